"""Thin bodies: rod and hoop with mass on a line, disc and plate with mass on an area."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from sympy import Expr, Integer, Rational, pi
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Factors, column
from derive.mechanics.bodies.body import EdgedBody, Particles, RoundBody
from derive.mechanics.bodies.regions import Point, Region, box, circle, disc, segment
from derive.mechanics.bodies.solids import disc_particles

__all__ = ["Disc", "Hoop", "Plate", "Rod"]

HALF = Rational(1, 2)


@dataclass(frozen=True)
class Rod(RoundBody):
    """A thin uniform rod along z, from its end at the origin.

    length   length
    mass     mass
    Points: end, centre. Its moment about its own axis is zero: all of its mass is there.
    """

    length: Expr
    mass: Expr
    name: ClassVar[str] = "a rod"
    seen_as: ClassVar[str] = "a thin rod"
    filling: ClassVar[str] = "length"
    reference: ClassVar[str] = "end"

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return Integer(0), self.length

    def radius_at(self, z: Expr) -> Expr:
        return Integer(0)

    @property
    def extent(self) -> Expr:
        return self.length

    def points(self) -> Mapping[str, Point]:
        return {"end": Point("end", column(0, 0, 0))}

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        return segment((Integer(0), self.length), point)

    def particles(self) -> Particles:
        """A sixth of the mass at each end and two thirds in the middle, the weights of Simpson's rule."""
        shares = ((Rational(1, 6), Integer(0)), (Rational(2, 3), HALF), (Rational(1, 6), Integer(1)))
        return [(share * self.mass, column(0, 0, place * self.length)) for share, place in shares]


class _Flat(RoundBody):
    """Across the z axis, as far as its radius."""

    radius: Expr
    flat_across: ClassVar[str | None] = "z"
    systems: ClassVar[tuple[str, ...]] = ("cylindrical",)

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return Integer(0), Integer(0)

    def radius_at(self, z: Expr) -> Expr:
        return self.radius

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", column(0, 0, 0)), "rim": Point("rim", column(self.radius, 0, 0))}


@dataclass(frozen=True)
class Disc(_Flat):
    """A thin uniform circular disc across the z axis, its centre at the origin.

    radius   length
    mass     mass
    """

    radius: Expr
    mass: Expr
    name: ClassVar[str] = "a disc"
    seen_as: ClassVar[str] = "a thin disc"
    filling: ClassVar[str] = "area"

    @property
    def extent(self) -> Expr:
        return Factors(pi, self.radius**2)

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        return disc(self.radius, point, Integer(0))

    def particles(self) -> Particles:
        return disc_particles(self.mass, self.radius, Integer(0))


@dataclass(frozen=True)
class Hoop(_Flat):
    """A thin uniform ring across the z axis, its centre at the origin.

    radius   length
    mass     mass
    """

    radius: Expr
    mass: Expr
    name: ClassVar[str] = "a hoop"
    filling: ClassVar[str] = "length"

    @property
    def extent(self) -> Expr:
        return Factors(2, pi, self.radius)

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        return circle(self.radius, point)

    def particles(self) -> Particles:
        """A quarter of the mass at each end of two diameters."""
        R = self.radius
        return [(self.mass / 4, column(x, y, 0)) for x, y in ((R, 0), (-R, 0), (0, R), (0, -R))]


@dataclass(frozen=True)
class Plate(EdgedBody):
    """A thin uniform rectangular plate in the plane of x and y, edges along the axes from the corner at the origin.

    sides    two lengths
    mass     mass
    """

    sides: tuple[Expr, Expr]
    mass: Expr
    name: ClassVar[str] = "a plate"
    filling: ClassVar[str] = "area"
    flat_across: ClassVar[str | None] = "z"
    reference: ClassVar[str] = "corner"

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"edges": self.sides}

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        a, b = self.sides
        return column(0, 0, 0), column(a, 0, 0), column(a, b, 0), column(0, b, 0)

    @property
    def edges(self) -> tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...]:
        return (self.sides[0], ((0, 1), (2, 3))), (self.sides[1], ((0, 3), (1, 2)))

    @property
    def extent(self) -> Expr:
        return self.sides[0] ** 2 if self.sides[0] == self.sides[1] else Factors(*self.sides)

    def points(self) -> Mapping[str, Point]:
        return {"corner": Point("corner", column(0, 0, 0))}

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        return box((*self.sides, None), point)

    def particles(self) -> Particles:
        """A sixth of the mass in the middle of each edge and a third at the centre."""
        a, b = self.sides
        middles = ((a / 2, 0), (a / 2, b), (0, b / 2), (a, b / 2))
        return [(self.mass / 3, column(a / 2, b / 2, 0)), *((self.mass / 6, column(x, y, 0)) for x, y in middles)]
