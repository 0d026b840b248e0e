"""Constraints kept by forces: Lagrange multipliers, and the contact forces that they are.

Coordinates that a constraint ties together are first treated as free; each constraint f = 0 adds lambda df/dq to the
equation of every coordinate. With f = x - X(q) its multiplier is the x component of the force that keeps it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, Integer, Pow, Rational, Symbol, cos, diff, sin

from derive.algebra.collect import by_accelerations, spread
from derive.algebra.expressions import Factors, Partial, Relation, Terms, TimeRate, rate, scalar
from derive.errors import Complaint, Rejected
from derive.mechanics.systems.coordinates import Coordinate, OfCoordinate, by_functions_of_time, letters_of, rate_of
from derive.mechanics.systems.dalembert import Load, Matter, plane_body
from derive.mechanics.systems.rolling import Contact
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.step import Level, Quantity, compared_with, value_behind

__all__ = [
    "Tie",
    "contact_forces",
    "equation_with_multipliers",
    "force_of_constraint",
    "free_lagrangian",
    "multipliers_eliminated",
    "tie",
]


@dataclass(frozen=True)
class Tie:
    """The constraint x = X(q): a coordinate, treated as free, is kept at a function of another by a force.

    free         the coordinate x
    at           the quantity X(q), whose letter is the same x
    multiplier   the letter of the force
    """

    free: Coordinate
    at: Quantity
    multiplier: Symbol

    @property
    def function(self) -> Expr:
        return self.free.symbol - self.at.value


def tie(free: Coordinate, at: Quantity, multiplier: str | None = None) -> Tie:
    """The constraint that keeps a coordinate at what was found for it. The force is called lambda_x unless named."""
    if at.symbol != free.symbol:
        message = f"`tie` keeps {free.symbol.name} at what was found for it, but `{at.key}` is {at.symbol}"
        raise Rejected(Complaint("wrong-argument", message))
    return Tie(free, at, scalar(multiplier or f"lambda_{free.symbol.name}"))


def free_lagrangian(
    mass: Expr,
    gravity: Expr,
    inertia: Expr | Quantity,
    place: Sequence[Coordinate],
    turning: Coordinate,
    symbol: str = "L_free",
    key: str = "free_lagrangian",
) -> Quantity:
    """Lagrangian of a body free in a plane, L_free = (1/2) I q_dot^2 + (1/2) M (x_dot^2 + y_dot^2) - M g y.

    mass, gravity   M in kg, g in m/s^2
    inertia         I about the centre of mass, kg m^2
    place           x and y of the centre of mass, y upwards, m
    turning         the angle q by which the body turns
    Second route: the sum of q_dot dL/dq_dot, less L, is the energy of its mass points and of its weight.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4.
    """
    x, y = (q.symbol for q in place)
    weight = Matter((), (Load((Integer(0), -mass * gravity), (x, y)),), (x, y))
    moment = value_behind(inertia)
    matter = plane_body(mass, (x, y), moment, turning.symbol, (x, y, turning.symbol)) + weight

    def law(m: Expr, g: Expr, i: Expr, *_: Expr) -> Expr:
        moving = Factors(Rational(1, 2), m, Terms(Pow(rate(x), 2), Pow(rate(y), 2)))
        return Terms(Factors(Rational(1, 2), i, Pow(turning.rate, 2)), moving, -Factors(m, g, y))

    def energy(found: Expr) -> tuple[Expr, Expr]:
        carried = Add(*(rate(q) * diff(found, rate(q)) for q in matter.coordinates))
        return carried - found, matter.kinetic_energy() + mass * gravity * y

    return establish(
        "constraints.free_lagrangian",
        scalar(symbol),
        law,
        {"mass": mass, "gravity": gravity, "inertia": inertia, "x": x, "y": y, "q": turning.symbol},
        lines=Lines(put_in=None, result=False),
        routes={"energy": energy},
        key=key,
        kind="energy",
        facts=[matter],
        scope=Scope(coordinates=letters_of((*place, turning))),
    )


def equation_with_multipliers(of: Quantity, q: Coordinate, ties: Sequence[Tie], key: str | None = None) -> Quantity:
    """Lagrange's equation of the first kind, d/dt dL/dq_dot - dL/dq = sum of lambda df/dq.

    of     the Lagrangian of the free coordinates, J
    q      one of them
    ties   the constraints f = 0
    Second route: d'Alembert's principle, the forces of constraint acting on a displacement of q alone.
    Outcomes: free (a coordinate that one tie keeps), turning (the coordinate that the ties depend on).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    matter = of.needed(Matter)
    moving = list(matter.coordinates)
    forces = [(t.multiplier, t.function) for t in ties]
    on_q = Add(*(force * diff(f, q.symbol) for force, f in forces))
    kept = next((t for t in ties if t.free.symbol == q.symbol), None)

    def by_virtual_work() -> Relation:
        """The force on a free coordinate is its own multiplier; on the others it acts where the tie carries it."""
        own = kept.multiplier if kept else -sum((t.multiplier * diff(t.at.value, q.symbol) for t in ties), Integer(0))
        return Relation(matter.inertia_along(q.symbol) - matter.force_along(q.symbol), "=", own)

    return establish(
        "constraints.equation_with_multipliers",
        None,
        lambda L, *_: Relation(Terms(TimeRate(Partial(L, q.rate), *moving), -Partial(L, q.symbol)), "=", on_q),
        {"lagrangian": of, "q": q.symbol, **({"multiplier": kept.multiplier} if kept else {})},
        telling=Telling(formulas=_told_of(kept), judged_by={"multiplier": kept.multiplier if kept else None}),
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            arranged=lambda found: Relation(by_accelerations(found.left, moving), "=", _by_forces(found.right, ties)),
        ),
        routes={"virtual_work": compared_with(by_virtual_work)},
        outcome="free" if kept else "turning",
        key=key or f"motion_{q.symbol.name}",
        kind=None,
        facts=[OfCoordinate(q)],
        scope=Scope(coordinates={t.multiplier: "force" for t in ties}),
    )


