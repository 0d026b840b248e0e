"""Thin bodies in a plane: annulus, triangle, half-disc, and a wire bent to a piece of a circle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Self

from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, cos, pi, sin, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Factors, Terms, column, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.body import EdgedBody
from derive.mechanics.bodies.equimomental import Particles, disc_of_particles, from_moments, without
from derive.mechanics.bodies.mapping import Mapped
from derive.mechanics.bodies.regions import Bounds, Point, coordinates

__all__ = ["Annulus", "Arc", "HalfDisc", "Triangle"]

HALF, ZERO = Rational(1, 2), Integer(0)
ORIGIN = column(0, 0, 0)
CORNERS = ("first corner", "second corner", "third corner", "fourth corner")


def about_centre(mass: Expr, centre: ImmutableMatrix, second: ImmutableMatrix) -> ImmutableMatrix:
    """Second moments about the centre of mass, of those about the origin."""
    return ImmutableDenseMatrix(second - mass * centre * centre.T)


def require_order(body: str, inner: Expr, outer: Expr) -> None:
    """A hole is smaller than what it is in, as far as the sizes show."""
    if (outer - inner).is_nonpositive:
        message = f"{body} of the inner radius {inner} and the outer radius {outer} has nothing between them"
        raise Rejected(Complaint("sizes", message, help="the inner radius stands first"))


def diagonal(*entries: Expr) -> ImmutableMatrix:
    return ImmutableDenseMatrix(3, 3, lambda i, j: entries[i] if i == j else ZERO)


@dataclass(frozen=True)
class Annulus(Mapped):
    """A thin uniform disc with a round hole, across the z axis, its centre at the origin.

    inner, outer   radii, lengths
    mass           mass
    Points: centre, rim (of the outer circle).
    """

    inner: Expr
    outer: Expr
    mass: Expr
    name: ClassVar[str] = "an annulus"
    filling: ClassVar[str] = "area"
    flat_across: ClassVar[str | None] = "z"
    is_round: ClassVar[bool] = True

    def __post_init__(self) -> None:
        require_order(self.name, self.inner, self.outer)

    @property
    def extent(self) -> Expr:
        return Factors(pi, Terms(self.outer**2, -(self.inner**2)))

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", ORIGIN), "rim": Point("rim", column(self.outer, 0, 0))}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        r, theta = coordinates(("r", "theta"), self.inner.free_symbols | self.outer.free_symbols)
        limits = ((theta, ZERO, 2 * pi), (r, self.inner, self.outer))
        return column(r * cos(theta), r * sin(theta), 0), limits

    def particles(self) -> Particles:
        """A disc less the disc that was cut out, their masses as the squares of their radii."""
        whole, removed = (self.mass * r**2 / (self.outer**2 - self.inner**2) for r in (self.outer, self.inner))
        return without(disc_of_particles(whole, self.outer, ZERO), disc_of_particles(removed, self.inner, ZERO))


@dataclass(frozen=True)
class Triangle(Mapped, EdgedBody):
    """A thin uniform triangular plate in the plane of x and y.

    corners   three places (x, y), lengths
    mass      mass
    `Triangle.on_base(b, h, mass)` has its base from the origin along x, its top at the height h over the middle of the
    base, or at x = foot; `Triangle.equilateral(a, mass)` has three sides a.
    Points: first corner, second corner, third corner; centre.
    """

    corners_at: tuple[tuple[Expr, Expr], tuple[Expr, Expr], tuple[Expr, Expr]]
    mass: Expr
    name: ClassVar[str] = "a triangle"
    seen_as: ClassVar[str] = "a triangular plate"
    filling: ClassVar[str] = "area"
    flat_across: ClassVar[str | None] = "z"
    reference: ClassVar[str] = "first corner"

    def __post_init__(self) -> None:
        if tidied(self._signed_area) == 0:
            raise Rejected(Complaint("sizes", "the three corners of this triangle are on one line"))

    @classmethod
    def on_base(cls, base: Expr, height: Expr, mass: Expr, foot: Expr | None = None) -> Self:
        """Its top is over the middle of its base, or over x = foot."""
        return cls(((ZERO, ZERO), (base, ZERO), (base / 2 if foot is None else foot + ZERO, height)), mass)

    @classmethod
    def equilateral(cls, side: Expr, mass: Expr) -> Self:
        return cls.on_base(side, side * sqrt(3) / 2, mass)

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        return tuple(column(x, y, 0) for x, y in self.corners_at)

    @property
    def edges(self) -> tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...]:
        return ()

    @property
    def measures(self) -> Mapping[str, Any]:
        return {}

    @property
    def _signed_area(self) -> Expr:
        """Half the products of neighbouring places, round the edge."""
        (x1, y1), (x2, y2), (x3, y3) = self.corners_at
        return (x1 * (y2 - y3) + x2 * (y3 - y1) + x3 * (y1 - y2)) / 2

    @property
    def extent(self) -> Expr:
        (x1, y1), (x2, y2), (_, y3) = self.corners_at
        if x1 == y1 == y2 == 0 and x2.is_positive and y3.is_positive:
            return Factors(HALF, x2, y3)
        area = tidied(self._signed_area)
        return -area if area.could_extract_minus_sign() or area.is_negative else area

    def points(self) -> Mapping[str, Point]:
        return {name: Point(name, place) for name, place in zip(CORNERS, self.corners, strict=False)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        """With the base on the x axis by x and y; any other by parts u and v of two of its sides."""
        (x1, y1), (x2, y2), (x3, y3) = self.corners_at
        taken = {s for corner in self.corners_at for end in corner for s in end.free_symbols}
        if x1 == y1 == y2 == 0 and x2.is_positive and y3.is_positive:
            x, y = coordinates("xy", taken)
            return column(x, y, 0), ((y, ZERO, y3), (x, x3 * y / y3, x2 + (x3 - x2) * y / y3))
        u, v = coordinates("uv", taken)
        a, b, c = self.corners
        return ImmutableDenseMatrix(a + u * (b - a) + v * (c - a)), ((u, ZERO, Integer(1)), (v, ZERO, 1 - u))

    def particles(self) -> Particles:
        """A third of the mass in the middle of each side."""
        a, b, c = self.corners
        return [(self.mass / 3, ImmutableDenseMatrix((p + q) / 2)) for p, q in ((a, b), (b, c), (c, a))]


@dataclass(frozen=True)
class HalfDisc(Mapped):
    """Half of a thin uniform disc, in the plane of x and y where y is positive; its diameter is along x.

    radius   length
    mass     mass
    Points: circle_centre (the middle of the diameter, the origin), centre.
    """

    radius: Expr
    mass: Expr
    name: ClassVar[str] = "a half-disc"
    is_lopsided: ClassVar[bool] = True
    filling: ClassVar[str] = "area"
    flat_across: ClassVar[str | None] = "z"
    reference: ClassVar[str] = "circle_centre"

    @property
    def extent(self) -> Expr:
        return Factors(HALF, pi, self.radius**2)

    def points(self) -> Mapping[str, Point]:
        return {"circle_centre": Point("circle_centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        r, theta = coordinates(("r", "theta"), self.radius.free_symbols)
        return column(r * cos(theta), r * sin(theta), 0), ((theta, ZERO, pi), (r, ZERO, self.radius))

    def particles(self) -> Particles:
        """By Pappus: turned about its diameter it is a ball, 4/3 pi R^3 = 2 pi y_C (pi R^2/2). Its second moments about
        the diameter and across it are those of a whole disc of its mass."""
        centre = column(0, Rational(4, 3) * self.radius / pi, 0)
        square = self.mass * self.radius**2 / 4
        return from_moments(self.mass, centre, about_centre(self.mass, centre, diagonal(square, square, ZERO)))


@dataclass(frozen=True)
class Arc(Mapped):
    """A thin uniform wire bent to a piece of a circle in the plane of x and y, which the x axis halves.

    radius       length
    half_angle   from the x axis to either end, an angle up to pi: pi/2 for half a circle
    mass         mass
    Points: circle_centre (the origin), centre.
    """

    radius: Expr
    half_angle: Expr
    mass: Expr
    name: ClassVar[str] = "an arc"
    is_lopsided: ClassVar[bool] = True
    seen_as: ClassVar[str] = "a bent wire"
    filling: ClassVar[str] = "length"
    flat_across: ClassVar[str | None] = "z"
    reference: ClassVar[str] = "circle_centre"

    def __post_init__(self) -> None:
        if (self.half_angle - pi).is_nonnegative or self.half_angle.is_nonpositive:
            message = f"an arc of the half angle {self.half_angle} is not a piece of a circle"
            raise Rejected(Complaint("sizes", message, help="a whole circle is a `Hoop`"))

    @property
    def extent(self) -> Expr:
        length = Factors(2, self.half_angle, self.radius)
        return length if self.half_angle.free_symbols else explicit(length)

    def points(self) -> Mapping[str, Point]:
        return {"circle_centre": Point("circle_centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        (theta,) = coordinates(("theta",), self.radius.free_symbols | self.half_angle.free_symbols)
        place = column(self.radius * cos(theta), self.radius * sin(theta), 0)
        return place, ((theta, -self.half_angle, self.half_angle),)

    def particles(self) -> Particles:
        """With x ds = R dy, the first moment is R times the chord, and the second R times the area between arc and y
        axis, that of a sector and of a triangle."""
        R, alpha = self.radius, self.half_angle
        centre = column(R * sin(alpha) / alpha, 0, 0)
        sector, triangle = alpha * R**2, R**2 * sin(alpha) * cos(alpha)
        along = self.mass * (sector + triangle) / (2 * alpha)
        across = self.mass * R**2 - along
        return from_moments(self.mass, centre, about_centre(self.mass, centre, diagonal(along, across, ZERO)))
