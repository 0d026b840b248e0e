"""Solids: bodies with mass in a volume. Round solids have their axis along z."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diag, diff, pi, sin

from derive.algebra.expressions import Factors, Terms, column, explicit
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies import claims
from derive.mechanics.bodies.body import (
    ORIGIN,
    ZERO,
    Body,
    Conical,
    Cylindrical,
    Hollow,
    OfHeight,
    RoundBody,
    Spherical,
)
from derive.mechanics.bodies.boundary import Ellipsoidal, Extruded, Toroidal
from derive.mechanics.bodies.equimomental import (
    HALF,
    Particles,
    disc_of_particles,
    drawn_out,
    on_diameters,
    ring_of_particles,
    sliced,
    stretched,
)
from derive.mechanics.bodies.facts import Integrated
from derive.mechanics.bodies.integration import worked_integral
from derive.mechanics.bodies.mapping import Map, cylindrical, spherical
from derive.mechanics.bodies.regions import Point, Region, coordinates, round_by_chords
from derive.mechanics.bodies.thin_bodies import HalfDisc
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, is_zero
from derive.steps.subject import Subject, with_name

__all__ = [
    "Ball",
    "Cone",
    "Cylinder",
    "Ellipsoid",
    "HalfCylinder",
    "Hemisphere",
    "ThickShell",
    "Torus",
    "Tube",
    "volume",
]

UPWARDS = ImmutableDenseMatrix(diag(1, -1, -1))  # half a turn about x, which reverses z


# --- round solids, defined by the radius at each height ---------------------------------------------------------------


class RoundSolid(RoundBody):
    """A solid of revolution: all points between two heights, at a distance of at most `radius_at(z)` from the z
    axis."""

    systems = ("cylindrical", "cartesian")

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        if coordinates == "cartesian":
            found = round_by_chords(self.radius_at, self.ends, point, self._primed(point))
        else:
            found = super().region(point).with_named_section(self.letters, self._primed(point))
        if not self.called or found.section is None:
            return found
        (r, edge), limits = found.section, found.limits
        own = with_name(self.called, "r", r)[1]  # the symbol in the step that derives the radius
        limits = tuple((x, low.xreplace({r: own}), up.xreplace({r: own})) for x, low, up in limits)
        return replace(found, limits=limits, section=(own, edge))

    def _primed(self, point: Point) -> str:
        """The suffix of the symbol of the radius: a prime if z is not measured from the origin, and an index if the
        body has a name."""
        index = f"_{self.called.partition(' ')[0]}" if self.called else ""
        return index if point.name == self.reference else f"'{index}"

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """Two expressions that are equal if the point (r, z), in body axes, is on the edge of the body."""
        raise AttributeError(f"{type(self).__name__} must define its edge")

    def radii(self, point: Point, region: Region) -> list[Quantity]:
        if region.section is None:
            return []
        if point not in self._known_radii:
            self._known_radii[point] = _section_radius(self, point, region)
        return [self._known_radii[point]]

    @cached_property
    def _known_radii(self) -> dict[Point, Quantity]:
        return {}


class Cone(Conical, RoundSolid):
    """A uniform circular cone, from its apex at the origin to its base at z = height.

    radius   the radius of the base, a length
    height   the height, a length
    mass     the mass of the body

    Points: apex, base (the centre of the base; the z axis of this point has the opposite direction, towards the apex),
    centre.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """

    id, reference = "cone", "apex"

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"base_radius": self.radius, "height": self.height}

    def points(self) -> Mapping[str, Point]:
        return {**super().points(), "base": Point("base", column(0, 0, self.height), UPWARDS)}

    @cached_property
    def extent(self) -> Quantity:
        return volume(self)

    def particles(self) -> Particles:
        """One twentieth of the mass at the apex, four fifths as a disc at three quarters of the height, and three
        twentieths as a disc at the base. Each disc has five particles.

        The slices of a cone have masses proportional to z^2. With the height as unit, the means of 1, z and z^2 are 1,
        3/4 and 3/5. The means of 1, z and z^2 over the heights 0, 3/4 and 1 with the weights 1/20, 16/20 and 3/20 are
        the same.
        """
        found = [(self.mass / 20, ORIGIN)]
        for share, height in ((Rational(4, 5), Rational(3, 4)), (Rational(3, 20), Integer(1))):
            found += disc_of_particles(share * self.mass, height * self.radius, height * self.height)
        return found

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """The apex, the point (r, z) and the rim are on one line: r/z = radius/height."""
        return r * self.height, self.radius * z


class Cylinder(Cylindrical, RoundSolid):
    """A uniform circular cylinder, from its base at the origin to z = height.

    radius   the radius, a length
    height   the height, a length
    mass     the mass of the body

    Points: base (the centre of the base, at the origin), centre.
    """

    id, reference = "cylinder", "base"

    @property
    def extent(self) -> Expr:
        return Factors(pi, self.radius**2, self.height)

    def particles(self) -> Particles:
        """Copies of the particles of a disc at three values of z, weighted by Simpson's rule."""
        return drawn_out(disc_of_particles(self.mass, self.radius, ZERO), self.ends)


