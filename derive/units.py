"""Units, exactly: what one of them is in the SI, as a rational number and a power of pi.

`rpm` is pi/30 rad/s and not 0.10472, so a number put in at the end spoils nothing. See docs/decisions/0003-units.md.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from sympy import Expr, Integer, Rational, pi

from derive.dimensions import NUMBER, Dimension, dimension_of_kind
from derive.errors import Place
from derive.source import did_you_mean, rejected

_MASS, _LENGTH, _TIME = (dimension_of_kind(kind) for kind in ("mass", "length", "time"))
_FORCE, _ENERGY = dimension_of_kind("force"), dimension_of_kind("energy")
MAX_TEXT = 40
MAX_EXPONENT = 9

# name -> (exact SI value, dimension). A radian is 1 and `Hz` is 1/s: a turn is said as `rev`.
_UNITS: dict[str, tuple[Expr, Dimension]] = {
    "m": (Integer(1), _LENGTH),
    "mm": (Rational(1, 1000), _LENGTH),
    "cm": (Rational(1, 100), _LENGTH),
    "km": (Integer(1000), _LENGTH),
    "in": (Rational("0.0254"), _LENGTH),
    "ft": (Rational("0.3048"), _LENGTH),
    "kg": (Integer(1), _MASS),
    "g": (Rational(1, 1000), _MASS),
    "t": (Integer(1000), _MASS),
    "lb": (Rational("0.45359237"), _MASS),
    "s": (Integer(1), _TIME),
    "ms": (Rational(1, 1000), _TIME),
    "min": (Integer(60), _TIME),
    "h": (Integer(3600), _TIME),
    "rad": (Integer(1), NUMBER),
    "deg": (pi / 180, NUMBER),
    "degree": (pi / 180, NUMBER),
    "degrees": (pi / 180, NUMBER),
    "rev": (2 * pi, NUMBER),
    "rpm": (pi / 30, NUMBER / _TIME),
    "Hz": (Integer(1), NUMBER / _TIME),
    "N": (Integer(1), _FORCE),
    "kN": (Integer(1000), _FORCE),
    "J": (Integer(1), _ENERGY),
    "kJ": (Integer(1000), _ENERGY),
    "W": (Integer(1), _ENERGY / _TIME),
    "kW": (Integer(1000), _ENERGY / _TIME),
    "Pa": (Integer(1), _FORCE / _LENGTH**2),
    "kPa": (Integer(1000), _FORCE / _LENGTH**2),
}
UNIT_NAMES = tuple(_UNITS)
ANGLE_UNITS = ("rad", "deg", "degree", "degrees", "rev")

_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_RAISED = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+")
_TOKEN = re.compile(
    r"\s+|(?P<name>[A-Za-z]+|°|1(?=\s*/))(?:(?:\^|\*\*)(?P<power>-?\d{1,3}))?|(?P<times>\*|·|⋅)|(?P<per>/)|(?P<other>.)"
)


@dataclass(frozen=True)
class Unit:
    """A unit as written, its exact value in the SI, its dimension, and its factors for whoever prints it."""

    text: str
    factor: Expr
    dimension: Dimension
    factors: tuple[tuple[str, int], ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(name for name, _ in self.factors)


def read_unit(text: str, place: Place | None = None) -> Unit:
    """`kg m^2/s` as a unit; a `/` divides by the one factor after it, as in `m/s/s` or `N m/rad`."""
    text = text.strip()
    if not text or len(text) > MAX_TEXT:
        rejected("unknown-unit", "a unit is missing" if not text else "this unit is too long", place)
    factors = tuple(_factors(text, place))
    factor: Expr = Integer(1)
    dimension = NUMBER
    for name, power in factors:
        value, its_dimension = _UNITS[name]
        factor, dimension = factor * value**power, dimension * its_dimension ** Fraction(power)
    return Unit(text, factor, dimension, factors)


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
        rejected("unknown-unit", f"`{text}` is not a unit", place, "write it as `kg m^2/s`")


def _check(name: str, power: int, text: str, place: Place | None) -> None:
    if name not in _UNITS:
        within = f" in `{text}`" if name != text else ""
        units = ", ".join(f"`{unit}`" for unit in ("m", "cm", "kg", "g", "s", "N", "rad/s", "rpm", "deg"))
        rejected("unknown-unit", f"unknown unit `{name}`{within}", place, did_you_mean(name, _UNITS) or f"try {units}")
    if not 0 < abs(power) <= MAX_EXPONENT:
        rejected("unknown-unit", f"the power {power} of `{name}` is not used", place)


def begins_with_unit(text: str) -> bool:
    """Whether the first name of a text is that of a unit: enough to tell `2 cm` from `2 a`."""
    first = re.match(r"\s*([A-Za-z]+|°|1(?=\s*/))", text)
    return first is not None and (first[1] in _UNITS or not first[1].isalpha())
