"""What must be true for each word that chooses a sentence about coordinates, potentials and oscillations."""

from __future__ import annotations

from collections.abc import Callable

from sympy import Expr, diff

from derive.algebra.expressions import Partial, Relation, Slope, explicit
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.mechanics.outcomes.signs import always_sign, lasts, sign_where_it_exists, vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of, told_by
from derive.steps.record import assumed, assumed_in_words
from derive.steps.step import is_zero


def _cyclic(facts: Judged) -> bool:
    return is_zero(slope(explicit(facts.inputs["lagrangian"]), facts.inputs["coordinate"]))


def _not_cyclic(facts: Judged) -> bool:
    return not _cyclic(facts)


def _by_its_coordinate(facts: Judged, outcome: str) -> bool:
    """The derivative is by the coordinate that the sentence names."""
    return isinstance(facts.symbol, Partial) and facts.symbol.args[1] == facts.inputs["coordinate"]


def _order_of(*orders: int, more: bool = False) -> Predicate:
    def is_so(facts: Judged) -> bool:
        symbol = facts.symbol
        order = int(symbol.args[2]) if isinstance(symbol, Slope) else 0
        return order > max(orders) if more else order in orders

    return is_so


def _shaped(shape: str, at_bound: bool) -> Predicate:
    """The first derivative that does not vanish, by differentiation where the verb expands in a series."""

    def is_so(facts: Judged) -> bool:
        q, place = facts.inputs["coordinate"], facts.inputs["place"]
        level = is_zero(diff(facts.result, q, 2).subs(q, place))
        if at_bound != ("case" in facts.inputs) or at_bound and not level:
            return False
        for n in range(2, 9):
            there = tidied(diff(facts.result, q, n).subs(q, place))
            if not is_zero(there):
                return shape == _shape_by(n, there)
        return shape == "flat"

    return is_so


def _shape_by(order: int, derivative: Expr) -> str:
    if order % 2:
        return "inflection"
    return "minimum" if derivative.is_positive else "maximum" if derivative.is_negative else "conditional"


def _of_square(sign: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.inputs["squared"]) -> Predicate:
    """In numbers, where the state of rest exists; that it vanishes or is of no known sign, by the letters."""
    return sign_where_it_exists(sign, of) if sign else always_sign(sign, of)


def _rate_of_square(sign: int | None, turned: int) -> Predicate:
    """An oscillation has the root of the square as its rate, a motion that grows the root of minus the square."""
    judged = _of_square(sign)
    return lambda facts: judged(facts) and is_zero(explicit(facts.result) ** 2 - turned * facts.inputs["squared"])


def _bent(sign: int | None) -> Predicate:
    """The second derivative at the place, by differentiation of the value that was put there."""

    def curvature(facts: Judged) -> Expr:
        q, at = facts.inputs["coordinate"], facts.inputs["at"]
        return diff(explicit(facts.inputs["potential"]), q, 2).subs(q, at)

    return always_sign(sign, curvature)


_SIGNS = {
    word: _of_square(sign, lambda facts: facts.result)
    for word, sign in (("stable", 1), ("unstable", -1), ("neutral", 0), ("conditional", None))
}


def _free_bodies(facts: Judged) -> int:
    return sum(not placed.is_held for placed in facts.subject.body.bodies)


def _on_the_sides_that_are_assumed(facts: Judged) -> bool:
    """Of a distance |u| the page takes u only where it assumes u > 0."""
    sides = [Relation(u, ">", 0) for u in facts.inputs["branches"]]
    of_springs = any(side in assumed_in_words() for side in sides)
    return lasts(facts) and set(sides) <= set(assumed()) and of_springs == (facts.words["seen"] == "stretched")


_TABLE: dict[str, dict[str, Predicate]] = {
    "kinematics.rate_of": {"generic": lasts, "zero": vanishes},
    "lagrange.squared_speed": {
        "alone": lambda facts: len(facts.subject.body.particles) == 1 and _free_bodies(facts) == 0,
        "centre": lambda facts: not facts.subject.body.particles and _free_bodies(facts) <= 1,
        "of_several": lambda facts: len(facts.subject.body.masses) > 1,
    },
    "lagrange.potential_energy": {"generic": _on_the_sides_that_are_assumed, "zero": vanishes},
    "lagrange.magnetic_term": {
        "alone": lambda facts: facts.inputs["fields"] == 1,
        "several": lambda facts: facts.inputs["fields"] > 1,
    },
    "lagrange.lagrangian": {
        "generic": lambda facts: "magnetic" not in facts.inputs,
        "in_field": lambda facts: "magnetic" in facts.inputs,
    },
    "lagrange.generalized_force": {"generic": lasts, "zero": vanishes},
    "lagrange.equation_of_motion": {"generic": _not_cyclic, "cyclic": _cyclic},
    "vibrations.frequency_squared": _SIGNS,
    "vibrations.frequency": {
        "stable": _rate_of_square(1, 1),
        "unstable": _rate_of_square(-1, -1),
        "neutral": _rate_of_square(0, 1),
        "conditional": _rate_of_square(None, 1),
        "growing": _rate_of_square(None, -1),
    },
    "rest.slope": {"slope": _order_of(1), "curvature": _order_of(2), "higher": _order_of(2, more=True)},
    "rest.extreme_value": {
        "minimum": _bent(1),
        "maximum": _bent(-1),
        "level": _bent(0),
        "conditional": _bent(None),
    },
    "rest.leading_order": {
        **{
            shape: _shaped(shape, at_bound=False)
            for shape in ("minimum", "maximum", "inflection", "conditional", "flat")
        },
        **{
            f"{shape}_at_bound": _shaped(shape, at_bound=True)
            for shape in ("minimum", "maximum", "inflection", "conditional", "flat")
        },
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)

told_by("lagrange.generalized_force", _by_its_coordinate)
