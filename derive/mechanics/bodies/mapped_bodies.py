"""Bodies defined by a position map: their cells, size, mass and density.

A position map consists of formulas for the components of the position, and of limits for the variables in these
formulas. A curve has one variable, a surface two, a solid three. The density is uniform, or a formula in the same
variables.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar

from sympy import Expr, ImmutableDenseMatrix, Integer, Pow, Symbol, cos, nan, oo, sin, zoo
from sympy.matrices import ImmutableMatrix

from derive.algebra.equality import Verdict
from derive.algebra.expressions import (
    Cross,
    Dot,
    Factors,
    Norm,
    Ratio,
    as_expr,
    explicit,
    scalar,
    vector,
)
from derive.algebra.integrals import definite
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies import claims
from derive.mechanics.bodies.body import DENSITIES, Body, density
from derive.mechanics.bodies.body import ORIGIN as ZERO
from derive.mechanics.bodies.equimomental import Particles, counted_from, from_moments
from derive.mechanics.bodies.integration import worked_integral
from derive.mechanics.bodies.mapping import cell, checked_limits, from_point, inside, tangents_of
from derive.mechanics.bodies.possible import check_map, require_positive
from derive.mechanics.bodies.quadrature import agrees, spanned
from derive.mechanics.bodies.regions import Bounds, Point, Region
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.step import Form, Quantity, Route
from derive.steps.subject import Subject

__all__ = [
    "Sheet",
    "Solid",
    "Wire",
    "cell_of",
    "mass_by_integration",
    "normalised_density",
    "size_by_integration",
    "variables",
]

ORIGIN = Point("origin", ZERO)
VARIABLES = {"length": 1, "area": 2, "volume": 3}  # what the mass fills -> the number of variables
LETTERS = {"length": "l", "area": "A", "volume": "V"}  # what the mass fills -> symbol of the size


def variables(*names: str) -> tuple[Symbol, ...]:
    """Real symbols for the variables of a body: `r, theta = variables("r", "theta")`."""
    return tuple(scalar(name) for name in names)


class GeneralBody(Body):
    """The common base of bodies defined by their position map."""

    reference: ClassVar[str] = "origin"
    is_lopsided: ClassVar[bool] = True  # no symmetry is tested, so none is used
    is_of_particles: ClassVar[bool] = False

    def __init__(
        self,
        position: Sequence[Any],
        limits: Mapping[Symbol, tuple[Any, Any]],
        mass: Expr | None = None,
        density: Expr | None = None,
    ):
        _check_map(type(self).__name__, VARIABLES[self.filling], position, limits, mass, density)
        given = Integer(1) if density is None else as_expr(density)
        self._position, self._limits = checked_limits((*position, 0, 0)[:3], limits, set())
        fresh = {u: scalar(u.name) for u in limits}
        outside, self._profile = given.xreplace(fresh).as_independent(*fresh.values(), as_Add=False)
        self.given_mass, self.given_density = mass, None if density is None else outside
        next(inside(self._limits, looks=1))  # raises an error if no random numbers put the limits in order
        self._mapped = cell(self._position, self._limits)
        if self._mapped == 0:
            message = (
                f"the position of this `{type(self).__name__}` does not vary independently with each of its variables"
            )
            help_line = "a curve has one variable, a surface two, a solid three"
            raise Rejected(Complaint("no-size", message, help=help_line))
        if mass is not None:
            require_positive(self.name, "mass", mass)
        check_map(type(self).__name__, self._position, self._limits, given.xreplace(fresh), mass is None)

    def __repr__(self) -> str:
        """Return a text that is the same in each process, because the digest of a problem depends on this text."""
        given = (self._position, self._limits, self._profile, self.given_mass, self.given_density, self.called)
        return f"{type(self).__name__}{given}"

    @property
    def is_uniform(self) -> bool:
        return bool(self._profile == 1)

    @property
    def front(self) -> Expr:
        if self.given_mass is None and self.given_density is not None:
            return self.given_density
        return super().front if self.is_uniform else self.mass / self.size

    @property
    def measures(self) -> Mapping[str, Any]:
        """Empty: the position map defines the size of the body, so there are no named lengths."""
        return {}

    @property
    def profile(self) -> Expr:
        return self._profile

    def map(self) -> tuple[ImmutableMatrix, Bounds]:
        return self._position, self._limits

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        """The region of the body: its cells, weighted by the density up to a constant factor."""
        return from_point(point, self._position, self._limits, tidied(self._mapped * self._profile))

    @property
    def size(self) -> Expr:
        """The integral of the density without its constant factor: for a uniform body, the volume, area or length."""
        return exact(self, self._profile * self._mapped, "size")

    @cached_property
    def extent(self) -> Expr | Quantity:
        return size_by_integration(self) if self.is_uniform else self.size

    @cached_property
    def mass(self) -> Expr:
        return self.given_mass if self.given_mass is not None else tidied(self.given_density * self.size)

    @cached_property
    def density(self) -> Quantity:
        """The step that derives the density; if only the density is given, the step that derives the mass."""
        if self.given_mass is None:
            return mass_by_integration(self)
        return density(self) if self.is_uniform else normalised_density(self)

    @property
    def mass_as_found(self) -> Quantity | Expr:
        return self.density if self.given_mass is None else self.mass

    @cached_property
    def middle(self) -> Point:
        first = [exact(self, x * self._profile * self._mapped, "centre") / self.size for x in self._position]
        return Point("centre", ImmutableDenseMatrix(3, 1, [tidied(x) for x in first]))

    def particles(self) -> Particles:
        """Particles with the moments of the body. The moments are integrals, so these particles cannot check an
        integral."""
        return self._equimomental

    @cached_property
    def _equimomental(self) -> Particles:
        centre = self.middle
        r = centre.seen(self._position)
        weight = self.mass / self.size * self._profile * self._mapped
        second = ImmutableDenseMatrix(3, 3, lambda i, j: tidied(exact(self, weight * r[i] * r[j], "inertia")))
        return from_moments(self.mass, centre.position, second)

    def another_way(
        self, integrand: Callable[[ImmutableMatrix], Any], point: Point, of: Callable[[Any], Any] = lambda found: found
    ) -> dict[str, Route]:
        """A check by a numerical sum over cells, in place of a second route by particles: the particles of this body
        come from integrals."""
        position, limits = self.map()

        def by_cells(found: Any) -> Verdict:
            there = self.mass / self.size * self._profile * explicit(integrand(counted_from(point, position)))
            return agrees(of(found), there, position, limits)

        return {"quadrature": by_cells}


class Wire(GeneralBody):
    """Mass along a curve: `Wire((x, y, z), {u: (a, b)}, mass=M)`.

    position   two or three lengths, formulas in the variable
    limits     the variable with its lower and its upper limit
    mass       the mass; needed if there is no `density`
    density    mass per length, a formula in the variable; if the mass is given too, the density is proportional to this
               formula
    """

    id: ClassVar[str] = "wire"
    filling: ClassVar[str] = "length"


class Sheet(GeneralBody):
    """Mass on a surface, flat or curved: `Sheet((x, y, z), {u: (a, b), v: (c, d)}, mass=M)`.

    position   two or three lengths, formulas in the variables
    limits     each variable with its lower and upper limit; a limit may depend on variables that are named earlier
    mass       the mass; needed if there is no `density`
    density    mass per area, a formula in the variables; if the mass is given too, the density is proportional to this
               formula
    """

    id: ClassVar[str] = "sheet"
    filling: ClassVar[str] = "area"


class Solid(GeneralBody):
    """Mass in a volume: `Solid((x, y, z), {u: (a, b), v: (c, d), w: (e, f)}, mass=M)`.

    position   three lengths, formulas in the variables
    limits     each variable with its lower and upper limit; a limit may depend on variables that are named earlier
    mass       the mass; needed if there is no `density`
    density    mass per volume, a formula in the variables; if the mass is given too, the density is proportional to
               this formula
    """

    id: ClassVar[str] = "solid"
    filling: ClassVar[str] = "volume"


def _check_map(name: str, count: int, position: Any, limits: Any, mass: Any, density: Any) -> None:
    if not isinstance(limits, Mapping) or len(limits) != count or not all(isinstance(u, Symbol) for u in limits):
        what = {1: "one variable", 2: "two variables", 3: "three variables"}[count]
        message = f"`{name}` needs {what} with its limits" if count == 1 else f"`{name}` needs {what} with their limits"
        raise Rejected(Complaint("wrong-argument", message, help="write {u: (a, b), ...}, the outermost first"))
    if not all(isinstance(ends, tuple | list) and len(ends) == 2 for ends in limits.values()):
        raise Rejected(Complaint("wrong-argument", f"each variable of `{name}` needs a lower and an upper limit"))
    if len(position) not in ({3} if count == 3 else {2, 3}):
        components = "three" if count == 3 else "two or three"
        raise Rejected(Complaint("wrong-argument", f"`{name}` needs a position with {components} components"))
    if mass is None and density is None:
        raise Rejected(Complaint("no-mass", f"`{name}` needs a mass or a density", help="add `mass=` or `density=`"))


def exact(body: GeneralBody, integrand: Expr, what: str) -> Expr:
    """An exact integral over the variables, by antiderivatives term by term."""
    _, limits = body.map()
    found = definite(integrand, list(reversed(limits)))
    if found is None or found.has(nan, zoo, oo):
        message = f"the {what} of {body.name} needs an integral that is not finite or has no known antiderivative"
        help_line = "choose variables in which the integrand consists of powers, sines and cosines"
        raise Rejected(Complaint("no-antiderivative", message, help=help_line))
    return tidied(found)


CELL_OF = Rule(
    "bodies.cell_of",
    source="Apostol, *Calculus*, volume 2, sections 11.32 and 12.5",
    outcomes={
        "curve": claims.with_variables(1),
        "surface": claims.with_variables(2),
        "solid": claims.with_variables(3),
    },
    evidence={"chords": ROUTE, "edges": CHECK},
    statements=[claims.cell_is_positive],
    named={"cell": claims.size_of_a_cell, "place": claims.mapped_to, "u": claims.variable_of_the_map},
)


def cell_of(body: GeneralBody, key: str = "cell") -> Quantity:
    """Size of a cell: r_u . (r_v x r_w) for a solid; its square |r_u x r_v|^2 for a surface and |r_u|^2 for a curve.

    body   a body defined by its position map

    Second route: the square of the size is det(r_i . r_j), with scalar products from squared distances of neighbouring
    points.
    Check: for a solid, the size agrees numerically with the signed volume that small edges span.
    Outcomes: curve, surface, solid.
    Source: Apostol, *Calculus*, volume 2, sections 11.32 and 12.5.
    """
    position, limits = body.map()
    names = [x for x, _, _ in limits]
    tangents = tangents_of(position, names)
    letters = [vector(f"r_{x.name}") for x in names]
    n = len(names)

    def size(*t: Any) -> Expr:
        if n == 3:
            return Dot(t[0], Cross(t[1], t[2]))
        return Pow(Norm(t[0] if n == 1 else Cross(t[0], t[1])), 2)

    size_now = cell(position, limits)
    return establish(
        CELL_OF,
        size(*letters),
        lambda: size(*tangents),
        {},
        key=key,
        routes={
            "chords": lambda found: (found**2 if n == 3 else found, _determinant_of_chords(position, names)),
            **({"edges": lambda found: spanned(found, position, limits)} if n == 3 else {}),
        },
        outcome={1: "curve", 2: "surface", 3: "solid"}[n],
        lines=Lines(put_in=None, means=dict(zip(letters, tangents, strict=True))),
        phrase_data=PhraseData(
            named={"cell": size_now, "place": position, **{f"u_{k}": x for k, x in enumerate(names)}},
            outcome_data={"limits": limits},
        ),
        scope=Scope(about=Subject(body=body), coordinates=_variables_of(body)),
    )


def _determinant_of_chords(position: ImmutableMatrix, names: Sequence[Symbol]) -> Expr:
    """Return det(r_i . r_j). Each r_i . r_j is half the second derivative, at zero distance, of the squared chord to a
    neighbouring point."""
    steps = [scalar(f"delta_{x.name}") for x in names]
    moved = position.xreplace({x: x + s for x, s in zip(names, steps, strict=True)}) - position
    chord = sum((x**2 for x in moved), Integer(0))
    here = dict.fromkeys(steps, Integer(0))
    entries = [[slope(slope(chord, s), u).xreplace(here) / 2 for u in steps] for s in steps]
    return ImmutableDenseMatrix(entries).det(method="berkowitz")


SIZE_BY_INTEGRATION = Rule(
    "bodies.size_by_integration",
    source="Apostol, *Calculus*, volume 2, sections 11.32 and 12.5",
    outcomes={word: claims.of_filling(word) for word in ("length", "area", "volume")},
    evidence={"quadrature": CHECK},
    shown=Shown(brief=Manner.TAKEN_IN),
)


def size_by_integration(body: GeneralBody) -> Quantity:
    """Length, area or volume of a body: the integral over its cells.

    body   a body defined by its position map

    Check: a numerical sum over cells; the size of each cell comes from the scalar products of its edges.
    Outcomes: length, area, volume.
    Source: Apostol, *Calculus*, volume 2, sections 11.32 and 12.5.
    """
    region = body.region(ORIGIN)
    kind, letter = body.filling, LETTERS[body.filling]
    exact(body, region.element, kind)
    return establish(
        SIZE_BY_INTEGRATION,
        Symbol(_free(body, letter, f"{letter}_0"), positive=True),
        lambda: region.integral(Integer(1)),
        {},
        key=kind,
        kind=kind,
        parents=_cells(body),
        routes={"quadrature": lambda found: agrees(found, [Integer(1)], *body.map())},
        outcome=kind,
        lines=Lines(between=worked_integral(region, Integer(1), Integer(1), Integer(1)), put_in=None),
        scope=Scope(about=Subject(body=body)),
    )


MASS_BY_INTEGRATION = Rule(
    "bodies.mass_by_integration",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    evidence={"quadrature": CHECK},
)


def mass_by_integration(body: GeneralBody, key: str = "mass") -> Quantity:
    """Mass of a body with a given density, M = integral of the density over the body.

    body   a body defined by its position map and its density

    Check: a numerical sum over cells; the size of each cell comes from the scalar products of its edges.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    region = body.region(ORIGIN)
    front = body.front
    return establish(
        MASS_BY_INTEGRATION,
        Symbol(_free(body, "M", "M_0"), positive=True),
        lambda: Factors(front, region.integral(Integer(1))),
        {},
        key=key,
        kind="mass",
        parents=_cells(body),
        routes={"quadrature": lambda found: agrees(found, [front * body.profile], *body.map())},
        lines=Lines(between=_without_last(worked_integral(region, Integer(1), front, body.size)), put_in=None),
        scope=Scope(about=Subject(body=body)),
    )


