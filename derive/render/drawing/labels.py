"""Positions of the labels of a drawing: each next to the thing that it names, covering as little else as possible.

For each label, several positions around its point are tried. A position has a cost for each line point and each label
that it covers. A second, smaller cost grows with the distance from the position that the mark prefers. The position
with the lowest total cost is used. The labels are placed one after another, in several rounds. If the total cost is
still high, they are placed again in a different order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, dist, hypot, inf, pi, sin
from typing import Any, TypeAlias

from derive.figures.pieces import Bullet, Patch, Piece, Stroke, Tag
from derive.figures.space import Spot, direction, is_within

Extent: TypeAlias = tuple[float, float, float, float]  # left, below, right, above

CLEAR = 1.5  # in points: at a smaller distance, a label counts as covering a line or another label
LINE, HEAVY = 3.0, 60.0  # cost of covering a point of a line, and of covering another label
OUTSIDE = 6.0  # cost of a position outside the thing that the label names
BESIDE = 9.0  # the gap in a row, in points, below which two labels look like a product
STACKED = 4.0  # the gap in a column, in points, below which two labels look like a fraction
TOGETHER = 5.0  # cost of two labels that look like a product or a fraction
HEAVY_ENOUGH = 20.0  # if the total cost is at least this number, the labels are placed again in a different order
# For the label of a line, each point of another line that is closer to the label than NEAR, in points, costs DOUBT. All
# these points together cost at most MOST_DOUBT.
NEAR, DOUBT, MOST_DOUBT = 3.0, 0.6, 12.0
WIDE = 1.0  # in points: a wider line is represented by its two edges
OWN = 1.5  # in points; drawn points closer than this to the line that a label names belong to that line
ROUNDS = 3
INSIDE = 0.62  # the distance of a letter inside an arc from the vertex, divided by the radius
LETTER = 5.5  # in points: half the room for the letter of an angle
ALONG_ARC = (0.5, 0.36, 0.64, 0.25, 0.75, 0.12, 0.88)  # places of a letter, as fractions of its arc, the best first
AT_END = 8.0  # additional cost of a letter at an end of its arc, compared with the middle of the arc
NARROW = 12.0  # cost of a letter inside an arc that has little room


@dataclass(frozen=True)
class Placed:
    """A label with its box and the lower left corner of this box. The cost depends on what the box covers, and on its
    distance from the preferred position."""

    label: Any
    corner: Spot
    extent: Extent
    cost: float = 0.0


def placed(
    pieces: Sequence[Piece],
    measured: Callable[[Any], tuple[float, float]],
    width: Callable[[Stroke], float] = lambda stroke: 0.0,
) -> list[Placed]:
    """Return every label of the pieces with its position.

    `measured` returns the width and height of a label in points; `width` returns the width of a line.
    """
    drawn = _seen(pieces, width)
    tags = [piece for piece in pieces if isinstance(piece, Tag)]
    tried = [sorted(enumerate(_weighed(tag, measured, drawn)), key=lambda each: each[1][0]) for tag in tags]
    is_inside = [tag.on or tag.round is not None for tag in tags]
    order = sorted(range(len(tags)), key=lambda i: (not is_inside[i], tags[i].way is not None))
    costs, found = _one_by_one(order, tried, drawn)
    if sum(costs.values()) >= HEAVY_ENOUGH:  # labels probably cover something: place those with few positions first
        other = sorted(order, key=lambda i: (not is_inside[i], len(tried[i])))
        again = _one_by_one(other, tried, drawn)
        costs, found = min((costs, found), again, key=lambda each: sum(each[0].values()))
    return [Placed(tags[i].label, found[i][:2], found[i], costs[i]) for i in order]


Tries: TypeAlias = Sequence[tuple[int, tuple[float, Extent]]]  # numbered boxes with costs, cheapest first


def _one_by_one(
    order: Sequence[int], tried: Sequence[Tries], drawn: Sequence[Spot]
) -> tuple[dict[int, float], dict[int, Extent]]:
    found: dict[int, Extent] = {}
    costs: dict[int, float] = {}
    for _ in range(ROUNDS):
        before = dict(found)
        for i in order:
            costs[i], found[i] = _best(tried[i], drawn, [box for j, box in found.items() if j != i])
        if found == before:
            break
    return costs, found


def _best(tried: Tries, drawn: Sequence[Spot], others: Sequence[Extent]) -> tuple[float, Extent]:
    """Return the least total cost of a box of the label, and this box."""
    least, best = inf, (-1, (0.0, 0.0, 0.0, 0.0))
    for place, (cost, box) in tried:
        if cost > least:
            break
        whole = cost + _covered(box, drawn, others)
        if (whole, place) < (least, best[0]):
            least, best = whole, (place, box)
    return least, best[1]


def _weighed(
    tag: Tag, measured: Callable[[Any], tuple[float, float]], drawn: Sequence[Spot]
) -> Iterable[tuple[float, Extent]]:
    """Yield the boxes of a label with costs. The label of a line costs more near another line, to avoid confusion."""
    tried = _tried(tag, *measured(tag.label))
    if tag.way is None:
        yield from tried
        return
    start, end = _moved(tag.spot, tag.way, -1.0), _moved(tag.spot, tag.way, 1.0)
    others = [spot for spot in drawn if _distance(spot, start, end) > OWN]
    for cost, (left, below, right, above) in tried:
        near = sum(left - NEAR < x < right + NEAR and below - NEAR < y < above + NEAR for x, y in others)
        yield cost + min(DOUBT * near, MOST_DOUBT), (left, below, right, above)


def _distance(spot: Spot, start: Spot, end: Spot) -> float:
    x, y = end[0] - start[0], end[1] - start[1]
    return abs((spot[0] - start[0]) * y - (spot[1] - start[1]) * x) / (hypot(x, y) or 1.0)


def _tried(tag: Tag, width: float, height: float) -> Iterable[tuple[float, Extent]]:
    """Yield boxes around the point of a label; the cost grows with the distance from the preferred position."""
    if tag.round is not None:
        yield from _tried_round(tag, *tag.round, width, height)
        return
    if tag.on:
        yield from _tried_on(tag, width, height)
        return
    if tag.way is not None:
        yield from _tried_along(tag, tag.way, width, height)
        return
    base = (tag.towards[0], tag.towards[1])
    for ring, gap in enumerate((tag.gap, tag.gap + 4, tag.gap + 9, tag.gap + 15)):
        for turn in range(-8, 9):
            angle = turn * pi / 8
            x = base[0] * cos(angle) - base[1] * sin(angle)
            y = base[0] * sin(angle) + base[1] * cos(angle)
            box = _box(_moved(tag.spot, (x, y), gap + _reach((x, y), width, height)), width, height)
            yield abs(turn) * 0.8 + ring * 2.5, box


def _reach(way: Spot, width: float, height: float) -> float:
    """Return the distance from the middle of a box to its edge in a direction."""
    x, y = way
    return min(width / 2 / max(abs(x), 1e-9), height / 2 / max(abs(y), 1e-9), hypot(width, height) / 2)


def _tried_on(tag: Tag, width: float, height: float) -> Iterable[tuple[float, Extent]]:
    """Yield boxes on the thing that the label names, then boxes outside it."""
    for share in (0.0, -0.5, 0.5, -1.0, 1.0):
        yield 4.0 * abs(share), _box(_moved(tag.spot, tag.towards, share), width, height)
    (x, y), far = tag.towards, hypot(*tag.towards)
    for side in (1.0, -1.0) if far and tag.outside else ():
        away = side * (tag.outside + (abs(y) * width + abs(x) * height) / 2 / far)
        for share in (0.0, -0.5, 0.5, -1.0, 1.0):
            middle = _moved(_moved(tag.spot, tag.towards, share), (-y / far, x / far), away)
            yield OUTSIDE + 2.0 * abs(share) + (side < 0) * 2.0, _box(middle, width, height)


def _tried_round(
    tag: Tag, vertex: Spot, arc: Sequence[Spot], width: float, height: float
) -> Iterable[tuple[float, Extent]]:
    """Yield boxes between the lines of an angle inside its arc, and boxes just outside the arc."""
    radius, half = dist(vertex, arc[len(arc) // 2]), dist(arc[0], arc[-1]) / 2
    has_room = half * INSIDE >= LETTER
    for share in ALONG_ARC:
        spot = arc[round(share * (len(arc) - 1))]
        away = direction(vertex, spot)
        cost = 2.0 * AT_END * abs(share - 0.5)
        for part in (INSIDE, 0.72 * INSIDE):
            inside = cost + 0.05 * (INSIDE - part) * radius + (0.0 if has_room else NARROW)
            yield inside, _box(_moved(vertex, away, part * radius), width, height)
        for further in (0.0, -1.5, 3.0, 7.0):
            box = _box(_moved(spot, away, tag.gap + further + _reach(away, width, height)), width, height)
            yield cost + 0.6 * abs(further) + (1.0 if has_room else 0.0), box


def _tried_along(tag: Tag, way: Spot, width: float, height: float) -> Iterable[tuple[float, Extent]]:
    """Yield boxes along a line on both sides."""
    (x, y), far = tag.towards, hypot(*tag.towards) or 1.0
    normal = x / far, y / far
    away = tag.gap + (abs(normal[0]) * width + abs(normal[1]) * height) / 2
    for share in (0.0, 0.2, -0.2, 0.4, -0.4, 0.6, -0.6):
        beside = _moved(tag.spot, way, share)
        for side in (1.0, -1.0):
            for further in (0.0, 4.0, 9.0):
                cost = 6.0 * abs(share) + (side < 0) * 2.0 + 1.2 * further
                yield cost, _box(_moved(beside, normal, side * (away + further)), width, height)


def _moved(spot: Spot, way: Spot, share: float) -> Spot:
    return spot[0] + share * way[0], spot[1] + share * way[1]


def _box(middle: Spot, width: float, height: float) -> Extent:
    return middle[0] - width / 2, middle[1] - height / 2, middle[0] + width / 2, middle[1] + height / 2


def _covered(box: Extent, drawn: Sequence[Spot], others: Sequence[Extent]) -> float:
    left, below, right, above = box[0] - CLEAR, box[1] - CLEAR, box[2] + CLEAR, box[3] + CLEAR
    lines = sum(left < x < right and below < y < above for x, y in drawn)
    labels = sum(left < o[2] and o[0] < right and below < o[3] and o[1] < above for o in others)
    together = sum(_reads_as_product(box, other) or _reads_as_fraction(box, other) for other in others)
    return lines * LINE + labels * HEAVY + TOGETHER * together


def _reads_as_product(one: Extent, other: Extent) -> bool:
    """Return whether two labels are so close in one row that they read as a product."""
    common = min(one[3], other[3]) - max(one[1], other[1])
    in_a_row = common > 0.5 * min(one[3] - one[1], other[3] - other[1])
    return in_a_row and max(one[0], other[0]) - min(one[2], other[2]) < BESIDE


def _reads_as_fraction(one: Extent, other: Extent) -> bool:
    """Return whether two labels are so close above one another that they read as a fraction."""
    common = min(one[2], other[2]) - max(one[0], other[0])
    in_a_column = common > 0.5 * min(one[2] - one[0], other[2] - other[0])
    return in_a_column and max(one[1], other[1]) - min(one[3], other[3]) < STACKED


def _seen(pieces: Sequence[Piece], width: Callable[[Stroke], float]) -> list[Spot]:
    """Return the visible points of the lines and bullets."""
    found: list[Spot] = []
    for piece in pieces:
        if isinstance(piece, Patch):
            found = [spot for spot in found if not is_within(spot, piece.spots)]
        found += _dots(piece, width(piece) if isinstance(piece, Stroke) else 0.0)
    return found


def _dots(piece: Piece, width: float) -> list[Spot]:
    """Return points along a stroke, or on the edge of a bullet."""
    if isinstance(piece, Bullet):
        x, y = piece.spot
        reach = max(1, round(piece.size - 0.6))
        around = range(-reach, reach + 1)
        return [(x + i, y + j) for i in around for j in around if max(abs(i), abs(j)) == reach or reach == 1]
    if not isinstance(piece, Stroke):
        return []
    found = []
    for (x, y), (u, v) in pairwise(piece.spots):
        steps, (along, up) = max(1, round(hypot(u - x, v - y))), direction((x, y), (u, v))
        for off in (-width / 2, width / 2) if width > WIDE else (0.0,):
            found += [
                (x + (u - x) * i / steps - off * up, y + (v - y) * i / steps + off * along) for i in range(steps + 1)
            ]
    return found
