"""Marks drawn over the bodies: lines, axes, arrows, arcs, rotation arrows, dimension lines, points and supports."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from math import acos, cos, degrees, hypot, pi, radians, sin
from typing import Any, ClassVar

from sympy import MatrixBase

from derive.algebra.expressions import Dot, Norm, explicit
from derive.algebra.tidy import factored_matrix, tidied
from derive.figures.marks import InWords, Mark, Position
from derive.figures.pieces import Bullet, InNumbers, Paper, Patch, Piece, Stroke, Tag
from derive.figures.space import (
    NOUGHT,
    Spot,
    Vector,
    across,
    angle_of,
    direction,
    dot,
    hull,
    is_within,
    midway,
    plus,
    rim,
    size_of,
    unit,
)

PIECES = 200  # number of short pieces of an axis; each is tested for a disc in front of it
PAST = 0.3  # length by which an axis extends beyond a body, relative to the size of the body
SHORTEST = 11.0  # length of the shortest dimension line that has room for its two arrowheads, in points
OUTSIDE = 13.0  # length of the two arrows outside a dimension line shorter than SHORTEST, in points
FORCE = 58.0  # length of a `ForceArrow` of size 1, in points
APPLIED = 26.0  # length of the arrow of a given force in the drawing of a system, in points
ASIDE = 12.0  # constant part of the shift of a dimension line, in points
SHORT = 3  # the components of a point are described only if together they contain at most this many operations
RING = 0.16  # radius of a rotation arrow round an axis, relative to the size of the body
DOT = 2.6  # radius of a point that is wider than a rod, in points
HOLLOW = 2.3  # radius of the circle for a point on a body, in points
NEAR_TIP = 0.72  # distance of a label from the start of its arrow, relative to the length of the arrow
EYE = 3.4  # radius of the circle that shows an axis or a vector along the line of sight, in points
# distance from a particle to the arrow of a positive direction, and half the length of this arrow, in points
POSITIVE = 26.0, 11.0
# The arrow of a positive rotation is between these polar angles, in degrees. An arrow on the right side is mirrored.
AROUND_BODY = 115, 169
ROUND = 10.0  # least radius of the arrow of a `Turn`, in points
BROKEN = 30.0  # least height of a support that is drawn with a gap, in points
STAND = 16.0  # least height of a support, in points
CLEARANCE = 8.0  # least height of a body above the ground, and distance of its rotation arrow from its rim; in points


@dataclass(frozen=True)
class _Between(Mark):
    start: Position
    end: Position

    @property
    def ends(self) -> tuple[Position, ...]:
        return self.start, self.end


@dataclass(frozen=True)
class _Single(Mark):
    at: Position

    @property
    def ends(self) -> tuple[Position, ...]:
        return (self.at,)


# --- lines -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Line(_Between):
    """A line, drawn with a pen such as `edge`, `construction` or `hidden`."""

    pen: str = "construction"

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = paper.spots(*(paper.numbers.vector(end) for end in self.ends))
        along = direction(*spots)
        (x, y), (u, v) = spots
        half = (u - x) / 2, (v - y) / 2
        return [Stroke(spots, self.pen), Tag(self.label, midway(*spots), (along[1], -along[0]), way=half)]


@dataclass(frozen=True)
class Axis(_Between):
    """A coordinate axis: a thin arrow from start to end; with a direction `past`, it continues beyond the end.

    discs   the centre, the radius and the normal vector of each flat disc through which the axis passes; the axis is
            dashed where a disc is in front of it
    """

    past: Position = None
    discs: tuple[tuple[Position, Any, Position], ...] = ()
    together: ClassVar[str | None] = "axes"

    def pieces(self, paper: Paper) -> list[Piece]:
        start, end = (paper.numbers.vector(each) for each in self.ends)
        if self.past is not None:
            end = plus(end, unit(paper.numbers.vector(self.past)), PAST * paper.reach)
        spots = paper.spots(start, end)
        if hypot(spots[1][0] - spots[0][0], spots[1][1] - spots[0][1]) < 1e-6:
            return _along_sight(self.label, spots[0], dot(plus(end, start, -1.0), paper.stance.eye) > 0)
        name = Tag(self.label, spots[1], direction(*spots))
        return [*(self._strokes(paper, start, end) if self.discs else [Stroke(spots, "axis", head=True)]), name]

    def _strokes(self, paper: Paper, start: Vector, end: Vector) -> list[Stroke]:
        way, eye = plus(end, start, -1.0), paper.stance.eye
        places = [plus(start, way, i / PIECES) for i in range(PIECES + 1)]
        hidden = [False] * PIECES
        for centre, radius, normal in self.discs:
            middle, up = paper.numbers.vector(centre), paper.numbers.vector(normal)
            outline = hull(paper.spots(*rim(middle, paper.numbers.of(radius), up)))
            for i, (one, other) in enumerate(pairwise(places)):
                from_disc = plus(plus(one, way, 0.5 / PIECES), middle, -1.0)
                is_behind = dot(from_disc, up) * dot(eye, up) < 0
                hidden[i] = hidden[i] or (is_behind and is_within(midway(*paper.spots(one, other)), outline))
        ends = [0, *(i for i in range(1, PIECES) if hidden[i] != hidden[i - 1]), PIECES]
        return [
            Stroke(paper.spots(places[i], places[j]), "hidden" if hidden[i] else "axis", head=j == PIECES)
            for i, j in pairwise(ends)
        ]


def _along_sight(label: Any, spot: Spot, comes: bool, towards: Spot = (-0.7, 0.7)) -> list[Piece]:
    """Return a circle, with a dot for a vector towards the viewer and with a cross for a vector away from the
    viewer."""
    (x, y), far = spot, EYE * 0.7
    cross = [Stroke(((x - far, y - s * far), (x + far, y + s * far)), "thin") for s in (-1, 1)]
    signs: list[Piece] = [Bullet(spot, 1.1)] if comes else [*cross]
    return [
        Bullet(spot, EYE),
        Bullet(spot, EYE - 0.6, "blank"),
        *signs,
        Tag(label, spot, towards, EYE + 2.0),
    ]


@dataclass(frozen=True)
class AxisOfRotation(Mark):
    """The axis through a point along a direction. It extends beyond the body at both ends, but its first part, up to
    the body, is left out if the body would hide it.

    With a rate, a rotation arrow surrounds the axis near its far end, and the label is next to this arrow. The arrow is
    right-handed if the rate is positive.
    """

    through: Position
    along: Position
    rate: Any = None

    def pieces(self, paper: Paper) -> list[Piece]:
        through, along = paper.numbers.vector(self.through), unit(paper.numbers.vector(self.along))
        if not size_of(along):
            return []
        places = [dot(plus(place, through, -1.0), along) for place in (*paper.fixed, through)]
        start = self._start(paper, plus(through, along, min(places)), along)
        far = max(places) + (PAST if self.rate is None else 1.9 * PAST) * paper.reach
        if self.rate is None:
            spots = paper.spots(start, plus(through, along, far))
            return [Stroke(spots, "construction"), Tag(self.label, spots[1], direction(*spots))]
        sense = 1.0 if paper.numbers.of(self.rate) > 0 else -1.0
        round_end = plus(through, along, far - 0.6 * PAST * paper.reach)
        off = self._to_clear(paper, round_end, along, RING * paper.reach)
        line = Stroke(paper.spots(start, plus(through, along, far + off)), "construction")
        ring = plus(round_end, along, off)
        return [line, *_circling(ring, plus(NOUGHT, along, sense), RING * paper.reach, self.label, paper)]

    def _start(self, paper: Paper, near: Vector, along: Vector) -> Vector:
        """Return the start of the line. The line begins at the body if the body would hide its first part, because
        the line would then seem to leave the body through a front edge."""
        start = plus(near, along, -PAST * paper.reach)
        (x, y), (u, v) = paper.spots(near, start)
        is_behind = dot(along, paper.stance.eye) > 0 and is_within(
            ((x + u) / 2, (y + v) / 2), hull(paper.spots(*paper.fixed))
        )
        return near if is_behind else start

    def _to_clear(self, paper: Paper, ring: Vector, along: Vector, radius: float) -> float:
        """Return how far the rotation arrow must move along the axis to be outside the outline of the bodies; 0 if no
        tried distance is enough."""
        outline = hull(paper.spots(*paper.fixed))
        tried = [PAST * paper.reach * step / 4 for step in range(9)]
        for off in tried:
            spots = paper.spots(*rim(plus(ring, along, off), 1.3 * radius, along))
            if not any(is_within(spot, outline) for spot in spots):
                return off
        return 0.0

    def in_words(self) -> InWords:
        names = {"label": self.label, "direction": _components(self.along)}
        return "axis_of_rotation" if self.rate is None else "turning_axis", names


def measured(line: tuple[Spot, Spot], label: Any, away: Spot, gap: float = 3.0, way: Spot | None = None) -> list[Piece]:
    """Return a dimension line with its label. If the line is too short for its arrowheads, two arrows point to its ends
    from outside."""
    (x, y), (u, v) = line
    if hypot(u - x, v - y) >= SHORTEST:
        return [Stroke(line, "measure", head=True, tail=True), Tag(label, midway(*line), away, gap, way)]
    a, b = direction(*line)
    outer = (x - OUTSIDE * a, y - OUTSIDE * b), (u + OUTSIDE * a, v + OUTSIDE * b)
    arrows = [Stroke((far, near), "measure", head=True) for far, near in zip(outer, line, strict=True)]
    return [Stroke(line, "thin"), *arrows, Tag(label, outer[1], (a, b), gap)]


@dataclass(frozen=True)
class LengthMark(_Between):
    """A dimension line between two points, shifted to one side; a length of zero is not drawn.

    aside    the direction of the shift; None for a shift to the left, or upwards if the line is horizontal
    clear    a length that is added to the shift, and is drawn to scale
    beyond   a further part of the shift, in points, to leave room for other dimension lines

    The shift is the sum of `clear`, `beyond` and the constant `ASIDE`.
    """

    aside: Position | None
    clear: Any = 0
    beyond: float = 0.0

    def pieces(self, paper: Paper) -> list[Piece]:
        start, end = (paper.numbers.vector(each) for each in self.ends)
        if size_of(plus(end, start, -1.0)) < 1e-9 * paper.reach:
            return []
        spots = paper.spots(start, end)
        away = _square_to(direction(*spots), self._away(paper))
        clear = paper.numbers.of(self.clear) * paper.scale

        def set_off(spot: Spot, far: float) -> Spot:
            return spot[0] + away[0] * (clear + far), spot[1] + away[1] * (clear + far)

        off = ASIDE + self.beyond
        extensions = [Stroke((set_off(spot, 0.2 * ASIDE), set_off(spot, off + 0.25 * ASIDE)), "thin") for spot in spots]
        line = (set_off(spots[0], off), set_off(spots[1], off))
        (x, y), (u, v) = line
        return [*extensions, *measured(line, self.label, away, way=(0.4 * (u - x), 0.4 * (v - y)))]

    def _away(self, paper: Paper) -> Spot:
        if self.aside is None:
            return -1.0, 0.0
        x, y = paper.spot(paper.numbers.vector(self.aside))
        size = hypot(x, y) or 1.0
        return x / size, y / size

    def in_words(self) -> InWords | None:
        return self._if_named("length")


def _square_to(line: Spot, away: Spot) -> Spot:
    """Return the unit vector perpendicular to a line on the paper, on the side of `away`."""
    share = away[0] * line[0] + away[1] * line[1]
    x, y = away[0] - share * line[0], away[1] - share * line[1]
    size = hypot(x, y)
    if size > 0.05:
        return x / size, y / size
    return (line[1], -line[0]) if line[1] - line[0] > 0 else (-line[1], line[0])  # upwards or to the right


# --- vectors and angles ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Arrow(Mark):
    """A vector, drawn in its true direction; a zero vector is not drawn.

    start    the point at which the arrow starts, or its tip if `pushes`
    size     the drawn length relative to the size of the body, because vectors of different kinds have no common scale
    asked    whether the problem asks for the vector; then the arrow is emphasised
    pushes   whether the tip of the arrow is at `start`
    aside    a shift to the left of the arrow, in points, so that the arrow covers no other arrow
    """

    start: Position
    value: Position
    size: Any
    asked: bool = True
    pushes: bool = False
    aside: float = 0.0

    @property
    def directions(self) -> tuple[Position, ...]:
        return (self.value,)

    def tip(self, numbers: InNumbers, reach: float) -> Vector:
        along = unit(numbers.vector(self.value))
        return plus(numbers.vector(self.start), along, 0.0 if self.pushes else numbers.of(self.size) * reach)

    def pieces(self, paper: Paper) -> list[Piece]:
        start, along = paper.numbers.vector(self.start), unit(paper.numbers.vector(self.value))
        if not size_of(along):
            return []
        far = self._length(paper)
        spots = paper.spots(start, plus(start, along, -far if self.pushes else far))
        if self.aside:
            x, y = direction(*(spots[::-1] if self.pushes else spots))
            spots = tuple((u - self.aside * y, v + self.aside * x) for u, v in spots)
        pen = "asked" if self.asked else "given"
        if hypot(spots[1][0] - spots[0][0], spots[1][1] - spots[0][1]) < 1e-6 < far:
            return _along_sight(self.label, spots[0], dot(along, paper.stance.eye) > 0, (0.7, -0.7))
        if self.pushes:
            return [Stroke(spots[::-1], pen, head=True), Tag(self.label, spots[1], direction(*spots))]
        return [Stroke(spots, pen, head=True), Tag(self.label, spots[1], direction(*spots))]

    def _length(self, paper: Paper) -> float:
        return paper.numbers.of(self.size) * paper.reach

    def in_words(self) -> InWords | None:
        names = {"label": self.label, "direction": _components(self.value)}
        if _vanishes(self.value):
            return "no_arrow", names
        return "arrow" if names["direction"] else "arrow_of_letters", names


@dataclass(frozen=True)
class ForceArrow(Arrow):
    """A force in the diagram of a single body. `size` is the length of the arrow in units of FORCE points, so the
    forces of several drawings have one scale.

    inside   whether the arrow is inside the body; the label is then beside the shaft
    """

    inside: bool = False

    def pieces(self, paper: Paper) -> list[Piece]:
        found = super().pieces(paper)
        return _labelled_beside(found) if self.inside else found

    def _length(self, paper: Paper) -> float:
        return paper.numbers.of(self.size) * FORCE / paper.scale


@dataclass(frozen=True)
class PositiveDirection(_Single):
    """A thin arrow beside a particle; it points in the direction in which a coordinate grows."""

    along: Position

    def pieces(self, paper: Paper) -> list[Piece]:
        at, along = paper.numbers.vector(self.at), unit(paper.numbers.vector(self.along))
        (x, y), ahead = paper.spots(at, plus(at, along, paper.reach))
        u, v = direction((x, y), ahead)
        off, half = POSITIVE
        across, up = _square_to((u, v), (-1.0, 0.0))
        x, y = x + off * across, y + off * up
        ends = (x - half * u, y - half * v), (x + half * u, y + half * v)
        return [Stroke(ends, "axis", head=True), Tag(self.label, ends[1], (u, v))]

    def in_words(self) -> InWords | None:
        return self._if_named("arrow", direction=_components(self.along))


@dataclass(frozen=True)
class PositiveRotation(_Single):
    """A thin curved arrow around a round body in the plane, in the sense in which the angle of the body grows.

    radius             the radius of the body
    counterclockwise   whether this sense is counterclockwise
    to_the_right       whether the arrow is on the right side of the body, used if a force is drawn on the left side
    """

    radius: Any
    counterclockwise: bool
    to_the_right: bool = False

    def pieces(self, paper: Paper) -> list[Piece]:
        x, y = paper.spot(paper.numbers.vector(self.at))
        far = paper.numbers.of(self.radius) * paper.scale + CLEARANCE
        turns = [radians(degree) for degree in range(*AROUND_BODY, 3)]
        turns = [pi - turn for turn in turns[::-1]] if self.to_the_right else turns
        spots = tuple((x + far * cos(turn), y + far * sin(turn)) for turn in turns)
        ends = spots if self.counterclockwise else spots[::-1]
        return [Stroke(ends, "axis", head=True), Tag(self.label, ends[-1], direction((x, y), ends[-1]))]

    def in_words(self) -> InWords | None:
        return self._if_named("turn")


@dataclass(frozen=True)
class AppliedForce(Arrow):
    """A given force on a part of a system: an arrow of a fixed length.

    clear   the distance from the point of application to the start of the arrow, or to its tip if it pushes, in points
    """

    clear: float = 0.0

    def pieces(self, paper: Paper) -> list[Piece]:
        start, along = paper.numbers.vector(self.start), unit(paper.numbers.vector(self.value))
        if not size_of(along):
            return []
        (x, y), ahead = paper.spots(start, plus(start, along, paper.reach))
        u, v = direction((x, y), ahead)
        x, y = x - self.aside * v, y + self.aside * u
        side = -1 if self.pushes else 1
        near, far = ((x + side * d * u, y + side * d * v) for d in (self.clear, self.clear + APPLIED))
        ends = (far, near) if self.pushes else (near, far)
        return [Stroke(ends, "given", head=True), Tag(self.label, far, (side * u, side * v))]


@dataclass(frozen=True)
class Projection(Arrow):
    """The projection of a vector on the horizontal plane through its start, and the line from its tip to this plane,
    both dashed. The arrow of the vector is a separate mark with the same `size`."""

    def pieces(self, paper: Paper) -> list[Piece]:
        start, tip = paper.numbers.vector(self.start), self.tip(paper.numbers, paper.reach)
        below = tip[0], tip[1], start[2]
        return [Stroke(paper.spots(start, below, tip), "hidden")]

    @property
    def directions(self) -> tuple[Position, ...]:
        return ()

    def in_words(self) -> None:
        return None


@dataclass(frozen=True)
class Cone(Arrow):
    """The cone that a vector describes when it turns about an axis, drawn with two dashed lines. These are the circle
    of the tip, and the line from the start of the vector to the point of this circle opposite to the tip. The arrow of
    the vector is a separate mark with the same `size`."""

    axis: Position = field(kw_only=True)

    def pieces(self, paper: Paper) -> list[Piece]:
        start, axis = paper.numbers.vector(self.start), unit(paper.numbers.vector(self.axis))
        arm = plus(self.tip(paper.numbers, paper.reach), start, -1.0)
        centre = plus(start, axis, dot(arm, axis))
        across = plus(plus(start, arm), centre, -1.0)
        circle = rim(centre, size_of(across), axis)
        opposite = plus(centre, across, -1.0)
        return [Stroke(paper.spots(*circle), "trace"), Stroke(paper.spots(start, opposite), "trace")]

    @property
    def directions(self) -> tuple[Position, ...]:
        return ()

    def in_words(self) -> InWords:
        return "way", {"label": None}


@dataclass(frozen=True)
class Weight(Arrow):
    """A weight at its point of application.

    A weight does not affect the choice of the view, because it is visible in every view that is tried. Its label may be
    anywhere next to the shaft of the arrow, because the space below the tip is often occupied.
    """

    def pieces(self, paper: Paper) -> list[Piece]:
        return _labelled_beside(super().pieces(paper))

    @property
    def directions(self) -> tuple[Position, ...]:
        return ()


def _labelled_beside(arrow: list[Piece]) -> list[Piece]:
    line = next((piece for piece in arrow if isinstance(piece, Stroke)), None)
    if line is None:
        return arrow
    (x, y), (u, v) = line.spots
    along = direction(*line.spots)
    near_tip = x + NEAR_TIP * (u - x), y + NEAR_TIP * (v - y)
    way = 0.55 * (u - x), 0.55 * (v - y)  # the label may move along the arrow
    return [
        Tag(piece.label, near_tip, (along[1], -along[0]), way=way) if isinstance(piece, Tag) else piece
        for piece in arrow
    ]


def letter_of_angle(label: Any, vertex: Spot, arc: tuple[Spot, ...]) -> Tag:
    middle = arc[len(arc) // 2]
    return Tag(label, middle, direction(vertex, middle), 2.5, round=(vertex, arc))


@dataclass(frozen=True)
class AngleMark(Mark):
    """The arc between two directions at a vertex; by default the radius is chosen so that the arc is readable.

    No arc is drawn if a direction is zero or if the directions are almost parallel or opposite.

    radius   a length
    part     the radius relative to the size of the bodies; used if `radius` is None
    """

    vertex: Position
    a: Position
    b: Position
    radius: Any = None
    part: Any = None

    @property
    def directions(self) -> tuple[Position, ...]:
        return self.a, self.b

    def pieces(self, paper: Paper) -> list[Piece]:
        vertex = paper.numbers.vector(self.vertex)
        a, b = (unit(paper.numbers.vector(each)) for each in self.directions)
        size = angle_of(a, b)
        if not size_of(a) or not size_of(b) or not 0.02 < size < pi - 0.02:
            return []
        # The arc of a small angle has a large radius, so that the arc is visible.
        comfortable = max(0.3, min(0.8, 0.3 / size)) if self.part is None else paper.numbers.of(self.part)
        radius = paper.numbers.of(self.radius) if self.radius is not None else paper.reach * comfortable
        beside = unit(plus(b, a, -dot(a, b)))
        turned = [size * i / 48 for i in range(49)]
        spots = paper.spots(*(plus(plus(vertex, a, radius * cos(t)), beside, radius * sin(t)) for t in turned))
        return [Stroke(spots, "angle"), letter_of_angle(self.label, paper.spot(vertex), spots)]

    def in_words(self) -> InWords | None:
        if self.label is None or any(_vanishes(v) for v in self.directions):
            return None
        a, b = (_whole_direction(v) for v in self.directions)
        if a is None or b is None:
            return "angle_of_letters", {"label": self.label}
        cosine = explicit(Dot(a, b)) / explicit(Norm(a) * Norm(b))
        if abs(cosine) == 1:
            return None
        return "angle", {"label": self.label, "size": f"{degrees(acos(float(cosine))):.1f}\u00b0"}


@dataclass(frozen=True)
class Turn(Mark):
    """A right-handed rotation arrow about a direction.

    size    the radius of the arrow relative to the size of the body; very small arrows are drawn larger
    middle  the direction from the centre to the middle of the arrow, by default towards the viewer
    """

    centre: Position
    along: Position
    size: Any
    middle: Position = None

    def pieces(self, paper: Paper) -> list[Piece]:
        centre, along = paper.numbers.vector(self.centre), unit(paper.numbers.vector(self.along))
        if not size_of(along):
            return []
        radius = max(paper.numbers.of(self.size) * paper.reach, ROUND / paper.scale)
        front = None if self.middle is None else paper.numbers.vector(self.middle)
        return _circling(centre, along, radius, self.label, paper, front)

    def in_words(self) -> InWords | None:
        return self._if_named("turn")


def _circling(
    centre: Vector, along: Vector, radius: float, label: Any, paper: Paper, middle: Vector | None = None
) -> list[Piece]:
    """Return most of a circle and its label; the arrowhead shows the right-handed sense about `along`."""
    u, v = across(along)
    towards = paper.stance.eye if middle is None else middle
    front = max(range(360), key=lambda degree: dot(_round(u, v, degree), towards))
    places = [plus(centre, _round(u, v, front + degree), radius) for degree in range(-125, 126, 5)]
    spots = paper.spots(*places)
    if middle is not None:
        outer = spots[len(spots) // 2]
        return [Stroke(spots, "turn", head=True), Tag(label, outer, direction(paper.spot(centre), outer))]
    outer = max(spots, key=lambda spot: (round(spot[0], 6), spot[1]))
    return [Stroke(spots, "turn", head=True), Tag(label, outer, (1.0, 0.0))]


def _round(u: Vector, v: Vector, degree: float) -> Vector:
    t = degree * pi / 180
    return plus((u[0] * cos(t), u[1] * cos(t), u[2] * cos(t)), v, sin(t))


# --- points ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class PointMark(_Single):
    """A point."""

    size: ClassVar[float] = 1.6  # radius in points

    def pieces(self, paper: Paper) -> list[Piece]:
        spot = paper.spot(paper.numbers.vector(self.at))
        return [Bullet(spot, self.size), Tag(self.label, spot, (0.7, 0.7), 4.0)]

    def in_words(self) -> InWords | None:
        """Return the description of a point, with its components unless they are long or all zero; None for a point
        without a label."""
        entries = tuple(tidied(entry) for entry in self.at)
        is_short = any(entries) and sum(entry.count_ops() for entry in entries) <= SHORT
        return self._if_named("point", place=entries if is_short else None)


@dataclass(frozen=True)
class LargePoint(PointMark):
    """A point as a dot that is wider than a rod."""

    size: ClassVar[float] = DOT


@dataclass(frozen=True)
class HollowPoint(PointMark):
    """A point drawn as a small circle, so that it is visible on a rod too."""

    def pieces(self, paper: Paper) -> list[Piece]:
        spot = paper.spot(paper.numbers.vector(self.at))
        return [Bullet(spot, HOLLOW), Bullet(spot, 0.6 * HOLLOW, "blank"), Tag(self.label, spot, (0.7, 0.7), 4.0)]


@dataclass(frozen=True)
class CentreMark(LargePoint):
    """A centre of mass that the problem asks for, so its position is drawn but not described."""

    def in_words(self) -> InWords | None:
        return self._if_named("point", place=None)


@dataclass(frozen=True)
class Support(_Single):
    """The support of a pivot: a triangle on hatched ground. The ground is lower on the paper than all bodies.

    If a body could strike the ground when it turns about the pivot, a gap in the triangle shows that the triangle is
    higher than drawn.
    """

    def pieces(self, paper: Paper) -> list[Piece]:
        pivot = paper.numbers.vector(self.at)
        x, y = spot = paper.spot(pivot)
        far = max((size_of(plus(place, pivot, -1.0)) for place in paper.fixed), default=0.0) * paper.scale
        foot = min(y - STAND, *(low - CLEARANCE for _, low in paper.spots(*paper.fixed)), y)
        is_broken = y - foot < far
        foot = min(foot, y - BROKEN) if is_broken else foot
        stand = Stroke(((x - 5, foot), (x, y), (x + 5, foot)), "edge")
        ground = Stroke(((x - 13, foot), (x + 13, foot)), "edge")
        hatches = [Stroke(((x + k, foot), (x + k - 4, foot - 4)), "thin") for k in range(-9, 14, 4)]
        gap = self._gap(x, foot + 0.3 * (y - foot)) if is_broken else []
        return [stand, *gap, ground, *hatches, Tag(self.label, spot, (-0.9, 0.4), 4.0)]

    @staticmethod
    def _gap(x: float, y: float) -> list[Piece]:
        wide, high, rise = 7.0, 2.2, 1.8
        (a, b), (c, d) = (((x - wide, y + off - rise), (x + wide, y + off + rise)) for off in (-high, high))
        return [Patch((a, b, d, c)), Stroke((a, b), "edge"), Stroke((c, d), "edge")]

    def in_words(self) -> InWords:
        return "support", {"label": self.label}


# --- descriptions in words -------------------------------------------------------------------------------------------


def _vanishes(vector: Any) -> bool:
    return all(entry == 0 for entry in explicit(vector))


def _whole_direction(vector: Any) -> MatrixBase | None:
    """Return the direction of a vector as numbers; None if the vector is zero or its direction is unknown."""
    if _vanishes(vector):
        return None
    factor, rest = factored_matrix(explicit(vector))
    if rest.free_symbols or not (factor.is_positive or factor.is_negative):
        return None
    return -rest if factor.is_negative else rest


def _components(vector: Any) -> tuple[Any, ...] | None:
    found = _whole_direction(vector)
    return None if found is None else tuple(found)
