"""Euler's law for the rotation of one body in a plane: about its centre of mass, a fixed axis or a point of contact."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.collect import by_accelerations
from derive.algebra.expressions import Factors, Relation, Terms, depends_on_time, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.model.rigid import inertia_of, is_about_the_point
from derive.mechanics.model.system import System
from derive.mechanics.newton import claims
from derive.mechanics.newton.alone import ZERO, Alone, Vector, body_of, changes_alone, dot, is_free
from derive.mechanics.newton.by_lagrange import facts_of_motion, lagrangian_behind, virtual_work
from derive.mechanics.newton.second_law import at_rest_in, data_of, forces_in, sum_of, which_of_several
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import coordinates_in
from derive.steps.rule import ROUTE, Rule
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, compared_with, is_zero

__all__ = ["torque_law"]


@dataclass(frozen=True)
class About:
    """A point about which torques are taken.

    word   "axis" (fixed), "centre_of_mass", "contact", or "point" (where several unknown forces act, at rest)
    place  its place
    """

    word: str
    place: Vector


TORQUE_LAW = Rule(
    "newton.torque_law",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, sections 7.5 to 7.7",
    outcomes={
        f"{outcome}{suffix}": claims.both(claims.of_masses(several, alike), claims.at_rest(suffix == "_at_rest"))
        for outcome, several, alike in (("alone", False, False), ("of_several", True, False), ("alike", True, True))
        for suffix in ("", "_at_rest")
    },
    evidence={"lagrange": ROUTE},
    statements=[claims.rate_of_angular_momentum, claims.point_of_the_torques],
    named={"mass": claims.mass_of_the_body, "coordinate": claims.coordinate_of_the_law},
)


def torque_law(
    system: System, q: Coordinate, key: str | None = None, about: str = "", at_rest: bool = False
) -> Quantity:
    """Sum of the torques on the body that rotates with a coordinate, I alpha = sum of tau, in the sense in which the
    coordinate increases.

    system   particles and bodies in a plane, and the forces on them
    q        a coordinate that rotates one body
    about    "contact" for torques about a point of contact, where the rate of change of the angular momentum also has the
             term of the centre of mass; by default the fixed axis of the body, or else its centre of mass
    at_rest  whether the system is at rest, so that the torques add up to zero; they are then taken about the point at
             which most of the unknown forces act
    Second route: Lagrange's equations, for the rotation of this body alone.
    Outcomes: alone, of_several, alike, as `second_law`.
    Errors: the system moves in space; no body can rotate alone; a force without a letter has a torque.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, sections 7.5 to 7.7.
    """
    body = body_of(system, q.symbol)
    turn = body.turn(q.symbol)
    if turn == 0:
        message = f"`torque_law`: the coordinate {q.symbol.name} rotates no body"
        raise Rejected(Complaint("wrong-argument", message, help="use `second_law`"))
    point = _point(body, turn, about, at_rest)
    sense = Integer(sign_known(turn) or 1)
    torques = sum_of([sense * force.torque(point.place) for force in body.forces])
    of = lagrangian_behind(system)
    inertia = None if at_rest else inertia_of(body.part)
    arm = tuple(a - b for a, b in zip(body.centre, _point_of_inertia(body, inertia, point), strict=True))
    carried = tidied(sense * body.mass * (dot((-arm[1], arm[0]), body.acceleration_of_centre)))
    turning = by_accelerations(tidied(sense * body.angular_acceleration), body.moving)

    def law(*moment: Expr) -> Relation:
        if not moment:
            return Relation(ZERO, "=", torques)
        left = [Factors(moment[0], turning), *([by_accelerations(carried, body.moving)] if carried != 0 else [])]
        return Relation(Terms(*left) if len(left) > 1 else left[0], "=", torques)

    changes = changes_alone(body, tuple(sense * c for c in rotated(body, point.place)), sense)
    return establish(
        TORQUE_LAW,
        None,
        law,
        {} if inertia is None else {"inertia": inertia},
        lines=Lines(result=False, arranged=explicit),
        routes={"lagrange": compared_with(lambda: at_rest_in(virtual_work(of, changes), system, at_rest))},
        outcome=which_of_several(body) + ("_at_rest" if at_rest else ""),
        phrase_data=PhraseData(
            words={"where": point.word},
            named={"coordinate": q.symbol, "mass": body.mass},
            outcome_data={
                **data_of(body),
                "about": point.place,
                "angle": body.angle,
                "forces": tuple((f.at, f.letter) for f in body.forces if f.at is not None),
                "spread": body.spread,
            },
        ),
        key=key or f"motion_{q.symbol.name}",
        facts=facts_of_motion(system, q, changes),
        scope=Scope(coordinates={**system.coordinates, **forces_in(system)}, differ=("body", "mass", "point", "axis")),
    )


def rotated(body: Alone, about: Vector) -> Vector:
    """The displacement of the centre in a rotation about a place by a unit angle, counterclockwise."""
    x, y = (a - b for a, b in zip(body.centre, about, strict=True))
    return tidied(-y), tidied(x)


def _point(body: Alone, turn: Expr, about: str, at_rest: bool) -> About:
    """Return the point about which the body can rotate alone.

    Forces without a letter, which keep the body on the path that the coordinates describe, then have no torque.
    """
    free = [each for each in _points(body, about, at_rest) if is_free(body, rotated(body, each.place), Integer(1))]
    if free:
        return free[0]
    message = "a force that has no letter has a torque about the centre of mass"
    help_line = "give the friction a letter, `friction: {rolling: F}`; or use `method: angular_momentum`"
    raise Rejected(Complaint("method", message, help=help_line))


def _points(body: Alone, about: str, at_rest: bool) -> list[About]:
    """The points about which torques may be taken, the best one first."""
    touched = [force.at for force in body.forces if force.at is not None and force.letter is not None]
    centre = About("centre_of_mass", body.centre)
    if about == "contact" or at_rest:
        most = sorted(dict.fromkeys(touched), key=lambda place: -touched.count(place))
        places = [About("point" if at_rest else "contact", place) for place in most]
        return [*places, *([About("contact", at)] if (at := _resting_point(body)) and about == "contact" else []), centre]
    held = _resting_point(body)
    axis = [About("axis", held)] if held is not None and is_fixed(held) else []
    return [*axis, centre]


def _resting_point(body: Alone) -> Vector | None:
    """The point of the body that is at rest in every motion that the coordinates allow; None if there is no such point."""
    turning = [q for q in body.moving if body.turn(q) != 0]
    shifting = [q for q in body.moving if any(c != 0 for c in body.shift(q))]
    if len(turning) != 1 or not set(shifting) <= set(turning):
        return None
    (dx, dy), turn = body.shift(turning[0]), body.turn(turning[0])
    x, y = body.centre
    return tidied(x - dy / turn), tidied(y + dx / turn)


def is_fixed(place: Vector) -> bool:
    return not coordinates_in(ImmutableDenseMatrix(place)) and not any(depends_on_time(c) for c in place)


def _point_of_inertia(body: Alone, inertia: object, point: About) -> Vector:
    """The place from which the term of the centre of mass is reckoned: none if the moment of inertia is about the point
    itself."""
    about_it = is_about_the_point(body.part) and _is_same(body.part.at.components, point.place)
    return body.centre if inertia is None or about_it else point.place


def _is_same(one: Vector, other: Vector) -> bool:
    return all(is_zero(a - b) for a, b in zip(one, other, strict=True))
