"""Packs the expressions of a chain into printed lines.

A line has at most one reason, and an expression that is too long for a line is broken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from derive.page.chain_lines import Equations
from derive.page.numbering import Number
from derive.page.wording import Inline, Text
from derive.render.notation.breaking import broken, terms_of
from derive.render.notation.layout import Array, Layout, Row, width
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain

LINE_WIDTH, PAGE_WIDTH, TEXT_WIDTH = 74.0, 66.0, 60.0  # widths of a line on paper, in a browser and in text
LINE_INDENT = 4.0  # indent of a continuation line
GAP = 5.0  # width of the gap between two equations on one row
LAW_WIDTH = 28.0  # greatest width of a law in letters, such as T - U, that shares the frame of its result
INEQUALITIES = {"less", "greater", "at_most", "at_least", "unequal"}
MOST_SIDES = 4  # greatest number of right sides on one line of a chain


@dataclass(frozen=True)
class Printed:
    """One printed line: the left side (if the line begins a chain), then relations and right sides, then the reason.

    `framed` is the number of final right sides in a frame.
    """

    left: Layout | None
    sides: tuple[tuple[str, Layout], ...]
    reason: tuple[Inline, ...]
    number: Number | None = None
    framed: int = 0

    @property
    def frames_all(self) -> bool:
        """Return whether the frame includes the whole line; in a continued chain the relation is before the frame."""
        stands_alone = self.left is not None or self.sides[0][0] in ("start", "on")
        return self.framed == len(self.sides) and stands_alone

    @property
    def width(self) -> float:
        return (width(self.left) if self.left else 0) + sum(2 + width(side) for _, side in self.sides)


@lru_cache(maxsize=1024)  # every format and the height of a display need these lines
def printed_lines(equations: Equations, notation: Notation, limit: float = LINE_WIDTH) -> tuple[Printed, ...]:
    """Return the lines of one step, at most `limit` characters wide if they can be broken; the last line has the
    number."""
    packed: list[Printed] = []
    begun: Layout | None = None  # the left side of the current equation
    relations: list[str] = []  # the relation signs of the current equation
    result = len(equations.lines) - equations.framed  # the first line that is framed
    for i, line in enumerate(equations.lines):
        framed = int(i >= result)
        side = (line.relation, notation.result(line.right) if line.presented else notation.layout(line.right))
        last = packed[-1] if packed else None
        indent = width(packed[0].left) if last and last.left is None and packed[0].left is not None else 0
        left = notation.side(line.left) if line.left is not None else None
        goes_on = left is None or left == begun and line.relation == "equals"
        begun, relations = (begun, [*relations, line.relation]) if left is None else (left, [line.relation])
        if last and left is not None and line.beside and _has_room(last, left, side[1], line.reason, limit):
            sides = (*last.sides, ("next", left), side)
            packed[-1] = replace(last, sides=sides, reason=line.reason, framed=len(sides) if last.framed else 0)
            continue
        if last and not goes_on:
            packed.append(Printed(left, (side,), line.reason, framed=framed))
            continue
        if last and framed and i == result and begun is not None:
            answer = Printed(begun, (side,), line.reason, framed=1)
            packed = _with_answer(packed, answer, _joined(relations), line.numeric, limit)
            continue
        if last and line.relation == "equals" and _alike(last.sides[-1][1], side[1]):
            # Two expressions that print the same terms, in any order, are shown once.
            packed[-1] = replace(last, sides=(*last.sides[:-1], side), framed=max(last.framed, framed))
            continue
        reason_room = max(reason_width(line.reason), reason_width(last.reason)) if last else 0
        room = last is not None and indent + last.width + 2 + width(side[1]) + reason_room <= limit
        if last and room and len(last.sides) < MOST_SIDES and not (last.reason and line.reason):
            reason, count = last.reason or line.reason, last.framed + framed
            packed[-1] = Printed(last.left, (*last.sides, side), reason, framed=count)
        else:
            packed.append(Printed(None if last else left, (side,), line.reason, framed=framed))
    lines = [line for whole in packed for line in _fitted(whole, limit)]
    return (*lines[:-1], replace(lines[-1], number=equations.number))


def framed_together(lines: Sequence[Printed]) -> list[list[Printed]]:
    """Group lines into rows of one line each; lines in a common frame form one row."""
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
        if groups and _is_one_answer(lines) and _is_one_answer(steps[i - 1]):
            groups[-1].append(i)
        else:
            groups.append([i])
    return groups


def _is_one_answer(lines: Sequence[Printed]) -> bool:
    return len(lines) == 1 and lines[0].frames_all and all(relation != "next" for relation, _ in lines[0].sides)


def _with_answer(packed: Sequence[Printed], answer: Printed, relation: str, apart: bool, limit: float) -> list[Printed]:
    """Add the result of a chain, which is framed: T = ... = [7/24 M a^2]. A result that means little without its left
    side, such as zero, is framed with the left side.

    relation  the sign between the left side and the result
    apart     whether the result is never framed with the formula before it
    """
    *others, last = packed
    ((sign, result),) = answer.sides
    if sign == "equals" and _alike(last.sides[-1][1], result):  # an expression that prints the same terms is shown once
        last = replace(last, sides=last.sides[:-1])
    law = sum(width(side) for _, side in last.sides)
    whole = replace(answer, sides=(*last.sides, (sign, result)), framed=len(last.sides) + 1)
    begins = bool(last.sides) and last.left == answer.left and not last.reason and not apart
    needs_left = relation in INEQUALITIES or _is_zero(result)
    if begins and (law <= LAW_WIDTH or needs_left) and whole.width + reason_width(answer.reason) <= TEXT_WIDTH:
        return [*others, whole]
    if needs_left:
        return [*others, *([last] if last.sides else []), replace(answer, sides=((relation, result),))]
    reason = last.reason or answer.reason
    row = replace(last, sides=(*last.sides, (sign, result)), reason=reason, framed=1)
    indent = width(answer.left) if answer.left is not None and last.left is None else 0
    fits = indent + row.width + reason_width(reason) <= limit and len(row.sides) <= MOST_SIDES
    if limit <= TEXT_WIDTH and any(_has_vector(side) for _, side in row.sides):
        fits = False  # text shows the column (a, b, c) as a row, which is wider
    if not last.sides or fits and not (last.reason and answer.reason):
        return [*others, row]
    return [*others, last, replace(row, left=None, sides=((sign, result),), reason=answer.reason)]


def _has_vector(side: Layout) -> bool:
    return isinstance(side, Array) or isinstance(side, Row) and any(map(_has_vector, side.items))


def _is_zero(result: Layout) -> bool:
    if isinstance(result, Array):
        return all(_is_zero(entry) for line in result.rows for entry in line)
    return plain(result).strip() == "0"


def _joined(relations: Sequence[str]) -> str:
    """Return the relation between the left side and the last right side of a chain: from S > a and a = b follows S >
    b."""
    others = [each for each in relations if each != "equals"]
    return next((each for each in others if each in INEQUALITIES), others[0] if others else "equals")


def _has_room(last: Printed, left: Layout, right: Layout, reason: tuple[Inline, ...], limit: float) -> bool:
    return last.width + GAP + width(left) + 2 + width(right) + reason_width(reason) <= limit


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
    return [replace(each, framed=len(each.sides)) for each in whole] if line.framed else whole


def reason_width(reason: tuple[Inline, ...]) -> float:
    """Return the width of a reason in small print with the gap before it."""
    return 3 + 0.75 * sum(len(node.text) if isinstance(node, Text) else 3 for node in reason) if reason else 0
