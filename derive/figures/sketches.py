"""The drawing of a system, from its description: `sketch("pendulum", System(...))`.

The bodies, springs, strings, rods, wires, surfaces and joints of the description are drawn. A particle that no drawn
part holds is drawn with lines and curves that show its coordinates. No part is guessed.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import Any

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Pow, Rational, Symbol, cos, diff, pi, sin, sqrt
from sympy.matrices import MatrixBase

from derive.algebra.expressions import TIME, Relation, as_expr, explicit, rate, scalar
from derive.algebra.tidy import tidied
from derive.figures.annotations import AppliedForce, Axis, AxisOfRotation, LengthMark, Line, PointMark, Weight
from derive.figures.connections import Connections
from derive.figures.contacts import contact_marks
from derive.figures.elements import CLEAR
from derive.figures.links import Link, angle_of_link, is_fixed, is_spring, link_to, moving_in, same
from derive.figures.marks import Drawing, Mark, Marks, Surface
from derive.figures.parts import BLOCK, BOB, BlockMark, ConnectionMark, ParticleMark, SpringMark, WheelMark
from derive.figures.placed_bodies import pivot_of, placed_marks, placed_outline, with_its_shape
from derive.figures.positions import column_of
from derive.figures.scenes import drawing
from derive.figures.surroundings import HATCH, DistanceMark, FieldMark, FixedEnd, GravityMark, OriginMark, WayMark
from derive.figures.tops import stance_values
from derive.figures.turning import downwards, link_marks, moving_end, natural_length
from derive.figures.velocities import Moment, impact_marks, is_of_the_moment, later_marks, launch_marks, moment_drawn
from derive.mechanics.bodies.placed import PointOfBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.forces import Damper, GivenForce
from derive.mechanics.model.joints import DragAlong
from derive.mechanics.model.no_slip import Rolling
from derive.mechanics.model.surfaces import Plane, dot
from derive.mechanics.model.system import Central, Particle, System

__all__ = ["sketch"]

ZERO = Integer(0)
FAR = Rational(8, 5)  # a curve along a coordinate is drawn up to FAR times the drawn value of the coordinate
ECCENTRICITY = Rational(1, 2)
WEIGHT = Rational(2, 5)  # length of the arrow of a weight, relative to the size of the drawing
BROADSIDE = 23 * pi / 36  # rotation angle at which a rotating vertical plane faces the viewer
ON_A_TABLE = 17 * pi / 36  # rotation angle of two horizontal axes at which all axes are well apart in the drawing
ALONE = (ParticleMark, PointMark, ConnectionMark, LengthMark, DistanceMark, FieldMark, GravityMark)
UNDER_FLOOR = 16.0  # additional shift, in points, that puts a dimension line below the floor under a block
OVER_LABEL = 9.0  # the height of the label of a spring, in points
APART = 5.0  # half the distance between the arrows of two forces at one place, in points
BENEATH = 18.0  # the distance between two dimension lines, in points


def sketch(
    key: str,
    system: System,
    *more: Marks,
    values: Mapping[Any, Any] | None = None,
    named: Sequence[Location] = (),
    weights: Any = False,
    start: Moment | None = None,
    impact: Moment | None = None,
) -> Drawing | None:
    """Return a drawing of a system from its description; the drawing is recorded for the problem.

    Return None if the drawing would not show the whole system and no marks are added.

    key       the name of the drawing, for `drawings:` in the problem
    system    particles, bodies, springs, connections, forces and weights
    more      marks that are drawn in addition to the marks of the description
    values    numbers or proportions for symbols in the drawing
    named     positions of further parts, such as a pivot
    weights   whether an arrow shows the weight of each particle and body, in place of one arrow for gravity. A number
              is the length of these arrows, relative to the size of the drawing
    start     the initial state of a motion
    impact    the state at an impact; if it is given, the impact is drawn
    """
    scene = _Scene(system, named, weights, start, impact)
    if not more and not scene.is_whole:
        return None
    values = {**scene.values, **(values or {})}
    return drawing(key, scene.marks, *more, values=values, left_out=scene.left_out, undrawn=scene.undrawn)


def things_of(system: System, named: Sequence[Location] = ()) -> tuple[list[Mark], Mapping[Symbol, Any]] | None:
    """Return the marks of the sketch that show the parts of the system and its surroundings, without their labels, and
    the values that replace symbols. Return None if a sketch would not show the whole system.

    Dimension lines, axes, angles, and the arrows of gravity and of fields are left out.
    """
    scene = _Scene(system, named)
    if not scene.is_whole or scene.left_out:
        return None
    return [replace(mark, label=None) for mark in scene.marks if scene.is_thing(mark)], scene.values


class _Scene:
    """The marks of a system, and the numbers that replace its symbols in the drawing."""

    def __init__(
        self,
        system: System,
        named: Sequence[Location] = (),
        weights: Any = False,
        start: Moment | None = None,
        impact: Moment | None = None,
    ):
        self.system, self.weights, self.start, self.impact = system, weights, start, impact
        self.named = named
        self.rows = len(system.places[0].components)
        self.connections = Connections(system, start.at if start is not None else None)
        self.links = {
            i: link for i in range(len(system.particles)) if (link := link_to(system, i, tuple(named))) is not None
        }

    # --- completeness ---

    @property
    def left_out(self) -> list[Relation]:
        """Return the constraints that are given as formulas, which the drawing cannot show."""
        return [each.relation for each in self.system.constraints if not each.enforcer]

    @property
    def is_whole(self) -> bool:
        """Whether the drawing shows the whole system, and more than separate particles and bodies."""
        return (
            self.connections.is_possible
            and self._bodies_are_seen()
            and self._rolling_is_seen()
            and self._energies_are_seen()
            and self._shows_something()
        )

    def _bodies_are_seen(self) -> bool:
        return all(
            placed_outline(with_its_shape(placed)) or self.rows == 3 and not same(placed.at, placed.centre)
            for placed in self.system.bodies
        )

    def _rolling_is_seen(self) -> bool:
        """Whether the drawing shows the surfaces on which bodies roll."""
        rolling = [r for each in self.system.conditions if (r := each.fact(Rolling)) is not None]
        drawn = [touch.of for touch in self.connections.contacts if self.connections.is_drawn(touch.surface)]
        if all(any(getattr(of, "body", None) is r.body.body for of in drawn) for r in rolling):
            return True
        return bool(list(contact_marks(self.system))) and (self.rows == 2 or len(self.system.conditions) == 1)

    def _touching_bodies(self) -> list[Any]:
        return [touch for touch in self.connections.contacts if hasattr(touch.of, "body") and self.rows == 2]

    def _energies_are_seen(self) -> bool:
        charged = len([each for each in self.system.charges if any(each.electric)])
        own = self.system.stored[: len(self.system.stored) - charged]
        many = len(self.system.particles) + len(self.system.bodies) > 1 or self.system.bodies
        moving = self.system.coordinates
        return not many or all(
            diff(each.energy, p, q) == 0 for each in own for p in moving for q in moving_in(self.system, each.energy)
        )

    def _shows_something(self) -> bool:
        """Whether the drawing shows more than particles and bodies with their angles and positions."""
        outlines = [mark for placed in self.system.bodies for mark in placed_outline(with_its_shape(placed))]
        if any(not isinstance(mark, ALONE) and mark not in outlines for mark in self.marks):
            return True
        if self.left_out:
            return True
        acts = self.system.weights or self.system.constraints or self.system.conditions or self.system.given_forces
        return bool(
            not self.system.bodies
            and (self.links or self.system.between)
            or any(pivot_of(self.system, placed) for placed in self.system.bodies if self.rows == 2)
            or self.rows == 3
            and outlines
            and not acts
        )

    # --- numbers ---

    @cached_property
    def values(self) -> Mapping[Symbol, Any]:
        found: dict[Symbol, Any] = dict(stance_values(self.system))
        found |= {letter: value for letter, value in self.connections.values.items() if letter not in found}
        if self.impact is not None:
            found.update(moment_drawn(self.system, self.impact))
        return {**found, **self._carried_round()}

    def _carried_round(self) -> Mapping[Symbol, Any]:
        """Return a mapping with the time at which a system in space with one constant prescribed rate of rotation is
        drawn. The mapping is empty for any other system."""
        if (rate := self._rate_round()) is None:
            return {}
        level = len(self.system.coordinates) > 1 and not moving_in(
            self.system, *(p.components[-1] for p in self.system.places)
        )
        angle = ON_A_TABLE if level else BROADSIDE
        return {TIME: angle / rate}

    def _rate_round(self) -> Expr | None:
        """Return the constant rate of the prescribed rotation in space, if there is one; otherwise None."""
        components = [c for place in self.system.places for c in place.components]
        angles = {f.args[0] for c in components for f in c.atoms(sin, cos)}
        rates = [diff(angle, TIME) for angle in angles if angle.has(TIME)]
        return rates[0] if self.rows == 3 and len(rates) == 1 and not rates[0].has(TIME) else None

    # --- marks ---

    @cached_property
    def marks(self) -> list[Mark]:
        found = [*self._all(), *(launch_marks(self.system, self.start) if self.start else ())]
        if not any(isinstance(mark, AxisOfRotation) for mark in found):
            found += self._axis_of_table()
        # The drawing of an impact omits angles and distances that are zero at the impact, distances with a given rate,
        # and marks of origins.
        if self.impact is not None:
            found = [
                mark for mark in found if not (isinstance(mark, OriginMark) or is_of_the_moment(mark, self.impact))
            ]
            found += impact_marks(self.system, self.impact)
            found += later_marks(self.system, self.impact, self._at_any_time)
        return list(dict.fromkeys([*found, *self._between_supports(found)]))

    @property
    def _at_any_time(self) -> list[Mark]:
        """The marks of the system without its impact."""
        return _Scene(self.system, self.named).marks

    def _between_supports(self, marks: Iterable[Mark]) -> Iterable[Mark]:
        """Yield dimension lines for distances between supports at the same height. A line is above the supports if all
        masses are lower and one of them can move vertically; otherwise it is below."""
        if self.rows != 2:
            return
        number = self.connections.number
        places = [Location(tuple(mark.at)) for mark in marks if isinstance(mark, FixedEnd) and any(mark.away)]
        places = sorted(dict.fromkeys(places), key=lambda place: [number(c) for c in place.components[::-1]])
        heights = [at.components[1] for _, at in self.system.masses]
        for one, other in pairwise(places):
            x, y = (tidied(c) for c in (other - one).components)
            if y != 0 or not x.as_coeff_Mul()[1].is_Symbol or moving_in(self.system, x):
                continue
            above = max((number(c - one.components[1]) for c in heights), default=0.0)
            is_level = not any(moving_in(self.system, c) for c in heights)
            aside = 1 if above < 0 and not is_level else -1
            room = UNDER_FLOOR if is_level else HATCH
            way = ImmutableDenseMatrix([0, aside])
            yield LengthMark(column_of(one), column_of(other), way, beyond=room, label=x)

    def _all(self) -> Iterable[Mark]:
        for each in self.system.between:
            yield from self._between(each)
        yield from self.connections.marks
        yield from self._rolling()
        for placed in self.system.bodies:
            yield from placed_marks(self.system, placed)
            if isinstance(placed.at, PointOfBody):
                yield FixedEnd(column_of(placed.at), column_of(placed.at) * 0, True)  # a hinge between two bodies
        for i, particle in enumerate(self.system.particles):
            yield from self._particle(i, particle)
        relative = list(self._two_bodies())
        yield from relative
        if self.rows == 2 and not relative and self.impact is None:
            yield from self._displacements()
        if self.weights and self.system.weights:
            yield from self._weights()
        elif self.system.weights:
            yield GravityMark(downwards(self.rows), label=self.system.gravity)
        yield from self._fields()
        if self.impact is None:
            yield from self._applied()

    def _rolling(self) -> Iterable[Mark]:
        return () if self._touching_bodies() else contact_marks(self.system)

    def _axis_of_table(self) -> list[Mark]:
        if (rate := self._rate_round()) is None:
            return []
        return [AxisOfRotation(ImmutableDenseMatrix([0, 0, 0]), ImmutableDenseMatrix([0, 0, 1]), rate, label=rate)]

    def is_thing(self, mark: Mark) -> bool:
        """Whether a mark shows a thing: a part of the system, its surroundings, a point, or a line that is drawn to a
        particle in place of a rod."""
        if isinstance(mark, Line):
            return mark.pen == "edge"
        if isinstance(mark, ConnectionMark):
            return mark.label is not None and not moving_in(self.system, mark.label)
        if isinstance(mark, WayMark):
            return mark.pen != "trace"
        return isinstance(mark, Surface | PointMark) and not isinstance(mark, OriginMark)

    # --- particles ---

    def _particle(self, i: int, particle: Particle) -> Iterable[Mark]:
        block = self.connections.block(particle)
        if block is not None:
            yield from block
            return
        charge = next((each.charge for each in self.system.charges if same(each.at, particle.at)), None)
        yield ParticleMark(column_of(particle.at), charge, label=particle.mass)
        link = self.links.get(i)
        if link is not None and not self._is_drawn(particle, link):
            marks = link_marks(self.system, link)
            yield from self._along_wire(link, marks) if self.connections.is_on_wire(particle.at) else marks
            if self.rows == 3:
                yield from self._round(link)
        elif not self._is_held(particle, link):
            plain = [c for c in particle.at.components if c in self.system.coordinates]
            yield from self._cartesian(particle.at) if len(plain) == self.rows else self._ways(particle.at)

    def _along_wire(self, link: Link, marks: Iterable[Mark]) -> Iterable[Mark]:
        """Yield the marks of the link to a bead on a wire. The path of the bead is left out, because the wire shows
        it."""
        moving = moving_in(self.system, *link.way.components) - {TIME}
        is_straight = not link.is_constant and not any(diff(c, q, 2) for c in link.way.components for q in moving)
        turned = angle_of_link(self.system, link)
        side = None if turned is None else -column_of(turned[1])
        for mark in marks:
            if isinstance(mark, ConnectionMark) and is_straight and mark.label == link.length:
                yield DistanceMark(mark.start, mark.end, side, label=mark.label)
            elif not isinstance(mark, WayMark):
                yield mark

    def _is_held(self, particle: Particle, link: Link | None) -> bool:
        return self.connections.holds(particle) or link is not None and self.connections.runs_along(link)

    def _is_drawn(self, particle: Particle, link: Link) -> bool:
        """Whether a connection is drawn in place of the link."""
        return self._is_held(particle, link) if link.is_constant else self.connections.runs_along(link)

    def _round(self, link: Link) -> Iterable[Mark]:
        """Yield the curves on which the particle at the end of a link moves."""
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

    def _cartesian(self, at: Location, *, measured: bool = False) -> Iterable[Mark]:
        """Yield the axes, and the dashed lines from a place to them, with their lengths if `measured`."""
        for k, q in enumerate(at.components):
            ahead = Location(tuple(q if i == k else ZERO for i in range(self.rows)))
            origin, end = column_of(ahead) * 0, column_of(Rational(4, 3) * ahead)
            yield Axis(origin, end, label=q)
            if self.rows == 2:
                yield ConnectionMark(column_of(at), column_of(ahead), label=at.components[1 - k] if measured else None)
        if self.rows == 3:  # down to the plane of the first two axes, and from there to these axes
            x, y, _ = at.components
            foot = column_of(Location((x, y, ZERO)))
            yield ConnectionMark(column_of(at), foot)
            yield from (ConnectionMark(foot, column_of(Location(end))) for end in ((x, ZERO, ZERO), (ZERO, y, ZERO)))

    def _ways(self, at: Location) -> Iterable[Mark]:
        """Yield the curve of a point along each of its coordinates, except straight lines and wires. There are curves
        only if the number of coordinates of the point is less than 2 in a plane or 3 in space. In space, also yield
        dashed lines to a point that moves along one axis."""
        moving = [q for q in self.system.coordinates if q in moving_in(self.system, *at.components)]
        for q in moving if len(moving) < self.rows else ():
            ends = (-pi, pi) if self.system.coordinates[q] == "angle" else (-FAR * q, FAR * q)
            if any(diff(c, q, 2) != 0 for c in at.components) and not self.connections.is_on_wire(at):
                yield WayMark(column_of(at), q, *ends)
        if self.rows == 3 and len(moving) == 1 and moving[0] in at.components:
            beside = Location(tuple(ZERO if c == moving[0] else c for c in at.components))
            rest = Location(tuple(c.xreplace({moving[0]: ZERO}) for c in at.components))
            yield ConnectionMark(column_of(beside), column_of(at), label=moving[0])
            yield ConnectionMark(column_of(rest), column_of(beside))

    def _two_bodies(self) -> Iterable[Mark]:
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
        yield from self._cartesian(middle, measured=True)

    # --- displacements ---

    def _displacements(self) -> Iterable[Mark]:
        shown: set[Symbol] = set()
        for q, kind in self.system.coordinates.items():
            found = self._displaced(q) if kind == "length" and not self._is_shown(q) else None
            if found is not None:
                start, at = found
                shown.add(q)
                yield from self._with_natural_length(self._dimension(q, start, at, len(shown)), start)

    def _with_natural_length(self, mark: Mark, start: Location) -> Iterable[Mark]:
        """Yield a dimension line that begins at `start`. If the line shows the extension or the length of the only
        spring, also yield the natural length."""
        springs = [each for each in self.system.between if is_spring(each)]
        ends = [end for each in springs for end in (each.start, each.end) if not self._moves(end)]
        length = natural_length(self.system, springs[0]) if len(springs) == len(ends) == 1 else None
        if length is not None:
            ways = [tidied(c) for c in (start - ends[0]).components]
            if [abs(c) for c in ways if c != 0] == [length] and isinstance(mark, DistanceMark):
                spring, fixed = springs[0], ends[0]
                covered = self._covered(spring.end if same(spring.start, fixed) else spring.start)
                back = column_of(fixed - start)
                mark = replace(mark, off=mark.off + OVER_LABEL, back=back, moved=(covered, covered))
                yield replace(mark, start=column_of(fixed), end=column_of(start), label=length, moved=(0.0, covered))
            elif not any(ways) and isinstance(mark, LengthMark) and isinstance(mark.aside, MatrixBase):
                way = mark.end - mark.start
                far = mark.start + length / sqrt(tidied(way.dot(way))) * way
                yield replace(mark, end=far, aside=-mark.aside, label=length)
        yield mark

    def _is_shown(self, q: Symbol) -> bool:
        """Whether another mark has the coordinate as its label: an axis, or the line of a polar coordinate."""
        free = [p.at for i, p in enumerate(self.system.particles) if i not in self.links]
        axes = any(q in at.components and self._is_cartesian(at) for at in free)
        links = any(q in moving_in(self.system, link.length) for link in self.links.values())
        return axes or links

    def _is_cartesian(self, at: Location) -> bool:
        particle = next(p for p in self.system.particles if p.at is at)
        is_free = self.connections.block(particle) is None and not self.connections.holds(particle)
        return is_free and all(c in self.system.coordinates for c in at.components)

    def _displaced(self, q: Symbol) -> tuple[Location, Location] | None:
        """Return the two ends of the dimension line of a length q; None if q cannot be shown in this way.

        The ends are the two ends of a piece of a rope, or the positions of one point at q = 0 and at the drawn value of
        q. The point is a mass, the point at which a body is placed, or the end of a string or a rod. Along the
        dimension line, the position at q = 0 must have a constant distance from the origin or from another drawn
        place. Otherwise the line would seem to measure a different length.
        """
        found = []
        if (piece := self.connections.rope_piece(q)) is not None:
            return piece
        for at in self._places:
            way = Location(tuple(diff(c, q) for c in at.components))
            if any(way.components) and is_fixed(self.system, way) and tidied(Add(*(c**2 for c in way.components))) == 1:
                start = Location(tuple(c.xreplace({q: ZERO}) for c in at.components))
                if not self._is_measurable(start, way):
                    continue
                found.append((len(moving_in(self.system, *at.components)), start, at))
        if not found:
            return None
        _, start, at = min(found, key=lambda each: each[0])
        return start, at

    @property
    def _places(self) -> list[Location]:
        """The places of masses, the points at which bodies are placed, and the ends of strings, of rods and of lines
        that are drawn in place of rods.
        """
        masses = [*(at for _, at in self.system.masses), *(placed.at for placed in self.system.bodies)]
        links = [link for i, link in self.links.items() if not self._is_drawn(self.system.particles[i], link)]
        ends = [line.places[k] for line in self.connections.lines for k in (0, -1)]
        return [*masses, *(link.start for link in links), *ends]

    def _is_measurable(self, start: Location, way: Location) -> bool:
        """Whether a place has a constant distance, in the direction of a unit vector, from the origin or from a drawn
        place."""
        between = [at for line in self.connections.lines for at in line.places]
        springs = [end for each in self.system.between for end in (each.start, each.end)]
        gaps = [start, *(start - place for place in (*self._places, *between, *springs))]
        return any(not moving_in(self.system, tidied(dot(gap, way))) for gap in gaps)

    def _dimension(self, q: Symbol, start: Location, at: Location, before: int) -> Mark:
        x, y = (tidied(c) for c in (at - start).components)
        touch = next((each for each in self.connections.contacts if self._touches(each, at)), None)
        if touch is not None and hasattr(touch.surface, "unit_normal"):
            on_slope = x != 0 and y != 0
            is_carrier = any(each.surface.of == touch.of for each in self.connections.contacts)
            if isinstance(touch.of, Particle) and touch.surface.of is None and not on_slope and not is_carrier:
                off = max(BLOCK[1] / 2, self.connections.height_of_dashpots) + CLEAR
                return DistanceMark(column_of(start), column_of(at), column_of(touch.normal), off, label=q)
            if on_slope:
                if isinstance(touch.of, Particle):
                    ends = column_of(start), column_of(at)
                    return DistanceMark(*ends, column_of(touch.normal), BLOCK[1] + CLEAR, label=q)
                down = touch.at - at
                if tidied(x * down.components[1] - y * down.components[0]) == 0:  # the distance from the surface
                    aside = ImmutableDenseMatrix([-down.components[1], down.components[0]])
                    return LengthMark(column_of(touch.at), column_of(at), aside, self._clear(at), label=q)
                return LengthMark(column_of(start + down), column_of(at + down), column_of(-touch.normal), label=q)
        beyond = BENEATH * before if self._is_on_carrier(at) else 0.0
        # A horizontal dimension line is above a place on an inclined plane, and below any other place.
        below = -1 if touch is None or not self._is_inclined(touch.surface) else 1
        aside = ImmutableDenseMatrix([0, below] if y == 0 else [self._free_side(at), 0])
        return LengthMark(column_of(start), column_of(at), aside, self._clear(at), beyond, label=q)

    def _is_inclined(self, surface: Any) -> bool:
        return isinstance(surface, Plane) and all(tidied(c) != 0 for c in surface.unit_normal.components)

    def _touches(self, touch: Any, at: Location) -> bool:
        if touch.of is None:
            return False
        own = touch.of.centre if hasattr(touch.of, "centre") else touch.of.at
        return same(own, at)

    def _free_side(self, at: Location) -> int:
        """Return the side of a vertical dimension line, 1 (right) or -1 (left), away from the other masses."""
        others = [place for _, place in self.system.masses if not same(place, at)]
        ways = [self.connections.number((place - at).components[0]) for place in others]
        return 1 if not ways or max(ways) < 0 or min(ways) > -1e-9 and max(ways) < 1e-9 else -1

    def _is_on_carrier(self, at: Location) -> bool:
        """Whether the mass at a place carries a surface, or touches a surface that a particle carries. Successive
        dimension lines of such masses are at different distances."""
        carriers = [each for each in self.connections.contacts if isinstance(each.surface.of, Particle)]
        return any(same(at, each.at) or same(at, each.surface.of.at) for each in carriers)

    def _clear(self, at: Location) -> Expr:
        """The distance of a dimension line from a place: the radius of a disc with its centre there, or zero."""
        outlines = [mark for placed in self.system.bodies for mark in placed_outline(with_its_shape(placed))]
        wheels = (mark for mark in outlines if isinstance(mark, WheelMark) and mark.radius is not None)
        return next((mark.radius for mark in wheels if same(Location(tuple(mark.centre)), at)), ZERO)

    # --- forces ---

    def _fields(self) -> Iterable[Mark]:
        """Yield the arrows of uniform electric and magnetic fields, beyond all other marks. Arrows of different
        directions start at one point."""
        shown: list[Sequence[Expr]] = []
        fields = [field for each in self.system.charges for field in (each.electric, each.magnetic)]
        fields = [field for field in fields if len(field) == self.rows and any(field)]
        fields = [field for field in fields if not moving_in(self.system, *field)]
        rises = any(field[-1] != 0 for field in fields)
        for field in fields:
            strength = [c for c in field if c != 0]
            label = strength[0] if len(strength) == 1 and strength[0].is_Symbol else None
            way = ImmutableDenseMatrix(field)
            parallel = [one for one in shown if ImmutableDenseMatrix.hstack(way, ImmutableDenseMatrix(one)).rank() == 1]
            yield FieldMark(way, len(parallel), rises, label=label)
            shown.append(field)

    def _applied(self) -> Iterable[Mark]:
        """Yield the arrows of given forces and drags. Arrows at the same place are side by side."""
        forces = [(each, drawn) for each in self.system.given_forces if (drawn := self._drawn_force(each)) is not None]
        drags = [(each, drawn) for each in self.system.dampers if (drawn := self._drawn_drag(each)) is not None]
        for each, (way, size) in [*forces, *drags]:
            place = Location(tuple(each.place))
            is_drag, clear = isinstance(each, Damper), self._covered(place) or BOB
            aside = (
                APART if sum(same(place, Location(tuple(other.place))) for other, _ in [*forces, *drags]) > 1 else 0.0
            )
            yield AppliedForce(column_of(place), way, 1, False, is_drag, aside, label=size, clear=clear)

    def _drawn_drag(self, each: Damper) -> tuple[ImmutableDenseMatrix, Expr] | None:
        """Return the direction and the magnitude of the arrow of a drag; None if the drag is not drawn."""
        if isinstance(each, DragAlong) or self.rows != 2 or len(each.at) != self.rows:
            return None
        moving = moving_in(self.system, *each.place)
        if len(moving) != 1 or moving == {TIME}:
            return None
        (q,) = moving
        way = ImmutableDenseMatrix([-diff(c, q) for c in each.place])
        return (way, each.constant * rate(q)) if way.dot(way) == 1 and not moving_in(self.system, *way) else None

    def _drawn_force(self, each: GivenForce) -> tuple[ImmutableDenseMatrix, Expr] | None:
        """Return the direction and the magnitude of the arrow of a given force; None if the force is not drawn.

        A force whose magnitude contains a coordinate is left out, because the sign of the label could be wrong in the
        drawn state. A force with several components is left out if its magnitude contains a root.
        """
        if len(each.at) != self.rows or self._is_friction(each):
            return None
        at_start = [[diff(c, TIME, n).subs(TIME, 0) for c in each.components] for n in (0, 1)]
        drawn = next((_along_axis(way) for way in at_start if any(way)), None)
        size = _magnitude(each.components)
        if drawn is None or size is None or moving_in(self.system, size) - {TIME}:
            return None
        return drawn, size

    def _is_friction(self, each: GivenForce) -> bool:
        unknown = {constraint.force for constraint in self.system.constraints}
        return bool(unknown & ImmutableDenseMatrix(each.components).free_symbols)

    @property
    def undrawn(self) -> list[tuple[str, Any]]:
        """Return the given forces, torques and drags that the drawing does not show: their kinds, and their values or
        constants. The caption of the drawing states them. The opposite of a force between two bodies is left
        out, and so are all given forces and torques in the drawing of an impact."""
        found: list[tuple[str, Any]] = []
        opposites = {each.opposite for each in self.system.given_forces if each.opposite is not None}
        for each in self.system.given_forces if self.impact is None else ():
            if self._is_friction(each) or self._drawn_force(each) is not None or each in opposites:
                continue
            if not any(as_expr(c) != 0 for c in each.components):
                continue
            (at, *more) = each.at
            sort = "force" if more or self.system.coordinates.get(at) != "angle" else "torque"
            values = tuple(each.components)
            found.append((sort, values[0] if len(values) == 1 else values))
        hidden = [each for each in self.system.dampers if not isinstance(each, DragAlong)]
        drags = [each for each in hidden if self.impact is not None or self._drawn_drag(each) is None]
        return [*found, *(("drag", each.constant) for each in drags)]

    def _weights(self) -> Iterable[Mark]:
        down, gravity = downwards(self.rows), self.system.gravity
        size = WEIGHT if self.weights is True else self.weights
        for particle in self.system.particles:
            yield Weight(column_of(particle.at), down, size, False, label=particle.mass * gravity)
        for placed in self.system.bodies:
            centre = column_of(with_its_shape(placed).centre)
            yield Weight(centre, down, size, False, label=placed.body.mass * gravity)

    def _moves(self, place: Location) -> bool:
        """Whether an end of a spring or of a central force moves or is the position of a particle; all other ends are
        fixed."""
        return not is_fixed(self.system, place) or any(same(place, particle.at) for particle in self.system.particles)

    def _is_free(self, end: Location) -> bool:
        """Whether no mass is at the end of a spring."""
        return not any(same(end, at) for _, at in self.system.masses)

    def _covered(self, end: Location) -> float:
        """Return the length, in points, that a block covers at this end of a spring."""
        there = [particle for particle in self.system.particles if same(particle.at, end)]
        blocks = [mark for particle in there for mark in self.connections.block(particle) or ()]
        return max((BLOCK[0] / 2 for mark in blocks if isinstance(mark, BlockMark)), default=0.0)

    def _between(self, each: Central) -> Iterable[Mark]:
        """Yield a spring with its supports, or the marks of another central force."""
        a, b = column_of(each.start), column_of(each.end)
        elastic = is_spring(each)
        if elastic:
            constant = tidied(diff(explicit(each.energy), each.distance, 2))
            yield SpringMark(a, b, (self._covered(each.start), self._covered(each.end)), label=constant)
        for end, way in ((each.start, b - a), (each.end, a - b)):
            if not elastic and is_fixed(self.system, end):
                yield from () if self._moves(end) else (PointMark(column_of(end)),)
                yield from self._orbit(each, end)
            elif self._moves(end):
                yield from moving_end(self.system, end, False) if elastic and self._is_free(end) else ()
            elif elastic and self._is_nail(way):
                yield PointMark(column_of(end))
            elif elastic:
                turns = any(same(link.start, end) for link in self.links.values())
                yield FixedEnd(column_of(end), downwards(self.rows) if turns else way)
        linked = {(link.start.components, link.end.components) for link in self.links.values()}
        ends = (each.start.components, each.end.components)
        if not elastic and not linked & {ends, ends[::-1]}:
            yield ConnectionMark(a, b)

    def _is_nail(self, way: ImmutableDenseMatrix) -> bool:
        """Whether a spring is held by a nail in a horizontal plane, so that its other end moves round the nail."""
        moving = self.system.coordinates
        is_round = len([c for c in way if moving_in(self.system, c) - {TIME}]) > 1
        return not self.system.weights and is_round and not any(c.xreplace(dict.fromkeys(moving, ZERO)) for c in way)

    def _orbit(self, each: Central, centre: Location) -> Iterable[Mark]:
        """Yield an ellipse with the centre of an inverse-square force at one focus; nothing for any other force."""
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


def _along_axis(way: Sequence[Expr]) -> ImmutableDenseMatrix:
    """Replace a vector along an axis by a unit vector, because the description in words can then state its direction.
    The unit vector has the direction in which the label of the arrow is positive. Return any other vector unchanged."""
    if sum(c != 0 for c in way) > 1:
        return ImmutableDenseMatrix(way)
    return ImmutableDenseMatrix([0 if c == 0 else -1 if c.could_extract_minus_sign() else 1 for c in way])


def _magnitude(components: Sequence[Expr]) -> Expr | None:
    """Return the magnitude of a force. If several components are not zero, return None for a magnitude that contains a
    root or an absolute value."""
    (first, *others) = [c for c in components if c != 0] or [ZERO]
    if not others:
        return -first if first.could_extract_minus_sign() else first
    size = tidied(sqrt(tidied(Add(*(c**2 for c in components)))))
    return None if size.has(Abs) or any(not power.exp.is_integer for power in size.atoms(Pow)) else size
