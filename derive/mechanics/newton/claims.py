"""Predicates of Newton's laws: each judges whether an outcome, or a statement in its sentence, is correct."""

from __future__ import annotations

from typing import Any

from sympy import Add, Expr, Integer, diff

from derive.algebra.equality import equal
from derive.algebra.expressions import depends_on_time, explicit, rate
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.steps.claims import both as both
from derive.steps.rule import Judged, Predicate
from derive.steps.step import is_zero
from derive.steps.trial_numbers import sign_found

Vector = tuple[Expr, ...]
SIDEWAYS = {"to_the_right": 1, "to_the_left": -1}
VERTICAL = {"upwards": 1, "downwards": -1}
SLOPES = {"up_the_slope": 1, "down_the_slope": -1}


def of_masses(several: bool, alike: bool = False) -> Predicate:
    """Return a predicate that is true if both of these flags agree with the masses of the system.

    several   whether the system has several masses
    alike     whether another mass equals the mass of the body in the law
    """

    def is_so(facts: Judged) -> bool:
        masses = facts.inputs["masses"]
        same = [each for each in masses if is_zero(each - facts.inputs["weight"])]
        return (len(masses) > 1, len(same) > 1) == (several, alike)

    return is_so


def at_rest(wanted: bool) -> Predicate:
    """Return a predicate: the left side of the equation must be zero if `wanted`, as for bodies at rest, and nonzero
    otherwise."""
    return lambda facts: is_zero(explicit(facts.result).left) == wanted


def mass_of_the_body(facts: Judged, mass: Any) -> bool:
    return is_zero(mass - facts.inputs["weight"])


def coordinate_of_the_law(facts: Judged, q: Any) -> bool:
    """Whether the coordinate moves or rotates the body."""
    turn = diff(facts.inputs.get("angle", Integer(0)), q)
    return any(not is_zero(c) for c in (*_way(facts, q), turn))


def _way(facts: Judged, q: Any = None) -> Vector:
    return tuple(explicit(diff(c, q or facts.inputs["coordinate"])) for c in facts.inputs["place"])


def _positive(value: Expr) -> bool:
    return sign_found(value) == 1


def _dot(a: Vector, b: Vector) -> Expr:
    return Add(*(x * y for x, y in zip(a, b, strict=True)))


def _cross(a: Vector, b: Vector) -> Expr:
    return a[0] * b[1] - a[1] * b[0]


def _are_parallel(a: Vector, b: Vector) -> bool:
    return is_zero(_dot(a, a) * _dot(b, b) - _dot(a, b) ** 2)


def _is_fixed(place: Vector, moving: Any) -> bool:
    return not any(explicit(c).has(*moving) or depends_on_time(c) for c in place)


def mass_times_acceleration(facts: Judged, outcome: str) -> bool:
    """Whether the left side is the mass times the component of the acceleration along the displacement of the
    coordinate. For a body at rest, the left side and this product must be zero."""
    way, moving = _way(facts), list(facts.inputs["moving"])
    along = facts.inputs["weight"] * _dot(way, _acceleration(facts))
    left = explicit(facts.result).left
    if outcome.endswith("at_rest"):
        return is_zero(left) and is_zero(_still(along, moving))
    return bool(equal(left**2 * _dot(way, way), along**2)) and (is_zero(along) or _positive(left * along))


def _acceleration(facts: Judged) -> Vector:
    moving = list(facts.inputs["moving"])
    return tuple(by_functions_of_time(c, moving, 2) for c in facts.inputs["place"])


def _still(value: Expr, moving: Any) -> Expr:
    return explicit(value).xreplace({rate(q, n): Integer(0) for q in moving for n in (1, 2)})


def rate_of_angular_momentum(facts: Judged, outcome: str) -> bool:
    """Whether the left side is the rate of change of the body's angular momentum about the point. This rate is the sum
    of m r x a over the particles of the body. The direction in which the coordinate rotates the body is positive.
    """
    moving, angle = list(facts.inputs["moving"]), facts.inputs["angle"]
    arm = tuple(a - b for a, b in zip(facts.inputs["place"], facts.inputs["about"], strict=True))
    whole = facts.inputs["weight"] * _cross(arm, _acceleration(facts))
    whole += facts.inputs["spread"] * by_functions_of_time(angle, moving, 2)
    turn, left = diff(angle, facts.inputs["coordinate"]), explicit(facts.result).left
    if outcome.endswith("at_rest"):
        return is_zero(left) and is_zero(_still(whole, moving))
    if facts.words["term"] == "alone":
        moment = facts.inputs["spread"] + facts.inputs["weight"] * _dot(arm, arm)
        whole = moment * by_functions_of_time(angle, moving, 2)
    return is_zero(left - whole) if _positive(turn) else is_zero(left + whole)


