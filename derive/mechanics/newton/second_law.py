"""Newton's second law for one particle, or for the centre of mass of one body, along one direction."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Expr, Integer, Symbol

from derive.algebra.collect import by_accelerations
from derive.algebra.expressions import Factors, Relation, Terms, explicit, rate
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.newton import claims
from derive.mechanics.newton.alone import Alone, bodies_alone, body_of, changes_alone, unit_along
from derive.mechanics.newton.by_lagrange import facts_of_motion, lagrangian_behind, virtual_work
from derive.mechanics.newton.directions import direction_of, normals
from derive.mechanics.model.system import System
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import ROUTE, Rule
from derive.steps.step import Quantity, compared_with, is_zero

__all__ = ["second_law"]

ZERO = Integer(0)


SECOND_LAW = Rule(
    "newton.second_law",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, sections 2.4 and 3.1",
    outcomes={
        f"{outcome}{suffix}": claims.both(claims.of_masses(several, alike), claims.at_rest(suffix == "_at_rest"))
        for outcome, several, alike in (("alone", False, False), ("of_several", True, False), ("alike", True, True))
        for suffix in ("", "_at_rest")
    },
    evidence={"lagrange": ROUTE},
    statements=[claims.mass_times_acceleration, claims.direction],
    named={"mass": claims.mass_of_the_body, "coordinate": claims.coordinate_of_the_law, "towards": claims.coordinate_of_the_law},
)


def second_law(system: System, q: Coordinate, key: str | None = None, at_rest: bool = False) -> Quantity:
    """Newton's second law for the body that moves with a coordinate, m a = sum of F, along the direction in which the
    coordinate moves it.

    system   particles and bodies in a plane, and the forces on them
    q        a coordinate that moves the centre of mass of one body without rotation
    at_rest  whether the system is at rest, so that the forces add up to zero
    Second route: Lagrange's equations, for the displacement of this body alone.
    Outcomes: alone (the system has one mass), of_several (the mass of this body differs from the others), alike (another
    body has the same mass).
    Errors: the system moves in space; no body can move along q alone; q rotates the body.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, sections 2.4 and 3.1.
    """
    body = body_of(system, q.symbol)
    shift = body.shift(q.symbol)
    if body.turn(q.symbol) != 0:
        message = f"`second_law`: the coordinate {q.symbol.name} also rotates the body"
        raise Rejected(Complaint("wrong-argument", message, help="use `torque_law`"))
    way, of = unit_along(shift), lagrangian_behind(system)
    changes = changes_alone(body, way, ZERO)
    forces = sum_of([force.along(way) for force in body.forces])
    moving = body.moving

    def law() -> Relation:
        left = ZERO if at_rest else Factors(body.mass, by_accelerations(body.acceleration(way), moving))
        return Relation(left, "=", forces)

    along = direction_of(body, way)
    return establish(
        SECOND_LAW,
        None,
        law,
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"lagrange": compared_with(lambda: at_rest_in(virtual_work(of, changes), system, at_rest))},
        outcome=which_of_several(body) + ("_at_rest" if at_rest else ""),
        phrase_data=PhraseData(
            words={"way": along.word},
            named={"coordinate": q.symbol, "mass": body.mass} | ({"towards": q.symbol} if along.word == "increasing" else {}),
            outcome_data={**data_of(body), "normals": tuple(normals(body)), "centre": along.centre},
        ),
        key=key or f"motion_{q.symbol.name}",
        facts=facts_of_motion(system, q, changes),
        scope=Scope(coordinates={**system.coordinates, **forces_in(system)}),
    )


def at_rest_in(equation: Relation, system: System, at_rest: bool) -> Relation:
    """The equation with all rates and accelerations zero, if the system is at rest."""
    still = {rate(q, n): ZERO for q in system.coordinates for n in (1, 2)}
    return Relation(equation.residual.xreplace(still), "=", ZERO) if at_rest else equation


def forces_in(system: System) -> dict[Symbol, str]:
    """The symbols of the constraint forces, with their kinds."""
    return {each.force: each.kind_of_force or "" for each in system.constraints}


def which_of_several(body: Alone) -> str:
    """The outcome of a law of one body: whether the system has other bodies, and whether one has the same mass."""
    masses = [each.mass for each in bodies_alone(body.system)]
    if len(masses) == 1:
        return "alone"
    return "alike" if sum(is_zero(each - body.mass) for each in masses) > 1 else "of_several"


def data_of(body: Alone) -> dict[str, Any]:
    """The data with which predicates judge a sentence about one body."""
    return {
        "place": body.centre,
        "weight": body.mass,
        "masses": tuple(each.mass for each in bodies_alone(body.system)),
        "moving": tuple(body.moving),
    }


def sum_of(terms: Sequence[Expr]) -> Expr:
    """The sum of the components of forces, or of torques: positive terms first, and no term that vanishes."""
    present = [term for term in (tidied(each) for each in terms) if term != 0]
    ordered = sorted(present, key=lambda term: term.could_extract_minus_sign())
    return Terms(*ordered) if len(ordered) > 1 else ordered[0] if ordered else ZERO
