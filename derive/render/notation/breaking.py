"""Breaks a sum that is too long for a line. A line ends before a plus or minus sign, but never within a root or matrix.

A bracket that is itself too long opens on one line and closes on another. If the numerator of a fraction is long,
1/denominator becomes a factor in front, and the numerator is broken like such a bracket.
"""

from __future__ import annotations

from derive.render.notation.layout import Digits, Fenced, Fraction, Layout, Operator, Row, row, width

BREAKS_BEFORE = {"plus", "minus"}
SMALL_PART = 0.5  # a bracket narrower than this fraction of a line is not broken


def broken(layout: Layout, room: float, room_after: float) -> list[Layout]:
    """Return the lines of a layout; one line if the layout cannot be broken.

    room         the greatest width of the first line, if the terms allow this width
    room_after   the same for the other lines
    """
    pieces = _pieces(layout, min(room, room_after)) if width(layout) > room else [layout]
    lines = [pieces[0]]
    for piece in pieces[1:]:
        longer = row(lines[-1], piece)
        if width(longer) <= (room if len(lines) == 1 else room_after):
            lines[-1] = longer
        else:
            lines.append(piece)
    return lines


def _pieces(layout: Layout, room: float) -> list[Layout]:
    terms = terms_of(layout)
    if len(terms) > 1:
        return [piece for term in terms for piece in (_pieces(term, room) if width(term) > room else [term])]
    items = layout.items if isinstance(layout, Row) else (layout,)
    at = max(range(len(items)), key=lambda i: width(items[i]))
    before, widest, after = items[:at], items[at], items[at + 1 :]
    if isinstance(widest, Fraction) and len(terms_of(widest.above)) > 1 and width(widest) > SMALL_PART * room:
        before, widest = (*before, Fraction(Digits("1"), widest.below)), Fenced(widest.above)
    if not isinstance(widest, Fenced) or widest.kind != "(" or width(widest) <= SMALL_PART * room:
        return [layout]
    first, *others = _pieces(widest.inside, room)
    if not others:
        return [layout]
    return [row(*before, Operator("open"), first), *others[:-1], row(others[-1], Operator("close"), *after)]


def terms_of(layout: Layout) -> list[Layout]:
    """Return the terms of a sum, each with its sign."""
    if not isinstance(layout, Row):
        return [layout]
    terms: list[list[Layout]] = [[]]
    for item in layout.items:
        if isinstance(item, Operator) and item.kind in BREAKS_BEFORE and terms[-1]:
            terms.append([])
        terms[-1].append(item)
    return [row(*term) for term in terms]
