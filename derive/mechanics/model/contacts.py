"""Contacts of bodies with surfaces: the normal force and friction, on material points of the body and the surface."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self, TypeAlias

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Mul, Symbol, eye, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Relation, as_expr, depends_on_time, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled, Unverified
from derive.mechanics.bodies.placed import PlacedBody, PointOfBody
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.model.connection import Connection, PointForce, end_of, is_end
from derive.mechanics.model.constraint import Constraint, StaticLimit
from derive.mechanics.model.contact_points import has_radius, radius_of, touching
from derive.mechanics.model.forces import GivenForce
from derive.mechanics.model.material import GROUND
from derive.mechanics.model.no_slip import contact_velocity, no_slip, velocity_at, velocity_of_particle
from derive.mechanics.model.part import moved
from derive.mechanics.model.surfaces import (
    Circle,
    Curve,
    Plane,
    Surface,
    column_of,
    dot,
    unit,
    vector,
)
from derive.steps.record import assume, coordinates_in, require_constant
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, is_zero

__all__ = ["contact", "landing_surface"]

ZERO, ONE = Integer(0), Integer(1)
Part: TypeAlias = Constraint | GivenForce | Quantity


@dataclass(frozen=True)
class Contact(Connection):
    """A body that touches a surface.

    of       the body or particle; None for a fixed corner that a body touches
    at       the place of contact
    surface  the surface that the body touches
    gap      the distance between the body and the surface, m; for a particle or a point of a body at a curve, the
             vertical distance from the curve
    normal   the unit vector normal to the surface, towards the body
    gradient  the length of the gradient of `gap` on the surface
    """

    of: Any
    at: Location
    surface: Surface
    gap: Expr
    normal: Location
    gradient: Expr = ONE

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
            gradient=self.gradient.subs(known),
        )

    def pair(self, size: Expr, direction: Location) -> tuple[PointForce, PointForce]:
        """The force along a direction on the body, and the opposite force on the surface."""
        return (
            PointForce(size, direction.components, self.at, self.of),
            PointForce(size, (-direction).components, self.foot, self.surface.of),
        )


@dataclass(frozen=True)
class LandingSurface(Connection):
    """A surface that a particle reaches only at the end of a free flight, so it exerts no force on the particle."""

    surface: Surface

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), surface=self.surface.moved(known))


def landing_surface(surface: Any) -> LandingSurface:
    """A surface on which a free flight ends; the drawing shows this surface.

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
    static: Any = None,
    force: str = "",
    key: str = "no_slip",
) -> tuple[Contact | Part, ...]:
    """The forces between a body and a surface that it touches, and the conditions that they enforce.

    of         what touches the surface: a particle, a round body, or a point of a body such as `rod.place_of("end")`.
               If a body carries the surface, `of` may also be a fixed place that the surface touches, such as the edge
               of a table
    on         a surface, `plane(...)`, `circle(...)` or `curve(...)`; or another round body
    normal     the symbol of the normal force along the unit normal, in newtons; positive if the surface pushes. The
               symbol is needed if the coordinates allow the body to leave the surface
    rolling    for a body that does not slip: the symbol of the friction that prevents slipping, in newtons; or True, if
               the coordinates alone keep the body on the surface. In a plane, by default, the friction is positive in
               the direction along the surface that has the free side on its left. In space, the friction has two
               components along axes in the surface, such as F_x and F_y. If only one horizontal axis is in the surface,
               the component named after the other horizontal axis is perpendicular to the first axis
    sliding    the coefficient of sliding friction mu: the friction mu N opposes the velocity of slip s of the material
               points. In space it is -mu N s/|s|, where s is not zero
    direction  "right", "left" or a vector. With `sliding`, the material point of the body slips over the surface in
               this direction. In space, `direction` is optional with `sliding`; leave it out if the coordinates allow
               other directions of slip. With a symbol of friction under `rolling` or `static`, the friction on the body
               is positive in this direction. `direction` is then allowed only for a motion in a plane
    static     the coefficient of static friction mu_s: the material points in contact do not move over each other, so
               a round body rolls. The friction must satisfy |F| <= mu_s N, or |F| <= mu_s |N| on a rail. In space, |F|
               is sqrt(F_x^2 + F_y^2)
    force      with `static`: the symbol of the friction F, in newtons, positive as for `rolling`
    key        with `rolling=True`: the key of the condition of rolling

    Equal and opposite forces act on the material points of the body and of the surface. The distance of a round body
    from the surface is the distance of its centre from the surface, minus the radius of the body. In space, a disc, a
    hoop, a cylinder or a cone touches a plane at the lowest point of a rim. Let e be the unit vector along the axis of
    the body, n the unit normal of the plane and R the radius of the rim. The distance of the body from the plane is
    then the distance of the centre of this rim from the plane, minus R sqrt(1 - (n.e)^2). A cone that lies on its side
    must be held at its apex. If a round body touches a curve, its centre is on the normal at the point of contact. A
    coordinate, such as the horizontal distance of this point from the origin of the curve, must describe this point.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 3 and 7; for a disc in
    space, Landau, Lifshitz, *Mechanics*, section 38.
    """
    touch = _contact(of, on)
    _check_carried(touch, bool(rolling) or sliding is not None or static is not None)
    if bool(rolling) + (sliding is not None) + (static is not None) > 1:
        message = "a body rolls, slides or sticks: give one of `rolling`, `sliding` and `static`"
        raise Rejected(Complaint("wrong-argument", message))
    found: list[Part] = []
    if not touch.is_kept:
        found.append(_normal(touch, normal))
    elif normal:
        _reject_normal(normal, touch)
    if rolling:
        found += _rolling(touch, rolling, direction, key)
    if sliding is not None:
        found.append(_sliding(touch, sliding, direction, normal or "N"))
    elif direction is not None and not isinstance(rolling, str) and static is None:
        message = "`direction` needs friction with a symbol or a coefficient, but neither is given"
        raise Rejected(Complaint("unused-key", message))
    if static is not None:
        found += _sticking(touch, force, direction, _static_limit(touch, static, normal))
    elif force:
        raise Rejected(Complaint("unused-key", "`force` is the symbol of the static friction, so it needs `static`"))
    return replace(touch, forces=tuple(_forces_of(touch, found))), *found


