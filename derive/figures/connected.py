"""The drawing of a plane system whose surfaces, contacts, strings, rods and joints are described.

Each described thing is drawn as what it is; nothing is recognised from formulas or from the names of symbols.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, sin, sqrt

from derive.algebra.expressions import TIME, column, explicit
from derive.algebra.tidy import tidied
from derive.figures.annotations import Arrow, LengthMark, PointMark
from derive.figures.annotations import Line as Edge
from derive.figures.marks import Mark
from derive.figures.parts import (
    BarMark,
    BlockMark,
    ConnectionMark,
    CornerRopeMark,
    DashpotMark,
    ParticleMark,
    PlankMark,
    RopeMark,
    SpringMark,
    WedgeMark,
    WheelMark,
)
from derive.figures.placed_bodies import placed_outline, with_its_shape
from derive.figures.positions import column_of
from derive.figures.recognition import Link, is_fixed, is_spring, moving_in, same
from derive.figures.scenes import drawn_at
from derive.figures.space import numeric
from derive.figures.surfaces import Circle as CircleMark
from derive.figures.surroundings import AngleBetween, FixedEnd, FloorMark, GravityMark, GroundMark
from derive.figures.turning import angle_marks, downwards
from derive.mechanics.bodies.placed import PlacedBody, PointOfBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.connection import Connection
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.contacts import Contact, LandingSurface
from derive.mechanics.model.joints import Dashpot, Pin
from derive.mechanics.model.strings import Line
from derive.mechanics.model.surfaces import Circle, Plane, Surface, distance_between, dot
from derive.mechanics.model.system import Central, Particle, System

ZERO, ONE = Integer(0), Integer(1)
ACROSS = column(0, 0, 1)
# Values of free coordinates, relative to the largest body.
AWAY = (Rational(8, 5), Rational(6, 5), Rational(2), Rational(4, 5))
WHEEL = Rational(1, 24)  # the drawn radius of a small pulley, relative to the length of the strings
HANGER = Rational(1, 8)  # the drawn distance of a pulley from the ceiling, relative to the length of the strings
BENEATH = 18.0  # the distance of dimension lines beneath what carries a plane, in points
BOWL = 4  # the radius of a bowl, relative to the largest body in it
PAST = Rational(3, 2)  # the drawn length of a plane beyond the bodies on it, relative to their size
ROUND = Rational(3, 5)  # the angle from the vertical of a body on a circle
SMALL = 0.08  # greatest inclination of a plane that counts as level or upright


def connections_of(system: System) -> list[Any]:
    return [part for part in system.parts if isinstance(part, Connection)]


def is_described(system: System) -> bool:
    """Whether the system states what connects its parts: a connection, or a body that is held at a point of another."""
    connected = [each for each in connections_of(system) if not isinstance(each, Dashpot)]
    return bool(connected) or any(isinstance(placed.at, PointOfBody) for placed in system.bodies)


def dashpot_marks(system: System) -> Iterator[Mark]:
    """Yield the dashpots of a system, each beside the spring between the same places, if there is one."""
    springs = [{each.start.components, each.end.components} for each in system.between]
    for each in connections_of(system):
        if isinstance(each, Dashpot):
            beside = {each.start.components, each.end.components} in springs
            yield DashpotMark(column_of(each.start), column_of(each.end), beside, label=each.constant)


class ConnectedScene:
    """The marks of a described system, and the numbers at which they are drawn."""

    def __init__(self, system: System):
        self.system = system
        self.contacts = [each for each in connections_of(system) if isinstance(each, Contact)]
        self.landings = [each for each in connections_of(system) if isinstance(each, LandingSurface)]
        self.lines = [each for each in connections_of(system) if isinstance(each, Line)]
        self.pins = [each for each in connections_of(system) if isinstance(each, Pin)]

    # --- numbers ---

    @cached_property
    def values(self) -> dict[Symbol, Any]:
        """A value for each coordinate: a position in which each constraint is satisfied."""
        found: dict[Symbol, Any] = {}
        for circle in (each.surface for each in self.contacts if isinstance(each.surface, Circle)):
            if circle.inside and circle.radius.is_Symbol and self._size != ONE:
                found[circle.radius] = BOWL * self._size
        for each in self.contacts:
            if isinstance(each.surface, Circle) and set(each.at.components) and not each.is_kept:
                found |= self._on_circle(each)
        for constraint in self.system.constraints:
            if not constraint.in_rates:
                found |= self._solved(constraint, found)
        free = [q for q, kind in self.system.coordinates.items() if q not in found and kind == "length"]
        carriers = [each.through for each in self._planes if each.of is not None]
        carried = {q for place in carriers for q in moving_in(self.system, *place.components)}
        for i, q in enumerate(sorted(free, key=lambda q: q in carried)):
            found[q] = self._size * (self._farthest if q in carried else AWAY[i % len(AWAY)])
        chosen = {letter: found[letter] for letter in found if letter in free or letter not in self.system.coordinates}
        return {**drawn_at(self.system.coordinates), **{letter: value.subs(chosen) for letter, value in found.items()}}

    def _on_circle(self, touch: Contact) -> dict[Symbol, Any]:
        """Values of Cartesian coordinates of a body on a circle with its centre at a fixed place."""
        body = touch.of.centre if isinstance(touch.of, PlacedBody) else touch.of.at
        x, y = body.components
        circle: Any = touch.surface
        if not all(c in self.system.coordinates for c in (x, y)):
            return {}
        distance = tidied(touch.gap - dot(touch.normal, body - circle.centre))
        far = distance if circle.inside else -distance
        up = -1 if circle.inside else 1
        along = Location((far * sin(ROUND), up * far * cos(ROUND)))
        return dict(zip((x, y), (circle.centre + along).components, strict=True))

    def _solved(self, constraint: Constraint, known: Mapping[Symbol, Any]) -> dict[Symbol, Any]:
        """Solve a constraint for a coordinate, or for a length that it contains, such as the length of a string."""
        if constraint.left.is_Symbol and constraint.left not in self.system.coordinates:
            return {constraint.left: tidied(constraint.right.subs(known))}
        residual = explicit(constraint.residual).subs(known)
        free = [q for q in constraint.coordinates if q not in known]
        for q in reversed(free):
            share = tidied(diff(residual, q))
            if share != 0 and not moving_in(self.system, share):
                return {q: tidied(q - residual / share)}
        return {}

    @property
    def _farthest(self) -> Rational:
        """The coordinate of a carrier: a wedge is to the right of the body on it, the middle of a plank to the left."""
        slopes = [each for each in self._planes if each.of is not None and tidied(each.unit_normal.components[0]) != 0]
        return Rational(16, 5) if slopes else Rational(4, 5)

    @property
    def _span(self) -> Expr:
        """The distance of the two farthest ends of strings."""
        places = [place for line in self.lines for place in line.through]
        return max((distance_between(a, b) for a, b in combinations(places, 2) if not same(a, b)), key=self._number)

    @property
    def _size(self) -> Expr:
        """The size of the largest body."""
        sizes = [mark.radius for mark in self._outlines if isinstance(mark, WheelMark) and mark.radius is not None]
        return max(sizes, key=numeric, default=ONE)

    def _number(self, value: Expr) -> float:
        return numeric(value.subs(self.values), self.values)

    # --- marks ---

    @property
    def marks(self) -> list[Mark]:
        found: list[Mark] = []
        for surface in dict.fromkeys(each.surface for each in self.contacts):
            found += self._surface(surface, [each for each in self.contacts if each.surface == surface])
        for landing in self.landings:
            found += self._landing(landing.surface)
        for placed in self.system.bodies:
            found += self._body(placed)
        for particle in self.system.particles:
            found += self._particle(particle)
        for line in self.lines:
            found += self._line(line)
        for each in self.system.between:
            found += self._spring(each)
        found += dashpot_marks(self.system)
        for pin in self.pins:
            found += self._pin(pin)
        found += self._coordinates()
        if self.system.weights:
            found.append(GravityMark(downwards(2), label=self.system.gravity))
        return list(dict.fromkeys(found))

    @cached_property
    def _outlines(self) -> list[Mark]:
        return [mark for placed in self.system.bodies for mark in placed_outline(with_its_shape(placed))]

    # --- surfaces ---

    def _surface(self, surface: Surface, contacts: Sequence[Contact]) -> Iterable[Mark]:
        if isinstance(surface, Circle):
            yield from self._circle(surface, contacts)
        elif isinstance(surface, Plane):
            low, high = self._ends(surface, contacts)
            if surface.of is None:
                yield from self._plane(surface, low, high)
                yield from self._slope(surface, low, high)
            elif isinstance(surface.of, Particle):
                yield from self._carrier(surface, low, high)

    def _plane(self, plane: Plane, low: Location, high: Location) -> Iterable[Mark]:
        """Yield the hatched line of a fixed plane; a moving plane, such as a belt, has no hatches, and an arrow."""
        if not isinstance(plane.moves, Location):
            yield GroundMark(column_of(low), column_of(high), column_of(-plane.unit_normal))
            return
        velocity = Location(tuple(diff(c, TIME) for c in plane.moves.components))
        size = tidied(sqrt(Add(*(c**2 for c in velocity.components))))
        yield Edge(column_of(low), column_of(high), "edge")
        start = low + Rational(1, 10) * (high - low) - self._size * Rational(1, 5) * plane.unit_normal
        yield Arrow(column_of(start), column_of(velocity), Rational(1, 2), False, label=size)

    def _landing(self, surface: Surface) -> Iterable[Mark]:
        """Yield the plane on which a flight ends, below or beside the circle or the string from which it begins."""
        if isinstance(surface, Plane):
            n = surface.unit_normal
            along = Location((n.components[1], -n.components[0]))
            circles = [
                (each.surface.centre, each.surface.radius) for each in self.contacts if isinstance(each.surface, Circle)
            ]
            reach = circles or [(line.through[0], self._span) for line in self.lines]
            for middle, far in reach[:1]:
                way = dot(along, middle - surface.through)
                low, high = (surface.through + (way + sign * PAST * far) * along for sign in (-1, 1))
                yield from self._plane(surface, low, high)
                yield from self._slope(surface, low, high)

    def _ends(self, plane: Plane, contacts: Sequence[Contact]) -> tuple[Location, Location]:
        """The ends of the drawn part of a plane, from the lower or left end to the other end."""
        n = plane.unit_normal
        along = Location((n.components[1], -n.components[0]))
        if self._number(along.components[1]) < -SMALL or abs(self._number(along.components[1])) <= SMALL > self._number(
            along.components[0]
        ):
            along = -along
        ways = [dot(along, each.at - plane.through) for each in contacts]
        past = self._size * PAST
        meets = any(other != plane and same(other.through, plane.through) for other in self._planes)
        first, last = (choice([*ways, ZERO] if meets else ways, key=self._number) for choice in (min, max))
        if isinstance(plane.of, Particle) and abs(self._number(along.components[1])) <= SMALL:
            half = max((tidied(way) for way in ways), key=lambda way: abs(self._number(way)))
            far = (half if self._number(half) > 0 else -half) + past
            return plane.through - far * along, plane.through + far * along  # the place of a plank is its middle
        low = first if meets and first == 0 else first - past
        high = last if meets and last == 0 else last + past
        return plane.through + low * along, plane.through + high * along

    @property
    def _planes(self) -> list[Plane]:
        return list(dict.fromkeys(each.surface for each in self.contacts if isinstance(each.surface, Plane)))

    def _slope(self, plane: Plane, low: Location, high: Location) -> Iterable[Mark]:
        """Yield the angle of an inclined plane, at its lower end."""
        x, y = (high - low).components
        if abs(self._number(x)) <= SMALL or abs(self._number(y)) <= SMALL:
            return
        angle = _angle_in(plane.unit_normal)
        level = _direction(1 if self._number(x) > 0 else -1, 0)
        if angle is not None:
            yield AngleBetween(column_of(low), level, column_of(high - low), True, label=angle)

    def _carrier(self, plane: Plane, low: Location, high: Location) -> Iterable[Mark]:
        """Yield the particle that carries a plane: a wedge under a slope, or a plank under a level plane."""
        x, y = (high - low).components
        label = plane.of.mass
        if abs(self._number(y)) <= SMALL:
            down = Location((ZERO, -self._size * Rational(1, 3)))
            corners: tuple[Location, ...] = (low, high, high + down, low + down)
            sort: type[WedgeMark] = PlankMark
        else:
            corners, sort = (low, high, Location((high.components[0], low.components[1]))), WedgeMark
            angle = _angle_in(plane.unit_normal)
            level = _direction(1 if self._number(x) > 0 else -1, 0)
            if angle is not None:
                yield AngleBetween(column_of(low), level, column_of(high - low), label=angle)
        yield sort(tuple(map(column_of, corners)), label=label)
        yield FloorMark(tuple(column_of(corner) for corner in corners[-2:]))

    def _circle(self, circle: Circle, contacts: Sequence[Contact]) -> Iterable[Mark]:
        centre = column_of(circle.centre)
        if isinstance(circle.of, PlacedBody):
            return
        yield CircleMark(centre, ACROSS, circle.radius, not circle.inside)
        yield PointMark(centre)
        yield ConnectionMark(centre, column_of(contacts[0].at), label=circle.radius)
        yield from angle_marks(self.system, link_between(circle.centre, contacts[0].at))

    # --- bodies and particles ---

    def _body(self, placed: PlacedBody) -> Iterable[Mark]:
        shown: Any = with_its_shape(placed)
        outline = placed_outline(shown)
        yield from outline
        centre = column_of(shown.centre)
        yield PointMark(centre)
        if isinstance(shown.at, PointOfBody):
            yield PointMark(column_of(shown.at))
        if is_fixed(self.system, shown.at) and not same(shown.at, shown.centre):
            yield FixedEnd(column_of(shown.at), downwards(2), True)
        elif is_fixed(self.system, shown.centre):
            yield FixedEnd(centre, downwards(2), True)
        for mark in outline:
            if isinstance(mark, BarMark):
                start, end = (Location(tuple(place)) for place in (mark.start, mark.end))
                yield from angle_marks(self.system, Link(start, end, mark.label, True))

    def _particle(self, particle: Particle) -> Iterable[Mark]:
        if any(each.surface.of is particle or each.surface.of == particle for each in self.contacts):
            return
        touch = next((each for each in self.contacts if each.of == particle), None)
        at = column_of(particle.at)
        if touch is not None and isinstance(touch.surface, Plane):
            yield BlockMark(at, column_of(touch.tangent), stands=True, label=particle.mass)
        elif not any(same(particle.at, place) for line in self.lines for place in line.through[1:-1]):
            yield ParticleMark(at, label=particle.mass)

    # --- strings, rods, springs and joints ---

    def _line(self, line: Line) -> Iterable[Mark]:
        places = [column_of(place) for place in line.through]
        letter = next((c.left for c in self.system.constraints if c.forces == line.forces and c.left.is_Symbol), None)
        if line.is_rod:
            yield BarMark(places[0], places[-1], label=letter)
        elif len(places) == 3 and is_fixed(self.system, line.through[1]):
            yield CornerRopeMark(*places)
        else:
            wheel = self._span * WHEEL
            radii = tuple(wheel if 0 < i < len(places) - 1 else ZERO for i in range(len(places)))
            yield RopeMark(tuple(places), radii, label=letter if len(places) == 2 else None)
        if len(places) == 2:
            yield from angle_marks(self.system, link_between(*line.through))
        for place in line.through[1:-1] if len(places) != 3 or not is_fixed(self.system, line.through[1]) else ():
            particle = next((one for one in self.system.particles if same(one.at, place)), None)
            yield WheelMark(column_of(place), self._span * WHEEL, label=particle.mass if particle else None)
            if particle is None and is_fixed(self.system, place):
                yield BarMark(column_of(place), column_of(place + Location((ZERO, HANGER * self._span))))
                yield FixedEnd(column_of(place + Location((ZERO, HANGER * self._span))), downwards(2))
        for place, other in ((line.through[0], line.through[1]), (line.through[-1], line.through[-2])):
            within = any(same(place, pulley) for pulley in line.through[1:-1])
            if not within and any(force.of is None and same(force.at, place) for force in line.forces):
                below = self._number((other - place).components[1]) < 0 or line.is_rod
                yield FixedEnd(column_of(place), downwards(2) if below else column_of(other - place), line.is_rod)

    def _spring(self, each: Central) -> Iterable[Mark]:
        a, b = column_of(each.start), column_of(each.end)
        if is_spring(each):
            yield SpringMark(a, b, label=tidied(diff(explicit(each.energy), each.distance, 2)))
            for end, way in ((each.start, b - a), (each.end, a - b)):
                if is_fixed(self.system, end):
                    yield FixedEnd(column_of(end), way)
        else:
            yield ConnectionMark(a, b)

    def _pin(self, pin: Pin) -> Iterable[Mark]:
        if is_fixed(self.system, pin.at):
            yield FixedEnd(column_of(pin.at), downwards(2), True)
        else:
            yield PointMark(column_of(pin.at))

    # --- coordinates ---

    def _coordinates(self) -> Iterator[Mark]:
        """Yield a dimension line for each coordinate that is a Cartesian component of the place of a mass."""
        shown: set[Symbol] = set()
        for _, at in self.system.masses:
            x, y = at.components
            for q, start, aside in (
                (x, Location((ZERO, y)), _direction(0, -1)),
                (y, Location((x, ZERO)), _direction(1, 0)),
            ):
                own = q if q in self.system.coordinates else -q
                if own in self.system.coordinates and own not in shown:
                    shown.add(own)
                    beyond = BENEATH * len(shown) if self._is_on_carrier(at) else 0.0
                    yield LengthMark(column_of(start), column_of(at), aside, self._clear(at), beyond, label=own)
        for each in self.contacts:
            moving = moving_in(self.system, *each.at.components)
            if len(moving) == 1 and not moving & shown and isinstance(each.surface, Plane):
                (q,) = moving
                start = Location(tuple(c.xreplace({q: ZERO}) for c in each.at.components))
                yield LengthMark(column_of(start), column_of(each.at), column_of(-each.normal), label=q)

    def _is_on_carrier(self, at: Location) -> bool:
        """Whether a mass carries a plane or touches one that is carried; its dimension line is beneath the carrier."""
        carriers = [each for each in self.contacts if isinstance(each.surface.of, Particle)]
        return any(same(at, each.at) or same(at, each.surface.of.at) for each in carriers)

    def _clear(self, at: Location) -> Expr:
        """The distance of a dimension line from the centre of a body: its radius."""
        wheels = (mark for mark in self._outlines if isinstance(mark, WheelMark) and mark.radius is not None)
        return next((mark.radius for mark in wheels if same(Location(tuple(mark.centre)), at)), ZERO)


def link_between(start: Location, end: Location) -> Link:
    return Link(start, end, distance_between(start, end), True)


def _direction(x: Any, y: Any) -> Any:
    return ImmutableDenseMatrix([x, y])


def _angle_in(direction: Location) -> Expr | None:
    """The symbol whose sine and cosine are the components of a direction."""
    angles = {f.args[0] for c in direction.components for f in c.atoms(sin, cos)}
    return next((angle for angle in angles if angle.is_Symbol), None)
