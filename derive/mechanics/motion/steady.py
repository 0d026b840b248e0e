"""Steady motions: the cyclic coordinates have constant rates, and all other coordinates are constant.

Source: Landau, Lifshitz, *Mechanics*, section 14; Goldstein, Poole, Safko, *Classical Mechanics*, sections 3.6 and 5.7.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from sympy import Add, Dummy, Expr, Integer, Mul, Symbol

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import TIME, Partial, Relation, as_expr, bound, depends_on_time, explicit, rate
from derive.algebra.ranges import never_vanishes_within
from derive.algebra.taylor import slope
from derive.errors import Complaint, Rejected
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Symbols, Values, in_results
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate, kind_of_rate, unknown
from derive.mechanics.lagrange.applied_forces import ActedOn
from derive.mechanics.lagrange.facts import WithMomenta
from derive.mechanics.lagrange.lagrangian import coordinates_of
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.motion import claims
from derive.mechanics.motion.facts import Steady
from derive.solving.presentation import presented, without_positive
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import require_constant
from derive.steps.rule import ROUTE, Rule
from derive.steps.step import Level, Quantity, compared_with, require_kind

__all__ = ["steady_motion"]

ZERO = Integer(0)


def steady_motion(
    of: Quantity,
    rates: Mapping[Any, Any] | None = None,
    at: Mapping[Any, Any] | None = None,
    key: str = "steady_motion",
) -> Quantity | tuple[Quantity, ...]:
    """Condition of a steady motion, dL/dq = 0 at q_dot = 0, for each coordinate q that is not cyclic.

    of      the Lagrangian, J, which must not contain the time; or the equation of motion of one coordinate, with the
            values of conserved momenta substituted
    rates   constant rates of cyclic coordinates, `{phi: Omega}`; a rate that is not given keeps its symbol
    at      constant values of other coordinates, `{theta: alpha}`; a coordinate that is not given keeps its symbol
    key     the key of the step; for several conditions, the name of the coordinate is appended

    Second route: sum of (m a - F) . dr/dq = 0 for the mass points in this motion, with accelerations a from the places
    as functions of time.
    Outcomes: generic, always (satisfied for all values of the symbols), of_equation (from an equation of motion).
    Errors: L contains the time; no coordinate is cyclic, or all are; a force without a potential energy acts; a rate is
    given for a coordinate that is not cyclic; the condition cannot be satisfied.
    Source: Landau, Lifshitz, *Mechanics*, section 14; Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    known = of.fact(WithMomenta)
    equation, of = (of, known.lagrangian) if known is not None else (None, of)
    require_kind("steady_motion", "of", of, "energy")
    L = explicit(of.value)
    if depends_on_time(L) or of.fact(ActedOn) is not None:
        time, other = "contains the time explicitly", "does not contain all forces: some have no potential energy"
        raise Rejected(Complaint("changes", f"`steady_motion`: `{of.key}` {time if depends_on_time(L) else other}"))
    every = coordinates_of(of)
    turning = [q for q in every if not L.has(q.symbol)]
    still = [q for q in every if L.has(q.symbol)]
    if not turning or not still:
        which = "only cyclic coordinates" if turning else "no cyclic coordinate, so no rate is constant"
        raise Rejected(Complaint("wrong-argument", f"`steady_motion`: `{of.key}` has {which}"))
    given_rates, values = _given("rate", rates, turning, still), _given("value", at, turning, still)
    given_rates |= {k.coordinate: bound(k.turning, values) for k in (known.kept if known is not None else ())}
    steady_rates = {q.symbol: given_rates.get(q.symbol, q.rate) for q in turning}
    places = {q.symbol: values.get(q.symbol, q.symbol) for q in still}
    motion = {letter: ZERO for q in every for letter in (q.rate, q.acceleration)}
    motion |= {rate(q): value for q, value in steady_rates.items()} | values
    conditions = tuple(presented(bound(derivative(L, q.symbol), motion)) for q in still)
    steady = Steady(of, places, steady_rates, conditions)
    if equation is not None:
        return _of_equation(equation, steady, equation.needed(OfCoordinate).coordinate, motion, key)
    single = len(still) == 1
    found = tuple(_condition(steady, q, motion, key if single else f"{key}_{q.symbol.name}") for q in still)
    return found[0] if single else found