def point_of_the_torques(facts: Judged, outcome: str) -> bool:
    """Whether the point is what the sentence calls it: a centre of mass, a fixed axis, a point of contact, or a point
    where constraint forces act."""
    word, about, place = facts.words["where"], facts.inputs["about"], facts.inputs["place"]
    if word == "centre_of_mass":
        return all(is_zero(a - b) for a, b in zip(about, place, strict=True))
    if word == "axis":
        return _is_fixed(about, facts.inputs["moving"])
    if word == "contact" and _is_at_rest(facts, about):
        return True
    return word in ("contact", "point") and any(letter is not None for letter in _letters_at(facts, about))


def _letters_at(facts: Judged, place: Vector) -> list[Any]:
    """The symbols of the forces that act at a place, and None for each known force that acts at this place."""
    forces = facts.inputs["forces"]
    return [letter for at, letter in forces if all(is_zero(a - b) for a, b in zip(at, place, strict=True))]


def force_at_the_point(facts: Judged, letter: Any) -> bool:
    return letter in _letters_at(facts, facts.inputs["about"])


def _is_at_rest(facts: Judged, about: Vector) -> bool:
    """Whether the point of the body at this place is at rest in every motion that the coordinates allow."""
    for q in facts.inputs["moving"]:
        (dx, dy), turn = _way(facts, q), diff(facts.inputs["angle"], q)
        x, y = (a - b for a, b in zip(about, facts.inputs["place"], strict=True))
        if not is_zero(dx - turn * y) or not is_zero(dy + turn * x):
            return False
    return True


def direction(facts: Judged, outcome: str) -> bool:
    """Whether the displacement of the coordinate has the direction that the sentence names."""
    word, way, moving = facts.words["way"], _way(facts), facts.inputs["moving"]
    if word in VERTICAL:
        return all(is_zero(c) for c in way[:-1]) and _positive(VERTICAL[word] * way[-1])
    if word in SIDEWAYS:
        return len(way) == 2 and is_zero(way[1]) and _positive(SIDEWAYS[word] * way[0])
    if word in SLOPES:
        on_slope = any(is_zero(_dot(normal, way)) for normal in facts.inputs["normals"])
        return _is_fixed(way, moving) and on_slope and _positive(SLOPES[word] * way[-1])
    if word == "away_from_the_slope":
        across = [n for n in facts.inputs["normals"] if _are_parallel(n, way)]
        return _is_fixed(way, moving) and any(_positive(_dot(n, way)) for n in across)
    if word in ("outwards", "along_the_tangent"):
        centre = facts.inputs["centre"]
        arm = tuple(a - b for a, b in zip(facts.inputs["place"], centre, strict=True))
        if not _is_fixed(centre, moving):
            return False
        if word == "along_the_tangent":
            return is_zero(_dot(arm, way))
        return _are_parallel(arm, way) and _positive(_dot(arm, way))
    return word == "increasing"


def no_constraint_force(facts: Judged) -> bool:
    return not facts.inputs["letters"]


def constraint_forces_do_no_work(facts: Judged) -> bool:
    """Whether constraint forces act, and each condition on the velocities is satisfied at rest and does not contain the
    time. If such a condition is linear in the rates, the force of this constraint has no power for any velocities that
    the constraint allows."""
    still = dict.fromkeys(facts.inputs["rates"], Integer(0))
    conditions = [explicit(each) for each in facts.inputs["velocities"]]
    homogeneous = all(is_zero(each.xreplace(still)) and not depends_on_time(each) for each in conditions)
    return bool(facts.inputs["letters"]) and homogeneous


def rate_of_the_energy(facts: Judged, outcome: str) -> bool:
    """Whether the rate that the sentence states is the rate of the coordinate times the left side of the equation."""
    told, left = explicit(facts.inputs["rate"]), explicit(facts.result).left
    return is_zero(told - rate(facts.inputs["coordinate"]) * left)


def same_as_one(facts: Judged) -> bool:
    return "lagrange_2" not in facts.quantities and same_equation(facts)


def same_as_several(facts: Judged) -> bool:
    return "lagrange_2" in facts.quantities and same_equation(facts)


def same_equation(facts: Judged) -> bool:
    """Whether the law of one body and the result are the same equation, up to a factor without rates."""
    law, found = (explicit(each).residual for each in (facts.quantities["newton"].value, facts.result))
    rates = {rate(q, n) for each in facts.quantities.values() for q in each.coordinates for n in (1, 2)}
    letters = sorted(law.free_symbols & found.free_symbols, key=lambda s: (not s.name.endswith("_ddot"), s.name))
    for letter in letters:
        slopes = [diff(each, letter) for each in (law, found)]
        if not any(is_zero(slope) or slope.has(letter) for slope in slopes):
            factor = slopes[1] / slopes[0]
            return is_zero(found - factor * law) and not factor.free_symbols & rates
    return False
