"""Contacts of bodies with surfaces: the normal force and friction, with their forces on the material points of both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.expressions import as_expr, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.boundary import Hollowed, Round
from derive.mechanics.bodies.placed import PlacedBody, PointOfBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.constraint import Constraint, PointForce
from derive.mechanics.model.forces import GivenForce
from derive.mechanics.model.material import GROUND
from derive.mechanics.model.no_slip import no_slip, rolling_constraint, velocity_at
from derive.mechanics.model.surfaces import Circle, Surface, dot, unit, vector
from derive.steps.record import require_constant
from derive.steps.step import Quantity, is_zero

__all__ = ["contact"]

ZERO = Integer(0)
Part: TypeAlias = Constraint | GivenForce | Quantity


@dataclass(frozen=True)
class Touch:
    """A body that touches a surface.

    of       the body or particle
    at       the place of contact
    surface  the surface
    gap      the distance between the body and the surface, m
    normal   the unit vector from the surface to the body
    """

    of: Any
    at: Location
    surface: Surface
    gap: Expr
    normal: Location

    @property
    def is_kept(self) -> bool:
        """Whether the coordinates alone keep the body on the surface."""
        return is_zero(self.gap)

    @property
    def tangent(self) -> Location:
        """In a plane, the unit vector along the surface; the free side is on its left."""
        x, y = self.normal.components
        return Location((y, -x))

    def pair(self, direction: Location) -> tuple[PointForce, ...]:
        """The force along a direction on the body, and the opposite force on the surface."""
        found = [PointForce(direction.components, self.at, self.of)]
        if self.surface.of is not None:
            found.append(PointForce((-direction).components, self.at, self.surface.of))
        return tuple(found)


def contact(
    of: Any,
    on: Any,
    normal: str = "",
    rolling: str | bool = False,
    sliding: Any = None,
    direction: Any = None,
) -> tuple[Part, ...]:
    """The forces between a body and a surface that it touches, and the conditions that they enforce.

    of         a particle, a round body (its surface touches), or a point of a body, `rod.place_of("end")`
    on         a surface, `plane(...)` or `circle(...)`; or another round body
    normal     the symbol of the normal force, N, along the unit normal; positive if the surface pushes. Needed if the
               coordinates allow the body to leave the surface
    rolling    whether the body does not slip; or the symbol of the friction that prevents slipping, N, positive along
               the surface with the free side on the left
    sliding    the coefficient of sliding friction mu: the friction mu N opposes the velocity of slip
    direction  with `sliding`: the direction in which the material point of the body slips over the surface
    Equal and opposite forces act on the material points of both. The distance of a round body from the surface is the
    distance of its centre minus its radius.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, sections 3.2 and 7.6.
    """
    touch = _touch(of, on)
    if rolling and sliding is not None:
        raise Rejected(Complaint("wrong-argument", "a body either rolls or slides: give `rolling` or `sliding`"))
    found: list[Part] = []
    if not touch.is_kept:
        found.append(Constraint(touch.gap, ZERO, scalar(normal or "N"), forces=touch.pair(touch.normal)))
    elif normal:
        _reject_normal(normal, touch)
    if rolling:
        found += _rolling(touch, rolling)
    if sliding is not None:
        found.append(_sliding(touch, sliding, direction, normal or "N"))
    elif direction is not None:
        raise Rejected(Complaint("unused-key", "`direction` is the direction of slip, so it needs `sliding`"))
    return tuple(found)


def _touch(of: Any, on: Any) -> Touch:
    surface = on if isinstance(on, Surface) else _surface_of(on)
    if isinstance(of, PointOfBody):
        body, at, radius = of.body, Location(of.components), ZERO
    elif isinstance(of, PlacedBody):
        body, at, radius = of, of.centre, _radius_of(of)
    elif hasattr(of, "mass") and isinstance(getattr(of, "at", None), Location):
        body, at, radius = of, of.at, ZERO
    else:
        message = "`contact` needs a particle, a round body or a point of a body"
        help_line = Spelled('give a point of the body: `rod.place_of("end")`', "give a point of the body: `rod.end`")
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    away = surface.normal(at)
    place = at if radius == 0 else Location(tuple(tidied(c) for c in (at - radius * away).components))
    return Touch(body, place, surface, tidied(surface.distance(at) - radius), away)


def _surface_of(body: Any) -> Circle:
    if not isinstance(body, PlacedBody):
        raise Rejected(Complaint("wrong-argument", "`contact` needs a surface, or a round body"))
    return Circle(body, None, body.centre, _radius_of(body))


def _radius_of(placed: PlacedBody) -> Expr:
    """Return the radius of a body that is round in the plane of motion, or of a ball in space."""
    boundary = placed.body.boundary
    outer = boundary.whole if isinstance(boundary, Hollowed) else boundary
    if isinstance(outer, Round) and placed.across in (2, None):
        z = Symbol("z_along", real=True)
        middle = (outer.ends[0] + outer.ends[1]) / 2
        radius = outer.radius_at(middle)
        is_widest = is_zero(outer.radius_at(z).diff(z).subs(z, middle))
        is_ball = is_zero(outer.radius_at(z) ** 2 + (z - middle) ** 2 - radius**2)
        if is_ball or is_widest and placed.across == 2:
            return radius
    message = f"{placed.body.name} is not round in this view, so the point where it touches the surface is unknown"
    help_line = Spelled('give a point of the body: `rod.place_of("end")`', "give a point of the body: `rod.end`")
    raise Rejected(Complaint("no-contact", message, help=help_line))


def _reject_normal(letter: str, touch: Touch) -> None:
    where = ", ".join(map(str, touch.at.components))
    message = f"the coordinates keep the body on the surface at ({where}), so `{letter}` does not appear"
    help_line = "give the body a coordinate for its distance from the surface, so that the normal force keeps it there"
    raise Rejected(Complaint("not-an-unknown", message, help=help_line))


def _rolling(touch: Touch, rolling: str | bool) -> list[Part]:
    if not isinstance(touch.of, PlacedBody) or len(touch.at.components) == 3:
        return _rolling_in_space(touch, rolling)
    ground = touch.surface.ground
    if touch.is_kept and rolling is True:
        found = no_slip(touch.of, touch.at, ground)
        return list(found) if isinstance(found, tuple) else [found]
    slip = velocity_at(touch.of, touch.at) - velocity_at(ground, touch.at)
    along = tidied(dot(touch.tangent, slip))
    letter = scalar(rolling if isinstance(rolling, str) else "F")
    return [Constraint(along, ZERO, letter, in_rates=True, forces=touch.pair(touch.tangent))]


def _rolling_in_space(touch: Touch, rolling: str | bool) -> list[Part]:
    if not isinstance(touch.of, PlacedBody):
        raise Rejected(Complaint("wrong-argument", "a particle does not roll", help="leave out `rolling`"))
    if not touch.is_kept:
        message = "in space, rolling needs coordinates that keep the body on the surface"
        raise Rejected(Complaint("wrong-argument", message, help="leave out the coordinate away from the surface"))
    if rolling is True:
        found = no_slip(touch.of, touch.at, touch.surface.ground)
        return list(found) if isinstance(found, tuple) else [found]
    return list(rolling_constraint(touch.of, touch.at, str(rolling), touch.surface.ground))


def _sliding(touch: Touch, coefficient: Any, direction: Any, letter: str) -> GivenForce:
    """Return the friction mu N against the velocity of slip, on the material points of both."""
    mu = as_expr(coefficient)
    require_constant("contact", "coefficient of friction", mu)
    if touch.is_kept:
        message = f"the coordinates keep the body on the surface, so its normal force `{letter}` is unknown"
        help_line = "give the body a coordinate for its distance from the surface"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    if direction is None:
        message = "sliding friction needs the direction in which the body slips over the surface"
        raise Rejected(Complaint("missing-key", message, help="give it as `direction`, for example `[1, 0]`"))
    along = unit("contact", vector("contact", direction, touch.at))
    if not is_zero(ImmutableDenseMatrix([tidied(dot(along, touch.normal))])):
        raise Rejected(Complaint("wrong-argument", "the direction of slip must be along the surface"))
    force = tuple(-mu * scalar(letter) * c for c in along.components)
    by = touch.surface.of if touch.surface.of is not None else GROUND
    return GivenForce(force, touch.at.components, touch.of, by)
