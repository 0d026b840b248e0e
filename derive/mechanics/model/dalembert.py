"""The mass points of a system and the forces on them, from which second routes start.

A rigid body is equivalent to a few mass points: one has the whole mass, at the centre of mass, and others describe the
rotation. Each of these other points is the end of a vector that rotates with the body: the unit vector of a body axis,
or the sum of two such unit vectors. Its `mass` is a second moment, or a difference of second moments, in kg m^2.
Kinetic energy, momenta and the virtual work of inertial forces follow from the positions of these points as functions
of t.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4 (d'Alembert's principle).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from sympy import Expr, ImmutableDenseMatrix, Integer, Matrix, Symbol

from derive.algebra.expressions import depends_on_time, explicit
from derive.algebra.taylor import slope
from derive.errors import Complaint, Unverified
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.steps.record import coordinates_in
from derive.steps.step import Fact, Route

Vector = tuple[Expr, ...]


@dataclass(frozen=True)
class MassPoint:
    """A mass, in kg, at a place, in m; or a second moment, in kg m^2, at the end of a dimensionless vector."""

    mass: Expr
    place: Vector


@dataclass(frozen=True)
class Load:
    """A force, in N, at a place, in m; or a generalized force along a coordinate, such as a torque along an angle, N m.

    place   the components of the place; for a generalized force, the coordinate or angle along which it acts, as the
            only component
    held    pairs of a symbol in `place` and its value. Such a symbol is constant in every displacement; an example is a
            component of the position of a particle in its body
    multiplier   the symbol of a constraint force, which is a factor of the force; None for other forces
    """

    force: Vector
    place: Vector
    held: tuple[tuple[Symbol, Expr], ...] = ()
    multiplier: Symbol | None = None

    def work_along(self, q: Symbol) -> Expr:
        """F . dr/dq"""
        return _dot(self.force, self.slopes(q))

    def slopes(self, q: Symbol) -> Vector:
        """dr/dq, where r is the place of the force."""
        return tuple(c.xreplace(dict(self.held)) for c in _along(self.place, q))


@dataclass(frozen=True)
class MagneticForce:
    """The force e v x B, N, on a charge e in a uniform magnetic field.

    For a motion in a plane, B is perpendicular to the plane, and positive towards the reader. The vector potential of
    the field is A = (1/2) B x r, in T m.
    """

    charge: Expr
    place: Vector
    field: Vector

    def __post_init__(self) -> None:
        if coordinates_in(ImmutableDenseMatrix(self.field)):
            message = "a magnetic field that depends on the place is not uniform"
            raise Unverified(Complaint("unverified", message))

    def load(self, moving: Sequence[Symbol]) -> Load:
        """Return the force e v x B from SymPy's vector product, without `vector_potential`."""
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
        """e A . dr/dq"""
        return self.charge * _dot(self.vector_potential, _along(self.place, q))


@dataclass(frozen=True)
class Reaction:
    """The force of a constraint; its virtual work is the sum of lambda a_q dq.

    factors   pairs of q and a_q; for a constraint f = c between coordinates, a_q is df/dq
    """

    multiplier: Symbol
    factors: tuple[tuple[Symbol, Expr], ...]

    def work_along(self, q: Symbol) -> Expr:
        return self.multiplier * dict(self.factors).get(q, Integer(0))


@dataclass(frozen=True)
class Matter(Fact):
    """Mass points and forces, and the coordinates that their places depend on.

    loads    the forces that have a potential energy
    fields   the magnetic forces, which have a vector potential in the Lagrangian
    others   the other forces without a potential energy: given forces, drag, and constraint forces
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
        """Whether any mass point, or any force with a potential energy, is known."""
        return bool(self.points or self.loads)

    def named(self, routes: Mapping[str, Route]) -> dict[str, Route]:
        """The second routes by name; a subclass may rename them."""
        return dict(routes)

    def further_routes(self, q: Symbol) -> dict[str, Route]:
        """Further second routes to an equation of motion, in addition to virtual work; empty by default."""
        return {}

    @property
    def is_driven(self) -> bool:
        """Whether the place of a mass point depends on time explicitly, not only through the coordinates."""
        return any(depends_on_time(x) for point in self.points for x in point.place)

    @property
    def weights(self) -> set[Symbol]:
        """The symbols in the masses of the mass points."""
        return {letter for point in self.points for letter in explicit(point.mass).free_symbols}

    def kinetic_energy(self) -> Expr:
        """Half the sum of m v.v"""
        return sum((_dot(v, v) * m / 2 for m, _, v in self._moving(1)), Integer(0))

    def momentum_along(self, q: Symbol) -> Expr:
        """The sum of m v . dr/dq over mass points, plus the sum of e A . dr/dq over charges e in magnetic fields"""
        found = self.field_momentum_along(q)
        return sum((m * _dot(v, _along(r, q)) for m, r, v in self._moving(1)), found)

    def energy_in_fields(self) -> Expr:
        """The sum of e v . A over charges e in magnetic fields"""
        found: Expr = Integer(0)
        for field in self.fields:
            found += field.charge * _dot(field.vector_potential, self._rates(field.place, 1))
        return found

    def field_momentum_along(self, q: Symbol) -> Expr:
        """The sum of e A . dr/dq over charges e in magnetic fields"""
        return sum((field.momentum_along(q) for field in self.fields), Integer(0))

    def inertia_along(self, q: Symbol) -> Expr:
        """The sum of m a . dr/dq: minus the generalized force of the inertial forces"""
        return sum((m * _dot(a, _along(r, q)) for m, r, a in self._moving(2)), Integer(0))

    def turning_along(self, q: Symbol) -> Expr:
        """The sum of m v . d(dr/dq)/dt, which is dT/dq, plus d/dt of the sum of e A . dr/dq over charges e.

        The second term plus `deflection_along` is the derivative of the sum of e v . A with respect to q.
        """
        found: Expr = self._rates((self.field_momentum_along(q),), 1)[0] if self.fields else Integer(0)
        for m, r, v in self._moving(1):
            found += m * _dot(v, self._rates(_along(r, q), 1))
        return found

    def force_along(self, q: Symbol) -> Expr:
        """The generalized force along q: the sum of F . dr/dq over all forces"""
        return self.stored_force_along(q) + self.deflection_along(q) + self.other_force_along(q)

    def other_force_along(self, q: Symbol) -> Expr:
        """The generalized force of the forces that have no term in the Lagrangian"""
        return sum((load.work_along(q) for load in self.others), Integer(0))

    def deflection_along(self, q: Symbol) -> Expr:
        """The generalized force of the magnetic forces"""
        return sum((field.load(self.coordinates).work_along(q) for field in self.fields), Integer(0))

    def stored_force_along(self, q: Symbol) -> Expr:
        """The generalized force of the forces that have a potential energy"""
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
