"""The parts of machines: particles, rods, ropes, springs, dashpots, blocks, carts, wheels, wedges and planks.

Particles, springs, and blocks and wheels without given lengths have a size in points, so they are readable in drawings
of any scale.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import acos, atan2, cos, hypot, pi, sin, sqrt
from typing import Any, ClassVar

from sympy import Symbol

from derive.figures.marks import BESIDE, InWords, Position, Surface
from derive.figures.pieces import Bullet, InNumbers, Paper, Patch, Piece, Stroke, Tag
from derive.figures.space import Spot, Vector, direction, midway, plus

# Lengths in points.
BOB = 4.3  # radius of a particle
WHEEL = 9.0  # radius of a pulley
BLOCK = (22.0, 18.0)  # width and height of a block
CART = (38.0, 13.0)  # width and height of a cart
CASTER = 3.6  # radius of the wheels of a cart
COIL = 4.6  # half the width of a spring
PITCH = 5.0  # usual length of a half turn of a spring
FEWEST = 4  # least number of half turns of a spring
LEAD = 7.0  # usual length of each straight end of a spring

CYLINDER = (16.0, 8.0)  # length and width of the cylinder of a dashpot
BESIDE_SPRING = 20.8  # distance of a dashpot from a spring between the same places

BEND = 6.0  # radius of a bend of a rope
TUBE, ALONG_TUBE = 3.0, 13.0  # half the width of the tube at a bend of a rope, and its length on each side of the bend
SHORT = 3  # greatest number of characters in a name that is written on a block


@dataclass(frozen=True)
class _Piecewise(Surface):
    """A part of a machine. A part without a `name` is described by the phrase `told_as`, which is by default named
    after the class: "bar" for a `BarMark`."""

    @property
    def told_as(self) -> str:
        return type(self).__name__.removesuffix("Mark").lower()

    def in_words(self) -> InWords | None:
        return super().in_words() or (self.told_as, {"label": self.label})


def beside(label: Any, start: Spot, end: Spot, gap: float = 3.0) -> Tag:
    """Return the label of a line, preferably above the line, because hanging parts and angles are below it."""
    x, y = direction(start, end)
    normal = (-y, x) if x > 1e-9 or abs(x) <= 1e-9 and y < 0 else (y, -x)
    return Tag(label, midway(start, end), normal, gap, ((end[0] - start[0]) / 2, (end[1] - start[1]) / 2))


@dataclass(frozen=True)
class _Stretched(_Piecewise):
    """A straight part from one point to another."""

    start: Position
    end: Position
    layer: ClassVar[int] = 1

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.start), numbers.vector(self.end)]

    def _beside(self, spots: tuple[Spot, ...], gap: float) -> Tag:
        return beside(self.label, spots[0], spots[1], gap)


@dataclass(frozen=True)
class BarMark(_Stretched):
    """A massless rod, which is drawn over the part to which it is fixed."""

    layer: ClassVar[int] = 3
    pen: ClassVar[str] = "bar"

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = paper.spots(*self.places(paper.numbers))
        return [Stroke(spots, self.pen), self._beside(spots, 3.0)]


@dataclass(frozen=True)
class ConnectionMark(_Stretched):
    """A dashed line between two points, such as a line of polar coordinates; its label, if any, is a length."""

    layer: ClassVar[int] = 0

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = paper.spots(*self.places(paper.numbers))
        return [Stroke(spots, "trace"), self._beside(spots, 3.0)]

    def in_words(self) -> InWords | None:
        return super().in_words() if self.label is not None else None


@dataclass(frozen=True)
class SpringMark(_Stretched):
    """A spring: a zigzag with straight ends. It is not drawn if both ends coincide.

    covered   the lengths at its two ends that blocks cover, in points
    """

    covered: tuple[float, float] = (0.0, 0.0)

    def pieces(self, paper: Paper) -> list[Piece]:
        (x, y), (u, v) = spots = paper.spots(*self.places(paper.numbers))
        far = hypot(u - x, v - y)
        if far < 1e-6:
            return []
        first, last = self.covered if far > sum(self.covered) + 2 * COIL else (0.0, 0.0)
        lead = min(LEAD, 0.2 * (far - first - last))
        step = far - first - last - 2 * lead
        turns = max(FEWEST, min(26, round(step / PITCH)))
        along = direction(*spots)
        aside = -along[1], along[0]

        def spot(way: float, off: float) -> Spot:
            return x + along[0] * way + aside[0] * off, y + along[1] * way + aside[1] * off

        begin, step = first + lead, step / turns
        peaks = [spot(begin + (i + 0.5) * step, COIL if i % 2 else -COIL) for i in range(turns)]
        line = ((x, y), spot(begin, 0), *peaks, spot(far - last - lead, 0), (u, v))
        return [Stroke(line, "spring"), self._beside((spot(first, 0), spot(far - last, 0)), COIL + 3.0)]


@dataclass(frozen=True)
class DashpotMark(_Stretched):
    """A dashpot: a piston in an open cylinder.

    beside   whether the dashpot is drawn next to a spring between the same points: above the spring, or beside a
             vertical spring
    """

    beside: bool = False

    def pieces(self, paper: Paper) -> list[Piece]:
        ends = paper.spots(*self.places(paper.numbers))
        far = hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1])
        if far < 1e-6:
            return []
        along = direction(*ends)
        off = 0.0 if not self.beside else BESIDE_SPRING if along[0] >= 0 else -BESIDE_SPRING
        half, wide = CYLINDER[0] / 2, CYLINDER[1] / 2

        def spot(way: float, aside: float = 0.0) -> Spot:
            shift = off + aside
            return ends[0][0] + along[0] * way - along[1] * shift, ends[0][1] + along[1] * way + along[0] * shift

        middle = far / 2
        left, right = middle - half, middle + half
        lines = [
            (ends[0], spot(0), spot(middle)),
            (spot(middle, -0.8 * wide), spot(middle, 0.8 * wide)),
            (spot(left, -wide), spot(right, -wide), spot(right, wide), spot(left, wide)),
            (spot(right), spot(far), ends[1]),
        ]
        tag = Tag(self.label, spot(middle, wide if off >= 0 else -wide), (0.0, 1.0), 3.0)
        return [*(Stroke(line, "edge") for line in lines), tag]


@dataclass(frozen=True)
class RopeMark(_Piecewise):
    """A taut string through points; the bend at a wheel decides on which side of the wheel the string passes.

    along   the points through which the string runs, in order
    radii   the radius of the wheel at each point: zero for no wheel, None for a wheel of the usual size
    """

    along: tuple[Position, ...]
    radii: tuple[Any, ...]
    layer: ClassVar[int] = 1
    pen: ClassVar[str] = "string"

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(place) for place in self.along]

    def pieces(self, paper: Paper) -> list[Piece]:
        return self.string(self.circles(paper))

    def circles(self, paper: Paper) -> list[tuple[Spot, float]]:
        """Return the centres and radii of the wheels, with negative radii where the string bends to the right."""
        spots = paper.spots(*self.places(paper.numbers))
        radii = [WHEEL if r is None else paper.numbers.of(r) * paper.scale for r in self.radii]
        turns = [0.0, *(bend(*three) for three in zip(spots, spots[1:], spots[2:], strict=False)), 0.0]
        return [(spot, r * turn) for spot, r, turn in zip(spots, radii, turns, strict=True)]

    def string(self, circles: Sequence[tuple[Spot, float]]) -> list[Piece]:
        lines = [_tangent(*a, *b) for a, b in pairwise(circles)]
        path = [lines[0][0]]
        for (middle, radius), before, after in zip(circles[1:], lines, [*lines[1:], None], strict=True):
            path += [before[1]] if after is None else _round(middle, radius, before[1], after[0])
        longest = max(lines, key=lambda line: hypot(line[1][0] - line[0][0], line[1][1] - line[0][1]))
        return [Stroke(tuple(path), self.pen), beside(self.label, *longest)]


@dataclass(frozen=True)
class RopeBelowMark(RopeMark):
    """A string below a table. The table hides the part of the string that is behind the table."""

    layer: ClassVar[int] = -3

    @property
    def told_as(self) -> str:
        return "rope"


@dataclass(frozen=True)
class HeavyRopeMark(RopeMark):
    """A rope with mass; its label is its mass. A smooth tube guides it round each place between its ends."""

    pen: ClassVar[str] = "rod"

    def string(self, circles: Sequence[tuple[Spot, float]]) -> list[Piece]:
        """Return the rope, with round bends, and the two walls of the tube at each bend."""
        spots = [spot for spot, _ in circles]
        path, walls = [spots[0]], []
        for a, b, c in zip(spots, spots[1:], spots[2:], strict=False):
            path += _rounded(a, b, c, BEND)
            for off in (-TUBE, TUBE):
                ends = (_beyond(b, a, off, bend(a, b, c)), _beyond(b, c, off, -bend(a, b, c)))
                corner = _shifted_corner(a, b, c, off)
                walls.append(Stroke((ends[0], *_rounded(ends[0], corner, ends[1], BEND + off), ends[1]), "edge"))
        longest = max(pairwise(spots), key=lambda line: hypot(line[1][0] - line[0][0], line[1][1] - line[0][1]))
        return [Stroke((*path, spots[-1]), self.pen), *walls, beside(self.label, *longest)]

    @property
    def told_as(self) -> str:
        return "heavy_rope"


def _rounded(a: Spot, b: Spot, c: Spot, radius: float) -> list[Spot]:
    """Return an arc that touches both lines of the corner b from inside."""
    one, other = direction(b, a), direction(b, c)
    cosine = max(-1.0, min(1.0, one[0] * other[0] + one[1] * other[1]))
    half = acos(cosine) / 2
    if not 0.05 < half < pi / 2 - 0.05 or radius <= 0:
        return [b]
    far, reach = radius / sin(half), radius * cos(half) / sin(half)
    x, y = one[0] + other[0], one[1] + other[1]
    size = hypot(x, y)
    middle = b[0] + far * x / size, b[1] + far * y / size
    ends = [(b[0] + reach * u, b[1] + reach * v) for u, v in (one, other)]
    return _round(middle, radius * bend(a, b, c), *ends)


def _beyond(corner: Spot, end: Spot, off: float, side: float) -> Spot:
    """Return the end of a wall of a tube; if `off` is positive, the wall is on the outer side of the bend."""
    x, y = direction(corner, end)
    far = min(ALONG_TUBE, 0.6 * hypot(end[0] - corner[0], end[1] - corner[1]))
    return corner[0] + far * x - side * off * y, corner[1] + far * y + side * off * x


def _shifted_corner(a: Spot, b: Spot, c: Spot, off: float) -> Spot:
    """Return the corner of a wall of a tube, at the distance `off` from both lines; if `off` is positive, the corner is
    outside the bend."""
    (x, y), (u, v) = direction(b, a), direction(b, c)
    sine = max(abs(x * v - y * u), 0.05)
    return b[0] - off * (x + u) / sine, b[1] - off * (y + v) / sine


def bend(a: Spot, b: Spot, c: Spot) -> float:
    """Return 1 if the path from a to c bends to the left at b, or -1 if it bends to the right or is straight."""
    return 1.0 if (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > 0 else -1.0


def _tangent(a: Spot, p: float, b: Spot, q: float) -> tuple[Spot, Spot]:
    """Return the tangent from the circle (a, p) to the circle (b, q).

    The centre of a circle with a positive radius is on the left of the tangent. If the circles have no such tangent,
    the result is the line between their centres.
    """
    x, y = b[0] - a[0], b[1] - a[1]
    far = hypot(x, y)
    if far <= abs(q - p) or far == 0:
        return a, b
    # The unit normal n to the left of the line has n.(b - a) = q - p.
    share = (q - p) / far
    rest = sqrt(1 - share**2)
    ex, ey = x / far, y / far
    n = ex * share - ey * rest, ey * share + ex * rest
    return (a[0] - n[0] * p, a[1] - n[1] * p), (b[0] - n[0] * q, b[1] - n[1] * q)


def _round(middle: Spot, radius: float, start: Spot, end: Spot) -> list[Spot]:
    """Return the spots of an arc from `start` to `end`, counterclockwise if the radius is positive."""
    if abs(radius) < 1e-9:
        return [start]
    first, last = (atan2(spot[1] - middle[1], spot[0] - middle[0]) for spot in (start, end))
    sense = 1.0 if radius > 0 else -1.0
    way = (sense * (last - first)) % (2 * pi)
    if way > 2 * pi - 1e-6:
        way = 0.0
    angles = [first + sense * way * i / 24 for i in range(25)]
    return [(middle[0] + abs(radius) * cos(t), middle[1] + abs(radius) * sin(t)) for t in angles]


@dataclass(frozen=True)
class CornerRopeMark(_Piecewise):
    """A taut string with a small pulley at its corner.

    lifts   the outward shifts of the two straight parts, in points, which leave room for bodies under the string
    """

    start: Position
    corner: Position
    end: Position
    lifts: tuple[float, float] = (0.0, 0.0)
    layer: ClassVar[int] = 1

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(place) for place in (self.start, self.corner, self.end)]

    def pieces(self, paper: Paper) -> list[Piece]:
        a, corner, b = paper.spots(*self.places(paper.numbers))
        ways = direction(corner, a), direction(corner, b)
        cosine = ways[0][0] * ways[1][0] + ways[0][1] * ways[1][1]
        half = acos(max(-1.0, min(1.0, cosine))) / 2
        if not 0.05 < half < pi / 2 - 0.05:
            return [Stroke((a, corner, b), "string")]
        # For each direction from the corner to an end, the unit normal that points to the side of the other end.
        inwards = [_normal(e, other) for e, other in zip(ways, ways[::-1], strict=True)]
        sine = sin(2 * half)
        shares = [(lift - WHEEL) / sine for lift in self.lifts[::-1]]
        hub = tuple(corner[k] - ways[0][k] * shares[0] - ways[1][k] * shares[1] for k in (0, 1))
        touching = [(hub[0] - n[0] * WHEEL, hub[1] - n[1] * WHEEL) for n in inwards]
        a, b = (
            (spot[0] - n[0] * lift, spot[1] - n[1] * lift)
            for spot, n, lift in zip((a, b), inwards, self.lifts, strict=True)
        )
        arc = _round((hub[0], hub[1]), WHEEL * bend(a, corner, b), *touching)
        return [Stroke((a, *arc, b), "string"), *disc((hub[0], hub[1]), WHEEL, "blank"), Bullet((hub[0], hub[1]))]

    @property
    def told_as(self) -> str:
        return "corner_rope"


def _normal(along: Spot, side: Spot) -> Spot:
    """Return the unit vector perpendicular to `along` that makes an acute angle with `side`."""
    normal = -along[1], along[0]
    return normal if normal[0] * side[0] + normal[1] * side[1] > 0 else (along[1], -along[0])


@dataclass(frozen=True)
class ParticleMark(_Piecewise):
    """A particle, a bob or a bead: a small disc, labelled with its mass and, if there is one, its charge."""

    at: Position
    charge: Any = field(default=None, metadata=BESIDE)
    layer: ClassVar[int] = 4

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.at)]

    def pieces(self, paper: Paper) -> list[Piece]:
        spot = paper.spot(*self.places(paper.numbers))
        label = self.label if self.charge is None else (self.label, ", ", self.charge)
        return [Bullet(spot, BOB, "ink"), Tag(label, spot, (0.9, -0.3), BOB + 2.5)]


@dataclass(frozen=True)
class BlockMark(_Piecewise):
    """A block on a line along which it moves.

    at              the centre of the block; if `stands` is true, the centre of its base, and the block is on the left
                    of `along`
    width, height   lengths, or None for the usual size
    """

    at: Position
    along: Position
    width: Any = None
    height: Any = None
    stands: bool = False
    layer: ClassVar[int] = 2
    usual: ClassVar[tuple[float, float]] = BLOCK

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.at)]

    def pieces(self, paper: Paper) -> list[Piece]:
        middle, corners = self._framed(paper, *self._size(paper))
        return [Patch(corners, "body"), Stroke((*corners, corners[0]), "edge"), self._named(middle, corners)]

    def _size(self, paper: Paper) -> tuple[float, float]:
        given = zip((self.width, self.height), self.usual, strict=True)
        wide, high = (usual if size is None else paper.numbers.of(size) * paper.scale for size, usual in given)
        return wide, high

    def _framed(self, paper: Paper, wide: float, high: float) -> tuple[Spot, tuple[Spot, ...]]:
        at, ahead = paper.numbers.vector(self.at), paper.numbers.vector(self.along)
        spot = paper.spot(at)
        e = first = direction(spot, paper.spot(plus(at, ahead)))
        e = e if e[0] > 1e-9 or abs(e[0]) <= 1e-9 and e[1] > 0 else (-e[0], -e[1])
        if self.stands:
            spot = spot[0] - first[1] * high / 2, spot[1] + first[0] * high / 2
        half = [(-wide / 2, -high / 2), (wide / 2, -high / 2), (wide / 2, high / 2), (-wide / 2, high / 2)]
        return spot, tuple((spot[0] + e[0] * a - e[1] * b, spot[1] + e[1] * a + e[0] * b) for a, b in half)

    def _named(self, middle: Spot, corners: tuple[Spot, ...]) -> Tag:
        if not isinstance(self.label, Symbol) or len(self.label.name.replace("_", "")) > SHORT:
            return Tag(self.label, middle, (0.0, 1.0), self.usual[1] / 2 + 3.0)
        (x, y), (u, v), (p, q), _ = corners
        outside = hypot(p - u, q - v) / 2 + 3.0
        return Tag(self.label, middle, ((u - x) * 0.3, (v - y) * 0.3), on=True, outside=outside)


@dataclass(frozen=True)
class CartMark(BlockMark):
    """A cart on two wheels; `at` is the centre of its body."""

    usual: ClassVar[tuple[float, float]] = CART

    def pieces(self, paper: Paper) -> list[Piece]:
        wide, high = self._size(paper)
        middle, corners = self._framed(paper, wide, high)
        (x, y), (u, v) = corners[:2]
        wheels: list[Piece] = []
        down = direction(corners[3], corners[0])
        for share in (0.22, 0.78):
            hub = x + (u - x) * share + CASTER * down[0], y + (v - y) * share + CASTER * down[1]
            wheels += [*disc(hub, CASTER, "blank"), Bullet(hub, 0.9)]
        return [Patch(corners, "body"), Stroke((*corners, corners[0]), "edge"), *wheels, self._named(middle, corners)]


@dataclass(frozen=True)
class WheelMark(_Piecewise):
    """A disc or hoop seen along its axis: a pulley or a rolling wheel.

    radius    a length, or None for the radius of a small pulley
    pointer   a direction that rotates with the disc, drawn as a radius
    is_ring   whether the mark is a hoop
    """

    centre: Position
    radius: Any = None
    pointer: Position = None
    is_ring: bool = False
    layer: ClassVar[int] = 2

    def places(self, numbers: InNumbers) -> list[Vector]:
        x, y, z = numbers.vector(self.centre)
        radius = numbers.of(self.radius) if self.radius is not None else 0.0
        return [(x - radius, y - radius, z), (x + radius, y + radius, z)]

    def pieces(self, paper: Paper) -> list[Piece]:
        hub = paper.spot(paper.numbers.vector(self.centre))
        radius = WHEEL if self.radius is None else paper.numbers.of(self.radius) * paper.scale
        pieces = _ring(hub, radius) if self.is_ring else disc(hub, radius, "body")
        if self.pointer is not None and not self.is_ring:
            ahead = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.pointer)))
            end = hub[0] + radius * ahead[0], hub[1] + radius * ahead[1]
            return [*pieces, Stroke((hub, end), "edge"), Bullet(hub), beside(self.label, hub, end)]
        return [*pieces, Bullet(hub), Tag(self.label, hub, (-0.6, 0.8))]


def disc(middle: Spot, radius: float, fill: str) -> list[Piece]:
    angles = [2 * pi * i / 72 for i in range(73)]
    spots = tuple((middle[0] + radius * cos(t), middle[1] + radius * sin(t)) for t in angles)
    return [Patch(spots, fill), Stroke(spots, "edge")]


def _ring(middle: Spot, radius: float) -> list[Piece]:
    return [Stroke(piece.spots, "bar") for piece in disc(middle, radius, "blank") if isinstance(piece, Stroke)]


@dataclass(frozen=True)
class WedgeMark(_Piecewise):
    """A wedge, or another solid seen from its side, given by its corners."""

    corners: tuple[Position, ...]

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(corner) for corner in self.corners]

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = paper.spots(*self.places(paper.numbers))
        # The label is not near the sharpest corner, where the angle of a slope has its label.
        sharp = min(range(len(spots)), key=lambda i: _opening(spots[i - 1], spots[i], spots[(i + 1) % len(spots)]))
        shares = [0.2 if i == sharp else 0.8 / (len(spots) - 1) for i in range(len(spots))]
        x, y = (sum(share * spot[k] for share, spot in zip(shares, spots, strict=True)) for k in (0, 1))
        return self._shown(spots, (x, y))

    def _shown(self, spots: tuple[Spot, ...], label: Spot) -> list[Piece]:
        return [Patch(spots, "body"), Stroke((*spots, spots[0]), "edge"), Tag(self.label, label, (0.0, 0.0), on=True)]


@dataclass(frozen=True)
class PlankMark(WedgeMark):
    """A plank seen from its side, given by its corners: the upper corners first, from left to right."""

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = paper.spots(*self.places(paper.numbers))
        end = midway(spots[1], spots[2])  # the label is next to the right end, because the plank may be thin
        beside = Tag(self.label, end, direction(midway(spots[0], spots[3]), end))
        return [Patch(spots, "body"), Stroke((*spots, spots[0]), "edge"), beside]


def _opening(before: Spot, corner: Spot, after: Spot) -> float:
    (x, y), (u, v) = direction(corner, before), direction(corner, after)
    return acos(max(-1.0, min(1.0, x * u + y * v)))
