"""Sum of the torques on one body in a plane, about its centre of mass, a fixed axis or a point of contact. For a body
at rest, the torques may also be about a point where unknown forces act."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sympy import Expr, Integer, Mul, Symbol

from derive.algebra.collect import by_accelerations
from derive.algebra.expressions import Factors, Relation, Terms, explicit
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.model.rigid import inertia_of, is_about_the_point
from derive.mechanics.model.system import System
from derive.mechanics.newton import claims
from derive.mechanics.newton.by_lagrange import facts_of_motion, lagrangian_behind, virtual_work
from derive.mechanics.newton.second_law import OUTCOMES, at_rest_in, data_of, outcome_of, scope_of
from derive.mechanics.newton.single_bodies import (
    ZERO,
    Alone,
    Vector,
    arm,
    body_of,
    changes_alone,
    dot,
    is_free,
    is_same,
    rotated,
    sense_of,
    sum_of,
)
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.rule import ROUTE, Rule
from derive.steps.step import Quantity, compared_with

__all__ = ["torque_law"]

CONTACT = "contact"


@dataclass(frozen=True)
class About:
    """A point about which torques are taken.

    word   "axis" (a fixed point), "centre_of_mass", "contact", or "point" (for a body at rest: a point where unknown
           forces act)
    place  the components of the position of this point, m
    """

    word: str
    place: Vector


TORQUE_LAW = Rule(
    "newton.torque_law",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7",
    outcomes=OUTCOMES,
    evidence={"lagrange": ROUTE},
    statements=[claims.rate_of_angular_momentum, claims.point_of_the_torques],
    named={
        "mass": claims.mass_of_the_body,
        "coordinate": claims.coordinate_of_the_law,
        "acting": claims.force_at_the_point,
    },
)


def torque_law(
    system: System, q: Coordinate, key: str | None = None, about: str = "", at_rest: bool = False
) -> Quantity:
    """Sum of the torques on the body that rotates with a coordinate, I alpha = sum of tau. Torques are positive in the
    direction in which the body rotates as the coordinate increases.

    system   particles and bodies in a plane, and the forces on them
    q        a coordinate that rotates one body
    about    "contact" for a point of contact; the angular momentum about this point also has the term M r x v of the
             centre of mass. By default, torques are about the fixed axis of the body, or else about its centre of mass
    at_rest  whether the system is at rest; the torques then add up to zero. They are about the point with the most
             unknown forces, if the coordinates let only this body rotate about such a point

    Second route: Lagrange's equations, for a rotation in which only this body moves.
    Outcomes: as `second_law`.
    Errors: a body moves in space; the coordinates do not let one body move with q while all others stay at rest; q does
    not rotate this body; a force without a symbol has a torque.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7.
    """
    body = body_of(system, q.symbol)
    turn = body.turn(q.symbol)
    if turn == 0:
        message = f"`torque_law`: the coordinate {q.symbol.name} does not rotate the body that it moves"
        raise Rejected(Complaint("wrong-argument", message, help="use `second_law`"))
    point, sense = _point(body, about, at_rest), sense_of(turn)
    torques = _sum_of_torques([sense * force.torque(point.place) for force in body.forces], at_rest)
    inertia = None if at_rest else inertia_of(body.part)
    turning = by_accelerations(tidied(sense * body.angular_acceleration), body.moving)
    carried = by_accelerations(tidied(sense * _moment_of_the_centre(body, point)), body.moving)

    def law(*moment: Expr) -> Relation:
        terms = [*(Factors(each, turning) for each in moment), *([carried] if moment and carried != 0 else [])]
        return Relation(Terms(*terms) if len(terms) > 1 else terms[0] if terms else ZERO, "=", torques)

    of = lagrangian_behind(system)
    changes = changes_alone(body, tuple(sense * c for c in rotated(body, point.place)), sense)
    return establish(
        TORQUE_LAW,
        None,
        law,
        {} if inertia is None else {"inertia": inertia},
        lines=Lines(result=False, arranged=explicit),
        routes={"lagrange": compared_with(lambda: at_rest_in(virtual_work(of, changes), system, at_rest))},
        outcome=outcome_of(body, at_rest),
        phrase_data=PhraseData(
            words={"where": point.word, "term": "with_centre" if carried != 0 else "alone"},
            named={"coordinate": q.symbol, "mass": body.mass} | _acting_at(body, point),
            outcome_data={
                **data_of(body),
                "about": point.place,
                "angle": body.angle,
                "spread": body.spread,
                "forces": tuple((f.at, f.letter) for f in body.forces if f.at is not None),
            },
        ),
        key=key or f"motion_{q.symbol.name}",
        facts=facts_of_motion(system, q, changes),
        scope=scope_of(system),
    )


def _sum_of_torques(terms: Sequence[Expr], at_rest: bool) -> Expr:
    """The sum of the torques, with their common symbols in front: R (S_1 - S_2). If the body is at rest and all terms
    are negative, all signs are reversed, because the sum is zero."""
    negative = at_rest and all(term.could_extract_minus_sign() for term in explicit(sum_of(terms)).as_ordered_terms())
    terms = [tidied(-term if negative else term) for term in terms if term != 0]
    common = Mul(*(f for f in Mul.make_args(common_factor(terms)) if f.is_Symbol)) if len(terms) > 1 else Integer(1)
    numbers = {abs(term.as_coeff_Mul()[0]) for term in terms}
    common *= numbers.pop() if len(numbers) == 1 and common != 1 else Integer(1)
    inside = sum_of([term / common for term in terms])
    return Factors(*common.as_ordered_factors(), inside) if common != 1 and isinstance(inside, Terms) else sum_of(terms)


def _acting_at(body: Alone, point: About) -> dict[str, Symbol]:
    """The symbols of at most two unknown forces that act at the point of the law; empty for an axis, a contact or a
    centre of mass.
    """
    if point.word != "point":
        return {}
    here = [f.letter for f in body.forces if f.at is not None and f.letter is not None and is_same(f.at, point.place)]
    return {f"acting_{i}": letter for i, letter in enumerate(here[:2], 1)}


def _point(body: Alone, about: str, at_rest: bool) -> About:
    """Return the first point about which the body can rotate while all other bodies stay at rest.

    Forces without a symbol, which keep the body on the path that the coordinates describe, have no torque about this
    point.
    """
    choices = _points_at_rest(body) if at_rest else _points_of_contact(body) if about == CONTACT else []
    if body.axis is not None:
        choices.append(About("axis", body.axis))
    choices.append(About("centre_of_mass", body.centre))
    for each in choices:
        if is_free(body, rotated(body, each.place), Integer(1)):
            return each
    message = "a force without a symbol has a torque about the centre of mass"
    help_line = "give the friction a symbol, `friction: {rolling: F}`; or use `method: angular_momentum`"
    raise Rejected(Complaint("method", message, help=help_line))


def _points_at_rest(body: Alone) -> list[About]:
    """The points at which unknown forces act, first the point with the most unknown forces."""
    touched = [force.at for force in body.forces if force.at is not None and force.letter is not None]
    return [About("point", at) for at in sorted(dict.fromkeys(touched), key=lambda place: -touched.count(place))]


def _points_of_contact(body: Alone) -> list[About]:
    """The points where forces with symbols act, such as friction. If one point of the body is always at rest, the last
    item is this point."""
    touched = [each.place for each in _points_at_rest(body)]
    resting = _resting_point(body)
    return [About(CONTACT, place) for place in (*touched, *([resting] if resting is not None else []))]


def _resting_point(body: Alone) -> Vector | None:
    """The point that is at rest in every motion of a body, if only one coordinate moves this body; None if there is no
    such point."""
    moving = [q for q in body.moving if body.moves_with(q)]
    if len(moving) != 1 or body.turn(moving[0]) == 0:
        return None
    (dx, dy), turn, (x, y) = body.shift(moving[0]), body.turn(moving[0]), body.centre
    return tidied(x - dy / turn), tidied(y + dx / turn)


def _moment_of_the_centre(body: Alone, point: About) -> Expr:
    """The term M r x a of the rate of change of the angular momentum, positive counterclockwise; zero if the moment of
    inertia is about the point itself."""
    if point.word == "axis" and is_about_the_point(body.part):
        return ZERO
    x, y = arm(body.centre, point.place)
    return body.mass * dot((-y, x), body.acceleration_of_centre)
