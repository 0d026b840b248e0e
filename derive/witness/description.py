"""The described system: masses, bodies, forces and constraints, as formulas in coordinates, rates, time and symbols."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, TypeAlias

from sympy import Expr, Symbol

from derive.algebra.expressions import explicit

Vector: TypeAlias = tuple[Expr, ...]


@dataclass(frozen=True)
class Particle:
    """A particle: its mass in kg and its position `place` in m."""

    mass: Expr
    place: Vector


@dataclass(frozen=True)
class Body:
    """A rigid body, given by the position of one of its points and by its orientation.

    mass     the mass of the body, kg
    place    the position in space of one known point of the body, m
    arm      the vector from the known point to the centre of mass, in components along the body axes, m
    spread   second moments, the sums of m r_i r_j about the centre of mass along the body axes, kg m^2
    turns    successive rotations: for each, the number (0, 1 or 2) of a body axis, and the angle. Each rotation also
             rotates the axes of the later rotations. In a plane there is one rotation, about the normal
    axes     in a plane, the numbers of the two body axes in this plane; in space (0, 1, 2)
    """

    mass: Expr
    place: Vector
    arm: Vector
    spread: tuple[tuple[Expr, ...], ...]
    turns: tuple[tuple[int, Expr], ...]
    axes: tuple[int, ...]


@dataclass(frozen=True)
class Pair:
    """A potential energy in J that depends on the distance between the positions `start` and `end`."""

    start: Vector
    end: Vector
    distance: Symbol
    energy: Expr


@dataclass(frozen=True)
class Force:
    """A force in N at the position `place`; or a torque in N m, if `place` is an angle.

    body   the index of a body: the force acts on the particle of this body at `place`. Without a body, the force acts
           on the point `place` itself
    """

    components: Vector
    place: Vector
    body: int | None = None


@dataclass(frozen=True)
class Drag:
    """A drag force -c v, where c is `constant` and v is the velocity of `place`. If `place` is one coordinate, -c v is
    a generalized force, such as a drag torque.

    body   the index of a body: v is then the velocity of the particle of this body at `place`
    """

    constant: Expr
    place: Vector
    body: int | None = None


@dataclass(frozen=True)
class Charge:
    """A charge, in C, in uniform fields; in a plane the magnetic field has one component, towards the reader."""

    charge: Expr
    place: Vector
    electric: Vector
    magnetic: Vector


@dataclass(frozen=True)
class Condition:
    """A formula that is zero during the motion; it contains coordinates and time, or is linear in the rates.

    multiplier   the symbol of the constraint force; None if this force has no symbol
    expresses    the coordinate that the condition expresses in terms of others; this coordinate has no momentum of
                 its own. None if the condition does not express a coordinate
    """

    residual: Expr
    in_rates: bool = False
    multiplier: Symbol | None = None
    expresses: Symbol | None = None


@dataclass(frozen=True)
class Description:
    """A mechanical system as it is described, possibly by a given Lagrangian in place of masses.

    coordinates   each coordinate with its kind, such as "angle" or "length"
    gravity       the acceleration of free fall, in the negative direction of the last axis, m/s^2
    energies      potential energies in the coordinates, J
    lagrangian    the Lagrangian in J, if it is given
    """

    coordinates: tuple[tuple[Symbol, str], ...]
    particles: tuple[Particle, ...] = ()
    bodies: tuple[Body, ...] = ()
    gravity: Expr | None = None
    pairs: tuple[Pair, ...] = ()
    energies: tuple[Expr, ...] = ()
    forces: tuple[Force, ...] = ()
    drags: tuple[Drag, ...] = ()
    charges: tuple[Charge, ...] = ()
    conditions: tuple[Condition, ...] = ()
    lagrangian: Expr | None = None

    @property
    def multipliers(self) -> tuple[Symbol, ...]:
        """The symbols of the constraint forces."""
        return tuple(each.multiplier for each in self.conditions if each.multiplier is not None)


def with_functions(part: Any, known: Mapping[Symbol, Expr]) -> Any:
    """The description, or a part of it, with these formulas in place of prescribed functions of the time."""
    if isinstance(part, Expr):
        return explicit(part).xreplace(known)
    if isinstance(part, tuple):
        return tuple(with_functions(each, known) for each in part)
    if is_dataclass(part) and not isinstance(part, type):
        return replace(part, **{f.name: with_functions(getattr(part, f.name), known) for f in fields(part)})
    return part


@dataclass(frozen=True)
class Meeting:
    """A collision of two particles, or of one particle with an object at rest.

    start, end    the colliding particles, each as a `Force` at its position; `start` is None for an object at rest
    normal        the direction of the impulse on `end`; empty if the colliding objects stay together
    restitution   the ratio of the speed of separation to the speed of approach
    letters       the symbol of the impulse, or the symbols of its components
    """

    start: Force | None
    end: Force
    normal: Vector
    restitution: Expr
    letters: tuple[Symbol, ...]


@dataclass(frozen=True)
class Impact:
    """An impact on a system at one instant: given impulses and collisions.

    at       coordinate -> its value at the instant of the impact
    before   rate -> its value just before the impact; all other rates are zero
    """

    system: Description
    impulses: tuple[Force, ...]
    meetings: tuple[Meeting, ...]
    at: tuple[tuple[Symbol, Expr], ...]
    before: tuple[tuple[Symbol, Expr], ...]
