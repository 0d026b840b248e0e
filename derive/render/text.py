"""Layout to plain text for a terminal: one line where it can be, a block of lines for vectors and tensors."""

from __future__ import annotations

from dataclasses import dataclass

from derive.render.layout import (
    GREEK,
    Applied,
    Array,
    Evaluated,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Limits,
    Lowered,
    Mark,
    Name,
    Number,
    Raised,
    RootSign,
    Row,
    Word,
    begins_with_number,
)

MARKS = {
    "dot": "·",
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
    "plus_minus": " ± ",
    "space": " ",
    "comma": ", ",
    "open": "(",
    "close": ")",
    "start": "",
    "on": "    ",
}
UNITS = {"degree": "°", "deg": "°", "partial": "∂"}
_RAISED = str.maketrans("0123456789-+", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺")


@dataclass(frozen=True)
class Box:
    """Lines of equal width; `middle` is the one that a line of text continues."""

    lines: tuple[str, ...]
    middle: int = 0

    @property
    def width(self) -> int:
        return len(self.lines[0])

    def beside(self, other: Box) -> Box:
        above = max(self.middle, other.middle)
        below = max(len(self.lines) - self.middle, len(other.lines) - other.middle)
        left, right = (box._padded(above, below) for box in (self, other))
        return Box(tuple(a + b for a, b in zip(left, right, strict=True)), above)

    def _padded(self, above: int, below: int) -> list[str]:
        blank = " " * self.width
        missing_below = below - (len(self.lines) - self.middle)
        return [blank] * (above - self.middle) + list(self.lines) + [blank] * missing_below


def plain(layout: Layout) -> str:
    """A layout as text, possibly of several lines."""
    return "\n".join(line.rstrip() for line in box(layout).lines)


def box(layout: Layout) -> Box:
    match layout:
        case Array(rows):
            return _array(rows)
        case Row(items):
            return _row(items)
        case Fenced(inside, kind):
            inner = box(inside)
            if len(inner.lines) > 1:
                return _tall_fence(inner, kind)
            return Box((f"({inner.lines[0]})" if kind == "(" else f"|{inner.lines[0]}|",))
    return Box((_line(layout),))


def _subscript(text: str) -> str:
    """Letters run together; a word stands behind a comma."""
    parts = text.split("_")
    return GREEK.get(text, ("," if any(len(part) > 2 for part in parts) else "").join(parts))


def _line(layout: Layout) -> str:
    match layout:
        case Number(digits):
            return digits
        case Name(base, subscript, dots, style):
            unprimed = base.rstrip("'")
            letter = GREEK.get(unprimed, unprimed) + {0: "", 1: "\u0307", 2: "\u0308"}.get(dots, "'" * dots)
            mark = "\u20d7" if style == "vector" and base != "0" else ""
            return letter + mark + base[len(unprimed) :] + (f"_{_subscript(subscript)}" if subscript else "")
        case Word(text):
            return UNITS.get(text, text)
        case Mark(kind):
            return MARKS[kind]
        case Fraction(above, below):
            return f"{_tight(above, is_above=True)}/{_tight(below)}"
        case Raised(base, power):
            exponent = _line(power).replace(" ", "")
            small = exponent.translate(_RAISED)
            letter = f"({_line(base)})" if isinstance(base, Name) and base.dots else _line(base)
            return letter + (small if not small.isascii() and "/" not in exponent else f"^({exponent})")
        case Lowered(base, word):
            return f"{plain(base)}_{word}"
        case RootSign(inside):
            inner = plain(inside)
            return f"√{inner}" if isinstance(inside, Number | Name) else f"√({inner})"
        case Limits(inside, lower, upper):
            return f"[{plain(inside)}]({plain(lower)}..{plain(upper)})"
        case Evaluated(inside, where):
            return f"{plain(inside)}|({plain(where)})"
        case IntegralSign(lower, upper):
            return "∫ " if lower is None or upper is None else f"∫({plain(lower)}..{plain(upper)}) "
        case Applied(name, argument, power):
            raised = _line(power).translate(_RAISED) if power else ""
            inner = plain(argument)
            return f"{name}{raised}{inner if isinstance(argument, Fenced) else ' ' + inner}"
    return plain(layout)


def _tight(layout: Layout, *, is_above: bool = False) -> str:
    """An operand of `/`: bracketed if it would be misread; a product may stand before the stroke as it is."""
    text = plain(layout)
    simple = isinstance(layout, Number | Name | Raised | RootSign | Fenced | Applied) or _is_differential(layout)
    product = is_above and isinstance(layout, Row) and not any(isinstance(item, Mark) for item in layout.items)
    return text if simple or product else f"({text})"


def _row(items: tuple[Layout, ...]) -> Box:
    result: Box | None = None
    before: Layout | None = None
    for i, item in enumerate(items):
        leads = i == 0 or (isinstance(before, Mark) and before.kind not in ("plus", "minus", "space"))
        piece = Box(("-",)) if leads and item == Mark("minus") else box(item)
        if result is not None and before is not None and _needs_space(before, item):
            result = result.beside(Box((" ",)))
        result = piece if result is None else result.beside(piece)
        before = item
    return result or Box(("",))


def _needs_space(before: Layout, item: Layout) -> bool:
    """`13/12 M a²`, but `2a` and `3(x + y)`."""
    if isinstance(before, Mark | IntegralSign) or isinstance(item, Mark):
        return False
    if item in (Word("degree"), Word("deg")):
        return False
    if _is_sign_of_change(before):
        return False
    if isinstance(before, Number):
        return isinstance(item, Word | Array) or begins_with_number(item)
    return True


def _is_sign_of_change(layout: Layout) -> bool:
    """d, d^2 or a curly d."""
    sign = layout.base if isinstance(layout, Raised) else layout
    return sign in (Word("d"), Word("partial"))


def _is_differential(layout: Layout) -> bool:
    """d or dx, which need no brackets above or below a stroke."""
    first = layout.items[0] if isinstance(layout, Row) else layout
    return _is_sign_of_change(first)


def _array(rows: tuple[tuple[Layout, ...], ...]) -> Box:
    cells = [[plain(entry) for entry in line] for line in rows]
    widths = [max(len(line[j]) for line in cells) for j in range(len(cells[0]))]
    lines = ["  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True)) for line in cells]
    if len(lines) == 1:
        return Box((f"({lines[0]})",))
    if len(rows[0]) == 1:  # a column: one line, as vectors are written in running text
        return Box(("(" + ", ".join(line[0] for line in cells) + ")",))
    left = ["⎡"] + ["⎢"] * (len(lines) - 2) + ["⎣"]
    right = ["⎤"] + ["⎥"] * (len(lines) - 2) + ["⎦"]
    return Box(tuple(a + line + b for a, line, b in zip(left, lines, right, strict=True)), len(lines) // 2)


def _tall_fence(inner: Box, kind: str) -> Box:
    n = len(inner.lines)
    if kind != "(":
        return Box(tuple(f"|{line}|" for line in inner.lines), inner.middle)
    left = ["⎛"] + ["⎜"] * (n - 2) + ["⎝"]
    right = ["⎞"] + ["⎟"] * (n - 2) + ["⎠"]
    return Box(tuple(a + line + b for a, line, b in zip(left, inner.lines, right, strict=True)), inner.middle)
