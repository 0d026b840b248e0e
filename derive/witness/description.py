"""What is there: masses, bodies, forces and constraints, as formulas in coordinates, rates, the time and letters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from sympy import Expr, Symbol

Vector: TypeAlias = tuple[Expr, ...]


@dataclass(frozen=True)
class Particle:
    """A mass, kg, at a place, m."""

    mass: Expr
    place: Vector


@dataclass(frozen=True)
class Body:
    """A rigid body, by a point of it whose place is known and by how it is rotated.

    mass     kg
    place    of the known point, in space, m
    arm      from that point to the centre of mass, along the axes of the body, m
    spread   second moments, the sums of m r_i r_j about the centre of mass along the axes of the body, kg m^2
    turns    rotations one after another, each about an axis (0, 1, 2) that the earlier ones led to, by an angle; in a
             vertical plane there is one, about the normal
    axes     in a plane, the numbers of the two axes of the body that lie in it; in space (0, 1, 2)
    """

    mass: Expr
    place: Vector
    arm: Vector
    spread: tuple[tuple[Expr, ...], ...]
    turns: tuple[tuple[int, Expr], ...]
    axes: tuple[int, ...]


@dataclass(frozen=True)
class Pair:
    """A potential energy of the distance between two places, J."""

    start: Vector
    end: Vector
    distance: Symbol
    energy: Expr


@dataclass(frozen=True)
class Force:
    """A force at a place, N; or a torque on an angle, N m, where the place has one component, the angle.

    body   the number of the body whose particle at that place it acts on; by default the place itself moves
    """

    components: Vector
    place: Vector
    body: int | None = None


@dataclass(frozen=True)
class Drag:
    """A force -c v against the velocity of a place, or of the particle that a body has there; or against an angle's."""

    constant: Expr
    place: Vector
    body: int | None = None


@dataclass(frozen=True)
class Charge:
    """A charge, C, in uniform fields; in a plane the magnetic field has the one component towards the reader."""

    charge: Expr
    place: Vector
    electric: Vector
    magnetic: Vector


@dataclass(frozen=True)
class Condition:
    """A formula that vanishes during the motion: of coordinates and the time, or linear in rates.

    multiplier   the letter of what keeps it, where it has one
    """

    residual: Expr
    in_rates: bool = False
    multiplier: Symbol | None = None


@dataclass(frozen=True)
class Description:
    """A system of mechanics as it is described, or a Lagrangian that is given in place of one.

    coordinates   with the kind of each: "angle", "length"
    gravity       the acceleration of free fall against the last axis, m/s^2
    energies      potential energies in the coordinates, J
    lagrangian    where it is given, J
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
        """The letters of what keeps the conditions."""
        return tuple(each.multiplier for each in self.conditions if each.multiplier is not None)


@dataclass(frozen=True)
class Meeting:
    """Two particles that meet, or one that meets what is at rest.

    start, end    their places, as those of forces
    normal        along which the impulse acts on the end; empty where the two stay together
    restitution   the part of the speed of approach with which they part
    letters       of the impulse, or of its components
    """

    start: Force | None
    end: Force
    normal: Vector
    restitution: Expr
    letters: tuple[Symbol, ...]


@dataclass(frozen=True)
class Impact:
    """What happens to a system in a moment: given impulses and meetings.

    at       coordinate -> its value in that moment
    before   rate -> its value just before; the others are zero
    """

    system: Description
    impulses: tuple[Force, ...]
    meetings: tuple[Meeting, ...]
    at: tuple[tuple[Symbol, Expr], ...]
    before: tuple[tuple[Symbol, Expr], ...]
