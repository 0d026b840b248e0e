"""What bodies roll on, where a condition of rolling says at which place they touch it: fixed cylinders."""

from __future__ import annotations

from collections.abc import Iterable

from sympy import Add, Float, Integer

from derive.algebra.expressions import column
from derive.figures.annotations import PointMark
from derive.figures.marks import Mark
from derive.figures.parts import ConnectionMark
from derive.figures.positions import column_of
from derive.figures.recognition import Link, is_fixed, link_from_fixed
from derive.figures.surfaces import Circle
from derive.figures.turning import angle_marks
from derive.mechanics.systems.no_slip import Rolling
from derive.mechanics.systems.places import Location
from derive.mechanics.systems.system import System

ACROSS = column(0, 0, 1)


def contact_marks(system: System) -> Iterable[Mark]:
    """Of each body that rolls in a plane on what is at rest: the cylinder that it touches, and the point of contact."""
    for condition in system.conditions:
        rolling = condition.fact(Rolling)
        if rolling is None or rolling.ground is not None or len(rolling.at.components) != 2:
            continue
        contact = Location(tuple(c.subs(system.known) for c in rolling.at.components))
        link = link_from_fixed(system, contact)
        if link is not None:
            yield from _cylinder(system, link, rolling)


def _cylinder(system: System, link: Link, rolling: Rolling) -> Iterable[Mark]:
    """Seen along its axis, with the way from there to the contact and the angle of that."""
    centre, contact = column_of(link.start), column_of(link.end)
    around = Circle(centre, ACROSS, link.length, _is_outside(system, link, rolling), name="a fixed cylinder")
    yield around
    yield PointMark(centre)
    yield ConnectionMark(centre, contact, label=link.length)
    yield PointMark(contact)
    yield from angle_marks(system, link)


def _is_outside(system: System, link: Link, rolling: Rolling) -> bool:
    """Whether the body is farther from the axis than the contact is, with all letters alike and no coordinate."""
    middle = rolling.body.centre - link.start
    beyond = Add(*(c**2 for c in middle.components)) - link.length**2
    there = beyond.xreplace(dict.fromkeys(system.coordinates, Integer(0))).subs(system.known)
    number = there.xreplace(dict.fromkeys(there.free_symbols, Float(1)))
    return bool(is_fixed(system, link.start) and number.evalf() > 0)
