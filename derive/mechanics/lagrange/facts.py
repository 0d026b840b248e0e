"""Facts that results hand on besides their value, for the steps that rest on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sympy import Dummy, Expr, Integer, Symbol

from derive.algebra.expressions import Relation, bound, explicit, rate
from derive.algebra.taylor import slope
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.dalembert import Matter
from derive.steps.step import Fact, Quantity, Route

ZERO = Integer(0)


@dataclass(frozen=True)
class ForceOf(Fact):
    """The constraint that a force keeps, and the equations from which it was found."""

    missing = "is not the force of a constraint"
    constraint: Constraint
    problem: Any


@dataclass(frozen=True)
class KeptMomentum(Fact):
    """The letter of a momentum, the value that it keeps, and the rate of its coordinate that follows from that."""

    missing = "is not the value of a conserved momentum"
    momentum: Symbol
    value: Expr
    coordinate: Symbol
    turning: Expr


@dataclass(frozen=True)
class WithMomenta(Fact):
    """An equation of motion in which momenta have the values that they keep: the Lagrangian, and these values."""

    missing = "is not an equation of motion with the values of conserved momenta put in"
    lagrangian: Quantity
    kept: tuple[KeptMomentum, ...]


@dataclass(frozen=True)
class FromLagrangian(Fact):
    """The Lagrangian that an equation of motion or a momentum comes from."""

    missing = "does not come from a Lagrangian"
    lagrangian: Quantity


@dataclass(frozen=True)
class Energies(Fact):
    """The energies that a Lagrangian is the difference of."""

    missing = "is not the Lagrangian that `lagrangian` yields"
    kinetic: Quantity
    potential: Quantity
    magnetic: Quantity | None = None

    @property
    def whole(self) -> Expr:
        return explicit(self.kinetic.value + self.potential.value)


def energies_of(lagrangian: Quantity) -> Energies | None:
    """The energies that it is the difference of; nothing where it is given."""
    return None if lagrangian.fact(Varied) is not None else lagrangian.needed(Energies)


@dataclass(frozen=True)
class Varied(Matter):
    """What a given Lagrangian does where it is varied, in the place of mass points and forces.

    function   the Lagrangian
    """

    function: Expr = ZERO

    def __add__(self, other: Matter) -> Matter:
        if other != self:
            raise Rejected(Complaint("different-subjects", "these belong to different Lagrangians"))
        return self

    @property
    def is_known(self) -> bool:
        return True

    def named(self, routes: Mapping[str, Route]) -> dict[str, Route]:
        return {f"given_{name}": route for name, route in routes.items()}

    def kinetic_energy(self) -> Expr:
        raise Rejected(Complaint("given-lagrangian", "of a Lagrangian that is given no kinetic energy is known"))

    def momentum_along(self, q: Symbol) -> Expr:
        """What L gains where the rate of q alone is varied."""
        return slope(self.function, rate(q))

    def turning_along(self, q: Symbol) -> Expr:
        """What L gains where q alone is varied."""
        return slope(self.function, q)

    def inertia_along(self, q: Symbol) -> Expr:
        """What the action loses where q is varied, per unit of time: dp/dt less the slope of L."""
        return by_functions_of_time(self.momentum_along(q), self.coordinates) - self.turning_along(q)

    def further_routes(self, q: Symbol) -> dict[str, Route]:
        """The rate of the energy of q alone, the others being what they are as functions of time, less what these do,
        is the power of what acts along q: no derivative of L by q is taken."""

        def power(found: Any) -> tuple[Any, Any]:
            others = [s for s in self.coordinates if s != q]
            own = rate(q) * self.momentum_along(q) - self.function
            changed = by_functions_of_time(own, self.coordinates)
            given = by_functions_of_time(self.function, others)
            along = (changed + given) / rate(q) - self.other_force_along(q)
            return found, Relation(along, "=", 0)

        return {"energy_identity": power}

    def change_along(self, shift: Mapping[Symbol, Expr]) -> Expr:
        """The first order of L where every coordinate is shifted by a formula."""
        small = Dummy("epsilon", real=True)
        moved: dict[Symbol, Expr] = {}
        for q, x in shift.items():
            moved.update({q: q + small * x, rate(q): rate(q) + small * by_functions_of_time(x, self.coordinates)})
        return slope(bound(self.function, moved), small).xreplace({small: ZERO})
