"""Connections of bodies with each other and with the ground, such as contacts, strings, massless rods and joints.

Functions such as `contact` return a connection together with the constraints and forces that affect the motion. For
drawings, the connection records which forces act on which material points.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

from sympy import Expr, ImmutableDenseMatrix, Symbol

from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import PlacedBody, PointOfBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.dalembert import Load
from derive.mechanics.model.material import material_point
from derive.mechanics.model.part import Part, moved
from derive.steps.record import coordinates_in


@dataclass(frozen=True)
class PointForce:
    """A force on a material point: `size` times `direction`, N.

    size   the symbol of a constraint force; for sliding friction, `size` is 1 and `direction` contains the factor mu N
    at     the place where the force acts
    of     the body or particle on which the force acts; None for the ground or a massless pulley
    """

    size: Expr
    direction: tuple[Expr, ...]
    at: Location
    of: Any

    def moved(self, known: Mapping[Symbol, Expr]) -> PointForce:
        direction = tuple(c.subs(known) for c in self.direction)
        return PointForce(self.size.subs(known), direction, self.at.with_values(known), moved(self.of, known))

    def load(self, multiplier: Symbol | None) -> Load:
        point = material_point("constraint", self.of, self.at)
        return Load(tuple(self.size * c for c in self.direction), point.place, point.held, multiplier)


@dataclass(frozen=True)
class Connection(Part):
    """A connection, such as a contact, a string or a joint.

    forces   the forces of its constraints and of its friction on material points, for drawings; may be empty
    """

    forces: tuple[PointForce, ...]

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(self, forces=tuple(each.moved(known) for each in self.forces))

    def on(self, body: Any) -> Sequence[PointForce]:
        return [each for each in self.forces if each.of is body or each.of == body]


def end_of(given: Any) -> tuple[Location, Any]:
    """Return a place, and the body or particle to which it belongs. The second item is None for a place that belongs to
    no body or particle."""
    if isinstance(given, PointOfBody):
        return Location(given.components), given.body
    if isinstance(given, PlacedBody):
        return given.centre, given
    if isinstance(given, Location):
        return given, None
    return given.at, given


def require_bodies(verb: str, ends: Sequence[tuple[Location, Any]], otherwise: str = "") -> None:
    """Require each moving place to belong to a body or particle, because a force acts at the place.

    otherwise   the text at the end of the help line
    """
    for place, of in ends:
        if of is None and (moving := coordinates_in(ImmutableDenseMatrix(place.components))):
            where = ", ".join(map(str, place.components))
            message = (
                f"`{verb}`: the place ({where}) moves with {next(iter(moving))}, "
                "but it does not belong to a body or particle"
            )
            help_line = (
                "name a particle or a point of a body: `cart`, `{from: cart, by: [0, d]}`, `rod.end`" + otherwise
            )
            raise Rejected(Complaint("which-body", message, help=help_line))


def is_end(given: Any) -> bool:
    is_particle = hasattr(given, "mass") and isinstance(getattr(given, "at", None), Location)
    return is_particle or isinstance(given, Location | PlacedBody)
