"""The verdict on a number: its value, its unit and its significant figures are judged separately.

A decimal may be rounded. Zeros at the end of a whole number may come from rounding, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from sympy import Expr, Integer, Rational, pi

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.kinds import kind_with_article, named
from derive.algebra.rounding import rounded
from derive.errors import DeriveError
from derive.grading.key import Number, Target
from derive.grading.outcomes import Outcome, Verdict
from derive.grading.typed_text import with_points
from derive.units import Unit, read_unit

FEWEST = 2  # the least number of significant figures with which a rounded decimal is judged
LONGEST_UNIT = 80
_WORDS = {
    "radians": "rad", "radian": "rad", "meters": "m", "metres": "m", "meter": "m", "metre": "m", "seconds": "s",
    "second": "s", "sec": "s", "minutes": "min", "minute": "min", "kilograms": "kg", "kilogram": "kg", "grams": "g",
    "gram": "g", "newtons": "N", "newton": "N", "joules": "J", "joule": "J", "watts": "W", "watt": "W", "hertz": "Hz",
    "degrees": "deg", "degree": "deg", "RPM": "rpm", "Nm": "N m", "Ns": "N s", "Js": "J s", "hours": "h", "hour": "h",
    "per": "/", "squared": "^2", "cubed": "^3", "square": "", "kilo": "k", "centi": "c", "milli": "m",
    "revolutions": "rev", "rads": "rad", "kgm": "kg m", "secs": "s",
}  # fmt: skip
_PREFIXED = re.compile(r"\\(kilo|centi|milli)\s*\\([a-z]+)")


def unit_in(text: str) -> Unit | None:
    r"""Return the unit in a text, such as `rad/s`, `\mathrm{kg\,m^2}` or `\metre\per\second`; else None."""
    if not text.strip() or len(text) > LONGEST_UNIT:
        return None
    plain = re.sub(r"\^\{?\\circ\}?|\\degree\b|\\circ\b", " deg ", text)
    plain = _PREFIXED.sub(lambda found: f" {_WORDS[found[1]]}{_WORDS.get(found[2], found[2])} ", plain)
    plain = re.sub(r"\\(?:mathrm|text|textrm|rm|si|unit|mathit|operatorname)\b", " ", plain)
    plain = re.sub(r"\\frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}", r" \1/\2 ", plain)
    plain = re.sub(r"\\(?:cdot|times|[,;:! ])|[~*·⋅×]|(?<=[A-Za-z])\.(?=[A-Za-z])", " ", plain)
    plain = plain.replace("\\", " ").replace("{", "").replace("}", "").replace("°", " deg ").replace("º", " deg ")
    plain = re.sub(r"(?<![A-Za-z])[A-Za-z]+", lambda found: _WORDS.get(found[0], found[0]), plain)
    plain = re.sub(r"\s*\^\s*", "^", re.sub(r"\s*/\s*", "/", plain)).replace("(", " ").replace(")", " ")
    plain = re.sub(r"\b(rev|rad)/min\b", lambda found: "rpm" if found[1] == "rev" else found[0], plain)
    if not re.search("[A-Za-z]", plain):
        return None
    try:
        return read_unit(" ".join(plain.split()))
    except (DeriveError, KeyError, ValueError):
        return None


def with_units(text: str) -> Iterator[tuple[str, Unit]]:
    r"""Yield the first reading of a text as a number with a unit, if any: `15.13 rpm`, `\SI{15.13}{rpm}`, `21.6°`."""
    plain = text.strip().strip("$").strip()
    if found := re.fullmatch(r"\\(?:SI|qty)\s*(?:\[[^\]]*\])?\s*\{([^{}]*)\}\s*\{((?:[^{}]|\{[^{}]*\})*)\}", plain):
        if (unit := unit_in(found[2])) is not None:
            yield found[1], unit
        return
    if found := re.fullmatch(r"\\ang\s*\{([^{};]*)\}", plain):
        yield found[1], read_unit("deg")
        return
    for at in range(1, len(plain)):
        if plain[at - 1] in "0123456789)}.πi " and plain[at] not in "0123456789." and len(plain) - at <= LONGEST_UNIT:
            rest = plain[at:]
            if rest[0] in "^}" and not rest.startswith(("^\\circ", "^{\\circ}")):
                continue
            if (unit := unit_in(rest)) is not None:
                yield plain[:at].rstrip(" \\,~"), unit
                return


def components_of(text: str, count: int) -> list[str]:
    r"""Return the decimals of a typed vector, such as `(1.5, 0, -2)`, `(1,5; 0; -2)`, `(1,5, 0, -2)` or
    `\begin{pmatrix} 1.5 \\ 0 \end{pmatrix}`; an empty list if the text does not have `count` decimals."""
    plain = re.sub(r"\\(?:begin|end)\s*\{[a-z]*matrix\}|\\(?:left|right)\b|[()\[\]$]", " ", text).replace("\u2212", "-")
    for separator in (r";|\\\\", ",", r",\s"):
        entries = [re.sub(r"\s", "", with_points(each)) for each in re.split(separator, plain.strip())]
        if len(entries) == count and all(re.fullmatch(r"[-+]?\d+(\.\d+)?([eE][-+]?\d+)?", each) for each in entries):
            return entries
    return []


def figures_of(text: str) -> int:
    """Return the number of significant figures of a typed decimal; zeros at the end of a whole number count."""
    digits = re.sub(r"[eE].*|\\cdot.*|\\times.*", "", text)
    return len(re.sub(r"\D", "", digits).lstrip("0"))


def verdict_on_number(
    value: Expr, is_decimal: bool, figures: int, unit: Unit | None, target: Target, number: Number, places: int
) -> Verdict:
    """Judge a number.

    is_decimal   whether the value is a single decimal number, which may be rounded; any other value is compared exactly
    figures      the number of significant figures of the value
    places       the number of digits of the value after the point; the unit of the last digit is 10^-places (places =
                 -2 for 1.5e3)
    """
    dimension = target.dimension or NUMBER
    if unit is not None and unit.dimension != dimension:
        return Verdict(
            Outcome.DIMENSION, f"`{unit.text}` measures {named(unit.dimension)}, not {_asked(target, dimension)}"
        )
    if unit is None:
        return _without_unit(value, is_decimal, figures, places, target, number, dimension)
    found = _in_unit(value, is_decimal, figures, places, number, unit.factor, unit.text)
    if unit.factors == (("min", -1),) and "rpm" in number.unit and not found.is_right:
        turns = _in_unit(value, is_decimal, figures, places, number, read_unit("rpm").factor, "rpm")
        if turns.is_right:
            return Verdict(Outcome.CONVENTION, f"with `{unit.text}` as revolutions per minute").adding(turns.because)
    return found


def _without_unit(
    value: Expr, is_decimal: bool, figures: int, places: int, target: Target, number: Number, dimension: Dimension
) -> Verdict:
    needs_unit = dimension != NUMBER or target.kind == "angle"
    if not needs_unit:
        return _in_unit(value, is_decimal, figures, places, number, Integer(1), "")
    tried = [(number.factor, number.unit), (Integer(1), "the SI")]
    if target.kind == "angle":
        plain = _in_unit(value, is_decimal, figures, places, number, Integer(1), "rad")
        if plain.is_right:
            return plain  # an angle in radians is a number
        degrees = _in_unit(value, is_decimal, figures, places, number, pi / 180, "degrees")
        if degrees.is_right:
            told = "the angle is read in degrees, although no unit is typed"
            return Verdict(Outcome.CONVENTION, told).adding(degrees.because)
        return plain
    for factor, name in tried:
        found = _in_unit(value, is_decimal, figures, places, number, factor, name)
        if found.is_right:
            unit = name if name and name != "the SI" else "SI units"
            return Verdict(
                Outcome.DIMENSION,
                f"the number is right in {unit}, but its unit is missing: {_asked(target, dimension)} is asked for",
            )
    return Verdict(
        Outcome.DIFFERENT,
        "the number is wrong or has too few figures, and its unit is missing: "
        f"{_asked(target, dimension)} is asked for",
    )


def _asked(target: Target, dimension: Dimension) -> str:
    return kind_with_article(target.kind) if target.kind else named(dimension)


def _in_unit(
    value: Expr, is_decimal: bool, figures: int, places: int, number: Number, factor: Expr, unit: str
) -> Verdict:
    exact = number.exact / factor
    if not is_decimal:
        return _exactly(value, exact, number, unit)
    half = Rational(10) ** -places / 2
    right = _told(exact, max(number.figures, FEWEST), unit)
    while True:
        apart = abs(_many_digits(exact) - value)
        if apart <= half:
            if figures < FEWEST and apart:
                return Verdict(Outcome.DIFFERENT, f"at least {FEWEST} figures are needed to judge: {right}")
            short = f"; the problem asks for {number.figures} figures" if figures < number.figures and apart else ""
            return Verdict(Outcome.EQUAL, f"the value rounded to {figures} figures{short}" if apart else "")
        if places > 0 or value % (Integer(10) ** (1 - places)) or figures <= 1:
            break
        places, figures, half = places - 1, figures - 1, half * 10  # zeros at the end may come from rounding
    if apart <= 3 * half and figures >= 3:
        return Verdict(Outcome.DIFFERENT, f"the last figure is wrong: {right}")
    return _compared(value, exact, unit, right)


def _exactly(value: Expr, exact: Expr, number: Number, unit: str) -> Verdict:
    from derive.grading.structure import are_equal

    if are_equal(value, exact):
        return Verdict(Outcome.EQUAL, "")
    return _compared(value, exact, unit, _told(exact, number.figures, unit))


def _compared(value: Expr, exact: Expr, unit: str, right: str) -> Verdict:
    ratio = float(_many_digits(value) / _many_digits(exact)) if exact != 0 else 0.0
    if abs(ratio + 1) < 1e-3:
        return Verdict(Outcome.SIGN, f"the number has the wrong sign: {right}")
    for factor, name in _FACTORS:
        if abs(ratio / factor - 1) < 1e-3:
            return Verdict(Outcome.FACTOR, f"the number is {name} times the right one: {right}")
    return Verdict(Outcome.DIFFERENT, f"the number is wrong: {right}")


_FACTORS = (
    (2, "2"), (0.5, "1/2"), (3, "3"), (1 / 3, "1/3"), (4, "4"), (0.25, "1/4"), (10, "10"), (0.1, "1/10"),
    (100, "100"), (0.01, "1/100"), (1000, "1000"), (0.001, "1/1000"), (6.283185307, "2 pi"), (0.159154943, "1/(2 pi)"),
    (57.29577951, "180/pi (degrees and radians)"), (0.01745329252, "pi/180 (degrees and radians)"),
    (60, "60"), (1 / 60, "1/60"), (9.549296586, "60/(2 pi) (turns per minute and rad/s)"),
    (0.1047197551, "2 pi/60 (turns per minute and rad/s)"),
)  # fmt: skip


def _many_digits(exact: Expr) -> Rational:
    return Rational(str(exact.evalf(40))) if not exact.is_Rational else exact


def _told(exact: Expr, figures: int, unit: str) -> str:
    shown = rounded(exact, figures)
    number = f"{float(shown):.{figures}g}"
    shown = f"{number} {unit}".rstrip() if unit != "the SI" else f"{number} in SI units"
    return f"the right value is {shown}"


__all__ = ["components_of", "figures_of", "unit_in", "verdict_on_number", "with_units"]
