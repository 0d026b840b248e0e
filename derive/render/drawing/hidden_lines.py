"""The outlines of solids and plane figures as strokes on paper: which edges are hidden, where a curved side ends.

Every solid is convex, so that an edge is hidden where both surfaces that meet in it face away from the eye.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product
from math import atan2, cos, hypot, pi, sin
from typing import Any

from derive.figures import marks as m
from derive.render.drawing.camera import Numbers, Spot, Stance, Vector, across, dot, plus, size_of, unit

STEPS = 96  # of a whole circle
FLAT = 0.25  # a disc that is flatter, in terms of its radius, hides too little to be dashed


@dataclass(frozen=True)
class Stroke:
    """A line on paper, drawn with one of the pens of `derive.render.drawing.canvas`, perhaps with heads at its ends."""

    spots: tuple[Spot, ...]
    pen: str
    head: bool = False
    tail: bool = False


@dataclass(frozen=True)
class Patch:
    """A surface on paper that hides what is drawn before it."""

    spots: tuple[Spot, ...]
    shade: str = "paper"


@dataclass(frozen=True)
class Bullet:
    """A point on paper."""

    spot: Spot


@dataclass(frozen=True)
class Tag:
    """A label: what it says, the spot that it belongs to, the side on which it would best stand."""

    label: Any
    spot: Spot
    towards: Spot
    gap: float = 3.0


Piece = Stroke | Patch | Bullet | Tag


@dataclass(frozen=True)
class Paper:
    """What a mark needs to be drawn: numbers, the direction one looks from, points per unit of length, the body's size
    and its middle.
    """

    numbers: Numbers
    stance: Stance
    scale: float = 1.0
    reach: float = 1.0
    middle: Vector = (0.0, 0.0, 0.0)
    fixed: tuple[Vector, ...] = field(default=(), repr=False)

    def spot(self, place: Vector) -> Spot:
        right, up = self.stance.spot(place)
        return right * self.scale, up * self.scale

    def spots(self, *places: Vector) -> tuple[Spot, ...]:
        return tuple(self.spot(place) for place in places)

    def outward(self, spot: Spot) -> Spot:
        """The direction on paper away from the middle of the body."""
        middle = self.spot(self.middle)
        return direction(middle, spot)


def direction(start: Spot, end: Spot) -> Spot:
    """The unit vector on paper from one spot to another; upwards if they coincide."""
    x, y = end[0] - start[0], end[1] - start[1]
    size = hypot(x, y)
    return (x / size, y / size) if size > 1e-9 else (0.0, 1.0)


def fixed_places(mark: m.Mark, numbers: Numbers) -> list[Vector]:
    """The points that say how large a mark is."""
    match mark:
        case m.Box():
            return list(_corners(mark, numbers).values())
        case m.ConeMark():
            return [numbers.vector(mark.apex), *_rim(mark.base, mark.apex, mark.radius, numbers)[::8]]
        case m.CylinderMark():
            rims = [_rim(a, b, mark.radius, numbers) for a, b in ((mark.start, mark.end), (mark.end, mark.start))]
            return [place for rim in rims for place in rim[::8]]
        case m.BallMark():
            centre, radius = numbers.vector(mark.centre), numbers.of(mark.radius)
            steps = [column for axis in range(3) for column in (_along(axis, radius), _along(axis, -radius))]
            return [plus(centre, step) for step in steps]
        case m.Circle():
            return _circle(numbers.vector(mark.centre), numbers.vector(mark.normal), numbers.of(mark.radius))[::8]
        case m.Polygon():
            return [numbers.vector(corner) for corner in mark.corners]
        case m.RodMark():
            return [numbers.vector(mark.start), numbers.vector(mark.end)]
    return []


def outline_of(mark: m.Mark, paper: Paper) -> list[Piece]:
    """The pieces of a solid or a plane figure, its own surface first; of any other mark none."""
    match mark:
        case m.Box():
            return _box(mark, paper)
        case m.ConeMark():
            return _cone(mark, paper)
        case m.CylinderMark():
            return _cylinder(mark, paper)
        case m.BallMark():
            rim = _circle(paper.numbers.vector(mark.centre), paper.stance.eye, paper.numbers.of(mark.radius))
            return _plane_figure(paper.spots(*rim), filled=True)
        case m.RodMark():
            ends = (paper.numbers.vector(mark.start), paper.numbers.vector(mark.end))
            return [Stroke(paper.spots(*ends), "rod")]
        case m.Circle():
            rim = _circle(
                paper.numbers.vector(mark.centre), paper.numbers.vector(mark.normal), paper.numbers.of(mark.radius)
            )
            return _plane_figure(paper.spots(*rim), mark.filled)
        case m.Polygon():
            corners = [paper.numbers.vector(corner) for corner in mark.corners]
            return _plane_figure(paper.spots(*corners, corners[0]), filled=True)
    return []


def _along(axis: int, size: float) -> Vector:
    x, y, z = (size if axis == k else 0.0 for k in range(3))
    return x, y, z


def _plane_figure(spots: tuple[Spot, ...], filled: bool) -> list[Piece]:
    return [*([Patch(spots, "body")] if filled else []), Stroke(spots, "edge")]


# --- blocks ----------------------------------------------------------------------------------------------------------


def _corners(box: m.Box, numbers: Numbers) -> dict[tuple[int, ...], Vector]:
    start = numbers.vector(box.corner)
    x, y, z = (numbers.of(side) for side in box.sides)
    return {ends: plus(start, (ends[0] * x, ends[1] * y, ends[2] * z)) for ends in product((0, 1), repeat=3)}


def _box(box: m.Box, paper: Paper) -> list[Piece]:
    """Twelve edges: an edge along one axis lies between two faces, each seen if its normal points to the eye."""
    corners, eye = _corners(box, paper.numbers), paper.stance.eye
    pieces: list[Piece] = [Patch(hull(paper.spots(*corners.values())))]
    hidden: list[Piece] = []
    seen: list[Piece] = []
    for axis in range(3):
        outer: list[tuple[Spot, Spot]] = []
        others = [k for k in range(3) if k != axis]
        for ends in product((0, 1), repeat=2):
            lower, upper = ([0, 0, 0], [0, 0, 0])
            lower[axis], upper[axis] = 0, 1
            for k, end in zip(others, ends, strict=True):
                lower[k] = upper[k] = end
            facing = [eye[k] * (1 if end else -1) > 1e-9 for k, end in zip(others, ends, strict=True)]
            line = paper.spots(corners[tuple(lower)], corners[tuple(upper)])
            (seen if any(facing) else hidden).append(Stroke(line, "edge" if any(facing) else "hidden"))
            if any(facing) and not all(facing):
                outer.append((line[0], line[1]))
        if box.edges and outer:
            pieces.append(_edge_tag(box.edges[axis], outer, paper))
    return [pieces[0], *hidden, *seen, *pieces[1:]]


def _edge_tag(label: Any, edges: Sequence[tuple[Spot, Spot]], paper: Paper) -> Tag:
    """Beside the lowest of the outer edges of one direction."""
    middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in edges]
    spot = min(middles, key=lambda at: (round(at[1], 6), at[0]))
    return Tag(label, spot, paper.outward(spot))


# --- round solids ----------------------------------------------------------------------------------------------------


def _circle(centre: Vector, normal: Vector, radius: float) -> list[Vector]:
    u, v = across(normal)
    angles = [2 * pi * i / STEPS for i in range(STEPS + 1)]
    return [plus(plus(centre, u, radius * cos(t)), v, radius * sin(t)) for t in angles]


def _rim(centre: Any, other: Any, radius: Any, numbers: Numbers) -> list[Vector]:
    """The circle about one end of a solid of revolution, whose other end gives the axis."""
    c, d = numbers.vector(centre), numbers.vector(other)
    return _circle(c, plus(d, c, -1.0), numbers.of(radius))


def _cone(cone: m.ConeMark, paper: Paper) -> list[Piece]:
    apex, base, radius = (
        paper.numbers.vector(cone.apex),
        paper.numbers.vector(cone.base),
        paper.numbers.of(cone.radius),
    )
    height = size_of(plus(apex, base, -1.0))
    to_apex = unit(plus(apex, base, -1.0))
    rim = _rim(cone.base, cone.apex, cone.radius, paper.numbers)

    def side_faces(place: Vector) -> float:
        """The outward normal of the side at a point of the rim, along the direction to the eye."""
        outward = unit(plus(place, base, -1.0))
        normal = plus((outward[0] * height, outward[1] * height, outward[2] * height), to_apex, radius)
        return dot(normal, paper.stance.eye)

    base_faces = -dot(to_apex, paper.stance.eye) > 0
    pieces: list[Piece] = [Patch(hull(paper.spots(apex, *rim)), "body")]
    pieces += _drawn_rim(rim, lambda place: base_faces or side_faces(place) >= 0, paper)
    ends = _changes(rim, side_faces)
    pieces += [Stroke(paper.spots(apex, place), "edge") for place in ends]
    return pieces


def _cylinder(cylinder: m.CylinderMark, paper: Paper) -> list[Piece]:
    start, end = paper.numbers.vector(cylinder.start), paper.numbers.vector(cylinder.end)
    axis = unit(plus(end, start, -1.0))
    lower = _circle(start, axis, paper.numbers.of(cylinder.radius))
    upper = [plus(place, plus(end, start, -1.0)) for place in lower]
    eye = paper.stance.eye
    flat = size_of(plus(end, start, -1.0)) < FLAT * paper.numbers.of(cylinder.radius)

    def side_faces(place: Vector) -> float:
        return dot(plus(place, start, -1.0), eye)

    pieces: list[Piece] = [Patch(hull(paper.spots(*lower, *upper)), "body")]
    for rim, centre, outward in ((lower, start, -1.0), (upper, end, 1.0)):
        is_seen = _end_or_side(centre, outward * dot(axis, eye) > 0, eye)
        pieces += [s for s in _drawn_rim(rim, is_seen, paper) if s.pen != "hidden" or not flat]
    along = plus(end, start, -1.0)
    pieces += [Stroke(paper.spots(place, plus(place, along)), "edge") for place in _changes(lower, side_faces)]
    return pieces


def _end_or_side(centre: Vector, end_faces: bool, eye: Vector) -> Callable[[Vector], bool]:
    """Whether a point of a cylinder's rim is seen: with the end that it bounds, or with the side."""
    return lambda place: end_faces or dot(plus(place, centre, -1.0), eye) >= 0


