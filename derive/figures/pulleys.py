"""Strings over pulleys of negligible radius; the pulleys are drawn inside the corners of the string."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, sqrt
from typing import Any, ClassVar

from derive.figures.marks import InWords, Surface
from derive.figures.parts import RopeMark, bend, disc
from derive.figures.pieces import Bullet, InNumbers, Paper, Piece, Stroke, Tag
from derive.figures.space import Spot, Vector, direction
from derive.figures.surroundings import STAND, hatched

ANCHOR = 6.0  # half the length of the piece of wall at a fixed end of a string, in points


@dataclass(frozen=True)
class PulleyRopeMark(RopeMark):
    """A taut string over pulleys of negligible radius at the corners of the string.

    The pulleys are drawn inside the corners, so each piece of the string has its true direction. If the string returns
    along itself, the pulley is drawn at the corner itself, between two parallel pieces.

    corners   the indices of the places with such a pulley
    tied      whether each of the two ends is fixed; a fixed end may be drawn a little aside
    """

    corners: tuple[int, ...] = ()
    tied: tuple[bool, bool] = (False, False)

    @property
    def told_as(self) -> str:
        return "pulley_rope"

    def hub(self, paper: Paper, corner: int) -> Spot:
        """Return the centre of the pulley at a corner."""
        return self.circles(paper)[corner][0]

    def circles(self, paper: Paper) -> list[tuple[Spot, float]]:
        spots = list(paper.spots(*self.places(paper.numbers)))
        radii = [paper.numbers.of(radius) * paper.scale for radius in self.radii]
        pieces = list(pairwise(spots))  # the ends of each piece; where the string returns, its pieces are shifted
        found: dict[int, tuple[Spot, float]] = {}
        for k in (k for k in self.corners if _returns(spots[k - 1], spots[k], spots[k + 1])):
            sense = _sense(spots, k)
            found[k] = spots[k], radii[k] * sense
            for i, end, sign in ((k - 1, k - 1, 1), (k, k + 1, -1)):
                if end in self.corners or (end == 0 and self.tied[0]) or (end == len(spots) - 1 and self.tied[1]):
                    pieces[i] = _shifted(pieces[i], sign * sense * radii[k], direction(spots[k - 1], spots[k]))
        for k in (k for k in range(1, len(spots) - 1) if k not in found):
            (a, b), (d, c) = pieces[k - 1], pieces[k]
            corner = b if b == d else _crossing((a, b), (d, c))
            middle = _inside(a, corner, c, radii[k]) if k in self.corners else spots[k]
            found[k] = middle, radii[k] * bend(a, corner, c)
        ends = (pieces[0][0], 0.0), (pieces[-1][1], 0.0)
        return [ends[0], *(found[k] for k in range(1, len(spots) - 1)), ends[1]]


def _sense(spots: Sequence[Spot], k: int) -> float:
    """Return the sense in which a string turns round a pulley at which it reverses its direction: 1 to the left, -1 to
    the right."""
    along = direction(spots[k - 1], spots[k])
    offs = [_off(spot, spots[k], along) for spot in reversed(spots[: k - 1])]
    before = next((off for off in offs if abs(off) > 1e-6), -1.0)
    return -1.0 if before > 0 else 1.0


def _shifted(piece: tuple[Spot, Spot], far: float, along: Spot) -> tuple[Spot, Spot]:
    (x, y), (u, v) = piece
    by = far * along[1], -far * along[0]
    return (x + by[0], y + by[1]), (u + by[0], v + by[1])


def _crossing(one: tuple[Spot, Spot], other: tuple[Spot, Spot]) -> Spot:
    """Return the intersection of two lines; if they are parallel, the end of the first."""
    along = direction(*one)
    start, end = (_off(spot, one[1], along) for spot in other)
    if abs(end - start) < 1e-6:
        return one[1]
    share = start / (start - end)
    (x, y), (u, v) = other
    return x + share * (u - x), y + share * (v - y)


def _off(spot: Spot, at: Spot, along: Spot) -> float:
    return along[0] * (spot[1] - at[1]) - along[1] * (spot[0] - at[0])


def _returns(a: Spot, b: Spot, c: Spot) -> bool:
    """Whether the path from a to c turns back at b."""
    (x, y), (u, v) = direction(a, b), direction(b, c)
    return x * u + y * v < -0.999


def _inside(a: Spot, b: Spot, c: Spot, radius: float) -> Spot:
    """Return the centre of a circle that touches both lines of the corner b from inside."""
    (x, y), (u, v) = direction(b, a), direction(b, c)
    far = hypot(x + u, y + v)
    if far < 1e-3:
        return b[0] - radius * abs(y), b[1] - radius * abs(x)
    sine = sqrt(max((1 - (x * u + y * v)) / 2, 1e-6))  # the sine of half the angle of the corner
    return b[0] + radius * (x + u) / (far * sine), b[1] + radius * (y + v) / (far * sine)


@dataclass(frozen=True)
class SmallPulleyMark(Surface):
    """A pulley of negligible radius at a corner of a string.

    string   the string
    corner   the index of the place of the pulley
    hanger   the distance of the ceiling above the place, if the pulley hangs from the ceiling
    """

    string: PulleyRopeMark
    corner: int
    hanger: Any = None
    layer: ClassVar[int] = 2

    def in_words(self) -> InWords:
        return "wheel", {"label": self.label}

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.string.along[self.corner])]

    def pieces(self, paper: Paper) -> list[Piece]:
        x, _ = hub = self.string.hub(paper, self.corner)
        radius = paper.numbers.of(self.string.radii[self.corner]) * paper.scale
        pieces = [*disc(hub, radius, "body"), Bullet(hub), Tag(self.label, hub, (-0.6, 0.8), radius)]
        if self.hanger is None:
            return pieces
        top = paper.spot(*self.places(paper.numbers))[1] + paper.numbers.of(self.hanger) * paper.scale
        return [*pieces, Stroke((hub, (x, top)), "bar"), *hatched((x - STAND, top), (x + STAND, top), (0.0, 1.0))]


@dataclass(frozen=True)
class TiedEndMark(Surface):
    """A piece of wall at a fixed end of a string over small pulleys.

    string   the string
    is_last  whether the wall is at the last end of the string; otherwise it is at the first end
    """

    string: PulleyRopeMark
    is_last: bool
    layer: ClassVar[int] = 4

    def in_words(self) -> InWords:
        return "fixed_end", {"label": self.label}

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.string.along[-1 if self.is_last else 0])]

    def pieces(self, paper: Paper) -> list[Piece]:
        stroke = self.string.pieces(paper)[0].spots
        end, before = (stroke[-1], stroke[-2]) if self.is_last else stroke[:2]
        (x, y), (u, v) = end, direction(before, end)
        return hatched((x + ANCHOR * v, y - ANCHOR * u), (x - ANCHOR * v, y + ANCHOR * u), (u, v))
