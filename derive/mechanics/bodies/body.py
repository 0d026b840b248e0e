"""Bodies: the region that the mass fills, the density, the centre of mass, and the named points and directions.

Every body has body axes. Positions along these axes have the unit of the sizes of the body. A plate and a cuboid have
their edges along these axes and a corner at the origin. Each standard shape that is round about an axis has this axis
along z.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, ClassVar, Self

from sympy import Expr, ImmutableDenseMatrix, Integer, MatMul, Pow, Symbol, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.direction import Direction
from derive.algebra.expressions import AXES, Ratio, column, explicit, vector
from derive.errors import Complaint, Rejected, Spelled, Unverified
from derive.mechanics.bodies import claims
from derive.mechanics.bodies.boundary import Boundary, Hollowed, Round, of_map
from derive.mechanics.bodies.components import centre_component, is_its_own_image, is_round_solid
from derive.mechanics.bodies.equimomental import OfParticles, Particles, summed, without
from derive.mechanics.bodies.facts import CountedFrom
from derive.mechanics.bodies.landmarks import is_where_named
from derive.mechanics.bodies.mapping import Map, cell, cylindrical, from_point
from derive.mechanics.bodies.parts import PlacedPart, name_of_body
from derive.mechanics.bodies.placed import Placeable
from derive.mechanics.bodies.possible import require_positive
from derive.mechanics.bodies.regions import Point, Region, no_such_coordinates
from derive.steps.claims import lasts
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.record import free_letter
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.signs import sign_known
from derive.steps.step import Form, Level, Quantity, is_zero
from derive.steps.subject import Subject

__all__ = ["centre_of_mass", "density"]

ZERO = Integer(0)
ORIGIN = column(0, 0, 0)

# what the mass of a body fills -> symbol and kind of the density
DENSITIES = {
    "volume": ("rho", "density"),
    "area": ("sigma", "surface density"),
    "length": ("lambda", "line density"),
}


class Body(Placeable, OfParticles):
    """The common base of all bodies whose distribution of mass is known; a body given only by its moments is a
    `RigidBody`.

    A subclass defines the named points, the region of integration and the size. A subclass also defines a few
    particles, which together have the mass, the centre of mass and the second moments of the body.
    """

    mass: Expr
    filling: ClassVar[str] = "volume"
    reference: ClassVar[str] = "centre"  # the named point from which positions are measured by default
    other_centre: ClassVar[str] = ""  # a point that readers may call "centre", although it is not the centre of mass
    called: str = ""  # the name of the body on a page with several bodies, such as "upper rod"
    names_given: tuple[str, ...] = ()  # names that the author gave to points; their positions are not checked
    is_lopsided: ClassVar[bool] = False  # whether the body may lack the inversion symmetry that its particles have
    is_round: ClassVar[bool] = False  # whether the shape is symmetric under every rotation about z
    systems: ClassVar[tuple[str, ...]] = ("cartesian",)  # coordinate systems in which the integrals have known limits
    is_integrated: bool = False  # whether a page integrates a standard moment of inertia in place of quoting it

    def __post_init__(self) -> None:
        self.check_sizes()

    def check_sizes(self) -> None:
        """Reject a mass or a size that is known to be zero or negative."""
        require_positive(self.name, "mass", self.mass)
        for role, size in self.measures.items():
            for each in size if isinstance(size, tuple) else (size,):
                if isinstance(each, Expr | int):
                    require_positive(self.name, role.replace("_", " "), each)

    def integrated(self) -> Self:
        """Return the same body; a page then integrates a standard moment of inertia in place of quoting it."""
        return self._with("is_integrated", True)

    def named(self, called: str) -> Self:
        """Return the same body with a name, for a page with several bodies: steps, symbols and words include the name.

        called   one or two words; with "upper rod", keys begin with `upper_rod_` and symbols have the index `upper`
        """
        return self._with("called", name_of_body(called))

    def _with(self, name: str, value: Any) -> Self:
        twin = copy(self)
        for known in [each for each in vars(twin) if isinstance(getattr(type(self), each, None), cached_property)]:
            del vars(twin)[known]
        object.__setattr__(twin, name, value)
        return twin

    def at(self, *place: Any, of: str = "centre") -> PlacedPart:
        """Return this body as a part of a larger body, with its point named `of` at a place: x, y or x, y, z, or one
        argument with these components, such as `point(x, y)`."""
        return PlacedPart(self, of, self.point(of).position).at(*place, of=of)

    def turned(self, axis: Any, angle: Any) -> PlacedPart:
        """Return this body as a part of a larger body, rotated right-handed about an axis through its own centre of
        mass. This axis is parallel to an axis of the larger body."""
        return PlacedPart(self, "centre", self.point("centre").position).turned(axis, angle)

    def map(self) -> Map:
        """The position along the body axes as a formula, and the limits of the variables of this formula, outermost
        first."""
        raise AttributeError(f"{type(self).__name__} must define its position map")

    @property
    def boundary(self) -> Boundary | None:
        return of_map(*self.map())

    @property
    def profile(self) -> Expr:
        """The density up to a constant factor, as a function of the variables of the map."""
        return Integer(1)

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        """The region that the body fills, relative to a point; by default in the first of the body's coordinate
        systems."""
        position, limits = self.map()
        sizes = (each if isinstance(each, tuple) else (each,) for each in self.measures.values())
        return from_point(point, position, limits, cell(position, limits, tuple(size for own in sizes for size in own)))

    def points(self) -> Mapping[str, Point]:
        """The named points of the body. The centre of mass may be missing here, because `point()` adds it."""
        return {self.reference: Point(self.reference, ORIGIN)}

    @property
    def flat_across(self) -> str | None:
        """The first axis whose coordinate is zero everywhere in the body, "x" for a rod along z; None if there is no
        such axis."""
        return next((axis for axis, x in zip("xyz", self.map()[0], strict=True) if x == 0), None)

    @property
    def extent(self) -> Expr | Quantity:
        """The volume, area or length of the body: a step if it must be derived, otherwise a formula."""
        raise AttributeError(f"{type(self).__name__} must define its volume, area or length")

    @property
    def measures(self) -> Mapping[str, Any]:
        """Name -> value, for the lengths and angles that define the size of the body; lengths of the same name form a
        tuple."""
        own: Any = self
        return {each.name: getattr(self, each.name) for each in fields(own) if each.name != "mass"}

    @property
    def letters(self) -> set[Symbol]:
        """The symbols in the sizes of the body; variables of integration must differ from these symbols."""
        own: Any = self
        return _letters_of([getattr(own, each.name) for each in fields(own) if each.name != "mass"])

    def radii(self, point: Point, region: Region) -> list[Quantity]:
        """The steps for the radii that appear in the limits of integration over a region; empty by default."""
        return []

    @cached_property
    def middle(self) -> Point:
        """The centre of mass, from the particles of the body."""
        total = summed(self.particles(), lambda r: r)
        return Point("centre", ImmutableDenseMatrix((total / self.mass).applyfunc(lambda x: x.cancel())))

    def point(self, name: str) -> Point:
        points = {**self.points(), "centre": self.middle}
        if name not in points:
            known = ", ".join(f'"{known}"' for known in points)
            raise Rejected(Complaint("no-such-point", f'{self.name} has no point "{name}"', help=f"it has {known}"))
        if name not in self._points_seen:
            if not is_where_named(self, points[name]):
                raise Unverified(Complaint("unverified", f"{self.name} has no {name} at {points[name].position}"))
            self._points_seen.add(name)
        return points[name]

    @cached_property
    def _points_seen(self) -> set[str]:
        """The names of points whose positions have already been checked."""
        return set()

    def within(self, point: Point, coordinates: str | None = None) -> Region:
        """The region that the body fills; coordinates in which the limits are unknown are an error."""
        if coordinates is not None and coordinates not in self.systems:
            raise no_such_coordinates(self.name, coordinates, self.systems)
        return self.region(point, coordinates)

    @cached_property
    def density(self) -> Quantity:
        return density(self)

    @cached_property
    def centre(self) -> Quantity:
        return centre_of_mass(self)

    @property
    def mass_as_found(self) -> Quantity | Expr:
        """The mass: the step that derives the mass, or the given value."""
        return self.mass

    @property
    def front(self) -> Expr:
        """The constant factor of the density, in front of an integral; by default the symbol of the density."""
        letter: Expr = self.density.symbol
        return letter

    @property
    def density_letter(self) -> str:
        return DENSITIES[self.filling][0]

    @property
    def size(self) -> Expr:
        """The value of the volume, area or length of the body."""
        extent = self.extent
        return extent.value if isinstance(extent, Quantity) else explicit(extent)

    def over_mass(self, integrand: Callable[[ImmutableMatrix], Any], point: Point) -> Any:
        """The evaluated integral of f(r) dm, where the position r is measured from a point."""
        region = self.region(point).with_section_put_in()
        values, density = explicit(integrand(region.position)), self.mass / self.size
        if hasattr(values, "applyfunc"):
            return values.applyfunc(lambda f: density * explicit(region.integral(f)))
        return density * explicit(region.integral(values))

    def direction(self, axis: Direction, symbol: str = "d", key: str = "axis_vector") -> Quantity:
        """Return a vector along an axis that is given by its name or by components."""
        named = self.axes_by_name()
        if axis.name is not None and axis.name not in named:
            known = list(named)
            message = f"{self.name} has no axis `{axis.name}`"
            raise Rejected(Complaint("no-such-axis", message, help=f"use {', '.join(known[:-1])} or {known[-1]}"))
        along = named[axis.name] if axis.name is not None else column(*(axis.components or ()))
        return axis_vector(self, along, axis.name or "components", symbol, key)

    def derived_centre(self, start: Point, symbol: str, key: str) -> Quantity | None:
        """The centre of mass relative to a point, if the body has a special derivation; None by default."""
        return None

    def derived_tensor(self, point: Point, symbol: str, key: str) -> Quantity | None:
        """The inertia tensor about a point, if the body has a special derivation; None by default."""
        return None

    def derived_moment(self, axis: str, point: Point, symbol: str, key: str) -> Quantity | None:
        """The moment of inertia about an axis through a point, if the body has a special derivation; None by
        default."""
        return None

    def axes_by_name(self) -> Mapping[str, ImmutableMatrix]:
        return {name: column(*(int(name == other) for other in "xyz")) for name in "xyz"}


class RoundBody(Body):
    """A body that is round about the z axis; its radius is a function of z between two ends."""

    is_round: ClassVar[bool] = True

    @property
    def ends(self) -> tuple[Expr, Expr]:
        """The smallest and the largest z of the body."""
        raise AttributeError(f"{type(self).__name__} must define its smallest and its largest z")

    def radius_at(self, z: Expr) -> Expr:
        """The radius of the cross-section at z."""
        raise AttributeError(f"{type(self).__name__} must define its radius")

    def map(self) -> Map:
        """Cylindrical coordinates z, phi and r; for a shell or a hoop r is the radius at z, for a rod r is zero."""
        low, high = self.ends
        z = low if low == high else (low, high)
        if self.filling == ("area" if z != low else "length"):
            return cylindrical(self.letters, z, self.radius_at)
        return cylindrical(self.letters, z, 0 if self.filling == "length" else (0, self.radius_at))

    @property
    def boundary(self) -> Round:
        return Round(self.ends, self.radius_at, self.filling == "length")


@dataclass(frozen=True)
class OfRadius(Body):
    """A body defined by one radius."""

    radius: Expr
    mass: Expr


@dataclass(frozen=True)
class OfHeight(Body):
    """A body from z = 0 to z = height, whose cross-section is defined by a radius."""

    radius: Expr
    height: Expr
    mass: Expr

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return ZERO, self.height


class Spherical(OfRadius, RoundBody):
    """A body whose curved outer surface is a sphere about the origin, or a part of such a sphere."""

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return -self.radius, self.radius

    def radius_at(self, z: Expr) -> Expr:
        return sqrt(self.radius**2 - z**2)


class Cylindrical(OfHeight, RoundBody):
    """A body whose curved outer surface is a cylinder about the z axis."""

    def radius_at(self, z: Expr) -> Expr:
        return self.radius


class Conical(OfHeight, RoundBody):
    """A body whose curved outer surface is a cone with its apex at the origin.

    radius   the radius at z = height
    """

    def radius_at(self, z: Expr) -> Expr:
        return self.radius * z / self.height


class Hollow(Body):
    """A round body with a concentric cavity of the same shape.

    inner, outer   the radius of the cavity, and the outer radius of the body

    Errors: the inner radius is known to be greater than the outer radius, or equal to it.
    """

    inner: Expr
    outer: Expr
    power: ClassVar[int]  # the mass of a body without a cavity is proportional to this power of its radius
    is_round: ClassVar[bool] = True

    def check_sizes(self) -> None:
        super().check_sizes()
        require_order(self.name, self.inner, self.outer)

    @property
    def measures(self) -> Mapping[str, Any]:
        own = {"inner": "inner_radius", "outer": "outer_radius"}
        return {own.get(id, id): size for id, size in super().measures.items()}

    def filled(self, radius: Expr, mass: Expr) -> RoundBody:
        """The body of the same shape without a cavity."""
        raise AttributeError(f"{type(self).__name__} must define the body without the cavity")

    def whole_and_removed(self) -> tuple[RoundBody, RoundBody]:
        between = self.outer**self.power - self.inner**self.power
        whole, removed = (self.filled(r, self.mass * r**self.power / between) for r in (self.outer, self.inner))
        return whole, removed

    @property
    def boundary(self) -> Hollowed:
        return Hollowed(*(each.boundary for each in self.whole_and_removed()))

    def particles(self) -> Particles:
        """The particles of the full body, and the particles of the removed body with negative masses."""
        whole, removed = self.whole_and_removed()
        return without(whole.particles(), removed.particles())


def require_order(body: str, inner: Expr, outer: Expr) -> None:
    if sign_known(outer - inner) in (0, -1):
        message = f"{body} needs an outer radius that is greater than its inner radius"
        first = "give the inner radius first, then the larger outer radius"
        raise Rejected(Complaint("sizes", message, help=Spelled(first, "make `inner` smaller than `outer`")))


def _letters_of(size: Any) -> set[Symbol]:
    if isinstance(size, tuple | list):
        return {letter for each in size for letter in _letters_of(each)}
    return size.letters if isinstance(size, Body) else set(getattr(size, "free_symbols", ()))


AXIS_VECTOR = Rule(
    "bodies.axis_vector",
    source="none needed",
    outcomes={"diagonal": claims.joins_corners, "edge": claims.along_the_edge, "components": lasts},
    statements=[claims.axis_as_named],
    shown=Shown(brief=Manner.TAKEN_IN, standard=Manner.TAKEN_IN),
)


def axis_vector(
    body: Body | None, along: ImmutableMatrix, name: str, symbol: str = "d", key: str = "axis_vector"
) -> Quantity:
    """Vector d along an axis, by its components along the body axes: a definition.

    Outcomes: diagonal (from corner to opposite corner), edge, components.
    Source: none needed.
    """
    return establish(
        AXIS_VECTOR,
        vector(symbol),
        lambda: along,
        {},
        outcome="edge" if name in {"x", "y", "z"} else name,
        phrase_data=PhraseData(words={"axis": name}),
        key=key,
        scope=Scope(about=Subject(body=body)),
    )


DENSITY = Rule(
    "bodies.density",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    outcomes={
        "along_edges": claims.has_edges,
        "volume": claims.density_volume,
        "area": claims.dimensions_of_filling(2),
        "length": claims.dimensions_of_filling(1),
        "derived": claims.density_derived,
    },
    evidence={"mass_given_back": CHECK},
    shown=Shown(brief=Manner.TOLD, standard=Manner.TOLD),
)


def density(body: Body, symbol: str | None = None, key: str = "density", part: str | None = None) -> Quantity:
    """Density of a uniform body, rho = M/V; for a thin body sigma = M/A or lambda = M/l.

    body    a body with the mass M and the volume V, area A or length l
    part    the name of the body, if the page has several bodies

    Check: the integral of the density over the body gives M back.
    Outcomes: along_edges (a cuboid); volume, area, length (what the mass fills); derived (a step derives the size).
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    extent = body.extent
    usual, kind = DENSITIES[body.filling]
    letter = usual if body.called else free_letter(usual)
    region = body.region(body.point(body.reference)).with_section_put_in()
    return establish(
        DENSITY,
        Symbol(symbol or letter, positive=True),
        lambda mass, extent: Ratio(mass, extent),
        {"mass": body.mass, "extent": extent},
        routes={"mass_given_back": lambda rho: (region.integral(rho), body.mass)},
        outcome=_density_outcome(body, extent),
        kind=kind,
        key=key,
        phrase_data=PhraseData(words={"part": part} if part else {}),
        scope=Scope(about=Subject(body=body)),
    )


