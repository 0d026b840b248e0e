"""Hollow bodies: tube and thick shell, and the thin shells of a sphere, half a sphere, a cylinder and a cone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from sympy import Expr, Integer, Rational, cos, pi, sin, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Factors, Terms, column
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.equimomental import Particles, ring_of_particles, sliced, without
from derive.mechanics.bodies.flat_shapes import ORIGIN, ZERO, require_order
from derive.mechanics.bodies.mapping import Mapped
from derive.mechanics.bodies.regions import Bounds, Point, coordinates
from derive.mechanics.bodies.solids import Ball, Cylinder

__all__ = ["ConicalShell", "CylindricalShell", "HemisphericalShell", "SphericalShell", "ThickShell", "Tube"]


class _About(Mapped):
    """Round about the z axis."""

    is_round: ClassVar[bool] = True


def on_sphere(r: Expr, theta: Expr, phi: Expr) -> ImmutableMatrix:
    """The place at the distance r from the origin, at theta from the z axis, at phi round it."""
    return column(r * sin(theta) * cos(phi), r * sin(theta) * sin(phi), r * cos(theta))


@dataclass(frozen=True)
class Tube(_About):
    """A uniform hollow cylinder about the z axis, from its base at the origin to z = height.

    inner, outer   radii, lengths
    height         length
    mass           mass
    Points: base (the centre of the one at the origin), centre.
    """

    inner: Expr
    outer: Expr
    height: Expr
    mass: Expr
    name: ClassVar[str] = "a tube"
    seen_as: ClassVar[str] = "a hollow cylinder"
    reference: ClassVar[str] = "base"

    def __post_init__(self) -> None:
        require_order(self.name, self.inner, self.outer)

    @property
    def extent(self) -> Expr:
        return Factors(pi, Terms(self.outer**2, -(self.inner**2)), self.height)

    def points(self) -> Mapping[str, Point]:
        return {"base": Point("base", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        taken = self.inner.free_symbols | self.outer.free_symbols | self.height.free_symbols
        z, theta, r = coordinates(("z", "theta", "r"), taken)
        limits = ((z, ZERO, self.height), (theta, ZERO, 2 * pi), (r, self.inner, self.outer))
        return column(r * cos(theta), r * sin(theta), z), limits

    def particles(self) -> Particles:
        """A cylinder less the cylinder that was taken out, their masses as the squares of their radii."""
        across = self.outer**2 - self.inner**2
        whole, removed = (
            Cylinder(r, self.height, self.mass * r**2 / across).particles() for r in (self.outer, self.inner)
        )
        return without(whole, removed)


@dataclass(frozen=True)
class ThickShell(_About):
    """A uniform ball about the origin with a hollow ball in its middle.

    inner, outer   radii, lengths
    mass           mass
    """

    inner: Expr
    outer: Expr
    mass: Expr
    name: ClassVar[str] = "a thick shell"
    seen_as: ClassVar[str] = "a hollow ball"

    def __post_init__(self) -> None:
        require_order(self.name, self.inner, self.outer)

    @property
    def extent(self) -> Expr:
        return Factors(Rational(4, 3), pi, Terms(self.outer**3, -(self.inner**3)))

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        r, theta, phi = coordinates(("r", "theta", "phi"), self.inner.free_symbols | self.outer.free_symbols)
        limits = ((r, self.inner, self.outer), (theta, ZERO, pi), (phi, ZERO, 2 * pi))
        return on_sphere(r, theta, phi), limits

    def particles(self) -> Particles:
        """A ball less the ball that was taken out, their masses as the cubes of their radii."""
        between = self.outer**3 - self.inner**3
        whole, removed = (Ball(r, self.mass * r**3 / between).particles() for r in (self.outer, self.inner))
        return without(whole, removed)


@dataclass(frozen=True)
class SphericalShell(_About):
    """A thin uniform shell of a sphere about the origin.

    radius   length
    mass     mass
    """

    radius: Expr
    mass: Expr
    name: ClassVar[str] = "a spherical shell"
    seen_as: ClassVar[str] = "a thin spherical shell"
    filling: ClassVar[str] = "area"

    @property
    def extent(self) -> Expr:
        return Factors(4, pi, self.radius**2)

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        theta, phi = coordinates(("theta", "phi"), self.radius.free_symbols)
        return on_sphere(self.radius, theta, phi), ((theta, ZERO, pi), (phi, ZERO, 2 * pi))

    def particles(self) -> Particles:
        """A sixth of the mass at each end of three diameters: its moments about them are equal and add up to twice
        M R^2."""
        ends = (
            column(*(sign * self.radius * int(k == axis) for k in range(3))) for axis in range(3) for sign in (1, -1)
        )
        return [(self.mass / 6, end) for end in ends]


@dataclass(frozen=True)
class HemisphericalShell(_About):
    """Half of a thin uniform spherical shell, where z is positive; the centre of its rim is at the origin.

    radius   length
    mass     mass
    Points: circle_centre (of its rim), centre.
    """

    radius: Expr
    mass: Expr
    name: ClassVar[str] = "a hemispherical shell"
    filling: ClassVar[str] = "area"
    reference: ClassVar[str] = "circle_centre"

    @property
    def extent(self) -> Expr:
        return Factors(2, pi, self.radius**2)

    def points(self) -> Mapping[str, Point]:
        return {"circle_centre": Point("circle_centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        theta, phi = coordinates(("theta", "phi"), self.radius.free_symbols)
        return on_sphere(self.radius, theta, phi), ((theta, ZERO, pi / 2), (phi, ZERO, 2 * pi))

    def particles(self) -> Particles:
        """By Archimedes, slices of equal height have equal masses."""
        ends, across = (ZERO, self.radius), lambda z: sqrt(self.radius**2 - z**2)
        return sliced(self.mass, ends, across, lambda z: Integer(1), ring_of_particles)


@dataclass(frozen=True)
class CylindricalShell(_About):
    """A thin uniform shell of a cylinder without ends, about the z axis, from the origin to z = height.

    radius   length
    height   length
    mass     mass
    Points: circle_centre (of its lower rim), centre.
    """

    radius: Expr
    height: Expr
    mass: Expr
    name: ClassVar[str] = "a cylindrical shell"
    seen_as: ClassVar[str] = "a thin cylindrical shell"
    filling: ClassVar[str] = "area"
    reference: ClassVar[str] = "circle_centre"

    @property
    def extent(self) -> Expr:
        return Factors(2, pi, self.radius, self.height)

    def points(self) -> Mapping[str, Point]:
        return {"circle_centre": Point("circle_centre", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        z, theta = coordinates(("z", "theta"), self.radius.free_symbols | self.height.free_symbols)
        place = column(self.radius * cos(theta), self.radius * sin(theta), z)
        return place, ((z, ZERO, self.height), (theta, ZERO, 2 * pi))

    def particles(self) -> Particles:
        """Rings of equal mass at equal heights."""
        return sliced(self.mass, (ZERO, self.height), lambda z: self.radius, lambda z: Integer(1), ring_of_particles)


@dataclass(frozen=True)
class ConicalShell(_About):
    """The thin uniform side of a circular cone without its base, from its apex at the origin to z = height.

    radius   of its rim, length
    height   length
    mass     mass
    Points: tip (the apex), centre.
    """

    radius: Expr
    height: Expr
    mass: Expr
    name: ClassVar[str] = "a conical shell"
    seen_as: ClassVar[str] = "the side of a cone"
    filling: ClassVar[str] = "area"
    reference: ClassVar[str] = "tip"

    @property
    def extent(self) -> Expr:
        return Factors(pi, self.radius, sqrt(self.radius**2 + self.height**2))

    def points(self) -> Mapping[str, Point]:
        return {"tip": Point("tip", ORIGIN)}

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        z, theta = coordinates(("z", "theta"), self.radius.free_symbols | self.height.free_symbols)
        r = self.radius * z / self.height
        return column(r * cos(theta), r * sin(theta), z), ((z, ZERO, self.height), (theta, ZERO, 2 * pi))

    def particles(self) -> Particles:
        """Rings whose masses grow as their radii."""
        ends = (ZERO, self.height)
        return sliced(self.mass, ends, lambda z: tidied(self.radius * z / self.height), lambda z: z, ring_of_particles)
