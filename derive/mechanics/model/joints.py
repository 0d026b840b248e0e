"""Joints (hinges and rigid joints), motors and dashpots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

from sympy import Add, Expr, Integer, Symbol

from derive.algebra.expressions import TimeRate, as_expr, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.connection import Connection, PointForce, end_of, is_end, require_bodies
from derive.mechanics.model.constraint import Constraint, constraint
from derive.mechanics.model.dalembert import Load
from derive.mechanics.model.forces import Damper, damping
from derive.mechanics.model.material import material_point
from derive.mechanics.model.part import moved
from derive.mechanics.model.surfaces import raw_distance
from derive.steps.record import coordinates_in, require_no_coordinate
from derive.steps.step import is_zero

__all__ = ["dashpot", "motor", "pin", "weld"]

ZERO = Integer(0)


@dataclass(frozen=True)
class Pin(Connection):
    """A hinge at which two bodies, or a body and the ground, are pinned together."""

    at: Location

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), at=self.at.with_values(known))


def pin(of: Any, to: Any, force: str = "R") -> tuple[Pin | Constraint, ...]:
    """A frictionless hinge, which keeps two points together; in space it is a ball joint.

    of, to   the two points: points of bodies, bodies (at the centre of mass), particles, or places without coordinates
    force    the symbol R of the force on `of`, N; its components are R_x and R_y, in space also R_z. If the coordinates
             already keep the two points together along an axis, the component along this axis does not appear

    The opposite force acts on `to`.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 2.
    """
    for each in (of, to):
        if not is_end(each):
            message = "each end of a `pin` must be a particle, a body, a point of a body or a place"
            how = Spelled('give a point as `rod.place_of("end")`', "give a point of a body as `rod.end`")
            raise Rejected(Complaint("wrong-argument", message, help=how))
    (here, body), (there, other) = end_of(of), end_of(to)
    require_bodies("pin", [(here, body), (there, other)])
    gaps = [tidied(c) for c in (here - there).components]
    found: list[Constraint] = []
    for i, gap in enumerate(gaps):
        letter = scalar(f"{force}_{'xyz'[i]}")
        along = tuple(Integer(int(i == k)) for k in range(len(gaps)))
        pair = PointForce(letter, along, here, body), PointForce(letter, tuple(-c for c in along), there, other)
        if not is_zero(gap):
            found.append(Constraint(gap, ZERO, letter, forces=pair, enforcer="joint"))
    if not found:
        message = "the coordinates keep the two points together, so the force of the joint does not appear"
        help_line = "give one of the bodies coordinates of its own, so that the joint keeps the points together"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    fixed = there if other is None else here
    return Pin(tuple(force for each in found for force in each.forces), fixed), *found


def weld(of: Any, to: Any, force: str = "R", torque: str = "C") -> tuple[Pin | Constraint, ...]:
    """A rigid joint of two bodies in a plane: a hinge, with a couple that keeps the angle between the bodies constant.

    of, to   points of bodies, as for `pin`
    force    the symbol of the force on `of`, as for `pin`
    torque   the symbol of the couple on `of`, N m

    The angle keeps the value that it has where all coordinates are zero.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 2.
    """
    bodies = [end_of(each)[1] if is_end(each) else None for each in (of, to)]
    turned: list[Any] = [each.turned for each in bodies if isinstance(each, PlacedBody) and each.is_plane]
    if len(turned) < 2:
        raise Rejected(Complaint("wrong-argument", "`weld` needs two bodies that move in a plane"))
    angle = explicit(as_expr(turned[0] - turned[1]))
    if not coordinates_in(angle):
        message = (
            "the coordinates keep the angle between the two bodies constant, so the couple of the joint does not appear"
        )
        raise Rejected(Complaint("not-an-unknown", message, help="use `pin`"))
    at_zero = angle.xreplace(dict.fromkeys(coordinates_in(angle), ZERO))
    return *pin(of, to, force), replace(constraint(angle, at_zero, torque), enforcer="joint")


@dataclass(frozen=True)
class Motor(Connection):
    """A motor, whose torque keeps an angle equal to a prescribed function of time.

    angle    the angle that the motor prescribes
    torque   the symbol of the torque
    """

    angle: Expr
    torque: Symbol

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), angle=self.angle.subs(known))


def motor(on: Any, turns: Any, torque: str = "M") -> tuple[Motor, Constraint]:
    """A motor, whose torque keeps an angle equal to a prescribed function of time.

    on      the angle: a coordinate, or a formula that contains coordinates
    turns   the value of the angle, a function of time such as `Omega*t`
    torque  the symbol of the torque of the motor, N m; positive in the direction in which the angle increases

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    require_no_coordinate("motor", "value of the angle", as_expr(turns))
    kept = replace(constraint(on, turns, torque), enforcer="motor")
    return Motor((), explicit(as_expr(on)), kept.force), kept


