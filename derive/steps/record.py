"""The record of one run of a script: the quantities that the script has established, and the coordinates that it has
named.

A symbol denotes one quantity in a run, or a general quantity and cases of it. Only the symbol of a coordinate or of its
rate may have several values, for example at different instants.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from functools import wraps
from typing import Any, Protocol, TypeVar

from sympy import Expr, MatrixBase, MatrixSymbol, Symbol, oo

from derive.algebra.expressions import RATES, TIME, Prescribed, Relation, component_names, explicit, prescribed_in, rate
from derive.algebra.order import Contradiction, Order, known_order
from derive.algebra.ranges import own_meaning, sign_within
from derive.errors import Complaint, Place, Rejected, Spelled
from derive.steps.step import Quantity, same_value, value_behind


class Recalling(Protocol):
    """A memory of earlier calls of verbs."""

    def result(self, verb: Callable[..., Any], given: Mapping[str, Any], run: Run, make: Callable[[], Any]) -> Any: ...

    def of_another_run(self) -> Recalling: ...


@dataclass
class Call:
    """A call of a verb while it runs.

    before   the number of quantities that were established before the call
    asked    the questions that the call put to the record, each with its arguments and its answer
    """

    before: int
    asked: list[tuple[str, tuple[Any, ...], Any]] = field(default_factory=list)


@dataclass
class Run:
    """The state of a running script, and its record.

    established   all quantities that verbs have established, in order
    cases         for each quantity, the general quantity of which it is a case; None if there is no such quantity
    coordinates   the coordinates that the script has named, with their kinds
    assumed       assumed conditions on the symbols
    in_words      the assumed conditions that a step states in words
    orders        the known order, and this order with the first assumed condition, with the first two, and so on
    drawings      the drawings of the page
    defined       the quantities that the problem defines under `define:`
    defined_at    the place in a file where each quantity of `define:` is written, by its name
    is_natural    whether results may contain quantities of `define:` and usual quantities such as omega_0
    numbers       the numbers that the problem gives for its symbols
    places        the place in a file where each given value is written
    letters       the symbols of given values, coordinates, forces and definitions; results must not use these symbols
    memory        earlier calls of verbs
    call          the call of a verb that is running
    """

    established: list[Quantity] = field(default_factory=list)
    cases: list[Quantity | None] = field(default_factory=list)
    coordinates: dict[Symbol, str] = field(default_factory=dict)
    assumed: list[Relation] = field(default_factory=list)
    in_words: list[Relation] = field(default_factory=list)
    orders: list[Order] = field(default_factory=list)
    drawings: list[Any] = field(default_factory=list)
    defined: list[Quantity] = field(default_factory=list)
    defined_at: Mapping[str, Place] = field(default_factory=dict)
    is_natural: bool = True
    numbers: Mapping[Symbol, Expr] = field(default_factory=dict)
    places: Mapping[str, Place] = field(default_factory=dict)
    letters: Collection[str] = ()
    memory: Recalling | None = None
    call: Call | None = None


# other textbook symbols for a result, if the problem uses the usual symbol for another quantity
OTHER_LETTERS: Mapping[str, tuple[str, ...]] = {
    "T": ("K",),
    "U": ("V",),
    "L": ("calL",),
    "H": ("calH",),
    "R": ("calR",),
    "h": ("J", "calE"),
    "v": ("u", "w"),
    "u": ("w",),
    "tau": ("tau_0",),
    "omega": ("Omega",),
    "lambda": ("mu", "lambda_0"),
    "beta": ("delta",),
    "gamma": ("Gamma",),
    "rho": ("rho_0",),
    "sigma": ("sigma_0",),
}

current_run: ContextVar[Run | None] = ContextVar("run", default=None)


@contextmanager
def recorded(run: Run | None = None) -> Iterator[Run]:
    """Record the quantities and the assumptions of a run."""
    run = run or Run()
    token = current_run.set(run)
    try:
        with own_meaning():
            yield run
    finally:
        current_run.reset(token)


@contextmanager
def unrecorded() -> Iterator[None]:
    """Derive steps that only a check needs. The run does not keep these steps, but it keeps their assumptions."""
    run = current_run.get() or Run()
    token = current_run.set(replace(run, established=[], cases=[], drawings=[], defined=[], memory=None, call=None))
    try:
        yield
    finally:
        current_run.reset(token)


QUESTIONS: dict[str, Callable[..., Any]] = {}  # name -> function with which a verb queries the record
A = TypeVar("A")


def question(answered: Callable[..., A]) -> Callable[..., A]:
    """Decorate a function with which a verb queries the record. The answers are stored with the result of the verb. A
    stored result is used again only if the answers are still the same."""
    QUESTIONS[answered.__name__] = answered

    @wraps(answered)
    def noted(*about: Any) -> A:
        answer = answered(*about)
        run = current_run.get()
        if run is not None and run.call is not None:
            each = (answered.__name__, about, answer)
            if each not in run.call.asked:
                run.call.asked.append(each)
        return answer

    return noted


@question
def is_taken(name: str) -> bool:
    """Whether the problem or an earlier result uses the symbol with this name."""
    run = current_run.get()
    if run is None:
        return False
    return name in run.letters or any(str(quantity.symbol) == name for quantity in _before_call(run))


@question
def result_called(name: str) -> Quantity | None:
    """Return the earlier result with this symbol, or None."""
    run = current_run.get()
    before = _before_call(run) if run is not None else ()
    return next((quantity for quantity in before if str(quantity.symbol) == name), None)


@question
def results_of(*rules: str) -> tuple[Quantity, ...]:
    """Return the earlier results of these rules."""
    run = current_run.get()
    before = _before_call(run) if run is not None else ()
    return tuple(quantity for quantity in before if quantity.step.rule in rules)


def letter_of_limit(symbol: Any, letter: Symbol, to: Any) -> Any:
    """Return a symbol for the limit of a result: omega_2_lim if the symbol `letter` goes to a finite value,
    omega_2_infty if it goes to infinity.

    If this symbol is taken, the returned symbol also contains the name of `letter`.
    """
    if isinstance(symbol, MatrixBase):
        return symbol.applyfunc(lambda each: letter_of_limit(each, letter, to))
    if isinstance(symbol, MatrixSymbol):
        return MatrixSymbol(_name_of_limit(symbol.name, letter, to), *symbol.shape)
    if not isinstance(symbol, Symbol):  # omega_0^2
        (inner,) = symbol.free_symbols
        return symbol.xreplace({inner: letter_of_limit(inner, letter, to)})
    return Symbol(_name_of_limit(symbol.name, letter, to), real=True)


def _name_of_limit(name: str, letter: Symbol, to: Any) -> str:
    dots = next((suffix for suffix in reversed(RATES) if suffix and name.endswith(suffix)), "")
    base = name.removesuffix(dots)
    mark = "infty" if to in (oo, -oo) else "lim"
    plain, longer = (f"{base}_{each}{dots}" for each in (mark, f"{letter.name.replace('_', '')}_{mark}"))
    return longer if is_taken(plain) else plain


def coordinate_named(symbol: Symbol, kind: str) -> None:
    """Record a coordinate that a script names. Expressions with this coordinate are then known to change."""
    run = current_run.get()
    if run is not None:
        run.coordinates[symbol] = kind


@question
def free_letter(name: str, *indices: str) -> str:
    """Return the usual symbol of a result or, if the problem already uses it, another textbook symbol. If the problem
    uses all of these, return the usual symbol.

    name      the usual symbol, with its own index
    indices   further indices with which the symbol must also be free
    """
    run = current_run.get()
    base, _, own = name.partition("_")
    if run is None:
        return name
    for letter in (base, *OTHER_LETTERS.get(base, ())):
        found = f"{letter}_{own}" if own else letter
        if not {found, *(f"{found}_{index}" for index in indices)} & set(run.letters):
            return found
    return name


@question
def given_letters() -> set[str]:
    """Return the names of the symbols of the given values, coordinates, forces and definitions of the problem."""
    run = current_run.get()
    return set(run.letters) if run is not None else set()


def assume(condition: Relation, in_words: bool = False) -> None:
    """Assume a condition on the symbols. The page states the assumption, unless a step states it (`in_words`). Reject a
    condition that is known to contradict the earlier assumptions."""
    run = current_run.get()
    if run is not None and condition not in run.assumed:
        known = known_order()
        orders = run.orders if run.orders[:1] == [known] else [known]
        try:
            for each in (*run.assumed[len(orders) - 1 :], condition):
                orders.append(_with_condition(orders[-1], each))
        except Contradiction:
            message = f"this result is true only for {condition}, which contradicts the assumptions of the page"
            help_line = "ask for results that are true under the same conditions"
            raise Rejected(Complaint("contradiction", message, help=help_line)) from None
        run.orders = orders
        run.assumed.append(condition)
        run.in_words.extend([condition] if in_words else [])


def _with_condition(order: Order, condition: Relation) -> Order:
    if condition.operator in ("=", "!="):
        return order
    difference = explicit(condition.residual if condition.operator[0] == ">" else -condition.residual)
    return order.with_relation(difference, not condition.operator.endswith("="), sign_within)


def assumed() -> list[Relation]:
    """Return the assumptions of the page."""
    run = current_run.get()
    return list(run.assumed) if run is not None else []


def forget_words() -> None:
    """Let the page state all assumptions, because no step states them in words."""
    run = current_run.get()
    if run is not None:
        run.in_words.clear()


def assumed_in_words() -> list[Relation]:
    """Return the assumptions that a step states in words."""
    run = current_run.get()
    return list(run.in_words) if run is not None else []


def established() -> list[Quantity]:
    """Return the quantities that this run has established so far."""
    run = current_run.get()
    own = run.established[run.call.before :] if run is not None and run.call is not None else []
    return [*_established_before(), *own]


@question
def _established_before() -> tuple[Quantity, ...]:
    """Return the quantities that the run had established before the current call of a verb."""
    run = current_run.get()
    return _before_call(run) if run is not None else ()


def _before_call(run: Run) -> tuple[Quantity, ...]:
    return tuple(run.established[: run.call.before if run.call else None])


def add_definition(quantity: Quantity) -> None:
    """Record a quantity that the problem defines."""
    run = current_run.get()
    if run is not None:
        run.defined.append(quantity)


def check_not_defined(key: str, symbol: Any, value: Any = None) -> None:
    """Reject a step whose key is the name of a quantity under `define:`. Also reject a step whose symbol contains such
    a name, unless the value of the step follows from the definition."""
    run = current_run.get()
    if run is None:
        return
    own = {key, *(s.name for s in getattr(symbol, "free_symbols", ()) if isinstance(s, Symbol))}
    names = [quantity for quantity in run.defined if quantity.key in own]
    name = next((each.key for each in names if each.key == key or not _is_its_value(each, symbol, value)), None)
    if name is not None:
        also = f"the step `{key}` also uses this symbol for its result"
        message = f"`{name}` is a symbol of this problem, but {also if name != key else 'it is also the key of a step'}"
        raise Rejected(Complaint("letter-clash", message, run.defined_at.get(name), help="use another symbol"))


def _is_its_value(defined: Quantity, symbol: Any, value: Any) -> bool:
    """Whether the value of an expression that contains a defined symbol follows from the definition."""
    if not isinstance(value, Expr) or not isinstance(symbol, Expr):
        return False
    return same_value(symbol.subs(defined.symbol, explicit(defined.value)), value)


@question
def may_use_quantities() -> bool:
    """Whether results may contain quantities under `define:` and usual quantities such as omega_0."""
    run = current_run.get()
    return run is None or run.is_natural


@question
def defined_quantities() -> tuple[Quantity, ...]:
    """Return the quantities that the problem defines under `define:`."""
    run = current_run.get()
    return tuple(run.defined) if run is not None else ()


def defined_as(value: Expr) -> Quantity | None:
    """Return the quantity under `define:` that has this value, or None."""
    return next((each for each in defined_quantities() if same_value(each.value, value)), None)


def finished_steps(run: Run) -> tuple[str, ...]:
    """Return the keys of the quantities that the run had established before the current call."""
    return tuple(dict.fromkeys(quantity.key for quantity in _before_call(run)))


def named_coordinates() -> tuple[Symbol, ...]:
    """Return all coordinates of the run."""
    run = current_run.get()
    return tuple(run.coordinates) if run else ()


def coordinates_in(result: Any) -> dict[Symbol, str]:
    """Return the coordinates that occur in a result, or whose rates occur in it, each with its kind."""
    run = current_run.get()
    if run is None or not run.coordinates:
        return {}
    present = result.free_symbols
    return {q: kind for q, kind in run.coordinates.items() if present & {q, *(rate(q, n) for n in (1, 2, 3))}}


def add(quantity: Quantity, case_of: Quantity | None) -> None:
    """Check that the symbol of a quantity is new or keeps its meaning, and record the quantity if there is a run."""
    run = current_run.get()
    known = {**quantity.coordinates, **(run.coordinates if run else {})}
    _check_one_meaning(quantity, case_of, known, run.established if run else quantity.parents)
    if run is not None:
        run.established.append(quantity)
        run.cases.append(case_of)


def _is_the_same(one: Quantity, other: Quantity) -> bool:
    """Whether two quantities have the same step or the same value, such as a tensor and its definition."""
    return one is other or one.step == other.step or same_value(one.value, other.value)


def _check_one_meaning(
    quantity: Quantity, case_of: Quantity | None, coordinates: Iterable[Symbol], others: Iterable[Quantity]
) -> None:
    """Check that the symbol of a quantity denotes only one quantity in a script, or cases of it.

    A coordinate and its rates may have several values, since each motion has its own values.
    """
    symbol = quantity.symbol
    moving = {s for q in coordinates for s in (q, rate(q), rate(q, 2))}
    if not isinstance(symbol, Symbol | MatrixSymbol) or symbol in moving:
        return
    for other in others:
        if other.symbol != symbol or other.step == quantity.step or same_value(other.value, quantity.value):
            continue
        if _is_open(other) or _is_open(quantity):
            continue
        if case_of is not None and (_is_the_same(other, case_of) or other.key in case_of.step.inputs):
            continue
        message = f"`{other.key}` and `{quantity.key}` are both called {symbol}, but they are different quantities"
        raise Rejected(
            Complaint(
                "letter-clash",
                message,
                help=Spelled(
                    'pass `symbol="..."` to one of the two verbs',
                    "give one of the two another letter, under `symbols` or with `symbol`",
                ),
            )
        )


def _is_open(quantity: Quantity) -> bool:
    """Whether the components of a vector are unspecified symbols. Another vector with the same symbol is then a
    special case of this vector."""
    symbol, value = quantity.symbol, quantity.value
    return isinstance(symbol, MatrixSymbol) and list(value) == list(component_names(symbol.name))


def changes(value: Any, coordinates: Iterable[Symbol] = ()) -> Symbol | None:
    """Return a symbol that makes a value change, such as the time or a coordinate; None if the value is constant."""
    letters = explicit(value).free_symbols
    moving = [*prescribed_in(value), TIME, *(s for q in coordinates for s in (q, rate(q), rate(q, 2)))]
    return next((s for s in moving if s in letters), None)


def called_if_changing(moving: Symbol) -> str:
    """Return the words by which an error names a symbol that changes with time."""
    if moving == TIME:
        return "the time t"
    return f"{moving.name}, a function of the time" if isinstance(moving, Prescribed) else moving.name


def require_no_coordinate(verb: str, role: str, given: Any, help: str | None = None) -> None:
    """Reject an input that contains a coordinate or its rate, for a law that needs a function of the time alone."""
    moving = next(iter(coordinates_in(explicit(given))), None)
    if moving is not None:
        wanted = f"`{verb}` needs a {role} that is constant or a function of the time"
        message = f"{wanted}, but {given} contains {moving} or a rate of {moving}"
        raise Rejected(Complaint("changes", message, help=help))


def require_constant(verb: str, role: str, given: Any, help: str | None = None) -> None:
    """Reject an input that changes with time, for a law that needs a constant."""
    known = given.coordinates if isinstance(given, Quantity) else {}
    run = current_run.get()
    moving = changes(value_behind(given), {**known, **(run.coordinates if run else {})})
    if moving is not None:
        what = called_if_changing(moving)
        name = f"`{given.key}`" if isinstance(given, Quantity) else f"{value_behind(given)}"
        message = f"`{verb}` needs a constant {role}, but {name} depends on {what}"
        raise Rejected(Complaint("changes", message, help=help))