def _told_of(kept: Tie | None) -> dict[str, tuple[Any, Any]]:
    """What a phrase may say of the tie that keeps the coordinate, and the same from its function."""
    if kept is None:
        return {}
    x = kept.free.symbol
    return {"constraint": (Relation(x, "=", kept.at.value), Relation(kept.function, "=", 0))}


def _by_forces(value: Expr, ties: Sequence[Tie]) -> Expr:
    """Each multiplier with what stands before it."""
    return Add(*(spread(diff(value, t.multiplier)) * t.multiplier for t in ties))


def force_of_constraint(equation: Quantity, tied: Tie, key: str | None = None) -> Quantity:
    """The force that keeps a coordinate, lambda = M x_ddot - F, with x_ddot as the constraint has it.

    equation   of the coordinate that the tie keeps
    tied       the tie
    Second route: the momentum of the coordinate, M dX/dt, differentiated as a function of t.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    own = equation.needed(OfCoordinate).coordinate
    if own.symbol != tied.free.symbol:
        message = f"`{equation.key}` is the equation of {own.symbol.name}, but the tie keeps {tied.free.symbol.name}"
        raise Rejected(Complaint("different-subjects", message))
    acceleration = rate_of(rate_of(tied.at))
    left = equation.value.left
    mass, x = diff(left, tied.free.acceleration), tied.free
    applied = left - mass * x.acceleration
    moving = list(tied.at.coordinates)

    def by_momentum() -> Expr:
        return by_functions_of_time(mass * by_functions_of_time(tied.at.value, moving), moving) + applied

    return establish(
        "constraints.force_of_constraint",
        tied.multiplier,
        lambda a: mass * a + applied,
        {"acceleration": acceleration},
        lines=Lines(put_in=None, arranged=lambda value: by_accelerations(value, moving)),
        routes={"momentum": compared_with(by_momentum)},
        key=key or f"force_{x.symbol.name}",
        kind="force",
        parents=[equation],
        telling=Telling(points_to={"equation": equation}),
    )


def multipliers_eliminated(
    equation: Quantity, forces: Sequence[Quantity], found: Quantity, key: str = "multipliers_eliminated"
) -> Quantity:
    """Equation of motion with the forces of constraint put in: it must be that of the one free coordinate.

    equation   of the coordinate that the ties depend on
    forces     the multipliers, as `force_of_constraint` yields them
    found      the equation of motion found with the constraints solved from the start
    Second route: that equation.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    moving = list(found.coordinates)
    left, right = equation.value.sides

    def law(*names: Any) -> Relation:
        return Relation(left - right.xreplace({f.symbol: name for f, name in zip(forces, names, strict=False)}), "=", 0)

    return establish(
        "constraints.multipliers_eliminated",
        None,
        law,
        {**{f"force_{i}": force for i, force in enumerate(forces)}, "turning": equation, "found": found},
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            arranged=lambda relation: Relation(by_accelerations(relation.left, moving), "=", 0),
        ),
        routes={"solved_first": compared_with(lambda: found.value)},
        key=key,
        facts=found.facts,
    )