def point_of_contact(of: Any, on: Any) -> PointOfBody:
    """The material point at which a body touches a surface; `of` and `on` as in `contact`."""
    touch = _contact(of, on)
    return PointOfBody(touch.at.components, body=touch.of)


def _check_carried(touch: Contact, rough: bool) -> None:
    """Require a body that carries the surface if the surface, or the axes in which it is at rest, move with
    coordinates. With friction, also require such a body if no axes are given and the normal of a plane depends on the
    time."""
    surface = touch.surface
    turning = touch.normal.components if isinstance(surface, Plane) else ()
    axes = tuple(surface.moves.in_space) if isinstance(surface.moves, Axes) else ()
    moving = coordinates_in(ImmutableDenseMatrix([*axes, *surface.place.components, *turning, Integer(0)]))
    if surface.of is None and moving:
        message = (
            f"the surface moves with {next(iter(moving))}, but no body carries it, "
            "so the contact force on the surface would act on nothing"
        )
        help_line = (
            "in place of `in`, name the body that carries the surface, `of: disc`"
            if axes
            else ("name the body that carries the surface, `of: wedge`")
        )
        raise Rejected(Complaint("which-body", message, help=help_line))
    if rough and surface.of is None and not axes and any(depends_on_time(c) for c in turning):
        message = "the surface rotates, so the velocity of its material is unknown"
        raise Rejected(Complaint("wrong-argument", message, help="let a body carry the surface, `of: plate`"))
    _check_moves_with_its_material(surface)


def _check_moves_with_its_material(surface: Surface) -> None:
    """Reject a plane or circle whose shape does not move with the body that carries it, or with its rotating axes.

    A particle of a plane must stay on the plane: n . (v(p) - dp/dt) = 0 and dn/dt = omega x n. Here p is a place of the
    plane and n is its unit normal; v and omega are the velocity and the angular velocity of the material. A particle at
    the centre of a circle must stay at the centre.
    """
    if surface.of is None and not isinstance(surface.moves, Axes) or isinstance(surface, Curve):
        return
    place, material = surface.place, surface.ground
    apart = velocity_at(material, place) - velocity_at(place, place)
    moving = [dot(surface.unit_normal, apart)] if isinstance(surface, Plane) else [*apart.components]
    if isinstance(surface, Plane):
        n = surface.unit_normal
        turned = velocity_at(material, place + n) - velocity_at(material, place)
        moving += [*(velocity_at(n, n) - turned).components]
    if all(is_zero(tidied(c)) for c in moving):
        return
    who = "the rotating axes that are given for it" if surface.of is None else "the body that carries it"
    what = "`along` or `normal` is a vector in space, which must turn with the axes or the body, as in "
    help_line = (
        f"{what}`along: [cos(theta), sin(theta)]`; the place `through` must move with them"
        if isinstance(surface, Plane)
        else "the centre of the surface must move like a point of the axes, or of the body that carries the surface"
    )
    raise Rejected(Complaint("which-body", f"the surface does not move with {who}", help=help_line))


