"""Writes a layout as plain text for a terminal: one line if possible, a block of lines for a tensor.

These are the rules for reading a line; `tests/printed/from_text.py` reads every printed line by these rules:

    a b, 2a      a product; it binds tighter than `·` and `×` of vectors, which bind tighter than + and -.
    1/2 M a²/b   from left to right: half of M a², divided by b. A product after the stroke is in brackets.
    a·3b         a product with a later factor that begins with a number.
    a⃗·b⃗, a⃗ × b⃗  a product of vectors: it extends on either side up to the next sign.
    -a b         minus the whole product. This sign appears only where a sum begins, never after `·` or another sign.
    sin θ        a function of one letter. A longer argument is in brackets, `sin(2θ)`; sin² θ is the square of sin θ.
    √a           the square root of one letter or number; any other square root is √(...).
    a⃗, I⃡        a vector under an arrow, a tensor under a double arrow; `I` is a scalar, `1⃡` the unit tensor, 0 a zero.
    ∫(0..a) dx   an integral over everything that follows in its product; `∫ f dm` is over a body.
    [F](0..a)    F between two limits; U|(x = 0) is U at a place; dL/dt and d/dt (...) are derivatives.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from itertools import pairwise
from typing import Any

from derive.render.notation.layout import (
    ACCENTS,
    DEGREE_SIGN,
    GREEK_LETTERS,
    SCRIPT_LETTERS,
    SIGNS,
    THIN_SPACE,
    Applied,
    Array,
    Bracketed,
    Digits,
    Evaluated,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Lowered,
    Name,
    Operator,
    Raised,
    RootSign,
    Row,
    Sign,
    Upright,
    begins_with_number,
    first_of,
    is_differential,
    last_of,
    separator_of,
)

TEXT_OPERATORS = {
    "dot": "·",
    "inner": "·",
    "times": "×",
    "cross": " × ",
    "plus": " + ",
    "minus": " - ",
    "equals": " = ",
    "approx": " ≈ ",
    "unequal": " ≠ ",
    "less": " < ",
    "greater": " > ",
    "at_most": " ≤ ",
    "at_least": " ≥ ",
    "tends": " → ",
    "plus_minus": " ± ",
    "space": " ",
    "comma": ", ",
    "semicolon": "; ",
    "open": "(",
    "close": ")",
    "start": "",
    "on": "    ",
    "next": ",   ",
    "stroke": "/",
}
LEADING_SIGNS: dict[Layout, str] = {Operator("minus"): "-", Operator("plus_minus"): "±"}  # at the beginning of a sum
UNITS = {DEGREE_SIGN.text: "°", "partial": "∂"}
PRINTED_LETTERS = {**GREEK_LETTERS, **SCRIPT_LETTERS}
ARROWS = {"vector": "\u20d7", "tensor": "\u20e1"}
_RAISED = str.maketrans("0123456789-+", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺")


def columns(text: str) -> int:
    """Return the width of a text in columns; an arrow or a dot above a letter has no width."""
    return len(text) if text.isascii() else sum(not unicodedata.combining(character) for character in text)


def to_the_right(text: str, width: int) -> str:
    return " " * (width - columns(text)) + text


@dataclass(frozen=True)
class TextBox:
    """Lines of equal width; text next to the box is on the line with the index `middle`."""

    lines: tuple[str, ...]
    middle: int = 0

    @property
    def width(self) -> int:
        return columns(self.lines[0])

    def beside(self, other: TextBox) -> TextBox:
        if len(self.lines) == len(other.lines) == 1:
            return TextBox((self.lines[0] + other.lines[0],))
        above = max(self.middle, other.middle)
        below = max(len(self.lines) - self.middle, len(other.lines) - other.middle)
        left, right = (each._padded(above, below) for each in (self, other))
        return TextBox(tuple(a + b for a, b in zip(left, right, strict=True)), above)

    def _padded(self, above: int, below: int) -> list[str]:
        blank = " " * self.width
        missing_below = below - (len(self.lines) - self.middle)
        return [blank] * (above - self.middle) + list(self.lines) + [blank] * missing_below


def plain(layout: Layout) -> str:
    """Return a layout as text of one or more lines."""
    return "\n".join(line.rstrip() for line in text_box(layout).lines)


def in_one_line(layout: Layout) -> str:
    """Return a layout as text on a single line, a matrix row by row in brackets."""
    return plain(_on_one_line(layout))


def text_box(layout: Layout) -> TextBox:
    match layout:
        case Array(rows):
            return _array(rows)
        case Row(items):
            return _row(items)
        case Fenced(inside, kind):
            inner = text_box(inside)
            if len(inner.lines) > 1:
                return _tall_fence(inner, kind)
            left, right = {"(": ("(", ")"), "[": ("[", "]"), "|": ("|", "|"), "{": ("{", "}")}[kind]
            return TextBox((f"{left}{inner.lines[0]}{right}",))
        case Lowered(base, word):
            below = word if isinstance(word, str) else in_one_line(word)
            return text_box(base).beside(TextBox((f"_{below if below.isalnum() else f'({below})'}",)))
    return TextBox((_line(_on_one_line(layout) if _holds_matrix(layout) else layout),))


def _holds_matrix(layout: Any) -> bool:
    if isinstance(layout, Array) and len(layout.rows[0]) > 1:
        return True
    parts = layout if isinstance(layout, tuple) else vars(layout).values()
    return any(_holds_matrix(part) for part in parts if part is not None and not isinstance(part, str | int))


def _on_one_line(layout: Any) -> Any:
    if isinstance(layout, Array) and len(layout.rows[0]) > 1:
        lines = [_in_brackets(line) for line in layout.rows]
        return _in_brackets([_on_one_line(line) for line in lines])
    if isinstance(layout, tuple):
        return tuple(_on_one_line(item) for item in layout)
    if not is_dataclass(layout) or isinstance(layout, type):
        return layout
    return replace(layout, **{part.name: _on_one_line(getattr(layout, part.name)) for part in fields(layout)})


def _in_brackets(entries: Sequence[Layout]) -> Layout:
    return Fenced(Row(tuple(item for entry in entries for item in (separator_of(entries), entry))[1:]))


def _line(layout: Layout) -> str:
    match layout:
        case Digits(digits):
            return digits
        case Name(base, subscript, dots, style, accent):
            letter = PRINTED_LETTERS.get(layout.letter, layout.letter)
            dotted = {0: "", 1: "\u0307", 2: "\u0308"}.get(dots, "'" * dots)
            arrow = ARROWS.get(style, "") if base != "0" else ""
            between, parts = layout.below
            below = f"_{between.join(GREEK_LETTERS.get(part, part) for part in parts)}" if subscript else ""
            return letter + ACCENTS.get(accent, "") + dotted + arrow + layout.primes + below
        case Upright(text):
            return UNITS.get(text, text)
        case Operator(kind):
            return TEXT_OPERATORS[kind]
        case Sign(command):
            return SIGNS[command]
        case Fraction(above, below):
            return f"{_tight(above, is_above=True)}/{_tight(below)}"
        case Raised(base, power):
            exponent = _line(power).replace(" ", "")
            small = exponent.translate(_RAISED)
            letter = f"({_line(base)})" if isinstance(base, Name) and base.dots else _line(base)
            if exponent.isalpha():
                return f"{letter}^{exponent}"
            return letter + (small if set(exponent) <= set("0123456789-+") else f"^({exponent})")
        case RootSign(inside, degree):
            inner = plain(inside)
            root = f"{_line(degree).translate(_RAISED)}√" if degree else "√"
            return f"{root}{inner}" if isinstance(inside, Digits | Name) else f"{root}({inner})"
        case Bracketed(inside, lower, upper):
            return f"[{plain(inside)}]({plain(lower)}..{plain(upper)})"
        case Evaluated(inside, where):
            return f"{plain(inside)}|({plain(where)})"
        case IntegralSign(lower, upper):
            limits = "..".join(plain(limit) for limit in (lower, upper) if limit)
            return f"∫({limits}) " if limits else "∫ "
        case Applied(name, argument, power):
            raised = _line(power).translate(_RAISED) if power else ""
            inner = plain(argument)
            return f"{name}{raised}{inner if isinstance(argument, Fenced) else ' ' + inner}"
    return plain(layout)


def _tight(layout: Layout, *, is_above: bool = False) -> str:
    """Return an operand of `/`, in brackets if it would be misread."""
    text = plain(layout)
    last = last_of(layout)
    if isinstance(last, Applied) and not isinstance(last.argument, Fenced):
        return f"({text})"  # sin x/2 could be read as the sine of x/2
    single = isinstance(layout, Digits | Name | Raised | RootSign | Fenced | Applied)
    product = is_above and isinstance(layout, Row) and not any(isinstance(item, Operator) for item in layout.items)
    return text if single or product or is_differential(first_of(layout)) else f"({text})"


def _row(items: tuple[Layout, ...]) -> TextBox:
    pieces = [_piece(before, item) for before, item in zip((None, *items), items, strict=False)]
    result = pieces[0] if pieces else TextBox(("",))
    for i, (before, item) in enumerate(pairwise(items), 1):
        piece = pieces[i]
        if item == THIN_SPACE and i < len(items) - 1:
            piece = TextBox((_gap(items[:i], items[i + 1], pieces[i + 1]),))
        elif _needs_space(before, item):
            result = result.beside(TextBox((_gap(items[:i], item, piece),)))
        result = result.beside(piece)
    return result


def _piece(before: Layout | None, item: Layout) -> TextBox:
    leads = before is None or isinstance(before, Operator) and before.kind not in ("plus", "minus", "space", "close")
    return TextBox((LEADING_SIGNS[item],)) if leads and item in LEADING_SIGNS else text_box(item)


def _gap(before: tuple[Layout, ...], item: Layout, piece: TextBox) -> str:
    """Return the text between two factors, such as a dot before a digit."""
    begins = len(piece.lines) == 1 and piece.lines[0][:1].isdigit() and not isinstance(first_of(item), Name)
    behind_differential = len(before) > 1 and is_differential(before[-2])
    return "·" if begins and not behind_differential else " "


def _needs_space(before: Layout, item: Layout) -> bool:
    if isinstance(before, Operator | IntegralSign | Sign) or isinstance(item, Operator | Sign):
        return False
    if item == DEGREE_SIGN or is_differential(before):
        return False
    if isinstance(before, Digits):
        return isinstance(item, Upright | Array) or begins_with_number(item)
    return True


def _array(rows: tuple[tuple[Layout, ...], ...]) -> TextBox:
    cells = [[plain(entry) for entry in line] for line in rows]
    widths = [max(columns(line[j]) for line in cells) for j in range(len(cells[0]))]
    lines = ["  ".join(to_the_right(text, width) for text, width in zip(line, widths, strict=True)) for line in cells]
    if len(lines) == 1:
        return TextBox((f"({lines[0]})",))
    if len(rows[0]) == 1:  # a column is written on one line as a list of components
        between = TEXT_OPERATORS[separator_of(entry for (entry,) in rows).kind]
        return TextBox(("(" + between.join(line[0] for line in cells) + ")",))
    left = ["⎡"] + ["⎢"] * (len(lines) - 2) + ["⎣"]
    right = ["⎤"] + ["⎥"] * (len(lines) - 2) + ["⎦"]
    return TextBox(tuple(a + line + b for a, line, b in zip(left, lines, right, strict=True)), len(lines) // 2)


def _tall_fence(inner: TextBox, kind: str) -> TextBox:
    n = len(inner.lines)
    if kind != "(":
        return TextBox(tuple(f"|{line}|" for line in inner.lines), inner.middle)
    left = ["⎛"] + ["⎜"] * (n - 2) + ["⎝"]
    right = ["⎞"] + ["⎟"] * (n - 2) + ["⎠"]
    return TextBox(tuple(a + line + b for a, line, b in zip(left, inner.lines, right, strict=True)), inner.middle)