def contact_forces(
    forces: tuple[Quantity, Quantity], place: tuple[Quantity, Quantity], angle: Coordinate, motion: Quantity
) -> tuple[Quantity, Quantity]:
    """Force of the ground on a rolling body, across and along the surface, n = (sin q, cos q) and t = (cos q, -sin q).

    forces   its components lambda_x to the right and lambda_y upwards, N
    place    the centre of mass, as `rolled_centre` yields it
    angle    q, clockwise, of the normal n from the vertical
    motion   the equation of motion
    Keys: normal_force (N, away from the ground) and tangent_force (F, to the right, friction).
    Second route: Newton's law along n and t; for F also the moment of both about the centre of mass, which must give
    the equation of motion.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, sections 2.5 and 7.6.
    """
    q, moving = angle.symbol, [angle.symbol]
    matter = motion.needed(Matter)
    at = [x.value for x in place]
    n, t = (sin(q), cos(q)), (cos(q), -sin(q))

    def by_newton(direction: tuple[Expr, Expr]) -> Expr:
        mass = matter.points[0].mass
        a = [by_functions_of_time(x, moving, 2) for x in at]
        return sum((d * (mass * a[i] - matter.loads[0].force[i]) for i, d in enumerate(direction)), Integer(0))

    def moment(tangential: Expr) -> Relation:
        """About the centre of mass, clockwise: the levers go to the contact."""
        arm = [c - x for c, x in zip(place[0].needed(Contact).place, at, strict=True)]
        reaction = [normal.value * a + tangential * b for a, b in zip(n, t, strict=True)]
        return Relation(_turning(matter) * angle.acceleration, "=", arm[1] * reaction[0] - arm[0] * reaction[1])

    normal = establish(
        "constraints.contact_forces",
        scalar("N"),
        lambda x, y: Terms(Factors(x, n[0]), Factors(y, n[1])),
        {"right": forces[0], "up": forces[1]},
        lines=Lines(put_in=None, arranged=lambda value: by_accelerations(value, moving)),
        routes={"newton": compared_with(lambda: by_newton(n))},
        outcome="normal",
        telling=Telling(judged_by={"angle": q}),
        key="normal_force",
        kind="force",
        parents=list(place),
    )
    tangent = establish(
        "constraints.contact_forces",
        scalar("F"),
        lambda x, y, _: Terms(Factors(x, t[0]), -Factors(y, n[0])),
        {"right": forces[0], "up": forces[1], "normal": normal},
        lines=Lines(put_in=None, arranged=lambda value: by_accelerations(value, moving)),
        routes={
            "newton": compared_with(lambda: by_newton(t)),
            "moment": lambda found: (moment(found), motion.value),
        },
        outcome="tangent",
        telling=Telling(judged_by={"angle": q}),
        key="tangent_force",
        kind="force",
        parents=list(place),
    )
    return normal, tangent


def _turning(matter: Matter) -> Expr:
    """The moment of inertia of a body in a plane: the second moment on its pointer, if it has one."""
    return matter.points[1].mass if len(matter.points) > 1 else Integer(0)
