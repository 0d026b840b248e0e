"""What one run of a script has established, which coordinates it has named, and what therefore moves.

One letter is one quantity in a run, and what contains a coordinate, a rate or the time is known to change.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from functools import wraps
from typing import Any, Protocol, TypeVar

from sympy import Expr, MatrixBase, MatrixSymbol, Symbol, oo

from derive.algebra.expressions import RATES, TIME, Relation, component_names, explicit, rate
from derive.algebra.ranges import own_meaning
from derive.errors import Complaint, Place, Rejected, Spelled
from derive.steps.step import Quantity, same_value, value_behind


class Recalling(Protocol):
    """What knows the calls of verbs that were made before."""

    def result(self, verb: Callable[..., Any], given: Mapping[str, Any], run: Run, make: Callable[[], Any]) -> Any: ...


@dataclass
class Call:
    """A call of a verb while it is made.

    before   how many quantities were established before it
    asked    what it has asked of the record, about what, and the answer
    """

    before: int
    asked: list[tuple[str, tuple[Any, ...], Any]] = field(default_factory=list)


@dataclass
class Run:
    """What is known while a script runs, and what it leaves.

    established   every quantity, in order; cases, for each of them that which it is a particular case of
    coordinates   those that it has named, with their kinds
    assumed       conditions that its letters leave open; in_words, those of them that a step tells
    drawings      what is to be seen
    numbers       behind the letters of its problem, as given
    places        where each given was written
    letters       that the problem has for what is given, for coordinates and for forces: no result takes them
    memory        of calls of verbs that were made before; call, the one that is being made
    """

    established: list[Quantity] = field(default_factory=list)
    cases: list[Quantity | None] = field(default_factory=list)
    coordinates: dict[Symbol, str] = field(default_factory=dict)
    assumed: list[Relation] = field(default_factory=list)
    in_words: list[Relation] = field(default_factory=list)
    drawings: list[Any] = field(default_factory=list)
    numbers: Mapping[Symbol, Expr] = field(default_factory=dict)
    places: Mapping[str, Place] = field(default_factory=dict)
    letters: Collection[str] = ()
    memory: Recalling | None = None
    call: Call | None = None


# what textbooks call a result too, where a problem has the usual letter for something else
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
    """The record of what is done within, so that the page can name what it does not show and what it assumes."""
    run = run or Run()
    token = current_run.set(run)
    try:
        with own_meaning():
            yield run
    finally:
        current_run.reset(token)


QUESTIONS: dict[str, Callable[..., Any]] = {}  # what a verb asks of the record, besides what every call is told by
A = TypeVar("A")


def question(answered: Callable[..., A]) -> Callable[..., A]:
    """What a verb asks of the record is noted: where the answer is another, the verb is called again."""
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
    """Whether the problem or an earlier result has this letter."""
    run = current_run.get()
    if run is None:
        return False
    return name in run.letters or any(str(quantity.symbol) == name for quantity in _before_call(run))


def letter_of_limit(symbol: Any, letter: Symbol, to: Any) -> Any:
    """A letter for what a result becomes where a letter goes to a value: omega_2_lim, or omega_2_infty.

    Another letter where this one is taken has the letter that goes there too.
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
    """A script has named a coordinate: from now on whatever contains it is known to move."""
    run = current_run.get()
    if run is not None:
        run.coordinates[symbol] = kind


@question
def free_letter(name: str, *indices: str) -> str:
    """The letter of a result, with its index; another one where the problem has it, with any of the indices."""
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
    """The letters that the problem has for what is given, for coordinates and for forces."""
    run = current_run.get()
    return set(run.letters) if run is not None else set()


def assume(condition: Relation, in_words: bool = False) -> None:
    """A condition that the letters leave open: the page says that it is taken to hold; or a step does, in words."""
    run = current_run.get()
    if run is not None and condition not in run.assumed:
        run.assumed.append(condition)
        run.in_words.extend([condition] if in_words else [])


def assumed() -> list[Relation]:
    """What the page says that it takes to hold."""
    run = current_run.get()
    return list(run.assumed) if run is not None else []


