"""Positions of the names of several curves in one panel: each next to its own curve and away from the others."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import dist, hypot

from derive.figures.space import Spot
from derive.render.drawing.sheets import Extent

GAP = 3.5  # in points: the distance of a name from its curve
CLEAR = 2.0  # in points: the least distance between a name and a curve or another text
WORDS = 9.0  # in points: the least distance between two texts in the same line
APART = 8.0  # in points: the least distance of a name from the other curves
ENOUGH = 30.0  # in points: a greater distance from the other curves is not better
STEP = 2.0  # in points: the distance between the points that represent a curve
TRIED = 48  # the approximate number of places along a curve at which a name is tried
INNER = 9.0  # in points: the distance of a legend from the axes with their ticks
LONGEST = 0.35  # greatest fraction of a curve that the gap for its name removes
STUB = 15.0  # in points: the least distance from the gap in an open curve to an end of the curve
TURN = 4.0  # in points: the least distance, if possible, of the gap in a closed curve from a turning point of the curve
ENDS = 0.04  # fraction of a curve, at each of its ends, at which no name is tried


def dots_of(spots: Sequence[Spot]) -> list[Spot]:
    """Return points along a line, at small distances from one another."""
    found = [spots[0]]
    for (x, y), (u, v) in pairwise(spots):
        parts = max(1, round(dist((x, y), (u, v)) / STEP))
        found += [(x + (u - x) * i / parts, y + (v - y) * i / parts) for i in range(1, parts + 1)]
    return found


def is_clear(box: Extent, dots: Sequence[Spot], others: Sequence[Extent]) -> bool:
    """Return whether a box neither covers nor nearly touches a point of a curve or another box."""
    left, below, right, above = box[0] - CLEAR, box[1] - CLEAR, box[2] + CLEAR, box[3] + CLEAR
    return not any(left < x < right and below < y < above for x, y in dots) and not any(
        box[0] - WORDS < other[2] and other[0] < box[2] + WORDS and below < other[3] and other[1] < above
        for other in others
    )


def is_inside(box: Extent, panel: Extent) -> bool:
    return panel[0] <= box[0] and panel[1] <= box[1] and box[2] <= panel[2] and box[3] <= panel[3]


def beside_curves(
    curves: Sequence[Sequence[Spot]],
    sizes: Sequence[tuple[float, float]],
    panel: Extent,
    taken: Sequence[Extent],
    lines: Sequence[Spot] = (),
) -> list[Extent] | None:
    """Return the box of the name of each curve, or None if a name has no clear place far from the other curves.

    curves   points of each curve, close to each other
    sizes    the width and the height of each name
    panel    the space in which the names must be
    taken    the boxes of other texts
    lines    points of other lines
    """
    found: list[Extent] = []
    for k, (own, size) in enumerate(zip(curves, sizes, strict=True)):
        others = [dot for j, dots in enumerate(curves) if j != k for dot in dots]
        tried = [
            (min(ENOUGH, _distance(box, others)), box)
            for box in _boxes(own, size)
            if is_inside(box, panel) and is_clear(box, [*own, *others, *lines], [*found, *taken])
        ]
        far, box = max(tried, key=lambda each: each[0], default=(0.0, panel))
        if far < APART:
            return None
        found.append(box)
    return found


def on_curve(
    own: Sequence[Spot], size: tuple[float, float], panel: Extent, taken: Sequence[Extent], lines: Sequence[Spot]
) -> Extent | None:
    """Return the box of a name in a gap of its curve, far from other lines, or None if no place is clear.

    own     points of the curve, close to each other
    lines   points of all other lines
    """
    wide, high = size
    every = [own[i] for i in range(0, len(own), max(1, len(own) // TRIED))]
    boxes = [(x - wide / 2, y - high / 2, x + wide / 2, y + high / 2) for x, y in every]
    # A short piece between the gap and an end of an open curve looks like a curve of its own. A gap at a turning point
    # of a closed curve hides that the curve is closed.
    is_closed = dist(own[0], own[-1]) <= 2 * STEP
    ends = [min(own), max(own)] if is_closed else [own[0], own[-1]]
    tried = [
        (min(ENOUGH, _distance(box, lines)), box)
        for box in boxes
        if is_inside(box, panel)
        and is_clear(box, lines, taken)
        and sum(is_within(x, box) for x in own) < LONGEST * len(own)
        and (is_closed or _distance(box, ends) >= STUB)
    ]
    if is_closed:
        tried = [each for each in tried if _distance(each[1], ends) >= TURN] or tried
    return max(tried, key=lambda each: each[0], default=(0.0, None))[1]


def is_within(spot: Spot, box: Extent) -> bool:
    """Return whether a point is in a box or close to it."""
    return box[0] - CLEAR < spot[0] < box[2] + CLEAR and box[1] - CLEAR < spot[1] < box[3] + CLEAR


def _boxes(own: Sequence[Spot], size: tuple[float, float]) -> list[Extent]:
    """Return boxes of a name on both sides of its curve, beginning with the boxes in the middle of the curve."""
    wide, high = size
    first, last = round(ENDS * len(own)), round((1 - ENDS) * len(own))
    every = range(max(first, 2), min(last, len(own) - 2), max(1, (last - first) // TRIED))
    found = []
    for i in sorted(every, key=lambda i: abs(2 * i - len(own))):
        (x, y), (u, v), (a, b) = own[i - 2], own[i + 2], own[i]
        length = hypot(u - x, v - y) or 1.0
        across, up = (y - v) / length, (u - x) / length
        for side in (1.0, -1.0):
            away = side * (GAP + (abs(across) * wide + abs(up) * high) / 2)
            middle = a + away * across, b + away * up
            found.append((middle[0] - wide / 2, middle[1] - high / 2, middle[0] + wide / 2, middle[1] + high / 2))
    return found


def _distance(box: Extent, dots: Sequence[Spot]) -> float:
    """Return the distance of a box from the nearest of these points; `ENOUGH` if there are no points."""
    left, below, right, above = box
    return min((hypot(max(left - x, 0.0, x - right), max(below - y, 0.0, y - above)) for x, y in dots), default=ENOUGH)


def corner_for(
    size: tuple[float, float], dots: Sequence[Spot], taken: Sequence[Extent], panel: Extent
) -> Extent | None:
    """Return a box of this size in a corner of the panel, clear of curves and other texts; None if there is no such
    box."""
    wide, high = size
    left, below, right, above = panel[0] + INNER, panel[1] + INNER, panel[2], panel[3]
    corners = [(right - wide, above - high), (left, above - high), (right - wide, below), (left, below)]
    boxes = [(x, y, x + wide, y + high) for x, y in corners]
    return next((box for box in boxes if is_inside(box, panel) and is_clear(box, dots, taken)), None)


def rows_of(widths: Sequence[float], room: float) -> list[list[int]]:
    """Return the indices of the entries of a legend, row by row; each row fits the room if possible."""
    rows: list[list[int]] = []
    used = 0.0
    for i, wide in enumerate(widths):
        if not rows or used + wide > room:
            rows.append([])
            used = 0.0
        rows[-1].append(i)
        used += wide
    return rows
