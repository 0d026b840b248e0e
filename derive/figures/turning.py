"""Rotating parts, recognised from formulas: rods on pivots, links of variable length, and their angles."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, pi, sin, sqrt

from derive.algebra.expressions import TIME
from derive.algebra.normal_form import vanishes
from derive.algebra.tidy import tidied
from derive.figures.annotations import Axis, AxisOfRotation, PointMark
from derive.figures.elements import CLEAR
from derive.figures.marks import Mark
from derive.figures.parts import COIL, BarMark, ConnectionMark, ParticleMark
from derive.figures.positions import column_of
from derive.figures.recognition import Link, angle_of_link, is_spring, kept_length, moving_in, same
from derive.figures.surroundings import AngleBetween, DistanceMark, FixedEnd, WayMark
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import Particle, System
from derive.steps.step import is_zero

ZERO = Integer(0)
FAR = Rational(8, 5)  # drawn range of a curve, relative to the value of its coordinate
HANGING = frozenset({"bob", "pendulum"})  # names of particles that hang on a rod or a string
THREADED = frozenset({"bead", "ring", "sleeve", "collar"})  # names of particles on a wire


def turning_marks(system: System, link: Link, which: Particle, named: Sequence[Location] = ()) -> Iterable[Mark]:
    """Yield a particle at the end of its link, with the link and its angle.

    named   positions of parts such as pivots; in a prescribed rotation, a link from a named or moving point is a rod
    """
    start, end = column_of(link.start), column_of(link.end)
    rows = len(link.start.components)
    yield ParticleMark(end, label=which.mass)
    yield from angle_marks(system, link)
    moving = moving_in(system, *link.way.components)
    around = [q for q in system.coordinates if q in moving and system.coordinates[q] == "angle"]
    held = any(same(link.start, place) for place in named) or bool(moving_in(system, *link.start.components))
    alone = moving_in(system, *link.end.components) - {TIME} == set(around[:1])
    if link.is_constant and TIME in moving and around and held and not _is_called(which.name, THREADED):
        yield BarMark(start, end, label=link.length)
        yield PointMark(start)
        yield from _arm(system, link.start)
    elif link.is_constant and TIME in moving and alone and around:
        yield WayMark(end, around[0], -pi, pi, "wire")
        yield ConnectionMark(start, end, label=link.length)
    elif link.is_constant and not is_rod_for(system, link, which.name):
        yield ConnectionMark(start, end, label=link.length)
        if not _is_rim(system, link):
            yield PointMark(start)
            if around and moving - {TIME} == set(around[:1]):
                yield WayMark(end, around[0], -pi, pi, "wire" if _is_called(which.name, THREADED) else "trace")
    elif link.is_constant:
        yield BarMark(start, end, label=link.length)
        sliding = sorted(moving_in(system, *link.start.components) - {TIME}, key=str)
        if not any(same(link.start, particle.at) for particle in system.particles) and not sliding:
            yield FixedEnd(start, downwards(rows), True)
            yield from _shaken(system, link.start)
        elif len(sliding) == 1 and not _is_joint(system, link.start):
            far = pi if system.coordinates[sliding[0]] == "angle" else FAR * sliding[0]
            yield WayMark(start, sliding[0], -far, far, "wire")
            yield PointMark(start)
    elif (components := _components(system, link)) and not link.length.is_Symbol:
        yield from components
    elif _has_spring(system, link):
        up = ImmutableDenseMatrix([-link.way.components[1], link.way.components[0]]) if rows == 2 else None
        yield DistanceMark(start, end, up, COIL + CLEAR, label=link.length)
    else:
        if (radius := kept_length(system, link.length)) is not None and around:
            yield WayMark(column_of(bound_place(link.end, link.length, radius)), around[0], -pi, pi, "wire")
        alone = moving_in(system, *link.end.components) - {TIME} == {link.length}
        if TIME in moving and alone and not moving_in(system, *link.start.components):
            yield WayMark(end, link.length, ZERO, Rational(3, 2) * link.length, "wire")
        yield ConnectionMark(start, end, label=link.length)
        if not any(same(link.start, place) for each in system.between for place in (each.start, each.end)):
            yield PointMark(start)


def is_rod_for(system: System, link: Link, name: str) -> bool:
    """Return whether a link of constant length is a rod or a string, not the radius of a hoop on which a bead slides.

    The name of the particle decides; otherwise a link is a rod or a string if a mass is at its start, or if the symbol
    of its length begins with l. A radius of a round body is neither.
    """
    if _is_called(name, THREADED) or _is_rim(system, link):
        return False
    if _is_called(name, HANGING) or _is_joint(system, link.start):
        return True
    return all(letter.name.lower().startswith("l") for letter in link.length.free_symbols)


def _is_joint(system: System, place: Location) -> bool:
    """Return whether a particle or the centre of mass of a body is at a point."""
    return any(same(place, at) for _, at in system.masses)


def _is_called(name: str, kinds: frozenset[str]) -> bool:
    return any(part.rstrip("0123456789") in kinds for part in name.lower().replace("-", "_").split("_"))


def _is_rim(system: System, link: Link) -> bool:
    """Return whether a link is a radius of a round body, so its end is on the rim of the body."""
    for placed in system.bodies:
        radius = getattr(placed.body, "radius", None)
        if radius is not None and same(placed.centre, link.start) and is_zero(radius - link.length):
            return True
    return False


def bound_place(place: Location, letter: Expr, value: Expr) -> Location:
    return Location(tuple(c.xreplace({letter: value}) for c in place.components))


def downwards(rows: int) -> ImmutableDenseMatrix:
    return ImmutableDenseMatrix([0] * (rows - 1) + [-1])


def angle_marks(system: System, link: Link) -> Iterable[Mark]:
    """Yield the angle between a link and a fixed direction; in space, also yield the angle of the link's horizontal
    projection."""
    turned = angle_of_link(system, link)
    if turned is not None:
        angle, zero = turned
        if len(link.way.components) == 2 or moving_in(system, angle) != {TIME}:  # otherwise the axis shows the rate
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


def _shaken(system: System, support: Location) -> Iterable[Mark]:
    """Yield the displacement of a support that moves along x or y."""
    moving = moving_in(system, *support.components)
    rest = Location(tuple(_terms_without(c, moving) for c in support.components))
    moved = [c for c in (support - rest).components if c != 0]
    if len(rest.components) == 2 and len(moved) == 1:
        side = [0, 1] if (support - rest).components[0] != 0 else [-1, 0]
        yield DistanceMark(column_of(rest), column_of(support), ImmutableDenseMatrix(side), 18.0, label=moved[0])


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
            through = column_of(_on_the_axis(link.start))
            yield AxisOfRotation(through, ImmutableDenseMatrix([0, 0, 1]), rate, label=rate)
        elif moving_in(system, angle):
            yield ConnectionMark(start, start + level)
            yield ConnectionMark(start + level, column_of(link.end))
            yield AngleBetween(start, ImmutableDenseMatrix([1, 0, 0]), level, True, label=angle)
        return


def _on_the_axis(carried: Location) -> Location:
    """Return the point on the axis about which a point rotates with a prescribed motion."""
    return Location(tuple(_terms_without(c, {TIME}) for c in carried.components))


def _arm(system: System, carried: Location) -> Iterable[Mark]:
    """Yield the arm from the axis to a point that rotates with a prescribed motion."""
    foot = _on_the_axis(carried)
    square = tidied(Add(*(c**2 for c in (carried - foot).components)))
    if square != 0 and not moving_in(system, square):
        yield BarMark(column_of(foot), column_of(carried), label=sqrt(square))


def _terms_without(value: Expr, letters: set[Symbol]) -> Expr:
    return Add(*(term for term in Add.make_args(value) if not term.free_symbols & letters))
