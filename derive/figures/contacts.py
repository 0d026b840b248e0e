"""Marks of fixed surfaces on which bodies roll. The rolling conditions specify the points of contact."""

from __future__ import annotations

from collections.abc import Iterable

from sympy import Add, Expr, Integer, Rational, cos, pi, sqrt

from derive.algebra.expressions import column
from derive.algebra.tidy import tidied
from derive.figures.annotations import Line, PointMark, Turn
from derive.figures.links import Link, is_fixed, link_from_fixed, moving_in
from derive.figures.marks import Mark
from derive.figures.parts import ConnectionMark
from derive.figures.positions import column_of
from derive.figures.space import numeric
from derive.figures.surfaces import Circle
from derive.figures.surroundings import UprightAngle, WayMark
from derive.figures.turning import angle_marks
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.no_slip import Rolling
from derive.mechanics.model.system import System
from derive.steps.step import is_zero

ZERO = Integer(0)
ACROSS = column(0, 0, 1)
# Distances of a rotation arrow and of the end of its axis from the fixed point, relative to the distance of
# the centre of mass from the fixed point.
ROUND_AT, LONG = Rational(3, 2), Rational(17, 10)


def contact_marks(system: System) -> Iterable[Mark]:
    """Yield, for each body that rolls on a fixed surface, the marks of this surface and of the point of contact.

    There are marks only if the surface is a cylinder seen along its axis, or a horizontal plane through a fixed point
    of the body.
    """
    for condition in system.conditions:
        rolling = condition.fact(Rolling)
        if rolling is None or rolling.ground is not None:
            continue
        contact = Location(tuple(c.subs(system.known) for c in rolling.at.components))
        if len(contact.components) == 3:
            yield from _on_a_plane(system, rolling, contact)
            continue
        link = link_from_fixed(system, contact)
        if link is not None:
            yield from _cylinder(system, link, rolling)


def _on_a_plane(system: System, rolling: Rolling, contact: Location) -> Iterable[Mark]:
    """Yield the marks of a body in space that rolls on a horizontal plane through its fixed point.

    The marks are the circle of the points of contact, and the line from the fixed point to the contact. The angle
    between this line and the axis of the body, and the spin about this axis, are also marked.
    """
    body = rolling.body
    way = contact - body.at
    moving = moving_in(system, *way.components)
    length = sqrt(tidied(Add(*(c**2 for c in way.components))))
    if not is_fixed(system, body.at) or way.components[2] != 0 or len(moving) != 1 or moving_in(system, length):
        return
    (q,) = moving
    start, end = column_of(body.at), column_of(contact)
    yield WayMark(end, q, -pi, pi)
    yield Line(start, end, "construction")
    yield PointMark(end)
    _, own = body.turned.turns[-1]
    along = column_of(body.centre.with_values(system.known) - body.at)
    axis = tidied(Add(*(c**2 for c in along)))
    cosine = Add(*(a * b for a, b in zip(along, end - start, strict=True))) / (length * sqrt(axis))
    letters = {letter for _, angle in body.turned.turns for letter in angle.free_symbols}
    leaning = next((a for a in sorted(letters, key=str) if is_zero(tidied(cosine) - cos(a))), None)
    if leaning is not None and leaning not in moving:
        yield UprightAngle(start, end - start, along, label=leaning)
    if own.is_Symbol:
        yield Line(start, start + LONG * along, "construction")
        yield Turn(start + ROUND_AT * along, along, Rational(1, 5), label=own)


def _cylinder(system: System, link: Link, rolling: Rolling) -> Iterable[Mark]:
    """Yield the marks of a cylinder seen along its axis, of the point of contact, and of the angle of this point."""
    centre, contact = column_of(link.start), column_of(link.end)
    outside = _is_outside(system, link, rolling)
    yield Circle(centre, ACROSS, link.length, outside, name="fixed_cylinder")
    yield PointMark(centre)
    between = _between_axes(system, link, rolling)
    if outside or between is None:
        yield ConnectionMark(centre, contact, label=link.length)
    else:  # the body that rolls inside covers the line to the contact
        yield Line(centre, column_of(rolling.body.centre), label=between)
    yield PointMark(contact)
    yield from angle_marks(system, link)


def _between_axes(system: System, link: Link, rolling: Rolling) -> Expr | None:
    way = [c.subs(system.known) for c in (rolling.body.centre - link.start).components]
    length = sqrt(tidied(Add(*(c**2 for c in way))))
    return None if length == 0 or moving_in(system, length) else length


def _is_outside(system: System, link: Link, rolling: Rolling) -> bool:
    middle = rolling.body.centre - link.start
    beyond = Add(*(c**2 for c in middle.components)) - link.length**2
    at_zero = dict.fromkeys(system.coordinates, ZERO)
    return is_fixed(system, link.start) and numeric(beyond.subs(system.known), at_zero) > 0
