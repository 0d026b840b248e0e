"""Which forms of a chain share a line: as many as fit, a form with a reason ending its line."""

from __future__ import annotations

from dataclasses import dataclass

from derive.document import Equations, Line
from derive.render.layout import (
    Applied,
    Array,
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
)
from derive.render.notation import Notation
from derive.wording import Node, Text


@dataclass(frozen=True)
class Printed:
    """One printed line: `left` if it begins the chain, then relations and right sides, then the reason."""

    left: Layout | None
    sides: tuple[tuple[str, Layout], ...]
    reason: tuple[Node, ...]
    number: int | None = None

    @property
    def width(self) -> float:
        return (width(self.left) if self.left else 0) + sum(2 + width(side) for _, side in self.sides)


def printed_lines(equations: Equations, notation: Notation, limit: float) -> list[Printed]:
    """The lines of one step, packed to a width in characters; the last carries the number."""
    packed: list[Printed] = []
    for line in equations.lines:
        side = (line.relation, right_side(line, notation))
        last = packed[-1] if packed else None
        if line.left is not None and packed:
            packed.append(Printed(notation.layout(line.left), (side,), line.reason))
            continue
        if last and last.sides[-1][1] == side[1] and line.relation == "equals":
            continue  # what is laid out alike is one line to the reader
        room = last is not None and last.width + 2 + width(side[1]) + reason_width(last.reason) <= limit
        if last and room and len(last.sides) < 3 and not (last.reason and line.reason):
            packed[-1] = Printed(last.left, (*last.sides, side), last.reason or line.reason)
        else:
            left = notation.layout(line.left) if line.left is not None else None
            packed.append(Printed(left, (side,), line.reason))
    end = packed[-1]
    packed[-1] = Printed(end.left, end.sides, end.reason, equations.number)
    return packed


def reason_width(reason: tuple[Node, ...]) -> float:
    """A reason is set small, with a gap before it."""
    return 3 + 0.75 * sum(len(node.text) if isinstance(node, Text) else 3 for node in reason) if reason else 0


def right_side(line: Line, notation: Notation) -> Layout:
    return notation.result(line.right) if line.presented else notation.layout(line.right)


def width(layout: Layout) -> float:
    """About how many characters wide a layout is in print."""
    match layout:
        case Number(digits):
            return len(digits)
        case Name(_, subscript, _, _):
            return 1.2 + 0.7 * len(subscript)
        case Word(text):
            return 0.9 * len(text)
        case Mark(kind):
            return {"space": 0.4, "dot": 1.2}.get(kind, 2)
        case Row(items):
            return sum(width(item) for item in items)
        case Fraction(above, below):
            return max(width(above), width(below)) + 0.6
        case Raised(base, power):
            return width(base) + 0.7 * width(power)
        case Lowered(base, word):
            return width(base) + 0.6 * len(word)
        case RootSign(inside):
            return width(inside) + 1.5
        case Fenced(inside, _):
            return width(inside) + 1.6
        case Limits(inside, lower, upper):
            return width(inside) + 1.6 + 0.7 * max(width(lower), width(upper))
        case IntegralSign(lower, upper):
            return 2.0 + (0.5 * max(width(lower), width(upper)) if lower and upper else 0)
        case Applied(name, argument, power):
            return 0.9 * len(name) + 0.5 + width(argument) + (0.7 * width(power) if power else 0)
        case Array(rows):
            columns = [max(width(line[j]) for line in rows) for j in range(len(rows[0]))]
            return sum(columns) + 2.0 * (len(columns) - 1) + 2.6
