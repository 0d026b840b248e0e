"""The position and orientation of a body. The position is the place of the centre of mass, or of another given point.

The orientation in space is a set of axes. In a plane the orientation is an angle about the normal, positive
counterclockwise. One body axis is perpendicular to the plane and points towards the reader. At zero angle, the two body
axes after this axis in the cyclic order x, y, z are along the axes of the plane.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from operator import mul
from typing import Any, ClassVar

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol, cos, sin
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import as_expr, column, depends_on_time, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled, with_article
from derive.mechanics.bodies.boundary import Boundary
from derive.mechanics.bodies.regions import Point
from derive.mechanics.kinematics.places import Axes, Location, turn_about
from derive.steps.record import coordinates_in

__all__: list[str] = []

XYZ = "xyz"


@dataclass(frozen=True)
class PlacedBody:
    """A body with its position and its orientation.

    body     an object with a mass, a centre of mass and moments of inertia
    turned   the axes of the body; for a motion in a plane, the angle
    point    a point of the body
    at       the place of this point
    across   for a motion in a plane, the index of the body axis perpendicular to the plane
    rim      for a motion in a plane, the centre and the radius of the circle that bounds a body of unknown shape
    """

    body: Any
    turned: Axes | Expr
    point: Point
    at: Location
    across: int | None = None
    rim: tuple[Location, Expr] | None = None

    def with_rim(self, centre: Location, radius: Expr) -> PlacedBody:
        """Return the body with the circle that bounds it; the centre of the circle must be fixed in the body."""
        if not self.is_plane:
            raise Rejected(Complaint("wrong-argument", "a body can have a `rim` only if it moves in a plane"))
        x, y = (centre - self.at).components
        c, s = cos(self.turned), sin(self.turned)
        own = ImmutableDenseMatrix([tidied(x * c + y * s), tidied(y * c - x * s)])
        if coordinates_in(own) or depends_on_time(own):
            message = "the centre of the `rim` does not move with the body"
            help_line = (
                "measure the centre of mass from the centre of the rim: `{from: axis, by: [a*cos(phi), a*sin(phi)]}`"
            )
            raise Rejected(Complaint("no-such-body", message, help=help_line))
        return replace(self, rim=(centre, radius))

    @property
    def hub(self) -> Location:
        """The centre of the rim if there is one; otherwise the centre of mass."""
        return self.rim[0] if self.rim is not None else self.centre

    @property
    def is_plane(self) -> bool:
        return not isinstance(self.turned, Axes)

    def seen_in_space(self, arm: ImmutableMatrix) -> Location:
        """Convert a vector from body axes to axes fixed in space or in the plane."""
        if isinstance(self.turned, Axes):
            return Location(tuple(self.turned.in_space * arm))
        j, k = self.in_plane
        c, s = cos(self.turned), sin(self.turned)
        return Location((arm[j] * c - arm[k] * s, arm[j] * s + arm[k] * c))

    def carries(self, arm: Location) -> bool:
        """Whether a vector in space turns with the body: its components along the body axes are constant."""
        axes = [self.seen_in_space(ImmutableDenseMatrix([int(i == n) for i in range(3)])) for n in range(3)]
        own = ImmutableDenseMatrix([tidied(Add(*map(mul, arm.components, axis.components))) for axis in axes])
        return not coordinates_in(own) and not depends_on_time(own)

    @property
    def in_plane(self) -> tuple[int, int]:
        i = self.across or 0
        return (i + 1) % 3, (i + 2) % 3

    @cached_property
    def centre(self) -> Location:
        """The place of the centre of mass."""
        arm = ImmutableDenseMatrix((self.body.middle.position - self.point.position).expand())
        return self.at + self.seen_in_space(arm) if any(arm) else self.at

    @property
    def is_held(self) -> bool:
        """Whether the place `at` is at rest."""
        here = ImmutableDenseMatrix(self.at.components)
        return not coordinates_in(here) and not depends_on_time(here)

    def place_of(self, point: Any) -> PointOfBody:
        """The place of a point that moves with the body.

        point   the point, by its name or by components along the body axes
        """
        arm = ImmutableDenseMatrix((_point_of(self.body, point).position - self.point.position).expand())
        place = self.at + self.seen_in_space(arm) if any(arm) else self.at
        return PointOfBody(tuple(tidied(c) for c in place.components), body=self)

    def moved(self, values: Mapping[Symbol, Expr]) -> PlacedBody:
        """The same body with expressions substituted for some coordinates."""
        at = self.at.with_values(values)
        rim = (self.rim[0].with_values(values), self.rim[1].subs(values)) if self.rim is not None else None
        if not isinstance(self.turned, Axes):
            return replace(self, at=at, turned=self.turned.subs(values), rim=rim)
        turns = tuple((i, angle.subs(values)) for i, angle in self.turned.turns)
        return replace(self, at=at, turned=Axes(after(turns), turns))

    @property
    def depends_on(self) -> ImmutableMatrix:
        """The components of the position, then the entries of the rotation matrix or the angle, as one column."""
        turning = list(self.turned.in_space) if isinstance(self.turned, Axes) else [self.turned]
        return ImmutableDenseMatrix([*self.at.components, *turning])


@dataclass(frozen=True)
class PointOfBody(Location):
    """The place of a material point of a body."""

    body: Any = None

    def with_values(self, values: Any) -> PointOfBody:
        found = super().with_values(values)
        return self if found is self else PointOfBody(found.components, body=self.body.moved(values))


def body_at(place: Any, stated: Any = None) -> Any:
    """Return the stated body. If none is stated, return the body to which a place from `place_of` belongs, or None for
    any other place."""
    return place.body if stated is None and isinstance(place, PointOfBody) else stated


def after(turns: tuple[tuple[int, Expr], ...]) -> ImmutableMatrix:
    """The matrix of successive rotations. Each rotation is about a body axis, which the earlier rotations have
    already turned."""
    whole = turn_about(0, Integer(0))
    for i, angle in turns:
        whole = ImmutableDenseMatrix(whole * turn_about(i, angle))
    return whole


class Placeable:
    """A base class of bodies that can have a position and an orientation."""

    id: ClassVar[str] = "body"  # the sort of body, in files and in phrases, such as "thick_shell"
    name: ClassVar[str] = "a body"  # the sort of body in messages, made from `id`

    @property
    def boundary(self) -> Boundary | None:
        """The boundary of the body, for a drawing; None if no boundary is known, as for a body with parts."""
        return None

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.name = with_article(cls.id)

    def placed(self, turned: Any, centre: Location, across: str | None = None) -> PlacedBody:
        """Return the body with its centre of mass at a place. Axes give the orientation in space; an angle gives the
        orientation in a plane.

        across   the body axis perpendicular to the plane of motion; needed only if this axis is ambiguous
        """
        own: Any = self
        return _placed(own, turned, own.middle, centre, across)

    def held(self, turned: Any, at: Any, on: Location | None = None, across: str | None = None) -> PlacedBody:
        """Return the body held at one of its points.

        at   the point, by its name or by components along the body axes
        on   the place of this point, by default the origin
        """
        origin = Location((Integer(0),) * (3 if isinstance(turned, Axes) else 2))
        return _placed(self, turned, _point_of(self, at), on or origin, across)


def _point_of(body: Any, components: Any) -> Point:
    if isinstance(components, str):
        by_name = getattr(body, "point_called", None) or body.point
        named: Point = by_name(components)
        return named
    if not isinstance(components, tuple | list) or len(components) != 3:
        message = "give a point of a body by its name, or by three components along its axes"
        raise Rejected(Complaint("wrong-argument", message))
    return Point("point", column(*components))


def _placed(body: Any, turned: Any, point: Point, at: Any, across: str | None) -> PlacedBody:
    if not isinstance(at, Location):
        raise Rejected(Complaint("wrong-argument", "the place of a body must come from `point` or `place`"))
    count = 3 if isinstance(turned, Axes) else 2
    if len(at.components) != count:
        message = "if `turned` is a set of axes, the place needs three components; if `turned` is an angle, two"
        raise Rejected(Complaint("wrong-argument", message))
    if isinstance(turned, Axes):
        if getattr(body, "is_plane", False):
            message = f"only one moment of {body.name} is known, so the body can only move in a plane"
            raise Rejected(Complaint("wrong-argument", message, help="give its three principal moments"))
        return PlacedBody(body, turned, point, at)
    try:
        angle = explicit(as_expr(turned))
    except TypeError:
        raise Rejected(Complaint("wrong-argument", "`turned` must be a set of axes or an angle")) from None
    number = _across(body, across)
    _check_turns(body, number, angle)
    if across is None:
        _check_flat(body, number)
    return PlacedBody(body, angle, point, at, number)


def _check_turns(body: Any, number: int, angle: Expr) -> None:
    """Reject a rotation without moment of inertia, such as the rotation of a rod about its own axis."""
    spread = central_second_moments(body)
    j, k = (number + 1) % 3, (number + 2) % 3
    if coordinates_in(angle) and tidied(spread[j, j] + spread[k, k]) == 0:
        message = (
            f"{body.name} has no moment of inertia about its {XYZ[number]} axis, "
            "so the body cannot turn about this axis"
        )
        raise Rejected(Complaint("wrong-axis", message, help="put another axis of the body perpendicular to the plane"))


def _check_flat(body: Any, number: int) -> None:
    """Reject the default axis perpendicular to the plane if the body extends along this axis, unless all axes of the
    body are equivalent."""
    if tidied(central_second_moments(body)[number, number]) != 0 and not _is_isotropic(body):
        message = (
            f"{body.name} extends along its {XYZ[number]} axis, so the axis perpendicular to the plane is ambiguous"
        )
        raise Rejected(
            Complaint(
                "wrong-axis", message, help=Spelled('write `across="x"`, "y" or "z"', "write `across: x`, `y` or `z`")
            )
        )


def _across(body: Any, named: str | None) -> int:
    """The index of the body axis perpendicular to the plane: the named axis, or the axis that the shape determines. The
    default is z if the moment about only one axis is known, or if all axes of the body are equivalent."""
    if named is not None and named not in tuple(XYZ):
        message = f'a body has no axis "{named}"'
        raise Rejected(Complaint("wrong-argument", message, help='it has "x", "y", "z"'))
    flat = getattr(body, "flat_across", None)
    straight = "x" if getattr(body, "filling", "") == "length" else None
    found = named or flat or straight or ("z" if getattr(body, "is_plane", False) or _is_isotropic(body) else None)
    if found is None:
        message = f"the axis about which {body.name} turns in the plane is ambiguous"
        raise Rejected(
            Complaint(
                "wrong-axis", message, help=Spelled('write `across="x"`, "y" or "z"', "write `across: x`, `y` or `z`")
            )
        )
    return XYZ.index(found)


def _is_isotropic(body: Any) -> bool:
    spread = central_second_moments(body)
    return all(tidied(spread[i, j] - (spread[0, 0] if i == j else 0)) == 0 for i in range(3) for j in range(i, 3))


def central_second_moments(body: Any) -> ImmutableMatrix:
    """The sums of m r_i r_j over the particles of a body, kg m^2, with r measured from its centre of mass."""
    own = getattr(body, "central_second_moments", None)
    if own is not None:
        found: ImmutableMatrix = own
        return found
    centre = body.middle.position
    whole = ImmutableDenseMatrix.zeros(3, 3)
    for mass, place in body.particles():
        arm = place - centre
        whole = whole + mass * arm * arm.T
    return ImmutableDenseMatrix(whole.applyfunc(tidied))