class Ball(Spherical, RoundSolid):
    """A uniform ball about the origin.

    radius   the radius, a length
    mass     the mass of the body
    """

    id = "ball"
    part = Rational(4, 3)  # volume over pi radius^3

    @property
    def extent(self) -> Expr:
        return Factors(self.part, pi, self.radius**3)

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """The edge is at the distance R from the centre, by Pythagoras's theorem."""
        return r**2 + z**2, self.radius**2

    def particles(self) -> Particles:
        """A tenth of the mass is at each end of three diameters, so each second moment is 2 (M/10) R^2 = M R^2/5; the
        rest is at the centre."""
        return [(Rational(2, 5) * self.mass, ORIGIN), *on_diameters(Rational(3, 5) * self.mass, self.radius)]


class Hemisphere(Ball):
    """Half of a uniform ball, with z > 0; the centre of its base is at the origin.

    radius   the radius, a length
    mass     the mass of the body

    Points: base (the centre of the base), centre.
    """

    id, reference = "hemisphere", "base"
    other_centre = "base"
    part = Rational(2, 3)

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return ZERO, self.radius

    def particles(self) -> Particles:
        """The particles of slices: discs whose mass per height is proportional to the square of their radius."""
        return sliced(self.mass, self.ends, self.radius_at, lambda z: self.radius**2 - z**2)


# --- others ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Tube(Hollow):
    """A uniform hollow cylinder about the z axis, from its base at the origin to z = height.

    inner, outer   the radius of the cavity and the outer radius, both lengths
    height         the height, a length
    mass           the mass of the body

    Points: base (the centre of the base, at the origin), centre.
    """

    inner: Expr
    outer: Expr
    height: Expr
    mass: Expr
    id, reference, power = "tube", "base", 2

    @property
    def extent(self) -> Expr:
        return Factors(pi, Terms(self.outer**2, -(self.inner**2)), self.height)

    def map(self) -> Map:
        return cylindrical(self.letters, (0, self.height), (self.inner, self.outer))

    def filled(self, radius: Expr, mass: Expr) -> Cylinder:
        return Cylinder(radius, self.height, mass)


@dataclass(frozen=True)
class ThickShell(Hollow):
    """A uniform ball about the origin with a concentric spherical cavity.

    inner, outer   the radius of the cavity and the outer radius, both lengths
    mass           the mass of the body
    """

    inner: Expr
    outer: Expr
    mass: Expr
    id, power = "thick_shell", 3

    @property
    def extent(self) -> Expr:
        return Factors(Rational(4, 3), pi, Terms(self.outer**3, -(self.inner**3)))

    def map(self) -> Map:
        return spherical(self.letters, (self.inner, self.outer))

    def filled(self, radius: Expr, mass: Expr) -> Ball:
        return Ball(radius, mass)


