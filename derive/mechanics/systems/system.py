"""A mechanical system: particles and bodies, the forces on them, and the conditions on their motion.

Places are formulas in the coordinates, so that whatever ties particles together is built into them. The energies are
made of the places alone; so are the mass points and forces by which every second route goes (d'Alembert's principle).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeAlias

from sympy import Abs, Add, Dummy, Expr, ImmutableDenseMatrix, Integer, Pow, Rational, Symbol, diff, factor, sqrt

from derive.algebra.expressions import TIME, Factors, Relation, Terms, column, explicit, rate
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Unverified
from derive.mechanics.bodies.placed import Placeable, PlacedBody, central_second_moments
from derive.mechanics.bodies.possible import require_positive
from derive.mechanics.systems.constraint import Constraint
from derive.mechanics.systems.dalembert import Load, MassPoint, Matter, Reaction
from derive.mechanics.systems.forces import Charge, Damper, GivenForce, StoredEnergy, is_nothing
from derive.mechanics.systems.gradients import check_gradient
from derive.mechanics.systems.places import Location
from derive.steps.known_numbers import taken_positive
from derive.steps.record import assume, coordinates_in, require_constant
from derive.steps.step import Fact, Quantity, is_zero

__all__ = ["Particle", "System", "central", "spring", "weight"]

HALF, ZERO = Rational(1, 2), Integer(0)
DISTANCE = Dummy("r", positive=True)


@dataclass(frozen=True)
class Particle:
    """A particle of a constant mass, kg, at a place. Source: Taylor, *Classical Mechanics*, section 7.1.

    name   what it is, for its drawing: a "bob" hangs on a rod, a "bead" is on a wire
    """

    mass: Expr
    at: Location
    name: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.mass, Expr | int) or not isinstance(self.at, Location):
            message = "`Particle` needs the expression of a mass and a place that `point` or `place` gives"
            raise Rejected(Complaint("wrong-argument", message))
        require_constant("Particle", "mass", self.mass)
        require_positive("`Particle`", "mass", self.mass)


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

    @property
    def is_spring(self) -> bool:
        return self.distance is DISTANCE

    @cached_property
    def length(self) -> Expr:
        """Of a way along one line, its component there, where that is positive at rest and then taken to stay so."""
        components = [c for c in (self.end - self.start).components if c != 0]
        if len(components) == 1 and _is_sum_of_letters(components[0]):
            (way,) = components
            return _of_one_sign(way, self.is_spring) or Abs(way)
        length = sqrt(factor(tidied(Add(*(c**2 for c in components)))))
        along = next(iter(length.atoms(Abs)), ZERO)
        if length != along or not isinstance(along, Abs):
            return length
        return _of_one_sign(along.args[0], self.is_spring) or length

    def pulls(self) -> tuple[Load, Load]:
        """The forces at its two ends, towards each other where the energy grows with the distance."""
        way = (self.end - self.start).components
        size = self.pull.xreplace({self.distance: self.length})
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
    energy = Factors(HALF, constant, Pow(Terms(DISTANCE, -natural) if natural != 0 else DISTANCE, 2))
    return Central(start, end, DISTANCE, energy, constant * DISTANCE - constant * natural)


def central(energy: Expr, distance: Symbol, start: Location, end: Location) -> Central:
    """A potential energy U(r) of the distance r between two places: `central(-G*M*m/r, r, sun, planet)`."""
    if TIME in energy.free_symbols:
        raise Rejected(
            Complaint("changes", "`central` needs an energy of the distance alone, but it depends on the time t")
        )
    return Central(start, end, distance, energy, diff(energy, distance))


PartOfSystem: TypeAlias = (
    Particle | PlacedBody | Weight | Central | StoredEnergy | Charge | GivenForce | Damper | Constraint | Quantity
)
_PARTS = (Particle, PlacedBody, Weight, Central, StoredEnergy, Charge, GivenForce, Damper, Constraint, Quantity)


@dataclass(frozen=True)
class KnownCoordinate(Fact):
    """A coordinate that a condition makes a function of others, with the function."""

    missing = "is not a condition that gives a coordinate by others"
    coordinate: Symbol
    function: Expr


@dataclass(frozen=True)
class Eliminated(Fact):
    """The coordinates that conditions of a system give by others: what rests on it does not depend on them."""

    missing = "has no coordinate that is given by others"
    eliminates: tuple[Symbol, ...]


class System:
    """Particles and bodies, the forces on them, and the conditions on their motion.

    name   "first": keys of its steps begin with `first_`, letters have the index `first`
    """

    def __init__(self, *parts: PartOfSystem, name: str = ""):
        unknown = [part for part in parts if not isinstance(part, _PARTS)]
        if unknown:
            made_of = "particles, placed bodies, a weight, springs and other forces, and constraints"
            message = f"`System` is made of {made_of}, not of {type(unknown[0]).__name__}"
            help_line = "put a body somewhere with `.placed` or `.held`" if isinstance(unknown[0], Placeable) else None
            raise Rejected(Complaint("wrong-argument", message, help=help_line))
        if name and not re.fullmatch(r"[a-z]+( [a-z]+)?", name):
            help_line = 'give one or two words in small letters, "first"'
            raise Rejected(Complaint("name", f"`{name}` is not a name for a system", help=help_line))
        self.called = name
        self.conditions = tuple(part for part in parts if isinstance(part, Quantity))
        known = dict(_known_by(condition) for condition in self.conditions)
        self.known: Mapping[Symbol, Expr] = known
        self.eliminated = tuple(known)
        self.put_in = tuple(c for c in self.conditions if _is_put_into(c, parts))
        parts = tuple(_with_known(part, known) for part in parts) if known else parts
        self.particles = tuple(part for part in parts if isinstance(part, Particle))
        self.bodies = tuple(part for part in parts if isinstance(part, PlacedBody))
        self.weights = tuple(part for part in parts if isinstance(part, Weight))
        self.between = tuple(part for part in parts if isinstance(part, Central))
        self.charges = tuple(part for part in parts if isinstance(part, Charge))
        charged = tuple(c.stored for c in self.charges if not is_nothing(c.electric))
        self.stored = (*(part for part in parts if isinstance(part, StoredEnergy)), *charged)
        self.fields = tuple(c.deflected for c in self.charges if not is_nothing(c.magnetic))
        self.given_forces: tuple[GivenForce, ...] = tuple(part for part in parts if isinstance(part, GivenForce))
        self.dampers = tuple(part for part in parts if isinstance(part, Damper))
        self.constraints = tuple(part for part in parts if isinstance(part, Constraint))
        self._check()

    def _check(self) -> None:
        if not self.particles and not self.bodies:
            raise Rejected(Complaint("wrong-argument", "a `System` needs a particle or a body that is placed or held"))
        for placed in self.bodies:
            if placed.body.mass is None:
                raise Rejected(Complaint("wrong-argument", f"`System` needs the mass of {placed.body.name}"))
        for mass, _ in self.masses:
            if taken_positive(explicit(mass)) != 1:
                raise Rejected(Complaint("no-such-body", f"a mass of a `System` must be positive, but {mass} is not"))
        if len(self.weights) > 1:
            raise Rejected(Complaint("wrong-argument", "a `System` has one weight, that of all its particles"))
        if len({len(place.components) for place in self.places}) > 1:
            message = "some places of this `System` have two components, others three: the last one is upwards"
            raise Rejected(Complaint("wrong-argument", message, help="give all places in a plane, or all in space"))
        if not self.coordinates:
            message = "nothing in this `System` moves: its places depend on no coordinate"
            raise Rejected(Complaint("wrong-argument", message, help='name what varies with `coordinate("theta")`'))
        self._check_what_acts()
        for condition in self.conditions:
            _check_kept(condition)
        for each in self.constraints:
            check_gradient(each)
        letters = [each.force.name for each in self.constraints]
        if len(set(letters)) < len(letters):
            message = "two constraints of this `System` have forces of one letter"
            raise Rejected(Complaint("letter-clash", message, help='give them letters, `constraint(..., force="N")`'))

    def _check_what_acts(self) -> None:
        """Forces and constraints are those of what moves here, and of nothing else."""
        acting = [ImmutableDenseMatrix([e.energy]) for e in self.stored]
        acting += [ImmutableDenseMatrix(each.at) for each in self._others]
        acting += [ImmutableDenseMatrix([each.residual]) for each in self.constraints]
        for values in acting:
            for q in coordinates_in(values):
                if q not in self.coordinates:
                    message = f"a force or constraint of this `System` depends on {q.name}, but nothing in it moves so"
                    raise Rejected(Complaint("wrong-argument", message))

    @property
    def places(self) -> list[Location]:
        """Those of its particles and bodies, and the ends of what acts between them."""
        at = [particle.at for particle in self.particles] + [placed.centre for placed in self.bodies]
        at += [each.at for each in self.charges]
        return at + [end for s in self.between for end in (s.start, s.end)]

    @property
    def masses(self) -> list[tuple[Expr, Location]]:
        """The masses of its particles and bodies, with the places of their centres of mass."""
        own = [(particle.mass, particle.at) for particle in self.particles]
        return own + [(placed.body.mass, placed.centre) for placed in self.bodies]

    @property
    def _others(self) -> tuple[GivenForce | Damper, ...]:
        return *self.given_forces, *self.dampers

    @property
    def gravity(self) -> Expr:
        return self.weights[0].gravity if self.weights else Integer(0)

    @cached_property
    def coordinates(self) -> Mapping[Symbol, str]:
        """Those that its places and the turning of its bodies depend on, with their kinds."""
        entries = [c for place in self.places for c in place.components]
        return coordinates_in(ImmutableDenseMatrix([*entries, *(e for b in self.bodies for e in b.depends_on)]))

    @cached_property
    def matter(self) -> Matter:
        """Its mass points, and the forces on them."""
        moving = list(self.coordinates)
        points = [MassPoint(particle.mass, particle.at.components) for particle in self.particles]
        points += [point for placed in self.bodies for point in mass_points(placed)]
        loads = [self._weight_of(mass, at) for mass, at in self.masses] if self.weights else []
        loads += [load for each in self.between for load in each.pulls()]
        loads += [load for each in self.stored for load in each.loads(moving)]
        others: list[Load | Reaction] = [each.load(moving) for each in self._others]
        others += [Reaction(c.force, tuple((q, c.along(q)) for q in moving)) for c in self.constraints]
        return Matter(tuple(points), tuple(loads), tuple(moving), tuple(others), self.fields)

    def _weight_of(self, mass: Expr, at: Location) -> Load:
        *across, _ = at.components
        return Load((*(ZERO for _ in across), -mass * self.weights[0].gravity), at.components)


def _known_by(condition: Quantity) -> tuple[Symbol, Expr]:
    found = condition.fact(KnownCoordinate)
    if found is None:
        message = f"`{condition.key}` does not give a coordinate by others, so it cannot be put into the energies"
        help_line = "a condition of rolling that cannot be integrated is kept by forces: `*rolling_constraint(...)`"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    return found.coordinate, found.function


def _check_kept(condition: Quantity) -> None:
    """With the coordinate that it gives by others, a condition on rates holds whatever these do."""
    q, function = _known_by(condition)
    value = explicit(condition.value)
    if isinstance(value, Relation):
        its_rate = Add(*(diff(function, each) * rate(each) for each in coordinates_in(function)))
        left = value.residual.xreplace({rate(q): its_rate}).xreplace({q: function})
    else:
        left = value - function
    if not is_zero(left):
        raise Unverified(Complaint("unverified", f"`{condition.key}` is not kept by {q} = {function}"))


def _is_put_into(condition: Quantity, parts: Sequence[PartOfSystem]) -> bool:
    """Whether a part depends on the coordinate that a condition gives by others."""
    known = dict([_known_by(condition)])
    return any(_with_known(part, known) != part for part in parts if not isinstance(part, Quantity))


def _with_known(part: Any, known: Mapping[Symbol, Expr]) -> Any:
    """A part of a system with some of the coordinates given by others."""
    if isinstance(part, PlacedBody):
        return part.moved(known)
    if isinstance(part, Particle):
        return replace(part, at=_moved(part.at, known))
    if isinstance(part, Central):
        return replace(part, start=_moved(part.start, known), end=_moved(part.end, known))
    if isinstance(part, Charge):
        return replace(part, at=_moved(part.at, known))
    if isinstance(part, StoredEnergy):
        return StoredEnergy(part.energy.subs(known))
    if isinstance(part, GivenForce | Damper):
        return replace(part, at=tuple(c.subs(known) for c in part.at))
    return part


def _moved(place: Location, known: Mapping[Symbol, Expr]) -> Location:
    return place.with_values(known)


def mass_points(placed: PlacedBody) -> list[MassPoint]:
    """The mass of a body at its centre of mass, and second moments on unit vectors that turn as it does.

    The moments are those of its particles, so that no inertia tensor is used.
    """
    spread = central_second_moments(placed.body)
    points = [MassPoint(placed.body.mass, placed.centre.components)]
    axes = placed.in_plane if placed.is_plane else (0, 1, 2)
    arms = {i: column(*(int(i == k) for k in range(3))) for i in axes}
    for i in axes:
        alone = spread[i, i] - sum((spread[i, j] for j in axes if j != i), ZERO)
        points.append(MassPoint(alone, placed.seen_in_space(arms[i]).components))
        pairs = [j for j in axes if j > i and spread[i, j] != 0]
        points += [MassPoint(spread[i, j], placed.seen_in_space(arms[i] + arms[j]).components) for j in pairs]
    return [point for point in points if point.mass != 0]


def _of_one_sign(way: Expr, in_words: bool) -> Expr | None:
    """The way as a length that is taken to stay positive, where it has a sign at rest."""
    moving = coordinates_in(way)
    at_rest = way.xreplace(dict.fromkeys(moving, ZERO))
    if not moving or not at_rest.is_nonzero:
        return None
    length = way if at_rest.is_positive else -way
    stays = Relation(length, ">", ZERO)
    if not _is_so(stays, moving):
        raise Unverified(Complaint("unverified", f"a distance of {stays} would be negative at rest"))
    assume(stays, in_words)
    return length


def _is_sum_of_letters(way: Expr) -> bool:
    """Whether it is a sum of letters, each with its sign and nothing else: such a sum is in no factors."""
    return way.is_Add and all(term.is_Symbol or (-term).is_Symbol for term in way.args)


def _is_so(condition: Relation, coordinates: Mapping[Symbol, str]) -> bool:
    """Whether it is a length that is positive where all coordinates are zero."""
    at_rest = condition.residual.xreplace(dict.fromkeys(coordinates, ZERO))
    return bool(condition.mark == ">" and at_rest.is_positive)