@dataclass(frozen=True)
class DragAlong(Damper):
    """Drag -c d_dot along a distance d. Second routes use the forces on the material points at both ends.

    ends   for each end, the place, and the body or particle there (None for the ground or a massless joint)
    """

    ends: tuple[tuple[Location, Any], tuple[Location, Any]] = ((Location(()), None), (Location(()), None))

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        (start, one), (end, other) = self.ends
        ends = (start.with_values(known), moved(one, known)), (end.with_values(known), moved(other, known))
        return replace(super().moved(known), ends=ends)

    def other_loads(self, moving: Sequence[Symbol]) -> Sequence[Load]:
        """The forces c (u.v) u on the start and -c (u.v) u on the end. A force on the ground is left out.

        The unit vector u points from the start to the end; v is the velocity of the end relative to the start.
        """
        points = [material_point("dashpot", of, place) for place, of in self.ends]
        start, end = ([explicit(TimeRate(c, *moving)).xreplace(point.values) for c in point.place] for point in points)
        way = [b - a for a, b in zip(self.ends[0][0].components, self.ends[1][0].components, strict=True)]
        square = Add(*(c**2 for c in way))
        rate_of_square = Add(*(c * (b - a) for c, a, b in zip(way, start, end, strict=True)))
        drag = [self.constant * rate_of_square * c / square for c in way]
        pairs = zip(self.ends, points, (1, -1), strict=True)
        return [
            Load(tuple(sign * c for c in drag), point.place, point.held)
            for (_, of), point, sign in pairs
            if of is not None or any(c.has(*moving) for c in point.place)
        ]


@dataclass(frozen=True)
class Dashpot(Connection):
    """A dashpot between two places, with its damping constant."""

    constant: Expr
    start: Location
    end: Location

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        start, end = self.start.with_values(known), self.end.with_values(known)
        return replace(super().moved(known), start=start, end=end)


def dashpot(constant: Any, start: Any, end: Any, massless: bool = False) -> tuple[Dashpot, Damper]:
    """A dashpot between two points at the distance d. Its force on each point has the magnitude c |d_dot| and opposes
    the change of d.

    constant     the damping constant c, kg/s
    start, end   particles, bodies, points of bodies, or places without coordinates
    massless     whether the dashpot may end at a massless joint, such as its joint with a spring

    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 11.3.
    """
    if not all(map(is_end, (start, end))):
        raise Rejected(
            Complaint(
                "wrong-argument", "each end of a `dashpot` must be a particle, a body, a point of a body or a place"
            )
        )
    ends = end_of(start), end_of(end)
    if not massless:
        require_bodies("dashpot", ends, "; a joint without mass needs `massless: true`")
    (one, _), (other, _) = ends
    along = damping(constant, raw_distance(one, other))
    return Dashpot((), as_expr(constant), one, other), DragAlong(along.constant, along.at, None, ends)
