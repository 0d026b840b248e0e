"""Motion on straight lines, recognised from formulas: blocks on floors, on wedges and on strings over pulleys."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, sin

from derive.algebra.expressions import TIME
from derive.algebra.normal_form import vanishes
from derive.algebra.tidy import tidied
from derive.figures.annotations import PointMark
from derive.figures.elements import CLEAR, UNDER
from derive.figures.marks import Mark
from derive.figures.parts import (
    BLOCK,
    WHEEL,
    BarMark,
    BlockMark,
    CartMark,
    CornerRopeMark,
    ParticleMark,
    RopeMark,
    WedgeMark,
    WheelMark,
)  # fmt: skip
from derive.figures.positions import column_of
from derive.figures.recognition import (
    Link,
    Track,
    carrier_of,
    is_fixed,
    moving_in,
    ropes_of,
    same,
    strings_of,
    track_of,
)
from derive.figures.space import numeric
from derive.figures.surroundings import ROOM, AngleBetween, DistanceMark, FixedEnd, FloorMark
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import System

ZERO = Integer(0)
PAST = Rational(8, 5)  # length of an inclined plane, relative to the coordinate of the block on it


class Sliding:
    """The particles of a plane system that move on straight lines, except particles with links."""

    def __init__(self, system: System, links: Mapping[int, Link]):
        self.system, self.links = system, links
        self.small = dict.fromkeys(system.coordinates, Rational(1, 5))  # values of coordinates, to find directions
        free = [i for i in range(len(system.particles)) if i not in links]
        tracks = {i: track for i in free if (track := track_of(system, system.particles[i].at)) is not None}
        self.carriers = {i: carrier_of(system, i, track) for i, track in tracks.items()}
        self.tracks = {i: track for i, track in tracks.items() if self._is_held(track, self.carriers[i])}
        self.ropes = ropes_of({i: track for i, track in self.tracks.items() if is_fixed(system, track.start)})
        self.strings = strings_of(system, {i: t for i, t in self.tracks.items() if is_fixed(system, t.start)})
        self.moved = self._moved_apart()

    def marks(self) -> Iterable[Mark]:
        slopes = {i: track for i, track in self.tracks.items() if _is_slope(track)}
        wedges = {self.carriers[i] for i in slopes} - {None}
        for i, track in slopes.items():
            yield from self._on_wedge(i, track)
        for i, track in self.tracks.items():
            if i not in slopes:
                yield from self._on_line(i, track, i in wedges)
        for pair in (*self.ropes, *self.strings):
            yield from self._rope(*pair)

    def _is_held(self, track: Track, carrier: int | None) -> bool:
        """Return whether a line is fixed, moves with a particle, or has a prescribed motion."""
        return carrier is not None or moving_in(self.system, *track.start.components) <= {TIME}

    def _mass(self, i: int) -> Any:
        return self.system.particles[i].mass

    def _at(self, i: int) -> Location:
        """Return the position at which a particle is drawn, shifted sideways if two particles hang on one line."""
        at = self.system.particles[i].at
        return at + self.moved[i] if i in self.moved else at

    def _on_line(self, i: int, track: Track, is_wedge: bool) -> Iterable[Mark]:
        at, start = self._at(i), track.start + self.moved[i] if i in self.moved else track.start
        level = track.way.components[1] == 0
        off = CLEAR + (8 if is_wedge or level and self.system.between else 0)
        if not is_wedge:
            if not self._lies(track):
                yield from self._afloat(i, track)
                return
            carries = level and any(same(link.start, at) for link in self.links.values())
            kind = CartMark if carries else BlockMark
            block = kind(column_of(at), ImmutableDenseMatrix([1, 0]), label=self._mass(i))
            off += (block.usual[1] if level else block.usual[0]) / 2
            yield from (block, PointMark(column_of(at))) if kind is CartMark else (block,)
            if level and (self.system.weights or self.system.between):
                yield self._floor(i, track, UNDER[kind])
        if track.is_unit and self._is_measured(i):
            aside = ImmutableDenseMatrix([0, -1 if is_wedge else 1] if level else [self._free_side(i), 0])
            yield DistanceMark(column_of(start), column_of(at), aside, off, label=track.by)

    def _lies(self, track: Track) -> bool:
        """Return whether a particle is drawn as a block: if its line rises, or if the system has weights or fixed
        ends."""
        walls = [end for each in self.system.between for end in (each.start, each.end) if is_fixed(self.system, end)]
        return bool(self.system.weights or walls) or track.way.components[1] != 0

    def _afloat(self, i: int, track: Track) -> Iterable[Mark]:
        """Yield a particle on a line without a floor, and its displacement."""
        at, start = column_of(self._at(i)), column_of(track.start)
        yield ParticleMark(at, label=self._mass(i))
        if track.is_unit:
            before = [t for k, t in self.tracks.items() if k < i and same(t.start, track.start)]
            yield DistanceMark(start, at, ImmutableDenseMatrix([0, 1]), CLEAR + 10 + 16 * len(before), label=track.by)

    def _free_side(self, i: int) -> int:
        """Return the free side of a hanging particle: 1 (right) if the other particle of its string is on the left,
        else -1 (left). For a particle without a string, the bodies decide in place of the other particle."""
        other = next((k for pair in (*self.ropes, *self.strings) if i in pair for k in pair if k != i), None)
        beside = [self._at(other)] if other is not None else [placed.centre for placed in self.system.bodies]
        ways = [numeric((place - self._at(i)).components[0], self.small) for place in beside]
        return 1 if ways and max(ways) < 0 else -1

    def _is_measured(self, i: int) -> bool:
        """Return whether the coordinate is labelled at this particle.

        Two particles on a string have only one label, if possible at the particle whose coordinate is zero at the foot.
        """
        for pair in self.ropes:
            if i in pair:
                return i == next((k for k in pair if same(self.tracks[k].start, self.tracks[k].foot)), pair[0])
        return True

    def _floor(self, i: int, track: Track, off: float) -> Mark:
        """Return the floor below all particles that slide at this height; it ends at walls and pulleys."""
        alike = {k: t for k, t in self.tracks.items() if _same_height(t, track)}
        above = [self.system.particles[k].at for k in alike]
        above += [t.start for k, t in alike.items() if self._is_measured(k)]
        walls = self._walls_at(track)
        corners = [alike[k].foot for k in alike for pair in (*self.ropes, *self.strings) if k in pair]
        left, right = ROOM, ROOM
        if walls or corners:
            at = self.system.particles[i].at.components[0]
            before = [numeric(at - end.components[0], self.small) > 0 for end in walls + corners]
            short = -2 * WHEEL - 3 if corners else 0.0
            left, right = short if any(before) else ROOM, short if not all(before) else ROOM
        return FloorMark(tuple(column_of(each) for each in (*above, *walls, *corners)), off, (left, right))

    def _walls_at(self, track: Track) -> list[Location]:
        """Return the fixed ends of springs at the height of a floor; the floor ends at these points."""
        ends = [end for each in self.system.between for end in (each.start, each.end)]
        height = track.start.components[1]
        return [end for end in ends if is_fixed(self.system, end) and vanishes(end.components[1] - height)]

    def _on_wedge(self, i: int, track: Track) -> Iterable[Mark]:
        """Yield an inclined plane from zero of the coordinate to beyond the block, or down to the particle that carries
        it."""
        at, carrier = self._at(i), self.carriers[i]
        top, low = self._slope(i, track)
        foot = Location((top.components[0], low.components[1]))
        mass = self._mass(carrier) if carrier is not None else None
        both = next((pair for pair in self.ropes if i in pair and all(_is_slope(self.tracks[k]) for k in pair)), None)
        ends = [self._slope(k, self.tracks[k])[1] for k in both] if both else [low, foot]
        yield WedgeMark(tuple(column_of(each) for each in (top, *ends)), label=mass)
        yield BlockMark(column_of(at), column_of(track.way), stands=True, label=self._mass(i))
        yield FloorMark(tuple(column_of(end) for end in ends))
        slope = [f.args[0] for c in track.way.components for f in c.atoms(sin, cos)]
        if slope and slope[0].is_Symbol:
            yield AngleBetween(column_of(low), column_of(foot - low), column_of(top - low), label=slope[0])
        if track.is_unit and self._is_measured(i):
            normal = ImmutableDenseMatrix([-track.way.components[1], track.way.components[0]])
            normal = normal if numeric(normal[1], self.small) > 0 else -normal
            yield DistanceMark(column_of(track.start), column_of(at), normal, BLOCK[1] + CLEAR, label=track.by)

    def _slope(self, i: int, track: Track) -> tuple[Location, Location]:
        """Return the upper end and the lower end of the inclined plane on which a block slides."""
        carrier, far = self.carriers[i], track.start + PAST * track.by * track.way
        roped = next((pair for pair in self.ropes if i in pair), None)
        if roped is not None:
            ends = [self._past(k) for k in roped if _is_slope(self.tracks[k])]
            deepest = min(ends, key=lambda end: numeric(end.components[1], self.small))
            return track.foot, self._down_to(track.foot, self._past(i), deepest)
        rises = numeric(track.way.components[1], self.small) > 0
        top, low = (far, track.start) if rises else (track.start, far)
        return top, low if carrier is None else self._down_to(top, low, self.system.particles[carrier].at)

    def _down_to(self, top: Location, low: Location, base: Location) -> Location:
        """Return the point at the height of `base` on the line through `top` and `low`; `low` if `base` is too high."""
        fall, whole = top.components[1] - base.components[1], top.components[1] - low.components[1]
        if numeric(fall, self.small) < 1e-9:
            return low
        share: Expr = tidied(fall / whole)
        fallen: Location = share * (low - top)
        return top + fallen

    def _past(self, i: int) -> Location:
        """Return a point on the line a little beyond the block."""
        gone: Location = PAST * (self.system.particles[i].at - self.tracks[i].foot)
        return self.tracks[i].foot + gone

    def _rope(self, i: int, j: int) -> Iterable[Mark]:
        one, other = (self.tracks[k].foot + self.moved[k] if k in self.moved else self.tracks[k].foot for k in (i, j))
        a, b = column_of(self._at(i)), column_of(self._at(j))
        if same(one, other):
            lifts = tuple(BLOCK[1] / 2 if _is_slope(self.tracks[k]) else 0.0 for k in (i, j))
            yield CornerRopeMark(a, column_of(one), b, (lifts[0], lifts[1]))
            return
        middle, radius = Rational(1, 2) * (one + other), abs(tidied((other - one).components[0] / 2))
        wheel = WheelMark(column_of(middle), radius, label=radius if radius.is_Symbol and not self.moved else None)
        top = column_of(middle + Location((ZERO, Rational(9, 5) * radius)))
        yield RopeMark((a, wheel.centre, b), (ZERO, radius, ZERO))
        yield from (wheel, BarMark(wheel.centre, top), FixedEnd(top, ImmutableDenseMatrix([0, -1])))

    def _moved_apart(self) -> dict[int, Location]:
        """Return opposite sideways shifts for two particles of a string whose lines coincide, one to each side of a
        pulley."""
        found: dict[int, Location] = {}
        for i, j in self.ropes:
            one, other = self.tracks[i], self.tracks[j]
            if same(one.foot, other.foot) and vanishes(
                Add(*(a * b for a, b in zip(one.way.components, other.way.components, strict=True))) ** 2 - 1
            ):
                length = next(iter(sorted((one.start - other.start).components[1].free_symbols, key=str)), one.by)
                aside = Location((length / 6, ZERO))
                found.update({i: -aside, j: aside})
        return found

    @property
    def values(self) -> dict[Symbol, Expr]:
        """Return values of coordinates and radii for the drawing, as fractions of lengths that remain in the positions
        when all coordinates are zero."""
        found: dict[Symbol, Expr] = {}
        for q, kind in self.system.coordinates.items():
            slides = any(track.by == q and _is_slope(track) and i in self.carriers for i, track in self.tracks.items())
            lengths = [] if kind == "angle" or slides and not self.ropes else self._at_zero(q)
            if any(lengths):
                size = next(each for each in lengths if each != 0)
                size = size if all(lengths) else self._string(q, size)
                share = Rational(2, 5) if not all(lengths) else Rational(1, 4 + len(found))
                found[q] = share * size
        for i, j in self.ropes:
            radius = self._radius(i, j)
            long = (self.tracks[i].start - self.tracks[j].start).components[1].free_symbols - {radius}
            if radius.is_Symbol and long:
                found[radius] = min(long, key=str) / 5
        return found

    def _string(self, q: Symbol, size: Expr) -> Expr:
        """Return the length that the coordinate divides between two particles on a string, if this length is a multiple
        of `size`; otherwise return `size`."""
        for i, j in self.ropes:
            if self.tracks[i].by == q:
                whole = abs(tidied((self.tracks[i].start - self.tracks[j].start).components[1]))
                return whole if (whole / size).is_number and whole != 0 else size
        return size

    def _radius(self, i: int, j: int) -> Expr:
        """Return half the distance between the lines of two hanging particles, the radius of the pulley."""
        between = (self.tracks[j].foot - self.tracks[i].foot).components[0]
        return abs(tidied(between / 2))

    def _at_zero(self, q: Symbol) -> list[Expr]:
        """Return, for each component of a position with q, a symbol that remains when all coordinates and time are
        zero; zero if no symbol remains."""
        zero = dict.fromkeys((*self.system.coordinates, TIME), ZERO)
        holding = [c for place in self.system.places for c in place.components if q in c.free_symbols]
        return [min(c.xreplace(zero).free_symbols, key=str, default=ZERO) for c in holding]


def _same_height(one: Track, other: Track) -> bool:
    return all(track.way.components[1] == 0 for track in (one, other)) and vanishes(
        one.start.components[1] - other.start.components[1]
    )


def _is_slope(track: Track) -> bool:
    return all(c != 0 for c in track.way.components)
