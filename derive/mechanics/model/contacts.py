"""Contacts of bodies with surfaces: the normal force and friction, with their forces on the material points of both."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self, TypeAlias

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.expressions import TIME, Relation, as_expr, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled, Unverified
from derive.mechanics.bodies.boundary import Hollowed, Round
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.model.connection import Connection, PointForce, end_of, is_end
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.forces import GivenForce
from derive.mechanics.model.material import GROUND
from derive.mechanics.model.no_slip import no_slip, rolling_constraint, velocity_at, velocity_of_particle
from derive.mechanics.model.part import moved
from derive.mechanics.model.surfaces import Circle, Plane, Surface, dot, unit, vector
from derive.steps.record import assume, coordinates_in, require_constant
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, is_zero

__all__ = ["contact", "landing_surface"]

ZERO = Integer(0)
Part: TypeAlias = Constraint | GivenForce | Quantity


@dataclass(frozen=True)
class Contact(Connection):
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
    def foot(self) -> Location:
        """The place on the surface that touches the body."""
        return self.surface.foot(self.at, self.normal)

    @property
    def tangent(self) -> Location:
        """In a plane, the unit vector along the surface; the free side is on its left."""
        x, y = self.normal.components
        return Location((y, -x))

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(
            super().moved(known),
            of=moved(self.of, known),
            at=self.at.with_values(known),
            surface=self.surface.moved(known),
            gap=self.gap.subs(known),
            normal=self.normal.with_values(known),
        )

    def pair(self, size: Expr, direction: Location) -> tuple[PointForce, PointForce]:
        """The force along a direction on the body, and the opposite force on the surface."""
        return (
            PointForce(size, direction.components, self.at, self.of),
            PointForce(size, (-direction).components, self.foot, self.surface.of),
        )


@dataclass(frozen=True)
class LandingSurface(Connection):
    """A surface that a particle reaches only at the end of a free flight; no force acts on the particle before."""

    surface: Surface

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), surface=self.surface.moved(known))


def landing_surface(surface: Any) -> LandingSurface:
    """A surface on which a free flight ends; it is a part of the drawing.

    surface   a surface from `plane`
    """
    return LandingSurface((), surface)


def contact(
    of: Any,
    on: Any,
    normal: str = "",
    rolling: str | bool = False,
    sliding: Any = None,
    direction: Any = None,
) -> tuple[Contact | Part, ...]:
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
    touch = _contact(of, on)
    _check_carried(touch, bool(rolling) or sliding is not None)
    if rolling and sliding is not None:
        raise Rejected(Complaint("wrong-argument", "a body either rolls or slides: give `rolling` or `sliding`"))
    found: list[Part] = []
    if not touch.is_kept:
        found.append(_normal(touch, normal))
    elif normal:
        _reject_normal(normal, touch)
    if rolling:
        found += _rolling(touch, rolling)
    if sliding is not None:
        found.append(_sliding(touch, sliding, direction, normal or "N"))
    elif direction is not None:
        raise Rejected(Complaint("unused-key", "`direction` is the direction of slip, so it needs `sliding`"))
    return replace(touch, forces=tuple(_forces_of(touch, found))), *found


def _check_carried(touch: Contact, rough: bool) -> None:
    """Require the body that carries a surface that moves with coordinates, and the motion of a rough surface that
    rotates."""
    surface = touch.surface
    turning = touch.normal.components if isinstance(surface, Plane) else ()
    moving = coordinates_in(ImmutableDenseMatrix([*surface.place.components, *turning, Integer(0)]))
    if surface.of is None and moving and not isinstance(surface.moves, Axes):
        message = f"the surface moves with {next(iter(moving))}, but no body carries it, so nothing bears its reaction"
        raise Rejected(Complaint("which-body", message, help="name the body that carries the surface, `of: wedge`"))
    if rough and surface.of is None and any(c.has(TIME) for c in turning):
        message = "the surface rotates, so the velocity of its material is unknown"
        raise Rejected(Complaint("wrong-argument", message, help="let a body carry the surface, `of: plate`"))


def _normal(touch: Contact, letter: str) -> Constraint:
    if not letter:
        message = "the coordinates allow the body to leave the surface, so a normal force must keep it there"
        raise Rejected(Complaint("missing-key", message, help="give the symbol of the normal force, `normal: N`"))
    force = scalar(letter)
    return Constraint(touch.gap, ZERO, force, forces=touch.pair(force, touch.normal), enforcer="surface")


def _forces_of(touch: Contact, parts: Sequence[Part]) -> Iterator[PointForce]:
    for part in parts:
        if isinstance(part, Constraint):
            yield from part.forces
        if isinstance(part, GivenForce):
            yield from touch.pair(Integer(1), Location(part.components))


def _contact(of: Any, on: Any) -> Contact:
    surface = on if isinstance(on, Surface) else _surface_of(on)
    at, body = end_of(of) if is_end(of) else (None, None)
    if at is None or body is None:
        message = "`contact` needs a particle, a round body or a point of a body"
        help_line = Spelled('give a point of the body: `rod.place_of("end")`', "give a point of the body: `rod.end`")
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    radius = radius_of(of) if isinstance(of, PlacedBody) else ZERO
    away = surface.normal(at)
    place = at if radius == 0 else Location(tuple(tidied(c) for c in (at - radius * away).components))
    found = Contact((), body, place, surface, tidied(surface.distance(at) - radius), away)
    _check(found)
    _check_reached(found)
    return found


def _check_reached(touch: Contact) -> None:
    """Reject a body that never touches the surface: it is always away from the surface, or partly inside it."""
    sign = sign_known(touch.gap)
    if sign in (1, -1):
        where = "always away from the surface" if sign == 1 else "always partly inside the surface"
        message = f"the body is {where}, since its distance from the surface is {touch.gap}"
        raise Rejected(Complaint("no-contact", message, help="change the place of the body, its size or the surface"))


def _check(touch: Contact) -> None:
    """Check that the normal is a unit vector, and that the place of contact is as far from the surface as the body."""
    if not is_zero(tidied(dot(touch.normal, touch.normal)) - 1):
        raise Unverified(Complaint("unverified", "the normal of a contact is not a unit vector"))
    if not is_zero(tidied(touch.surface.height(touch.at, touch.normal) - touch.gap)):
        raise Unverified(Complaint("unverified", "the place of a contact is not on the surface of the body"))


def _surface_of(body: Any) -> Circle:
    radius = _round_radius(body) if isinstance(body, PlacedBody) else None
    if radius is None:
        message = "`contact` needs a surface, or a round body whose rim is the surface"
        help_line = Spelled(
            "describe a face of the body: `plane(..., of=body)`",
            "describe a face of the body under `surfaces`, with `of`",
        )
        raise Rejected(Complaint("no-contact", message, help=help_line))
    return Circle(body, None, body.centre, radius)


def radius_of(placed: PlacedBody) -> Expr:
    """Return the radius of a body that is round in the plane of motion, or of a ball in space."""
    radius = _round_radius(placed)
    if radius is None:
        message = f"{placed.body.name} is not round in this view, so the point where it touches the surface is unknown"
        help_line = Spelled('give a point of the body: `rod.place_of("end")`', "give a point of the body: `rod.end`")
        raise Rejected(Complaint("no-contact", message, help=help_line))
    return radius


def _round_radius(placed: PlacedBody) -> Expr | None:
    boundary = placed.body.boundary
    outer = boundary.whole if isinstance(boundary, Hollowed) else boundary
    if not isinstance(outer, Round) or placed.across not in (2, None):
        return None
    z = Symbol("z_along", real=True)
    middle = (outer.ends[0] + outer.ends[1]) / 2
    radius = outer.radius_at(middle)
    is_widest = is_zero(outer.radius_at(z).diff(z).subs(z, middle))
    is_ball = is_zero(outer.radius_at(z) ** 2 + (z - middle) ** 2 - radius**2)
    return radius if is_ball or is_widest and placed.across == 2 else None


def _reject_normal(letter: str, touch: Contact) -> None:
    where = ", ".join(map(str, touch.at.components))
    message = f"the coordinates keep the body on the surface at ({where}), so `{letter}` does not appear"
    help_line = "give the body a coordinate for its distance from the surface, so that the normal force keeps it there"
    raise Rejected(Complaint("not-an-unknown", message, help=help_line))


def _rolling(touch: Contact, rolling: str | bool) -> list[Part]:
    if not isinstance(touch.of, PlacedBody) or len(touch.at.components) == 3:
        return _rolling_in_space(touch, rolling)
    ground = touch.surface.ground
    if touch.is_kept and rolling is True:
        found = no_slip(touch.of, touch.at, ground)
        return list(found) if isinstance(found, tuple) else [found]
    slip = velocity_at(touch.of, touch.at) - velocity_at(ground, touch.foot)
    along = tidied(dot(touch.tangent, slip))
    if not isinstance(rolling, str):
        message = "the coordinates allow the body to leave the surface, so a friction must prevent slipping"
        raise Rejected(Complaint("missing-key", message, help="give the symbol of the friction, `{rolling: F}`"))
    letter = scalar(rolling)
    of_particles = velocity_of_particle(touch.of, touch.at, ground, touch.foot)
    by_particles = Add(*(a * b for a, b in zip(touch.tangent.components, of_particles, strict=True)))
    if not is_zero(tidied(along - by_particles)):
        raise Unverified(Complaint("unverified", "the slip is not the relative velocity of the particles in contact"))
    pair = touch.pair(letter, touch.tangent)
    return [Constraint(along, ZERO, letter, in_rates=True, forces=pair, enforcer="friction")]


def _rolling_in_space(touch: Contact, rolling: str | bool) -> list[Part]:
    if not isinstance(touch.of, PlacedBody):
        raise Rejected(Complaint("wrong-argument", "a particle does not roll", help="leave out `rolling`"))
    if not touch.is_kept:
        message = "in space, rolling needs coordinates that keep the body on the surface"
        raise Rejected(Complaint("wrong-argument", message, help="leave out the coordinate away from the surface"))
    if rolling is True:
        found = no_slip(touch.of, touch.at, touch.surface.ground)
        return list(found) if isinstance(found, tuple) else [found]
    return list(rolling_constraint(touch.of, touch.at, str(rolling), touch.surface.ground))


def _sliding(touch: Contact, coefficient: Any, direction: Any, letter: str) -> GivenForce:
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
    slip = velocity_at(touch.of, touch.at) - velocity_at(touch.surface.ground, touch.foot)
    assume(Relation(tidied(dot(along, slip)), ">", ZERO))  # otherwise the friction has the opposite direction
    force = tuple(-mu * scalar(letter) * c for c in along.components)
    by = touch.surface.of if touch.surface.of is not None else GROUND
    return GivenForce(force, touch.at.components, touch.of, by)
