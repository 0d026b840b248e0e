"""A drawing of a system from its formulas alone: `sketch("pendulum", System(...))`.

A particle at a constant distance from a place hangs on a rod, one that moves on a line is a block on a floor, on a
wedge or on a string, and one with a single coordinate is on the curve of its place. What is not recognised is drawn
as a particle where it is; nothing is drawn that the formulas do not say.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, pi, sin

from derive.algebra.expressions import TIME, explicit, scalar
from derive.algebra.normal_form import vanishes
from derive.algebra.tidy import tidied
from derive.figures.annotations import Axis, AxisOfRotation, PointMark
from derive.figures.elements import CLEAR, UNDER
from derive.figures.marks import Drawing, Mark, Marks
from derive.figures.parts import (
    BLOCK,
    COIL,
    WHEEL,
    BarMark,
    BlockMark,
    CartMark,
    ConnectionMark,
    CornerRopeMark,
    ParticleMark,
    RopeMark,
    SpringMark,
    WedgeMark,
    WheelMark,
)  # fmt: skip
from derive.figures.recognition import (
    Link,
    Track,
    angle_of_link,
    carrier_of,
    is_fixed,
    link_to,
    moving_in,
    ropes_of,
    same,
    track_of,
)  # fmt: skip
from derive.figures.scenes import drawing
from derive.figures.surroundings import (
    ROOM,
    AngleBetween,
    DistanceMark,
    FixedEnd,
    FloorMark,
    GravityMark,
    WayMark,
)  # fmt: skip
from derive.mechanics.systems.places import Location
from derive.mechanics.systems.system import Central, System

__all__ = ["sketch"]

ZERO = Integer(0)
PAST = Rational(8, 5)  # how far a slope goes past what slides on it, in terms of its coordinate
ECCENTRICITY = Rational(1, 2)


def sketch(key: str, system: System, *more: Marks, values: Mapping[Any, Any] | None = None) -> Drawing:
    """A drawing of a system, made of its places and forces, and put on the record of the problem.

    key      its name, for `drawings:` in the problem
    system   its particles, springs, central forces and weight
    more     further marks
    values   numbers or proportions with which letters are drawn
    """
    scene = _Scene(system)
    return drawing(key, scene.marks, *more, values={**scene.values, **(values or {})})


def _column(place: Location) -> ImmutableDenseMatrix:
    return ImmutableDenseMatrix(place.components)


class _Scene:
    """What is recognised of a system, and the marks for it."""

    def __init__(self, system: System):
        self.system = system
        self.rows = len(system.particles[0].at.components)
        indices = range(len(system.particles))
        self.links = {i: link for i in indices if (link := link_to(system, i)) is not None}
        free = [i for i in indices if i not in self.links]
        tracks = {i: track for i in free if (track := track_of(system, i)) is not None and self.rows == 2}
        self.carriers = {i: carrier_of(system, i, track) for i, track in tracks.items()}
        self.tracks = {i: track for i, track in tracks.items() if self._is_held(track, self.carriers[i])}
        self.ropes = ropes_of({i: track for i, track in self.tracks.items() if is_fixed(system, track.start)})
        self.free = [i for i in free if i not in self.tracks]
        self.moved = self._moved_apart()

    @property
    def _down(self) -> ImmutableDenseMatrix:
        return ImmutableDenseMatrix([0] * (self.rows - 1) + [-1])

    @cached_property
    def marks(self) -> list[Mark]:
        return list(dict.fromkeys(self._all()))

    def _all(self) -> Iterable[Mark]:
        for each in self.system.between:
            yield from self._between(each)
        for i, link in self.links.items():
            yield from self._linked(i, link)
        slopes = {i: track for i, track in self.tracks.items() if _is_slope(track)}
        wedges = {self.carriers[i] for i in slopes} - {None}
        for i, track in slopes.items():
            yield from self._on_wedge(i, track)
        for i, track in self.tracks.items():
            if i not in slopes:
                yield from self._on_line(i, track, i in wedges)
        for pair in self.ropes:
            yield from self._rope(*pair)
        for i in self.free:
            yield from self._free(i)
        if self.system.weights:
            yield GravityMark(self._down, label=self.system.gravity)

    def _is_held(self, track: Track, carrier: int | None) -> bool:
        """Whether its line is at rest, is carried by a particle, or moves as is prescribed."""
        return carrier is not None or moving_in(self.system, *track.start.components) <= {TIME}

    def _mass(self, i: int) -> Any:
        return self.system.particles[i].mass

    def _at(self, i: int) -> Location:
        """Where a particle is drawn: beside its place where two would hang on one line."""
        at = self.system.particles[i].at
        return at + self.moved[i] if i in self.moved else at

    def _is_particle(self, place: Location) -> bool:
        return any(same(place, particle.at) for particle in self.system.particles)

    # --- forces between two places ---

    def _between(self, each: Central) -> Iterable[Mark]:
        a, b = _column(each.start), _column(each.end)
        is_spring = diff(explicit(each.energy), each.distance, 3) == 0
        if is_spring:
            constant = tidied(diff(explicit(each.energy), each.distance, 2))
            yield SpringMark(a, b, label=constant)
        for end, way in ((each.start, b - a), (each.end, a - b)):
            if self._is_particle(end):
                continue
            if is_spring and is_fixed(self.system, end):
                turns = any(same(link.start, end) for link in self.links.values())
                yield FixedEnd(_column(end), self._down if turns else way)
            elif not is_spring:
                yield ParticleMark(_column(end))
                yield from self._orbit(each, end)
        linked = {(link.start.components, link.end.components) for link in self.links.values()}
        if not is_spring and not linked & {(p.components, q.components) for p, q in _both(each.start, each.end)}:
            yield ConnectionMark(a, b)

    def _orbit(self, each: Central, centre: Location) -> Iterable[Mark]:
        """An ellipse about the centre of a force that falls with the square of the distance."""
        other = each.end if same(each.start, centre) else each.start
        link = next((link for link in self.links.values() if same(link.end, other) and same(link.start, centre)), None)
        turned = angle_of_link(self.system, link) if link is not None and self.rows == 2 else None
        if link is None or turned is None or each.distance in tidied(each.pull * each.distance**2).free_symbols:
            return
        angle, _ = turned
        u = scalar("u")
        size = link.length * (1 + ECCENTRICITY * cos(angle)) / (1 + ECCENTRICITY * cos(u))
        e = explicit(ImmutableDenseMatrix(tuple(tidied(c / link.length) for c in link.way.components)))
        yield WayMark(_column(centre) + size * e.xreplace({angle: u}), u, -pi, pi)

    # --- what turns ---

    def _linked(self, i: int, link: Link) -> Iterable[Mark]:
        start, end, way = _column(link.start), _column(link.end), _column(link.way)
        yield ParticleMark(end, label=self._mass(i))
        turned = angle_of_link(self.system, link)
        if turned is not None:
            angle, zero = turned
            yield AngleBetween(start, _column(zero), way, True, label=angle)
        if self.rows == 3:
            yield from self._round_the_vertical(link)
        prescribed = TIME in moving_in(self.system, *link.way.components)
        around = [q for q in moving_in(self.system, *link.way.components) if self.system.coordinates.get(q) == "angle"]
        if link.is_constant and prescribed and around:
            yield WayMark(end, around[0], -pi, pi, "wire")
            yield ConnectionMark(start, end, label=link.length)
        elif link.is_constant:
            yield BarMark(start, end, label=link.length)
            if not self._is_particle(link.start):
                yield FixedEnd(start, self._down, True)
                yield from self._shaken(link.start)
        elif self._has_spring(link):
            up = ImmutableDenseMatrix([-link.way.components[1], link.way.components[0]]) if self.rows == 2 else None
            yield DistanceMark(start, end, up, COIL + CLEAR, label=link.length)
        else:
            if prescribed and link.length.is_Symbol:
                yield WayMark(end, link.length, ZERO, Rational(3, 2) * link.length, "wire")
            yield ConnectionMark(start, end, label=link.length)
            if not any(same(link.start, place) for each in self.system.between for place in (each.start, each.end)):
                yield PointMark(start)
        if not is_fixed(self.system, link.start) and self.rows == 3:
            yield from self._ways(i)

    def _has_spring(self, link: Link) -> bool:
        return any(
            diff(explicit(each.energy), each.distance, 3) == 0 and same(a, link.start) and same(b, link.end)
            for each in self.system.between
            for a, b in _both(each.start, each.end)
        )

    def _shaken(self, support: Location) -> Iterable[Mark]:
        """How far a support has moved, where it does so along one of the axes."""
        moving = moving_in(self.system, *support.components)
        rest = Location(tuple(_terms_without(c, moving) for c in support.components))
        moved = [c for c in (support - rest).components if c != 0]
        if self.rows == 2 and len(moved) == 1:
            side = [0, 1] if (support - rest).components[0] != 0 else [-1, 0]
            yield DistanceMark(_column(rest), _column(support), ImmutableDenseMatrix(side), 18.0, label=moved[0])

    def _round_the_vertical(self, link: Link) -> Iterable[Mark]:
        """The angle of what is seen from above, or the axis round which it is carried at a given rate."""
        x, y, _ = link.way.components
        angles = sorted({f.args[0] for c in (x, y) for f in c.atoms(sin, cos)}, key=str)
        start, level = _column(link.start), ImmutableDenseMatrix([x, y, 0])
        for angle in angles:
            if not vanishes(x * sin(angle) - y * cos(angle)):
                continue
            rate = diff(angle, TIME)
            if rate != 0:
                yield AxisOfRotation(start, ImmutableDenseMatrix([0, 0, 1]), rate, label=rate)
            elif moving_in(self.system, angle):
                yield ConnectionMark(start, start + level)
                yield ConnectionMark(start + level, _column(link.end))
                yield AngleBetween(start, ImmutableDenseMatrix([1, 0, 0]), level, True, label=angle)
            return

    # --- what moves on a line ---

    def _on_line(self, i: int, track: Track, is_wedge: bool) -> Iterable[Mark]:
        at, start = self._at(i), track.start + self.moved[i] if i in self.moved else track.start
        level = track.way.components[1] == 0
        off = CLEAR + (8 if is_wedge or level and self.system.between else 0)
        if not is_wedge:
            kind = CartMark if any(same(link.start, at) for link in self.links.values()) else BlockMark
            block = kind(_column(at), ImmutableDenseMatrix([1, 0]), label=self._mass(i))
            off += (block.usual[1] if level else block.usual[0]) / 2
            yield block
            if level and (self.system.weights or self.system.between):
                yield self._floor(i, track, UNDER[kind])
        if track.is_unit and self._is_measured(i):
            aside = ImmutableDenseMatrix([0, -1 if is_wedge else 1] if level else [self._free_side(i), 0])
            yield DistanceMark(_column(start), _column(at), aside, off, label=track.by)

    def _free_side(self, i: int) -> int:
        """Of what hangs: the side on which nothing hangs or lies at the other end of its string."""
        other = next((k for pair in self.ropes if i in pair for k in pair if k != i), None)
        return 1 if other is not None and self._numeric((self._at(other) - self._at(i)).components[0]) < 0 else -1

    def _is_measured(self, i: int) -> bool:
        """Of two on a string that one from whose line's foot the coordinate is counted, else the first."""
        for pair in self.ropes:
            if i in pair:
                return i == next((k for k in pair if same(self.tracks[k].start, self.tracks[k].foot)), pair[0])
        return True

    def _floor(self, i: int, track: Track, off: float) -> Mark:
        """Under all that slides at this height: up to walls and pulleys, and past everything else."""
        alike = {k: t for k, t in self.tracks.items() if _same_height(t, track)}
        above = [self.system.particles[k].at for k in alike]
        above += [t.start for k, t in alike.items() if self._is_measured(k)]
        walls = self._walls_at(track)
        corners = [alike[k].foot for k in alike for pair in self.ropes if k in pair]
        left, right = ROOM, ROOM
        if walls or corners:
            at = self.system.particles[i].at.components[0]
            before = [self._numeric(at - end.components[0]) > 0 for end in walls + corners]
            short = -2 * WHEEL - 3 if corners else 0.0
            left, right = short if any(before) else ROOM, short if not all(before) else ROOM
        return FloorMark(tuple(_column(each) for each in (*above, *walls, *corners)), off, (left, right))

    def _walls_at(self, track: Track) -> list[Location]:
        """The fixed ends of springs at the height of a floor, which it does not pass."""
        ends = [end for each in self.system.between for end in (each.start, each.end)]
        height = track.start.components[1]
        return [end for end in ends if is_fixed(self.system, end) and vanishes(end.components[1] - height)]

    def _on_wedge(self, i: int, track: Track) -> Iterable[Mark]:
        """A slope from where the coordinate is zero to a little past the block, down to what carries it."""
        at, carrier = self._at(i), self.carriers[i]
        top, low = self._slope(i, track)
        foot = Location((top.components[0], low.components[1]))
        mass = self._mass(carrier) if carrier is not None else None
        both = next((pair for pair in self.ropes if i in pair and all(_is_slope(self.tracks[k]) for k in pair)), None)
        ends = [self._slope(k, self.tracks[k])[1] for k in both] if both else [low, foot]
        yield WedgeMark(tuple(_column(each) for each in (top, *ends)), label=mass)
        yield BlockMark(_column(at), _column(track.way), stands=True, label=self._mass(i))
        yield FloorMark(tuple(_column(end) for end in ends))
        slope = [f.args[0] for c in track.way.components for f in c.atoms(sin, cos)]
        if slope and slope[0].is_Symbol:
            yield AngleBetween(_column(low), _column(foot - low), _column(top - low), label=slope[0])
        if track.is_unit and self._is_measured(i):
            normal = ImmutableDenseMatrix([-track.way.components[1], track.way.components[0]])
            normal = normal if self._numeric(normal[1]) > 0 else -normal
            yield DistanceMark(_column(track.start), _column(at), normal, BLOCK[1] + CLEAR, label=track.by)

    def _slope(self, i: int, track: Track) -> tuple[Location, Location]:
        """The upper and the lower end of the line on which a block slides."""
        carrier, far = self.carriers[i], track.start + PAST * track.by * track.way
        roped = next((pair for pair in self.ropes if i in pair), None)
        if roped is not None:
            ends = [self._past(k) for k in roped if _is_slope(self.tracks[k])]
            deepest = min(ends, key=lambda end: self._numeric(end.components[1]))
            return track.foot, self._down_to(track.foot, self._past(i), deepest)
        rises = self._numeric(track.way.components[1]) > 0
        top, low = (far, track.start) if rises else (track.start, far)
        return top, low if carrier is None else self._down_to(top, low, self.system.particles[carrier].at)

    def _down_to(self, top: Location, low: Location, base: Location) -> Location:
        """Where the line from one place to another comes to the height of a third, if that is below the first."""
        fall, whole = top.components[1] - base.components[1], top.components[1] - low.components[1]
        if self._numeric(fall) < 1e-9:
            return low
        share: Expr = tidied(fall / whole)
        return top + share * (low - top)

    def _numeric(self, value: Expr) -> float:
        """With coordinates small, and other letters 0.6: an acute angle, and any length."""
        small = {q: Rational(1, 5) for q in self.system.coordinates}
        found = value.xreplace({**dict.fromkeys(value.free_symbols, Rational(3, 5)), **small})
        return float(found.evalf())

    def _past(self, i: int) -> Location:
        """A little further down its line than a block on a string."""
        return self.tracks[i].foot + PAST * (self.system.particles[i].at - self.tracks[i].foot)

    # --- what hangs on a string ---

    def _rope(self, i: int, j: int) -> Iterable[Mark]:
        one, other = (self.tracks[k].foot + self.moved[k] if k in self.moved else self.tracks[k].foot for k in (i, j))
        a, b = _column(self._at(i)), _column(self._at(j))
        if same(one, other):
            lifts = tuple(BLOCK[1] / 2 if _is_slope(self.tracks[k]) else 0.0 for k in (i, j))
            yield CornerRopeMark(a, _column(one), b, (lifts[0], lifts[1]))
            return
        middle, radius = Rational(1, 2) * (one + other), abs(tidied((other - one).components[0] / 2))
        wheel = WheelMark(_column(middle), radius, label=radius if not self.moved else None)
        top = _column(middle + Location((ZERO, Rational(9, 5) * radius)))
        yield RopeMark((a, wheel.centre, b), (ZERO, radius, ZERO))
        yield from (wheel, BarMark(wheel.centre, top), FixedEnd(top, ImmutableDenseMatrix([0, -1])))

    def _moved_apart(self) -> dict[int, Location]:
        """Two that hang on one vertical line on both sides of a pulley are drawn beside each other."""
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

    # --- what is free ---

    def _free(self, i: int) -> Iterable[Mark]:
        at = self._at(i)
        yield ParticleMark(_column(at), label=self._mass(i))
        plain = [c for c in at.components if c in self.system.coordinates]
        if len(plain) == self.rows:
            yield from self._cartesian(at)
        else:
            yield from self._ways(i)

    def _cartesian(self, at: Location) -> Iterable[Mark]:
        for k, q in enumerate(at.components):
            ahead = Location(tuple(q if i == k else ZERO for i in range(self.rows)))
            origin, end = _column(ahead) * 0, _column(Rational(4, 3) * ahead)
            yield Axis(origin, end, label=q)
            if self.rows == 2:
                yield ConnectionMark(_column(at), _column(ahead))

    def _ways(self, i: int) -> Iterable[Mark]:
        """The curves of its place, one coordinate after the other; a thing that is there if it is the only one."""
        at = self._at(i)
        moving = [q for q in self.system.coordinates if q in moving_in(self.system, *at.components)]
        for q in moving:
            ends = (-pi, pi) if self.system.coordinates[q] == "angle" else (-PAST * q, PAST * q)
            yield WayMark(_column(at), q, *ends, "wire" if len(moving) == 1 else "trace")
        if len(moving) == 1 and moving[0] in at.components:
            beside = Location(tuple(ZERO if c == moving[0] else c for c in at.components))
            rest = Location(tuple(c.xreplace({moving[0]: ZERO}) for c in at.components))
            yield ConnectionMark(_column(beside), _column(at), label=moving[0])
            yield ConnectionMark(_column(rest), _column(beside))

    # --- what letters are drawn with ---

    @property
    def values(self) -> dict[Symbol, Expr]:
        """Small displacements where a coordinate is one, and half a string where it divides it."""
        found: dict[Symbol, Expr] = {}
        for q, kind in self.system.coordinates.items():
            slides = any(track.by == q and _is_slope(track) and i in self.carriers for i, track in self.tracks.items())
            lengths = [] if kind == "angle" or slides and not self.ropes else self._at_zero(q)
            if any(lengths):
                size = next(each for each in lengths if each != 0)
                share = Rational(2, 5) if not all(lengths) else Rational(1, 4 + len(found))
                found[q] = share * size
        for i, j in self.ropes:
            radius = self._radius(i, j)
            long = (self.tracks[i].start - self.tracks[j].start).components[1].free_symbols - {radius}
            if radius.is_Symbol and long:
                found[radius] = min(long, key=str) / 5
        return found

    def _radius(self, i: int, j: int) -> Expr:
        """Half of what is between the two lines on which masses hang."""
        between = (self.tracks[j].foot - self.tracks[i].foot).components[0]
        return abs(tidied(between / 2))

    def _at_zero(self, q: Symbol) -> list[Expr]:
        """Of each component with the coordinate in it what is left where all coordinates are zero: one letter of it."""
        zero = dict.fromkeys((*self.system.coordinates, TIME), ZERO)
        holding = [c for place in self.system.places for c in place.components if q in c.free_symbols]
        return [min(c.xreplace(zero).free_symbols, key=str, default=ZERO) for c in holding]


def _terms_without(value: Expr, letters: set[Symbol]) -> Expr:
    return Add(*(term for term in Add.make_args(value) if not term.free_symbols & letters))


def _same_height(one: Track, other: Track) -> bool:
    return all(track.way.components[1] == 0 for track in (one, other)) and vanishes(
        one.start.components[1] - other.start.components[1]
    )


def _both(a: Location, b: Location) -> tuple[tuple[Location, Location], tuple[Location, Location]]:
    return (a, b), (b, a)


def _is_slope(track: Track) -> bool:
    return all(c != 0 for c in track.way.components)
