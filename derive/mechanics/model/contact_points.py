"""Where a round body touches a surface: the place, the distance of the body from the surface, and the unit normal."""

from __future__ import annotations

from collections.abc import Iterator

from sympy import Expr, ImmutableDenseMatrix, Integer, Mul, Symbol, cos, diff, sin, sqrt, tan

from derive.algebra.expressions import Relation
from derive.algebra.relation import sides_without_minus
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled, Unverified
from derive.mechanics.bodies.boundary import Hollowed, Round
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.model.surfaces import Curve, Plane, Surface, column_of, direction_between, dot, help_to_sign
from derive.steps.record import assume, coordinates_in
from derive.steps.signs import sign_for_all, sign_known
from derive.steps.step import is_zero

ZERO = Integer(0)


def touching(placed: PlacedBody, surface: Surface) -> tuple[Location, Expr, Location]:
    """Return the place where a round body touches a surface, the distance of the body from the surface, and the unit
    normal."""
    if surface.is_two_sided:
        message = "a round body can touch a plane, a curve, a circle or a sphere, but not a rail"
        raise Rejected(Complaint("no-contact", message, help="let a particle or a point of the body touch the rail"))
    hub = placed.hub
    if isinstance(surface, Curve):
        foot, distance = _foot(placed, surface)
        _assume_that_it_fits(placed, surface, foot)
        away, gap = surface.normal(foot), tidied(distance - radius_of(placed))
        return foot + gap * away, gap, away
    away = surface.normal(hub)
    if _has_rims(placed):
        place, gap = lowest(placed, surface)
        _check_lowest(placed, surface, place, gap)
    else:
        place, gap = hub - radius_of(placed) * away, surface.distance(hub) - radius_of(placed)
    return Location(tuple(tidied(c) for c in place.components)), tidied(gap), away


def _foot(placed: PlacedBody, curve: Curve) -> tuple[Location, Expr]:
    """Return the place on a curve where the normal passes through the centre of a round body, and the distance of the
    centre from this place."""
    for foot in _feet(placed, curve):
        normal = curve.normal(foot)
        distance = tidied(dot(normal, placed.hub - foot))
        if sign_known(distance) == 1 and is_zero(column_of(placed.hub - foot - distance * normal)):
            return foot, distance
    message = f"the place where {placed.body.name} touches the curve is unknown: a coordinate must describe this place"
    help_line = (
        "use a coordinate x for the horizontal distance of the point of contact from the origin of the curve; the "
        "centre of a body above the curve is then at [x - R*f'/sqrt(1 + f'**2), f + R/sqrt(1 + f'**2)]; if a "
        "normal force is needed, write a positive length h instead of R"
    )
    raise Rejected(Complaint("no-contact", message, help=help_line))


def _feet(placed: PlacedBody, curve: Curve) -> Iterator[Location]:
    """Yield places of the curve that a round body may touch.

    First come the places whose horizontal distance from the origin of the curve is a coordinate of the body. For each
    other place, one coordinate or one symbol of the radius is replaced by zero in the place of the centre of the body.
    Only the places on the curve are yielded.
    """
    moving = coordinates_in(column_of(placed.hub))
    yield from (curve.point(q) for q in moving)
    for length in (*moving, *radius_of(placed).free_symbols):
        foot = placed.hub.with_values({length: ZERO})
        if is_zero(curve.distance(foot)):
            yield foot


def _assume_that_it_fits(placed: PlacedBody, curve: Curve, foot: Location) -> None:
    """Assume that a round body fits into the curve. Where the curve bends towards the body, the radius of the body must
    be less than the radius of curvature at the point of contact."""
    bends = diff(curve.formula, curve.letter, 2).xreplace({curve.letter: (foot - curve.through).components[0]})
    room = tidied(curve.gradient(foot) ** 3 - radius_of(placed) * (-bends if curve.below else bends))
    if sign_for_all(room) != 1:
        factors = (factor for factor in Mul.make_args(room) if sign_known(factor) != 1)
        more, less = sides_without_minus(Mul(*factors))
        assume(Relation(more, ">", less))


def _has_rims(placed: PlacedBody) -> bool:
    """Whether the outer shape of a body in space is the convex hull of one or two circles, as for a disc, a hoop, a
    cylinder or a cone.
    """
    outline = _outline(placed)
    return not placed.is_plane and outline is not None and outline.is_straight and not outline.is_line


def _outline(placed: PlacedBody) -> Round | None:
    """Return the outer boundary of a body if this boundary is round, otherwise None."""
    boundary = placed.body.boundary
    outer = boundary.whole if isinstance(boundary, Hollowed) else boundary
    return outer if isinstance(outer, Round) else None