def _without_last(forms: list[Form]) -> list[Form]:
    """The lines of an integral, except the line that collects the mass: the mass is still unknown."""
    return [form for form in forms if form.because != "mass_collected"]


NORMALISED_DENSITY = Rule(
    "bodies.normalised_density",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    evidence={"mass_given_back": CHECK},
    named={"profile": claims.proportional_to},
)


def normalised_density(body: GeneralBody, key: str = "density") -> Quantity:
    """Density of a body of given mass, proportional to a function p of the position: rho = M p/(integral of p dV).

    body   a body defined by its position map, its mass and the function p

    Check: a numerical sum of the density times the size of each cell gives the mass back.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    region, p = body.region(ORIGIN), body.profile
    return establish(
        NORMALISED_DENSITY,
        scalar(body.density_letter),
        lambda mass: Factors(mass, Ratio(p, region.integral(Integer(1)))),
        {"mass": body.mass},
        key=key,
        kind=DENSITIES[body.filling][1],
        parents=_cells(body),
        routes={"mass_given_back": lambda rho: agrees(body.mass, [rho], *body.map())},
        lines=Lines(put_in=None),
        scope=Scope(about=Subject(body=body), coordinates=_variables_of(body)),
        phrase_data=PhraseData(named={"profile": p}),
    )


def _cells(body: GeneralBody) -> list[Quantity]:
    """The step for the cells of a body; none if the size of a cell is 1, as for Cartesian coordinates."""
    return [] if cell(*body.map()) == 1 else [cell_of(body)]


def _variables_of(body: GeneralBody) -> dict[Symbol, str]:
    position, limits = body.map()
    angles = {s for f in position.atoms(sin, cos) for s in f.free_symbols}
    kinds = {}
    for x, *ends in limits:
        kinds[x] = "angle" if x in angles else "length" if any(end.free_symbols for end in ends) else "number"
    return kinds


def _free(body: GeneralBody, *letters: str) -> str:
    position, limits = body.map()
    taken = {
        s.name for x in (*position, body.front if body.given_mass is None else body.given_mass) for s in x.free_symbols
    }
    taken |= {s.name for limit in limits for end in limit for s in end.free_symbols}
    return next((letter for letter in letters if letter not in taken), letters[-1])