def _normal(touch: Contact, letter: str) -> Constraint:
    if not letter:
        message = "the coordinates allow the body to leave the surface, so a normal force must keep it there"
        raise Rejected(Complaint("missing-key", message, help="give the symbol of the normal force, `normal: N`"))
    force = scalar(letter)
    enforcer = "rail" if touch.surface.is_two_sided else "surface"
    pair = touch.pair(force, touch.normal)
    return Constraint(touch.gap, ZERO, force, forces=pair, enforcer=enforcer, gradient=touch.gradient)


def _forces_of(touch: Contact, parts: Sequence[Part]) -> Iterator[PointForce]:
    for part in parts:
        if isinstance(part, Constraint):
            yield from part.forces
        if isinstance(part, GivenForce):
            yield from touch.pair(Integer(1), Location(part.components))


def _contact(of: Any, on: Any) -> Contact:
    surface = on if isinstance(on, Surface) else _surface_of(on)
    at, body = end_of(of) if is_end(of) else (None, None)
    if at is None or body is None and (surface.of is None or coordinates_in(ImmutableDenseMatrix(at.components))):
        message = "`contact` needs a particle, a round body, a point of a body, or a fixed place on a carried surface"
        help_line = Spelled('give a point of the body: `rod.place_of("end")`', "give a point of the body: `rod.end`")
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    if isinstance(of, PlacedBody):
        place, gap, away = touching(of, surface)
        found = Contact((), body, place, surface, gap, away)
    else:
        found = Contact((), body, at, surface, surface.distance(at), surface.normal(at), surface.gradient(at))
    _check(found)
    _check_reached(found)
    return found


def _check_reached(touch: Contact) -> None:
    """Reject a body that is always away from the surface, or always at least partly behind the surface."""
    sign = sign_known(touch.gap)
    if sign in (1, -1):
        where = "always away from the surface" if sign == 1 else "always at least partly behind the surface"
        message = f"the body is {where}, since its distance from the surface is {touch.gap}"
        raise Rejected(Complaint("no-contact", message, help="change the place of the body, its size or the surface"))


def _check(touch: Contact) -> None:
    """Check that the normal is a unit vector, and that the place of contact and the body have the same distance from
    the surface along this normal."""
    if not is_zero(tidied(dot(touch.normal, touch.normal)) - 1):
        raise Unverified(Complaint("unverified", "the normal of a contact is not a unit vector"))
    if not _is_at_its_distance(touch):
        raise Unverified(Complaint("unverified", "the place of a contact is not on the surface of the body"))


def _is_at_its_distance(touch: Contact) -> bool:
    surface, gap = touch.surface, touch.gap / touch.gradient
    if isinstance(surface, Curve) and isinstance(touch.of, PlacedBody) and touch.gradient == 1:
        foot = touch.at - gap * touch.normal
        return is_zero(surface.distance(foot)) and is_zero(column_of(surface.normal(foot) - touch.normal))
    return is_zero(tidied(surface.height(touch.at, touch.normal) - gap))


def _surface_of(body: Any) -> Circle:
    if not isinstance(body, PlacedBody) or not has_radius(body):
        message = "`contact` needs a surface, or a round body whose rim is the surface"
        help_line = Spelled(
            "describe a face of the body: `plane(..., of=body)`",
            "describe a face of the body under `surfaces`, with `of`",
        )
        raise Rejected(Complaint("no-contact", message, help=help_line))
    return Circle(body, None, body.hub, radius_of(body))


def _reject_normal(letter: str, touch: Contact) -> None:
    where = ", ".join(map(str, touch.at.components))
    message = f"the coordinates keep the body on the surface at ({where}), so `{letter}` does not appear"
    help_line = "give the body a coordinate for its distance from the surface, so that the normal force keeps it there"
    raise Rejected(Complaint("not-an-unknown", message, help=help_line))


