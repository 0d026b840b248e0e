"""Newton's second law for one particle, or for the centre of mass of one body, along one direction."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.collect import by_accelerations
from derive.algebra.expressions import Factors, Relation, explicit, rate
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.model.system import System
from derive.mechanics.newton import claims
from derive.mechanics.newton.by_lagrange import facts_of_motion, lagrangian_behind, virtual_work
from derive.mechanics.newton.directions import INCREASING, direction_of, normals
from derive.mechanics.newton.single_bodies import ZERO, Alone, bodies_alone, body_of, changes_alone, sum_of, unit_along
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import ROUTE, Predicate, Rule
from derive.steps.step import Quantity, compared_with, is_zero
from derive.steps.subject import EVERYTHING

__all__ = ["second_law"]

OUTCOMES: Mapping[str, Predicate] = {  # the outcomes of `second_law` and `torque_law`
    f"{outcome}{suffix}": claims.both(claims.of_masses(several, alike), claims.at_rest(suffix == "_at_rest"))
    for outcome, several, alike in (("alone", False, False), ("of_several", True, False), ("alike", True, True))
    for suffix in ("", "_at_rest")
}
SECOND_LAW = Rule(
    "newton.second_law",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 2 and 3",
    outcomes=OUTCOMES,
    evidence={"lagrange": ROUTE},
    statements=[claims.mass_times_acceleration, claims.direction],
    named={
        "mass": claims.mass_of_the_body,
        "coordinate": claims.coordinate_of_the_law,
        "towards": claims.coordinate_of_the_law,
    },
)


def second_law(system: System, q: Coordinate, key: str | None = None, at_rest: bool = False) -> Quantity:
    """Newton's second law for the body that moves with a coordinate, m a = sum of F, along the direction in which the
    coordinate moves it.

    system   particles, bodies that move in a plane, and the forces on them
    q        a coordinate that moves the centre of mass of one body without rotation
    at_rest  whether the system is at rest; the forces then add up to zero

    Second route: Lagrange's equations, for a displacement in which only this body moves.
    Outcomes: alone (the system has one mass), of_several (the mass of this body differs from all other masses), alike
    (another body has the same mass); for bodies at rest, alone_at_rest, of_several_at_rest, alike_at_rest.
    Errors: a body moves in space; the coordinates do not let one body move with q while all others stay at rest; q
    rotates the body.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 2 and 3.
    """
    body = body_of(system, q.symbol)
    if body.turn(q.symbol) != 0:
        message = f"`second_law`: the coordinate {q.symbol.name} also rotates the body"
        raise Rejected(Complaint("wrong-argument", message, help="use `torque_law`"))
    way = unit_along(body.shift(q.symbol))
    along, of, changes = direction_of(body, way), lagrangian_behind(system), changes_alone(body, way, ZERO)
    inertia = ZERO if at_rest else Factors(body.mass, by_accelerations(body.acceleration(way), body.moving))
    towards = {"towards": q.symbol} if along.word == INCREASING else {}
    return establish(
        SECOND_LAW,
        None,
        lambda: Relation(inertia, "=", sum_of([force.along(way) for force in body.forces])),
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"lagrange": compared_with(lambda: at_rest_in(virtual_work(of, changes), system, at_rest))},
        outcome=outcome_of(body, at_rest),
        phrase_data=PhraseData(
            words={"way": along.word},
            named={"coordinate": q.symbol, "mass": body.mass, **towards},
            outcome_data={**data_of(body), "normals": tuple(normals(body)), "centre": along.centre},
        ),
        key=key or f"motion_{q.symbol.name}",
        facts=facts_of_motion(system, q, changes),
        scope=scope_of(system),
    )


def at_rest_in(equation: Relation, system: System, at_rest: bool) -> Relation:
    """The equation; for a system at rest, with all rates and accelerations zero."""
    still = {rate(q, n): ZERO for q in system.coordinates for n in (1, 2)}
    return Relation(equation.residual.xreplace(still), "=", ZERO) if at_rest else equation


def scope_of(system: System) -> Scope:
    """A scope with the coordinates of a system and the symbols of its constraint forces."""
    forces = {each.force: each.kind_of_force or "" for each in system.constraints}
    return Scope(coordinates={**system.coordinates, **forces}, differ=EVERYTHING)


def outcome_of(body: Alone, at_rest: bool) -> str:
    """The outcome of a law of one body: whether the system has other bodies, and whether one of these has the same
    mass."""
    masses = [each.mass for each in bodies_alone(body.system)]
    same = sum(is_zero(each - body.mass) for each in masses)
    found = "alone" if len(masses) == 1 else "alike" if same > 1 else "of_several"
    return f"{found}_at_rest" if at_rest else found


def data_of(body: Alone) -> dict[str, Any]:
    """The data with which predicates judge a sentence about one body."""
    return {
        "place": body.centre,
        "weight": body.mass,
        "masses": tuple(each.mass for each in bodies_alone(body.system)),
        "moving": tuple(body.moving),
    }
