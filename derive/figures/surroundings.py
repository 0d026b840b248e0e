"""Marks for the surroundings of a machine: ground, fixed ends, curves, angles, lengths, gravity and other fields."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from math import cos, hypot, pi, sin
from typing import Any, ClassVar

from derive.figures.annotations import ASIDE, letter_of_angle, measured
from derive.figures.marks import BESIDE, LAST, InWords, Mark, Position, Surface
from derive.figures.parts import BOB
from derive.figures.pieces import Bullet, InNumbers, Paper, Patch, Piece, Stroke, Tag
from derive.figures.space import NOUGHT, Spot, Vector, angle_of, direction, dot, midway, plus, size_of, unit

# Lengths in points.
HATCH = 4.0  # distance between two hatches, and depth of a hatch
STAND = 9.0  # half the length of the piece of wall at a fixed end
PEG = 2.2  # radius of the dot that is drawn instead of a fixed end and its wall
ABOVE = 0.1  # a held part is on the side of the wall if it extends there by more than this fraction of its length
UNDER = 20.0  # half the length of the piece of a surface under a particle
SLIDER, RAIL = (16.0, 9.0), 22.0  # width and height of a slider, and half the length of its rail
# Half the length of the double arrow at a moving support, and distance of this arrow from the rail.
MOVES, BESIDE_RAIL = 14.0, 12.0
ARC = (11.0, 30.0)  # least and greatest radius of an arc of the usual `share`, unless its angle is small
SMALLEST = 0.02  # smallest angle that is drawn, in radians
FREE = 16.0  # distance between all other marks and the arrow of gravity or of a field
ARROW = 24.0  # length of the arrow of gravity or of a field
ROOM = 26.0  # distance from the centre of a body on a floor to the end of the floor

STEPS = 120  # number of straight segments in a curve


def hatched(start: Spot, end: Spot, solid: Spot) -> list[Piece]:
    """Return a line with hatches on the side of the direction `solid`."""
    x, y = end[0] - start[0], end[1] - start[1]
    far = hypot(x, y)
    along = (x / far, y / far) if far > 1e-9 else (1.0, 0.0)
    count = max(1, round(far / HATCH))
    pieces: list[Piece] = [Stroke((start, end), "ground")]
    for i in range(count):
        at = start[0] + x * (i + 0.8) / count, start[1] + y * (i + 0.8) / count
        back = at[0] + HATCH * (solid[0] - 0.8 * along[0]), at[1] + HATCH * (solid[1] - 0.8 * along[1])
        pieces.append(Stroke((at, back), "hatch"))
    return pieces


@dataclass(frozen=True)
class GroundMark(Surface):
    """A floor, a ceiling or a wall: a line that is hatched on its solid side.

    solid   a direction towards the solid side
    off     the distance in points by which the line is shifted to its solid side, for a body of fixed size on paper
    """

    start: Position
    end: Position
    solid: Position
    off: float = 0.0
    layer: ClassVar[int] = -1

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.start), numbers.vector(self.end)]

    def pieces(self, paper: Paper) -> list[Piece]:
        start, end = paper.spots(*self.places(paper.numbers))
        solid = _across(start, end, paper.spot(paper.numbers.vector(self.solid)))
        a, b = ((x + solid[0] * self.off, y + solid[1] * self.off) for x, y in (start, end))
        return hatched(a, b, solid)

    def in_words(self) -> InWords:
        if self.solid[-1] == 0:
            return "wall", {}
        return ("ceiling" if self.solid[-1] == 1 else "ground"), {}


@dataclass(frozen=True)
class FloorMark(Surface):
    """Hatched level ground under some places.

    above     the places above the ground; the ground is drawn below the lowest of them
    off       the distance of the ground below the places `above`, in typographic points
    margins   the lengths by which the ground extends beyond these places to the left and to the right, in typographic
              points
    """

    above: tuple[Position, ...]
    off: float = 0.0
    margins: tuple[float, float] = (ROOM, ROOM)
    layer: ClassVar[int] = -1

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(place) for place in self.above]

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = paper.spots(*self.places(paper.numbers))
        y = min(spot[1] for spot in spots) - self.off
        left, right = (choice(spot[0] for spot in spots) for choice in (min, max))
        return hatched((left - self.margins[0], y), (right + self.margins[1], y), (0.0, -1.0))

    def in_words(self) -> InWords:
        return "ground", {}


@dataclass(frozen=True)
class OriginMark(Surface):
    """The origin of a coordinate along a horizontal line, as a short vertical stroke.

    off   the distance of the line below `at`, in points
    """

    at: Position
    off: float = 0.0

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.at)]

    def pieces(self, paper: Paper) -> list[Piece]:
        x, y = paper.spot(paper.numbers.vector(self.at))
        y -= self.off
        return [Stroke(((x, y - HATCH), (x, y + HATCH)), "ground"), Tag(self.label, (x, y + HATCH), (-0.6, 0.8), 2.0)]


def _across(start: Spot, end: Spot, side: Spot) -> Spot:
    along = direction(start, end)
    normal = -along[1], along[0]
    return normal if normal[0] * side[0] + normal[1] * side[1] >= 0 else (along[1], -along[0])


@dataclass(frozen=True)
class FixedEnd(Surface):
    """A point fixed to a piece of wall behind it.

    away    the direction away from the wall; if it is zero, no wall is drawn
    joint   whether the point is a pivot
    held    a vector along the part that is held here. If this part is on the side of the wall, a pivot has its wall on
            the other side, and any other point has no wall
    """

    at: Position
    away: Position
    joint: bool = False
    held: Position = None
    layer: ClassVar[int] = 4

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.at)]

    def pieces(self, paper: Paper) -> list[Piece]:
        x, y = spot = paper.spot(paper.numbers.vector(self.at))
        joint: list[Piece] = [Bullet(spot, 2.2), Bullet(spot, 1.3, "blank")] if self.joint else []
        if size_of(paper.numbers.vector(self.away)) < 1e-9:
            return joint
        away = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.away)))
        if self._is_below(paper, away):
            if not self.joint:
                return [Bullet(spot, PEG), Tag(self.label, spot, (-0.9, -0.4), 4.0)]
            away = -away[0], -away[1]
        start, end = ((x + s * away[1] * STAND, y - s * away[0] * STAND) for s in (-1, 1))
        return [*hatched(start, end, (-away[0], -away[1])), *joint, Tag(self.label, spot, (-away[1], away[0]), 5.0)]

    def _is_below(self, paper: Paper, away: Spot) -> bool:
        if self.held is None:
            return False
        x, y = paper.spot(paper.numbers.vector(self.held))
        return x * away[0] + y * away[1] < -ABOVE * hypot(x, y)

    def in_words(self) -> InWords:
        return "pivot" if self.joint else "fixed_end", {"label": self.label}


@dataclass(frozen=True)
class MovingEnd(Surface):
    """A support with a prescribed motion, with an arrow beside it.

    along   the direction of the motion, or one of its two directions
    side    the direction from the support to the arrow
    joint   whether the point is a pivot
    is_to_and_fro   whether the support may move in both directions, so that the arrow is a double arrow
    motion   the label of the arrow: the constant acceleration of the support; by default no label
    """

    at: Position
    along: Position
    side: Position
    joint: bool = False
    is_to_and_fro: bool = True
    motion: Any = field(default=None, metadata=BESIDE)
    layer: ClassVar[int] = 4

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.at)]

    def pieces(self, paper: Paper) -> list[Piece]:
        x, y = spot = paper.spot(paper.numbers.vector(self.at))
        u, v = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.along)))
        p, q = _across(spot, (x + u, y + v), paper.spot(paper.numbers.vector(self.side)))

        def moved(along: float, aside: float) -> Spot:
            return x + along * u + aside * p, y + along * v + aside * q

        wide, high = SLIDER
        box = tuple(moved(a * wide / 2, b * high / 2) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
        slider: list[Piece] = [
            Stroke((moved(-RAIL, 0.0), moved(RAIL, 0.0)), "ground"),
            Patch(box, "body"),
            Stroke((*box, box[0]), "edge"),
            Bullet(spot, 2.2),
            Bullet(spot, 1.3, "blank"),
        ]
        start, aside = -MOVES, BESIDE_RAIL
        if self.joint and abs(u) < 1e-6 and not self.is_to_and_fro:
            slider = [*hatched((x + STAND, y), (x - STAND, y), (0.0, 1.0)), *slider[3:]]
            start, aside = (1.0 if v > 0 else -1.0) * 2 * HATCH, 0.0
        end = start + 2 * MOVES
        return [
            *(slider if self.joint else [Stroke((moved(0.0, -STAND), moved(0.0, STAND)), "bar")]),
            Stroke((moved(start, aside), moved(end, aside)), "given", True, self.is_to_and_fro),
            Tag(self.motion, moved(end, aside), (p, q)),
            Tag(self.label, spot, (-u, -v), RAIL),
        ]

    def in_words(self) -> InWords:
        return "moving_end", {"label": self.label}


@dataclass(frozen=True)
class SurfacePiece(Surface):
    """A piece of the surface that a particle or a body touches; it has the slope of the surface.

    normal         the direction from the surface to the particle
    is_two_sided   whether the surface is a rail, which passes through the particle and has no hatches
    below          how far below `at` the surface is drawn, in points, by default the radius of a particle; a rail is
                   drawn at `at`
    half           half the length of the piece, in points
    is_fixed       whether the surface is fixed ground, with hatches
    """

    at: Position
    normal: Position
    is_two_sided: bool = False
    below: float = BOB
    half: float = UNDER
    is_fixed: bool = True
    layer: ClassVar[int] = -1

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.at)]

    def pieces(self, paper: Paper) -> list[Piece]:
        x, y = paper.spot(paper.numbers.vector(self.at))
        n = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.normal)))
        below, half = 0.0 if self.is_two_sided else self.below, self.half
        start, end = ((x - below * n[0] - s * n[1] * half, y - below * n[1] + s * n[0] * half) for s in (1, -1))
        is_plain = self.is_two_sided or not self.is_fixed
        return [Stroke((start, end), "edge")] if is_plain else hatched(start, end, (-n[0], -n[1]))

    def in_words(self) -> InWords:
        return "surface", {}


WAYS = {"wire": "wire", "edge": "drawn_curve"}  # the names of phrases for the pens other than `trace`


@dataclass(frozen=True)
class WayMark(Surface):
    """The curve of a point as one symbol varies over a range, with all other symbols fixed.

    pen   `trace` for a path, `wire` for a solid object, or `edge` for a line
    """

    place: Position
    letter: Any
    lower: Any
    upper: Any
    pen: str = "trace"
    layer: ClassVar[int] = -1

    def places(self, numbers: InNumbers) -> list[Vector]:
        return numbers.along(self.place, self.letter, (self.lower, self.upper), 12)

    def pieces(self, paper: Paper) -> list[Piece]:
        steps = 1 if self.is_straight else STEPS
        spots = paper.spots(*paper.numbers.along(self.place, self.letter, (self.lower, self.upper), steps))
        return [Stroke(spots, self.pen), Tag(self.label, spots[-1], direction(spots[-2], spots[-1]))]

    @property
    def is_straight(self) -> bool:
        return all(entry.diff(self.letter, 2) == 0 for entry in self.place)

    def in_words(self) -> InWords | None:
        return WAYS.get(self.pen, "way"), {"label": self.label}


@dataclass(frozen=True)
class CurvedGround(WayMark):
    """A curve that is hatched on its solid side.

    solid   a direction towards the solid side, the same for all points
    """

    solid: Position = field(kw_only=True)

    def pieces(self, paper: Paper) -> list[Piece]:
        def spots(steps: int) -> tuple[Spot, ...]:
            return paper.spots(*paper.numbers.along(self.place, self.letter, (self.lower, self.upper), steps))

        solid = paper.spot(paper.numbers.vector(self.solid))
        far = sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(spots(STEPS)))
        found: list[Piece] = [Stroke(spots(STEPS), "ground")]
        for a, b in pairwise(spots(max(1, round(far / HATCH)))):
            found += hatched(a, b, _across(a, b, solid))[1:]
        return found

    def in_words(self) -> InWords:
        return "ground", {}


@dataclass(frozen=True)
class AngleBetween(Mark):
    """The arc from one line to another at a vertex; its radius is usually less than the lengths of the lines.

    a, b       vectors from the vertex along the lines
    dashed     whether the first line is drawn, as a dashed line
    growing    the direction in which the end of b moves if the angle grows; if it is given, an arrowhead shows the
               positive sense
    """

    vertex: Position
    a: Position
    b: Position
    dashed: bool = False
    growing: Position = None
    layer: ClassVar[int] = 5
    share: ClassVar[float] = 0.4  # the radius of the arc, divided by the length of the lines

    @property
    def ends(self) -> tuple[Position, ...]:
        return (self.vertex,)

    @property
    def directions(self) -> tuple[Position, ...]:
        return self.a, self.b

    def pieces(self, paper: Paper) -> list[Piece]:
        vertex, a, b = (paper.numbers.vector(each) for each in (self.vertex, self.a, self.b))
        size, far = angle_of(a, b), size_of(b) * paper.scale
        if not size_of(a) or not size_of(b) or not SMALLEST < size < pi - 1e-6:
            return []
        reach = far if self.dashed else min(far, size_of(a) * paper.scale)
        # The arc of a small angle has a larger radius, so that the arc is visible.
        part, most = self.share, self.share / AngleBetween.share * ARC[1]
        points = min(max(part * reach, ARC[0]), most) if size > 0.35 else min(0.6 * reach, 1.5 * ARC[1])
        along, across = unit(a), unit(plus(b, unit(a), -dot(b, unit(a))))
        radius = points / paper.scale
        turned = [size * i / 48 for i in range(49)]
        places = (plus(plus(vertex, along, radius * cos(t)), across, radius * sin(t)) for t in turned)
        pieces: list[Piece] = []
        if self.dashed:
            end = plus(vertex, along, max(points + 7.0, min(0.65 * far, 62.0)) / paper.scale)
            pieces.append(Stroke(paper.spots(vertex, end), "trace"))
        spots = paper.spots(*places)
        onwards = plus(plus(NOUGHT, along, -sin(size)), across, cos(size))
        grows = 0.0 if self.growing is None else dot(paper.numbers.vector(self.growing), onwards)
        return [
            *pieces,
            Stroke(spots, "angle", head=grows > 0, tail=grows < 0),
            letter_of_angle(self.label, paper.spot(vertex), spots),
        ]

    def in_words(self) -> InWords | None:
        return ("angle_of_letters", {"label": self.label}) if self.label is not None else None


@dataclass(frozen=True)
class UprightAngle(AngleBetween):
    """An angle in a vertical plane. It does not affect the choice of the view, because the drawn values of the other
    angles already make this plane face the viewer. The arc is larger, because the body covers the vertex."""

    share: ClassVar[float] = 0.8

    @property
    def directions(self) -> tuple[Position, ...]:
        return ()


@dataclass(frozen=True)
class DistanceMark(Mark):
    """A dimension line between two points.

    aside      the side to which the line is shifted; by default away from the centre of the drawing
    off        the length of this shift, in points
    back       a direction in which both ends are also moved: for a block, the direction from its centre to its spring
    moved      the two lengths by which the ends are moved in this direction, in points
    on_paper   the side as a direction on the paper, in place of `aside`
    """

    start: Position
    end: Position
    aside: Position = None
    off: float = ASIDE
    back: Position = None
    moved: tuple[float, float] = (0.0, 0.0)
    on_paper: Spot | None = None

    @property
    def ends(self) -> tuple[Position, ...]:
        return self.start, self.end

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = paper.spots(*(paper.numbers.vector(end) for end in self.ends))
        if hypot(spots[1][0] - spots[0][0], spots[1][1] - spots[0][1]) < 1e-6:
            return []
        if self.on_paper is not None:
            side = self.on_paper
        elif self.aside is None:
            x, y = paper.spot(paper.middle)
            at = midway(*spots)
            side = at[0] - x, at[1] - y
        else:
            side = paper.spot(paper.numbers.vector(self.aside))
        away = _across(spots[0], spots[1], side)
        if self.back is not None:
            x, y = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.back)))
            spots = tuple((spot[0] + x * far, spot[1] + y * far) for spot, far in zip(spots, self.moved, strict=True))

        def set_off(spot: Spot, far: float) -> Spot:
            return spot[0] + away[0] * far, spot[1] + away[1] * far

        extensions = [
            Stroke((set_off(spot, max(2.4, self.off - 10.0)), set_off(spot, self.off + 3.0)), "thin") for spot in spots
        ]
        line = set_off(spots[0], self.off), set_off(spots[1], self.off)
        return [*extensions, *measured(line, self.label, away)]

    def in_words(self) -> InWords | None:
        return self._if_named("length")


@dataclass(frozen=True)
class GravityMark(Mark):
    """The downward arrow of the gravitational field, beside the other marks."""

    down: Position
    layer: ClassVar[int] = LAST

    def pieces(self, paper: Paper) -> list[Piece]:
        down = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.down)))
        right, top = max(x for x, _ in paper.drawn) + FREE, max(y for _, y in paper.drawn)
        start, end = (right, top), (right + ARROW * down[0], top + ARROW * down[1])
        return [Stroke((start, end), "given", head=True), Tag(self.label, midway(start, end), (1.0, 0.0))]

    def in_words(self) -> InWords:
        return "gravity", {"label": self.label}


@dataclass(frozen=True)
class FieldMark(Mark):
    """The arrow of a uniform field, beyond all other marks.

    before   the number of parallel field arrows above this arrow
    rises    whether a field has a vertical component, so that the arrows need room above their start
    """

    along: Position
    before: int = 0
    rises: bool = False
    layer: ClassVar[int] = LAST

    @property
    def directions(self) -> tuple[Position, ...]:
        return (self.along,)

    def pieces(self, paper: Paper) -> list[Piece]:
        along = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.along)))
        right, top = max(x for x, _ in paper.drawn) + FREE, max(y for _, y in paper.drawn)
        start = right, top - (1.5 + 2.2 * self.before + self.rises) * ARROW
        end = start[0] + ARROW * along[0], start[1] + ARROW * along[1]
        return [Stroke((start, end), "given", head=True), Tag(self.label, end, along)]

    def in_words(self) -> InWords:
        return "arrow_of_letters", {"label": self.label}
