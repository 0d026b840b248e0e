"""Numbers with units, read from their text in a file."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NoReturn

from sympy import Expr, Rational, Symbol

from derive.algebra.dimensions import NUMBER
from derive.algebra.kinds import dimension_of_kind, kind_with_article, named, unit_of_kind
from derive.course.expression import RESERVED, Declared, rational
from derive.course.yaml_tree import Scalar, decimal_comma
from derive.errors import Place, Rejected, did_you_mean, rejected
from derive.units import UNIT_NAMES, begins_with_unit, misfit, read_unit

_NUMBER_UNIT = re.compile(
    r"\s*(?P<sign>[-+]?)\s*(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?:\s*/\s*(?P<over>\d+))?"
    r"(?P<unit>\s*(?![eE][+-]?\d)(?:[A-Za-z°]|1\s*/).*|\s*)",
    re.ASCII | re.DOTALL,
)


@dataclass(frozen=True)
class Number:
    """A number with its unit, its SI value, and its text in the file."""

    number: Rational
    unit: str
    si: Expr
    scalar: Scalar = field(repr=False, compare=False)


@dataclass(frozen=True)
class Wanted:
    """What is known about a value before it is read.

    notes             additions to an error about the value, such as where `solve()` asks for it
    one_of_many       whether the value is an entry of a list
    bounds            the least and the greatest allowed angle, in degrees
    numbers           the SI numbers of symbols, for a check of the sign
    is_end_of_scale   whether the value is an end of the range of a plot, and so may have any sign
    """

    name: str
    kind: str
    notes: tuple[str, ...] = ()
    one_of_many: bool = False
    bounds: tuple[int, int] | None = None
    numbers: Mapping[Symbol, Expr] = field(default_factory=dict)
    is_end_of_scale: bool = False

    @property
    def must(self) -> str:
        return f"each of `{self.name}` must be" if self.one_of_many else f"`{self.name}` must be"

    @property
    def must_be_it(self) -> str:
        return f"{self.must} {kind_with_article(self.kind)}"

    def refuse(self, code: str, message: str, place: Place, help: str | None = None) -> NoReturn:
        rejected(code, message, place, help, *self.notes)


def is_number_with_unit(scalar: Scalar) -> bool:
    """Return whether the text begins with a number and a unit, as in `1.5 kg m^2/s` or `3 cm*sin(phi)`."""
    match = _NUMBER_UNIT.fullmatch(scalar.text)
    return bool(match and begins_with_unit(match["unit"].strip()))


def number_with_unit(scalar: Scalar, wanted: Wanted, symbols: Mapping[str, Declared]) -> Number | None:
    """Read a number with its unit, such as `1.5 kg`. Return None if the text does not begin with a number and a unit,
    as in `2*a`; reject other text after the unit."""
    if re.fullmatch(r"\s*[+-]?\d+,\d+(\s.*)?", scalar.text):
        raise Rejected(decimal_comma(scalar.text, scalar.place))
    if re.match(r"\s*[+-]?\d{1,9}(?:[_'\u2009\u202f\xa0 ]\d{3})+(?![\w.])", scalar.text):
        joined = re.sub(r"(?<=\d)[_'\u2009\u202f\xa0 ](?=\d)", "", scalar.text.strip())
        message = f"`{scalar.text.strip()}` has a character between its digits"
        rejected("digits", message, scalar.place, f"write `{joined}`")
    match = _NUMBER_UNIT.fullmatch(scalar.text)
    if not match or not match["unit"].strip() or len(scalar.text) > 80:
        return None
    first = re.match(r"\s*([A-Za-z_][A-Za-z0-9_]*)", match["unit"])
    if first and not begins_with_unit(match["unit"]) and (first[1] in symbols or first[1] in RESERVED):
        return None
    start = match.start("unit") + len(match["unit"]) - len(match["unit"].lstrip())
    if first and not begins_with_unit(match["unit"]) and not did_you_mean(first[1], UNIT_NAMES):
        message = f"`{first[1]}` is neither a unit nor a declared symbol"
        declare = f"write a unit; or declare the symbol and write `{match['number']}*{match['unit'].strip()}`"
        help_of_unit = did_you_mean(first[1], symbols) or declare
        rejected("unknown-unit", message, scalar.place_within(start, len(first[1])), help_of_unit)
    unit = read_unit(match["unit"], scalar.place_within(start, len(scalar.text.rstrip()) - start))
    text = " ".join(scalar.text.split())
    if not unit_of_kind(wanted.kind) or unit.dimension != dimension_of_kind(wanted.kind):
        is_a = named(unit.dimension) if unit.dimension != NUMBER else kind_with_article("angle")
        product = f"{match['number']}*{match['unit'].strip()}" if first and first[1] in symbols else None
        help_line = f"write `{product}` if you mean the symbol" if product else None
        wanted.refuse("wrong-kind", f"{wanted.must_be_it}, but `{text}` is {is_a}", scalar.place, help_line)
    if wanted.kind == "angular speed" and "Hz" in unit.names:
        help_line = f"write `{text.replace('Hz', 'rev/s')}` for turns"
        message = f"`{text}` could mean turns per second or radians per second"
        wanted.refuse("ambiguous-unit", message, scalar.place, help_line)
    if misfit(unit, wanted.kind, unit.dimension):
        is_a = f"{kind_with_article(wanted.kind)}, which is not measured in `{unit.text}`"
        wanted.refuse("wrong-unit", f"{wanted.must} {is_a}", scalar.place)
    if (
        len(_digits(match["number"])) > 30
        or (match["over"] or "1").strip("0") == ""
        or abs(_ten_power(match["number"])) > 50
    ):
        message = f"`{text}` has over 30 digits, a power of ten beyond 50, or denominator 0"
        wanted.refuse("too-large", message, scalar.place)
    value = rational(match["number"]) / int(match["over"] or 1) * (-1 if match["sign"] == "-" else 1)
    return Number(value, unit.text, value * unit.factor, scalar)


def is_more_than_unit(text: str, symbols: Mapping[str, Declared]) -> bool:
    """Return whether a number with its unit is only the beginning of an expression, as in `3 cm*sin(phi)`."""
    names = re.findall(r"(?<![\d.])[A-Za-z_][A-Za-z0-9_]*", text)[1:]  # the first name is the unit
    return any(name in RESERVED or name in symbols and name not in UNIT_NAMES for name in names)


def _digits(number: str) -> str:
    return number.lower().partition("e")[0].replace(".", "")


def _ten_power(number: str) -> int:
    power = number.lower().partition("e")[2]
    return int(power) if power and len(power) < 6 else 99 * bool(power)


def check_range(declared: Declared, size: Expr, scalar: Scalar) -> None:
    """Check that a number given for a letter lies in the declared range of the letter."""
    if declared.lies and not declared.lies.holds(size):
        text = " ".join(scalar.text.split())
        message = f"`{declared.name}` is declared to lie in {declared.lies.written}, but `{text}` does not"
        rejected("out-of-range", message, scalar.place)