class HalfCylinder(OfHeight):
    """Half of a uniform cylinder about the z axis, with y > 0, from z = 0 to z = height.

    radius   the radius, a length
    height   the height, a length
    mass     the mass of the body

    Points: circle_centre (the centre of the circle at z = 0, the origin), centre.
    """

    id, reference, is_lopsided = "half_cylinder", "circle_centre", True
    other_centre = "circle_centre"

    @property
    def extent(self) -> Expr:
        return Factors(HALF, pi, self.radius**2, self.height)

    def map(self) -> Map:
        return cylindrical(self.letters, (0, self.height), (0, self.radius), (0, pi))

    @property
    def boundary(self) -> Extruded:
        return Extruded(HalfDisc(self.radius, self.mass).boundary)

    def particles(self) -> Particles:
        """Copies of the particles of a half-disc at three values of z, weighted by Simpson's rule."""
        return drawn_out(HalfDisc(self.radius, self.mass).particles(), (ZERO, self.height))


@dataclass(frozen=True)
class Ellipsoid(Body):
    """A uniform ellipsoid about the origin, with its axes along x, y and z.

    semi_axes   three lengths, along x, y and z
    mass        the mass of the body
    """

    semi_axes: tuple[Expr, Expr, Expr]
    mass: Expr
    id = "ellipsoid"

    @property
    def extent(self) -> Expr:
        return Factors(Rational(4, 3), pi, *self.semi_axes)

    def map(self) -> Map:
        """A ball of radius 1, scaled along each axis."""
        return spherical(self.letters, (0, 1), by=self.semi_axes)

    @property
    def boundary(self) -> Ellipsoidal:
        return Ellipsoidal(self.semi_axes)

    def particles(self) -> Particles:
        """The particles of a ball of radius 1, scaled along each axis."""
        return stretched(Ball(Integer(1), self.mass).particles(), self.semi_axes)


@dataclass(frozen=True)
class Torus(Body):
    """A uniform ring of round cross-section about the z axis, with its centre at the origin.

    radius    the distance of the middle of the cross-section from the axis, a length
    section   the radius of the cross-section, a length
    mass      the mass of the body
    """

    radius: Expr
    section: Expr
    mass: Expr
    id, is_round = "torus", True

    def check_sizes(self) -> None:
        super().check_sizes()
        if sign_known(self.radius - self.section) == -1:
            message = f"{self.name} needs a cross-section whose radius is not greater than the radius of the ring"
            raise Rejected(Complaint("sizes", message, help="`section` is the radius of the cross-section"))

    @property
    def extent(self) -> Expr:
        """The volume by Pappus: the area of the cross-section times the path length of its centre."""
        return Factors(2, pi**2, self.radius, self.section**2)

    def map(self) -> Map:
        """Variables: distance s from the middle of the cross-section, angle u round this middle, angle phi about z."""
        s, u, phi = coordinates(("s", "u", "phi"), self.letters)
        across = self.radius + s * cos(u)
        limits = ((s, ZERO, self.section), (u, ZERO, 2 * pi), (phi, ZERO, 2 * pi))
        return column(across * cos(phi), across * sin(phi), s * sin(u)), limits

    @property
    def boundary(self) -> Toroidal:
        return Toroidal(self.radius, self.section)

    def particles(self) -> Particles:
        """The particles of five rings, one through each particle of the cross-section. The mass of a ring is the mass
        of this particle times the radius of the ring divided by `radius`."""
        found: Particles = []
        for share, place in disc_of_particles(self.mass, self.section, ZERO):
            radius = self.radius + place[0]
            found += ring_of_particles(share * radius / self.radius, radius, place[1])
        return found


VOLUME = Rule(
    "bodies.volume",
    source="Apostol, *Calculus*, volume 2, section 11.17 (theorem of Pappus)",
    outcomes={"cylindrical": claims.volume_cylindrical},
    evidence={"pappus": ROUTE},
    statements=[claims.volume_of_its_sections],
    shown=Shown(brief=Manner.TAKEN_IN, standard=Manner.TAKEN_IN),
)