def lowest(placed: PlacedBody, surface: Surface) -> tuple[Location, Expr]:
    """Find the point of a body with rims that is nearest to a plane. Return this point, and its distance from the
    plane.

    The body is the convex hull of its rims, so the nearest point is on a rim. The vector from the centre of the rim to
    this point is one radius long. It is opposite to the projection of the normal of the plane onto the plane of the
    rim.
    """
    if not isinstance(surface, Plane) or not isinstance(placed.turned, Axes):
        message = f"in space, the point where {placed.body.name} touches a surface is known only for a plane"
        raise Rejected(Complaint("no-contact", message, help="give a plane, or a point of the body"))
    axis, n = Location(tuple(placed.turned.in_space[:, 2])), surface.unit_normal
    along = n - dot(n, axis) * axis
    if is_zero(ImmutableDenseMatrix(along.components)):
        message = f"{placed.body.name} lies flat on the plane, so the point where it touches the plane is unknown"
        raise Rejected(Complaint("no-contact", message, help="give a point of the body"))
    way = direction_between(Location((ZERO, ZERO, ZERO)), along)
    rims = []
    for z, radius in _rims(placed):
        centre = placed.place_of((ZERO, ZERO, z))
        rims.append((centre - radius * way, surface.distance(centre) - radius * dot(n, way)))
    return rims[0] if len(rims) == 1 else _lower(placed, *rims)


def _rims(placed: PlacedBody) -> list[tuple[Expr, Expr]]:
    """Return the height along the axis and the radius of each rim."""
    outline = _outline(placed)
    assert outline is not None
    radii = {z: outline.radius_at(z).replace(tan, lambda angle: sin(angle) / cos(angle)) for z in outline.ends}
    return list(radii.items())


def _check_lowest(placed: PlacedBody, plane: Surface, place: Location, gap: Expr) -> None:
    """Check that the place of contact is on a rim of the body, and that no place on a rim is nearer to the plane.

    On a rim of radius r, the lowest place is r sin(a) below the centre of the rim, where a is the angle between the rim
    and the plane.
    """
    middle = _own(placed, ZERO, ZERO, ZERO)
    along, across, axis = (_own(placed, *map(Integer, own)) - middle for own in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    n = plane.normal(place)
    square = dot(n, along) ** 2 + dot(n, across) ** 2
    rims = [(radius, _own(placed, ZERO, ZERO, z)) for z, radius in _rims(placed)]

    def is_lowest(radius: Expr, centre: Location) -> bool:
        arm = place - centre
        sine = tidied(sqrt(tidied(square)) if is_zero(radius) else -dot(n, arm) / radius)
        heights = (plane.distance(each) - r * sine - gap for r, each in rims)
        return (
            is_zero(dot(arm, arm) - radius**2)
            and is_zero(dot(arm, axis))
            and is_zero(sine**2 - square)
            and sign_known(sine) == 1
            and all(sign_known(tidied(height)) in (0, 1) for height in heights)
        )

    if not any(is_lowest(*rim) for rim in rims):
        message = "the place of a contact could not be shown to be the lowest point of the body"
        raise Unverified(Complaint("unverified", message, help="choose the axes so that x or y is along the surface"))


def _own(placed: PlacedBody, *own: Expr) -> Location:
    """Return the place of a point that has these components along the axes of the body."""
    return placed.at + placed.seen_in_space(ImmutableDenseMatrix(own) - placed.point.position)


def _lower(placed: PlacedBody, one: tuple[Location, Expr], other: tuple[Location, Expr]) -> tuple[Location, Expr]:
    """Return the lower of the lowest points of two rims, each given with its distance from the plane.

    If the distances are equal, the body touches the plane along the line between the two points. The body must then be
    held at one of these points, and the other point is returned.
    """
    difference = tidied(one[1] - other[1])
    sign = sign_known(difference)
    if sign is None:
        message = f"it is unknown which end of {placed.body.name} touches the plane: the sign of {difference} decides"
        help_line = help_to_sign(difference, [*coordinates_in(ImmutableDenseMatrix([difference]))])
        raise Rejected(Complaint("no-contact", message, help=help_line))
    if sign:
        return one if sign < 0 else other
    for held, free in ((one, other), (other, one)):
        if placed.is_held and is_zero(ImmutableDenseMatrix((held[0] - placed.at).components)):
            return free
    message = f"{placed.body.name} touches the plane along a line, so the contact forces do not act at a single point"
    raise Rejected(Complaint("no-contact", message, help="hold an end of this line, such as the apex of a cone"))


def radius_of(placed: PlacedBody) -> Expr:
    """Return the radius of a body that is round in the plane of motion, or of a ball; reject other bodies."""
    radius = _round_radius(placed)
    if radius is None:
        shape = "round in the plane of motion" if placed.is_plane else "a ball"
        message = f"{placed.body.name} is not {shape}, so the point where it touches the surface is unknown"
        help_line = Spelled(
            'give a point of the body: `rod.place_of("end")`',
            "give a point of the body, `rod.end`, or describe the body by `moments` and its `rim`",
        )
        raise Rejected(Complaint("no-contact", message, help=help_line))
    return radius


def has_radius(placed: PlacedBody) -> bool:
    """Whether a body is round in the plane of motion, or a ball in space."""
    return _round_radius(placed) is not None


def _round_radius(placed: PlacedBody) -> Expr | None:
    if placed.rim is not None:
        return placed.rim[1]
    outer = _outline(placed)
    if outer is None or placed.across not in (2, None):
        return None
    z = Symbol("z_along", real=True)
    middle = (outer.ends[0] + outer.ends[1]) / 2
    radius = outer.radius_at(middle)
    is_widest = is_zero(outer.radius_at(z).diff(z).subs(z, middle))
    is_ball = is_zero(outer.radius_at(z) ** 2 + (z - middle) ** 2 - radius**2)
    return radius if is_ball or is_widest and placed.across == 2 else None
