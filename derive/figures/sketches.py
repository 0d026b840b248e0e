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
from derive.figures.annotations import Axis, AxisOfRotation
from derive.figures.elements import CLEAR, UNDER
from derive.figures.marks import Drawing, Mark, Marks
from derive.figures.parts import (
    BLOCK, BarMark, BlockMark, CartMark, ConnectionMark, CornerRopeMark, ParticleMark, RopeMark, SpringMark, WedgeMark,
    WheelMark,
)  # fmt: skip
from derive.figures.recognition import (
    Link, Track, angle_of_link, carrier_of, is_fixed, link_to, moving_in, ropes_of, same, track_of,
)  # fmt: skip
from derive.figures.scenes import drawing
from derive.figures.surroundings import (
    AngleBetween, DistanceMark, FixedEnd, FloorMark, GravityMark, WayMark,
)  # fmt: skip
from derive.mechanics.systems.places import Location
from derive.mechanics.systems.system import Central, System

__all__ = ["sketch"]

ZERO, ONE = Integer(0), Integer(1)
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
        self.tracks = {i: track for i in free if (track := track_of(system, i)) is not None and self.rows == 2}
        self.carriers = {i: carrier_of(system, i, track) for i, track in self.tracks.items()}
        self.ropes = ropes_of({i: track for i, track in self.tracks.items() if is_fixed(system, track.start)})
        self.free = [i for i in free if i not in self.tracks]
        self.moved = self._moved_apart()

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
            down = ImmutableDenseMatrix([0] * (self.rows - 1) + [-1])
            yield GravityMark(down, label=self.system.gravity)

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
                yield FixedEnd(_column(end), way)
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
        angle, zero = turned
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
                yield FixedEnd(start, ImmutableDenseMatrix([0] * (self.rows - 1) + [-1]), True)
        else:
            if prescribed and link.length.is_Symbol:
                yield WayMark(end, link.length, ZERO, Rational(3, 2) * link.length, "wire")
            yield ConnectionMark(start, end, label=link.length)
        if not is_fixed(self.system, link.start) and self.rows == 3:
            yield from self._ways(i)

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
        off = CLEAR
        block: BlockMark | None = None
        if not is_wedge:
            kind = CartMark if any(same(link.start, at) for link in self.links.values()) else BlockMark
            block = kind(_column(at), ImmutableDenseMatrix([1, 0]), label=self._mass(i))
            off += (block.usual[1] if level else block.usual[0]) / 2
            yield block
        if level and (self.system.weights or self.system.between):
            under = UNDER[type(block)] if block is not None else 0.0
            alike = [t.start + t.by * t.way for t in self.tracks.values() if same_height(t, track)]
            yield FloorMark(tuple(_column(each) for each in (*alike, *self._ends_at(track))), under)
        if track.is_unit and i not in self._second_of_ropes:
            aside = ImmutableDenseMatrix([0, -1 if is_wedge else 1] if level else [-1, 0])
            yield DistanceMark(_column(self._origin_of(i, start)), _column(at), aside, off + 6 * is_wedge, label=track.by)

    @property
    def _second_of_ropes(self) -> set[int]:
        return {j for _, j in self.ropes}

    def _origin_of(self, i: int, start: Location) -> Location:
        return start

    def _ends_at(self, track: Track) -> list[Location]:
        """The fixed ends of springs at the height of a floor, to which it reaches."""
        ends = [end for each in self.system.between for end in (each.start, each.end)]
        height = track.start.components[1]
        return [end for end in ends if is_fixed(self.system, end) and vanishes(end.components[1] - height)]

    def _on_wedge(self, i: int, track: Track) -> Iterable[Mark]:
        """A slope from where the coordinate is zero to a little past the block, down to the height of what carries it."""
        at, way, carrier = self._at(i), _column(track.way), self.carriers[i]
        roped = any(i in pair for pair in self.ropes)
        far = track.start + PAST * track.by * track.way
        top, low = (track.foot, track.foot + PAST * (at - track.foot)) if roped else (track.start, far)
        if _rises(track) and not roped:
            top, low = low, top
        if carrier is not None:
            low = _down_to(top, low, self.system.particles[carrier].at) or low
        foot = Location((top.components[0], low.components[1]))
        yield WedgeMark((_column(top), _column(low), _column(foot)), label=self._mass(carrier) if carrier is not None else None)
        yield BlockMark(_column(at), way, stands=True, label=self._mass(i))
        if carrier is None:
            yield FloorMark((_column(low), _column(foot)))
        slope = [f.args[0] for c in track.way.components for f in c.atoms(sin, cos)]
        if slope and slope[0].is_Symbol:
            yield AngleBetween(_column(low), _column(foot - low), _column(top - low), label=slope[0])
        if track.is_unit and i not in self._second_of_ropes:
            normal = ImmutableDenseMatrix([-track.way.components[1], track.way.components[0]])
            normal = normal if _numeric(normal[1]) > 0 else -normal
            yield DistanceMark(_column(track.start), _column(at), normal, BLOCK[1] + CLEAR, label=track.by)

    # --- what hangs on a string ---

    def _rope(self, i: int, j: int) -> Iterable[Mark]:
        one, other = (self.tracks[k].foot + self.moved[k] if k in self.moved else self.tracks[k].foot for k in (i, j))
        a, b = _column(self._at(i)), _column(self._at(j))
        if same(one, other):
            yield CornerRopeMark(a, _column(one), b)
            return
        middle, radius = Rational(1, 2) * (one + other), tidied(abs((other - one).components[0]) / 2)
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

    # --- what letters are drawn with ---

    @property
    def values(self) -> dict[Symbol, Expr]:
        """Small displacements where a coordinate is one, and half a string where it divides it."""
        found: dict[Symbol, Expr] = {}
        for q, kind in self.system.coordinates.items():
            lengths = self._at_zero(q) if kind != "angle" else []
            if any(lengths):
                size = next(each for each in lengths if each != 0)
                share = Rational(2, 5) if not all(lengths) else Rational(1, 4 + len(found))
                found[q] = share * size
        return found

    def _at_zero(self, q: Symbol) -> list[Expr]:
        """Of each component with the coordinate in it what is left where all coordinates are zero: one letter of it."""
        zero = dict.fromkeys((*self.system.coordinates, TIME), ZERO)
        holding = [c for place in self.system.places for c in place.components if q in c.free_symbols]
        return [min(c.xreplace(zero).free_symbols, key=str, default=ZERO) for c in holding]


def same_height(one: Track, other: Track) -> bool:
    return all(track.way.components[1] == 0 for track in (one, other)) and vanishes(
        one.start.components[1] - other.start.components[1]
    )


def _both(a: Location, b: Location) -> tuple[tuple[Location, Location], tuple[Location, Location]]:
    return (a, b), (b, a)


def _is_slope(track: Track) -> bool:
    return all(c != 0 for c in track.way.components)


def _numeric(value: Expr) -> float:
    """With every letter 0.6: an acute angle, and any length."""
    return float(value.xreplace(dict.fromkeys(value.free_symbols, Rational(3, 5))).evalf())


def _rises(track: Track) -> bool:
    return _numeric(track.way.components[1]) > 0


def _down_to(top: Location, low: Location, base: Location) -> Location | None:
    """Where the line from one place to another comes to the height of a third, if that is below the first."""
    fall, whole = top.components[1] - base.components[1], top.components[1] - low.components[1]
    share = tidied(fall / whole)
    return top + share * (low - top) if _numeric(fall) > 1e-9 else None


_ = ONE
