"""The mass points and forces of a Lagrangian, on which its second routes rest.

A rigid body moves like a few mass points: one of the whole mass at the centre of mass, and for the rotation points on
unit vectors fixed in the body, whose `masses` are second moments, in kg m^2. Kinetic energy, momenta and the virtual
work of inertia and of forces then come only from positions, differentiated as functions of t.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4 (d'Alembert's principle).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from sympy import Expr, ImmutableDenseMatrix, Integer, Matrix, Symbol

from derive.algebra.expressions import TIME, explicit
from derive.algebra.taylor import slope
from derive.errors import Complaint, Unverified
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.steps.record import coordinates_in
from derive.steps.step import Fact, Route

Vector = tuple[Expr, ...]


@dataclass(frozen=True)
class MassPoint:
    """A mass, in kg, at a place in space, in m; or a second moment, in kg m^2, on a unit vector."""

    mass: Expr
    place: Vector


@dataclass(frozen=True)
class Load:
    """A force, in N, at a place, in m; or a torque, in N m, on an angle.

    held   symbols in the place that are constant in every displacement, such as the position of a particle in its body,
           with their values
    """

    force: Vector
    place: Vector
    held: tuple[tuple[Symbol, Expr], ...] = ()

    def work_along(self, q: Symbol) -> Expr:
        """F . dr/dq"""
        return _dot(self.force, self.slopes(q))

    def slopes(self, q: Symbol) -> Vector:
        """dr/dq of the place of the force."""
        return tuple(c.xreplace(dict(self.held)) for c in _along(self.place, q))


@dataclass(frozen=True)
class MagneticForce:
    """The force q v x B, N, on a charge in motion in a uniform magnetic field; in a plane B points to the reader.

    Its vector potential is A = (1/2) B x r, in T m.
    """

    charge: Expr
    place: Vector
    field: Vector

    def __post_init__(self) -> None:
        if coordinates_in(ImmutableDenseMatrix(self.field)):
            message = "a magnetic field that depends on the place is not uniform"
            raise Unverified(Complaint("unverified", message))

    def load(self, moving: Sequence[Symbol]) -> Load:
        """The force by SymPy's vector product, which the potential does not use: so each checks the other."""
        v = _rates_of(self.place, tuple(moving), 1)
        velocity, field = (Matrix([*v, 0][:3]), Matrix([0, 0, *self.field] if len(v) == 2 else self.field))
        return Load(tuple(self.charge * c for c in list(velocity.cross(field))[: len(v)]), self.place)

    @property
    def vector_potential(self) -> Vector:
        if len(self.place) == 2:
            (b,), (x, y) = self.field, self.place
            return -b * y / 2, b * x / 2
        (bx, by, bz), (x, y, z) = self.field, self.place
        return (by * z - bz * y) / 2, (bz * x - bx * z) / 2, (bx * y - by * x) / 2

    def momentum_along(self, q: Symbol) -> Expr:
        """q A . dr/dq"""
        return self.charge * _dot(self.vector_potential, _along(self.place, q))


@dataclass(frozen=True)
class Reaction:
    """The force of a constraint on rates: it does the work lambda a_q dq in a displacement."""

    force: Symbol
    factors: tuple[tuple[Symbol, Expr], ...]

    def work_along(self, q: Symbol) -> Expr:
        return self.force * dict(self.factors).get(q, Integer(0))