def assumed_in_words() -> list[Relation]:
    """Those of them that a step states in words."""
    run = current_run.get()
    return list(run.in_words) if run is not None else []


def established() -> list[Quantity]:
    """What this run has established so far."""
    run = current_run.get()
    own = run.established[run.call.before :] if run is not None and run.call is not None else []
    return [*_established_before(), *own]


@question
def _established_before() -> tuple[Quantity, ...]:
    """What it had established before the verb that asks was called."""
    run = current_run.get()
    return _before_call(run) if run is not None else ()


def _before_call(run: Run) -> tuple[Quantity, ...]:
    return tuple(run.established[: run.call.before if run.call else None])


def finished_steps(run: Run) -> tuple[str, ...]:
    """The keys of what it had established before the call that is being made."""
    return tuple(dict.fromkeys(quantity.key for quantity in _before_call(run)))


def named_coordinates() -> tuple[Symbol, ...]:
    """All coordinates of the run."""
    run = current_run.get()
    return tuple(run.coordinates) if run else ()


def coordinates_in(result: Any) -> dict[Symbol, str]:
    """The coordinates of the run that a result contains, themselves or by a rate."""
    run = current_run.get()
    if run is None or not run.coordinates:
        return {}
    present = result.free_symbols
    return {q: kind for q, kind in run.coordinates.items() if present & {q, *(rate(q, n) for n in (1, 2, 3))}}


def add(quantity: Quantity, case_of: Quantity | None) -> None:
    """Put a quantity on the record of the run, if there is one; its letter must be free, or mean what it meant."""
    run = current_run.get()
    known = {**quantity.coordinates, **(run.coordinates if run else {})}
    _check_one_meaning(quantity, case_of, known, run.established if run else quantity.parents)
    if run is not None:
        run.established.append(quantity)
        run.cases.append(case_of)


def _is_the_same(one: Quantity, other: Quantity) -> bool:
    """Whether they are one step, or one value that two steps have, as a tensor and its definition."""
    return one is other or one.step == other.step or same_value(one.value, other.value)


def _check_one_meaning(
    quantity: Quantity, case_of: Quantity | None, coordinates: Iterable[Symbol], others: Iterable[Quantity]
) -> None:
    """One letter is one quantity in a script: another value under a letter that is taken must be a case of it.

    What a coordinate or its rate becomes in one motion goes by the letter of that coordinate.
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
        message = f"`{other.key}` and `{quantity.key}` are both called {symbol}, but they are different things"
        raise Rejected(
            Complaint(
                "letter-clash",
                message,
                help=Spelled(
                    'give one of their verbs `symbol="..."`',
                    "give one of them another letter, under `symbols` or by `symbol`",
                ),
            )
        )


def _is_open(quantity: Quantity) -> bool:
    """A vector of which nothing is known but the names of its components: any other of its letter is a case of it."""
    symbol, value = quantity.symbol, quantity.value
    return isinstance(symbol, MatrixSymbol) and list(value) == list(component_names(symbol.name))


def changes(value: Any, coordinates: Iterable[Symbol] = ()) -> Symbol | None:
    """What makes a value change: the time itself, a coordinate or a rate; None if nothing does."""
    letters = explicit(value).free_symbols
    moving = [TIME, *(s for q in coordinates for s in (q, rate(q), rate(q, 2)))]
    return next((s for s in moving if s in letters), None)


def require_constant(verb: str, role: str, given: Any, help: str | None = None) -> None:
    """Refuse what changes in the course of time, where a law is one for constants."""
    known = given.coordinates if isinstance(given, Quantity) else {}
    run = current_run.get()
    moving = changes(value_behind(given), {**known, **(run.coordinates if run else {})})
    if moving is not None:
        what = "the time t" if moving == TIME else moving.name
        name = f"`{given.key}`" if isinstance(given, Quantity) else f"{value_behind(given)}"
        message = f"`{verb}` needs a constant {role}, but {name} depends on {what}"
        raise Rejected(Complaint("changes", message, help=help))