STEADY_MOTION = Rule(
    "motion.steady_motion",
    source="Landau, Lifshitz, *Mechanics*, section 14; Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7",
    outcomes={
        "generic": claims.steady_motion_generic,
        "always": claims.steady_motion_always,
        "of_equation": claims.nothing_else_moves,
    },
    evidence={"carried_along": ROUTE, "given_carried_along": ROUTE},
    named={"stays": claims.stays_and_turns, "turns": claims.stays_and_turns},
)


def _of_equation(
    equation: Quantity, steady: Steady, q: Coordinate, motion: Mapping[Symbol, Expr], key: str
) -> Quantity:
    """Condition of a steady motion from an equation of motion, with a constant coordinate and constant cyclic rates.

    Outcomes: of_equation.
    Source: the same as for `steady_motion`.
    """
    turning = set(steady.rates)
    still = {letter: value for letter, value in motion.items() if letter not in {rate(s) for s in turning}}
    matter = steady.lagrangian.needed(Matter)
    left = _rates_first(presented(bound(equation.value.left, still)), steady)
    core = without_positive(left, in_equation=True)
    if core.is_nonzero:
        raise Rejected(Complaint("cannot-hold", f"there is no such steady motion: {core} cannot vanish"))
    told = {f"stays_{n}": (s, value) for n, (s, value) in enumerate(steady.values.items(), 1) if s != value}
    kept = {s: v for s, v in steady.rates.items() if rate(s) != v}
    return establish(
        STEADY_MOTION,
        None,
        lambda *_: Relation(bound(equation.value.left, still), "=", 0),
        {"equation": equation, "coordinate": q.symbol},
        lines=Lines(law=Level.FULL, put_in=None, arranged=lambda _: Relation(core, "=", 0)),
        routes=matter.named(
            {"carried_along": compared_with(lambda: Relation(_left_along(matter, steady, q.symbol), "=", 0))}
        ),
        outcome="of_equation",
        phrase_data=PhraseData(
            named={role: Relation(s, "=", v) for role, (s, v) in told.items()},
            outcome_data={"lagrangian": steady.lagrangian.value, "constant": tuple(kept)},
        ),
        key=key,
        facts=[steady, OfCoordinate(q)],
    )


def _given(
    role: str, given: Mapping[Any, Any] | None, turning: Sequence[Coordinate], still: Sequence[Coordinate]
) -> dict[Symbol, Expr]:
    """Return a mapping from coordinates to their given constant values or, for the role "rate", to given rates."""
    known = {q.symbol for q in (turning if role == "rate" else still)}
    moving = {TIME, *(s for q in (*turning, *still) for s in (q.symbol, q.rate))}
    found: dict[Symbol, Expr] = {}
    for q, value in (given or {}).items():
        letter = q.symbol if isinstance(q, Coordinate) else q
        if letter not in known:
            wrong = "not cyclic" if role == "rate" else "cyclic, or not a coordinate of the Lagrangian"
            message = f"`steady_motion`: a {role} is given for {letter}, which is {wrong}"
            raise Rejected(Complaint("wrong-argument", message))
        number = value.value if isinstance(value, Quantity) else as_expr(value)
        held = {s for s in number.free_symbols if any(s == q.rate for q in turning)}  # constant in this motion
        held |= ({number} if isinstance(number, Symbol) else set()) - moving  # a symbol for a constant value
        require_constant("steady_motion", role, number.xreplace({s: Dummy("held", real=True) for s in held}))
        found[letter] = number
    return found


