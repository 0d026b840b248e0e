"""Solids of revolution: cone, cylinder and ball, with the axis of symmetry along z."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diag, diff, pi, sin, solve, sqrt

from derive.algebra.expressions import Factors, column, explicit
from derive.mechanics.bodies.body import Particles, RoundBody
from derive.mechanics.bodies.integration import worked_integral
from derive.mechanics.bodies.regions import COORDINATES, Point, Region, solid_of_revolution
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.step import Quantity, is_zero
from derive.steps.subject import Subject

__all__ = ["Ball", "Cone", "Cylinder", "volume"]

UPWARDS = ImmutableDenseMatrix(diag(1, -1, -1))  # half a turn about x: z is counted the other way


class RoundSolid(RoundBody):
    """A body that is all points within a certain distance of a piece of the z axis."""

    systems: ClassVar[tuple[str, ...]] = ("cylindrical", "cartesian")

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        return solid_of_revolution(self.radius_at, self.ends, point, coordinates or COORDINATES[1])

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """Two expressions that are equal where (r, z), in its own axes, is on its edge."""
        raise AttributeError(f"{type(self).__name__} must say where its edge is")

    def radii(self, point: Point, region: Region) -> list[Quantity]:
        if region.section is None:
            return []
        if point not in self._known_radii:
            self._known_radii[point] = _section_radius(self, point, region)
        return [self._known_radii[point]]

    @cached_property
    def _known_radii(self) -> dict[Point, Quantity]:
        return {}


@dataclass(frozen=True)
class Cone(RoundSolid):
    """A uniform circular cone, from its apex at the origin to its base at z = height.

    radius   of the base, length
    height   length
    mass     mass
    Points: apex; base (its centre, from which z is counted towards the apex); centre.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """

    radius: Expr
    height: Expr
    mass: Expr
    name: ClassVar[str] = "a cone"
    seen_as: ClassVar[str] = "a circular cone"
    reference: ClassVar[str] = "apex"

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"base radius": self.radius, "height": self.height}

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return Integer(0), self.height

    def radius_at(self, z: Expr) -> Expr:
        return self.radius * z / self.height

    def points(self) -> Mapping[str, Point]:
        base = Point("base", column(0, 0, self.height), UPWARDS)
        return {"apex": Point("apex", column(0, 0, 0)), "base": base}

    @cached_property
    def extent(self) -> Quantity:
        return volume(self)

    def particles(self) -> Particles:
        """One twentieth of the mass at the apex, four fifths as a disc at three quarters of the height, and three
        twentieths as a disc at the base; each disc as five particles.

        With weights 1, 16 and 3 of 20 the heights 0, 3/4 and 1 have the moments 1, 3/4 and 3/5 that the slices of a
        cone have, since their masses grow as the square of the height.
        """
        found = [(self.mass / 20, column(0, 0, 0))]
        for share, height in ((Rational(4, 5), Rational(3, 4)), (Rational(3, 20), Integer(1))):
            found += disc_particles(share * self.mass, height * self.radius, height * self.height)
        return found

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """Apex, edge and rim are on one line: the slopes are equal."""
        return r * self.height, self.radius * z


@dataclass(frozen=True)
class Cylinder(RoundSolid):
    """A uniform circular cylinder, from its base at the origin to z = height.

    radius   length
    height   length
    mass     mass
    Points: base (the centre of the one at the origin), centre.
    """

    radius: Expr
    height: Expr
    mass: Expr
    name: ClassVar[str] = "a cylinder"
    seen_as: ClassVar[str] = "a circular cylinder"
    reference: ClassVar[str] = "base"

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return Integer(0), self.height

    def radius_at(self, z: Expr) -> Expr:
        return self.radius

    @property
    def extent(self) -> Expr:
        return Factors(pi, self.radius**2, self.height)

    def points(self) -> Mapping[str, Point]:
        return {"base": Point("base", column(0, 0, 0))}

    def particles(self) -> Particles:
        """Discs of a sixth, two thirds and a sixth of the mass at the base, the middle and the top (the weights of
        Simpson's rule, which is exact for squares), each as five particles."""
        parts = ((Rational(1, 6), Integer(0)), (Rational(2, 3), Rational(1, 2)), (Rational(1, 6), Integer(1)))
        return [
            particle
            for share, height in parts
            for particle in disc_particles(share * self.mass, self.radius, height * self.height)
        ]


@dataclass(frozen=True)
class Ball(RoundSolid):
    """A uniform ball about the origin.

    radius   length
    mass     mass
    """

    radius: Expr
    mass: Expr
    name: ClassVar[str] = "a ball"

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return -self.radius, self.radius

    def radius_at(self, z: Expr) -> Expr:
        return sqrt(self.radius**2 - z**2)

    @property
    def extent(self) -> Expr:
        return Factors(Rational(4, 3), pi, self.radius**3)

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """Pythagoras: the edge is at the distance R from the centre."""
        return r**2 + z**2, self.radius**2

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", column(0, 0, 0))}

    def particles(self) -> Particles:
        """A tenth of the mass at each end of three diameters, the rest at the centre: 2 (M/10) R^2 = M R^2/5."""
        found = [(Rational(2, 5) * self.mass, column(0, 0, 0))]
        for axis in range(3):
            for sign in (1, -1):
                place = [sign * self.radius if k == axis else Integer(0) for k in range(3)]
                found.append((self.mass / 10, column(*place)))
        return found


def disc_particles(mass: Expr, radius: Expr, height: Expr) -> Particles:
    """A disc across the z axis: half of its mass at its centre and an eighth at each end of two diameters."""
    rim = ((radius, 0), (-radius, 0), (0, radius), (0, -radius))
    return [(mass / 2, column(0, 0, height)), *((mass / 8, column(x, y, height)) for x, y in rim)]


def volume(body: Cone) -> Quantity:
    """Volume of a cone, V = integral of dV.

    body    radius R, height h
    Second route: Pappus, the area of half its section times the way that the centroid of the half goes.
    Outcomes: cylindrical (the coordinates of the integral).
    Source: Apostol, *Calculus*, volume 2, section 11.18 (theorem of Pappus).
    """
    start = body.point(body.reference)
    region = body.region(start)
    _, theta, r = region.names
    return establish(
        "bodies.volume",
        Symbol("V" if Symbol("V", positive=True) not in body.mass.free_symbols else "V_0", positive=True),
        lambda *_: region.integral(Integer(1)),
        {"along": region.names[0]},
        telling=Telling(
            formulas={
                "edge": (region.limits[2][2], _edge_at(body, start, region.names[0])),
                "x_is": (r * cos(theta), region.position[0]),
                "y_is": (r * sin(theta), region.position[1]),
            },
            words={"start": start.name},
            judged_by={"element": region.element, "radius": r},
        ),
        lines=Lines(between=worked_integral(region, Integer(1), Integer(1), Integer(1)), put_in=None),
        routes={"pappus": lambda value: (value, _by_pappus(body))},
        outcome="cylindrical",
        kind="volume",
        scope=Scope(about=Subject(body=body)),
    )


def _edge_at(body: RoundSolid, point: Point, z: Expr) -> Expr:
    """The radius at z from a point, as the condition of the edge has it: solved for what makes its two sides equal."""
    r = Symbol("r_edge", nonnegative=True)
    left, right = body.edge_condition(point.along_body(z), r)
    (found,) = solve(left - right, r)
    return found


def _by_pappus(body: Cone) -> Expr:
    """The triangle apex, centre of the base, rim has the area R h/2, its centroid the distance R/3 from the axis."""
    corners = [(Integer(0), Integer(0)), (Integer(0), body.height), (body.radius, body.height)]
    (r1, z1), (r2, z2), (r3, z3) = corners
    area = ((r2 - r1) * (z3 - z1) - (r3 - r1) * (z2 - z1)) / 2
    return 2 * pi * (r1 + r2 + r3) / 3 * (-area)


def _is_of_a_ball(radius: Expr, along: Symbol) -> bool:
    """r^2 + (z - c)^2 is the same everywhere: the cross-sections are those of a ball."""
    return is_zero(diff(explicit(radius) ** 2, along, 2) + 2)


def _section_radius(body: RoundSolid, point: Point, region: Region) -> Quantity:
    """The radius of the cross-section at z from a point of the axis: R (h - z)/h, or sqrt(R^2 - z^2)."""
    symbol, value = region.section or (None, None)
    z = region.names[0]
    return establish(
        "bodies.section_radius",
        symbol,
        lambda _: value,
        {"along": z},
        routes={"edge": lambda r: body.edge_condition(point.along_body(z), r)},
        outcome=lambda radius: "straight" if body.is_straight else "ball" if _is_of_a_ball(radius, z) else "curved",
        kind="length",
        lines=Lines(put_in=None),
        scope=Scope(coordinates={z: "length"}, about=Subject(body=body, point=point)),
        telling=Telling(words={"start": point.name}),
        key="section_radius",
    )