@dataclass(frozen=True)
class Matter(Fact):
    """Mass points and loads, and the coordinates of their places.

    loads    the forces that have a potential energy
    fields   the forces of magnetic fields, which have vector potentials in a Lagrangian
    others   the forces without a potential energy: given forces, drag, and constraint forces
    """

    missing = "does not come from mass points and forces"

    points: tuple[MassPoint, ...] = ()
    loads: tuple[Load, ...] = ()
    coordinates: tuple[Symbol, ...] = ()
    others: tuple[Load | Reaction, ...] = ()
    fields: tuple[MagneticForce, ...] = ()

    def __add__(self, other: Matter) -> Matter:
        both = dict.fromkeys((*self.coordinates, *other.coordinates))
        others = (*self.others, *other.others)
        fields = (*self.fields, *other.fields)
        return Matter((*self.points, *other.points), (*self.loads, *other.loads), tuple(both), others, fields)

    @property
    def is_known(self) -> bool:
        """Whether mass points, or forces with a potential energy, are known."""
        return bool(self.points or self.loads)

    def named(self, routes: Mapping[str, Route]) -> dict[str, Route]:
        """Second routes, by names that show their basis."""
        return dict(routes)

    def further_routes(self, q: Symbol) -> dict[str, Route]:
        """Further routes to an equation of motion, apart from virtual work."""
        return {}

    @property
    def is_driven(self) -> bool:
        """Whether a place depends on time explicitly, not only through the coordinates."""
        return any(TIME in explicit(x).free_symbols for point in self.points for x in point.place)

    @property
    def weights(self) -> set[Symbol]:
        """The symbols in its masses."""
        return {letter for point in self.points for letter in explicit(point.mass).free_symbols}

    def kinetic_energy(self) -> Expr:
        """Half the sum of m v.v"""
        return sum((_dot(v, v) * m / 2 for m, _, v in self._moving(1)), Integer(0))

    def momentum_along(self, q: Symbol) -> Expr:
        """The sum of m v . dr/dq, and of q A . dr/dq of charges in magnetic fields"""
        found = self.field_momentum_along(q)
        return sum((m * _dot(v, _along(r, q)) for m, r, v in self._moving(1)), found)

    def energy_in_fields(self) -> Expr:
        """The sum of q v . A"""
        found: Expr = Integer(0)
        for field in self.fields:
            found += field.charge * _dot(field.vector_potential, self._rates(field.place, 1))
        return found

    def field_momentum_along(self, q: Symbol) -> Expr:
        """The sum of q A . dr/dq"""
        return sum((field.momentum_along(q) for field in self.fields), Integer(0))

    def inertia_along(self, q: Symbol) -> Expr:
        """The sum of m a . dr/dq: minus the virtual work of the inertial forces"""
        return sum((m * _dot(a, _along(r, q)) for m, r, a in self._moving(2)), Integer(0))

    def turning_along(self, q: Symbol) -> Expr:
        """The sum of m v . d(dr/dq)/dt, which is the derivative of T by q, plus the time derivative of the sum of
        q A . dr/dq over charges in magnetic fields.

        This second term and `deflection_along` together are the derivative of the sum of q v . A by q.
        """
        found: Expr = self._rates((self.field_momentum_along(q),), 1)[0] if self.fields else Integer(0)
        for m, r, v in self._moving(1):
            found += m * _dot(v, self._rates(_along(r, q), 1))
        return found

    def force_along(self, q: Symbol) -> Expr:
        """The sum of F . dr/dq: the virtual work of all forces"""
        return self.stored_force_along(q) + self.deflection_along(q) + self.other_force_along(q)

    def other_force_along(self, q: Symbol) -> Expr:
        """The virtual work of the forces without a term in the Lagrangian"""
        return sum((load.work_along(q) for load in self.others), Integer(0))

    def deflection_along(self, q: Symbol) -> Expr:
        """The virtual work of the forces q v x B"""
        return sum((field.load(self.coordinates).work_along(q) for field in self.fields), Integer(0))

    def stored_force_along(self, q: Symbol) -> Expr:
        """The virtual work of the forces that have a potential energy"""
        return sum((load.work_along(q) for load in self.loads), Integer(0))

    def _moving(self, order: int) -> list[tuple[Expr, Vector, Vector]]:
        return [(point.mass, point.place, self._rates(point.place, order)) for point in self.points]

    def _rates(self, v: Vector, order: int) -> Vector:
        return _rates_of(v, self.coordinates, order)


@lru_cache(maxsize=256)  # each momentum, force and equation of motion needs the rates of the same points
def _rates_of(v: Vector, coordinates: tuple[Symbol, ...], order: int) -> Vector:
    return tuple(by_functions_of_time(x, coordinates, order) for x in v)


def _dot(u: Vector, v: Vector) -> Expr:
    return sum((a * b for a, b in zip(u, v, strict=True)), Integer(0))


def _along(v: Vector, q: Symbol) -> Vector:
    return tuple(slope(x, q) for x in v)