def _condition(steady: Steady, q: Coordinate, motion: Mapping[Symbol, Expr], key: str) -> Quantity:
    """Condition of a steady motion for one coordinate.

    Outcomes: generic, always.
    Source: the same as for `steady_motion`.
    """
    of, matter = steady.lagrangian, steady.lagrangian.needed(Matter)
    force = bound(derivative(explicit(of.value), q.symbol), motion)
    core = without_positive(_rates_first(presented(-force), steady), in_equation=True)
    if core.is_nonzero or core != 0 and never_vanishes_within(core):
        raise Rejected(Complaint("cannot-hold", f"there is no such steady motion: {core} cannot vanish"))
    told = {f"stays_{n}": (s, value) for n, (s, value) in enumerate(steady.values.items(), 1) if s != value}
    told |= {f"turns_{n}": (rate(s), v) for n, (s, v) in enumerate(steady.rates.items(), 1) if rate(s) != v}
    return establish(
        STEADY_MOTION,
        None,
        lambda L: Relation(Partial(L, q.symbol), "=", 0),
        {"lagrangian": of},
        lines=Lines(put_in=None, motion=motion, arranged=lambda _: Relation(core, "=", 0)),
        routes=matter.named(
            {"carried_along": compared_with(lambda: Relation(_left_along(matter, steady, q.symbol), "=", 0))}
        ),
        outcome="always" if core == 0 else "generic",
        phrase_data=PhraseData(
            named={role: Relation(s, "=", v) for role, (s, v) in told.items()},
            outcome_data={"coordinate": q.symbol},
        ),
        key=key,
        facts=[steady, OfCoordinate(q)],
    )


def _rates_first(value: Expr, steady: Steady) -> Expr:
    """Choose the sign so that the highest power of a rate has a positive coefficient. Only squares and higher powers
    count; without them, the value is unchanged."""
    for letter in sorted({s for v in steady.rates.values() for s in v.free_symbols}, key=str):
        for each in Mul.make_args(value):
            polynomial = each.as_poly(letter)
            if each.is_Add and polynomial is not None and polynomial.degree() > 1:
                return presented(-value) if polynomial.LC().could_extract_minus_sign() else value
    return value


def _left_along(matter: Matter, steady: Steady, q: Symbol) -> Expr:
    """Return the residual of d'Alembert's principle for the mass points in this motion."""
    motion: dict[Symbol, Expr] = {**steady.values}
    motion |= {s: s + v * TIME for s, v in steady.rates.items()}
    rates = {rate(s): steady.rates.get(s, ZERO) for s in matter.coordinates}
    left: Expr = ZERO
    for point in matter.points:
        for c in (explicit(x) for x in point.place):
            speed = slope(c.xreplace(motion), TIME)
            left += point.mass * slope(speed, TIME) * slope(c, q).xreplace(motion)
    fields = [field.load(matter.coordinates) for field in matter.fields]
    works = (load.work_along(q) for load in (*matter.loads, *fields, *matter.others) if load.multiplier is None)
    return left - explicit(Add(*works)).xreplace(rates).xreplace(motion)


# --- for `results:` ---------------------------------------------------------------------------------------------------


NONE: Mapping[str, Expr] = MappingProxyType({})


@in_results(
    "steady",
    "the condition of a steady motion from the Lagrangian; `roots` solves this condition",
    of="steady: a Lagrangian",
    values="values: `{r: r_0}`",
    symbols="symbol: symbols of the cyclic rates",
)
def _in_results(
    of: Quantity, key: str, coordinates: Mapping[str, Coordinate], values: Values = NONE, symbols: Symbols = ()
) -> Quantity | tuple[Quantity, ...]:
    places = {coordinates[name]: value for name, value in values.items() if name in coordinates}
    rates: dict[Coordinate, Any] = {
        q: value for name, value in values.items() for q in coordinates.values() if q.rate.name == name
    }
    known = {*(q.symbol.name for q in places), *(q.rate.name for q in rates)}
    strange = next((name for name in values if name not in known), None)
    if strange is not None:
        message = f"`steady` needs values of coordinates or rates, but `{strange}` is neither"
        raise Rejected(Complaint("no-such-coordinate", message, argument=f"values:{strange}"))
    held = explicit(of.value).free_symbols
    turning = [q for q in coordinates.values() if q.symbol not in held and q not in rates]
    if len(symbols) not in (0, len(turning)):
        free = ", ".join(q.rate.name for q in turning) or "none"
        message = f"`steady` needs one symbol for each free cyclic rate ({free}), but `symbol` lists {len(symbols)}"
        help_line = "give a list of symbols in this order, or the value of a rate under `values`"
        raise Rejected(Complaint("wrong-argument", message, argument="symbols", help=help_line))
    for q, letter in zip(turning, symbols, strict=len(symbols) > 0):
        rates[q] = unknown(letter, kind_of_rate(q.kind) or "number", positive=True)
    return checked(steady_motion)(of, rates, places, key=key)
