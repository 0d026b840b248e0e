"""Given values: each becomes a checked value of the kind that the script's `solve()` asks for.

A kind is an annotation: `def solve(sides: Lengths, mass: Mass)`. A number with a unit becomes a symbol with a stored
number (`Measured`), so the derivation stays symbolic until its end. Zero and simple angles such as 45 deg stay numbers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from sympy import Expr, Integer, Rational, Symbol, pi

from derive.algebra.dimensions import NUMBER
from derive.algebra.direction import Direction
from derive.algebra.expressions import TIME, Amount
from derive.algebra.kinds import (
    ANNOTATIONS,
    DIRECTION,
    Asked,
    about_kind,
    dimension_of_kind,
    kind_with_article,
    named,
    plural,
    unit_of_kind,
)
from derive.algebra.ranges import Range
from derive.course.expression import Declared, read_expression
from derive.course.measures import Number, Wanted, check_range, is_more_than_unit, number_with_unit
from derive.course.yaml_tree import Mapping as MappingNode
from derive.course.yaml_tree import Scalar, Sequence, Tree, Word, shape_of
from derive.errors import DeriveError, Faults, Place, did_you_mean, rejected
from derive.units import read_unit

DIRECTION_NAMES = ("diagonal", "x", "y", "z")


@dataclass(frozen=True)
class Measured:
    """The number of a symbol, which is substituted at the end: 900 rpm for omega.

    number   the number in its unit, 900
    si       the exact number in SI units, 30*pi
    place    the place in the file where the number is written
    """

    symbol: Symbol
    number: Rational
    unit: str
    si: Expr
    place: Place | None = field(default=None, repr=False, compare=False)

    @property
    def factor(self) -> Expr:
        """The size of the unit in SI units."""
        return read_unit(self.unit).factor if self.unit else Integer(1)


@dataclass(frozen=True)
class Given:
    """One key of `given:`: the argument for `solve()`, and the numbers of the letters in this argument.

    `word` is a value that is a plain word, such as the name of a direction. `written` is an exact value as the file
    states it, such as 45 deg.
    """

    name: str
    kind: Asked
    value: Any
    measured: tuple[Measured, ...] = ()
    word: str | None = None
    written: Amount | None = None

    @property
    def letters(self) -> list[Symbol]:
        value = self.value.components or () if isinstance(self.value, Direction) else self.value
        entries = value if isinstance(value, tuple) else (value,)
        return [s for entry in entries for s in sorted(entry.free_symbols, key=str) if isinstance(s, Symbol)]


def symbol_of_kind(name: str, kind: str, lies: Range | None = None) -> Symbol:
    """Return the symbol of a declared letter. The letter `t` of kind time is the time itself. A letter whose range
    begins below zero is not assumed to be positive."""
    if name == TIME.name and kind == "time":
        return TIME
    is_positive = about_kind(kind).positive if lies is None else not lies.least.is_extended_negative
    if about_kind(kind).positive and is_positive or lies is not None and lies.is_above_zero:
        return Symbol(name, real=True, positive=True)
    return Symbol(name, real=True)


def read_givens(
    nodes: Mapping[str, Tree],
    kinds: Mapping[str, Asked],
    symbols: Mapping[str, Declared],
    faults: Faults,
    *,
    notes: Mapping[str, str] | None = None,
    used: Iterable[str] = (),
    numbers: Mapping[Symbol, Expr] | None = None,
) -> tuple[tuple[Given, ...], dict[str, Declared]]:
    """Return the givens in the order of `nodes`, and all symbols, including the symbols that replace numbers.

    notes     for each name, a note that says where `solve()` asks for its value
    used      the names of symbols that already have a number
    numbers   the SI numbers of these symbols, for checks of signs
    """
    read: dict[str, tuple[Expr | Number, ...] | Direction] = {}
    for name, node in nodes.items():
        with faults:
            note = (notes or {}).get(name)
            wanted = _wanted(name, kinds[name], (note,) if note else (), numbers or {})
            read[name] = _read_one(node, kinds[name], wanted, symbols)
    letters = _LettersForNumbers(symbols, {*used, *_names_in(read.values())})
    givens = []
    for name, value in read.items():
        with faults:
            givens.append(_given(name, kinds[name], value, letters))
    return tuple(givens), letters.symbols


def read_measured(name: Word, node: Tree, symbols: Mapping[str, Declared]) -> Measured:
    """Read the number of a declared symbol, with its unit."""
    declared = symbols.get(name)
    if declared is None:
        help_line = did_you_mean(name, symbols) or "declare it under `symbols:`"
        rejected("undeclared-symbol", f"`{name}` is not declared", name.place, help_line)
    if declared.symbol == TIME:
        rejected("time", "`t` is the time, so it cannot have a number", name.place, "use another letter: `t_1`")
    wanted = Wanted(str(name), declared.kind)
    scalar = _scalar(node, wanted, name.place)
    value = _value(scalar, wanted, symbols)
    if not isinstance(value, Number):
        if not value.is_Rational:
            wanted.refuse("wrong-kind", f"`{name}` needs a number here", scalar.place, _unit_example(declared.kind))
        value = Number(value, "", value, scalar)
    if declared.symbol.is_positive and not value.number > 0:
        wanted.refuse("not-positive", f"`{name}` must be positive, but `{scalar.text}` is not", scalar.place)
    check_range(declared, value.si, scalar)
    return Measured(declared.symbol, value.number, value.unit, value.si, scalar.place)


def read_numbers(written: Mapping[Word, Tree], symbols: Mapping[str, Declared], faults: Faults) -> tuple[Measured, ...]:
    """Read the numbers of `values:`, or of one case of a plot."""
    found = []
    for name, value in written.items():
        with faults:
            found.append(read_measured(name, value, symbols))
    return tuple(found)


def read_value(name: str, node: Tree, kind: str, symbols: Mapping[str, Declared], notes: tuple[str, ...] = ()) -> Expr:
    """Read an expression of the given kind in declared letters; a number with its unit becomes its value in the SI."""
    wanted = Wanted(name, kind, notes)
    return _read(node, wanted, symbols)


def read_end(node: Tree, kind: str, symbols: Mapping[str, Declared] | None = None) -> Expr:
    """Read an end of the range of a plot; the end may be zero or negative."""
    return _read(node, Wanted("range", kind, is_end_of_scale=True), symbols or {})


def _read(node: Tree, wanted: Wanted, symbols: Mapping[str, Declared]) -> Expr:
    value = _value(_scalar(node, wanted), wanted, symbols)
    return value.si if isinstance(value, Number) else value


def _wanted(name: str, kind: Asked, notes: tuple[str, ...], numbers: Mapping[Symbol, Expr]) -> Wanted:
    return Wanted(name, kind.each, notes, one_of_many=kind.count > 1, bounds=kind.bounds, numbers=numbers)


def _read_one(
    node: Tree, kind: Asked, wanted: Wanted, symbols: Mapping[str, Declared]
) -> tuple[Expr | Number, ...] | Direction:
    if kind is DIRECTION:
        return _direction(node, wanted, symbols)
    if kind.count == 1:
        return (_value(_scalar(node, wanted), wanted, symbols),)
    items = _three(node, wanted, f"{kind.count} {plural(kind.each)}", "write it as `[a, b, c]`")
    values = []
    own = Faults()
    for item in items:
        with own:
            values.append(_value(_scalar(item, wanted), wanted, symbols))
    own.stop()
    return tuple(values)


def _three(node: Tree, wanted: Wanted, what: str, help: str) -> tuple[Tree, ...]:
    if not isinstance(node, Sequence):
        wanted.refuse("wrong-kind", f"`{wanted.name}` must be {what}, but it is {shape_of(node)}", node.place, help)
    if (n := len(node.items)) != 3:
        message = f"`{wanted.name}` must be {what}, but {n} {'is' if n == 1 else 'are'} given"
        bare = n > 3 and any(isinstance(item, Scalar) and item.text.isdigit() for item in node.items)
        help_line = "a decimal has a point: `2.5 cm`" if bare else None
        wanted.refuse("wrong-length", message, node.place, help_line)
    return node.items


def _scalar(node: Tree, wanted: Wanted, where: Place | None = None) -> Scalar:
    if isinstance(node, Scalar) and not node.empty:
        return node
    if isinstance(node, Scalar):
        wanted.refuse("missing-value", f"{wanted.must_be_it}, but nothing is given", where or node.place)
    wanted.refuse("wrong-kind", f"{wanted.must_be_it}, but it is {shape_of(node)}", node.place)


def _value(scalar: Scalar, wanted: Wanted, symbols: Mapping[str, Declared]) -> Expr | Number:
    number = number_with_unit(scalar, wanted, symbols)
    if number is not None:
        _check_sign(number.si, scalar, wanted)
        return number
    expr, dimension = read_expression(scalar, symbols)
    text = " ".join(scalar.text.split())
    is_bare = expr.is_Rational and dimension == NUMBER and not (expr.is_zero and wanted.kind == "angle")
    if expr.is_zero and about_kind(wanted.kind).positive:
        _check_sign(expr, scalar, wanted)
    if is_bare and unit_of_kind(wanted.kind):
        units = ("deg", "rad") if wanted.kind == "angle" else (unit_of_kind(wanted.kind),)
        help_line = "write " + " or ".join(f"`{text} {unit}`" for unit in units)
        wanted.refuse("missing-unit", f"`{text}` needs a unit: {wanted.must_be_it}", scalar.place, help_line)
    if dimension != dimension_of_kind(wanted.kind):
        declared = symbols.get(text)
        is_a = kind_with_article(declared.kind) if declared and declared.kind else named(dimension)
        wanted.refuse("wrong-kind", f"{wanted.must_be_it}, but `{text}` is {is_a}", scalar.place)
    _check_sign(expr, scalar, wanted)
    return expr


def _check_sign(value: Expr, scalar: Scalar, wanted: Wanted) -> None:
    """Reject a value if it is known that its sign is wrong, or that an angle is out of range."""
    if wanted.is_end_of_scale:
        return
    text = " ".join(scalar.text.split())
    value = value.xreplace(dict(wanted.numbers))
    if about_kind(wanted.kind).positive and not about_kind(wanted.kind).signed and value.is_nonpositive:
        wanted.refuse("not-positive", f"{wanted.must} positive, but `{text}` is not", scalar.place)
    if about_kind(wanted.kind).signed and value.is_zero:
        wanted.refuse("not-positive", f"`{wanted.name}` must not be zero", scalar.place)
    least, greatest = (degrees * pi / 180 for degrees in wanted.bounds) if wanted.bounds else (value, value)
    if (value - least).is_negative or (value - greatest).is_positive:
        ends = " to ".join(str(180 * end / pi) for end in (least, greatest))
        wanted.refuse("out-of-range", f"{wanted.must} from {ends} deg, but `{text}` is not", scalar.place)


def _unit_example(kind: str) -> str:
    unit = unit_of_kind(kind)
    return f"write it as `1.5 {unit}`" if unit else "write it as `1.5`"


def _direction(node: Tree, wanted: Wanted, symbols: Mapping[str, Declared]) -> Direction:
    names = ", ".join(f"`{name}`" for name in DIRECTION_NAMES)
    if isinstance(node, Scalar) and not node.empty:
        if node.text not in DIRECTION_NAMES:
            help_line = did_you_mean(node.text, DIRECTION_NAMES) or f"the names are {names}"
            message = f"`{wanted.name}` must be a direction, but {shape_of(node)} is not one"
            wanted.refuse("wrong-kind", message, node.place, help_line)
        return Direction(node.text)
    items = _three(node, wanted, "a direction or 3 components", f"write {names}, or `[1, 1, 0]`")
    wanted = Wanted(wanted.name, "number", wanted.notes, one_of_many=True)
    own = Faults()
    components = []
    dimension = None
    for item in items:
        with own:
            scalar = _scalar(item, wanted)
            expr, found = read_expression(scalar, symbols)
            components.append(expr)
            if not expr.is_zero:
                dimension = dimension or found
                if found != dimension:
                    message = f"`{scalar.text}` is {named(found)}, but the components before it are not"
                    wanted.refuse("dimension", message, scalar.place)
    own.stop()
    if all(component.is_zero for component in components):
        wanted.refuse("zero-axis", f"`{wanted.name}` has no direction: every component is zero", node.place)
    x, y, z = components
    return Direction(None, (x, y, z))


def value_in_prose(
    name: str, node: Tree, symbols: Mapping[str, Declared], measured: Iterable[Measured]
) -> Given | None:
    """Return a value of a description for prose that mentions it, as in `<<body.sides>>`. Return None if the value is
    neither a word, nor a formula, nor a list of formulas.

    measured   the numbers of the description; each is identified by its place in the file
    """
    if isinstance(node, MappingNode):
        return None
    if isinstance(node, Scalar) and re.fullmatch(r"[^\W\d][\w -]*", node.text) and node.text not in symbols:
        return Given(name, DIRECTION, Direction(node.text), (), node.text)
    letters = {each.place: each.symbol for each in measured}
    items = node.items if isinstance(node, Sequence) else (node,)
    values = []
    for item in items:
        if not isinstance(item, Scalar):
            return None
        try:
            values.append(letters[item.place] if item.place in letters else read_expression(item, symbols)[0])
        except DeriveError:
            return None
    return Given(name, Asked("number", count=len(values)), values[0] if isinstance(node, Scalar) else tuple(values))


# -- letters for numbers ----------------------------------------------------------------------------------------------


def _names_in(values: Iterable[tuple[Expr | Number, ...] | Direction]) -> set[str]:
    exprs: list[Any] = []
    for value in values:
        exprs.extend(value.components or () if isinstance(value, Direction) else value)
    return {str(symbol) for expr in exprs if isinstance(expr, Expr) for symbol in expr.free_symbols}


class NumbersAsLetters:
    """The letters that replace the numbers of a description, so that its derivation stays symbolic.

    Equal numbers of the same kind share one letter.
    """

    def __init__(self, symbols: Mapping[str, Declared]):
        self.letters = _LettersForNumbers(symbols, set(symbols))
        self.known: dict[tuple[str, Expr], Expr] = {}
        self.measured: list[Measured] = []

    def letter(self, scalar: Scalar, name: str, kind: str, of: int = 1) -> Expr | None:
        """Return the value that replaces a number with a unit: zero, an exact angle, a letter, or minus a letter.
        Return None if the text is an expression.

        of   the number of values that belong together, such as 3 for the sides of a box
        """
        if is_more_than_unit(scalar.text, self.letters.symbols):
            return None
        number = number_with_unit(scalar, Wanted(name, kind), self.letters.symbols)
        if number is None:
            return None
        if (kind, number.si) not in self.known:
            given = _given(name, _asked_of_kind(kind, of), (number,), self.letters)
            self.known[kind, number.si] = given.value
            self.measured += given.measured
        return self.known[kind, number.si]


def _asked_of_kind(kind: str, count: int) -> Asked:
    """Return the annotation for one value of the given kind, with the letters that are usual for `count` values of this
    kind."""
    known = [asked for asked in ANNOTATIONS.values() if asked.each == kind]
    usual = next((asked for asked in known if asked.count == count), next(iter(known), None))
    return Asked(kind, usual.letters if usual and usual.letters else (kind[0],))


class _LettersForNumbers:
    """Finds letters for numbers: an unused declared letter of the right kind, or else a new letter."""

    def __init__(self, symbols: Mapping[str, Declared], used: set[str]):
        self.symbols = dict(symbols)
        self.used = used

    def letter(self, kind: Asked, size: Expr, scalar: Scalar) -> Symbol:
        taken = {*self.used, TIME.name}
        declared = (d for d in self.symbols.values() if d.kind == kind.each and d.name not in taken)
        chosen = next(declared, None)
        if chosen is None:
            free = (name for name in self.usual(kind) if name not in self.symbols)
            name = next(free)
            chosen = Declared(name, symbol_of_kind(name, kind.each), kind.each)
            self.symbols[name] = chosen
        self.used.add(chosen.name)
        check_range(chosen, size, scalar)
        return chosen.symbol

    def usual(self, kind: Asked) -> Iterable[str]:
        yield from kind.letters
        for n in range(1, len(self.symbols) + 2):
            yield f"{kind.letters[0].partition('_')[0]}_{n}"


def _given(name: str, kind: Asked, value: tuple[Expr | Number, ...] | Direction, letters: _LettersForNumbers) -> Given:
    if isinstance(value, Direction):
        return Given(name, kind, value, (), value.name)
    if isinstance(value[0], Number) and kind.each == "angle" and _is_exact_angle(value[0].si):
        number = value[0]
        return Given(name, kind, number.si, written=Amount(number.number, number.unit, number.si / number.number))
    measured: dict[Expr, Measured] = {}
    exprs: list[Expr] = []
    smallest = _common_measure(value)
    for entry in value:
        if isinstance(entry, Expr):
            exprs.append(entry)
            continue
        if entry.number == 0:
            # Zero is exact in every unit, so it needs no letter.
            exprs.append(Integer(0))
            continue
        # If the kind is positive, the letter replaces the absolute value of the number, and the sign is a factor.
        sign = -1 if about_kind(kind.each).positive and entry.number < 0 else 1
        size = entry.si * sign
        # Equal numbers share a letter, so that a cube stays a cube. If all entries are small integer multiples of the
        # smallest one, they share one letter: 2 cm, 4 cm, 6 cm are a, 2a, 3a.
        times = size / smallest.si if smallest else 1
        if smallest:
            entry, size = smallest, smallest.si
        if size not in measured:
            letter = letters.letter(kind, size, entry.scalar)
            measured[size] = Measured(letter, entry.number * sign, entry.unit, size, entry.scalar.place)
        exprs.append(sign * times * measured[size].symbol)
    return Given(name, kind, exprs[0] if kind.count == 1 else tuple(exprs), tuple(measured.values()))


def _is_exact_angle(angle: Expr) -> bool:
    """Return whether the angle is a nonzero multiple of 30 or 45 degrees."""
    parts = angle / pi
    return bool(parts.is_Rational and parts != 0 and (4 * parts).is_Integer | (6 * parts).is_Integer)


def _common_measure(value: tuple[Expr | Number, ...]) -> Number | None:
    """Return the smallest entry if all entries are small integer multiples of it; else None."""
    numbers = [entry for entry in value if isinstance(entry, Number) and entry.number > 0]
    if len(numbers) < len(value):
        return None
    smallest = min(numbers, key=lambda entry: float(entry.si))
    ratios = [entry.si / smallest.si for entry in numbers]
    return smallest if all(ratio.is_Integer and ratio <= 12 for ratio in ratios) else None
