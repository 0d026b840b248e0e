"""Mass, length and time: the kinds of quantity, and the dimension of an expression.

A kind is what an instructor writes under `symbols:` (`M: mass`). Every kind has a dimension and an SI unit.
Whether a whole line is homogeneous is decided by `dimension_of`, which names the term that offends.
Angles are numbers here, as in the SI; which powers of an angle the unit of a kind may have is said beside it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from operator import mul
from typing import Any


@dataclass(frozen=True)
class Dimension:
    """Exponents of mass, length and time: `M L^2 T^-2` is `Dimension(1, 2, -2)`."""

    mass: Fraction = Fraction(0)
    length: Fraction = Fraction(0)
    time: Fraction = Fraction(0)

    def __mul__(self, other: Dimension) -> Dimension:
        return Dimension(self.mass + other.mass, self.length + other.length, self.time + other.time)

    def __pow__(self, exponent: Fraction | int) -> Dimension:
        return Dimension(self.mass * exponent, self.length * exponent, self.time * exponent)

    def __truediv__(self, other: Dimension) -> Dimension:
        return self * other**-1

    @property
    def is_number(self) -> bool:
        return self == NUMBER


def _dimension(mass: int, length: int, time: int) -> Dimension:
    return Dimension(Fraction(mass), Fraction(length), Fraction(time))


NUMBER = _dimension(0, 0, 0)

# kind -> (dimension, SI unit as text, the kind with its article)
_KINDS: dict[str, tuple[Dimension, str, str]] = {
    "number": (NUMBER, "", "a number"),
    "angle": (NUMBER, "rad", "an angle"),
    "mass": (_dimension(1, 0, 0), "kg", "a mass"),
    "length": (_dimension(0, 1, 0), "m", "a length"),
    "time": (_dimension(0, 0, 1), "s", "a time"),
    "area": (_dimension(0, 2, 0), "m^2", "an area"),
    "volume": (_dimension(0, 3, 0), "m^3", "a volume"),
    "density": (_dimension(1, -3, 0), "kg/m^3", "a density"),
    "surface density": (_dimension(1, -2, 0), "kg/m^2", "a surface density"),
    "line density": (_dimension(1, -1, 0), "kg/m", "a line density"),
    "speed": (_dimension(0, 1, -1), "m/s", "a speed"),
    "acceleration": (_dimension(0, 1, -2), "m/s^2", "an acceleration"),
    "angular speed": (_dimension(0, 0, -1), "rad/s", "an angular speed"),
    "angular acceleration": (_dimension(0, 0, -2), "rad/s^2", "an angular acceleration"),
    "squared angular speed": (_dimension(0, 0, -2), "1/s^2", "a squared angular speed"),
    "frequency": (_dimension(0, 0, -1), "Hz", "a frequency"),
    "force": (_dimension(1, 1, -2), "N", "a force"),
    "energy": (_dimension(1, 2, -2), "J", "an energy"),
    "power": (_dimension(1, 2, -3), "W", "a power"),
    "torque": (_dimension(1, 2, -2), "N m", "a torque"),
    "momentum": (_dimension(1, 1, -1), "kg m/s", "a momentum"),
    "angular momentum": (_dimension(1, 2, -1), "kg m^2/s", "an angular momentum"),
    "moment of inertia": (_dimension(1, 2, 0), "kg m^2", "a moment of inertia"),
    "spring constant": (_dimension(1, 0, -2), "N/m", "a spring constant"),
}

KINDS = tuple(_KINDS)

# kind -> the powers of an angle that its unit may have: a radian may be left out of rad/s, but not of an angle
_ANGLES = {"angle": (1,), "angular speed": (1, 0), "angular acceleration": (1, 0), "squared angular speed": (2, 0)}


def dimension_of_kind(kind: str) -> Dimension:
    return _KINDS[kind][0]


def unit_of_kind(kind: str) -> str:
    """The coherent SI unit, in plain text: `kg m^2/s`."""
    return _KINDS[kind][1]


def angles_of_kind(kind: str | None) -> tuple[int, ...]:
    """The powers of an angle that a unit of the kind may have: one in rad/s, none in a length."""
    return _ANGLES.get(kind or "", (0,))


def unit_of_dimension(dimension: Dimension) -> str:
    """The coherent SI unit of what has a dimension and no kind: that of the one kind that has it, else a product.

    What has the dimension of an energy and of a torque is in N m, which is right of both; 1/s says nothing of an angle.
    """
    kinds = [kind for kind, (d, _, _) in _KINDS.items() if d == dimension]
    return unit_of_kind(kinds[0]) if len(kinds) == 1 else _product_of_units(dimension)


def _product_of_units(dimension: Dimension) -> str:
    """`N m`, `kg m^2/s`, `1/s`: what has the mass and the time of a force is told with newtons."""
    powers = {"kg": dimension.mass, "m": dimension.length, "s": dimension.time}
    if dimension.mass == 1 and dimension.time == -2:
        powers = {"N": Fraction(1), "m": dimension.length - 1}
    above = " ".join(_raised(unit, n) for unit, n in powers.items() if n > 0)
    below = "".join(f"/{_raised(unit, -n)}" for unit, n in powers.items() if n < 0)
    return (above or "1" * bool(below)) + below


def _raised(unit: str, power: Fraction) -> str:
    if power == 1:
        return unit
    return f"{unit}^{power}" if power.denominator == 1 else f"{unit}^({power})"


def kind_with_article(kind: str) -> str:
    return _KINDS[kind][2]


def kind_of_dimension(dimension: Dimension) -> str | None:
    """The first kind of that dimension: energy before torque, angular speed before frequency."""
    return next((kind for kind, (d, _, _) in _KINDS.items() if d == dimension), None)


def named(dimension: Dimension) -> str:
    """`a length`, or the exponents where no kind has that dimension."""
    kind = kind_of_dimension(dimension)
    return kind_with_article(kind) if kind else f"a quantity of dimension {exponents(dimension)}"


def exponents(dimension: Dimension) -> str:
    """`M L^2 T^-2`; `1` for a number."""
    letters = zip("MLT", (dimension.mass, dimension.length, dimension.time), strict=True)
    parts = [letter if n == 1 else f"{letter}^{n}" for letter, n in letters if n]
    return " ".join(parts) or "1"


class Inhomogeneous(Exception):
    """Two terms of one sum differ in dimension, or a function has an argument that is not a number."""

    def __init__(self, term: Any, dimension: Dimension, other: Any, expected: Dimension):
        self.term, self.dimension, self.other, self.expected = term, dimension, other, expected
        super().__init__(f"`{term}` is {named(dimension)}, but `{other}` is {named(expected)}")


def common(terms: Iterable[Any], of: Callable[[Any], Dimension | None]) -> Dimension | None:
    """The one dimension of all terms of a sum; raises `Inhomogeneous` with the first that has another."""
    first: tuple[Any, Dimension] | None = None
    for term in terms:
        dimension = of(term)
        if dimension is None:
            continue
        if first is None:
            first = (term, dimension)
        elif dimension != first[1]:
            raise Inhomogeneous(term, dimension, *first)
    return first[1] if first else None


def product(dimensions: Iterable[Dimension | None]) -> Dimension | None:
    found = list(dimensions)
    return None if None in found else reduce(mul, found, NUMBER)


def quotient(above: Dimension | None, below: Dimension | None) -> Dimension | None:
    return None if above is None or below is None else above / below


def power(base: Dimension | None, exponent: Fraction) -> Dimension | None:
    return None if base is None else base**exponent
