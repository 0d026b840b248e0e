"""Solids besides block, cone, cylinder and ball: hemisphere, half-cylinder, ellipsoid, torus, tetrahedron, wedge."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, cos, pi, sin, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Factors, column
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.body import EdgedBody
from derive.mechanics.bodies.equimomental import (
    Particles,
    disc_of_particles,
    drawn_out,
    ring_of_particles,
    sliced,
    stretched,
)
from derive.mechanics.bodies.flat_shapes import CORNERS, HALF, ORIGIN, ZERO, HalfDisc, Triangle, require_order
from derive.mechanics.bodies.hollow_shapes import on_sphere
from derive.mechanics.bodies.mapping import Mapped
from derive.mechanics.bodies.regions import Bounds, Point, coordinates
from derive.mechanics.bodies.solids import Ball, RoundSolid

__all__ = ["Ellipsoid", "HalfCylinder", "Hemisphere", "Tetrahedron", "Torus", "Wedge"]


@dataclass(frozen=True)
class Hemisphere(RoundSolid):
    """Half of a uniform ball, where z is positive; the centre of its base is at the origin.

    radius   length
    mass     mass
    Points: base (its centre), centre.
    """

    radius: Expr
    mass: Expr
    name: ClassVar[str] = "a hemisphere"
    seen_as: ClassVar[str] = "half of a ball"
    reference: ClassVar[str] = "base"

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return ZERO, self.radius

    def radius_at(self, z: Expr) -> Expr:
        return sqrt(self.radius**2 - z**2)

    @property
    def extent(self) -> Expr:
        return Factors(Rational(2, 3), pi, self.radius**3)

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """Pythagoras: the edge is at the distance R from the centre of the base."""
        return r**2 + z**2, self.radius**2

    def points(self) -> Mapping[str, Point]:
        return {"base": Point("base", ORIGIN)}

    def particles(self) -> Particles:
        """Discs whose masses are as the squares of their radii."""
        return sliced(self.mass, self.ends, self.radius_at, lambda z: self.radius**2 - z**2)


@dataclass(frozen=True)
class HalfCylinder(Mapped):
    """Half of a uniform cylinder about the z axis, where y is positive, from z = 0 to z = height.

    radius   length
    height   length
    mass     mass
    Points: circle_centre (of the half-disc at the origin), centre.
    """

    radius: Expr
    height: Expr
    mass: Expr
    name: ClassVar[str] = "a half-cylinder"
    is_lopsided: ClassVar[bool] = True
    reference: ClassVar[str] = "circle_centre"

    @property
    def extent(self) -> Expr:
        return Factors(HALF, pi, self.radius**2, self.height)

    def points(self) -> Mapping[str, Point]:
        return {"circle_centre": Point("circle_centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        z, theta, r = coordinates(("z", "theta", "r"), self.radius.free_symbols | self.height.free_symbols)
        limits = ((z, ZERO, self.height), (theta, ZERO, pi), (r, ZERO, self.radius))
        return column(r * cos(theta), r * sin(theta), z), limits

    def particles(self) -> Particles:
        """Half-discs of equal mass at equal heights."""
        return drawn_out(HalfDisc(self.radius, self.mass).particles(), (ZERO, self.height))


@dataclass(frozen=True)
class Ellipsoid(Mapped):
    """A uniform ellipsoid about the origin, its axes along x, y and z.

    semi_axes   three lengths
    mass        mass
    """

    semi_axes: tuple[Expr, Expr, Expr]
    mass: Expr
    name: ClassVar[str] = "an ellipsoid"

    @property
    def extent(self) -> Expr:
        return Factors(Rational(4, 3), pi, *self.semi_axes)

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        """A ball of radius 1, stretched along each axis."""
        taken = {s for axis in self.semi_axes for s in axis.free_symbols}
        r, theta, phi = coordinates(("r", "theta", "phi"), taken)
        place = column(*(a * x for a, x in zip(self.semi_axes, on_sphere(r, theta, phi), strict=True)))
        return place, ((r, ZERO, Integer(1)), (theta, ZERO, pi), (phi, ZERO, 2 * pi))

    def particles(self) -> Particles:
        """Those of a ball of radius 1, stretched as the ball is."""
        return stretched(Ball(Integer(1), self.mass).particles(), self.semi_axes)


@dataclass(frozen=True)
class Torus(Mapped):
    """A uniform ring of round cross-section about the z axis, its centre at the origin.

    radius    from the axis to the middle of the cross-section, length
    section   radius of the cross-section, length
    mass      mass
    """

    radius: Expr
    section: Expr
    mass: Expr
    name: ClassVar[str] = "a torus"
    is_round: ClassVar[bool] = True

    def __post_init__(self) -> None:
        require_order(self.name, self.section, self.radius)

    @property
    def extent(self) -> Expr:
        """By Pappus, the area of the cross-section times the way of its middle."""
        return Factors(2, pi**2, self.radius, self.section**2)

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        """By the distance s from the middle of the cross-section, the angle round it, and the angle about the axis."""
        s, u, phi = coordinates(("s", "u", "phi"), self.radius.free_symbols | self.section.free_symbols)
        across = self.radius + s * cos(u)
        limits = ((s, ZERO, self.section), (u, ZERO, 2 * pi), (phi, ZERO, 2 * pi))
        return column(across * cos(phi), across * sin(phi), s * sin(u)), limits

    def particles(self) -> Particles:
        """Rings through the five particles of the cross-section, each with a mass that grows as its radius."""
        found: Particles = []
        for share, place in disc_of_particles(self.mass, self.section, ZERO):
            radius = self.radius + place[0]
            found += ring_of_particles(share * radius / self.radius, radius, place[1])
        return found


def _height_over(corners: tuple[ImmutableMatrix, ...]) -> Expr:
    """Six times the volume of a tetrahedron, with a sign: the determinant of three edges."""
    first, *others = corners
    return tidied(ImmutableDenseMatrix.hstack(*(ImmutableDenseMatrix(c - first) for c in others)).det())


@dataclass(frozen=True)
class Tetrahedron(Mapped, EdgedBody):
    """A uniform solid with four corners.

    corners_at   four places (x, y, z), lengths
    mass         mass
    Points: first corner, ..., fourth corner; centre.
    """

    corners_at: tuple[tuple[Any, Any, Any], ...]
    mass: Expr
    name: ClassVar[str] = "a tetrahedron"
    reference: ClassVar[str] = "first corner"

    def __post_init__(self) -> None:
        if len(self.corners_at) != 4 or _height_over(self.corners) == 0:
            message = "a tetrahedron needs four corners that are not in one plane"
            raise Rejected(Complaint("sizes", message))

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        return tuple(column(*corner) for corner in self.corners_at)

    @property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        return (0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)

    @property
    def measures(self) -> Mapping[str, Any]:
        return {}

    @property
    def extent(self) -> Expr:
        sixfold = _height_over(self.corners)
        return (-sixfold if sixfold.could_extract_minus_sign() or sixfold.is_negative else sixfold) / 6

    def points(self) -> Mapping[str, Point]:
        return {name: Point(name, place) for name, place in zip(CORNERS, self.corners, strict=True)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        """By parts u, v and s of the three edges from its first corner; along the axes by x, y and z."""
        taken = {letter for corner in self.corners for letter in corner.free_symbols}
        first, *others = self.corners
        edges = [ImmutableDenseMatrix(c - first) for c in others]
        if first == ORIGIN and all(e == column(*(e[i] * int(i == k) for i in range(3))) for k, e in enumerate(edges)):
            (a, b, c), (x, y, z) = (e[k] for k, e in enumerate(edges)), coordinates("xyz", taken)
            limits = ((x, ZERO, a), (y, ZERO, b * (1 - x / a)), (z, ZERO, c * (1 - x / a - y / b)))
            return column(x, y, z), limits
        u, v, s = coordinates("uvs", taken)
        place = first + u * edges[0] + v * edges[1] + s * edges[2]
        limits = ((u, ZERO, Integer(1)), (v, ZERO, 1 - u), (s, ZERO, 1 - u - v))
        return ImmutableDenseMatrix(place), limits

    def particles(self) -> Particles:
        """A twentieth of the mass at each corner, four fifths at the mean of the corners."""
        mean = ImmutableDenseMatrix(sum(self.corners, ORIGIN) / 4)
        return [(Rational(4, 5) * self.mass, mean), *((self.mass / 20, corner) for corner in self.corners)]


@dataclass(frozen=True)
class Wedge(Mapped, EdgedBody):
    """A uniform right prism on a triangle: the triangle in the plane of x and y, drawn out along z.

    face     the triangle, as `Triangle` has it
    length   along z, from the origin
    mass     mass
    Points: first corner, second corner, third corner (of the face at z = 0); centre.
    """

    face: Triangle
    length: Expr
    mass: Expr
    name: ClassVar[str] = "a wedge"
    reference: ClassVar[str] = "first corner"

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        ends = (ZERO, self.length)
        return tuple(ImmutableDenseMatrix(corner + column(0, 0, z)) for z in ends for corner in self.face.corners)

    @property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        return (0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"length": self.length}

    @property
    def extent(self) -> Expr:
        area = self.face.extent
        return Factors(*(area.args if isinstance(area, Factors) else (area,)), self.length)

    def points(self) -> Mapping[str, Point]:
        return {name: Point(name, place) for name, place in zip(CORNERS, self.corners[:3], strict=False)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        place, limits = self.face.map()
        (z,) = coordinates(("z",), {s for corner in self.corners for s in corner.free_symbols})
        return ImmutableDenseMatrix(place + column(0, 0, z)), ((z, ZERO, self.length), *limits)

    def particles(self) -> Particles:
        """Triangles of equal mass at equal heights."""
        flat = Triangle(self.face.corners_at, self.mass).particles()
        return drawn_out(flat, (ZERO, self.length))
