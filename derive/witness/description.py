"""The described system: masses, bodies, forces and constraints, as formulas in coordinates, rates, time and symbols."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from sympy import Expr, Symbol

Vector: TypeAlias = tuple[Expr, ...]


@dataclass(frozen=True)
class Particle:
    """A mass in kg, at a place in m."""

    mass: Expr
    place: Vector


@dataclass(frozen=True)
class Body:
    """A rigid body, given by the place of one of its points and by its orientation.

    mass     kg
    place    place of the known point in space, m
    arm      from that point to the centre of mass, along the axes of the body, m
    spread   second moments, the sums of m r_i r_j about the centre of mass along the axes of the body, kg m^2
    turns    successive rotations, each by an angle about an axis (0, 1, 2) as rotated by the earlier ones; in a
             vertical plane there is one rotation, about the normal
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
    """A potential energy in J that depends on the distance between two places."""

    start: Vector
    end: Vector
    distance: Symbol
    energy: Expr


@dataclass(frozen=True)
class Force:
    """A force in N at a place; or a torque in N m on an angle, if the place has one component, the angle.

    body   number of the body with the particle on which the force acts; by default the force moves with the place
    """

    components: Vector
    place: Vector
    body: int | None = None


@dataclass(frozen=True)
class Drag:
    """A force -c v against the velocity of a place, or of a body's particle there; or a torque, likewise."""

    constant: Expr
    place: Vector
    body: int | None = None


@dataclass(frozen=True)
class Charge:
    """A charge in C in uniform fields; in a plane the magnetic field has one component, towards the reader."""

    charge: Expr
    place: Vector
    electric: Vector
    magnetic: Vector


@dataclass(frozen=True)
class Condition:
    """A formula that vanishes during the motion: of coordinates and time, or linear in the rates.

    multiplier   the symbol of its constraint force, if any
    """

    residual: Expr
    in_rates: bool = False
    multiplier: Symbol | None = None


@dataclass(frozen=True)
class Description:
    """A mechanical system as described, or a given Lagrangian instead.

    coordinates   each coordinate with its kind: "angle", "length"
    gravity       the acceleration of free fall against the last axis, m/s^2
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


@dataclass(frozen=True)
class Meeting:
    """A collision of two particles, or of one particle with an object at rest.

    start, end    their places, given as for forces
    normal        the direction of the impulse on `end`; empty if the two stay together
    restitution   the ratio of the speeds of separation and of approach
    letters       the symbols of the impulse, or of its components
    """

    start: Force | None
    end: Force
    normal: Vector
    restitution: Expr
    letters: tuple[Symbol, ...]


@dataclass(frozen=True)
class Impact:
    """An impact on a system at one instant: given impulses and collisions.

    at       coordinate -> its value at that instant
    before   rate -> its value just before; all others are zero
    """

    system: Description
    impulses: tuple[Force, ...]
    meetings: tuple[Meeting, ...]
    at: tuple[tuple[Symbol, Expr], ...]
    before: tuple[tuple[Symbol, Expr], ...]
