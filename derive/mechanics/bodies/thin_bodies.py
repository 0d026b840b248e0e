"""Thin bodies: mass on a straight line or a circle, on a part of a plane, or on a curved surface."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from sympy import Expr, Integer, Rational, cos, pi, sin, sqrt

from derive.algebra.expressions import Factors, Terms, column, explicit
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.body import (
    ORIGIN,
    ZERO,
    Body,
    Conical,
    Cylindrical,
    Hollow,
    OfRadius,
    RoundBody,
    Spherical,
)
from derive.mechanics.bodies.boundary import Rim
from derive.mechanics.bodies.equimomental import (
    HALF,
    Particles,
    disc_of_particles,
    drawn_out,
    from_moments,
    on_diameters,
    ring_of_particles,
    sliced,
)
from derive.mechanics.bodies.mapping import Map, cylindrical, spherical
from derive.mechanics.bodies.regions import Point
from derive.steps.signs import sign_known

__all__ = [
    "Annulus",
    "Arc",
    "ConicalShell",
    "CylindricalShell",
    "Disc",
    "HalfDisc",
    "HemisphericalShell",
    "Hoop",
    "Rod",
    "SphericalShell",
]

# --- lines and circles -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Rod(RoundBody):
    """A thin uniform rod along z, with one end at the origin.

    length   the length of the rod
    mass     the mass of the body

    Points: end (at the origin), far_end, centre. All of the mass is on the axis of the rod, so the moment of inertia
    about this axis is zero.
    """

    length: Expr
    mass: Expr
    id, filling, reference = "rod", "length", "end"

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return ZERO, self.length

    def radius_at(self, z: Expr) -> Expr:
        return ZERO

    @property
    def extent(self) -> Expr:
        return self.length

    def points(self) -> Mapping[str, Point]:
        return {**super().points(), "far_end": Point("far_end", column(0, 0, self.length))}

    def particles(self) -> Particles:
        return drawn_out([(self.mass, ORIGIN)], self.ends)


class _Flat(OfRadius, RoundBody):
    """A flat round body perpendicular to the z axis."""

    systems = ("cylindrical",)

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return ZERO, ZERO

    def radius_at(self, z: Expr) -> Expr:
        return self.radius

    def points(self) -> Mapping[str, Point]:
        return {**super().points(), "rim": Point("rim", column(self.radius, 0, 0))}


class Hoop(_Flat):
    """A thin uniform ring perpendicular to the z axis, with its centre at the origin.

    radius   the radius, a length
    mass     the mass of the body
    """

    id, filling = "hoop", "length"

    @property
    def extent(self) -> Expr:
        return Factors(2, pi, self.radius)

    def particles(self) -> Particles:
        return ring_of_particles(self.mass, self.radius, ZERO)


@dataclass(frozen=True)
class Arc(Body):
    """A thin uniform wire in the shape of a circular arc in the plane of x and y; the x axis bisects the arc.

    radius       the radius, a length
    half_angle   the angle from the x axis to either end, between 0 and pi; pi/2 for half a circle
    mass         the mass of the body

    Points: circle_centre (the origin), centre.
    """

    radius: Expr
    half_angle: Expr
    mass: Expr
    id, filling, reference = "arc", "length", "circle_centre"
    other_centre = "circle_centre"
    is_lopsided = True

    def check_sizes(self) -> None:
        super().check_sizes()
        if sign_known(self.half_angle - pi) in (0, 1) or sign_known(self.half_angle) in (0, -1):
            message = "the half angle of an arc must be between zero and pi"
            raise Rejected(Complaint("sizes", message, help="a whole circle is a `Hoop`"))

    @property
    def extent(self) -> Expr:
        length = Factors(2, self.half_angle, self.radius)
        return length if self.half_angle.free_symbols else explicit(length)

    def map(self) -> Map:
        return cylindrical(self.letters, ZERO, self.radius, (-self.half_angle, self.half_angle))

    def particles(self) -> Particles:
        """With x ds = R dy, the integral of x ds is R times the chord. The integral of x^2 ds is R times the area
        between the arc and the y axis. This area consists of a sector and two equal right triangles."""
        R, alpha = self.radius, self.half_angle
        sector, triangle = alpha * R**2, R**2 * sin(alpha) * cos(alpha)
        along = self.mass * (sector + triangle) / (2 * alpha)
        centre = column(R * sin(alpha) / alpha, 0, 0)
        return from_moments(self.mass, centre, about_origin=(along, self.mass * R**2 - along, ZERO))


# --- parts of a plane ------------------------------------------------------------------------------------------------


class Disc(_Flat):
    """A thin uniform circular disc perpendicular to the z axis, with its centre at the origin.

    radius   the radius, a length
    mass     the mass of the body
    """

    id, filling = "disc", "area"

    @property
    def extent(self) -> Expr:
        return Factors(pi, self.radius**2)

    def particles(self) -> Particles:
        return disc_of_particles(self.mass, self.radius, ZERO)


@dataclass(frozen=True)
class Annulus(Hollow):
    """A thin uniform disc with a round hole, perpendicular to the z axis, with its centre at the origin.

    inner, outer   the radius of the hole and the outer radius, both lengths
    mass           the mass of the body

    Points: centre, rim (a point of the outer circle).
    """

    inner: Expr
    outer: Expr
    mass: Expr
    id, filling, power = "annulus", "area", 2

    @property
    def extent(self) -> Expr:
        return Factors(pi, Terms(self.outer**2, -(self.inner**2)))

    def points(self) -> Mapping[str, Point]:
        return {**super().points(), "rim": Point("rim", column(self.outer, 0, 0))}

    def map(self) -> Map:
        return cylindrical(self.letters, ZERO, (self.inner, self.outer))

    def filled(self, radius: Expr, mass: Expr) -> Disc:
        return Disc(radius, mass)


class HalfDisc(OfRadius):
    """Half of a thin uniform disc in the plane of x and y, with y > 0; its diameter is along x.

    radius   the radius, a length
    mass     the mass of the body

    Points: circle_centre (the middle of the diameter, the origin), centre.
    """

    id, filling, reference, is_lopsided = "half_disc", "area", "circle_centre", True
    other_centre = "circle_centre"

    @property
    def extent(self) -> Expr:
        return Factors(HALF, pi, self.radius**2)

    def map(self) -> Map:
        return cylindrical(self.letters, ZERO, (0, self.radius), (0, pi))

    @property
    def boundary(self) -> Rim:
        """The edge of the half-disc; a drawing labels half of the diameter as the radius."""
        edge = super().boundary
        assert isinstance(edge, Rim)
        return replace(edge, radius=(column(-self.radius, 0, 0), ORIGIN, self.radius))

    def particles(self) -> Particles:
        """By Pappus: revolved about its diameter, the half-disc forms a ball, so 4/3 pi R^3 = 2 pi y_C (pi R^2/2). The
        second moments along x and y about the origin are those of a whole disc of the same mass."""
        square = self.mass * self.radius**2 / 4
        centre = column(0, Rational(4, 3) * self.radius / pi, 0)
        return from_moments(self.mass, centre, about_origin=(square, square, ZERO))


# --- curved surfaces -------------------------------------------------------------------------------------------------


class SphericalShell(Spherical):
    """A thin uniform spherical shell about the origin.

    radius   the radius, a length
    mass     the mass of the body
    """

    id, filling = "spherical_shell", "area"

    @property
    def extent(self) -> Expr:
        return Factors(4, pi, self.radius**2)

    def map(self) -> Map:
        return spherical(self.letters, self.radius)

    def particles(self) -> Particles:
        """Six equal particles at the ends of three perpendicular diameters. As for the shell, the moments of inertia
        about these diameters are equal, and their sum is 2 M R^2."""
        return on_diameters(self.mass, self.radius)


class HemisphericalShell(SphericalShell):
    """Half of a thin uniform spherical shell, with z > 0; the centre of its rim is at the origin.

    radius   the radius, a length
    mass     the mass of the body

    Points: circle_centre (the centre of the rim), centre.
    """

    id, reference = "hemispherical_shell", "circle_centre"
    other_centre = "circle_centre"

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return ZERO, self.radius

    @property
    def extent(self) -> Expr:
        return Factors(2, pi, self.radius**2)

    def map(self) -> Map:
        return spherical(self.letters, self.radius, (0, pi / 2))

    def particles(self) -> Particles:
        """The particles of rings: by Archimedes, the mass per height is constant."""
        return sliced(self.mass, self.ends, self.radius_at, lambda z: Integer(1), ring_of_particles)


class CylindricalShell(Cylindrical):
    """A thin uniform cylindrical shell without end faces, about the z axis, from z = 0 to z = height.

    radius   the radius, a length
    height   the height, a length
    mass     the mass of the body

    Points: circle_centre (the centre of the rim at z = 0), centre.
    """

    id, filling = "cylindrical_shell", "area"
    reference = "circle_centre"

    @property
    def extent(self) -> Expr:
        return Factors(2, pi, self.radius, self.height)

    def particles(self) -> Particles:
        """Copies of the particles of a ring at three values of z, weighted by Simpson's rule."""
        return drawn_out(ring_of_particles(self.mass, self.radius, ZERO), self.ends)


class ConicalShell(Conical):
    """A thin uniform conical shell without a base, from its apex at the origin to z = height.

    radius   the radius of the rim, a length
    height   the height, a length
    mass     the mass of the body

    Points: tip (the apex), centre.
    """

    id, filling, reference = "conical_shell", "area", "tip"

    @property
    def extent(self) -> Expr:
        return Factors(pi, self.radius, sqrt(self.radius**2 + self.height**2))

    def particles(self) -> Particles:
        """The particles of rings: the mass per height is proportional to the radius."""
        return sliced(self.mass, self.ends, self.radius_at, lambda z: z, ring_of_particles)
