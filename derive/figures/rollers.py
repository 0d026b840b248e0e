"""Rolling on a straight line, recognised from formulas: the centre of a circle moves on a line while the body rotates.

The radius of the circle is the displacement of the centre per unit angle. The circle touches the line where the
velocity of rotation cancels the velocity of the centre.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, Integer, Rational, Symbol, cos, diff, pi, sin, sqrt

from derive.algebra.expressions import TIME
from derive.algebra.tidy import tidied
from derive.figures.annotations import LengthMark, Line, PointMark
from derive.figures.marks import Mark
from derive.figures.parts import ConnectionMark, ParticleMark, WheelMark
from derive.figures.positions import column_of
from derive.figures.recognition import Link, angle_of_link, is_fixed, moving_in
from derive.figures.space import numeric
from derive.figures.surroundings import WayMark
from derive.figures.turning import angle_marks
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import Particle, System
from derive.steps.step import is_zero

ZERO = Integer(0)
FAR = Rational(5, 2)  # displacement of a rolling body in the drawing, relative to its radius
ROUND = "round_body"


@dataclass(frozen=True)
class Roller:
    """A circle that rolls on a fixed straight line.

    hub      the centre of the circle
    radius   the radius of the circle
    foot     the point of contact with the line
    by       the coordinate with which the centre moves
    """

    hub: Location
    radius: Expr
    foot: Location
    by: Symbol


def roller_of(system: System, placed: Any) -> Roller | None:
    """Return the rolling circle of a body whose plane motion is a rolling motion; otherwise None."""
    if not placed.is_plane:
        return None
    hub = _steady_part(system, placed.centre)
    c, s = cos(placed.turned), sin(placed.turned)
    x, y = (placed.centre - hub).components
    own = tidied(x * c + y * s), tidied(y * c - x * s)
    return None if moving_in(system, *own) else _roller(system, hub, placed.turned)


def roller_with(system: System, particle: Particle) -> tuple[Roller, Link] | None:
    """Return the rolling circle that carries a particle with one coordinate, and the link from its centre to the
    particle; None if the particle does not move in this way."""
    hub = _steady_part(system, particle.at)
    moving = moving_in(system, *particle.at.components)
    if len(hub.components) != 2 or len(moving) != 1 or not moving_in(system, *hub.components):
        return None
    size = sqrt(tidied(Add(*(c**2 for c in (particle.at - hub).components))))
    if size == 0 or moving_in(system, size):
        return None
    x, y = (particle.at - hub).components
    (q,) = moving
    rate = tidied((x * diff(y, q) - y * diff(x, q)) / size**2)
    roller = _roller(system, hub, rate * q) if rate.is_number else None
    return (roller, Link(hub, particle.at, size, True)) if roller is not None else None


def _steady_part(system: System, place: Location) -> Location:
    """Return a position without the terms that contain sines or cosines of a coordinate or of time."""
    components = []
    for each in place.components:
        terms = Add.make_args(each.expand())
        components.append(Add(*(t for t in terms if not any(moving_in(system, f.args[0]) for f in t.atoms(sin, cos)))))
    return Location(tuple(components))


def _roller(system: System, hub: Location, turned: Expr) -> Roller | None:
    moving, turning = moving_in(system, *hub.components), moving_in(system, turned)
    if len(moving) != 1 or len(turning) != 1 or TIME in moving | turning:
        return None
    (q,), (angle,) = moving, turning
    way = Location(tuple(diff(c, q) for c in hub.components))
    share = _rates_of(system, angle, q)
    turn = diff(turned, angle)
    if share is None or not is_fixed(system, way) or moving_in(system, turn) or is_zero(turn * share):
        return None
    speed = sqrt(tidied(Add(*(c**2 for c in way.components))))
    radius = tidied(speed / (turn * share))
    x, y = (tidied(c / speed) for c in way.components)
    foot = hub + radius * Location((-y, x))
    size = radius if numeric(radius) > 0 else -radius
    return Roller(hub, tidied(size), foot, q) if not moving_in(system, radius) else None


def _rates_of(system: System, angle: Symbol, q: Symbol) -> Expr | None:
    """Return the derivative of an angle with respect to a coordinate, from a constraint; None without such a
    constraint."""
    if angle == q:
        return Integer(1)
    for each in system.constraints:
        if set(each.coordinates) == {angle, q} and not is_zero(each.along(angle)):
            return tidied(-each.along(q) / each.along(angle))
    return None


def arm_of(placed: Any, roller: Roller) -> Expr:
    """Return the distance of the centre of mass of a body from the centre of its rolling circle."""
    return sqrt(tidied(Add(*(c**2 for c in (placed.centre - roller.hub).components))))


# --- marks -----------------------------------------------------------------------------------------------------------


def rolling_marks(system: System, placed: Any, roller: Roller) -> Iterable[Mark]:
    """Yield a wheel for a body of which only the moments are known, and the line to its centre of mass."""
    size = arm_of(placed, roller)
    ahead = Location((cos(placed.turned), sin(placed.turned)))
    pointer = column_of(ahead) if size == 0 else None
    measures = (("radius", roller.radius),)
    yield WheelMark(column_of(roller.hub), roller.radius, pointer, label=roller.radius, name=ROUND, measures=measures)
    if size == 0:
        yield from angle_marks(system, Link(roller.hub, roller.hub + ahead, Integer(1), True))
    else:
        yield from arm_marks(system, Link(roller.hub, placed.centre, size, True))


def arm_marks(system: System, link: Link) -> Iterable[Mark]:
    """Yield a dashed line from the centre of a rolling circle to a point that rotates with it, and its angle."""
    yield Line(column_of(link.start), column_of(link.end), "construction", label=link.length)
    yield PointMark(column_of(link.end))
    yield from angle_marks(system, link)


def carrying_marks(system: System, particle: Particle, roller: Roller, link: Link) -> Iterable[Mark]:
    """Yield a particle on a rolling circle, its curve, the circle, and the line on which the circle rolls."""
    q = roller.by
    yield ParticleMark(column_of(particle.at), label=particle.mass)
    yield WayMark(column_of(particle.at), q, -pi, pi, "wire")
    yield WayMark(column_of(roller.foot), q, -pi, pi)
    turned = angle_of_link(system, link)
    if turned is None:
        return
    angle, _ = turned
    u = Symbol("u", real=True)
    way = Location(tuple(c.xreplace({sin(angle): sin(u), cos(angle): cos(u)}) for c in link.way.components))
    around = column_of(roller.hub) + (roller.radius / link.length) * column_of(way)
    yield WayMark(around, u, -pi, pi)
    yield ConnectionMark(column_of(link.start), column_of(link.end), label=link.length)
    yield PointMark(column_of(link.start))
    yield from angle_marks(system, link)


def way_marks(start: Location, end: Location, aside: Location, by: Symbol, clear: Any = ZERO) -> Sequence[Mark]:
    """Return a dimension line for a displacement, with its coordinate as the label."""
    return [LengthMark(column_of(start), column_of(end), column_of(aside), clear, label=by)]