def _density_outcome(body: Body, extent: Expr | Quantity) -> str:
    """The outcome of a density. For a block, the sentence about the density also describes the body axes."""
    if body.reference == "corner" and body.filling == "volume":
        return "along_edges"
    if isinstance(extent, Quantity):
        return "derived"
    return {"volume": "volume", "area": "area"}.get(body.filling, "length")


CENTRE_OF_MASS = Rule(
    "bodies.centre_of_mass",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2",
    outcomes={
        "generic": claims.is_symmetric_about_its_centre,
        "by_components": claims.centre_of_mass_by_components,
        "there": claims.centre_of_mass_there,
        "round": claims.on_the_axis,
    },
    evidence={"particles": ROUTE, "quadrature": CHECK},
    statements=[claims.counted_from_its_point],
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def centre_of_mass(
    body: Body,
    origin: str | None = None,
    coordinates: str | None = None,
    symbol: str = "r_C",
    key: str = "centre_of_mass",
) -> Quantity:
    """Centre of mass, r_C = (1/M) integral of r dm, measured from a named point of the body.

    body         a body with a mass and a region
    origin       the name of the point from which to measure; by default the `reference` of the body
    coordinates  "cartesian" or "cylindrical", for a body whose limits are known in both systems

    For a round solid, one step derives the component along the axis. For any other body without inversion symmetry, a
    step derives each component that is not zero.
    Second route: the mean position of the body's equimomental particles.
    Check: for a body defined by a position map, a numerical sum over cells takes the place of the second route.
    Outcomes: round (a round solid); generic (another body with inversion symmetry); by_components (steps derive the
    components); there (the centre of mass is at the named point).
    Errors: the body has no such point or no such coordinates.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2.
    """
    start = body.point(origin or body.reference)
    in_its_way = body.derived_centre(start, symbol, key)
    if in_its_way is not None:
        return in_its_way
    region = body.within(start, coordinates)
    whole = region.with_section_put_in().mass_integral(vector("r"), body.front)
    on_axis, is_even = is_round_solid(body), is_its_own_image(body)
    there = start.seen(body.middle.position)
    apart = [2] if on_axis else [k for k in range(3) if not (is_even or is_zero(there[k]))]
    names = {k: f"{key}_{'on_axis' if on_axis else AXES[k]}" for k in apart}
    found = {k: centre_component(body, AXES[k], start.name, coordinates, symbol, name) for k, name in names.items()}
    left = column(*(found[k].symbol if k in found else Integer(0) for k in range(3)))
    return establish(
        CENTRE_OF_MASS,
        vector(symbol),
        lambda mass: MatMul(Pow(mass, -1), whole, evaluate=False),
        {"mass": body.mass_as_found},
        routes=body.another_way(lambda r: r / body.mass, start),
        outcome="round" if on_axis else "generic" if is_even else "by_components" if found else "there",
        parents=[body.density, *found.values()],
        lines=Lines(
            between=[Form(left, "on_axis" if on_axis else "components", Level.STANDARD)] if found else [],
            put_in=Level.FULL,
        ),
        kind="length",
        facts=[CountedFrom(start)],
        phrase_data=PhraseData(words={"start": start.name}),
        key=key,
        scope=Scope(about=Subject(body=body, point=start)),
    )
