"""Stability of an equilibrium: whether the potential energy has a minimum at the equilibrium, and for which values of
the symbols.

For one coordinate the curvature decides; on the boundary of stability the next nonzero order decides. For several
coordinates the leading minors of the second derivatives decide (Sylvester's criterion).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol
from sympy.matrices import MatrixBase

from derive.algebra.amplitudes import Amplitudes, Determinant
from derive.algebra.collect import spread_or_by_terms
from derive.algebra.definite import sign_of_form
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import At, Relation, Slope, explicit, rate, scalar, stand_in
from derive.algebra.taylor import coefficient_along, series_along
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.hamilton.facts import SeenWith
from derive.mechanics.rest import claims
from derive.mechanics.rest.both_sides import on_known_sides
from derive.mechanics.rest.constrained_stability import OnConstraints, constraints_of
from derive.mechanics.rest.equilibria import all_matter, place_given, potential_at_rest, slope_otherwise, steady_in
from derive.mechanics.rest.facts import Shape, StableWhere, matter_behind
from derive.mechanics.rest.mass_matrix import check_regular, has_positive_inertia
from derive.mechanics.rest.potentials import slope
from derive.solving.relations import border_of, positive
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import require_constant
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.signs import sign_for_all, sign_where
from derive.steps.step import Fact, Form, Level, Quantity, is_zero, require_kind
from derive.witness.facts import Rest

__all__ = ["stability"]

HIGHEST = 8  # the highest order of the energy that is tried where the curvature vanishes
FEW = 5  # largest number of coordinates for which directions with entries 0, 1 and -1 are tried
SHORT = 80  # largest number of operations in a curvature that is shown before the equilibrium is substituted
ZERO = Integer(0)
SOURCE = (
    "Taylor, *Classical Mechanics*, section 4.6 and example 7.6; Goldstein, Poole, Safko, *Classical Mechanics*, "
    "section 6.1"
)
BY_FIRST_ORDER = Spelled(
    "decide with the equations of motion to first order: `linear_stability(linearised(motion))`", "ask for `linearised`"
)
STEADY = Spelled(
    "`steady_motion` finds a steady motion there, and `frequency_squared_about` determines its stability",
    "such a motion is steady: under `results`, `steady` gives the condition and `frequency` the stability",
)


@dataclass(frozen=True)
class Place:
    """An equilibrium whose stability is judged: a potential energy, its coordinates, and their values.

    exists   the condition under which the equilibrium exists; None if there is no condition
    rest     the step that found the equilibrium; None if the values are given
    """

    potential: Quantity
    coordinates: tuple[Symbol, ...]
    values: Mapping[Symbol, Expr]
    exists: Relation | None
    rest: Quantity | None

    @property
    def energy(self) -> Expr:
        return explicit(self.potential.value)

    def second(self, one: Symbol, other: Symbol) -> Expr:
        return tidied(on_known_sides(derivative(self.energy, one, other).xreplace(dict(self.values)), self.exists))


def stability(
    of: Quantity, at: Quantity | Mapping[Any, Expr], letter: Expr | None = None, key: str | None = None
) -> Quantity:
    """Stability of an equilibrium, from U''(q_0) > 0, or from the leading minors of the second derivatives of U.

    of       the potential energy, an effective potential energy, or the Lagrangian, J
    at       the equilibrium: as `equilibria` yields it, or `{theta: 0}`
    letter   the symbol that a condition is solved for, if possible; by default the symbol that occurs as a square, if
             there is exactly one such symbol

    Second route: the restoring force for a small displacement, from virtual work if mass points and forces are known.
    Check for several coordinates: the energy of a small displacement in an arbitrary direction.
    Outcomes: stable, unstable, depends (on the stated condition), depends_stable_on_border,
    depends_unstable_on_border, stable_by_higher_order, unstable_by_higher_order, flat (no order up to the eighth
    decides); for several coordinates also: unstable_along (the energy falls in a stated direction), level (to second
    order the energy is constant in some direction, and falls in none).
    Errors: a force remains at the equilibrium; coordinates are missing; the kinetic energy may be negative; the energy
    has no minimum, but forces linear in the rates may still stabilise the equilibrium, as in a rotating frame or a
    magnetic field.
    Source: Taylor, *Classical Mechanics*, section 4.6 and example 7.6; Goldstein, Poole, Safko, *Classical Mechanics*,
    section 6.1.
    """
    require_kind("stability", "of", of, "energy")
    held = constraints_of(of)
    if held:
        potential, values = _potential(of, at), place_given(at)
        found = OnConstraints(potential, held, values).stability(key or "stability")
        _check_nothing_else_holds_it(Place(potential, tuple(values), values, None, None), found.step.outcome)
        return found
    place = _place(of, at)
    named = key or ("stability" if place.rest is None else place.rest.key.replace("rest", "stability"))
    if len(place.coordinates) > 1:
        return _of_several(place, named)
    return _of_one(place, letter, named)


def _state(place: Place) -> Relation:
    """Return the equilibrium as an equation, coordinate = value. For one coordinate, the right side is the
    symbol of the equilibrium if a step found it, otherwise the value."""
    if len(place.coordinates) == 1:
        (q,) = place.coordinates
        named = place.values[q] if place.rest is None else place.rest.symbol
        return Relation(q, "=", named if isinstance(named, Expr) else place.values[q])
    return Relation(Amplitudes(*place.coordinates), "=", Amplitudes(*(place.values[q] for q in place.coordinates)))


def _place(of: Quantity, at: Quantity | Mapping[Any, Expr]) -> Place:
    known = place_given(at)
    rest, potential = at if isinstance(at, Quantity) else None, _potential(of, at)
    if rest is not None and not (of.step == potential.step or potential.rests_on(of)):
        raise Rejected(Complaint("different-subjects", f"`{rest.key}` is not an equilibrium of `{of.key}`"))
    held = tuple(q for q in potential.coordinates if explicit(potential.value).has(q))
    slopes = {q: derivative(explicit(potential.value), q).xreplace(known) for q in held}
    missing = [q for q in held if q not in known and not all(is_zero(slope) for slope in slopes.values())]
    if missing:
        message = f"`stability`: the value of {missing[0].name} at equilibrium is unknown"
        raise Rejected(
            Complaint("wrong-argument", message, help=f"add the value to `at`, such as `{missing[0].name}: 0`")
        )
    values = {q: value for q, value in known.items() if q in held}
    place = Place(potential, tuple(values), values, rest.needed(Rest).exists if rest else None, rest)
    check_regular("stability", all_matter(potential), values)
    _check_level(place)
    return place


def _potential(of: Quantity, at: Quantity | Mapping[Any, Expr]) -> Quantity:
    """Return the potential energy from which an equilibrium was found; for given values, use `potential_at_rest`."""
    if not isinstance(at, Quantity):
        return potential_at_rest(of)
    return next((parent for parent in at.parents if parent.step.kind == "energy"), of)


def _check_level(place: Place) -> None:
    if not place.coordinates:
        raise Rejected(Complaint("wrong-argument", f"`{place.potential.key}` depends on none of these coordinates"))
    for q, value in place.values.items():
        require_constant("stability", "value", value)
        force = tidied(on_known_sides(derivative(place.energy, q).xreplace(dict(place.values)), place.exists))
        if not is_zero(force):
            where = ", ".join(f"{s} = {v}" for s, v in place.values.items())
            message = (
                f"`{place.potential.key}` is not stationary at {where}: its derivative with respect to {q} is {force}"
            )
            steady = place.potential.fact(SeenWith)
            help_line = STEADY if steady is not None and steady.constants else "`equilibria` finds the equilibria"
            raise Rejected(Complaint("no-equilibrium", message, help=help_line))


# --- one coordinate --------------------------------------------------------------------------------------------------


STABILITY = Rule(
    "rest.stability",
    source=SOURCE,
    outcomes={
        "stable": claims.both(claims.always(1), claims.kinetic_energy_is_positive),
        "unstable": claims.both(claims.always(-1), claims.runs_away),
        "stable_by_higher_order": claims.both(claims.higher("stable"), claims.higher_lasts),
        "unstable_by_higher_order": claims.both(
            claims.higher("unstable"), claims.nothing_turns_it, claims.higher_lasts
        ),
        "flat": claims.both(claims.undecided, claims.nothing_turns_it),
        "depends": claims.both(claims.depends(None), claims.runs_away),
        "depends_stable_on_border": claims.both(claims.depends("stable"), claims.runs_away, claims.higher_lasts),
        "depends_unstable_on_border": claims.both(claims.depends("unstable"), claims.runs_away, claims.higher_lasts),
    },
    evidence={"small_force": ROUTE},
    statements=[claims.steady_as_its_potential],
    named={
        "steady": claims.only_coordinate,
        "place": claims.level_there("potential_here"),
        "state": claims.at_its_place,
    },
    shown=Shown(
        verdicts=frozenset(
            ("stable", "unstable", "stable_by_higher_order", "unstable_by_higher_order", "flat", "depends")
            + ("depends_stable_on_border", "depends_unstable_on_border")
        )
    ),
)


def _of_one(place: Place, letter: Expr | None, key: str) -> Quantity:
    """Curvature of the potential energy at an equilibrium.

    Outcomes: stable, unstable, depends, depends_stable_on_border, depends_unstable_on_border, stable_by_higher_order,
    unstable_by_higher_order, flat.
    Source: the same as for `stability`.
    """
    (q,), potential = place.coordinates, place.potential
    value = place.second(q, q)
    outcome, condition, border = _judged(place, value, letter)
    _check_nothing_else_holds_it(place, outcome)
    told: dict[str, tuple[Any, Any]] = {}
    named: dict[str, Any] = {"state": _state(place), **steady_in(potential, [q])}
    anywhere = derivative(place.energy, q, 2)
    is_short = anywhere.has(q) and int(anywhere.count_ops()) <= SHORT  # a constant is shown once, at the equilibrium
    level = [slope(potential, by=q)] if place.rest is None and is_short else []
    if level:
        named["place"] = Relation(q, "=", place.values[q])
    if condition is not None:
        told["condition"] = (condition, Relation(value, ">", 0))
    if place.exists is not None:
        told["exists"] = (place.exists, Relation(-place.exists.right, place.exists.operator, -place.exists.left))
    if border is not None and condition is not None:
        told["border"] = (
            Relation(condition.left, "=", condition.right),
            Relation(value, "=", 0),
        )
    order = _order(place.energy.subs(border.left, border.right) if border is not None else place.energy, place)
    is_open = outcome == "flat" and order > 0  # there is a nonzero derivative of unknown sign
    if outcome.endswith("order") or border is not None or is_open:
        energy = place.energy.subs(border.left, border.right) if border is not None else place.energy
        there = tidied(derivative(energy, q, order).xreplace({q: place.values[q]}))
        told["higher"] = (there, _coefficient(energy, q, place.values[q], order))
    return establish(
        STABILITY,
        At(Slope(potential.symbol, q, Integer(2)), q, place.values[q] if place.rest is None else place.rest.symbol),
        lambda second, at: At(second if is_short else Slope(second, q, Integer(2)), q, at),
        {
            "curvature": slope(potential, 2, by=q) if is_short else potential,
            "at": place.rest if place.rest is not None else place.values[q],
        },
        lines=Lines(put_in=None, law=Level.FULL, arranged=lambda _: spread_or_by_terms(value)),
        routes={"small_force": lambda found: (found, _small_force(place, q))},
        outcome=outcome,
        phrase_data=PhraseData(
            points_to={"potential": potential},
            formulas=told,
            named=named,
            outcome_data={
                "coordinates": place.coordinates,
                "place": tuple(place.values.values()),
                "potential_here": place.energy,
                **({"at_border": border} if border is not None else {}),
            },
        ),
        key=key,
        parents=[*level, potential],
        facts=[Shape(potential, q, place.values[q], border), *_decided_where(place, q, condition, border, outcome)],
    )


def _decided_where(
    place: Place, q: Symbol, condition: Relation | None, border: Relation | None, outcome: str
) -> list[Fact]:
    if condition is None:
        return []
    there = {"depends_stable_on_border": True, "depends_unstable_on_border": False}.get(outcome)
    return [StableWhere(place.energy, q, place.values[q], condition, border, there)]


def _judged(place: Place, value: Expr, letter: Expr | None) -> tuple[str, Relation | None, Relation | None]:
    """Return the outcome, the condition for stability, and the value of a symbol on the boundary of this condition.

    The condition is None if the stability does not depend on a condition. The value is None unless a higher order
    decides on the boundary.
    """
    if is_zero(value):
        return _by_higher_order(place, place.energy), None, None
    sign = sign_where(value, place.exists)
    if sign is not None:
        return ("stable" if sign > 0 else "unstable"), None, None
    condition = positive(value, *([letter] if isinstance(letter, Symbol) else []))
    border = border_of(condition)
    if border is None:
        return "depends", condition, None
    there = _by_higher_order(place, place.energy.subs(border.left, border.right))
    words = {
        "stable_by_higher_order": "depends_stable_on_border",
        "unstable_by_higher_order": "depends_unstable_on_border",
    }
    return words.get(there, "depends"), condition, border if there in words else None


def _order(energy: Expr, place: Place) -> int:
    """Return the lowest order, from the second to the eighth, that does not vanish at the equilibrium; 0 if all
    vanish."""
    (q,) = place.coordinates
    terms = series_along(energy, {q: place.values[q]}, {q: Integer(1)}, HIGHEST)
    return next((n for n in range(2, HIGHEST + 1) if not is_zero(terms[n])), 0)


def _by_higher_order(place: Place, energy: Expr) -> str:
    (q,) = place.coordinates
    order = _order(energy, place)
    if order == 0:
        return "flat"
    sign = sign_for_all(tidied(derivative(energy, q, order).xreplace({q: place.values[q]})))
    if order % 2 or sign == -1:
        return "unstable_by_higher_order"
    return "stable_by_higher_order" if sign == 1 else "flat"


def _coefficient(energy: Expr, q: Symbol, at: Expr, order: int) -> Expr:
    from sympy import factorial

    return factorial(order) * coefficient_along(energy, {q: at}, {q: Integer(1)}, order)


def _small_force(place: Place, q: Symbol) -> Expr:
    if matter_behind(place.potential) is not None:
        force = slope_otherwise(place.potential, q)
        return coefficient_along(force, place.values, {s: Integer(s == q) for s in place.values}, 1)
    return _coefficient(place.energy, q, place.values[q], 2)


# --- several ---------------------------------------------------------------------------------------------------------


STABILITY_OF_SEVERAL = Rule(
    "rest.stability_of_several",
    source=SOURCE,
    outcomes={
        "stable": claims.both(claims.always(1), claims.kinetic_energy_is_positive),
        "unstable": claims.both(claims.always(-1), claims.runs_away),
        "unstable_along": claims.both(claims.always(-1), claims.runs_away, claims.falls_as_told),
        "level": claims.both(claims.always(0), claims.nothing_turns_it),
        "depends": claims.stability_of_several_depends,
    },
    evidence={"any_direction": CHECK},
    statements=[claims.about_an_energy],
    named={"state": claims.at_its_place, "moving": claims.falls_along, "direction": claims.falls_along},
    shown=Shown(verdicts=frozenset(("stable", "unstable", "unstable_along", "level", "depends"))),
)


def _of_several(place: Place, key: str) -> Quantity:
    """Leading minors of the second derivatives, which are all positive at a minimum.

    Outcomes: stable, unstable, unstable_along (a stated direction), level, depends.
    Source: the same as for `stability`.
    """
    moving = place.coordinates
    matrix = ImmutableDenseMatrix([[place.second(p, q) for q in moving] for p in moving])
    minors = [_minor(matrix, n) for n in range(1, len(moving) + 1)]
    values = [tidied(explicit(minor)) for minor in minors]
    letters = ImmutableDenseMatrix([scalar(f"D_{n}") for n in range(1, len(moving) + 1)])
    outcome = _of_minors(matrix, values)
    told: dict[str, tuple[Any, Any]] = {}
    named: dict[str, Any] = {"state": _state(place)}
    way = _way_down(matrix) if outcome == "depends" else None
    if outcome == "unstable" and not any(sign_for_all(value) == -1 for value in values):
        way = _plain_way_down(matrix, [place.potential.coordinates[q] for q in moving])
    if way is not None:
        outcome = "unstable_along"
        told |= _falling(place, matrix, way)
        named |= {"moving": Amplitudes(*place.coordinates), "direction": Amplitudes(*way)}
    _check_nothing_else_holds_it(place, outcome)
    if place.exists is not None:
        told["exists"] = (place.exists, Relation(-place.exists.right, place.exists.operator, -place.exists.left))

    def in_any_direction(found: MatrixBase) -> tuple[MatrixBase, MatrixBase]:
        """Compare these minors with those from the second-order energy of an arbitrary displacement."""
        marks = {q: stand_in(f"u_{q.name}") for q in moving}
        energy = coefficient_along(place.energy, place.values, marks, 2).expand()
        second = ImmutableDenseMatrix([[derivative(energy, marks[p], marks[q]) for q in moving] for p in moving])
        return found, ImmutableDenseMatrix([second[:n, :n].det(method="laplace") for n in range(1, len(moving) + 1)])

    return establish(
        STABILITY_OF_SEVERAL,
        letters,
        lambda *_: Amplitudes(*minors),
        {"potential": place.potential, "at": place.rest or Integer(0)},
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            after=[Form(Amplitudes(*values), "result")],
            result=False,
            arranged=lambda _: ImmutableDenseMatrix(values),
        ),
        routes={"any_direction": in_any_direction},
        outcome=outcome,
        phrase_data=PhraseData(
            formulas=told,
            named=named,
            outcome_data={
                "coordinates": moving,
                "place": tuple(place.values.values()),
                "potential_here": place.energy,
            },
        ),
        key=key,
        parents=[place.potential],
    )


def _minor(matrix: MatrixBase, n: int) -> Expr:
    return matrix[0, 0] if n == 1 else Determinant(ImmutableDenseMatrix(matrix[:n, :n]))


def _of_minors(matrix: MatrixBase, minors: list[Expr]) -> str:
    if all(sign_for_all(value) == 1 for value in minors):
        return "stable"
    return {1: "stable", 0: "level", -1: "unstable", None: "depends"}[sign_of_form(matrix, sign_for_all)]


def _way_down(matrix: MatrixBase) -> MatrixBase | None:
    """Return a direction in which the energy falls for all values of the symbols; None if no such direction is found.

    The direction is a null vector of the part of the matrix that is proportional to one symbol.
    """
    for letter in sorted(matrix.free_symbols, key=str):
        share = matrix.applyfunc(lambda entry, s=letter: tidied(derivative(entry, s)))
        if share.has(letter):
            continue
        for column in share.nullspace(iszerofunc=is_zero):
            way = ImmutableDenseMatrix(column.applyfunc(tidied))
            if sign_for_all(tidied((way.T * matrix * way)[0])) == -1:
                return way
    return None


def _plain_way_down(matrix: MatrixBase, kinds: Sequence[str]) -> MatrixBase | None:
    """Return a direction with entries 0, 1 and -1 in which the energy falls; None if no such direction is found.

    kinds   the kinds of the coordinates; only coordinates of the same kind are displaced together
    """
    size = matrix.shape[0]
    ways = product((0, 1, -1), repeat=size) if size <= FEW else ()
    for way in sorted(ways, key=lambda each: (sum(map(abs, each)), [-n for n in each])):
        if len({kind for kind, n in zip(kinds, way, strict=True) if n}) == 1:
            column = ImmutableDenseMatrix(way)
            if sign_for_all(tidied((column.T * matrix * column)[0])) == -1:
                return column
    return None


def _falling(place: Place, matrix: MatrixBase, way: MatrixBase) -> dict[str, tuple[Any, Any]]:
    """Return two formulas for the second derivative of the energy along the direction: from the matrix, and from the
    energy."""
    along = coefficient_along(place.energy, place.values, dict(zip(place.coordinates, way, strict=True)), 2)
    return {
        "falling": (tidied((way.T * matrix * way)[0]), 2 * along),
    }


def _check_nothing_else_holds_it(place: Place, outcome: str) -> None:
    """Reject an equilibrium whose stability the potential energy alone does not decide.

    The kinetic energy may be negative, or gyroscopic forces may stabilise an equilibrium at which U has no minimum, as
    for a spinning top.
    """
    matter = all_matter(place.potential)
    if matter is not None and not has_positive_inertia(matter, place.values):
        message = "`stability`: the kinetic energy is not positive for every motion, "
        message += f"so a minimum of `{place.potential.key}` need not be stable"
        raise Rejected(Complaint("not-decided", message, help=BY_FIRST_ORDER))
    if outcome.startswith("stable") or matter is None:
        return
    still = {rate(q, n): ZERO for q in matter.coordinates for n in (1, 2)}
    for p, q in ((p, q) for p in place.coordinates for q in matter.coordinates if p != q):
        turned = derivative(matter.momentum_along(p), q) - derivative(matter.momentum_along(q), p)
        turned += derivative(matter.other_force_along(p), rate(q)) - derivative(matter.other_force_along(q), rate(p))
        if not is_zero(turned.xreplace(still).xreplace(dict(place.values))):
            message = f"`stability`: `{place.potential.key}` need not have a minimum at the equilibrium, but"
            message += f" forces linear in the rates of {q.name} and {p.name} may stabilise the equilibrium"
            raise Rejected(Complaint("not-decided", message, help=BY_FIRST_ORDER))
