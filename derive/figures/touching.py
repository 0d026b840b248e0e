"""Supports on which bodies and particles in a plane lean, hang or roll, recognised from constraints.

A constraint that fixes the height of a point is a floor, and a constraint that fixes its horizontal position is a wall;
both together are a fixed joint. If a round body rolls on a fixed circle, this circle is drawn. If a round body rolls on
a vertical line, a string that is wound on the body is drawn.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, sqrt

from derive.algebra.expressions import column, rate
from derive.algebra.tidy import tidied
from derive.figures.annotations import PointMark
from derive.figures.marks import Mark
from derive.figures.parts import BarMark, ConnectionMark, RopeMark, WheelMark
from derive.figures.placed_bodies import SilhouetteMark, ThickBar, placed_outline, with_its_shape
from derive.figures.positions import column_of
from derive.figures.recognition import (
    Link,
    is_fixed,
    kept_length,
    links_about_fixed,
    moving_in,
    same,
    track_of,
)
from derive.figures.rollers import FAR, arm_of, roller_of, way_marks
from derive.figures.space import numeric
from derive.figures.surfaces import Circle
from derive.figures.surroundings import FixedEnd, FloorMark, GroundMark
from derive.figures.turning import angle_marks, bound_place, downwards
from derive.mechanics.bodies.regions import Point
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.no_slip import Rolling, contact_velocity
from derive.mechanics.model.system import System
from derive.steps.step import is_zero

ZERO, ONE = Integer(0), Integer(1)
ACROSS = column(0, 0, 1)
PAST = Rational(6, 5)  # height of a wall, relative to the height of the point that touches it
ROLLING = 60.0  # length of the ground on either side of a rolling body, in points
TENSIONS = ("S", "T")  # first letters of tensions; a constraint by a string is not a floor or a wall


@dataclass(frozen=True)
class Leaning:
    """A point with a component that is fixed by a constraint.

    component   the index of the component
    at          the value of the component
    """

    constraint: Constraint
    place: Location
    component: int
    at: Expr


class Touching:
    """The marks for the constraints of a plane system, and the constraints that are shown by these marks."""

    def __init__(self, system: System):
        self.system = system
        self.shown: set[Constraint] = set()
        self.values: dict[Symbol, Expr] = {}
        self.told = False  # whether marks of `contacts` show a rolling condition
        self.rolls_at_rest: list[Any] = []  # bodies whose rolling surface or string is recognised
        is_plane = len(system.places[0].components) == 2
        self.marks: list[Mark] = [*self._leaning(), *self._wound(), *self._round()] if is_plane else []

    # --- walls and floors ---

    def _leaning(self) -> Iterable[Mark]:
        found = list(leanings(self.system))
        for each in found:
            self.shown.add(each.constraint)
            self.values.update(_solved(each.constraint, self.values))
        held = [a for a in found for b in found if a.component < b.component and same(a.place, b.place)]
        for each in held:
            other = next(b for b in found if b.component == 1 and same(b.place, each.place))
            yield FixedEnd(ImmutableDenseMatrix([each.at, other.at]), downwards(2), True)
        free = [each for each in found if not any(same(each.place, one.place) for one in held)]
        corners = [Location((each.at, ZERO)) for each in free if each.component == 0]
        for each in free:
            if each.component == 1:
                above = [each.place, *corners]
                yield FloorMark(tuple(ImmutableDenseMatrix([p.components[0], each.at]) for p in above))
            else:
                yield self._wall(each, [other.at for other in free if other.component == 1])

    def _wall(self, lean: Leaning, floors: list[Expr]) -> Mark:
        """Return the wall from the floor, or from the lowest mass, to a little above the point that touches it."""
        height = lean.place.components[1]
        others = [at for _, at in self.system.masses]
        low = (
            floors[0]
            if floors
            else min((at.components[1] for at in others), key=lambda height: numeric(height, self.values))
        )
        beside = sum(numeric(at.components[0] - lean.at, self.values) for at in others)
        solid = ImmutableDenseMatrix([-1 if beside > 0 else 1, 0])
        top = low + PAST * (height - low)
        return GroundMark(ImmutableDenseMatrix([lean.at, low]), ImmutableDenseMatrix([lean.at, top]), solid)

    # --- strings on round bodies ---

    def _wound(self) -> Iterable[Mark]:
        for placed, radius, _ in self._wheels():
            if is_fixed(self.system, placed.centre):
                yield from self._pulley(placed, radius)
            else:
                yield from self._unwinding(placed, radius)

    def _wheels(self) -> Iterator[tuple[Any, Expr, Location]]:
        """Yield the bodies with a round edge in the plane, with the radius and the centre of the circle."""
        for placed in map(with_its_shape, self.system.bodies):
            roller = roller_of(self.system, placed) if not placed_outline(placed) else None
            if roller is not None:
                if (arm := arm_of(placed, roller)).is_Symbol and not moving_in(self.system, arm):
                    self.values[arm] = Rational(3, 5) * roller.radius
                yield placed, roller.radius, roller.hub
            radius, own_points = getattr(placed.body, "radius", None), _points_of(placed.body)
            for mark in placed_outline(placed):
                if isinstance(mark, WheelMark):
                    yield placed, mark.radius, Location(tuple(mark.centre))
                elif isinstance(mark, SilhouetteMark) and radius is not None and "circle_centre" in own_points:
                    own = ImmutableDenseMatrix(own_points["circle_centre"].position - placed.point.position)
                    yield placed, radius, placed.at + placed.seen_in_space(own)

    def _pulley(self, placed: Any, radius: Expr) -> Iterable[Mark]:
        """Yield strings from a wheel with a fixed axle to particles that move on tangents of its rim."""
        hung = False
        for each in self.system.constraints:
            for particle in self.system.particles:
                track = track_of(self.system, particle.at)
                turning = moving_in(self.system, placed.turned)
                if track is None or set(each.coordinates) != {*turning, track.by} or track.way.components[0] != 0:
                    continue
                beside = particle.at.components[0] - placed.centre.components[0]
                turned = each.along(next(iter(turning))) / each.along(track.by)
                if is_zero(beside**2 - radius**2) and is_zero(turned**2 - radius**2):
                    top = Location((particle.at.components[0], placed.centre.components[1]))
                    yield RopeMark((column_of(particle.at), column_of(top)), (ZERO, ZERO))
                    self.shown.add(each)
                    hung = True
        if hung:
            above = column_of(placed.centre + Location((ZERO, Rational(9, 5) * radius)))
            yield BarMark(column_of(placed.centre), above)
            yield FixedEnd(above, downwards(2))

    def _unwinding(self, placed: Any, radius: Expr) -> Iterable[Mark]:
        """Yield the string on which a wheel moves up and down, and which is wound on the wheel."""
        track = track_of(self.system, placed.centre)
        if track is None or track.way.components[0] != 0 or not is_fixed(self.system, track.start):
            return
        for side in (-1, 1):
            beside = Location((side * radius, ZERO))
            if (kept := self.at_rest(placed, placed.centre + beside)) is not None:
                self.shown |= kept
                self.rolls_at_rest.append(placed)
                top = column_of(track.start + beside)
                yield RopeMark((column_of(placed.centre + beside), top), (ZERO, ZERO))
                yield FixedEnd(top, downwards(2))
                self._has_come(track.by, FAR * radius)
                yield from way_marks(track.start, placed.centre, Location((-side, ZERO)), track.by, radius)

    def _has_come(self, q: Symbol, far: Expr) -> None:
        """Set the displacement at which a wheel is drawn, so that its dimension line is visible."""
        if self.system.coordinates.get(q) == "length":
            self.values[q] = far

    # --- fixed circles ---

    def _round(self) -> Iterable[Mark]:
        """Yield the circle outside or inside which a wheel rolls, or the straight ground on which it rolls."""
        told = any(condition.fact(Rolling) for condition in self.system.conditions)
        for placed, radius, hub in self._wheels():
            link = next(links_about_fixed(self.system, hub), None)
            if link is not None and not told:
                yield from self._circle(placed, radius, link)
            for foot in self._feet(hub, radius):
                if (kept := self.at_rest(placed, foot)) is not None:
                    self.shown |= kept
                    self.rolls_at_rest.append(placed)
                    for q in self._moving(hub):
                        self._has_come(q, FAR * radius)
                    if not same(placed.centre, hub):
                        yield FloorMark((column_of(foot),), 0.0, (ROLLING, ROLLING))

    def _feet(self, hub: Location, radius: Expr) -> Iterable[Location]:
        """Yield the points at which a circle that moves on a straight line may touch straight ground below it."""
        way = Location(tuple(tidied(c.diff(q)) for c in hub.components for q in self._moving(hub)))
        if len(way.components) == 2 and is_fixed(self.system, way):
            size = sqrt(tidied(way.components[0] ** 2 + way.components[1] ** 2))
            x, y = (tidied(c / size) for c in way.components)
            for below in (Location((y, -x)), Location((-y, x))):
                if numeric(below.components[1]) < 0:
                    foot: Location = hub + radius * below
                    yield foot

    def _moving(self, place: Location) -> list[Symbol]:
        return sorted(moving_in(self.system, *place.components), key=str)

    def _circle(self, placed: Any, radius: Expr, link: Link) -> Iterable[Mark]:
        kept = kept_length(self.system, link.length)
        far = link.length if kept is None else kept
        inside = self._is_inside(placed, radius, link, far)
        if inside is None or (kept is None and not link.is_constant):
            return
        size = tidied(far + radius if inside else far - radius)
        if size == 0:
            return  # the body rotates about a fixed point of its rim
        start = column_of(link.start)
        bound = link.end if kept is None else bound_place(link.end, link.length, far)
        contact = column_of(link.start + (size / far) * (bound - link.start))
        yield Circle(start, ACROSS, size, not inside)
        yield PointMark(start)
        yield ConnectionMark(start, contact, label=size)
        yield from angle_marks(self.system, link)
        self.rolls_at_rest.append(placed)
        turning = {*moving_in(self.system, *link.way.components), *moving_in(self.system, placed.turned)}
        self.shown |= {c for c in self.system.constraints if set(c.coordinates) <= turning}
        if kept is not None:
            self.values[link.length] = far

    def _is_inside(self, placed: Any, radius: Expr, link: Link, far: Expr) -> bool | None:
        """Return whether the body is inside the fixed circle that it touches; None if no circle is recognised."""
        if kept_length(self.system, link.length) is not None:
            sizes = [tidied(far - radius), tidied(far + radius)]
            plain = [size.is_Symbol for size in sizes]
            return plain[1] if any(plain) else None
        for sign in (1, -1):
            contact: Location = link.end + (sign * radius / link.length) * link.way
            if (kept := self.at_rest(placed, contact)) is not None:
                self.shown |= kept
                return sign == 1
        return None

    # --- points at rest ---

    def at_rest(self, placed: Any, at: Location) -> set[Constraint] | None:
        """Return the constraints that keep the particle at a point of a body at rest; None if the particle moves."""
        moving = list(self.system.coordinates)
        found: set[Constraint] = set()
        for component in contact_velocity(placed, at, None):
            if component == 0:
                continue
            keeping = next((c for c in self.system.constraints if _follows(component, c, moving)), None)
            if keeping is None:
                return None
            found.add(keeping)
        return found


def leanings(system: System) -> Iterator[Leaning]:
    """Yield the points with a component that is fixed by a constraint, except constraints by strings."""
    places = [particle.at for particle in system.particles]
    for placed in system.bodies:
        for mark in placed_outline(with_its_shape(placed)):
            if isinstance(mark, ThickBar):
                places += [Location(tuple(mark.start)), Location(tuple(mark.end))]
    for each in system.constraints:
        if each.in_rates or each.force.name.startswith(TENSIONS):
            continue
        for place in places:
            for k, component in enumerate(place.components):
                rests = [tidied((component - sign * each.residual).expand()) for sign in (1, -1)]
                at = next((rest for rest in rests if not moving_in(system, rest)), None)
                if at is not None and moving_in(system, component):
                    yield Leaning(each, place, k, at)


def _solved(constraint: Constraint, known: Mapping[Symbol, Expr]) -> dict[Symbol, Expr]:
    """Solve a constraint for one coordinate, and return its formula in the others; an empty mapping if this is
    impossible."""
    for q in constraint.coordinates:
        share = constraint.along(q)
        if share.is_number and q not in known:
            return {q: tidied(q - constraint.residual / share)}
    return {}


def _follows(component: Expr, constraint: Constraint, moving: list[Symbol]) -> bool:
    """Return whether a constraint makes a velocity vanish: the velocity is a multiple of the rate of the constraint."""
    kept = constraint.velocity(moving)
    pairs = [(component.diff(rate(q)), kept.diff(rate(q))) for q in moving]
    share = next((a / b for a, b in pairs if b != 0 and a != 0), None)
    return share is not None and is_zero(tidied(component - share * kept))


def _points_of(body: Any) -> Mapping[str, Point]:
    points: Mapping[str, Point] = body.points() if hasattr(body, "points") else {}
    return points