def _rolling(touch: Contact, rolling: str | bool, direction: Any, key: str) -> Sequence[Part]:
    rolls, ground = touch.of, touch.surface.ground
    if touch.of is None and isinstance(touch.surface.of, PlacedBody):
        rolls, ground = touch.surface.of, None  # a body whose surface touches a fixed corner
    if not isinstance(rolls, PlacedBody):
        raise Rejected(Complaint("wrong-argument", "a particle does not roll", help="leave out `rolling`"))
    if touch.is_kept and rolling is True:
        if not any(contact_velocity(rolls, touch.at, ground)):
            return []  # the coordinates already satisfy the condition of rolling
        found = no_slip(rolls, touch.at, ground, key)
        return list(found) if isinstance(found, tuple) else [found]
    if not isinstance(rolling, str):
        message = "the coordinates allow the body to leave the surface, so rolling needs a friction force with a symbol"
        raise Rejected(Complaint("missing-key", message, help="give the symbol of the friction, `{rolling: F}`"))
    return _sticking(touch, rolling, direction)


def _sticking(touch: Contact, symbol: str, direction: Any = None, limit: StaticLimit | None = None) -> list[Constraint]:
    """Return the constraints on the rates that friction enforces: the material points in contact do not move over
    each other. A constraint is left out if it always holds."""
    if not symbol:
        message = "static friction needs the symbol of its force"
        raise Rejected(Complaint("missing-key", message, help="give it as `force`, `{static: mu_s, force: F}`"))
    ground = touch.surface.ground
    slip = velocity_at(touch.of, touch.at) - velocity_at(ground, touch.foot)
    of_particles = Location(tuple(velocity_of_particle(touch.of, touch.at, ground, touch.foot)))
    constraints = []
    for letter, way in _frictions(touch, symbol, direction).items():
        along = tidied(dot(way, slip))
        if not is_zero(tidied(along - dot(way, of_particles))):
            message = "the slip is not the relative velocity of the particles in contact"
            raise Unverified(Complaint("unverified", message))
        pair = touch.pair(letter, way)
        constraints.append(
            Constraint(along, ZERO, letter, in_rates=True, forces=pair, enforcer="friction", limit=limit)
        )
    moving = [each for each in constraints if not is_zero(each.left)]
    if not moving:
        message = f"the coordinates keep the body from slipping, so the friction `{symbol}` does not appear"
        help_line = "leave this friction out, or give the body coordinates that allow it to slip"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    return moving


def _frictions(touch: Contact, letter: str, direction: Any) -> dict[Symbol, Location]:
    """Return the symbols of the components of friction, each with the direction in which it is positive."""
    if len(touch.at.components) == 2:
        return {scalar(letter): touch.tangent if direction is None else _along(touch, direction)}
    if direction is not None:
        message = "in space, the components of friction are along axes, so `direction` has no effect"
        raise Rejected(Complaint("unused-key", message, help="leave it out"))
    return {scalar(f"{letter}_{axis}"): way for axis, way in _ways_along(touch).items()}


def _ways_along(touch: Contact) -> dict[str, Location]:
    """Return perpendicular unit vectors along a surface in space, by the names of axes.

    If two axes are in the surface, the vectors are along these axes. Otherwise one vector is along a horizontal axis in
    the surface. The other vector is perpendicular to it, and has the name of the other horizontal axis. If the normal
    rotates with the axes of the surface, the vectors are along these axes, otherwise along the axes in space.
    """
    turn = eye(3)
    if isinstance(touch.surface.moves, Axes) and any(map(depends_on_time, touch.normal.components)):
        turn = touch.surface.moves.in_space
    return {axis: Location(tuple(turn * way)) for axis, way in _ways_across(turn.T * column_of(touch.normal)).items()}


def _ways_across(normal: ImmutableMatrix) -> dict[str, ImmutableMatrix]:
    n = [tidied(c) for c in normal]
    flat = {i: eye(3)[:, i] for i in range(3) if is_zero(n[i])}
    if len(flat) == 2:
        return {"xyz"[i]: way for i, way in flat.items()}
    if 0 in flat:
        return {"x": flat[0], "y": ImmutableDenseMatrix((ZERO, n[2], -n[1]))}
    if 1 in flat:
        return {"x": ImmutableDenseMatrix((n[2], ZERO, -n[0])), "y": flat[1]}
    message = "in space, the components of friction are along axes, but no horizontal axis is in this surface"
    help_line = (
        "use a plane that contains the direction of x or y; on a sphere, friction without slipping is not available"
    )
    raise Rejected(Complaint("wrong-argument", message, help=help_line))


def _static_limit(touch: Contact, coefficient: Any, normal: str) -> StaticLimit:
    mu = _coefficient(touch, coefficient, normal or "N")
    if sign_known(mu) != 1:
        message = f"the coefficient of static friction {mu} is not known to be positive"
        raise Rejected(Complaint("sign", message, help="declare its letter as `positive number`"))
    return StaticLimit(mu, scalar(normal), of_rail=touch.surface.is_two_sided, in_space=len(touch.at.components) == 3)


