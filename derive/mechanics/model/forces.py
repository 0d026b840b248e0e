"""Forces other than weight and springs: given forces and torques, drag, charges in fields, and potential energies that
are given as functions.

The torque of a couple is a generalized force along an angle. A potential energy has a generalized force along each
coordinate that it contains.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol, diff

from derive.algebra.expressions import TIME, TimeRate, as_expr, explicit, rate
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import body_at
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.dalembert import Load, MagneticForce
from derive.mechanics.model.material import GROUND, MaterialPoint, material_point
from derive.mechanics.model.part import Part, moved, number_of
from derive.steps.record import coordinates_in, require_constant
from derive.steps.step import is_zero
from derive.witness import description as plain

__all__ = ["charge", "couple", "damping", "force", "potential"]

Vector = tuple[Expr, ...]
ZERO = Integer(0)


class _AtPlace(Part):
    """A force at a place, or along a coordinate.

    at   the components of the place; for a force along a coordinate or an angle, this quantity as the only component
    of   the body or particle on which the force acts, or "massless"; None if it is neither stated nor known from the
         place
    """

    at: Vector
    of: Any
    verb: ClassVar[str]  # the function with which a script creates the force
    what: ClassVar[str]  # the name of the force in messages

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        own: Any = self
        found: Self = replace(own, at=tuple(c.subs(known) for c in self.at), of=moved(self.of, known))
        return found

    @cached_property
    def point(self) -> MaterialPoint:
        """The material point on which the force acts."""
        return material_point(self.verb, self.of, Location(self.at))

    @property
    def place(self) -> Vector:
        """The place at which the force acts. A force on a particle acts at the place of the particle; any other force
        acts at `at`."""
        return self.at if self.point.held else self.point.place

    @property
    def acts_by(self) -> Vector:
        return self.at

    @property
    def loose_ends(self) -> Sequence[tuple[str, Vector]]:
        return [(self.what, self.at)] if self.of is None and len(self.at) > 1 else []


@dataclass(frozen=True)
class GivenForce(_AtPlace):
    """A force at a place, N; or a generalized force Q along a coordinate q, with the work Q dq.

    Q is a torque if q is an angle.
    of   the body or particle on which the force acts, or "massless"; None if it is neither stated nor known from the
         place
    by   the body or particle that exerts the force, or "ground"; the opposite force acts on this body or particle
    """

    components: Vector
    at: Vector
    of: Any = None
    by: Any = None
    verb = what = "force"

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), by=moved(self.by, known))

    def load(self, moving: Sequence[Symbol]) -> Load:
        return Load(self.components, self.point.place, self.point.held)

    @property
    def acts_by(self) -> Vector:
        return (*self.at, *self.components)

    @property
    def opposite(self) -> GivenForce | None:
        """The opposite force at the same place, on the body or particle `by`; None if `by` is None or the ground."""
        if self.by is None or self.by == GROUND:
            return None
        return GivenForce(tuple(-c for c in self.components), self.at, self.by, self.of)

    @property
    def pair(self) -> tuple[GivenForce, ...]:
        """The force, and the opposite force if there is one."""
        return (self,) if self.opposite is None else (self, self.opposite)

    def other_loads(self, moving: Sequence[Symbol]) -> Sequence[Load]:
        return [each.load(moving) for each in self.pair]

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        return {"forces": [plain.Force(f.components, f.place, number_of(f.of, bodies)) for f in self.pair]}


@dataclass(frozen=True)
class Damper(_AtPlace):
    """Drag -c v against the velocity v of a place, or -c q_dot along a coordinate; `of` as in `GivenForce`."""

    constant: Expr
    at: Vector
    of: Any = None
    verb, what = "damping", "drag"

    def velocity(self, moving: Sequence[Symbol]) -> Vector:
        return tuple(explicit(TimeRate(c, *moving)).xreplace(self.point.values) for c in self.point.place)

    def load(self, moving: Sequence[Symbol]) -> Load:
        drag = tuple(-self.constant * v for v in self.velocity(moving))
        return Load(drag, self.point.place, self.point.held)

    def other_loads(self, moving: Sequence[Symbol]) -> Sequence[Load]:
        return [self.load(moving)]

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        return {"drags": [plain.Drag(self.constant, self.place, number_of(self.of, bodies))]}


@dataclass(frozen=True)
class StoredEnergy(Part):
    """A potential energy as a function of the coordinates and time, J."""

    energy: Expr

    def moved(self, known: Mapping[Symbol, Expr]) -> StoredEnergy:
        return StoredEnergy(self.energy.subs(known))

    @property
    def acts_by(self) -> Vector:
        return (self.energy,)

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        return {"energies": [self.energy]}

    def stored_loads(self, moving: Sequence[Symbol]) -> list[Load]:
        """The generalized force -dU/dq along each coordinate, and -dU/dt along t; zeros are left out.

        -dU/dt is the rate at which U decreases if all coordinates are constant.
        """
        slopes = [(q, -diff(self.energy, q)) for q in (*moving, TIME)]
        return [Load((slope,), (q,)) for q, slope in slopes if slope != 0]


@dataclass(frozen=True)
class InUniformField(StoredEnergy):
    """The energy of a charge in a uniform electric field; the force is given as q E, not derived from the energy."""

    force: Vector
    at: Vector

    def stored_loads(self, moving: Sequence[Symbol]) -> list[Load]:
        """The force F, and (dF/dt) . r along t, the rate at which the energy decreases if the field changes."""
        changes = Add(*(diff(f, TIME) * c for f, c in zip(self.force, self.at, strict=True)))
        return [Load(self.force, self.at), *([Load((changes,), (TIME,))] if changes != 0 else [])]


@dataclass(frozen=True)
class Charge(Part):
    """A charge in uniform fields, with the force q (E + v x B)."""

    charge: Expr
    at: Location
    electric: Vector
    magnetic: Vector

    def moved(self, known: Mapping[Symbol, Expr]) -> Charge:
        return replace(self, at=self.at.with_values(known))

    @property
    def places(self) -> Sequence[Location]:
        return [self.at]

    @property
    def stored(self) -> StoredEnergy | None:
        """The potential energy in a uniform electric field, U = -q E . r; None without an electric field."""
        if is_nothing(self.electric):
            return None
        place = self.at.components
        energy = -self.charge * Add(*(e * c for e, c in zip(self.electric, place, strict=True)))
        return InUniformField(energy, tuple(self.charge * e for e in self.electric), place)

    def stored_loads(self, moving: Sequence[Symbol]) -> Sequence[Load]:
        return self.stored.stored_loads(moving) if self.stored is not None else []

    @property
    def fields(self) -> Sequence[MagneticForce]:
        return [] if is_nothing(self.magnetic) else [MagneticForce(self.charge, self.at.components, self.magnetic)]

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        return {"charges": [plain.Charge(self.charge, self.at.components, self.electric, self.magnetic)]}


def _vector(verb: str, role: str, given: Any, count: int) -> Vector:
    values = given.components if isinstance(given, Location) else given
    if not isinstance(values, tuple | list) or len(values) != count:
        needed = f"{count} components, as many as the place" if count > 1 else "one component"
        message = f"`{verb}`: `{role}` must have {needed}"
        raise Rejected(Complaint("wrong-argument", message))
    try:
        return tuple(as_expr(value) for value in values)
    except TypeError:
        raise Rejected(Complaint("wrong-argument", f"`{verb}`: `{role}` must consist of expressions")) from None


def _place(verb: str, at: Any) -> Location:
    if not isinstance(at, Location):
        raise Rejected(Complaint("wrong-argument", f"`{verb}` needs a place that `point` or `place` gives"))
    return at


def force(components: Any, at: Location, of: Any = None, by: Any = None) -> GivenForce:
    """A given force at a place, N; its components may be constants, or formulas in the coordinates and the time t.

    of   the body or particle on which the force acts, needed if the place does not move with this body; or "massless"
         for a part without mass
    by   the body or particle that exerts the force, or "ground"; the opposite force acts on this body or particle
    """
    place = _place("force", at)
    of = body_at(at, of)
    found = GivenForce(_vector("force", "components", components, len(place.components)), place.components, of, by)
    for each in (found, found.opposite):
        if each is not None:
            each.load(())  # raises an error if `of` is not valid
    return found


def couple(torque: Any, on: Any) -> GivenForce:
    """A given torque along an angle, N m; the angle is a coordinate, or a formula in coordinates."""
    along = as_expr(on)
    if not coordinates_in(along):
        message = f"`couple` needs an angle with a coordinate, but {along} contains none"
        raise Rejected(Complaint("wrong-argument", message))
    return GivenForce((as_expr(torque),), (along,))


def damping(constant: Any, at: Any, of: Any = None) -> Damper:
    """Drag against the velocity of a place, -c v with c in kg/s, or against the rate of a coordinate, -c q_dot.

    of   the body or particle on which the drag acts at this place, needed if the place does not move with this body
    """
    require_constant("damping", "constant", constant)
    if isinstance(at, Location):
        found = Damper(constant, at.components, body_at(at, of))
        found.load(())  # raises an error if `of` is not valid
        return found
    if not isinstance(at, Coordinate | Expr) or not coordinates_in(as_expr(at)):
        message = "`damping` must act on a place, or along a coordinate or a formula in coordinates"
        raise Rejected(Complaint("wrong-argument", message))
    return Damper(constant, (as_expr(at),))


def potential(energy: Any) -> StoredEnergy:
    """A potential energy as a function of the coordinates, and of time for a driven system, J."""
    given: Expr = explicit(as_expr(energy))
    moving = coordinates_in(given)
    fast = [q for q in moving if given.has(rate(q), rate(q, 2))]
    if fast:
        message = f"`potential` must not depend on rates, but it depends on the rate of {fast[0].name}"
        raise Rejected(Complaint("wrong-argument", message))
    if not moving:
        message = f"`potential` needs an energy in coordinates, but {given} contains no coordinate"
        raise Rejected(Complaint("wrong-argument", message))
    return StoredEnergy(given)


def charge(amount: Any, at: Location, E: Any = None, B: Any = None) -> Charge:
    """A charge (in C) at a place in a uniform electric field E (in V/m) and a uniform magnetic field B (in T).

    E   the components of the electric field, one for each component of the place
    B   three components; for a place in a plane, only the component perpendicular to the plane, towards the reader
    """
    place = _place("charge", at)
    count = len(place.components)
    electric = _vector("charge", "E", E, count) if E is not None else (ZERO,) * count
    if B is None:
        magnetic: Vector = (ZERO,) * (3 if count == 3 else 1)
    elif count == 2:
        magnetic = (as_expr(B),) if not isinstance(B, tuple | list | Location) else _vector("charge", "B", B, 1)
    else:
        magnetic = _vector("charge", "B", B, 3)
    require_constant("charge", "charge", as_expr(amount))
    for role, field in (("electric field", electric), ("magnetic field", magnetic)):
        for component in field:
            if coordinates_in(component):
                help_line = "describe any other field with `potential` or `force`"
                message = f"`charge` needs a uniform {role}, but {component} depends on the place"
                raise Rejected(Complaint("changes", message, help=help_line))
    for component in magnetic:
        require_constant("charge", "magnetic field", component)
    return Charge(as_expr(amount), place, electric, magnetic)


def is_nothing(vector: Vector) -> bool:
    return is_zero(ImmutableDenseMatrix(vector))
