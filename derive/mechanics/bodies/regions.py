"""Regions of space that bodies fill, and the coordinates for integrals over these regions.

A region consists of limits, the position as a function of the coordinates, and a factor. This factor turns a product
of differentials into a volume, an area or a length; for cylindrical coordinates it is r.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, field
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Integral, Symbol, Tuple, eye, sin, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import MassIntegral, bound, column, scalar, vector
from derive.errors import Complaint, Rejected
from derive.steps.record import given_letters, named_coordinates

Bounds = tuple[tuple[Symbol, Expr, Expr], ...]

OTHERS = {  # coordinate -> alternative names
    "x": ("xi",),
    "y": ("eta",),
    "z": ("zeta",),
    "r": ("s", "q", "w"),
    "theta": ("phi", "chi", "beta"),
    "phi": ("chi", "psi", "beta"),
    "u": ("w",),
    "v": ("nu",),
    "s": ("q", "w"),
}

COORDINATES = ("cartesian", "cylindrical")
ALONG = ImmutableDenseMatrix(eye(3))  # the body's own axes


@dataclass(frozen=True)
class Point:
    """A named point of a body, in body axes, and the axes for positions measured from this point.

    axes    a matrix; its columns are the unit vectors of these axes, by components along the body axes
    """

    name: str
    position: ImmutableMatrix
    axes: ImmutableMatrix = ALONG

    def seen(self, place: ImmutableMatrix) -> ImmutableMatrix:
        """A place of the body, measured from this point, in components along the axes of the point."""
        way = place - self.position
        return ImmutableDenseMatrix((way if self.axes == ALONG else self.axes.T * way).expand())

    def interval(self, lower: Expr, upper: Expr) -> tuple[Expr, Expr]:
        """Limits of z in body axes, converted to limits of z measured from this point."""
        ends = [self.seen(column(self.position[0], self.position[1], end))[2] for end in (lower, upper)]
        return (ends[0], ends[1]) if self.axes[2, 2] == 1 else (ends[1], ends[0])

    def along_body(self, z: Expr) -> Expr:
        """The coordinate z measured from this point, converted to z in body axes."""
        return self.position[2] + self.axes[2, 2] * z


@dataclass(frozen=True)
class Region:
    """Limits, outermost first, with the position and the volume, area or line element in the same coordinates.

    section     a symbol in the limits for the radius of a cross-section, and its value; None if there is no such symbol
    """

    limits: Bounds
    position: ImmutableMatrix
    element: Expr = field(default_factory=lambda: Integer(1))
    section: tuple[Symbol, Expr] | None = None

    @property
    def names(self) -> tuple[Symbol, ...]:
        return tuple(x for x, _, _ in self.limits)

    @property
    def has_mirrors(self) -> bool:
        """Whether the limits show that all coordinate planes are mirror planes: each of x, y and z is zero or ranges
        between opposite constants, and the element contains no variable."""
        names = self.names
        opposite = all(lower == -upper and not upper.has(*names) for _, lower, upper in self.limits)
        return opposite and all(x in (*names, 0) for x in self.position) and not self.element.has(*names)

    def integral(self, integrand: Expr) -> Integral:
        """The unevaluated integral of a function of the coordinates."""
        return Integral(integrand * self.element, *reversed(self.limits))

    def mass_integral(self, integrand: Any, density: Expr) -> MassIntegral:
        """The unevaluated integral of f(r) dm, with f written in terms of the symbol r."""
        inward = [Tuple(*limit) for limit in reversed(self.limits)]
        whole: MassIntegral = MassIntegral(integrand, vector("r"), density, self.position, self.element, *inward)
        return whole

    def with_named_section(self, taken: Collection[Symbol], primed: str = "") -> Region:
        """The same region in cylindrical coordinates, with a symbol r for a radius that varies along the axis. The
        symbol of the distance from the axis, which ranges from 0 to r, is then s. A constant radius has no symbol.

        taken    symbols that are not available for r and s
        primed   text to append to the name of r, such as a prime
        """
        z, angle, (out, lower, upper) = self.limits
        if not upper.has(z[0]):
            return self
        (s, named) = coordinates(("s", "r"), {*taken, z[0], angle[0]})
        r = Symbol(named.name + primed, nonnegative=True)
        position = ImmutableDenseMatrix(self.position.xreplace({out: s}))
        if position[1] == -s * sin(angle[0]):  # reverse the angle; a full circle keeps its limits
            position = ImmutableDenseMatrix([position[0], -position[1], position[2]])
        return Region((z, angle, (s, lower, r)), position, self.element.xreplace({out: s}), section=(r, upper))

    def with_section_put_in(self) -> Region:
        """The same region, with the value of the radius of the cross-section substituted in the limits."""
        if self.section is None:
            return self
        values = dict([self.section])
        limits = tuple((x, bound(lower, values), bound(upper, values)) for x, lower, upper in self.limits)
        return Region(limits, self.position, self.element)


def coordinates(names: Iterable[str], taken: Collection[Symbol]) -> list[Symbol]:
    """Symbols for coordinates, for example r, or s if r is taken. If `OTHERS` has enough names, the symbols
    differ from each other, from the symbols in `taken` and from the letters of the problem."""
    letters = {letter.name for letter in (*taken, *named_coordinates())} | given_letters()
    found: list[str] = []
    wanted = list(names)
    for name in wanted:
        spoken_for = letters | {*found, *(other for other in wanted if other != name)}
        found.append(next((other for other in (name, *OTHERS[name]) if other not in spoken_for), OTHERS[name][-1]))
    return [scalar(name) for name in found]


def round_by_chords(
    radius_at: Callable[[Expr], Expr], ends: tuple[Expr, Expr], point: Point, primed: str = ""
) -> Region:
    """The region within the distance radius_at(z) of the z axis of the body, in coordinates x, y, z measured from a
    point.

    ends     the limits of z in body axes
    primed   text to append to the name of the radius, such as a prime
    """
    taken = {letter for end in ends for letter in end.free_symbols | radius_at(end).free_symbols}
    z, x, y = coordinates("zxy", taken)
    _check_sign(radius_at, ends)
    edge = radius_at(point.along_body(z))
    varies = edge.has(z)
    r = Symbol(coordinates("r", taken)[0].name + primed, nonnegative=True) if varies else edge
    a, b = (point.axes.T * point.position)[:2]
    chord = sqrt(r**2 - (y + b) ** 2)
    limits = ((z, *point.interval(*ends)), (y, -r - b, r - b), (x, -chord - a, chord - a))
    return Region(limits, column(x, y, z), section=(r, edge) if varies else None)


def _check_sign(radius_at: Callable[[Expr], Expr], ends: tuple[Expr, Expr]) -> None:
    """Reject a radius that may be negative at an end, because the ends of a chord would then be in the wrong order."""
    unsure = next((radius for radius in map(radius_at, ends) if not radius.is_nonnegative), None)
    if unsure is not None:
        message = f"the radius `{unsure}` may be negative, but Cartesian limits need a radius that is not negative"
        help_line = "give the radius a separate symbol, or use cylindrical coordinates"
        raise Rejected(Complaint("unknown-sign", message, help=help_line))


def no_such_coordinates(body: str, wanted: str, known: Iterable[str]) -> Rejected:
    message = f'{body} has no limits in "{wanted}" coordinates'
    return Rejected(Complaint("no-such-coordinates", message, help="it has " + ", ".join(f'"{k}"' for k in known)))
