"""The marks of the connections in a system: surfaces, strings, pulleys, rods, joints, wires, motors and dashpots.

A connection is drawn only if the description of the system contains it. No connection is guessed from a formula or
from the name of a symbol.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations, pairwise
from typing import Any, TypeVar

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, pi, sin, sqrt

from derive.algebra.expressions import TIME, column, explicit, rate
from derive.algebra.ranges import range_of
from derive.algebra.tidy import tidied
from derive.figures.annotations import Arrow, Axis, AxisOfRotation, PointMark, Turn
from derive.figures.annotations import Line as Edge
from derive.figures.elements import UNDER
from derive.figures.links import Link, is_fixed, moving_in, same
from derive.figures.marks import Mark
from derive.figures.parts import (
    BESIDE_SPRING,
    BLOCK,
    CYLINDER,
    BarMark,
    BlockMark,
    ConnectionMark,
    CornerRopeMark,
    DashpotMark,
    HeavyRopeMark,
    PlankMark,
    RopeBelowMark,
    RopeMark,
    WedgeMark,
    WheelMark,
)
from derive.figures.placed_bodies import placed_outline, with_its_shape
from derive.figures.positions import column_of
from derive.figures.pulleys import PulleyRopeMark, SmallPulleyMark, TiedEndMark
from derive.figures.scenes import drawn_at
from derive.figures.space import numeric
from derive.figures.surfaces import Circle as CircleMark
from derive.figures.surfaces import TableMark
from derive.figures.surroundings import (
    ROOM,
    AngleBetween,
    CurvedGround,
    FixedEnd,
    FloorMark,
    GroundMark,
    OriginMark,
    WayMark,
)
from derive.figures.tops import euler_angles
from derive.figures.turning import angle_marks, downwards, line_between, moving_end, on_the_axis
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.lagrange.fixed_coordinates import fixed_together
from derive.mechanics.model.connection import Connection
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.contacts import Contact, LandingSurface
from derive.mechanics.model.joints import Dashpot, Motor, Pin
from derive.mechanics.model.strings import Line, Pulley, Wire
from derive.mechanics.model.surfaces import Circle, Curve, Plane, Surface, dot
from derive.mechanics.model.system import Particle, System
from derive.steps.signs import sign_known

ZERO, ONE = Integer(0), Integer(1)
ACROSS = column(0, 0, 1)
ORIGIN = Symbol("O")
# Values of coordinates that no constraint determines, relative to `Connections.size`.
AWAY = (Rational(8, 5), Rational(6, 5), Rational(2), Rational(4, 5))
ON_A_TABLE = (Rational(4, 5), Rational(-13, 10))  # the same for a table in space, relative to `ball_size`
# The drawn radius of a small pulley, and its drawn distance from the ceiling, relative to the greatest distance between
# two places of strings and rods.
WHEEL, HANGER = Rational(1, 24), Rational(1, 8)
HOOK = Rational(9, 5)  # the length of the hook that holds the axle of a pulley, relative to the radius of the pulley
BOWL = 4  # the radius of a bowl, relative to `Connections.size`
SPHERE = 2  # the radius of a fixed circle that a round body touches from outside, relative to `Connections.size`
AXIS = Rational(4, 5)  # the length of the axes on a table, relative to TABLE times `ball_size`
# The radius of a table in space is at least BEYOND times the greatest distance of a contact from the middle of the
# table. If this distance changes while a body moves, the radius is also at least TABLE times `ball_size`.
TABLE, BEYOND = Rational(5, 2), Rational(6, 5)
AROUND = Rational(1, 4)  # the radius of the arrow of a motor, relative to the size of the body
HALF_OF_ROPE = 1.2  # half the drawn thickness of a rope with mass, in points
PAST = Rational(3, 2)  # length of a plane beyond the last body on it, relative to `Connections.size`
ROUND = Rational(3, 5)  # angle between the vertical and the line from the centre of a circle to a body on the circle
EXACT = 1e-6
SMALL = 0.08  # a component of the direction of a plane counts as zero if its size is at most this number
FAR = Rational(8, 5)  # a wire is drawn up to FAR times the value that the coordinate of its particle has in the drawing

Sort = TypeVar("Sort", bound=Connection)


def connections_of(system: System, sort: type[Sort]) -> list[Sort]:
    """Return the connections of a system that belong to the class `sort`."""
    return [part for part in system.parts if isinstance(part, sort)]


class Connections:
    """The connections of a system with their marks, and the values that replace symbols in the drawing.

    in_a_plane   whether the system moves in a plane
    start        the values of coordinates at the start of a motion, if the drawing also shows the start
    """

    def __init__(self, system: System, start: Mapping[Symbol, Expr] | None = None):
        self.system = system
        self.start = dict(start or {})
        self.contacts = connections_of(system, Contact)
        self.lines = connections_of(system, Line)
        self.pins = connections_of(system, Pin)
        self.wires = connections_of(system, Wire)
        self.rows = len(system.places[0].components)
        self.in_a_plane = self.rows == 2

    def __bool__(self) -> bool:
        return bool(self.contacts or self.lines or self.pins)

    # --- numbers ---

    @cached_property
    def values(self) -> dict[Symbol, Any]:
        """The values of coordinates, and of some lengths, in the drawing. They satisfy the constraints, as far as these
        can be solved for a coordinate or a length."""
        found: dict[Symbol, Any] = {}
        for circle in (each.surface for each in self.contacts if isinstance(each.surface, Circle)):
            if circle.inside and circle.radius.is_Symbol and self.size != ONE:
                found[circle.radius] = BOWL * self.size
            elif circle.of is None and circle.radius.is_Symbol and self.size.is_Symbol:
                if sign_known(circle.radius - self.size) != -1:
                    found[circle.radius] = SPHERE * self.size
        for each in self.contacts:
            if self.in_a_plane and isinstance(each.surface, Circle) and not each.is_kept:
                found |= self._on_circle(each)
        residuals = [each.residual for each in self.system.constraints if not each.in_rates]
        found |= fixed_together(residuals, [*self.system.coordinates])
        for constraint in self.system.constraints:
            if not constraint.in_rates and (constraint.forces or not constraint.enforcer):
                found |= self._solved(constraint, found)
        found |= self._over_corners(found)
        free = [q for q, kind in self.system.coordinates.items() if q not in found and kind == "length"]
        carriers = [each.through for each in self._planes if each.of is not None]
        carried = {q for place in carriers for q in moving_in(self.system, *place.components)}
        on_table = not self.in_a_plane and self.contacts and not any(q.is_positive for q in free)
        away, size = (ON_A_TABLE, self.ball_size) if on_table else (AWAY, self.size)
        for i, q in enumerate(sorted(free, key=lambda q: q in carried)):
            found[q] = self._free_value(q, len(found)) or size * (
                self._farthest if q in carried else away[i % len(away)]
            )
        found |= self._arms() | self._amplitudes()
        found |= self._turned(found)
        chosen = {letter: found[letter] for letter in found if letter in free or letter not in self.system.coordinates}
        return {**drawn_at(self.system.coordinates), **{letter: value.subs(chosen) for letter, value in found.items()}}

    def _free_value(self, q: Symbol, before: int) -> Expr | None:
        """Return a value of the coordinate q, a length, that makes the drawing readable; None if no suitable length is
        known."""
        zero = dict.fromkeys((*self.system.coordinates, TIME), ZERO)
        components = [c for place in self.system.places for c in place.components]
        rests = [min(c.xreplace(zero).free_symbols, key=str, default=None) for c in components if q in c.free_symbols]
        known = [letter for letter in rests if letter is not None and letter != self.size]
        if known:
            falls = all(diff(place.components[0], q) == 0 for place in self.system.places) and self.system.weights
            return (Rational(2, 5) if falls or len(known) < len(rests) else Rational(4, 13 + 2 * before)) * known[0]
        others = {
            letter for c in components for letter in c.xreplace(zero).free_symbols if c.has(*self.system.coordinates)
        }
        is_alone = self.size == ONE and not any(q in c.free_symbols and c != q for c in components)
        return Rational(1, 4) * min(others, key=str) if others and is_alone and q in components else None

    def _turned(self, known: Mapping[Symbol, Any]) -> dict[Symbol, Any]:
        """Values of the angles through which bodies have rolled, from the distances that they have rolled."""
        found: dict[Symbol, Any] = {}
        for each in self.system.constraints:
            slopes = {q: tidied(diff(each.residual, rate(q))) for q in each.coordinates} if each.in_rates else {}
            angles = [q for q in slopes if self.system.coordinates[q] == "angle"]
            others = [q for q in slopes if q not in angles and q in known]
            steady = not any(moving_in(self.system, slope) for slope in slopes.values())
            if len(slopes) == 2 and len(angles) == 1 and others and steady:
                value = tidied(-slopes[others[0]] * known[others[0]] / slopes[angles[0]])
                if angles[0] not in found or numeric(value) > 0:  # a positive angle shows the positive sense
                    found[angles[0]] = value
        return found

    def _arms(self) -> dict[Symbol, Expr]:
        """Values of the distances between centres of mass and centres of rims."""
        found = {}
        for placed in self.system.bodies:
            if placed.rim is not None:
                arm = distance_of(placed.hub, placed.centre)
                if arm.is_Symbol and not moving_in(self.system, arm):
                    found[arm] = Rational(3, 5) * placed.rim[1]
        return found

    def _amplitudes(self) -> dict[Symbol, Expr]:
        """Values of the amplitudes of oscillating supports."""
        found = {}
        for line in self.lines:
            length = self._kept_length(line)
            terms = [t for place in line.places for c in place.components for t in Add.make_args(c) if t.has(TIME)]
            for term in terms if length is not None and not self._turns() else ():
                for letter in term.as_independent(TIME)[0].free_symbols if term.has(sin, cos) else ():
                    found[letter] = Rational(3, 10) * length
        return found

    def _on_circle(self, touch: Contact) -> dict[Symbol, Any]:
        """Values of the Cartesian coordinates of a body that touches a circle: the body is drawn at a fixed angle from
        the vertical."""
        circle: Any = touch.surface
        if touch.of is None:  # a round body on a fixed corner
            centre, body = touch.at, circle.of.hub
        else:
            centre, body = circle.centre, touch.of.hub if isinstance(touch.of, PlacedBody) else touch.of.at
        x, y = body.components
        if not all(c in self.system.coordinates for c in (x, y)):
            return {}
        distance = (
            tidied(touch.gap - dot(touch.normal, body - circle.centre)) if touch.of is not None else -circle.radius
        )
        far = distance if circle.inside else -distance
        up = -1 if circle.inside else 1
        along = Location((far * sin(ROUND), up * far * cos(ROUND)))
        return dict(zip((x, y), (centre + along).components, strict=True))

    def _over_corners(self, known: Mapping[Symbol, Any]) -> dict[Symbol, Any]:
        """Values of coordinates at which a rod lies over a fixed corner, with the corner at a third of the length of
        the rod."""
        found: dict[Symbol, Any] = {}
        for touch in (each for each in self.contacts if each.of is None):
            past = tidied(dot(touch.tangent, touch.at - touch.surface.of.centre).subs(known))
            bars = [mark for mark in placed_outline(with_its_shape(touch.surface.of)) if isinstance(mark, BarMark)]
            if bars and (past in self.system.coordinates or -past in self.system.coordinates):
                ends = (Location(tuple(place)) for place in (bars[0].start, bars[0].end))
                found[past if past.is_Symbol else -past] = distance_of(*ends) / 6
        return found

    def _solved(self, constraint: Constraint, known: Mapping[Symbol, Any]) -> dict[Symbol, Any]:
        """Solve a constraint for a coordinate, or for a length in the constraint, such as the length of a string.

        The result is empty if the constraint cannot be solved in this way.
        """
        if constraint.left.is_Symbol and constraint.left not in self.system.coordinates:
            return {constraint.left: tidied(constraint.right.subs(known))}
        residual = explicit(constraint.residual).subs(known)
        free = [q for q in constraint.coordinates if q not in known]
        for q in reversed(free):
            share = tidied(diff(residual, q))
            if share != 0 and not moving_in(self.system, share):
                value, whole = tidied(q - residual / share), constraint.right
                if q.is_positive and not value.is_positive and whole.is_Symbol and whole != self.size:
                    return {whole: tidied(explicit(constraint.left).subs(known))}
                return {q: value}
        return {}

    @property
    def _farthest(self) -> Rational:
        """The drawn value of the coordinate of a body that carries another body, relative to `size`.

        A wedge is drawn to the right of the body on it. The middle of a plank is drawn to the left of the body on it.
        """
        slopes = [each for each in self._planes if each.of is not None and tidied(each.unit_normal.components[0]) != 0]
        return Rational(5, 2) if slopes else Rational(4, 5)

    @property
    def _span(self) -> Expr:
        places = [place for line in self.lines for place in line.places]
        return max((distance_of(a, b) for a, b in combinations(places, 2) if not same(a, b)), key=self.number)

    @cached_property
    def size(self) -> Expr:
        """The radius of the largest round body; a sixth of the longest rod, if there is no round body; 1 if there is
        neither."""
        sizes = [mark.radius for mark in self._outlines if isinstance(mark, WheelMark) and mark.radius is not None]
        bars = [mark for mark in self._outlines if isinstance(mark, BarMark)]
        ends = [[Location(tuple(place)) for place in (bar.start, bar.end)] for bar in bars]
        return max(sizes or [distance_of(*each) / 6 for each in ends], key=numeric, default=ONE)

    @property
    def is_possible(self) -> bool:
        """Whether each body that touches a curve is drawn on the curve."""
        return all(abs(self.number(each.gap)) < EXACT for each in self.contacts if isinstance(each.surface, Curve))

    def number(self, value: Expr) -> float:
        return numeric(value.subs(self.values), self.values)

    @cached_property
    def _outlines(self) -> list[Mark]:
        return [mark for placed in self.system.bodies for mark in placed_outline(with_its_shape(placed))]

    # --- marks ---

    @property
    def marks(self) -> Iterator[Mark]:
        if self.in_a_plane:
            for surface in dict.fromkeys(each.surface for each in self.contacts):
                yield from self._surface(surface, [each for each in self.contacts if each.surface == surface])
            for landing in connections_of(self.system, LandingSurface):
                yield from self._landing(landing.surface)
        else:
            for plane in self._planes:
                yield from self._table(plane)
        for pulley in connections_of(self.system, Pulley):
            yield from self._pulley(pulley.at, pulley.radius)
        labels: set[Any] = set()  # each angle is drawn once
        for line in self.lines:
            yield from self._line(line, labels)
        for pin in self.pins:
            yield from self._pin(pin)
        for wire in self.wires:
            yield from self._wire(wire)
        for motor in connections_of(self.system, Motor):
            yield from self._motor(motor)
        yield from self._dashpots

    # --- surfaces ---

    def _surface(self, surface: Surface, contacts: Sequence[Contact]) -> Iterable[Mark]:
        if isinstance(surface, Circle):
            yield from self._circle(surface, contacts)
        elif isinstance(surface, Curve):
            yield self._curve(surface, contacts)
        elif isinstance(surface, Plane):
            low, high = self._ends(surface, contacts)
            if isinstance(surface.of, Particle):
                yield from self._carrier(surface, low, high)
            elif surface.of is None and not all(self._carries(each.of) for each in contacts):
                yield from self._plane(surface, low, high, contacts)
                yield from self._slope(surface, low, high)
        for touch in contacts:
            if touch.of is None:
                yield from self._corner(touch)

    def is_drawn(self, surface: Surface) -> bool:
        """Whether the drawing shows the surface. In space, the drawing shows only horizontal planes through a fixed
        point, with the bodies above them."""
        is_level = isinstance(surface, Plane) and surface.unit_normal.components == (ZERO, ZERO, ONE)
        return self.in_a_plane or is_level and is_fixed(self.system, surface.place)

    def _table(self, plane: Plane) -> Iterable[Mark]:
        """Yield the marks of a horizontal plane in space, and of the bodies on it."""
        if not self.is_drawn(plane):
            return
        through = column_of(plane.through)
        yield TableMark(through, ACROSS, self._table_radius(plane), True)
        if isinstance(plane.moves, Axes):
            rate = next((diff(angle, TIME) for i, angle in plane.moves.turns if i == 2), None)
            if rate is not None:
                yield AxisOfRotation(through, ACROSS, rate, label=rate)
        for touch in self.contacts:
            if touch.surface == plane and isinstance(touch.of, PlacedBody) and same(touch.of.at, touch.of.centre):
                yield from self._on_table(touch, plane)

    def _on_table(self, touch: Contact, plane: Plane) -> Iterable[Mark]:
        arm = distance_of(touch.of.centre, touch.at)
        for k, q in enumerate(touch.of.centre.components):
            if q in self.system.coordinates:
                start = column_of(plane.through)
                yield Axis(
                    start, start + AXIS * TABLE * self.ball_size * column(*(int(i == k) for i in range(3))), label=q
                )
        yield Edge(column_of(touch.of.centre), column_of(touch.at), "hidden", label=arm if arm.is_Symbol else None)
        yield PointMark(column_of(touch.at))
        yield from euler_angles(self.system, touch.of, Rational(5, 4) * arm)

    def _table_radius(self, plane: Plane) -> Expr:
        touches = [each for each in self.contacts if each.surface == plane]
        ways = [distance_of(plane.through, each.at) for each in touches]
        if any(moving_in(self.system, way) for way in ways) and any(hasattr(each.of, "hub") for each in touches):
            return max(TABLE * self.ball_size, *(BEYOND * way for way in ways), key=self.number)
        return BEYOND * max(ways, key=self.number)

    @property
    def ball_size(self) -> Expr:
        """The greatest distance of a contact from the centre of the body that touches the surface; 1 without bodies."""
        arms = [distance_of(each.of.hub, each.at) for each in self.contacts if hasattr(each.of, "hub")]
        return max(arms, key=numeric, default=ONE)

    def _carries(self, of: Any) -> bool:
        """Whether the part `of` carries the surface of a contact, as a wedge does; the round rim of a body does not
        count."""
        carried = [each.surface for each in self.contacts if each.surface.of == of]
        return of is not None and any(not (isinstance(each, Circle) and isinstance(of, PlacedBody)) for each in carried)

    def _plane(self, plane: Plane, low: Location, high: Location, contacts: Sequence[Contact]) -> Iterable[Mark]:
        if plane.is_two_sided:
            yield Edge(column_of(low), column_of(high), "edge")
        elif isinstance(plane.ground, Location):
            yield Edge(column_of(low), column_of(high), "edge")
            start = low + Rational(1, 10) * (high - low) - self.size * Rational(1, 5) * plane.unit_normal
            yield from _arrows_of_motion(column_of(start), plane.ground)
            return
        elif self.carries_only_blocks(plane):
            floor = self._floor(plane, contacts)
            yield floor
            yield from self._origin(plane, floor.off)
            return
        else:
            yield GroundMark(column_of(low), column_of(high), column_of(-plane.unit_normal))
        yield from self._origin(plane, 0.0)

    def carries_only_blocks(self, plane: Surface) -> bool:
        """Whether the surface is a level plane at rest under particles that are drawn as blocks. The centre of each
        block is at its particle, so springs and strings are at half the height of the block."""
        on_it = [each.of for each in self.contacts if each.surface == plane]
        return (
            isinstance(plane, Plane)
            and plane.of is None
            and not isinstance(plane.ground, Location)
            and is_zero_direction(plane.unit_normal.components[0])
            and all(isinstance(of, Particle) for of in on_it)
        )

    def _floor(self, plane: Plane, contacts: Sequence[Contact]) -> FloorMark:
        height = plane.through.components[1]
        ends = [place for each in self.system.between for place in (each.start, each.end)]
        ends += [place for line in self.lines for place in line.places]
        walls = [p for p in ends if is_fixed(self.system, p) and tidied(p.components[1] - height) == 0]
        blocks = [each.at for each in contacts]
        origin = [Location((ZERO, height))] if self.has_bare_origin(plane) else []
        middle = sum(self.number(place.components[0]) for place in blocks) / len(blocks)
        sides = {self.number(wall.components[0]) > middle for wall in walls}
        starts = [each.foot for each in contacts]
        margins = (0.0 if False in sides else ROOM, 0.0 if True in sides else ROOM)
        off = HALF_OF_ROPE if all(self.is_rope(each.of) for each in contacts) else UNDER[BlockMark]
        return FloorMark(tuple(column_of(p) for p in (*blocks, *walls, *starts, *origin)), off, margins)

    def has_bare_origin(self, plane: Plane) -> bool:
        """Whether a coordinate is measured along a fixed level line from the origin, at which nothing is drawn.

        If a joint, or an end of a spring, a string or a rod, is fixed, the origin is usually an equilibrium position.
        Then the result is False.
        """
        if plane.of is not None or isinstance(plane.ground, Location) or self.start:
            return False
        if not is_zero_direction(plane.unit_normal.components[0]):
            return False
        on_it = [each.of for each in self.contacts if each.surface == plane and each.of is not None]
        centres = [getattr(of, "centre", None) or of.at for of in on_it]
        ends = [end for each in self.system.between for end in (each.start, each.end)]
        fixed = [*ends, *(place for line in self.lines for place in line.places), *(pin.at for pin in self.pins)]
        meets = any(other != plane and other.through.components[0] == 0 for other in self._planes)
        is_bare = not meets and not any(is_fixed(self.system, place) for place in fixed)
        return is_bare and any(centre.components[0] in self.system.coordinates for centre in centres)

    def _origin(self, plane: Plane, off: float) -> Iterable[Mark]:
        if self.has_bare_origin(plane):
            yield OriginMark(column_of(Location((ZERO, plane.through.components[1]))), off, label=ORIGIN)

    def _landing(self, plane: Surface) -> Iterable[Mark]:
        if not isinstance(plane, Plane):
            return
        along = Location((plane.unit_normal.components[1], -plane.unit_normal.components[0]))
        circles = [each.surface for each in self.contacts if isinstance(each.surface, Circle)]
        starts = [(circle.centre, circle.radius) for circle in circles]
        for middle, far in (starts or [(line.places[0], self._span) for line in self.lines])[:1]:
            way = dot(along, middle - plane.through)
            low, high = (plane.through + (way + sign * PAST * far) * along for sign in (-1, 1))
            yield GroundMark(column_of(low), column_of(high), column_of(-plane.unit_normal))
            yield from self._slope(plane, low, high)

    def _ends(self, plane: Plane, contacts: Sequence[Contact]) -> tuple[Location, Location]:
        """The two ends of the drawn part of a plane. The first is the lower end, or the left end if the plane is
        level."""
        n = plane.unit_normal
        along = Location((n.components[1], -n.components[0]))
        if self.number(along.components[1]) < -SMALL or abs(self.number(along.components[1])) <= SMALL > self.number(
            along.components[0]
        ):
            along = -along
        ways = [dot(along, each.at - plane.through) for each in contacts]
        past = self.size * PAST
        begun = [dot(along, each.at.with_values(self.start) - plane.through) for each in contacts if self.start]
        ways += [tidied(way) for way in begun if not moving_in(self.system, way)]
        ways += [dot(along, -plane.through)] if self.has_bare_origin(plane) else []
        meets = any(other != plane and same(other.through, plane.through) for other in self._planes)
        is_slope = plane.of is None and min(abs(self.number(c)) for c in n.components) > SMALL
        first, last = (choice([*ways, ZERO] if meets or is_slope else ways, key=self.number) for choice in (min, max))
        if isinstance(plane.of, Particle) and abs(self.number(along.components[1])) <= SMALL:
            half = max((tidied(way) for way in ways), key=lambda way: abs(self.number(way)))
            far = (half if self.number(half) > 0 else -half) + past
            return plane.through - far * along, plane.through + far * along  # the place of a plank is its middle
        if isinstance(plane.of, Particle):  # a wedge: its face begins at the place of the particle
            first, last = (ZERO, last + past) if self.number(last) > -self.number(first) else (first - past, ZERO)
            return plane.through + first * along, plane.through + last * along
        low = first if meets and first == 0 else first - past
        high = last if meets and last == 0 else last + past
        return plane.through + low * along, plane.through + high * along

    def _corner(self, touch: Contact) -> Iterable[Mark]:
        """Yield the top and the side of a table or a step, whose edge is the fixed corner. The top is below the higher
        part of the body. The side of a step ends at the floor."""
        slope = explicit(touch.tangent.components[0] * touch.tangent.components[1]).subs(self.values)
        sign = sign_known(slope)
        level = Location((ONE if (self.number(slope) if sign is None else sign) > 0 else -ONE, ZERO))
        down = Location((ZERO, -ONE))
        heights = [
            tidied(touch.at.components[1] - each.through.components[1]) for each in self._planes if each.of is None
        ]
        side = next((each for each in heights if sign_known(each) == 1), self.size * Rational(4, 5))
        for along, inwards, far in ((level, down, self.size * Rational(4, 5)), (down, level, side)):
            end = touch.at + far * along
            yield GroundMark(column_of(touch.at), column_of(end), column_of(inwards))

    @property
    def _planes(self) -> list[Plane]:
        return list(dict.fromkeys(each.surface for each in self.contacts if isinstance(each.surface, Plane)))

    def _slope(self, plane: Plane, low: Location, high: Location) -> Iterable[Mark]:
        x, y = (high - low).components
        if abs(self.number(x)) <= SMALL or abs(self.number(y)) <= SMALL:
            return
        angle = _angle_in(plane.unit_normal)
        level = _direction(1 if self.number(x) > 0 else -1, 0)
        if angle is not None:
            yield AngleBetween(column_of(low), level, column_of(high - low), True, label=angle)

    def _carrier(self, plane: Plane, low: Location, high: Location) -> Iterable[Mark]:
        """Yield the marks of the particle that carries a plane: a plank under a level plane, a wedge under a slope, or
        a solid behind a vertical or overhanging plane. A wedge that touches a level floor is drawn on this floor."""
        x, y = (high - low).components
        label = plane.of.mass
        if abs(self.number(y)) <= SMALL:
            down = Location((ZERO, -self.size * Rational(1, 3)))
            corners: tuple[Location, ...] = (low, high, high + down, low + down)
            sort: type[WedgeMark] = PlankMark
        elif abs(self.number(x)) <= SMALL or self.number(plane.unit_normal.components[1]) < 0:
            inwards = -self.size * plane.unit_normal  # a body with a vertical face, or with a face on its lower side
            corners, sort = (low, high, high + inwards, low + inwards), WedgeMark
        else:
            height = self._floor_under(plane.of)
            # If the top of the face is not above the floor, the wedge cannot be drawn on this floor.
            if height is not None and self.number(high.components[1] - height) > SMALL:
                low = low + tidied((height - low.components[1]) / y) * (high - low)
            corners, sort = (low, high, Location((high.components[0], low.components[1]))), WedgeMark
            angle = _angle_in(plane.unit_normal)
            level = _direction(1 if self.number(x) > 0 else -1, 0)
            if angle is not None:
                yield AngleBetween(column_of(low), level, column_of(high - low), label=angle)
        yield sort(tuple(map(column_of, corners)), label=label)
        lowest = corners[-2:] if sort is PlankMark else (corners[0], corners[-1])
        if self.number(plane.unit_normal.components[1]) >= -SMALL:
            floor = next((each.surface for each in self.contacts if each.of == plane.of), None)
            origin: list[Location] = []
            if isinstance(floor, Plane) and self.has_bare_origin(floor):
                origin = [Location((ZERO, lowest[0].components[1]))]
                yield OriginMark(column_of(origin[0]), label=ORIGIN)
            yield FloorMark(tuple(column_of(corner) for corner in (*lowest, *origin)))

    def _floor_under(self, particle: Particle) -> Expr | None:
        """The height of the plane on which a particle stands; None if there is no such plane."""
        for each in self.contacts:
            if each.of == particle and isinstance(each.surface, Plane) and each.surface.of is None:
                return each.surface.through.components[1]
        return None

    def _curve(self, curve: Curve, contacts: Sequence[Contact]) -> Mark:
        ways = [(each.at - curve.through).components[0] for each in contacts]
        far = PAST * max((way if self.number(way) > 0 else -way for way in ways), key=self.number)
        place = column_of(curve.through + Location((curve.letter, curve.formula)))
        if curve.is_two_sided or curve.of is not None:
            label = curve.of.mass if isinstance(curve.of, Particle) else None
            return WayMark(place, curve.letter, -far, far, "wire", label=label)
        solid = _direction(0, 1 if curve.below else -1)
        return CurvedGround(place, curve.letter, -far, far, "ground", solid=solid)

    def _circle(self, circle: Circle, contacts: Sequence[Contact]) -> Iterable[Mark]:
        centre = column_of(circle.centre)
        if isinstance(circle.of, PlacedBody):
            return
        touch = contacts[0]
        yield CircleMark(centre, ACROSS, circle.radius, not circle.inside and not circle.is_two_sided)
        yield PointMark(centre)
        if circle.inside and isinstance(touch.of, PlacedBody):  # the body covers the line to the contact
            between = line_between(circle.centre, touch.of.hub)
            yield Edge(centre, column_of(touch.of.hub), label=between.length if touch.is_kept else None)
        else:
            yield ConnectionMark(centre, column_of(touch.foot), label=circle.radius)
        yield from angle_marks(self.system, line_between(circle.centre, touch.foot))

    # --- strings, rods, wires and joints ---

    def _line(self, line: Line, labels: set[Any]) -> Iterable[Mark]:
        places = line.places
        columns = [column_of(place) for place in places]
        if line.rope is not None:
            yield HeavyRopeMark(tuple(columns), (ZERO,) * len(columns), label=line.rope.mass)
            return
        if line.is_rod:
            yield BarMark(columns[0], columns[-1], label=self._kept_length(line))
        elif self._is_corner(line):
            start, corner, end = columns
            yield CornerRopeMark(start, corner, end, self._lifts(line))
        else:
            yield from self._string(line)
        if len(places) == 2:
            for mark in angle_marks(self.system, self._link_along(line)):
                if mark.label is None or mark.label not in labels:
                    labels.add(mark.label)
                    yield mark
        for place, other in self._loose_ends(line):
            yield from self._end(line, place, other)

    def _string(self, line: Line) -> Iterable[Mark]:
        columns = tuple(column_of(place) for place in line.places)
        small = self._span * WHEEL if self.in_a_plane and len(columns) > 2 else ZERO
        radii = (ZERO, *(e.radius if isinstance(e, Pulley) else small for e in line.through[1:-1]), ZERO)
        corners = self._small_pulleys(line)
        if self._is_through_table(line):
            for ends in pairwise(columns):
                sort = RopeBelowMark if any(self.number(end[-1]) < -EXACT for end in ends) else RopeMark
                yield sort(ends, (ZERO, ZERO))
            return
        if not corners:
            yield RopeMark(columns, radii, label=self._kept_length(line) if len(columns) == 2 else None)
            return
        tied = tuple(is_fixed(self.system, line.places[k]) for k in (0, -1))
        string = PulleyRopeMark(columns, radii, corners=corners, tied=(tied[0], tied[1]))
        yield string
        for k in corners:
            place = line.places[k]
            particle = next((one for one in self.system.particles if same(one.at, place)), None)
            hangs = particle is None and is_fixed(self.system, place)
            label = particle.mass if particle else None
            yield SmallPulleyMark(string, k, self._hanger(line, place) if hangs else None, label=label)
        for k in (0, 1):
            if tied[k]:
                yield TiedEndMark(string, k == 1)

    def _hanger(self, line: Line, at: Location) -> Expr:
        """Return the drawn distance from a fixed small pulley to the ceiling."""
        fixed = [line.places[k] for k in (0, -1) if is_fixed(self.system, line.places[k])]
        above = [tidied((place - at).components[1]) for place in fixed]
        return next((height for height in above if self.number(height) > SMALL), HANGER * self._span)

    def _small_pulleys(self, line: Line) -> tuple[int, ...]:
        if line.is_rod or line.rope is not None or not self.in_a_plane or self._is_corner(line):
            return ()
        last = len(line.through) - 1
        return tuple(k for k, each in enumerate(line.through) if 0 < k < last and not isinstance(each, Pulley))

    def _loose_ends(self, line: Line) -> Iterator[tuple[Location, Location]]:
        for k, beside in ((0, 1), (-1, -2)):
            if not (self._small_pulleys(line) and is_fixed(self.system, line.places[k])):
                yield line.places[k], line.places[beside]

    def _is_corner(self, line: Line) -> bool:
        """Whether a string has one fixed corner without a radius, as at the edge of a table."""
        corner = line.through[1]
        is_alone = len(line.through) == 3 and not isinstance(corner, Pulley)
        return self.in_a_plane and is_alone and is_fixed(self.system, corner)  # type: ignore[arg-type]

    def _is_through_table(self, line: Line) -> bool:
        """Whether a string passes through the middle of a table that is drawn in space at the height zero."""
        tables = [] if self.in_a_plane else [plane for plane in self._planes if self.is_drawn(plane)]
        holes = line.places[1:-1]
        return any(same(plane.through, hole) and hole.components[-1] == 0 for plane in tables for hole in holes)

    def _lifts(self, line: Line) -> tuple[float, float]:
        """The shifts of the two parts of a string away from the surfaces below. A string to a block on a slope is then
        at half the height of the block."""
        stands = [
            any(same(touch.at, place) and not self.carries_only_blocks(touch.surface) for touch in self.contacts)
            for place in (line.places[0], line.places[-1])
        ]
        return (BLOCK[1] / 2 if stands[0] else 0.0, BLOCK[1] / 2 if stands[1] else 0.0)

    def _kept_length(self, line: Line) -> Expr | None:
        """The length of a string or rod if this length is constant and is a symbol times a number; otherwise None."""
        constraint = next((c for c in self.system.constraints if c.forces and c.forces == line.forces), None)
        length = constraint.left if constraint is not None else distance_of(line.places[0], line.places[-1])
        return length if length.as_coeff_Mul()[1].is_Symbol and not moving_in(self.system, length) else None

    def _link_along(self, line: Line) -> Link:
        start, end = line.places
        moving = [moving_in(self.system, *place.components) for place in (start, end)]
        return line_between(end, start) if len(moving[1]) < len(moving[0]) else line_between(start, end)

    def _pulley(self, at: Location, radius: Expr) -> Iterable[Mark]:
        particle = next((one for one in self.system.particles if same(one.at, at)), None)
        label = radius if radius.is_Symbol else None
        yield WheelMark(column_of(at), radius, label=particle.mass if particle else label)
        if particle is None and is_fixed(self.system, at):
            above = at + Location((ZERO, HOOK * radius))
            yield BarMark(column_of(at), column_of(above))
            yield FixedEnd(column_of(above), downwards(2))
        for line in self.lines:
            for k in (0, -1):
                if same(line.places[k], at):  # the string holds the axle, not the rim, which turns
                    way = self._towards_end(line, k)
                    yield BarMark(column_of(at), column_of(at + HOOK * radius * way))

    def _towards_end(self, line: Line, k: int) -> Location:
        """Return the direction in which a string pulls at its first end (k = 0) or at its last end (k = -1)."""
        pulled, (place, other) = line.through[k], (line.places[k], line.places[1 if k == 0 else -2])
        beside = line.through[1 if k == 0 else -2]
        assert isinstance(pulled, Location)
        x, y = (other - place).components
        if isinstance(beside, Pulley):  # the string leaves this pulley at the rim
            x, y = (ZERO, y) if is_zero_direction(abs(x) - beside.radius) else (x, ZERO)
        if is_zero_direction(x):
            return Location((ZERO, ONE if self.number(y) > 0 else -ONE))
        size = sqrt(tidied(x**2 + y**2))
        return Location((tidied(x / size), tidied(y / size)))

    def _end(self, line: Line, place: Location, other: Location) -> Iterable[Mark]:
        holds = any(same(place, at) for _, at in self.system.masses) or any(
            same(place, each.at) for each in connections_of(self.system, Pulley)
        )
        holds |= any(force.of is not None and same(force.at, place) for force in line.forces)
        inside = any(same(place, between) for between in line.places[1:-1])
        if holds or inside or moving_in(self.system, *place.components) - {TIME}:
            return
        if any(moving_in(self.system, *p.components) - {TIME} == set() for p in (other,)) or self._turns():
            yield PointMark(column_of(place))
            return
        turns = any(self.system.coordinates.get(q) == "angle" for q in moving_in(self.system, *other.components))
        below = self.rows == 3 or line.is_rod or turns or self.number((other - place).components[1]) < 0
        if moving := list(moving_end(self.system, place, line.is_rod)):
            yield from moving
        elif not is_fixed(self.system, place):  # a prescribed motion on a curve
            yield FixedEnd(column_of(place), column_of(place) * 0, True)
            centre = on_the_axis(place)
            radius = distance_of(centre, place)
            label = radius if radius.is_Symbol else None
            yield ConnectionMark(column_of(centre), column_of(place), label=label)
        elif below:
            held = column_of(other - place) if self.in_a_plane else None
            yield FixedEnd(column_of(place), downwards(self.rows), line.is_rod, held)
        else:
            yield FixedEnd(column_of(place), column_of(other - place))

    def _turns(self) -> bool:
        """Whether an angle in the positions of a system in space depends on time, as in a prescribed rotation."""
        angles = {f.args[0] for p in self.system.places for c in p.components for f in c.atoms(sin, cos)}
        return self.rows == 3 and any(angle.has(TIME) for angle in angles)

    def _pin(self, pin: Pin) -> Iterable[Mark]:
        if moving := list(moving_end(self.system, pin.at, True)):
            return moving
        if not is_fixed(self.system, pin.at):
            return [FixedEnd(column_of(pin.at), column_of(pin.at) * 0, True)]
        centres = (force.of.centre for force in pin.forces if hasattr(force.of, "centre"))
        held = next((column_of(centre - pin.at) for centre in centres if self.in_a_plane), None)
        return [FixedEnd(column_of(pin.at), downwards(self.rows), True, held)]

    def _wire(self, wire: Wire) -> Iterable[Mark]:
        """Yield the curve of a wire: the path of its particle as the coordinate of the particle varies."""
        at = wire.of.at
        (q,) = moving_in(self.system, *at.components) - {TIME}
        start = Location(tuple(c.xreplace({q: ZERO}) for c in at.components))
        turns = any(c.has(TIME) for c in at.components) and not any(diff(c, q, 2) for c in at.components)
        is_half = turns and self.system.coordinates[q] == "length" and is_fixed(self.system, start)
        low, high = (-pi, pi) if self.system.coordinates[q] == "angle" else (ZERO if is_half else -FAR * q, FAR * q)
        known = range_of(q)
        if known is not None and known.least.is_finite and known.greatest.is_finite:
            low, high = known.least, known.greatest
        yield WayMark(column_of(at), q, low, high, "wire")

    def _motor(self, motor: Motor) -> Iterable[Mark]:
        for placed in self.system.bodies if self.in_a_plane else ():
            sense = diff(placed.turned, motor.angle) if motor.angle.is_Symbol else ZERO
            if sense in (1, -1) and is_fixed(self.system, placed.at):
                away = column_of(placed.at - placed.centre)
                yield Turn(
                    column_of(placed.at), sense * ACROSS, AROUND, away if any(away) else None, label=motor.torque
                )

    @property
    def _dashpots(self) -> list[DashpotMark]:
        """The dashpots. A dashpot is drawn beside a spring if both connect the same two places."""
        springs = [{each.start.components, each.end.components} for each in self.system.between]
        return [
            DashpotMark(
                column_of(each.start),
                column_of(each.end),
                {each.start.components, each.end.components} in springs,
                label=each.constant,
            )
            for each in connections_of(self.system, Dashpot)
        ]

    @property
    def height_of_dashpots(self) -> float:
        """The distance from a spring to the upper edge of a dashpot beside it, in points; 0 if no dashpot is beside a
        spring."""
        return BESIDE_SPRING + CYLINDER[1] / 2 if any(each.beside for each in self._dashpots) else 0.0

    # --- particles ---

    def block(self, particle: Particle) -> list[Mark] | None:
        """Return the block that represents a particle on a plane. The list is empty if another mark represents the
        particle, such as a wedge or a pulley. Return None if the particle is drawn as a small disc."""
        if any(each.surface.of == particle for each in self.contacts) and self.in_a_plane or self.is_rope(particle):
            return []
        if any(same(particle.at, place) for line in self.lines for place in line.places[1:-1]) and self.in_a_plane:
            return []
        touch = next((each for each in self.contacts if each.of == particle), None)
        if touch is None or not isinstance(touch.surface, Plane) or not self.in_a_plane:
            return None
        stands = not touch.surface.is_two_sided and not self.carries_only_blocks(touch.surface)
        return [BlockMark(column_of(particle.at), column_of(touch.tangent), stands=stands, label=particle.mass)]

    def is_rope(self, particle: Any) -> bool:
        """Whether the mass of the particle is distributed along a rope."""
        return any(line.rope is not None and line.rope == particle for line in self.lines)

    def rope_piece(self, length: Expr) -> tuple[Location, Location] | None:
        """Return the ends of a straight piece of rope with this length; None if there is no such piece."""
        pieces = (piece for line in self.lines if line.rope is not None for piece in pairwise(line.places))
        return next((piece for piece in pieces if distance_of(*piece) == length), None)

    def holds(self, particle: Particle) -> bool:
        """Whether the drawing shows what holds the particle, such as a surface or a string."""
        touched = any(each.of == particle for each in self.contacts) and self.in_a_plane
        return touched or any(same(particle.at, line.places[k]) for line in self.lines for k in (0, -1))

    def is_on_wire(self, at: Location) -> bool:
        return any(same(wire.of.at, at) for wire in self.wires)

    def runs_along(self, link: Link) -> bool:
        """Whether a string, a rod or the radius of a circle is drawn along the link."""
        pieces = [line.places for line in self.lines if link.is_constant or len(line.places) == 2]
        ends = [piece for places in pieces for piece in pairwise(places)]
        circles = [each.surface for each in self.contacts if isinstance(each.surface, Circle) and self.in_a_plane]
        centred = any(same(circle.centre, link.start) for circle in circles)
        return centred or any(same(a, link.start) and same(b, link.end) for one in ends for a, b in (one, one[::-1]))


def _arrows_of_motion(start: Any, place: Location) -> Iterator[Mark]:
    """Yield the arrow of a place with a prescribed motion: the velocity if it is constant, or the acceleration if it is
    constant and the place starts from rest. For any other motion along a straight line, yield two opposite
    arrows.
    """
    rates = [ImmutableDenseMatrix([tidied(diff(c, TIME, n)) for c in place.components]) for n in (1, 2)]
    constant = next((each for each in rates if any(each) and not each.has(TIME)), None)
    if constant is rates[0] or constant is not None and not any(rates[0].subs(TIME, 0)):
        size = tidied(sqrt(Add(*(c**2 for c in constant))))
        if isinstance(size, Abs) and size.args[0].is_Symbol:  # the arrow is drawn for a positive symbol
            size = size.args[0]
        yield Arrow(start, constant, Rational(1, 2), False, label=size)
        return
    x, y = rates[0]
    way = _direction(1, tidied(y / x)) if x != 0 else _direction(0, 1)
    if not way.has(TIME):
        yield Arrow(start, way, Rational(1, 4), False)
        yield Arrow(start, -way, Rational(1, 4), False)


def distance_of(start: Location, end: Location) -> Expr:
    return sqrt(tidied(Add(*(c**2 for c in (end - start).components))))


def is_zero_direction(component: Expr) -> bool:
    return bool(tidied(component) == 0)


def _direction(x: Any, y: Any) -> Any:
    return ImmutableDenseMatrix([x, y])


def _angle_in(direction: Location) -> Expr | None:
    """A symbol whose sine or cosine occurs in the components of a direction; None if there is no such symbol."""
    angles = {f.args[0] for c in direction.components for f in c.atoms(sin, cos)}
    return next((angle for angle in angles if angle.is_Symbol), None)
