"""Packs the expressions of a chain into printed lines.

A line has at most one reason, and an expression that is too long for a line is broken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, reduce

from derive.page.chain_lines import Equations
from derive.page.numbering import Number
from derive.page.wording import Inline, Text
from derive.render.notation.breaking import broken, terms_of
from derive.render.notation.layout import Layout, width
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain

# Widths are in characters.
LINE_WIDTH, PAGE_WIDTH, TEXT_WIDTH = 74.0, 66.0, 60.0  # greatest widths of a line on paper, in a browser, in text
LINE_INDENT = 4.0  # indent of a continuation line
GAP = 5.0  # width of the gap between two equations on one row
MOST_BEFORE = 2  # an answer with more lines before it never shares its frame with other answers
INEQUALITIES = {"less", "greater", "at_most", "at_least", "unequal"}
MOST_SIDES = 4  # greatest number of right sides on one line of a chain


@dataclass(frozen=True)
class Printed:
    """One printed line: the left side (if the line begins a chain), then relations and right sides, then the reason.

    `framed` is whether the line is an answer or a part of one.
    """

    left: Layout | None
    sides: tuple[tuple[str, Layout], ...]
    reason: tuple[Inline, ...]
    number: Number | None = None
    framed: bool = False

    @property
    def width(self) -> float:
        return (width(self.left) if self.left else 0) + sum(2 + width(side) for _, side in self.sides)


@lru_cache(maxsize=1024)  # every format needs these lines, and the height of a display depends on them
def printed_lines(equations: Equations, notation: Notation, limit: float = LINE_WIDTH) -> tuple[Printed, ...]:
    """Return the lines of one step, at most `limit` characters wide if they can be broken; the last line has the
    number."""
    packed: list[Printed] = []
    begun: Layout | None = None  # the left side of the current equation
    relations: list[str] = []  # the relation signs of the current equation
    result = len(equations.lines) - equations.framed  # the index of the first framed line
    for i, line in enumerate(equations.lines):
        framed = i >= result
        side = (line.relation, notation.result(line.right) if line.presented else notation.layout(line.right))
        last = packed[-1] if packed else None
        indent = width(packed[0].left) if last and last.left is None and packed[0].left is not None else 0
        left = notation.side(line.left) if line.left is not None else None
        goes_on = left is None or left == begun and line.relation == "equals"
        begun, relations = (begun, [*relations, line.relation]) if goes_on else (left, [line.relation])
        own = Printed(left, (side,), line.reason, framed=framed)
        if last and left is not None and line.beside and not last.reason and _has_room(last, left, own, limit):
            sides = (*last.sides, ("next", left), side)
            packed[-1] = replace(last, sides=sides, reason=line.reason)
            continue
        if last and not goes_on:
            packed.append(own)
            continue
        if last and framed and i == result:
            packed = _with_answer(packed, replace(own, left=begun), _joined(relations))
            continue
        if last and line.relation == "equals" and _alike(last.sides[-1][1], side[1]):
            # Two expressions that print the same terms, in any order, are shown once.
            packed[-1] = replace(last, sides=(*last.sides[:-1], side))
            continue
        reason_room = max(reason_width(line.reason), reason_width(last.reason)) if last else 0
        room = last is not None and indent + last.width + 2 + width(side[1]) + reason_room <= limit
        if last and room and len(last.sides) < MOST_SIDES and not (last.reason and line.reason):
            packed[-1] = replace(last, sides=(*last.sides, side), reason=last.reason or line.reason)
        else:
            packed.append(replace(own, left=None if last else left))
    lines = [line for whole in packed for line in _fitted(whole, limit)]
    return (*lines[:-1], replace(lines[-1], number=equations.number))


def framed_together(lines: Sequence[Printed]) -> list[list[Printed]]:
    """Group lines into rows: the lines of a common frame form one row, and each other line is a row."""
    rows: list[list[Printed]] = []
    for line in lines:
        goes_on = line.left is None and line.sides[0][0] == "on"
        if goes_on and line.framed and rows and rows[-1][-1].framed:
            rows[-1].append(line)
        else:
            rows.append([line])
    return rows


def answers_together(steps: Sequence[Sequence[Printed]]) -> list[list[int]]:
    """Group the steps of a display: consecutive answers share a frame. Return the positions of the steps of each
    group."""
    groups: list[list[int]] = []
    for i, lines in enumerate(steps):
        if groups and _ends_with_answer(lines) and _ends_with_answer(steps[i - 1]):
            groups[-1].append(i)
        else:
            groups.append([i])
    return groups


def before_answers(steps: Sequence[Sequence[Printed]], limit: float = LINE_WIDTH) -> list[Printed]:
    """Return the lines that precede the common frame of several answers; short laws share a line.

    A line has an even number of laws, such as pairs of Hamilton's equations, if all lines can then have the same
    number.
    """
    derived = [lines[:-1] for lines in steps]
    laws = [line for lines in derived for line in lines]
    shared = all(len(lines) <= 1 for lines in derived)
    rows = _filled(laws, limit if shared else 0)
    most = max(map(len, rows), default=0)
    equal = next((n for n in range(most - most % 2, 0, -2) if len(laws) % n == 0), 0)
    if len(rows) > 1 and equal:
        rows = [laws[i : i + equal] for i in range(0, len(laws), equal)]
    return [reduce(_beside, row) for row in rows]


def _filled(laws: Sequence[Printed], limit: float) -> list[list[Printed]]:
    """Distribute laws among rows: a law is added to the last row if there is room for it."""
    rows: list[list[Printed]] = []
    for law in laws:
        last = reduce(_beside, rows[-1]) if rows else None
        if last and law.left is not None and not last.reason and _has_room(last, law.left, law, limit):
            rows[-1].append(law)
        else:
            rows.append([law])
    return rows


def _beside(row: Printed, law: Printed) -> Printed:
    assert law.left is not None
    return replace(row, sides=(*row.sides, ("next", law.left), *law.sides), reason=law.reason)


def _ends_with_answer(lines: Sequence[Printed]) -> bool:
    *before, last = lines
    is_alone = last.left is not None and all(relation != "next" for relation, _ in last.sides)
    return last.framed and is_alone and len(before) <= MOST_BEFORE and not any(line.framed for line in before)


def _with_answer(packed: Sequence[Printed], answer: Printed, relation: str) -> list[Printed]:
    """Add the result of a chain as a separate equation in a frame: T = ... and then [T = 7/24 M a^2].

    relation  the sign between the left side and the result
    """
    *others, last = packed
    ((sign, result),) = answer.sides
    if sign == "equals" and _alike(last.sides[-1][1], result):  # an expression that prints the same terms is shown once
        own, moved = (last.reason, ()) if answer.reason else ((), last.reason)
        last = replace(last, sides=last.sides[:-1], reason=own)
        answer = replace(answer, reason=answer.reason or moved)
    return [*others, *([last] if last.sides else []), replace(answer, sides=((relation, result),))]


def _joined(relations: Sequence[str]) -> str:
    """Return the relation between the left side and the last right side of a chain: from S > a and a = b follows S >
    b."""
    others = [each for each in relations if each != "equals"]
    return next((each for each in others if each in INEQUALITIES), others[0] if others else "equals")


def _has_room(last: Printed, left: Layout, right: Printed, limit: float) -> bool:
    """Return whether an equation has room in the row of another equation."""
    return last.width + GAP + replace(right, left=left).width + reason_width(right.reason) <= limit


def _alike(first: Layout, second: Layout) -> bool:
    terms, others = terms_of(first), terms_of(second)
    return first == second or len(terms) == len(others) and _as_read(terms) == _as_read(others)


def _as_read(terms: list[Layout]) -> list[str]:
    """Return the terms as sorted texts, so that order and spacing do not matter in a comparison."""
    return sorted("".join(plain(term).split()) for term in terms)


def _fitted(line: Printed, limit: float) -> list[Printed]:
    """Break a line that is too long into several, if possible."""
    if line.width <= limit or len(line.sides) > 1:
        return [line]
    ((relation, side),) = line.sides
    if line.left is not None and width(line.left) > width(side):
        room = limit - 2 - width(side)
        first, *others = broken(line.left, room, room - LINE_INDENT)
        begun, ends = Printed(None, (("start", first),), ()), line.sides
    else:
        room = limit - 2 - (width(line.left) if line.left is not None else 0)
        first, *others = broken(side, room, room - LINE_INDENT)
        begun, ends = Printed(line.left, ((relation, first),), ()), line.sides[:0]
    if not others:
        return [line]
    *between, last = (Printed(None, (("on", piece),), ()) for piece in others)
    whole = [begun, *between, replace(last, sides=(*last.sides, *ends), reason=line.reason)]
    return [replace(each, framed=line.framed) for each in whole]


def reason_width(reason: tuple[Inline, ...]) -> float:
    """Return the width of a reason in small print with the gap before it."""
    return 3 + 0.75 * sum(len(node.text) if isinstance(node, Text) else 3 for node in reason) if reason else 0
