"""A mechanical system: particles and the forces on them, its kinetic and its potential energy.

Places are formulas in the coordinates, so that whatever ties particles together is built into them. The energies are
made of the places alone; so are the mass points and forces by which every second route goes (d'Alembert's principle).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from sympy import Abs, Add, Dummy, Expr, ImmutableDenseMatrix, Integer, Pow, Rational, Symbol, diff, factor, sqrt

from derive.algebra.collect import by_rates, by_terms
from derive.algebra.expressions import TIME, Factors, Relation, Terms, TimeRate, bound, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Unverified
from derive.mechanics.systems.dalembert import Load, MassPoint, Matter
from derive.mechanics.systems.places import Location
from derive.steps.establish import Lines, Scope, establish
from derive.steps.record import assume, coordinates_in, require_constant
from derive.steps.step import Quantity, compared_with
from derive.steps.subject import Subject

__all__ = ["Particle", "System", "central", "kinetic_energy_of", "potential_energy_of", "spring", "weight"]

HALF, ZERO = Rational(1, 2), Integer(0)
DISTANCE = Dummy("r", positive=True)


@dataclass(frozen=True)
class Particle:
    """A particle of a constant mass, kg, at a place. Source: Taylor, *Classical Mechanics*, section 7.1."""

    mass: Expr
    at: Location

    def __post_init__(self) -> None:
        if not isinstance(self.mass, Expr | int) or not isinstance(self.at, Location):
            message = "`Particle` needs the expression of a mass and a place that `point` or `place` gives"
            raise Rejected(Complaint("wrong-argument", message))
        require_constant("Particle", "mass", self.mass)


@dataclass(frozen=True)
class Weight:
    """The weight of every particle, downwards along the last axis, with the gravity g in m/s^2."""

    gravity: Expr


@dataclass(frozen=True)
class Central:
    """A potential energy U(r) of the distance between two places, J, and the pull along the line between them, N."""

    start: Location
    end: Location
    distance: Symbol
    energy: Expr
    pull: Expr

    @cached_property
    def length(self) -> Expr:
        """Of a way along one line, its component there, where that is positive at rest and then taken to stay so."""
        square = tidied(Add(*(c**2 for c in (self.end - self.start).components)))
        length = sqrt(factor(square))
        along = next(iter(length.atoms(Abs)), ZERO)
        if length != along or not isinstance(along, Abs):
            return length
        (way,) = along.args
        at_rest = way.xreplace(dict.fromkeys(coordinates_in(way), ZERO))
        if way == at_rest or not at_rest.is_nonzero:
            return length
        length = way if at_rest.is_positive else -way
        stays = Relation(length, ">", ZERO)
        if not _is_so(stays, coordinates_in(way)):
            raise Unverified(Complaint("unverified", f"a distance of {stays} would be negative at rest"))
        assume(stays)
        return length

    def pulls(self) -> tuple[Load, Load]:
        """The forces at its two ends, towards each other where the energy grows with the distance."""
        way = (self.end - self.start).components
        size = self.pull.subs(self.distance, self.length)
        pull = tuple(size * c / self.length for c in way)
        return Load(pull, self.start.components), Load(tuple(-c for c in pull), self.end.components)


def weight(gravity: Expr) -> Weight:
    """The weight of all particles of a system."""
    require_constant("weight", "gravity", gravity)
    return Weight(gravity)


def spring(constant: Expr, start: Location, end: Location, natural: Expr = ZERO) -> Central:
    """A spring without mass between two places, U = (1/2) k (r - l)^2, k in N/m and its natural length l in m."""
    require_constant("spring", "spring constant", constant)
    require_constant("spring", "natural length", natural)
    energy = Factors(HALF, constant, Pow(Terms(DISTANCE, -natural), 2))
    return Central(start, end, DISTANCE, energy, constant * DISTANCE - constant * natural)


def central(energy: Expr, distance: Symbol, start: Location, end: Location) -> Central:
    """A potential energy U(r) of the distance r between two places: `central(-G*M*m/r, r, sun, planet)`."""
    if TIME in energy.free_symbols:
        raise Rejected(
            Complaint("changes", "`central` needs an energy of the distance alone, but it depends on the time t")
        )
    return Central(start, end, distance, energy, diff(energy, distance))


PartOfSystem: TypeAlias = Particle | Weight | Central


class System:
    """Particles and the forces on them."""

    def __init__(self, *parts: PartOfSystem):
        self.particles = tuple(part for part in parts if isinstance(part, Particle))
        self.weights = tuple(part for part in parts if isinstance(part, Weight))
        self.between = tuple(part for part in parts if isinstance(part, Central))
        unknown = [part for part in parts if not isinstance(part, Particle | Weight | Central)]
        if unknown:
            made_of = "particles, a weight, springs and other central forces"
            message = f"`System` is made of {made_of}, not of {type(unknown[0]).__name__}"
            raise Rejected(Complaint("wrong-argument", message))
        if not self.particles:
            raise Rejected(Complaint("wrong-argument", "a `System` needs a particle"))
        if len(self.weights) > 1:
            raise Rejected(Complaint("wrong-argument", "a `System` has one weight, that of all its particles"))
        if len({len(place.components) for place in self.places}) > 1:
            message = "some places of this `System` have two components, others three: the last one is upwards"
            raise Rejected(Complaint("wrong-argument", message, help="give all places in a plane, or all in space"))
        if not self.coordinates:
            message = "nothing in this `System` moves: its places depend on no coordinate"
            raise Rejected(Complaint("wrong-argument", message, help='name what varies with `coordinate("theta")`'))

    @property
    def places(self) -> list[Location]:
        """Those of its particles, and the ends of what acts between them."""
        return [particle.at for particle in self.particles] + [end for s in self.between for end in (s.start, s.end)]

    @property
    def gravity(self) -> Expr:
        return self.weights[0].gravity if self.weights else Integer(0)

    @cached_property
    def coordinates(self) -> Mapping[Symbol, str]:
        """Those that its places depend on, with their kinds."""
        return coordinates_in(ImmutableDenseMatrix([c for place in self.places for c in place.components]))

    @cached_property
    def matter(self) -> Matter:
        """Its mass points, and the forces on them."""
        points = tuple(MassPoint(particle.mass, particle.at.components) for particle in self.particles)
        loads = [self._weight_of(particle) for particle in self.particles] if self.weights else []
        loads += [load for each in self.between for load in each.pulls()]
        return Matter(points, tuple(loads), tuple(self.coordinates))

    def _weight_of(self, particle: Particle) -> Load:
        *across, _ = particle.at.components
        down = -particle.mass * self.weights[0].gravity
        return Load((*(ZERO for _ in across), down), particle.at.components)


def _is_so(condition: Relation, coordinates: Mapping[Symbol, str]) -> bool:
    """Whether it is a length that is positive where all coordinates are zero."""
    at_rest = condition.residual.xreplace(dict.fromkeys(coordinates, ZERO))
    return bool(condition.mark == ">" and at_rest.is_positive)


def _numbered(letter: str, i: int, system: System) -> Symbol:
    """v of the only particle, else v_1, v_2, ..."""
    return scalar(f"{letter}_{i + 1}" if len(system.particles) > 1 else letter)


def _squared_speed(system: System, i: int) -> Quantity:
    """Square of the speed of a particle, v^2 = x_dot^2 + y_dot^2."""
    moving = list(system.coordinates)
    place = system.particles[i].at.components
    matter = Matter((MassPoint(Integer(2), place),), (), tuple(moving))
    return establish(
        "systems.squared_speed",
        Pow(_numbered("v", i, system), 2),
        lambda *at: Terms(*(Pow(TimeRate(c, *moving), 2) for c in at)),
        {f"place_{k}": c for k, c in enumerate(place)},
        key=_numbered("squared_speed", i, system).name,
        outcome="of_several" if len(system.particles) > 1 else "alone",
        routes={"functions_of_time": compared_with(matter.kinetic_energy)},
        lines=Lines(
            put_in=None,
            arranged=lambda value: by_rates(value, moving),
            means={_numbered("v", i, system): _speed(place, moving)},
        ),
        scope=Scope(coordinates=system.coordinates, about=Subject(body=system)),
    )


def _speed(place: tuple[Expr, ...], moving: list[Symbol]) -> Expr:
    return sqrt(Add(*(explicit(TimeRate(c, *moving)) ** 2 for c in place)))


def kinetic_energy_of(system: System, symbol: str = "T", key: str = "kinetic_energy") -> Quantity:
    """Kinetic energy of a system, T = sum of (1/2) m v^2 over its particles.

    system   its particles
    The square of each speed is a step of its own.
    Second route: half the sum of m v.v, the places differentiated as functions of t.
    Source: Taylor, *Classical Mechanics*, section 7.1.
    """
    speeds = [_squared_speed(system, i) for i in range(len(system.particles))]
    masses = [particle.mass for particle in system.particles]

    def law(*squares: Expr) -> Expr:
        return Terms(*(Factors(HALF, m, square) for m, square in zip(masses, squares, strict=True)))

    return establish(
        "systems.kinetic_energy",
        scalar(symbol),
        law,
        {f"speed_{i}": speed for i, speed in enumerate(speeds)},
        key=key,
        kind="energy",
        routes={"mass_points": compared_with(system.matter.kinetic_energy)},
        lines=Lines(put_in=None, arranged=lambda value: by_rates(value, list(system.coordinates), halves=True)),
        facts=[replace(system.matter, loads=())],
        scope=Scope(about=Subject(body=system)),
    )


def potential_energy_of(system: System, symbol: str = "U", key: str = "potential_energy") -> Quantity:
    """Potential energy of a system, U = sum of m g y from the origin upwards, and of (1/2) k (d - l)^2 of springs.

    system   its particles, springs and weight
    Second route: the forces do the work -dU along any motion, for each coordinate -dU/dq = sum of F . dr/dq; at the
    origin, with the springs at their natural length, it is zero.
    Outcomes: generic, zero (no force that has one).
    Source: Taylor, *Classical Mechanics*, section 4.2.
    """
    moving, matter = [*system.coordinates, TIME], system.matter

    def work(found: Expr) -> tuple[Expr, Expr]:
        marks = [Symbol(f"delta_{q.name}", real=True) for q in moving]
        lost = [-diff(found, q) * mark for q, mark in zip(moving, marks, strict=True)]
        return Add(*lost), Add(*(matter.force_along(q) * mark for q, mark in zip(moving, marks, strict=True)))

    heights = [Factors(p.mass, system.gravity, p.at.height) for p in system.particles] if system.weights else []
    stored = [bound(each.energy, {each.distance: each.length}) for each in system.between]
    return establish(
        "systems.potential_energy",
        scalar(symbol),
        lambda: Terms(*heights, *stored) if heights or stored else Integer(0),
        {},
        key=key,
        kind="energy",
        routes={"work": work},
        outcome=lambda value: "zero" if value == 0 else "generic",
        lines=Lines(put_in=None, arranged=by_terms),
        facts=[replace(matter, points=())],
        scope=Scope(coordinates=system.coordinates, about=Subject(body=system)),
    )