def _drawn_rim(rim: Sequence[Vector], is_seen: Callable[[Vector], bool], paper: Paper) -> list[Stroke]:
    """A closed curve as strokes, dashed where it is hidden; hidden ones first."""
    flags = [is_seen(place) for place in rim]
    strokes: list[Stroke] = []
    begin = 0
    for i in range(1, len(rim)):
        if flags[i] != flags[begin] or i == len(rim) - 1:
            strokes.append(Stroke(paper.spots(*rim[begin : i + 1]), "edge" if flags[begin] else "hidden"))
            begin = i
    return sorted(strokes, key=lambda stroke: stroke.pen != "hidden")


def _changes(rim: Sequence[Vector], facing: Callable[[Vector], float]) -> list[Vector]:
    """Where a curved side turns away from the eye: between two points of the rim, in proportion."""
    found = []
    for a, b in pairwise(rim):
        at, after = facing(a), facing(b)
        if (at >= 0) != (after >= 0):
            share = at / (at - after)
            found.append(plus(a, plus(b, a, -1.0), share))
    return found


def hull(spots: Sequence[Spot]) -> tuple[Spot, ...]:
    """The convex outline of spots, anticlockwise: sorted by angle about the lowest, turns to the right dropped."""
    first = min(spots, key=lambda s: (s[1], s[0]))
    rest = sorted(
        {s for s in spots if s != first},
        key=lambda s: (atan2(s[1] - first[1], s[0] - first[0]), hypot(s[0] - first[0], s[1] - first[1])),
    )
    outline = [first]
    for spot in rest:
        while len(outline) > 1 and _turns_right(outline[-2], outline[-1], spot):
            outline.pop()
        outline.append(spot)
    return tuple(outline)


def _turns_right(a: Spot, b: Spot, c: Spot) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 1e-12
