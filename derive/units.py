"""Units: the exact size of each unit in the SI, as the product of a rational number and a power of pi.

`rpm` is pi/30 rad/s and not 0.10472, so a number substituted at the end is exact (docs/decisions/0003-units.md).
An angle is a number. A unit also records to which power it contains a unit of angle. So `cm/rev` is rejected as the
unit of a length, and `degree` as the unit of the value of a cosine.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.kinds import about_kind, dimension_of_kind, kind_with_article, named
from derive.errors import Place, did_you_mean, rejected

if TYPE_CHECKING:
    from sympy import Expr

_MASS, _LENGTH, _TIME = (dimension_of_kind(kind) for kind in ("mass", "length", "time"))
_CURRENT = dimension_of_kind("current")
_FORCE, _ENERGY = dimension_of_kind("force"), dimension_of_kind("energy")
MAX_TEXT = 40
HIGHEST_POWER = 9

# name -> (its SI value as a fraction and a power of pi, dimension, power of an angle). A radian is 1, and `Hz` is 1/s.
# A turn is written as `rev`.
_UNITS: dict[str, tuple[Fraction, int, Dimension, int]] = {
    "m": (Fraction(1), 0, _LENGTH, 0),
    "mm": (Fraction(1, 1000), 0, _LENGTH, 0),
    "cm": (Fraction(1, 100), 0, _LENGTH, 0),
    "km": (Fraction(1000), 0, _LENGTH, 0),
    "in": (Fraction("0.0254"), 0, _LENGTH, 0),
    "ft": (Fraction("0.3048"), 0, _LENGTH, 0),
    "kg": (Fraction(1), 0, _MASS, 0),
    "g": (Fraction(1, 1000), 0, _MASS, 0),
    "t": (Fraction(1000), 0, _MASS, 0),
    "lb": (Fraction("0.45359237"), 0, _MASS, 0),
    "s": (Fraction(1), 0, _TIME, 0),
    "ms": (Fraction(1, 1000), 0, _TIME, 0),
    "min": (Fraction(60), 0, _TIME, 0),
    "h": (Fraction(3600), 0, _TIME, 0),
    "rad": (Fraction(1), 0, NUMBER, 1),
    "deg": (Fraction(1, 180), 1, NUMBER, 1),
    "degree": (Fraction(1, 180), 1, NUMBER, 1),
    "degrees": (Fraction(1, 180), 1, NUMBER, 1),
    "rev": (Fraction(2), 1, NUMBER, 1),
    "rpm": (Fraction(1, 30), 1, NUMBER / _TIME, 1),
    "Hz": (Fraction(1), 0, NUMBER / _TIME, 0),
    "N": (Fraction(1), 0, _FORCE, 0),
    "kN": (Fraction(1000), 0, _FORCE, 0),
    "J": (Fraction(1), 0, _ENERGY, 0),
    "kJ": (Fraction(1000), 0, _ENERGY, 0),
    "W": (Fraction(1), 0, _ENERGY / _TIME, 0),
    "kW": (Fraction(1000), 0, _ENERGY / _TIME, 0),
    "Pa": (Fraction(1), 0, _FORCE / _LENGTH**2, 0),
    "A": (Fraction(1), 0, _CURRENT, 0),
    "C": (Fraction(1), 0, _CURRENT * _TIME, 0),
    "V": (Fraction(1), 0, _ENERGY / (_CURRENT * _TIME), 0),
    "T": (Fraction(1), 0, _FORCE / (_CURRENT * _LENGTH), 0),
    "ohm": (Fraction(1), 0, _ENERGY / (_CURRENT**2 * _TIME), 0),
    "H": (Fraction(1), 0, _ENERGY / _CURRENT**2, 0),
    "F": (Fraction(1), 0, _CURRENT**2 * _TIME**2 / _ENERGY, 0),
    "Wb": (Fraction(1), 0, _ENERGY / _CURRENT, 0),
    "kPa": (Fraction(1000), 0, _FORCE / _LENGTH**2, 0),
}
UNIT_NAMES = tuple(_UNITS)
_OF_ANOTHER_KIND = {"torque": ("J", "kJ")}  # a torque is in N m; in joules it would be an energy

_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_RAISED = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+")
_TOKEN = re.compile(
    r"\s+|(?P<name>[A-Za-z]+|°|1(?=\s*/))(?:(?:\^|\*\*)(?P<power>-?\d{1,3}))?|(?P<times>\*|·|⋅)|(?P<per>/)|(?P<other>.)"
)


@dataclass(frozen=True)
class Unit:
    """A unit as written: its exact value in SI units, its dimension, its factors, and the power of an angle in it."""

    text: str
    rational: Fraction
    power_of_pi: int
    dimension: Dimension
    factors: tuple[tuple[str, int], ...] = ()
    angles: int = 0

    @property
    def factor(self) -> Expr:
        """The size of the unit in the SI, for calculations."""
        from sympy import Rational, pi  # imported here, because units are read and rejected without SymPy

        return Rational(self.rational.numerator, self.rational.denominator) * pi**self.power_of_pi

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(name for name, _ in self.factors)


def read_unit(text: str, place: Place | None = None) -> Unit:
    """Read `kg m^2/s` as a unit; a `/` divides only by the next factor, as in `m/s/s` or `N m/rad`."""
    text = text.strip()
    if not text or len(text) > MAX_TEXT:
        rejected("unknown-unit", "a unit is missing" if not text else "this unit is too long", place)
    factors = tuple(_factors(text, place))
    rational, power_of_pi, dimension, angles = Fraction(1), 0, NUMBER, 0
    for name, power in factors:
        value, its_power_of_pi, its_dimension, its_angles = _UNITS[name]
        rational, dimension = rational * value**power, dimension * its_dimension ** Fraction(power)
        power_of_pi, angles = power_of_pi + its_power_of_pi * power, angles + its_angles * power
    return Unit(text, rational, power_of_pi, dimension, factors, angles)


@dataclass(frozen=True)
class Misfit:
    """The reason why a unit does not measure a quantity: an error code, the end of the message, and perhaps a help
    line."""

    code: str
    why: str
    help: str | None = None


def misfit(unit: Unit, kind: str | None, dimension: Dimension) -> Misfit | None:
    """Return why a unit does not measure a quantity of a kind or of a dimension; None if the unit is suitable."""
    is_a = kind_with_article(kind) if kind else named(dimension)
    if unit.dimension != dimension:
        return Misfit("wrong-unit", f"is {is_a}, which is not measured in `{unit.text}`")
    if any(name in unit.names for name in _OF_ANOTHER_KIND.get(kind or "", ())):
        return Misfit("wrong-unit", f"is {is_a}, which is not measured in `{unit.text}`", "write `N m`")
    if "Hz" in unit.names and 1 in about_kind(kind).angles:
        turns, radians = (unit.text.replace("Hz", other) for other in ("rev/s", "rad/s"))
        return Misfit(
            "ambiguous-unit",
            f"is {is_a}, and `{unit.text}` could be turns or radians",
            f"write `{turns}` for turns, `{radians}` for radians",
        )
    if kind is None and (unit.angles or "Hz" in unit.names):
        why = f"has no kind, so `{unit.text}` is not allowed as its unit"
        return Misfit("wrong-unit", why, "leave the unit out; in a script, you can give the result a `kind=` instead")
    if unit.angles not in about_kind(kind).angles:
        return Misfit("wrong-unit", f"is {is_a}, which is not measured in `{unit.text}`")
    return None


def _factors(text: str, place: Place | None) -> Iterator[tuple[str, int]]:
    sign, wanted = 1, True
    for token in _TOKEN.finditer(_RAISED.sub(lambda raised: "^" + raised[0].translate(_SUPERSCRIPTS), text)):
        if token["name"]:
            name, power = token["name"].replace("°", "deg"), int(token["power"] or 1)
            if name != "1":
                _check(name, power, text, place)
                yield name, sign * power
            sign, wanted = 1, False
        elif not wanted and (token["times"] or token["per"]):
            sign, wanted = (-1 if token["per"] else 1), True
        elif token.lastgroup:
            wanted = True
            break
    if wanted:
        rejected("unknown-unit", f"`{text}` is not a unit", place, "write a unit such as `kg m^2/s`")


def _check(name: str, power: int, text: str, place: Place | None) -> None:
    if name not in _UNITS:
        within = f" in `{text}`" if name != text else ""
        units = ", ".join(f"`{unit}`" for unit in ("m", "cm", "kg", "g", "s", "N", "rad/s", "rpm", "deg"))
        rejected("unknown-unit", f"unknown unit `{name}`{within}", place, did_you_mean(name, _UNITS) or f"try {units}")
    if not 0 < abs(power) <= HIGHEST_POWER:
        rejected("unknown-unit", f"the power {power} of `{name}` is not allowed", place)


def begins_with_unit(text: str) -> bool:
    """Return whether the text after a number begins with a unit; this is enough to distinguish `2 cm` from `2 a`."""
    first = re.match(r"\s*([A-Za-z]+|°|1(?=\s*/))", text)
    return first is not None and (first[1] in _UNITS or not first[1].isalpha())