def volume(body: Cone) -> Quantity:
    """Volume of a cone, V = integral of dV.

    body    radius R, height h

    Second route: by the theorem of Pappus, the area of half the axial section times the path length of the centroid of
    this half.
    Outcomes: cylindrical (the coordinates of the integral).
    Source: Apostol, *Calculus*, volume 2, section 11.17 (theorem of Pappus).
    """
    start = body.point(body.reference)
    region = body.region(start)
    return establish(
        VOLUME,
        Symbol("V" if Symbol("V", positive=True) not in body.mass.free_symbols else "V_0", positive=True),
        lambda *_: region.integral(Integer(1)),
        {},
        parents=body.radii(start, region),
        facts=[Integrated.over(region)],
        phrase_data=PhraseData(outcome_data={"element": region.element, "radius": region.names[2]}),
        lines=Lines(between=worked_integral(region, Integer(1), Integer(1), Integer(1)), put_in=None),
        routes={"pappus": lambda value: (value, _by_pappus(body))},
        outcome="cylindrical",
        kind="volume",
        scope=Scope(about=Subject(body=body)),
    )


def _by_pappus(body: Cone) -> Expr:
    """Pappus: the triangle of the apex, the centre of the base and a point of the rim has the area R h/2 and its
    centroid at r = R/3.
    """
    corners = [(Integer(0), Integer(0)), (Integer(0), body.height), (body.radius, body.height)]
    (r1, z1), (r2, z2), (r3, z3) = corners
    area = ((r2 - r1) * (z3 - z1) - (r3 - r1) * (z2 - z1)) / 2
    return 2 * pi * (r1 + r2 + r3) / 3 * (-area)


def _is_of_a_ball(radius: Expr, along: Symbol) -> bool:
    """Whether r^2 + (z - c)^2 is constant for some c, so that the cross-sections are the cross-sections of a ball."""
    return is_zero(diff(explicit(radius) ** 2, along, 2) + 2)


SECTION_RADIUS = Rule(
    "bodies.section_radius",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    outcomes={
        "straight": claims.section_radius_straight,
        "ball": claims.is_of_a_ball,
        "curved": claims.section_radius_curved,
    },
    evidence={"edge": CHECK},
    statements=[claims.section_as_told],
    shown=Shown(brief=Manner.TOLD, standard=Manner.TOLD),
)


def _section_radius(body: RoundSolid, point: Point, region: Region) -> Quantity:
    """The radius of the cross-section at z, such as R z/h or sqrt(R^2 - z^2), with z measured from a point of the
    axis."""
    symbol, value = region.section or (None, None)
    z = region.names[0]
    polar = _polar_coordinates(region)
    return establish(
        SECTION_RADIUS,
        symbol,
        lambda _: value,
        {"along": z},
        routes={"edge": lambda r: body.edge_condition(point.along_body(z), r)},
        outcome=lambda radius: (
            "straight" if body.boundary.is_straight else "ball" if _is_of_a_ball(radius, z) else "curved"
        ),
        kind="length",
        lines=Lines(put_in=None),
        scope=Scope(coordinates={z: "length"}, about=Subject(body=body, point=point)),
        phrase_data=PhraseData(
            words={"start": point.name, **({"polar": point.name} if polar else {})},
            formulas=polar,
            outcome_data={"element": region.element, "names": list(region.names)},
        ),
        key="section_radius" if point.name == body.reference else f"section_radius_from_{point.name}",
    )


def _polar_coordinates(region: Region) -> dict[str, tuple[Expr, Expr]]:
    """The formulas x = s cos(phi) and y = s sin(phi) in cylindrical coordinates; empty in Cartesian coordinates."""
    if region.element == 1:
        return {}
    _, phi, s = region.names
    return {"x_is": (s * cos(phi), region.position[0]), "y_is": (s * sin(phi), region.position[1])}
