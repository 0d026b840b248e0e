"""A pulley that hangs on a string over a fixed pulley, recognised from the lines on which the particles move."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import permutations

from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, diff

from derive.algebra.tidy import tidied
from derive.figures.elements import CLEAR
from derive.figures.marks import Mark
from derive.figures.parts import BLOCK, BarMark, BlockMark, RopeMark, WheelMark
from derive.figures.positions import column_of
from derive.figures.recognition import Track, is_fixed, moving_in, same, track_of
from derive.figures.space import numeric
from derive.figures.surroundings import DistanceMark, FixedEnd
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import System

ZERO, HALF = Integer(0), Rational(1, 2)
DOWN = ImmutableDenseMatrix([0, -1])
UP = ImmutableDenseMatrix([1, 0])


class HangingPulley:
    """Three particles on two pulleys.

    One particle hangs on a string over a fixed pulley. At the other end of this string is a second pulley, and the two
    other particles hang on a string over the second pulley.

    hung   the indices of these three particles, in this order; of the two lower particles, the first is the one whose
           coordinate points down. Empty if the system is not of this kind
    """

    def __init__(self, system: System):
        self.system = system
        self.hung: tuple[int, ...] = ()
        self.tracks: dict[int, Track] = {}
        if len(system.places[0].components) != 2 or len(system.particles) != 3 or system.bodies or not system.weights:
            return
        found = {i: t for i, p in enumerate(system.particles) if (t := track_of(system, p.at)) is not None}
        self.tracks = {i: t for i, t in found.items() if t.way.components in {(ZERO, Integer(1)), (ZERO, Integer(-1))}}
        self.hung = next((three for three in permutations(self.tracks, 3) if self._hang(*three)), ())

    def _hang(self, alone: int, down: int, up: int) -> bool:
        first, second, third = (self.tracks[i] for i in (alone, down, up))
        moving = moving_in(self.system, *second.start.components)
        return (
            is_fixed(self.system, first.start)
            and second.by == third.by != first.by
            and moving == {first.by}
            and (first.way.components[1], second.way.components[1], third.way.components[1]) == (-1, -1, 1)
            and is_fixed(self.system, third.start - second.start)
            and tidied(diff(second.start.components[1], first.by)) == 1
            and not same(Location((second.start.components[0], ZERO)), Location((third.start.components[0], ZERO)))
            and tidied(self._hub(down, up).components[0] - first.start.components[0]) != 0
        )

    def _hub(self, down: int, up: int) -> Location:
        one, other = self.tracks[down].start, self.tracks[up].start
        return Location((tidied(HALF * (one.components[0] + other.components[0])), one.components[1]))

    def marks(self) -> Iterable[Mark]:
        alone, down, up = self.hung
        hub, first = self._hub(down, up), self.tracks[alone].start
        middle = tidied(HALF * (hub.components[0] + first.components[0]))
        top = Location((middle, first.components[1]))
        radii = [self._half(hub, first), self._half(self.tracks[down].start, self.tracks[up].start)]
        upper, lower = WheelMark(column_of(top), radii[0]), WheelMark(column_of(hub), radii[1])
        places = [column_of(self.system.particles[i].at) for i in self.hung]
        yield RopeMark((places[0], upper.centre, lower.centre), (ZERO, radii[0], ZERO))
        yield RopeMark((places[1], lower.centre, places[2]), (ZERO, radii[1], ZERO))
        above = column_of(top + Location((ZERO, Rational(9, 5) * radii[0])))
        yield from (upper, lower, BarMark(upper.centre, above), FixedEnd(above, DOWN))
        for i, place in zip(self.hung, places, strict=True):
            yield BlockMark(place, UP, label=self.system.particles[i].mass)
        for i, level in ((alone, top), (down, hub)):
            start = Location((self.system.particles[i].at.components[0], level.components[1]))
            aside = ImmutableDenseMatrix([1 if numeric(start.components[0] - level.components[0]) > 0 else -1, 0])
            yield DistanceMark(column_of(start), places[self.hung.index(i)], aside, CLEAR + BLOCK[0] / 2,
                               label=self.tracks[i].by)  # fmt: skip

    def _half(self, one: Location, other: Location) -> Expr:
        width = tidied(HALF * (one.components[0] - other.components[0]))
        return width if numeric(width) > 0 else -width

    @property
    def values(self) -> dict[Symbol, Expr]:
        """Return values of symbols for which all parts are drawn at distinct heights."""
        if not self.hung:
            return {}
        alone, down, up = self.hung
        upper = -self._hub(down, up).components[1].xreplace({self.tracks[alone].by: ZERO})
        lower = tidied((self.tracks[down].start - self.tracks[up].start).components[1])
        found = {self.tracks[alone].by: Rational(2, 5) * upper, self.tracks[down].by: Rational(1, 3) * lower}
        if lower.is_Symbol and upper.is_Symbol:
            found |= {lower: Rational(11, 10) * upper, self.tracks[down].by: Rational(7, 20) * upper}
        return found
