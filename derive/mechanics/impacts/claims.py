"""Predicates of impacts: each decides whether an outcome, or a symbol in the sentence of an outcome, is correct."""

from __future__ import annotations

from typing import Any

from sympy import Add, Expr, Integer, Rational, diff

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit, rate
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.steps.claims import parallel, value_of_role
from derive.steps.rule import Judged, Predicate
from derive.steps.step import is_zero


def is_struck(wanted: bool) -> Predicate:
    """Return a predicate: the power of the impulses must depend on the rate of the coordinate if `wanted`, and must not
    depend on it otherwise."""
    return lambda facts: wanted != is_zero(explicit(facts.inputs["slope"]))


def restitution(wanted: int | None) -> Predicate:
    """Return a predicate: the coefficient of restitution e must have the wanted value; None requires that e is neither
    0 nor 1."""

    def is_so(facts: Judged) -> bool:
        part = facts.inputs["restitution"]
        if wanted is not None:
            return is_zero(part - Integer(wanted))
        return not is_zero(part) and not is_zero(part - 1)

    return is_so


def momentum_of(facts: Judged, q: Any) -> bool:
    """Whether each rate s_dot in the left side of the result has the factor d^2 T/(dq_dot ds_dot), up to a common
    factor."""
    T, there = value_of_role(facts, "kinetic"), dict(facts.inputs["at"])
    moving = facts.quantities["kinetic"].coordinates
    inertia = {s: diff(T, rate(q), rate(s)).subs(there, simultaneous=True) for s in moving}
    return q in moving and parallel({s: diff(explicit(facts.result).left, rate(s)) for s in moving}, inertia)


def impulse_of_its_condition(facts: Judged, letter: Any) -> bool:
    """Whether the rates have the same factors in the power of the impulse and in the condition, up to a common
    factor."""
    power, left = diff(value_of_role(facts, "power"), letter), explicit(facts.result).left
    rates = power.free_symbols | left.free_symbols
    return parallel({v: diff(power, v) for v in rates}, {v: diff(left, v) for v in rates})


Vector = tuple[Expr, ...]


def has_impulse(wanted: bool) -> Predicate:
    """Return a predicate: the sum of the impulses in the law, or of their torques, must be nonzero if `wanted`, and
    zero otherwise."""
    return lambda facts: wanted != is_zero(Add(*facts.inputs["impulses"]))


def about_a_fixed_axis(struck: bool) -> Predicate:
    """Return a predicate: the point of the law must be fixed. If `struck`, the sum of the torques about this point must
    be nonzero. Otherwise it must be zero, and the law must contain all bodies of the system."""

    def is_so(facts: Judged) -> bool:
        fixed = not any(explicit(c).has(*facts.inputs["moving"]) for c in facts.inputs["about"])
        whole = struck or len(facts.inputs["bodies"]) == facts.inputs["count"]
        return fixed and whole and bool(has_impulse(struck)(facts))

    return is_so


def about_the_centre(facts: Judged) -> bool:
    """Whether the point of the law is the centre of mass of its only body."""
    ((_, place, _, _),) = facts.inputs["bodies"]
    return all(is_zero(a - b) for a, b in zip(place, facts.inputs["about"], strict=True))


def coordinate_of_the_body(facts: Judged, q: Any) -> bool:
    """Whether the coordinate moves or rotates the body to which the law applies."""
    values = [*facts.inputs.get("place", ()), facts.inputs.get("angle", Integer(0)), *facts.inputs.get("centre", ())]
    return any(not is_zero(diff(value, q)) for value in values)


def mass_of_the_body(facts: Judged, mass: Any) -> bool:
    return is_zero(mass - facts.inputs["weight"])


def _there(facts: Judged, value: Expr) -> Expr:
    return explicit(value).subs(dict(facts.inputs["at"]), simultaneous=True)


def _velocity(facts: Judged, place: Vector) -> Vector:
    return tuple(by_functions_of_time(c, list(facts.inputs["moving"])) for c in place)


def momentum_of_the_body(facts: Judged, outcome: str) -> bool:
    """Whether the left side is the momentum of the body just after the impact, along the direction of the law."""
    pairs = zip(_velocity(facts, facts.inputs["place"]), facts.inputs["way"], strict=True)
    momentum = facts.inputs["weight"] * Add(*(v * e for v, e in pairs))
    return bool(equal(explicit(facts.result).left, _there(facts, momentum)))


def angular_momentum_of_the_bodies(facts: Judged, outcome: str) -> bool:
    """Whether the left side is the angular momentum of all particles of the bodies about the point just after the
    impact. The direction in which the coordinate rotates its body is positive."""
    whole: Expr = Integer(0)
    for mass, place, spread, angle in facts.inputs["bodies"]:
        (x, y), (u, v) = (a - b for a, b in zip(place, facts.inputs["about"], strict=True)), _velocity(facts, place)
        whole += mass * (x * v - y * u) + spread * by_functions_of_time(angle, list(facts.inputs["moving"]))
    whole, left = _there(facts, whole), explicit(facts.result).left
    turn = diff(facts.inputs["angle"], facts.inputs["coordinate"])
    there = {s: Rational(3 + i, 7) for i, s in enumerate(sorted(turn.free_symbols, key=str))}
    return bool(equal(left, whole if turn.xreplace(there) > 0 else -whole))
