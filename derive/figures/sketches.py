"""A drawing of a system that needs only the formulas of the system: `sketch("pendulum", System(...))`.

A particle at a constant distance from a point is drawn on a rod. A particle on a straight line is drawn as a block on a
floor, a wedge or a string, and a particle with one coordinate on the curve on which it moves. All other particles are
drawn without further parts, because the drawing shows only what follows from the formulas.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, pi, sin, sqrt

from derive.algebra.expressions import TIME, explicit, scalar
from derive.algebra.tidy import tidied
from derive.figures.annotations import Axis, AxisOfRotation, PointMark, Weight
from derive.figures.completeness import is_whole
from derive.figures.connected import ConnectedScene, dashpot_marks, is_described
from derive.figures.contacts import contact_marks
from derive.figures.marks import Drawing, Mark, Marks
from derive.figures.parts import BarMark, ConnectionMark, ParticleMark, RopeMark, SpringMark
from derive.figures.placed_bodies import placed_marks, with_its_shape
from derive.figures.positions import column_of
from derive.figures.pulleys import HangingPulley
from derive.figures.recognition import (
    Link,
    angle_of_link,
    is_fixed,
    is_rod,
    is_spring,
    kept_length,
    link_to,
    moving_in,
    same,
    through_hole,
)
from derive.figures.rollers import carrying_marks, roller_with
from derive.figures.scenes import drawing
from derive.figures.sliding import Sliding
from derive.figures.space import numeric
from derive.figures.surroundings import FieldMark, FixedEnd, FloorMark, GravityMark, WayMark
from derive.figures.tops import stance_values
from derive.figures.touching import Touching
from derive.figures.turning import angle_marks, downwards, turning_marks
from derive.figures.velocities import Moment, impact_marks, is_of_the_moment, launch_marks, moment_drawn
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import Central, Particle, System

__all__ = ["sketch"]

ZERO = Integer(0)
HANGING = Rational(5, 2)  # length of a string through a hole in a table, relative to its part on the table
FAR = Rational(8, 5)  # drawn range of a curve, relative to the value of its coordinate
ECCENTRICITY = Rational(1, 2)
WEIGHT = Rational(2, 5)  # length of the arrow of a weight, relative to the size of the drawing
BROADSIDE = 23 * pi / 36  # angle at which a rotating vertical plane faces the viewer
ON_A_TABLE = 17 * pi / 36  # angle of two rotating horizontal axes at which all axes are drawn well apart


def sketch(
    key: str,
    system: System,
    *more: Marks,
    values: Mapping[Any, Any] | None = None,
    named: Sequence[Location] = (),
    weights: bool = False,
    start: Moment | None = None,
    impact: Moment | None = None,
) -> Drawing | None:
    """Return a drawing of a system from its positions and forces, which is recorded for the problem.

    The result is None if the drawing would not show the whole system and no further marks are given.

    key       the name of the drawing, for `drawings:` in the problem
    system    particles, bodies, springs, central forces and weights
    more      further marks
    values    numbers or proportions for symbols in the drawing
    named     positions of further parts, such as a pivot
    weights   whether the weight of each particle and body is drawn, instead of one arrow for gravity
    start     the initial state of a motion
    impact    the state at an impact; if it is given, the impact is drawn
    """
    if is_described(system) and len(system.places[0].components) == 2 and impact is None:
        connected = ConnectedScene(system)
        if not more and not connected.is_possible:
            return None
        return drawing(key, connected.marks, *more, values={**connected.values, **(values or {})})
    scene = _Scene(system, named, weights, start, impact)
    if not more and not scene.is_whole:
        return None
    return drawing(key, scene.marks, *more, values={**scene.values, **(values or {})})


class _Scene:
    """The recognised parts of a system, and their marks."""

    def __init__(
        self,
        system: System,
        named: Sequence[Location] = (),
        weights: bool = False,
        start: Moment | None = None,
        impact: Moment | None = None,
    ):
        self.system, self.named, self.weights = system, tuple(named), weights
        self.start, self.impact = start, impact
        self.rows = len(system.places[0].components)
        indices = range(len(system.particles))
        self.links = {i: link for i in indices if (link := link_to(system, i, self.named)) is not None}
        self.sliding = Sliding(system, self.links) if self.rows == 2 else None
        self.pulley = HangingPulley(system)
        if self.pulley.hung:
            self.links, self.sliding = {}, None
        held = {*self.links, *self.pulley.hung, *(self.sliding.tracks if self.sliding else ())}
        self.free = [i for i in indices if i not in held]
        self.touching = Touching(system)
        self.touching.told |= any(True for _ in contact_marks(system))
        self.rods = self._rigid() if self.rows == 2 else []

    def _rigid(self) -> list[tuple[int, int]]:
        """Return pairs of particles at a constant distance, among the particles without a line and without a link."""
        at = [particle.at for particle in self.system.particles]
        return [(i, j) for i, j in combinations(self.free, 2) if is_rod(self.system, at[i], at[j])]

    @property
    def is_whole(self) -> bool:
        joined = [*self.rods, *((*self.sliding.ropes, *self.sliding.strings) if self.sliding else ())]
        joined += [(self.pulley.hung[0], i) for i in self.pulley.hung[1:]]
        joined += [(i, k) for i, (link, _, _) in self.strings.items() for k, one in self.links.items() if one == link]
        joined += [(i, k) for i, links in self.tied.items() for k, one in self.links.items() if one in links]
        return is_whole(self.system, self.marks, self.links.values(), joined, self.touching)

    @property
    def values(self) -> Mapping[Symbol, Any]:
        found = dict(self.sliding.values) if self.sliding else stance_values(self.system)
        found.update(self.pulley.values)
        for link in self.links.values():
            if (radius := kept_length(self.system, link.length)) is not None:
                found[link.length] = radius
        found.update(self.touching.values)
        if self.impact is not None:
            found.update(moment_drawn(self.system, self.impact))
        hanging = {string: HANGING * link.length for link, _, string in self.strings.values()}
        return {**found, **self._carried_round(), **hanging}

    def _carried_round(self) -> Mapping[Symbol, Any]:
        """Return the time at which a system with a prescribed rotation about the vertical is clearly visible."""
        if (rate := self._rate_round()) is None:
            return {}
        level = len(self.system.coordinates) > 1 and not moving_in(
            self.system, *(p.components[-1] for p in self.system.places)
        )
        angle = ON_A_TABLE if level else BROADSIDE
        return {TIME: angle / rate}

    def _rate_round(self) -> Expr | None:
        """Return the constant rate of the prescribed rotation in space, if there is exactly one such rotation."""
        components = [c for place in self.system.places for c in place.components]
        angles = {f.args[0] for c in components for f in c.atoms(sin, cos)}
        rates = [diff(angle, TIME) for angle in angles if angle.has(TIME)]
        return rates[0] if self.rows == 3 and len(rates) == 1 and not rates[0].has(TIME) else None

    def _axis_of_table(self) -> list[Mark]:
        """Return the vertical axis of the prescribed rotation, if there is one."""
        if (rate := self._rate_round()) is None:
            return []
        return [AxisOfRotation(ImmutableDenseMatrix([0, 0, 0]), ImmutableDenseMatrix([0, 0, 1]), rate, label=rate)]

    def _two_bodies(self) -> Iterable[Mark]:
        """Yield, for two particles, the components of their relative position and the axes of their centre of mass, if
        the coordinates of the system are these components."""
        if self.rows != 2 or len(self.system.particles) != 2 or self.system.bodies:
            return
        one, other = self.system.particles
        coordinates = set(self.system.coordinates)
        middle = Location(
            tuple(
                tidied((one.mass * a + other.mass * b) / (one.mass + other.mass))
                for a, b in zip(one.at.components, other.at.components, strict=True)
            )
        )
        way = Location(tuple(tidied(c) for c in (one.at - other.at).components))
        if not {*middle.components, *way.components} <= coordinates or len({*middle.components}) < 2:
            return
        x, y = way.components
        corner = other.at + Location((x, ZERO))
        yield ConnectionMark(column_of(other.at), column_of(corner), label=x)
        yield ConnectionMark(column_of(one.at), column_of(corner), label=y)
        yield PointMark(column_of(middle))
        yield from self._cartesian(middle)

    @cached_property
    def strings(self) -> Mapping[int, tuple[Link, Location, Symbol]]:
        """Index of a hanging particle -> the link from the hole to the other particle, the position of the hanging
        particle, and the length of the string."""
        found = {}
        for link in self.links.values():
            for i in self.free if self.rows == 3 else ():
                string = through_hole(self.system, link, self.system.particles[i].at)
                if string is not None:
                    found[i] = link, self.system.particles[i].at, string
        return found

    @cached_property
    def tied(self) -> Mapping[int, tuple[Link, ...]]:
        """Index of a particle in space that rods join to particles with links -> these links."""
        held = [link for link in self.links.values() if link.is_constant]
        found: dict[int, tuple[Link, ...]] = {}
        for i in self.free if self.rows == 3 and self.named else ():
            at = self.system.particles[i].at
            if links := tuple(link for link in held if is_rod(self.system, link.end, at)):
                found[i] = links
        return found

    @cached_property
    def marks(self) -> list[Mark]:
        found = [*self._all(), *(launch_marks(self.system, self.start) if self.start else ())]
        if not any(isinstance(mark, AxisOfRotation) for mark in found):
            found += self._axis_of_table()
        if self.impact is not None:  # positions are fixed during an impact, so no displacement is shown
            found = [mark for mark in found if not is_of_the_moment(mark, self.impact)]
            found += impact_marks(self.system, self.impact)
        return list(dict.fromkeys(found))

    def _all(self) -> Iterable[Mark]:
        for each in self.system.between:
            yield from self._between(each)
        yield from dashpot_marks(self.system)
        yield from contact_marks(self.system)
        for placed in getattr(self.system, "bodies", ()):
            yield from placed_marks(self.system, placed)
            yield from self._centre(placed.centre)
        yield from self.touching.marks
        if self.pulley.hung:
            yield from self.pulley.marks()
        for i, j in self.rods:
            yield from self._rod(i, j)
        for i, link in self.links.items():
            yield from turning_marks(self.system, link, self.system.particles[i], self.named)
            if self.rows == 3:
                yield from self._round(link)
        yield from self._rods()
        yield from self._two_bodies()
        if self.sliding:
            yield from self.sliding.marks()
        for link, below, _ in self.strings.values():
            along = tuple(column_of(place) for place in (link.end, link.start, below))
            yield RopeMark(along, (ZERO, ZERO, ZERO))
        for i in self.free:
            if i in self.strings or i in self.tied or any(i in pair for pair in self.rods):
                yield ParticleMark(column_of(self.system.particles[i].at), label=self.system.particles[i].mass)
                continue
            yield from self._free(self.system.particles[i])
        if self.weights and self.system.weights:
            yield from self._weights()
        elif self.system.weights:
            yield GravityMark(downwards(self.rows), label=self.system.gravity)
        yield from self._fields()

    def _rod(self, i: int, j: int) -> Iterable[Mark]:
        """Yield a rod from the lower particle to the upper particle, with its angle."""
        low, up = sorted((self.system.particles[k].at for k in (i, j)), key=lambda at: numeric(at.components[1]))
        link = Link(low, up, sqrt(tidied(Add(*(c**2 for c in (up - low).components)))), True)
        yield BarMark(column_of(link.start), column_of(link.end), label=link.length)
        yield from angle_marks(self.system, link)
        for end in (low, up):
            if self.system.weights and not moving_in(self.system, end.components[1]):
                yield FloorMark((column_of(end),))

    def _round(self, link: Link) -> Iterable[Mark]:
        """Yield the circle of a particle about a vertical axis, and this axis; otherwise the curves of the particle."""
        *across, height = link.start.components
        if (
            link.is_constant
            or is_fixed(self.system, link.start)
            and TIME in moving_in(self.system, *link.way.components)
        ):
            return
        if any(across) or height not in {*self.system.coordinates, ZERO}:
            yield from self._ways(link.end)
            return
        for q in moving_in(self.system, *link.way.components):
            if self.system.coordinates.get(q) == "angle":
                yield WayMark(column_of(link.end), q, -pi, pi)
        if height in self.system.coordinates:
            yield Axis(column_of(link.start) * 0, column_of(Rational(5, 3) * link.start), label=height)

    def _rods(self) -> Iterable[Mark]:
        """Yield, in space, rods from particles on rods to further particles at a constant distance."""
        for i, links in self.tied.items():
            for link in links:
                yield BarMark(column_of(link.end), column_of(self.system.particles[i].at))

    def _fields(self) -> Iterable[Mark]:
        """Yield the arrows of uniform fields, next to all other marks."""
        beside = 0
        for each in self.system.charges:
            for field in (each.electric, each.magnetic):
                strength = [c for c in field if c != 0] if len(field) == self.rows else []
                if strength and not moving_in(self.system, *field):
                    label = strength[0] if len(strength) == 1 and strength[0].is_Symbol else None
                    yield FieldMark(ImmutableDenseMatrix(field), beside, label=label)
                    beside += 1

    def _weights(self) -> Iterable[Mark]:
        down, gravity = downwards(self.rows), self.system.gravity
        for particle in self.system.particles:
            yield Weight(column_of(particle.at), down, WEIGHT, False, label=particle.mass * gravity)
        for placed in self.system.bodies:
            centre = column_of(with_its_shape(placed).centre)
            yield Weight(centre, down, WEIGHT, False, label=placed.body.mass * gravity)

    def _moves(self, place: Location) -> bool:
        """Return whether the point moves or is the position of a particle, rather than a fixed end."""
        return not is_fixed(self.system, place) or any(same(place, particle.at) for particle in self.system.particles)

    # --- forces between two points ---

    def _between(self, each: Central) -> Iterable[Mark]:
        a, b = column_of(each.start), column_of(each.end)
        elastic = is_spring(each)
        if elastic:
            yield SpringMark(a, b, label=tidied(diff(explicit(each.energy), each.distance, 2)))
        for end, way in ((each.start, b - a), (each.end, a - b)):
            if self._moves(end):
                continue
            if elastic:
                turns = any(same(link.start, end) for link in self.links.values())
                yield FixedEnd(column_of(end), downwards(self.rows) if turns else way)
            else:
                yield ParticleMark(column_of(end))
                yield from self._orbit(each, end)
        linked = {(link.start.components, link.end.components) for link in self.links.values()}
        ends = (each.start.components, each.end.components)
        if not elastic and not linked & {ends, ends[::-1]}:
            yield ConnectionMark(a, b)

    def _orbit(self, each: Central, centre: Location) -> Iterable[Mark]:
        """Yield an ellipse about the centre of an inverse-square force."""
        other = each.end if same(each.start, centre) else each.start
        link = next((link for link in self.links.values() if same(link.end, other) and same(link.start, centre)), None)
        turned = angle_of_link(self.system, link) if link is not None and self.rows == 2 else None
        if link is None or turned is None or each.distance in tidied(each.pull * each.distance**2).free_symbols:
            return
        angle, _ = turned
        u = scalar("u")
        size = link.length * (1 + ECCENTRICITY * cos(angle)) / (1 + ECCENTRICITY * cos(u))
        e = explicit(ImmutableDenseMatrix(tuple(tidied(c / link.length) for c in link.way.components)))
        yield WayMark(column_of(centre) + size * e.xreplace({angle: u}), u, -pi, pi)

    # --- free particles ---

    def _free(self, particle: Particle) -> Iterable[Mark]:
        at = particle.at
        carried = roller_with(self.system, particle)
        if carried is not None:
            yield from carrying_marks(self.system, particle, *carried)
            return
        yield ParticleMark(column_of(at), label=particle.mass)
        plain = [c for c in at.components if c in self.system.coordinates]
        if len(plain) == self.rows:
            yield from self._cartesian(at)
        else:
            yield from self._ways(at)

    def _centre(self, at: Location) -> Iterable[Mark]:
        """Yield, for a leaning body, the distances of its centre from the axes, if these are its coordinates."""
        if self.rows != 2 or not self.touching.shown or not all(c in self.system.coordinates for c in at.components):
            return
        x, y = at.components
        yield ConnectionMark(ImmutableDenseMatrix([ZERO, y]), column_of(at), label=x)
        yield ConnectionMark(column_of(at), ImmutableDenseMatrix([x, ZERO]), label=y)

    def _cartesian(self, at: Location) -> Iterable[Mark]:
        for k, q in enumerate(at.components):
            ahead = Location(tuple(q if i == k else ZERO for i in range(self.rows)))
            origin, end = column_of(ahead) * 0, column_of(Rational(4, 3) * ahead)
            yield Axis(origin, end, label=q)
            if self.rows == 2:
                yield ConnectionMark(column_of(at), column_of(ahead))

    def _ways(self, at: Location) -> Iterable[Mark]:
        """Yield the curve of a point for each coordinate; a single curve is drawn as a wire."""
        moving = [q for q in self.system.coordinates if q in moving_in(self.system, *at.components)]
        for q in moving if len(moving) < self.rows else ():
            ends = (-pi, pi) if self.system.coordinates[q] == "angle" else (-FAR * q, FAR * q)
            yield WayMark(column_of(at), q, *ends, "wire" if len(moving) == 1 else "trace")
        if len(moving) == 1 and moving[0] in at.components:
            beside = Location(tuple(ZERO if c == moving[0] else c for c in at.components))
            rest = Location(tuple(c.xreplace({moving[0]: ZERO}) for c in at.components))
            yield ConnectionMark(column_of(beside), column_of(at), label=moving[0])
            yield ConnectionMark(column_of(rest), column_of(beside))
