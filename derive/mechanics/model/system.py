"""Mechanical systems: particles and bodies, the forces on them, and the conditions on their motion.

Places are formulas in the coordinates, so geometric constraints between particles can be built into the places. The
energies are derived from the places. Second routes (d'Alembert's principle) use mass points and the forces on them,
which are derived from the same places.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeAlias, TypeVar

from sympy import Abs, Add, Dummy, Expr, ImmutableDenseMatrix, Integer, Pow, Rational, Symbol, diff, factor, sqrt

from derive.algebra.expressions import Factors, Relation, Terms, column, depends_on_time, explicit, rate
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled, Unverified
from derive.mechanics.bodies.placed import Placeable, PlacedBody, central_second_moments
from derive.mechanics.bodies.possible import require_positive
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.model.acted_on import WrongPart, check_what_is_acted_on
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.dalembert import Load, MassPoint, Matter
from derive.mechanics.model.description import Described, described
from derive.mechanics.model.forces import Charge, Damper, GivenForce, StoredEnergy
from derive.mechanics.model.part import Part
from derive.steps.record import assume, coordinates_in, require_constant
from derive.steps.signs import taken_positive
from derive.steps.step import Fact, Quantity, is_zero
from derive.witness import description as plain

__all__ = ["Particle", "System", "central", "spring", "weight"]

Sort = TypeVar("Sort", bound=Part)

HALF, ZERO = Rational(1, 2), Integer(0)
DISTANCE = Dummy("r", positive=True)


@dataclass(frozen=True)
class Particle(Part):
    """A particle of constant mass, kg, at a place. Source: Taylor, *Classical Mechanics*, section 7.1."""

    mass: Expr
    at: Location

    def __post_init__(self) -> None:
        if not isinstance(self.mass, Expr | int) or not isinstance(self.at, Location):
            message = "`Particle` needs an expression for its mass and a place that `point` or `place` gives"
            raise Rejected(Complaint("wrong-argument", message))
        require_constant("Particle", "mass", self.mass)
        require_positive("`Particle`", "mass", self.mass)

    def moved(self, known: Mapping[Symbol, Expr]) -> Particle:
        return replace(self, at=self.at.with_values(known))

    @property
    def places(self) -> Sequence[Location]:
        return [self.at]

    @property
    def masses(self) -> Sequence[tuple[Expr, Location]]:
        return [(self.mass, self.at)]

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        return {"particles": [plain.Particle(self.mass, self.at.components)]}


@dataclass(frozen=True)
class MovingBody(Part):
    """A placed body as a part of a system."""

    placed: PlacedBody

    def moved(self, known: Mapping[Symbol, Expr]) -> MovingBody:
        return MovingBody(self.placed.moved(known))

    @property
    def places(self) -> Sequence[Location]:
        return [self.placed.centre]

    @property
    def depends_on(self) -> tuple[Expr, ...]:
        return (*super().depends_on, *self.placed.depends_on)

    @property
    def masses(self) -> Sequence[tuple[Expr, Location]]:
        return [(self.placed.body.mass, self.placed.centre)]

    @property
    def mass_points(self) -> Sequence[MassPoint]:
        """The mass points that represent the body. One has the mass of the body and is at its centre of mass. Each of
        the others is at the end of a vector that starts at the origin and rotates with the body. Its `mass` is a second
        moment, or a difference of second moments."""
        placed = self.placed
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

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        """The body for the witness: its mass, the place of its given point, its centre of mass relative to this point,
        its second moments, and its rotations."""
        placed = self.placed
        axes = placed.in_plane if placed.is_plane else (0, 1, 2)
        arm = explicit(ImmutableDenseMatrix(placed.body.middle.position - placed.point.position))
        turns = placed.turned.turns if isinstance(placed.turned, Axes) else ((2, placed.turned),)
        spread = central_second_moments(placed.body)
        found = plain.Body(
            mass=placed.body.mass,
            place=placed.at.components,
            arm=tuple(arm[i] for i in axes),
            spread=tuple(tuple(spread[i, j] for j in range(3)) for i in range(3)),
            turns=tuple(turns),
            axes=tuple(axes),
        )
        return {"bodies": [found]}


@dataclass(frozen=True)
class Weight(Part):
    """The weight of every mass, downwards along the last axis, with the gravitational acceleration g in m/s^2."""

    gravity: Expr

    def on(self, mass: Expr, at: Location) -> Load:
        *across, _ = at.components
        return Load((*(ZERO for _ in across), -mass * self.gravity), at.components)

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        return {"gravity": [self.gravity]}


@dataclass(frozen=True)
class Central(Part):
    """A potential energy U(r), J, of the distance r between two places, and the attractive force dU/dr, N.

    branch   u or -u, if r = |u| on a fixed line and the system has chosen the sign; None otherwise
    """

    start: Location
    end: Location
    distance: Symbol
    energy: Expr
    pull: Expr
    massless: bool = False
    branch: Expr | None = None

    @property
    def is_spring(self) -> bool:
        return self.distance is DISTANCE

    @cached_property
    def along(self) -> Expr | None:
        """The expression u, if the distance is |u| along a line with a fixed direction; None otherwise."""
        components = [c for c in (self.end - self.start).components if c != 0]
        if len(components) == 1 and _is_sum_of_letters(components[0]):
            return components[0]
        length = sqrt(factor(tidied(Add(*(c**2 for c in components)))))
        sizes = length.atoms(Abs)
        if len(sizes) != 1 or length.has(Pow):
            return None
        (size,) = sizes
        return length.xreplace({size: size.args[0]})

    @cached_property
    def length(self) -> Expr:
        """Return the distance; if the system has chosen a branch, return the branch and assume that it is positive."""
        if self.branch is not None:
            assume(Relation(self.branch, ">", ZERO), self.is_spring)
            return self.branch
        if self.along is not None:
            return Abs(self.along)
        return sqrt(factor(tidied(Add(*(c**2 for c in (self.end - self.start).components)))))

    def moved(self, known: Mapping[Symbol, Expr]) -> Central:
        return replace(self, start=self.start.with_values(known), end=self.end.with_values(known))

    @property
    def places(self) -> Sequence[Location]:
        return [self.start, self.end]

    @property
    def acts_by(self) -> tuple[Expr, ...]:
        return (self.energy.xreplace({self.distance: DISTANCE}),)

    @property
    def loose_ends(self) -> Sequence[tuple[str, tuple[Expr, ...]]]:
        what = "spring" if self.is_spring else "central force"
        return [] if self.massless else [(what, end.components) for end in self.places]

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        pair = plain.Pair(self.start.components, self.end.components, self.distance, explicit(self.energy))
        return {"pairs": [pair]}

    def stored_loads(self, moving: Sequence[Symbol]) -> Sequence[Load]:
        """The forces on the two ends, which are attractive if the energy increases with the distance."""
        way = (self.end - self.start).components
        size = self.pull.xreplace({self.distance: self.length})
        pull = tuple(size * c / self.length for c in way)
        return Load(pull, self.start.components), Load(tuple(-c for c in pull), self.end.components)


def weight(gravity: Expr) -> Weight:
    """The weight of all particles and bodies of a system."""
    require_constant("weight", "gravity", gravity)
    return Weight(gravity)


def spring(constant: Expr, start: Location, end: Location, natural: Expr = ZERO, massless: bool = False) -> Central:
    """A massless spring between two places, U = (1/2) k (r - l)^2, with k in N/m and the natural length l in m.

    massless   whether the spring may end at a massless joint. By default each end must be fixed to the ground, or move
               with a body, a particle or a massless rod
    """
    require_constant("spring", "spring constant", constant)
    require_constant("spring", "natural length", natural)
    energy = Factors(HALF, constant, Pow(Terms(DISTANCE, -natural) if natural != 0 else DISTANCE, 2))
    return Central(start, end, DISTANCE, energy, constant * DISTANCE - constant * natural, massless)


def central(energy: Expr, distance: Symbol, start: Location, end: Location, massless: bool = False) -> Central:
    """A potential energy U(r), where r is the distance between two places: `central(-G*M*m/r, r, sun, planet)`.

    massless   as in `spring`
    """
    if depends_on_time(energy):
        raise Rejected(
            Complaint(
                "changes",
                "`central` needs an energy that depends only on the distance, but this energy depends on the time t",
            )
        )
    return Central(start, end, distance, energy, diff(energy, distance), massless)


PartOfSystem: TypeAlias = Part | PlacedBody | Quantity


@dataclass(frozen=True)
class KnownCoordinate(Fact):
    """A coordinate, and the expression in other coordinates that a condition yields for it."""

    missing = "is not a condition that expresses a coordinate by others"
    coordinate: Symbol
    function: Expr


@dataclass(frozen=True)
class Eliminated(Fact):
    """The coordinates that conditions express by other coordinates; later quantities do not contain them."""

    missing = "has no coordinate that is expressed by others"
    eliminates: tuple[Symbol, ...]


class System:
    """Particles and bodies, the forces on them, and the conditions on their motion.

    name   a name such as "first": keys of steps of this system begin with `first_`, and symbols have the index `first`
    """

    def __init__(self, *parts: PartOfSystem, name: str = ""):
        unknown = [part for part in parts if not isinstance(part, PartOfSystem)]
        if unknown:
            made_of = "a particle, a placed body, a weight, a spring or another force, a constraint or a condition"
            message = f"a part of a `System` must be {made_of}, not a {type(unknown[0]).__name__}"
            help_line = "place a body with `.placed` or `.held`" if isinstance(unknown[0], Placeable) else None
            raise Rejected(Complaint("wrong-argument", message, help=help_line))
        if name and not re.fullmatch(r"[a-z]+( [a-z]+)?", name):
            help_line = 'use one or two words of lower-case letters, such as "first"'
            raise Rejected(Complaint("name", f"`{name}` is not a valid name for a system", help=help_line))
        self.called = name
        self.conditions = tuple(part for part in parts if isinstance(part, Quantity))
        known = _known_by_all(self.conditions)
        self.known: Mapping[Symbol, Expr] = known
        self.eliminated = tuple(known)
        made = _with_weights([_as_part(part) for part in parts if not isinstance(part, Quantity)])
        # bodies are last, because sums over all masses begin with the particles
        self._described = tuple(sorted(made, key=lambda part: isinstance(part, MovingBody)))
        self.put_in = tuple(c for c in self.conditions if _is_put_into(c, self._described))
        self.parts = tuple(part.moved(known) for part in self._described) if known else self._described
        self.particles = self._of(Particle)
        self.bodies = tuple(part.placed for part in self._of(MovingBody))
        self.weights, self.between, self.charges = self._of(Weight), self._of(Central), self._of(Charge)
        in_fields = tuple(each.stored for each in self.charges if each.stored is not None)
        self.stored: tuple[StoredEnergy, ...] = (*self._of(StoredEnergy), *in_fields)
        given = self._of(GivenForce)
        self.given_forces = (*given, *(each.opposite for each in given if each.opposite is not None))
        self.dampers, self.constraints = self._of(Damper), self._of(Constraint)
        self._check()
        self.parts = _with_branches(self)
        self.between = self._of(Central)

    def _of(self, sort: type[Sort]) -> tuple[Sort, ...]:
        return tuple(part for part in self.parts if isinstance(part, sort))

    def _check(self) -> None:
        if not self.particles and not self.bodies:
            raise Rejected(Complaint("wrong-argument", "a `System` needs a particle or a body that is placed or held"))
        for placed in self.bodies:
            if placed.body.mass is None:
                raise Rejected(Complaint("wrong-argument", f"`System` needs the mass of {placed.body.name}"))
        for mass, _ in self.masses:
            if taken_positive(explicit(mass)) != 1:
                message = f"a mass of a `System` must be positive, but {mass} is not known to be positive"
                raise Rejected(Complaint("no-such-body", message))
        if len(self.weights) > 1:
            raise Rejected(Complaint("wrong-argument", "a `System` can have only one weight, for all its masses"))
        if len({len(place.components) for place in self.places}) > 1:
            message = "some places of this `System` have two components, and some have three"
            raise Rejected(Complaint("wrong-argument", message, help="give all places in a plane, or all in space"))
        if not self.coordinates:
            message = "no place or rotation in this `System` depends on a coordinate"
            raise Rejected(
                Complaint(
                    "wrong-argument",
                    message,
                    help=Spelled('define a variable, `coordinate("theta")`', "list the variables under `coordinates`"),
                )
            )
        self._check_what_acts()
        check_what_is_acted_on(self)
        for condition in self.conditions:
            _check_kept(condition)
        letters = [each.force.name for each in self.constraints]
        if len(set(letters)) < len(letters):
            message = "two constraints of this `System` have the same symbol for their forces"
            raise Rejected(
                Complaint(
                    "letter-clash",
                    message,
                    help=Spelled(
                        'give each constraint a different symbol, `constraint(..., force="N")`',
                        "give each constraint a different symbol, such as `force: N`",
                    ),
                )
            )

    def _check_what_acts(self) -> None:
        for part in self.parts:
            for q in coordinates_in(ImmutableDenseMatrix(part.acts_by)):
                if q not in self.coordinates:
                    name = q.name
                    message = (
                        f"a force, energy or constraint depends on {name}, but no place or rotation depends on {name}"
                    )
                    raise Rejected(Complaint("wrong-argument", message))

    @property
    def places(self) -> list[Location]:
        """The places of particles and charges, the centres of mass of bodies, the ends of springs, central forces,
        strings and massless rods, and the holes and pulleys of strings."""
        return [place for part in self.parts for place in part.places]

    @property
    def masses(self) -> list[tuple[Expr, Location]]:
        """The masses of the particles and bodies, with the places of their centres of mass."""
        return [each for part in self.parts for each in part.masses]

    @property
    def gravity(self) -> Expr:
        return self.weights[0].gravity if self.weights else Integer(0)

    @cached_property
    def coordinates(self) -> Mapping[Symbol, str]:
        """The coordinates in the places and in the rotations of the bodies, with their kinds."""
        return coordinates_in(ImmutableDenseMatrix([c for part in self.parts for c in part.depends_on]))

    @property
    def acting(self) -> list[tuple[Any, str, tuple[Expr, ...]]]:
        """The forces for which the script does not state the body: for each, the part, the name of the force, and
        its place."""
        return [(part, what, place) for part in self._described for what, place in part.loose_ends]

    @property
    def described_bodies(self) -> list[PlacedBody]:
        """The bodies before coordinates are eliminated, in the order that the witness uses."""
        return [part.placed for part in self._described if isinstance(part, MovingBody)]

    @cached_property
    def described(self) -> Described:
        """The input of the witness: the parts before conditions eliminate coordinates."""
        moving = {**self.coordinates, **coordinates_in(ImmutableDenseMatrix([*self.known, ZERO]))}
        # the conditions as given: none is substituted into another
        expressed = [_known_by(condition) for condition in self.conditions]
        return Described(described(self._described, self.described_bodies, expressed, moving))

    @cached_property
    def matter(self) -> Matter:
        """The mass points of the system, and the forces on them."""
        moving = list(self.coordinates)
        points = [point for part in self.parts for point in part.mass_points]
        loads = [each.on(mass, at) for each in self.weights for mass, at in self.masses]
        loads += [load for part in self.parts for load in part.stored_loads(moving)]
        others = [load for part in self.parts for load in part.other_loads(moving)]
        fields = [field for part in self.parts for field in part.fields]
        return Matter(tuple(points), tuple(loads), tuple(moving), tuple(others), tuple(fields))


def _with_weights(parts: Sequence[Part]) -> list[Part]:
    """Return the parts, with the weight of each part whose mass is not at one place, such as a rope.

    Reject a given potential energy of the weight of such a part, because this weight would count twice.
    """
    gravity = next((part.gravity for part in parts if isinstance(part, Weight)), None)
    weights = [] if gravity is None else [each for part in parts for each in part.weighed(gravity)]
    for each in (part for part in parts if isinstance(part, StoredEnergy)):
        if any(not coordinates_in(tidied(each.energy - own.energy)) for own in weights):
            message = f"{each.energy} is the potential energy of a rope in gravity, which the weight already includes"
            raise WrongPart.of(each, Complaint("twice", message, help="leave this `potential` out"))
    return [*parts, *weights]


def _as_part(part: Part | PlacedBody) -> Part:
    return MovingBody(part) if isinstance(part, PlacedBody) else part


def _known_by(condition: Quantity) -> tuple[Symbol, Expr]:
    found = condition.fact(KnownCoordinate)
    if found is None:
        message = f"`{condition.key}` does not express one coordinate by others, so it cannot be a part of a `System`"
        help_line = Spelled(
            'if the rolling condition cannot be integrated, use a contact: `*contact(..., rolling="F")`',
            "give the symbol of the friction that enforces the condition, `friction: {rolling: F}`",
        )
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    return found.coordinate, found.function


def _known_by_all(conditions: Sequence[Quantity]) -> dict[Symbol, Expr]:
    """Express the coordinates that conditions eliminate by the coordinates that are left.

    Reject conditions that also relate the coordinates that are left; a condition that follows from earlier ones is
    allowed.
    """
    known: dict[Symbol, Expr] = {}
    for condition in conditions:
        q, function = _known_by(condition)
        left = ((q - function).xreplace(known)).expand()
        own = left.coeff(q)  # zero if earlier conditions express q
        if own != 0:
            function = tidied(q - left / own)
            known = {other: value.xreplace({q: function}) for other, value in known.items()} | {q: function}
        elif not is_zero(left):
            other = list(coordinates_in(left))[-1]
            value = tidied(other - left / left.coeff(other))
            message = f"the conditions of rolling also determine {other}, which is {value} plus a constant"
            help_line = f"write {value}, with a constant if needed, in place of {other}, and leave {other} out"
            raise Rejected(Complaint("wrong-argument", message, help=help_line))
    return known


def _check_kept(condition: Quantity) -> None:
    """Check that the expression for the coordinate satisfies the condition, whatever the values of the rates are."""
    q, function = _known_by(condition)
    value = explicit(condition.value)
    if isinstance(value, Relation):
        its_rate = Add(*(diff(function, each) * rate(each) for each in coordinates_in(function)))
        left = value.residual.xreplace({rate(q): its_rate}).xreplace({q: function})
    else:
        left = value - function
    if not is_zero(left):
        raise Unverified(Complaint("unverified", f"`{condition.key}` is not satisfied by {q} = {function}"))


def _is_put_into(condition: Quantity, parts: Sequence[Part]) -> bool:
    """Whether any part depends on the coordinate that the condition expresses by other coordinates."""
    known = dict([_known_by(condition)])
    return any(part.moved(known) != part for part in parts)


def _with_branches(system: System) -> tuple[Part, ...]:
    """Return the parts. In a potential, a distance |u| is replaced by u or by -u if there is a natural choice.

    There is such a choice if the coordinates are displacements from an equilibrium, as for carts at x_1 and d + x_2.
    The page then states that u keeps its sign. There is no natural choice for a cart at x with a spring to a wall at d:
    |x - d| remains.
    """
    sided = tuple(_near_rest(each) for each in system.between)
    balanced = all(each is not None for each in sided) and _is_balanced(system, [each for each in sided if each])
    chosen = {
        each: near
        for each, near in zip(system.between, sided, strict=True)
        if near is not None and (balanced or _has_natural_length(near))
    }
    return tuple(chosen.get(part, part) if isinstance(part, Central) else part for part in system.parts)


def _near_rest(each: Central) -> Central | None:
    """The potential with the branch that is positive where all coordinates are zero. None if there is no such branch,
    or if the distance contains no coordinate.

    If the line between the two places has no fixed direction, the potential is unchanged.
    """
    if each.along is None:
        return each
    at_rest = _undriven(each.along)
    if not coordinates_in(each.along) or not (at_rest.is_positive or at_rest.is_negative):
        return None
    return replace(each, branch=each.along if at_rest.is_positive else -each.along)


def _has_natural_length(each: Central) -> bool:
    return each.branch is not None and is_zero(each.pull.xreplace({each.distance: _undriven(each.branch)}))


def _is_balanced(system: System, between: Sequence[Central]) -> bool:
    """Whether all generalized forces of the potential energy vanish where all coordinates are zero."""
    energy = Add(*(each.energy.xreplace({each.distance: each.branch or each.length}) for each in between))
    energy += Add(*(each.energy for each in system.stored))
    energy += Add(*(mass * system.gravity * at.height for mass, at in system.masses))
    return all(is_zero(_at_zero(diff(explicit(energy), q))) for q in system.coordinates)


def _at_zero(value: Expr) -> Expr:
    return value.xreplace(dict.fromkeys(coordinates_in(value), ZERO))


def _undriven(way: Expr) -> Expr:
    """The displacement between two places when all coordinates are zero, without terms that contain the time."""
    return Add(*(term for term in Add.make_args(_at_zero(way).expand()) if not depends_on_time(term)))


def _is_sum_of_letters(way: Expr) -> bool:
    """Whether the expression is a sum of symbols, each with the factor 1 or -1."""
    return way.is_Add and all(term.is_Symbol or (-term).is_Symbol for term in way.args)
