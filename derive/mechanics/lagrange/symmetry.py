"""Noether's theorem: a shift of the coordinates under which the Lagrangian is invariant gives a constant of the motion.

Source: Landau, Lifshitz, *Mechanics*, sections 7 and 9; Goldstein, Poole, Safko, *Classical Mechanics*, section 13.7.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol, diff

from derive.algebra.collect import by_rates, by_terms
from derive.algebra.expressions import Factors, Partial, Relation, Terms, TimeRate, explicit, rate, scalar
from derive.algebra.normal_form import vanishes
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Value, Values, in_results
from derive.mechanics.kinematics.coordinates import Coordinate, by_functions_of_time, required
from derive.mechanics.lagrange import claims
from derive.mechanics.lagrange.facts import FromLagrangian, Varied
from derive.mechanics.lagrange.lagrangian import coordinates_of
from derive.mechanics.lagrange.momenta import conjugate_momentum, written_momentum
from derive.mechanics.model.dalembert import Matter
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Form, Level, Quantity

__all__ = ["noether"]

ZERO = Integer(0)


NOETHER = Rule(
    "lagrange.noether",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 13.7",
    outcomes={"symmetry": claims.noether_symmetry, "with_gain": claims.noether_with_gain},
    evidence={"along_the_shift": ROUTE, "carried": ROUTE, "given_along_the_shift": ROUTE, "given_carried": CHECK},
)


def noether(
    of: Quantity,
    shift: Mapping[Coordinate, Any],
    gained: Any = ZERO,
    symbol: str = "Q",
    key: str = "noether",
) -> Quantity:
    """Constant of the motion from a symmetry, Q = sum of p_q xi_q - F.

    of       the Lagrangian, J
    shift    coordinate -> xi, a formula in coordinates and time: each q becomes q + epsilon xi
    gained   F, a formula in coordinates and time, if the shift adds epsilon dF/dt to L; by default zero

    Separate steps show that L is invariant up to dF/dt, and derive the momenta.
    Second route: the time derivative of Q as a function of t is the sum of xi (m a - f) . dr/dq with the forces f. This
    sum vanishes by d'Alembert's principle. Also, Q + F is the sum of m v . dr over the mass points, and of e A . dr
    over charges e in magnetic fields. Here epsilon dr is the displacement by the shift.
    Check, if the problem gives L itself: if each rate q_dot becomes q_dot + epsilon xi, the first-order change of L is
    epsilon (Q + F).
    Outcomes: symmetry, with_gain (F is not zero).
    Errors: L is not invariant (the message shows its change); the shift or F contains a rate; the shift is zero, or
    shifts something that is not a coordinate of L.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 13.7.
    """
    xi = _formulas(of, shift)
    gain = _plain(gained, "function `gained`", of)
    changed = _change(of, xi, gain, key)
    matter = of.needed(Matter)
    moving = [q.symbol for q in coordinates_of(of)]
    momenta = {q: conjugate_momentum(of, q) for q in shift}

    def law(*p: Expr) -> Expr:
        carried = [_times(each, x) for each, x in zip(p, xi.values(), strict=True) if x != 0]
        return _positive_first([*carried, *(term for term in Add.make_args(-gain) if term != 0)])

    def along_the_shift(found: Expr) -> tuple[Expr, Expr]:
        work = [x * (matter.inertia_along(q) - matter.force_along(q)) for q, x in xi.items()]
        return by_functions_of_time(found, moving), Add(*work)

    def carried(found: Expr) -> tuple[Expr, Expr]:
        if isinstance(matter, Varied):
            return found, Add(*(x * matter.momentum_along(q) for q, x in xi.items())) - gain
        in_fields = (x * matter.field_momentum_along(q) for q, x in xi.items())
        return found, Add(*(m * way * v for m, way, v in _ways(matter, xi)), *in_fields) - gain

    return establish(
        NOETHER,
        scalar(symbol),
        law,
        {f"momentum_{q.symbol.name}": p for q, p in momenta.items()},
        lines=Lines(put_in=None, arranged=lambda value: written_momentum(value, of)),
        routes=matter.named({"along_the_shift": along_the_shift, "carried": carried}),
        outcome="with_gain" if gain != 0 else "symmetry",
        phrase_data=PhraseData(outcome_data={"gain": gain}, points_to={"change": changed}),
        key=key,
        parents=[of, changed],
        facts=[FromLagrangian(of)],
    )


def _formulas(of: Quantity, shift: Mapping[Coordinate, Any]) -> dict[Symbol, Expr]:
    named: list[Any] = list(shift)
    for q in named:
        if not isinstance(q, Coordinate):
            message = "`noether` needs a mapping from coordinates to shifts: {x: 1}, or {x: -y, y: x}"
            raise Rejected(Complaint("wrong-argument", message))
        required(of.coordinates, q, "noether", of)
    found = {q.symbol: _plain(x, f"shift of {q.symbol.name}", of) for q, x in shift.items()}
    if all(x == 0 for x in found.values()):
        raise Rejected(Complaint("wrong-argument", "`noether`: this shift moves no coordinate"))
    return found


def _plain(value: Any, role: str, of: Quantity) -> Expr:
    """Return a formula in coordinates and time; a formula with rates is rejected."""
    found = value.symbol if isinstance(value, Coordinate) else Integer(value) if isinstance(value, int) else value
    if not isinstance(found, Expr) or found.has(*(rate(q, n) for q in of.coordinates for n in (1, 2))):
        message = f"`noether`: the {role} must be a formula in coordinates and time, without rates"
        raise Rejected(Complaint("wrong-argument", message))
    return found


GAINED = Spelled(
    "if the change is the rate of some F, add `gained=F`", "if the change is the rate of some F, add `gained: F`"
)

CHANGE_UNDER_SHIFT = Rule(
    "lagrange.change_under_shift",
    source=(
        "Landau, Lifshitz, *Mechanics*, sections 7 and 9; Goldstein, Poole, Safko, *Classical Mechanics*, section 13.7"
    ),
    outcomes={"none": claims.change_under_shift_none, "gain": claims.change_under_shift_gain},
    evidence={"places": ROUTE, "given_places": ROUTE},
    statements=[claims.shifted_as_told],
)


def _change(of: Quantity, xi: Mapping[Symbol, Expr], gain: Expr, key: str) -> Quantity:
    """Derive the first-order change of L, the sum of dL/dq xi + dL/dq_dot dxi/dt. This change must equal the time
    derivative of `gain`."""
    matter = of.needed(Matter)
    moving = [q.symbol for q in coordinates_of(of)]
    L = explicit(of.value)
    ways = {q: x for q, x in xi.items() if x != 0 and L.has(q)}
    turned = {rate(q): v for q, x in xi.items() if (v := explicit(TimeRate(x, *moving))) != 0 and L.has(rate(q))}
    ways = _in_order(L, ways, turned)
    change, gained = Add(*(diff(L, s) * x for s, x in ways.items())), explicit(TimeRate(gain, *moving))
    if not vanishes(change - gained):
        by = f"epsilon times {by_terms(tidied(change))}"
        by += f", but the rate of `gained` is {by_terms(tidied(gained))}" if gained != 0 else ""
        message = f"`noether`: the shift is not a symmetry: it changes `{of.key}` by {by}"
        raise Rejected(Complaint("no-symmetry", message, help=GAINED))

    told: dict[str, Expr] = {}
    for i, (q, x) in enumerate(xi.items(), 1):
        told.update({f"q_{i}": q, **({f"xi_{i}": x} if x != 1 else {})})

    def law(L: Expr, *_: Expr) -> Relation:
        terms = [_times(Partial(L, s), x) for s, x in ways.items()]
        still = [Partial(L, q) for q, x in xi.items() if x != 0]
        return Relation(Terms(*(terms or still)), "=", TimeRate(gain, *moving) if gain != 0 else ZERO)

    def changed_by(gain: Expr) -> Expr:
        return by_functions_of_time(gain, moving)

    def by_places(found: Relation) -> tuple[Any, Any]:
        """Return the change of L from mass points and forces. It is the change of (1/2) m v.v plus the work of the
        forces; for charges e in magnetic fields, the rate of e A . dr is added."""
        if isinstance(matter, Varied):
            left = matter.change_along(xi)
            return ImmutableDenseMatrix([found.left, found.right]), ImmutableDenseMatrix([left, changed_by(gain)])
        done = [m * by_functions_of_time(way, moving) * v for m, way, v in _ways(matter, xi)]
        done += [matter.force_along(q) * x for q, x in xi.items()]
        done += [by_functions_of_time(matter.field_momentum_along(q) * x, moving) for q, x in xi.items()]
        both = [found.left, found.right]
        return ImmutableDenseMatrix(both), ImmutableDenseMatrix([Add(*done), changed_by(gain)])

    return establish(
        CHANGE_UNDER_SHIFT,
        None,
        law,
        {"lagrangian": of, **told},
        lines=Lines(put_in=None, result=False, arranged=explicit, after=_worked(L, ways, gain, moving)),
        routes=matter.named({"places": by_places}),
        outcome="none" if explicit(TimeRate(gain, *moving)) == 0 else "gain",
        phrase_data=PhraseData(outcome_data={"moved": tuple(ways)}),
        key=f"{key}_change",
    )


def _in_order(L: Expr, *groups: Mapping[Symbol, Expr]) -> dict[Symbol, Expr]:
    """Return the changes of the coordinates and the changes of the rates, as two groups one after the other. In each
    group, positive terms of the change of L come first. A group without positive terms comes last."""

    def is_negative(way: tuple[Symbol, Expr]) -> bool:
        return bool(_times(Partial(L, way[0]), way[1]).could_extract_minus_sign())

    ordered = [sorted(group.items(), key=is_negative) for group in groups if group]
    ordered.sort(key=lambda group: is_negative(group[0]))
    return dict(way for group in ordered for way in group)


def _worked(L: Expr, ways: Mapping[Symbol, Expr], gain: Expr, moving: Sequence[Symbol]) -> list[Form]:
    """Return the line with the derivatives substituted, if the shift changes a coordinate or a rate in L."""
    terms = [_times(by_rates(diff(L, s), moving), x) for s, x in ways.items()]
    right = by_rates(explicit(TimeRate(gain, *moving)), moving)
    return [Form(Relation(Terms(*terms), "=", right), "put_in", Level.STANDARD)] if terms else []


def _ways(matter: Matter, xi: Mapping[Symbol, Expr]) -> list[tuple[Expr, Expr, Expr]]:
    """Return the mass, the displacement by the shift and the velocity of each mass point along each axis."""
    found: list[tuple[Expr, Expr, Expr]] = []
    for point in matter.points:
        for c in point.place:
            way = Add(*(diff(c, q) * x for q, x in xi.items()))
            found.append((point.mass, way, by_functions_of_time(c, matter.coordinates)))
    return found


def _positive_first(terms: Sequence[Expr]) -> Expr:
    """Return the sum of the terms, positive ones first: x p_y - y p_x."""
    return Terms(*sorted(terms, key=lambda term: bool(term.could_extract_minus_sign())))


def _times(derivative: Expr, factor: Expr) -> Expr:
    """Return the product, in which sums are not multiplied out."""
    both = factor != 1 and (factor.is_Add or derivative.is_Add)
    return Factors(factor, derivative) if both else factor * derivative


@in_results(
    "noether",
    "the quantity that is conserved by a symmetry of the Lagrangian",
    of="noether: a Lagrangian",
    values="values: the shift of each coordinate, `{x: -y, y: x}`",
    gained="gained",
    symbol="symbol",
)
def _in_results(
    of: Quantity,
    values: Values,
    key: str,
    coordinates: Mapping[str, Coordinate],
    gained: Value = ZERO,
    symbol: str = "Q",
) -> Quantity:
    strange = next((name for name in values if name not in coordinates), None)
    if strange is not None:
        message = f"`noether` shifts coordinates, but `{strange}` is not a coordinate"
        raise Rejected(Complaint("no-such-coordinate", message, argument=f"values:{strange}"))
    return checked(noether)(of, {coordinates[name]: value for name, value in values.items()}, gained, symbol, key)