def _along(touch: Contact, direction: Any) -> Location:
    """Return the unit vector along the surface in a direction."""
    if direction in ("right", "left"):
        upwards = sign_known(touch.normal.components[1]) if len(touch.normal.components) == 2 else None
        if upwards not in (1, -1):
            message = f"the direction along the surface that points to the {direction} is unknown"
            raise Rejected(Complaint("wrong-argument", message, help="give the components of `direction`"))
        return touch.tangent if (upwards == 1) == (direction == "right") else -touch.tangent
    along = unit("contact", vector("contact", direction, touch.at))
    if not is_zero(ImmutableDenseMatrix([tidied(dot(along, touch.normal))])):
        raise Rejected(Complaint("wrong-argument", "`direction` must be along the surface"))
    return along


def _sliding(touch: Contact, coefficient: Any, direction: Any, letter: str) -> GivenForce:
    """Return the friction mu N on the body, against the velocity of slip; the opposite force acts on the surface."""
    mu = _coefficient(touch, coefficient, letter)
    if touch.surface.is_two_sided:
        message = f"the normal force `{letter}` of a rail may have either sign, so the sign of mu {letter} is unknown"
        raise Rejected(Complaint("wrong-argument", message, help="describe a surface, without `side: both`"))
    slip = velocity_at(touch.of, touch.at) - velocity_at(touch.surface.ground, touch.foot)
    slip = slip - dot(touch.normal, slip) * touch.normal  # during the contact, the component along the normal is zero
    is_free = direction is None and len(slip.components) == 3
    along = _way_of_slip(slip) if is_free else _along_slip(touch, direction, slip)
    _check_rubbing(touch, along, is_free)
    force = tuple(-mu * scalar(letter) * c for c in along.components)
    by = touch.surface.of if touch.surface.of is not None else GROUND
    return GivenForce(force, touch.at.components, touch.of, by)


def _way_of_slip(slip: Location) -> Location:
    """Return the unit vector along a velocity of slip in space, which is assumed not to be zero."""
    ways = [tidied(c) for c in slip.components]
    square = tidied(Add(*(c**2 for c in ways)))
    unsure = (each for each in Mul.make_args(square) if not each.is_positive)
    assume(Relation(Mul(*unsure), "!=", ZERO))
    return Location(tuple(c / sqrt(square) for c in ways))


def _check_rubbing(touch: Contact, along: Location, is_free: bool) -> None:
    """Check that the velocity of slip is parallel to the given unit vector and, if `is_free`, has its direction."""
    rubbing = Location(tuple(velocity_of_particle(touch.of, touch.at, touch.surface.ground, touch.foot)))
    rubbing = rubbing - dot(touch.normal, rubbing) * touch.normal
    speed = tidied(dot(along, rubbing))
    wrong = [rubbing - speed * along, dot(along, along) * along - along]
    is_along = all(is_zero(tidied(c)) for each in wrong for c in each.components)
    if not is_along or is_free and not is_zero(tidied(speed - sqrt(tidied(dot(rubbing, rubbing))))):
        message = "the friction is not opposite to the relative velocity of the particles in contact"
        raise Unverified(Complaint("unverified", message))


def _along_slip(touch: Contact, direction: Any, slip: Location) -> Location:
    if direction is None:
        message = "sliding friction needs the direction in which the body slips over the surface"
        raise Rejected(Complaint("missing-key", message, help="give it as `direction`, for example `[1, 0]`"))
    along = _along(touch, direction)
    speed = tidied(dot(along, slip))
    if any(tidied(c) != 0 for c in (slip - speed * along).components):
        message = "the coordinates also allow the body to slip across `direction`, so the friction may be oblique to it"
        help_line = "leave `direction` out: the friction is then opposite to the velocity of slip"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    signed = Mul(*(factor for factor in Mul.make_args(speed) if not factor.is_positive))
    assume(Relation(signed, ">", ZERO))  # otherwise the friction has the opposite direction
    return along


def _coefficient(touch: Contact, coefficient: Any, letter: str) -> Expr:
    """Return a coefficient of friction. The normal force, which the coefficient multiplies, must be a constraint force:
    the coordinates alone must not keep the body on the surface."""
    mu = as_expr(coefficient)
    require_constant("contact", "coefficient of friction", mu)
    if touch.is_kept:
        message = f"the coordinates keep the body on the surface, so the normal force `{letter}` does not appear"
        help_line = f"give the body a coordinate for its distance from the surface, and write `normal: {letter}`"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    return mu
