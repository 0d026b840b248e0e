"""Facts that results pass to later steps, in addition to their values."""

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
    """The constraint of a constraint force, and the linear equations that were solved for the force."""

    missing = "is not the force of a constraint"
    constraint: Constraint
    problem: Any


@dataclass(frozen=True)
class KeptMomentum(Fact):
    """The symbol and the conserved value of a momentum, its coordinate, and the resulting rate of this coordinate."""

    missing = "is not the value of a conserved momentum"
    momentum: Symbol
    value: Expr
    coordinate: Symbol
    turning: Expr


@dataclass(frozen=True)
class WithMomenta(Fact):
    """The Lagrangian of an equation of motion, and the conserved momenta whose values the equation contains."""

    missing = "is not an equation of motion with substituted values of conserved momenta"
    lagrangian: Quantity
    kept: tuple[KeptMomentum, ...]


@dataclass(frozen=True)
class FromLagrangian(Fact):
    """The Lagrangian from which a result was derived, such as an equation of motion or an energy function."""

    missing = "does not come from a Lagrangian"
    lagrangian: Quantity


@dataclass(frozen=True)
class Energies(Fact):
    """The kinetic and the potential energy of a Lagrangian, and its term for magnetic fields, if there is one."""

    missing = "is not a Lagrangian that `lagrangian` returned"
    kinetic: Quantity
    potential: Quantity
    magnetic: Quantity | None = None

    @property
    def whole(self) -> Expr:
        return explicit(self.kinetic.value + self.potential.value)


def energies_of(lagrangian: Quantity) -> Energies | None:
    """Return the energies of which a Lagrangian consists; None for a Lagrangian that is given as a formula."""
    return None if lagrangian.fact(Varied) is not None else lagrangian.needed(Energies)


@dataclass(frozen=True)
class Varied(Matter):
    """The first variations of a given Lagrangian; second routes use them in place of mass points and forces.

    function   the expression of the Lagrangian, J
    """

    function: Expr = ZERO

    def __add__(self, other: Matter) -> Matter:
        if other != self:
            raise Rejected(Complaint("different-subjects", "these quantities belong to different Lagrangians"))
        return self

    @property
    def is_known(self) -> bool:
        return True

    def named(self, routes: Mapping[str, Route]) -> dict[str, Route]:
        return {f"given_{name}": route for name, route in routes.items()}

    def kinetic_energy(self) -> Expr:
        raise Rejected(Complaint("given-lagrangian", "the kinetic energy of a given Lagrangian is unknown"))

    def momentum_along(self, q: Symbol) -> Expr:
        """Return the derivative of L with respect to the rate of q."""
        return slope(self.function, rate(q))

    def turning_along(self, q: Symbol) -> Expr:
        """Return the derivative of L with respect to q."""
        return slope(self.function, q)

    def inertia_along(self, q: Symbol) -> Expr:
        """Return dp/dt minus the derivative of L with respect to q; this is minus the variational derivative of the
        action."""
        return by_functions_of_time(self.momentum_along(q), self.coordinates) - self.turning_along(q)

    def further_routes(self, q: Symbol) -> dict[str, Route]:
        """Return the second route by the energy identity, which needs no derivative of L with respect to q.

        The energy of q alone is q_dot p - L. The rate of this energy, plus the rate of L at constant q and q_dot, is
        the power of the forces along q.
        """

        def power(found: Any) -> tuple[Any, Any]:
            others = [s for s in self.coordinates if s != q]
            own = rate(q) * self.momentum_along(q) - self.function
            changed = by_functions_of_time(own, self.coordinates)
            given = by_functions_of_time(self.function, others)
            along = (changed + given) / rate(q) - self.other_force_along(q)
            return found, Relation(along, "=", 0)

        return {"energy_identity": power}

    def change_along(self, shift: Mapping[Symbol, Expr]) -> Expr:
        """Return the first-order change of L if the coordinates are shifted by these formulas."""
        small = Dummy("epsilon", real=True)
        moved: dict[Symbol, Expr] = {}
        for q, x in shift.items():
            moved.update({q: q + small * x, rate(q): rate(q) + small * by_functions_of_time(x, self.coordinates)})
        return slope(bound(self.function, moved), small).xreplace({small: ZERO})
