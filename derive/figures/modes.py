"""Pictures of small displacements, in normal modes and just after an impact: the displaced system, with an arrow at
each mass in the direction of its displacement.

The displacement of a mass is a sum over the coordinates. Each term is the derivative of the position of the mass with
respect to a coordinate, at equilibrium, times the amplitude of this coordinate. If the ratio of the displacements is
known, the lengths of the arrows are in this ratio, except that a very small displacement has no arrow.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, pairwise
from math import cos, hypot, isfinite, pi, sin
from typing import Any, ClassVar

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, diff, sqrt
from sympy.matrices import MatrixBase

from derive.algebra.expressions import TIME, as_expr, explicit, rate
from derive.algebra.tidy import tidied
from derive.figures.links import moving_in
from derive.figures.marks import SENSES, Drawing, Mark, Position, ShownMode
from derive.figures.parts import BLOCK, BOB, BarMark, BlockMark, ConnectionMark, ParticleMark, WedgeMark, WheelMark
from derive.figures.pieces import Paper, Piece, Stroke
from derive.figures.positions import column_of
from derive.figures.scenes import drawing
from derive.figures.sketches import things_of
from derive.figures.space import Spot, direction, numeric, size_of
from derive.figures.surroundings import FixedEnd, WayMark
from derive.figures.velocities import Moment
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import System
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.mechanics.vibrations.modes import MODE_SHAPE
from derive.steps.known_numbers import with_numbers
from derive.steps.signs import sign_beside_root, sign_known
from derive.steps.step import Quantity, is_zero

__all__ = ["draw_after", "draw_modes"]

ANGLE = Rational(2, 5)  # approximate greatest displacement of an angle, in radians
MOVED = Rational(1, 6)  # approximate greatest displacement of a length, relative to the least distance in the system
# Lengths in points, before the drawing is reduced.
# The usual length of the shortest arrow, and the least visible length of an arrow.
SHORTEST, VISIBLE = 14.0, 8.0
# The usual length of the longest arrow, and its greatest length, used if another arrow would be too short.
LONGEST = 42.0, 56.0
ABOVE = 6.0  # the distance between a mass and an arrow next to it
ROUND = 24.0  # the radius of the arrow of a rotation
OPEN = 1.9  # the angle of this arrow, in radians

FREE = 0.8  # the greatest length of an arrow next to its mass, relative to the least distance between two masses
ALONG = 0.45  # a line is along an arrow if the sine of the angle between them is smaller than this number
SLIGHT = 1e-9  # a displacement below this size, relative to the greatest, counts as zero
ALMOST = 0.26  # a component of a direction below this size is not described
FREE_MOTION, TO_SCALE, WITHOUT_SMALL = "free", "to_scale", "without_small"
SORTS = {1: "oscillating", None: "oscillating", -1: "growing", 0: FREE_MOTION}  # sign of omega^2 -> sort of the mode


@dataclass(frozen=True)
class DisplacementArrow(Mark):
    """The displacement of a mass in a normal mode, or just after an impact.

    at       the place of the mass
    value    its displacement, up to a factor that all masses have in common
    others   the displacements of all masses; the greatest displacement has the longest arrow
    side     the direction from the mass to the arrow, if the arrow is next to the mass; None if the arrow starts at the
             mass
    clear    a length that is added to the distance of the arrow from the mass, and is drawn to scale
    off      the other part of this distance, in points; for an arrow that starts at a mass, the radius of the mass
    room     the least distance between two masses, which limits the arrows; None without a limit
    exact    whether the lengths of all arrows are in the ratio of the displacements
    """

    at: Position
    value: Position
    others: tuple[Position, ...]
    side: Position = None
    clear: Any = 0
    off: float = 0.0
    room: Any = None
    exact: bool = False
    layer: ClassVar[int] = 8

    def pieces(self, paper: Paper) -> list[Piece]:
        sizes = [size_of(paper.numbers.vector(each)) for each in self.others]
        moving = [size for size in sizes if size > SLIGHT * max(sizes)]
        way = paper.numbers.vector(self.value)
        size = size_of(way)
        if size <= SLIGHT * max(sizes):
            return []
        length = size / max(sizes) * self._longest(paper, min(moving) / max(sizes))
        if self.exact and length < VISIBLE:
            return []
        length = length if self.exact else max(length, SHORTEST)
        along = direction((0.0, 0.0), paper.spot(way))
        x, y = paper.spot(paper.numbers.vector(self.at))
        if self.side is None:
            ends = tuple((x + far * along[0], y + far * along[1]) for far in (self.off, self.off + length))
            return [Stroke(ends, "asked", head=True)]
        u, v = self._beside(paper)
        ends = tuple((x + u + s * length * along[0], y + v + s * length * along[1]) for s in (-0.5, 0.5))
        return [Stroke(ends, "asked", head=True)]

    def _longest(self, paper: Paper, least: float) -> float:
        """Return the length of the longest arrow; `least` is the ratio of the least to the greatest displacement."""
        longest = min(max(LONGEST[0], SHORTEST / least), LONGEST[1])
        if self.room is None:
            return longest
        return min(longest, FREE * paper.numbers.of(self.room) * paper.scale)

    def _beside(self, paper: Paper) -> Spot:
        x, y = paper.spot(paper.numbers.vector(self.side))
        far = (paper.numbers.of(self.clear) * paper.scale + self.off) / (hypot(x, y) or 1.0)
        return far * x, far * y


@dataclass(frozen=True)
class RotationArrow(Mark):
    """The rotation of a body whose centre of mass is at rest: an arc above the centre.

    rotation   the angle of rotation, counterclockwise, up to a factor
    """

    at: Position
    rotation: Any
    layer: ClassVar[int] = 8

    def pieces(self, paper: Paper) -> list[Piece]:
        x, y = paper.spot(paper.numbers.vector(self.at))
        turned = paper.numbers.of(self.rotation)
        sense = 1 if turned > 0 else -1
        angles = [pi / 2 + sense * OPEN * (i / 24 - 0.5) for i in range(25)]
        spots = tuple((x + ROUND * cos(t), y + ROUND * sin(t)) for t in angles)
        return [Stroke(spots, "asked", head=True)] if turned else []


@dataclass(frozen=True)
class RestMark(Mark):
    """A short dashed line at the undisplaced position of a mass, perpendicular to its displacement.

    half   half the length of the line, in points
    """

    at: Position
    value: Position
    half: float
    layer: ClassVar[int] = 7

    def pieces(self, paper: Paper) -> list[Piece]:
        x, y = paper.spot(paper.numbers.vector(self.at))
        u, v = direction((0.0, 0.0), paper.spot(paper.numbers.vector(self.value)))
        return [Stroke(tuple((x - s * self.half * v, y + s * self.half * u) for s in (-1, 1)), "trace")]


def draw_modes(
    system: System, steps: Sequence[Quantity], named: Sequence[Location] = (), like: str = ""
) -> list[Drawing]:
    """Draw each normal mode of a system in a plane.

    steps   the established steps; the mode shapes among them are drawn
    named   positions of further parts, as for `sketch`
    like    the name of the sketch of the system; the numbers of this sketch are also used here

    The name of a drawing is the key of the shape. The list is empty if a sketch cannot show the system, if a point has
    a prescribed motion, or if a rope has mass. A mode is left out if the direction of a displacement depends on unknown
    numbers. Modes that are found together are also left out if none of them oscillates or grows.
    """
    shapes = [each for each in steps if each.step.rule == MODE_SHAPE.name]
    if not shapes or len(system.places[0].components) != 2:
        return []
    if any(TIME in moving_in(system, *place.components) for place in system.places):
        return []
    if len(system.masses) > len(system.particles) + len(system.bodies):
        return []  # the mass of a rope is not at one place
    things = things_of(system, named)
    if things is None:
        return []
    found = []
    for linear, own in _together(shapes):
        if {q.symbol for q, _ in linear.place} == {*system.coordinates}:
            siblings = tuple(each.key for each in own)
            modes = [_InMode(system, *things, (each.key,), linear, each) for each in own]
            known = [mode for mode in modes if mode.is_known]
            found += (
                [mode.drawn(siblings, like) for mode in known]
                if any(mode.sort != FREE_MOTION for mode in known)
                else []
            )
    return found


def _together(shapes: Sequence[Quantity]) -> list[tuple[Linear, list[Quantity]]]:
    found: list[tuple[Linear, list[Quantity]]] = []
    for shape in shapes:
        linear = next(fact for each in shape.parents if (fact := each.fact(Linear)) is not None)
        own = next((known for other, known in found if other == linear), None)
        if own is None:
            found.append((linear, own := []))
        own.append(shape)
    return found


def draw_after(
    key: str, system: System, moment: Moment, after: Sequence[Quantity], named: Sequence[Location] = ()
) -> Drawing | None:
    """Draw a system in a plane a short time after an impact. The displacements are in the ratio of the rates just after
    the impact, and arrows show the velocities of the masses.

    moment   the state at the impact
    after    the rates just after the impact

    Return None for a system in space, and for a system that a sketch cannot show. For numbers that differ from those
    of the drawing, the directions of the arrows may also differ.
    """
    things = things_of(system, named)
    if things is None or len(system.places[0].components) != 2:
        return None
    rest = {q: moment.at.get(q, Integer(0)) for q in system.coordinates}
    rates = {each.symbol: explicit(each.value) for each in after}
    moved = {q: rates.get(rate(q), Integer(0)) for q in rest}
    return _Struck(system, *things, tuple(each.key for each in after), rest, moved).drawn_after(key)


@dataclass(frozen=True)
class _Displaced:
    """A system that is slightly displaced.

    things   the marks of the system
    values   the numbers that replace symbols in the sketch of the system
    keys     the keys of the steps that determine the displacement
    """

    system: System
    things: Sequence[Mark]
    values: Mapping[Symbol, Any]
    keys: tuple[str, ...]

    @property
    def rest(self) -> Mapping[Symbol, Expr]:
        """The values of the coordinates before the displacement."""
        raise AttributeError(f"{type(self).__name__} must define `rest`")

    @property
    def amplitudes(self) -> Mapping[Symbol, Expr]:
        """The displacement of each coordinate, up to a common factor."""
        raise AttributeError(f"{type(self).__name__} must define `amplitudes`")

    @cached_property
    def masses(self) -> list[tuple[Expr, Location]]:
        particles = [(each.mass, each.at) for each in self.system.particles]
        return particles + [(each.body.mass, each.centre) for each in self.system.bodies]

    @cached_property
    def rotations(self) -> list[Expr]:
        """The rotation of each mass, counterclockwise; zero for a particle."""
        angles = [Integer(0)] * len(self.system.particles) + [each.turned for each in self.system.bodies]
        return [self._change(ImmutableDenseMatrix([angle]))[0] for angle in angles]

    @cached_property
    def displacements(self) -> list[MatrixBase]:
        return [self._change(column_of(at)) for _, at in self.masses]

    def _change(self, value: MatrixBase) -> MatrixBase:
        """Return the change of a column, to first order in the amplitudes."""
        slopes = [self._at_rest(value.diff(q)) * amplitude for q, amplitude in self.amplitudes.items()]
        return ImmutableDenseMatrix([tidied(Add(*entries)) for entries in zip(*slopes, strict=True)])

    def _at_rest(self, value: Any) -> Any:
        return value.xreplace(self.rest)

    def number(self, value: Expr) -> float:
        fixed = {s: v for s, v in self.values.items() if s not in self.rest}
        return numeric(explicit(with_numbers(self._at_rest(value))), fixed)

    @property
    def _moving(self) -> list[tuple[MatrixBase, tuple[Expr, Location]]]:
        pairs = zip(self.displacements, self.masses, strict=True)
        return [(each, mass) for each, mass in pairs if any(each)]

    def _is_number(self, column: MatrixBase) -> bool:
        try:
            return all(isfinite(self.number(c)) for c in column)
        except TypeError:  # a complex number
            return False

    def _along(self, displacement: MatrixBase, at: Location) -> Expr | None:
        """Return a component of a displacement, up to a positive factor.

        If the displacement is parallel to an axis or the ratio y/x is a number, the result is the component along an
        axis. Otherwise the result is the component along the path of a coordinate, or None if the displacement is not
        along such a path.
        """
        x, y = displacement
        if x == 0 or y == 0 or tidied(y / x).is_number:
            return y if x == 0 else x
        for q in self.amplitudes:
            u, v = (self._at_rest(diff(c, q)) for c in at.components)
            if (u, v) != (0, 0) and is_zero(tidied(x * v - y * u)):
                return tidied((x * u + y * v) / (u**2 + v**2))
        return None

    # --- the drawing ---

    def _things_and_values(self) -> tuple[list[Mark], dict[Symbol, Any]]:
        return [self._as_in_sketch(mark) for mark in self.things], {**self.values, **self._state()}

    def _as_in_sketch(self, mark: Mark) -> Mark:
        """Return the mark for the displaced system; a wall or a wire stays as in the sketch."""
        if isinstance(mark, FixedEnd):
            return replace(mark, away=self._at_rest(mark.away))
        if isinstance(mark, WayMark):
            drawn = {q: value for q, value in self.values.items() if q in self.rest}
            return replace(mark, lower=as_expr(mark.lower).xreplace(drawn), upper=as_expr(mark.upper).xreplace(drawn))
        return mark

    def _state(self) -> dict[Symbol, Expr]:
        least = self._least(self.system.places)
        usual = {
            q: ANGLE if self.system.coordinates[q] == "angle" else MOVED * (least or Integer(1)) for q in self.rest
        }
        size = sqrt(Add(*((self.amplitudes[q] / usual[q]) ** 2 for q in self.rest)))
        return {q: self.rest[q] + self.amplitudes[q] / size for q in self.rest}

    def _least(self, places: Sequence[Location]) -> Expr | None:
        columns = [self._at_rest(column_of(place)) for place in places]
        ways = [b - a for a, b in combinations(columns, 2)]
        sizes = {way: hypot(*(self.number(c) for c in way)) for way in ways}
        different = [way for way in ways if sizes[way] > 1e-9]
        if not different:
            return None
        x, y = min(different, key=lambda way: sizes[way])
        if x == 0 or y == 0:
            (own,) = (c for c in (x, y) if c != 0)
            return own if self.number(own) > 0 else -own
        return sqrt(tidied(x**2 + y**2))

    def _rest_marks(self) -> Iterator[Mark]:
        """Yield dashed lines for the undisplaced rods, and for the undisplaced positions of masses without a rod."""
        bars = [mark for mark in self.things if isinstance(mark, BarMark)]
        ends = [end for mark in bars for end in (mark.start, mark.end)]
        for mark in bars:
            if (mark.start, mark.end) != (at_rest := (self._at_rest(mark.start), self._at_rest(mark.end))):
                yield ConnectionMark(*at_rest)
        for displacement, (_, at) in self._moving:
            own = [mark for mark in self.things if self._is_at(mark, at)]
            if own and not any(self._distance(end, column_of(at)) < 1e-9 for end in ends):
                half = max(BLOCK[1] / 2 if isinstance(mark, BlockMark) else BOB for mark in own)
                yield RestMark(self._at_rest(column_of(at)), displacement, half + ABOVE)

    def _arrows(self) -> Iterator[Mark]:
        besides = [self._beside(each, at) for each, (_, at) in zip(self.displacements, self.masses, strict=True)]
        is_beside = any(side is not None for side, *_ in besides)
        room = self._least([at for _, at in self.masses]) if is_beside else None
        moved = tuple(self.displacements)
        keys, exact = self.keys, self.lengths in (TO_SCALE, WITHOUT_SMALL)
        moves = zip(self.displacements, self.rotations, self.masses, besides, strict=True)
        for displacement, turned, (_, at), beside in moves:
            if turned != 0 and not any(displacement):
                yield RotationArrow(column_of(at), turned, keys=keys)
            else:
                yield DisplacementArrow(self._start(at), displacement, moved, *beside, room, exact, keys=keys)

    def _start(self, at: Location) -> Position:
        """Return the place at which the arrow of a mass starts: the place of the mass, or the middle of a wedge or
        plank.
        """
        own = column_of(at)
        for mark in self.things:
            if isinstance(mark, WedgeMark):
                places = [*mark.corners, (mark.corners[0] + mark.corners[1]) / 2]
                if any(self._distance(place, own) < 1e-9 for place in places):
                    return sum(mark.corners[1:], mark.corners[0]) / len(mark.corners)
        return own

    def _beside(self, displacement: MatrixBase, at: Location) -> tuple[Position, Any, float]:
        """Return the side of the mass on which its arrow is drawn, and the distance from the mass, as a length and in
        points. The side is None if the arrow starts at the mass."""
        x, y = (self.number(c) for c in displacement)
        size = hypot(x, y)
        if not size:
            return None, Integer(0), 0.0
        x, y = x / size, y / size
        normal = (-y, x) if x > 0.1 or abs(x) <= 0.1 and y < 0 else (y, -x)  # upwards, or to the right
        own = [mark for mark in self.things if self._is_at(mark, at)]
        block = next((mark for mark in own if isinstance(mark, BlockMark)), None)
        if block is not None:
            off = BLOCK[1] if block.stands else BLOCK[1] / 2
            return self._side(normal), Integer(0), off + ABOVE
        lines = list(self._lines(at))
        if not any(abs(x * v - y * u) < ALONG for u, v in lines):
            return None, Integer(0), BOB if any(isinstance(mark, ParticleMark) for mark in own) else 0.0
        across = sum(normal[0] * u + normal[1] * v for u, v in lines if abs(x * v - y * u) >= ALONG)
        if across > 1e-6:
            normal = -normal[0], -normal[1]
        wheel = next((mark for mark in own if isinstance(mark, WheelMark)), None)
        if wheel is not None and wheel.radius is not None:
            return self._side(normal), wheel.radius, ABOVE
        return self._side(normal), Integer(0), BOB + ABOVE

    @staticmethod
    def _side(normal: Spot) -> Position:
        return ImmutableDenseMatrix([Rational(round(1000 * c), 1000) for c in normal])

    def _is_at(self, mark: Mark, at: Location) -> bool:
        place = getattr(mark, "centre", None) if isinstance(mark, WheelMark) else getattr(mark, "at", None)
        is_mass = isinstance(mark, BlockMark | ParticleMark | WheelMark)
        return is_mass and place is not None and self._distance(place, column_of(at)) < 1e-9

    def _lines(self, at: Location) -> Iterator[Spot]:
        """Yield the directions of the lines that start at a mass, such as springs and rods."""
        here = column_of(at)
        for mark in self.things:
            along = getattr(mark, "along", None)
            ends = along if isinstance(along, tuple) else (getattr(mark, "start", None), getattr(mark, "end", None))
            pairs = [pair for pair in pairwise(ends) if None not in pair]
            for one, other in (*pairs, *(pair[::-1] for pair in pairs)):
                far = self._distance(one, other)
                if far > 1e-9 and self._distance(one, here) < 1e-9:
                    u, v = (self.number(c) for c in other - one)
                    yield u / far, v / far

    def _distance(self, one: Position, other: Position) -> float:
        return hypot(*(self.number(c) for c in other - one))

    @cached_property
    def lengths(self) -> str:
        """What the lengths of the arrows show, as in `ShownMode`."""
        if len(self.masses) == 1:
            return "alone"
        return "of_letters" if self.letters else WITHOUT_SMALL if self._has_small() else TO_SCALE

    @cached_property
    def letters(self) -> tuple[Symbol, ...]:
        """The symbols without numbers on which the ratio of the displacements depends."""
        squares = [each.dot(each) for each, _ in self._moving]
        ratios = [explicit(with_numbers(tidied(each / squares[0]))) for each in squares[1:]]
        return tuple(sorted(set[Symbol]().union(*(ratio.free_symbols for ratio in ratios)), key=str))

    def _has_small(self) -> bool:
        sizes = [hypot(*(self.number(c) for c in each)) for each, _ in self._moving]
        return bool(sizes) and min(sizes) / max(sizes) < VISIBLE / LONGEST[1]

    def _moves(self) -> tuple[tuple[tuple[Expr, tuple[str, ...], str], ...], str]:
        """Return the masses in order with the directions of their displacements and rotations, and the name of the
        order."""
        places = [tuple(self.number(c) for c in at.components) for _, at in self.masses]
        wide, high = (max(p[k] for p in places) - min(p[k] for p in places) for k in (0, 1))
        name = "" if len(places) < 2 else "down" if high > wide else "across"
        order = sorted(range(len(places)), key=lambda i: -places[i][1] if name == "down" else places[i][0])
        words = [self._words(each) for each in self.displacements]
        senses = ["" if each == 0 else SENSES[int(self.number(each) > 0)] for each in self.rotations]
        return tuple((explicit(self.masses[i][0]), words[i], senses[i]) for i in order), name

    def _words(self, displacement: MatrixBase) -> tuple[str, ...]:
        x, y = (self.number(c) for c in displacement)
        size = hypot(x, y)
        if not size:
            return ()
        across = ("right" if x > 0 else "left",) if abs(x) > ALMOST * size else ()
        return (*across, "up" if y > 0 else "down") if abs(y) > ALMOST * size else across


@dataclass(frozen=True)
class _InMode(_Displaced):
    """A system displaced in one mode.

    linear   the linear equations
    shape    the step that derives the mode shape
    """

    linear: Linear
    shape: Quantity

    @cached_property
    def rest(self) -> dict[Symbol, Expr]:
        return {q.symbol: value for q, value in self.linear.place}

    @cached_property
    def amplitudes(self) -> dict[Symbol, Expr]:
        entries = explicit(self.shape.value)
        return {q.symbol: entry for (q, _), entry in zip(self.linear.place, entries, strict=True)}

    @property
    def frequency(self) -> Quantity:
        return next(each for each in self.shape.parents if each.fact(Mode) is not None)

    @property
    def sort(self) -> str:
        return SORTS[self.frequency.needed(Mode).root.sign]

    @cached_property
    def is_known(self) -> bool:
        """Whether the directions of all displacements and rotations, relative to each other, are the same for all
        allowed values of the symbols."""
        if not all(self._is_real(value) for value in self.rest.values()):
            return False
        places = [self._at_rest(column_of(place)) for place in self.system.places]
        if not all(map(self._is_number, (*places, *self.displacements, ImmutableDenseMatrix(self.rotations)))):
            return False
        components: list[Expr | None] = [self._along(each, at) for each, (_, at) in self._moving]
        components += [each for each in self.rotations if each != 0]
        known = [each for each in components if each is not None]
        if not known or len(known) < len(components):
            return False
        return all(sign_beside_root(tidied(each / known[0])) in (1, -1) for each in known[1:])

    def _is_real(self, value: Expr) -> bool:
        exists = self.linear.exists
        known = exists is None or sign_known(exists.residual) == (1 if exists.operator == ">" else -1)
        return known and bool(explicit(with_numbers(value)).is_real)

    def drawn(self, siblings: tuple[str, ...], like: str) -> Drawing:
        things, values = self._things_and_values()
        marks = (*things, *self._rest_marks(), *self._arrows())
        return drawing(self.shape.key, *marks, values=values, mode=self._shown(siblings, like))

    def _shown(self, siblings: tuple[str, ...], like: str) -> ShownMode:
        root = self.frequency.needed(Mode).root
        moves, order = self._moves()
        symbol, several = self.frequency.symbol, root.times > 1
        return ShownMode(symbol, self.sort, several, self.lengths, self.letters, moves, order, siblings, like)


@dataclass(frozen=True)
class _Struck(_Displaced):
    """A system a short time after an impact.

    at      the values of the coordinates at the impact
    rates   the rates of the coordinates just after the impact, by coordinate
    """

    at: Mapping[Symbol, Expr]
    rates: Mapping[Symbol, Expr]

    @property
    def rest(self) -> Mapping[Symbol, Expr]:
        return self.at

    @property
    def amplitudes(self) -> Mapping[Symbol, Expr]:
        return self.rates

    def drawn_after(self, key: str) -> Drawing:
        things, values = self._things_and_values()
        return drawing(key, *things, *self._rest_marks(), *self._arrows(), values=values)
