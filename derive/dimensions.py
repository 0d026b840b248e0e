"""Mass, length and time: the kinds of quantity, and the dimension of an expression.

A kind is what an instructor writes under `symbols:` (`M: mass`). Every kind has a dimension and an SI unit.
Whether a whole line is homogeneous is decided by `dimension_of`, which names the term that offends.
Angles are numbers here, as in the SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


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


def dimension_of_kind(kind: str) -> Dimension:
    return _KINDS[kind][0]


def unit_of_kind(kind: str) -> str:
    """The coherent SI unit, in plain text: `kg m^2/s`."""
    return _KINDS[kind][1]


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
