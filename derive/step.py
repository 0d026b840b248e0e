"""A verified step, the value it yields, and the one door through which steps are made.

A `Step` is data: keys and expressions, no sentence and no TeX. Only `establish()` makes one, and it refuses unless

    (a) each line of the chain equals the line before it, and
    (b) every second, physical route to the result agrees with it.

A verb states its law once, as a function. `establish` calls it with the *names* of its inputs, which gives the
formula, and with their *values*, which gives the substitution; the tidy value of that is the result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any, NoReturn

from sympy import Expr, MatrixBase, MatrixSymbol, Symbol, diff
from sympy.core.symbol import Str

from derive.dimensions import kind_with_article
from derive.errors import Complaint, Rejected, Unverified
from derive.evidence import LEAST_SURE_FIRST, Evidence, Grade, Verdict, equal
from derive.exact import vanishes
from derive.expressions import AXES, Relation, Truncated, bound, component_names, explicit
from derive.tidy import tidied

BY_MOTION = "by the equations of motion"  # what a claim says that holds for motions that obey them


class Level(StrEnum):
    """How much algebra a reader wants; a form is shown at its own level and at every higher one."""

    BRIEF = "brief"
    STANDARD = "standard"
    FULL = "full"

    def shows(self, other: Level) -> bool:
        order = list(Level)
        return order.index(other) <= order.index(self)


NUMBERS = ("value", "rounded")  # why a form stands at the end of a chain: the number in a unit, exact or rounded


@dataclass(frozen=True)
class Form:
    """One line of a chain: an expression and why it equals the line before it.

    `because` is a key that `templates/phrases` puts into words. A form `because="rounded"` is approximately equal.
    A form may be a `Relation`; then it says the same as the relation before it, once both are divided by `nonzero`
    factors: those that do not vanish in the case considered, or in an inequality are positive.
    """

    expr: Any
    because: str
    level: Level = Level.BRIEF
    nonzero: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Step:
    """What was established: the symbol, the chain that leads to its value, and how we know.

    The symbol of a step that yields a relation is None: the page refers to it by its number. `coordinates` are those
    that the step brings in, with their kinds. `stands_for` are keys of steps that there would be in another case: two
    roots where there is only one.
    """

    key: str
    rule: str
    symbol: Any
    chain: tuple[Form, ...]
    inputs: tuple[str, ...]
    roles: tuple[tuple[str, Any], ...]
    outcome: str
    evidence: tuple[Evidence, ...]
    kind: str | None = None
    words: tuple[tuple[str, str], ...] = ()
    coordinates: tuple[tuple[Symbol, str], ...] = ()
    stands_for: tuple[str, ...] = ()

    @property
    def result(self) -> Any:
        return self.chain[-1].expr

    @property
    def grade(self) -> Grade:
        """As sure as the least sure of its lines, all of which must hold, and as the surest of its second routes."""
        lines = [e.grade for e in self.evidence if e.is_of_line]
        routes = [e.grade for e in self.evidence if not e.is_of_line]
        surest = [max(routes, key=LEAST_SURE_FIRST.index)] if routes else []
        return min([*lines, *surest], key=LEAST_SURE_FIRST.index)


@dataclass(frozen=True, eq=False)
class Quantity:
    """A value that knows the step that made it, and the steps that step rests on.

    Arithmetic on a quantity would lose its history, so it is refused; `let` is the verb for that.
    """

    value: Any
    step: Step
    parents: tuple[Quantity, ...] = ()
    context: Mapping[str, Any] = field(default_factory=dict)

    @property
    def symbol(self) -> Any:
        return self.step.symbol

    @property
    def key(self) -> str:
        return self.step.key

    @property
    def coordinates(self) -> dict[Symbol, str]:
        """The coordinates that it may depend on, with their kinds: its own and those of what it rests on."""
        own = dict(self.step.coordinates)
        return {**own, **{q: kind for parent in self.parents for q, kind in parent.coordinates.items()}}

    def __repr__(self) -> str:
        return f"Quantity({self.key}: {self.symbol} = {self.value})"

    def _no_arithmetic(self, *_: Any) -> NoReturn:
        raise Unverified(
            Complaint(
                "plain-arithmetic",
                f"arithmetic on `{self.key}` would lose the steps behind it",
                help=f'write it as a step: let("name", lambda x: ..., {self.key})',
            )
        )

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = _no_arithmetic
    __truediv__ = __rtruediv__ = __pow__ = __rpow__ = __neg__ = __matmul__ = _no_arithmetic


def lettered(quantity: Quantity) -> Quantity:
    """The quantity known by its letter alone: what rests on it keeps the letter, until values are put in."""
    return replace(quantity, value=quantity.symbol, parents=(quantity,))


Law = Callable[..., Any]
Route = Callable[[Any], tuple[Any, Any] | Verdict]


def compared_with(other: Callable[[], Any]) -> Route:
    """The plainest second route: another way to the same value."""
    return lambda result: (result, other())


def establish(
    rule: str,
    symbol: Any,
    law: Law,
    inputs: Mapping[str, Any],
    *,
    key: str | None = None,
    before: Sequence[Form] = (),
    between: Sequence[Form] = (),
    after: Sequence[Form] = (),
    routes: Mapping[str, Route] | None = None,
    outcome: Callable[[Any], str] | str = "generic",
    kind: str | None = None,
    definition: bool = False,
    put_in: Level | None = Level.STANDARD,
    show_result: bool = True,
    law_shown: Level = Level.BRIEF,
    parents: Sequence[Quantity] = (),
    context: Mapping[str, Any] | None = None,
    words: Mapping[str, str] | None = None,
    coordinates: Mapping[Symbol, str] | None = None,
    stands_for: Sequence[str] = (),
    arranged: Callable[[Any], Any] = tidied,
    motion: Mapping[Symbol, Expr] | None = None,
) -> Quantity:
    """Make a step, or refuse.

    rule      which phrase and which source, `topic.verb`
    symbol    what the page calls the result
    law       a function of the inputs, in their order; it is called with names and with values
    inputs    role -> Quantity, or plain SymPy value
    before    forms that come ahead of the law, `between` the law and the result, `after` the result
    routes    claim -> function of the result, giving two values that must be equal
    outcome   a word, or a function of the result that gives one; it selects the phrase
    words     name -> key of a term that phrases put into words ("about": "corner")
    stands_for   keys that answers may ask for although in this case there is only this step
    arranged  how the result is written; it changes no value
    motion    rate -> what the equations of motion make of it, put in at the last line, which holds only then
    put_in    the level at which the substituted law is shown; None leaves it out; `law_shown` that of the law
    Raises `Unverified`, naming the step, when a line or a route disagrees.
    """
    key = key or rule.rpartition(".")[2]
    _check_names(key, [q for q in inputs.values() if isinstance(q, Quantity)])
    quantities = {role: q for role, q in inputs.items() if isinstance(q, Quantity)}
    given = [value_behind(q) for q in inputs.values()]
    names = [q.symbol if isinstance(q, Quantity) else q for q in inputs.values()]

    formula, substituted = law(*names), law(*given)
    bindings = _bindings([*quantities.values(), *parents])
    result = arranged(bound(explicit(bound(substituted, bindings)), {**bindings, **(motion or {})}))
    _check_letter(key, symbol, result)
    chain = _without_repeats(
        [
            *before,
            Form(formula, "law", law_shown),
            *([Form(substituted, "put_in", put_in)] if put_in else []),
            *between,
            *([Form(result, "motion" if motion else "result")] if show_result else []),
            *after,
        ],
        symbol,
    )
    evidence = [_line_evidence(key, chain, i, bindings, motion or {}) for i in range(1, len(chain))]
    evidence += [_route_evidence(key, claim, route(result)) for claim, route in (routes or {}).items()]
    if not routes:
        evidence.append(_unsupported(key, rule, definition))
    chosen = outcome(result) if callable(outcome) else outcome
    _check_outcome(key, chosen, result, may_be_zero=callable(outcome))
    step = Step(
        key=key,
        rule=rule,
        symbol=symbol,
        chain=tuple(chain),
        inputs=tuple(dict.fromkeys(q.key for q in [*quantities.values(), *parents])),
        roles=tuple((role, _called(q)) for role, q in inputs.items()),
        outcome=chosen,
        evidence=tuple(evidence),
        kind=kind,
        words=tuple((words or {}).items()),
        coordinates=tuple((coordinates or {}).items()),
        stands_for=tuple(stands_for),
    )
    quantity = Quantity(result, step, tuple(dict.fromkeys([*parents, *quantities.values()])), context or {})
    record = _established.get()
    if record is not None:
        record.append(quantity)
    return quantity


def _called(value: Any) -> Any:
    """What a phrase calls an input: its symbol, or the key of a relation, which has none."""
    if isinstance(value, Quantity):
        return Str(value.key) if value.symbol is None else value.symbol
    return value


_established: ContextVar[list[Quantity] | None] = ContextVar("established", default=None)


@contextmanager
def recorded() -> Iterator[list[Quantity]]:
    """Collect every quantity established within, so that the page can name those it does not show."""
    record: list[Quantity] = []
    token = _established.set(record)
    try:
        yield record
    finally:
        _established.reset(token)


def _check_outcome(key: str, outcome: str, result: Any, may_be_zero: bool) -> None:
    """A sentence that says "zero" needs a result that vanishes, and one that vanishes is not `generic`."""
    vanishing = is_zero(result)
    if (outcome == "zero" and not vanishing) or (outcome == "generic" and may_be_zero and vanishing):
        message = f"`{key}`: the outcome `{outcome}` does not fit the result {_short(result)}"
        raise Unverified(Complaint("unverified", message))


def _check_names(key: str, quantities: Sequence[Quantity]) -> None:
    """Two different things of one name cannot stand in one formula."""
    named: dict[Any, Quantity] = {}
    for quantity in quantities:
        if quantity.symbol is None:
            continue
        other = named.setdefault(quantity.symbol, quantity)
        if other.step != quantity.step:
            message = f"`{key}` needs `{other.key}` and `{quantity.key}`, but both are called {quantity.symbol}"
            raise Rejected(Complaint("letter-clash", message, help='give one of their verbs `symbol="..."`'))


def _check_letter(key: str, symbol: Any, result: Any) -> None:
    """A letter that already means something in the result cannot also be its name."""
    if isinstance(symbol, Symbol) and any(other.name == symbol.name for other in result.free_symbols):
        message = f"`{key}` is called {symbol.name}, but {symbol.name} already stands for something that is given"
        raise Rejected(Complaint("letter-clash", message, help='use another letter, or give the verb `symbol="..."`'))


def _unsupported(key: str, rule: str, definition: bool) -> Evidence:
    """A verb has a second route or says that it only gives something a name."""
    if not definition:
        raise Unverified(Complaint("no-second-route", f"`{key}` has no second route and is not a definition"))
    return Evidence("definition", Grade.DEFINITION, rule)


def _without_repeats(forms: Sequence[Form], symbol: Any) -> list[Form]:
    """A form that looks just like the one before it says nothing; the lower level of the two is kept.

    Nor does one that is only the symbol of the step, unless there is no other.
    """
    kept: list[Form] = []
    for form in [form for form in forms if form.expr != symbol] or forms[-1:]:
        if kept and kept[-1].expr == form.expr and form.because != "rounded":
            level = min(kept[-1].level, form.level, key=list(Level).index)
            kept[-1] = replace(kept[-1], level=level)
        else:
            kept.append(form)
    return kept


def _bindings(quantities: Sequence[Quantity]) -> dict[Any, Any]:
    """What the names in a formula stand for: a vector's name brings its components' names along."""
    values: dict[Any, Any] = {}
    for quantity in quantities:
        if quantity.symbol is None:
            continue
        values[quantity.symbol] = quantity.value
        if isinstance(quantity.symbol, MatrixSymbol) and quantity.symbol.shape == (3, 1):
            names = component_names(quantity.symbol.name)
            values.update(zip(names, list(quantity.value), strict=True))
        elif isinstance(quantity.symbol, MatrixBase):  # several things established together, such as I_1, I_2, I_3
            values.update(zip(quantity.symbol, quantity.value, strict=True))
    # A name may not stand for something that holds that very name (a general omega has components omega_x, ...).
    return {name: value for name, value in values.items() if name != value}


def _line_evidence(
    key: str, chain: Sequence[Form], i: int, bindings: Mapping[Any, Any], motion: Mapping[Symbol, Expr]
) -> Evidence:
    form, before = chain[i], chain[i - 1]
    if form.because in NUMBERS:  # each number of a result is compared with the result, not with the number before it
        before = next(other for other in reversed(chain[:i]) if other.because not in NUMBERS)
    left, right = (explicit(bound(each.expr, bindings)) for each in (before, form))
    claim = f"line {i + 1} equals line {i}"
    if form.because == "rounded":
        return _rounding_evidence(key, claim, left, form.expr)
    if isinstance(form.expr, Truncated):
        return _series_evidence(key, claim, left, form.expr)
    if form.because == "motion":
        claim = f"{claim} {BY_MOTION}"
        left, right = bound(left, motion), bound(right, motion)
    verdict = equal(left, right, [explicit(bound(factor, bindings)) for factor in form.nonzero])
    if not verdict:
        raise _refused(key, f"line {i + 1} ({form.because}) does not follow from line {i}", left, right, verdict)
    return Evidence(claim, verdict.grade, verdict.detail)


def _series_evidence(key: str, claim: str, whole: Any, series: Any) -> Evidence:
    """A series that breaks off has, at its place, the value and the derivatives of the whole up to its order."""
    polynomial, x, place, order = series.args
    rest = whole - explicit(polynomial)
    for n in range(int(order) + 1):
        if not vanishes(diff(rest, x, n).subs(x, place)):
            raise Unverified(Complaint("unverified", f"`{key}`: the series is wrong at order {n} in {x}"))
    return Evidence(claim, Grade.APPROXIMATION, f"to order {order} in {x}")


def _rounding_evidence(key: str, claim: str, exact: Any, rounded: Any) -> Evidence:
    """A rounded value may differ by half a unit of its last place, and by no more."""
    from derive.rounding import off_by_more_than_half_a_unit

    offender = off_by_more_than_half_a_unit(exact, rounded)
    if offender:
        raise Unverified(Complaint("unverified", f"`{key}`: {offender[0]} is not {offender[1]} rounded"))
    return Evidence(claim, Grade.APPROXIMATION, "within half a unit of the last place")


def _route_evidence(key: str, claim: str, found: tuple[Any, Any] | Verdict) -> Evidence:
    """A route gives two values to compare, or has compared them itself, as one in numbers does."""
    if isinstance(found, Verdict):
        left = right = None
        verdict = found
    else:
        left, right = (explicit(value) for value in found)
        verdict = equal(left, right)
    if not verdict:
        raise _refused(key, f"its second route `{claim}` disagrees", left, right, verdict)
    return Evidence(claim, verdict.grade, verdict.detail)


def _refused(key: str, what: str, left: Any, right: Any, verdict: Verdict) -> Unverified:
    notes = [f"by the law     {_short(left)}", f"otherwise      {_short(right)}"]
    at = ", ".join(f"{name} = {value}" for name, value in verdict.point)
    notes.append(f"they differ: {verdict.detail}" + (f" at {at}" if at else ""))
    return Unverified(Complaint("unverified", f"`{key}`: {what}", notes=tuple(notes)))


def _short(value: Any) -> str:
    text = str(value)
    return text if len(text) <= 300 else text[:300] + " ..."


def require_kind(verb: str, role: str, quantity: Any, kind: str) -> None:
    """Refuse a quantity of another kind: arguments in the wrong order, a tensor for a vector."""
    if isinstance(quantity, Quantity) and quantity.step.kind == kind:
        return
    got = (
        f"`{quantity.key}` is {kind_with_article(quantity.step.kind or 'number')}"
        if isinstance(quantity, Quantity)
        else f"it is {type(quantity).__name__}"
    )
    wanted = kind_with_article(kind)
    raise Rejected(Complaint("wrong-argument", f"`{verb}` needs {wanted} as its `{role}`, but {got}"))


def value_behind(given: Any) -> Any:
    """The value of a quantity; anything else is its own value."""
    return given.value if isinstance(given, Quantity) else given


def scalar_component(quantity: Quantity, i: int) -> Symbol:
    """The name of a vector quantity's component: c -> c_x."""
    return component_names(quantity.symbol.name)[i]


def entry_name(name: str, i: int, j: int) -> Symbol:
    """The name of a tensor's entry: J_xy."""
    return Symbol(f"{name}_{AXES[i]}{AXES[j]}", real=True)


def is_zero(value: Any) -> bool:
    value = explicit(value)
    if isinstance(value, Relation):
        return False
    entries: list[Expr] = list(value) if hasattr(value, "shape") else [value]
    return all(vanishes(entry) for entry in entries)
