"""The polar coordinates of particles: the line from a point to a particle, its angle, and the curve of the particle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, pi, sin, sqrt

from derive.algebra.expressions import TIME
from derive.algebra.normal_form import vanishes
from derive.algebra.prescribed import depends_on_time
from derive.algebra.tidy import tidied
from derive.figures.annotations import Axis, AxisOfRotation, PointMark
from derive.figures.elements import CLEAR
from derive.figures.links import Link, angle_of_link, is_spring, moving_in, same
from derive.figures.marks import Mark
from derive.figures.parts import COIL, ConnectionMark
from derive.figures.positions import column_of
from derive.figures.surroundings import AngleBetween, DistanceMark, MovingEnd, WayMark
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import Central, System

ZERO = Integer(0)
PAST_SUPPORT = 26.0  # the distance of a dimension line from a moving support, in points


def link_marks(system: System, link: Link) -> Iterable[Mark]:
    """Yield the line from a point to a particle, with the angle or the length of this line."""
    start, end = column_of(link.start), column_of(link.end)
    yield from angle_marks(system, link)
    moving = moving_in(system, *link.way.components)
    around = [q for q in system.coordinates if q in moving and system.coordinates[q] == "angle"]
    if not link.is_constant and not link.length.is_Symbol and (components := _components(system, link)):
        yield from components
        return
    if not link.is_constant and _has_spring(system, link):
        up = ImmutableDenseMatrix([-link.way.components[1], link.way.components[0]]) if len(start) == 2 else None
        yield DistanceMark(start, end, up, COIL + CLEAR, label=link.length)
        return
    yield ConnectionMark(start, end, label=link.length)
    starts_at_end = any(same(link.start, place) for each in system.between for place in (each.start, each.end))
    if not starts_at_end and not moving_in(system, *link.start.components) - {TIME}:
        yield PointMark(start)
    if link.is_constant and around and moving_in(system, *link.end.components) - {TIME} == set(around[:1]):
        yield WayMark(end, around[0], -pi, pi)


def downwards(rows: int) -> ImmutableDenseMatrix:
    return ImmutableDenseMatrix([0] * (rows - 1) + [-1])


def angle_marks(system: System, link: Link) -> Iterable[Mark]:
    """Yield the angle between a link and a fixed direction; in space, also the angle of the horizontal projection."""
    turned = angle_of_link(system, link)
    if turned is not None:
        angle, zero = turned
        # If only the time changes an angle in space, an axis with the rate of the angle is drawn in place of the angle.
        if len(link.way.components) == 2 or moving_in(system, angle) != {TIME}:
            yield AngleBetween(column_of(link.start), column_of(zero), column_of(link.way), True, label=angle)
    if len(link.way.components) == 3:
        yield from _round_the_vertical(system, link)


def _components(system: System, link: Link) -> list[Mark]:
    """Return the axes along which the components of a link are measured, if the components are coordinates."""
    lengths = [q for q in moving_in(system, link.length) if system.coordinates.get(q) == "length"]
    ways = {q: ImmutableDenseMatrix([diff(c, q) for c in link.way.components]) for q in lengths}
    if len(ways) < 2 or any(moving_in(system, *way) - {TIME} for way in ways.values()):
        return []
    start = column_of(link.start)
    return [Axis(start, start + Rational(4, 3) * q * way, label=q) for q, way in sorted(ways.items(), key=str)]


def _has_spring(system: System, link: Link) -> bool:
    return any(
        is_spring(each) and same(a, link.start) and same(b, link.end)
        for each in system.between
        for a, b in ((each.start, each.end), (each.end, each.start))
    )


def natural_length(system: System, spring: Central) -> Expr | None:
    """Return the natural length of a spring; None if it is not a constant symbol."""
    pull, stiffness = (diff(spring.energy, spring.distance, n) for n in (1, 2))
    length = tidied(spring.distance - pull / stiffness)
    return length if length.is_Symbol and not moving_in(system, length) else None


def moving_end(system: System, support: Location, joint: bool) -> Iterator[Mark]:
    """Yield a support with a prescribed motion along a straight line in a plane. If this line is horizontal or
    vertical, also yield the displacement of the support."""
    if len(support.components) != 2 or moving_in(system, *support.components) != {TIME}:
        return
    rest = on_the_axis(support)
    x, y = (tidied(c) for c in (support - rest).components)
    slope = tidied(y / x) if x != 0 else ZERO
    if moving_in(system, slope):
        return
    sense = _sense(y if x == 0 else x)
    along = (sense or 1) * ImmutableDenseMatrix([1, slope] if x != 0 else [0, 1])
    side = ImmutableDenseMatrix([0, 1] if x != 0 else [-1, 0])
    pull = tidied(diff(y if x == 0 else x, TIME, 2))
    is_constant = pull != 0 and not depends_on_time(pull)
    motion = (-pull if pull.could_extract_minus_sign() else pull) if is_constant else None
    yield MovingEnd(column_of(support), along, side, joint, sense == 0, motion)
    if x == 0 or y == 0:
        yield DistanceMark(column_of(rest), column_of(support), side, PAST_SUPPORT, label=x if y == 0 else y)


def _sense(value: Expr) -> int:
    """Return 1 if a function of time increases, -1 if it decreases, and 0 if neither is known."""
    rate = tidied(diff(value, TIME)).xreplace({TIME: Symbol("t", positive=True)})
    return 1 if rate.is_positive else -1 if rate.is_negative else 0


def _round_the_vertical(system: System, link: Link) -> Iterable[Mark]:
    """Yield the angle of the horizontal projection of a link, or the axis of its rotation if the rate is prescribed."""
    x, y, _ = link.way.components
    angles = sorted({f.args[0] for c in (x, y) for f in c.atoms(sin, cos)}, key=str)
    start, level = column_of(link.start), ImmutableDenseMatrix([x, y, 0])
    for angle in angles:
        if not vanishes(x * sin(angle) - y * cos(angle)):
            continue
        rate = diff(angle, TIME)
        if rate != 0:
            through = column_of(on_the_axis(link.start))
            yield AxisOfRotation(through, ImmutableDenseMatrix([0, 0, 1]), rate, label=rate)
        elif moving_in(system, angle):
            yield ConnectionMark(start, start + level)
            yield ConnectionMark(start + level, column_of(link.end))
            yield AngleBetween(start, ImmutableDenseMatrix([1, 0, 0]), level, True, label=angle)
        return


def on_the_axis(carried: Location) -> Location:
    """Return a position without the terms that contain the time: in a prescribed rotation, a place on the axis."""
    return Location(tuple(_terms_without(c, {TIME}) for c in carried.components))


def _terms_without(value: Expr, letters: set[Symbol]) -> Expr:
    return Add(*(term for term in Add.make_args(value) if not term.free_symbols & letters))


def line_between(start: Location, end: Location) -> Link:
    """Return the line between two places as a link whose length counts as constant."""
    length = sqrt(tidied(Add(*(c**2 for c in (end - start).components))))
    return Link(start, end, length, True)
