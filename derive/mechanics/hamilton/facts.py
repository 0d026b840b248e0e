"""Facts about motions in phase space that results pass to later steps, in addition to their values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from sympy import Expr, Symbol

from derive.algebra.expressions import (
    bound,
    explicit,
    rate,
)
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.coordinates import Coordinate, by_functions_of_time
from derive.mechanics.lagrange.momenta import letter_of_momentum
from derive.mechanics.model.dalembert import Matter
from derive.steps.step import Fact, Quantity, Route


@dataclass(frozen=True)
class Constant(Fact):
    """The cyclic coordinate of a constant momentum."""

    missing = "is not a momentum that `conserved` returned"
    coordinate: Coordinate


@dataclass(frozen=True)
class SeenWith(Fact):
    """The context of an effective potential energy: the Lagrangian, the constant momenta, and the mass points and
    forces."""

    missing = "is not an effective potential energy"
    lagrangian: Quantity
    constants: tuple[Quantity, ...]
    matter: Matter

    def with_values(self, values: Mapping[Symbol, Expr]) -> SeenWith | None:
        """Return the same fact with values substituted for the symbols of constant momenta; None if `values` contains
        any other symbol."""
        if not isinstance(self.matter, ReducedMatter) or not set(values) <= {p.symbol for p in self.constants}:
            return None
        rates = tuple((v, tidied(bound(found, values))) for v, found in self.matter.rates)
        return replace(self, matter=replace(self.matter, rates=rates))


@dataclass(frozen=True)
class PhaseSpace(Fact):
    """The coordinates and momenta of a function in phase space, and the Lagrangian that defines these momenta."""

    missing = "is not a function of coordinates and their momenta"
    coordinates: tuple[Coordinate, ...]
    momenta: tuple[Quantity, ...]
    lagrangian: Quantity

    @property
    def pairs(self) -> tuple[tuple[Symbol, Symbol], ...]:
        return tuple((q.symbol, letter_of_momentum(q)) for q in self.coordinates)

    @property
    def in_rates(self) -> dict[Symbol, Expr]:
        """Each momentum as a function of the rates, from the step that derived it."""
        return {p.symbol: explicit(p.value) for p in self.momenta}


@dataclass(frozen=True)
class ReducedMatter(Matter):
    """Mass points and forces with respect to the coordinates that are not cyclic. The rates of the cyclic coordinates
    follow from their constant momenta.

    whole   the mass points and forces with all coordinates
    rates   the rates of the cyclic coordinates, in terms of the other coordinates and the constant momenta
    """

    whole: Matter = field(default_factory=Matter)
    rates: tuple[tuple[Symbol, Expr], ...] = ()

    def kinetic_energy(self) -> Expr:
        return self._put_in(self.whole.kinetic_energy())

    def named(self, routes: Mapping[str, Route]) -> dict[str, Route]:
        return self.whole.named(routes)

    def momentum_along(self, q: Symbol) -> Expr:
        return self._put_in(self.whole.momentum_along(q))

    def inertia_along(self, q: Symbol) -> Expr:
        return self._put_in(self.whole.inertia_along(q))

    def turning_along(self, q: Symbol) -> Expr:
        return self._put_in(self.whole.turning_along(q))

    def force_along(self, q: Symbol) -> Expr:
        return self._put_in(self.whole.force_along(q))

    def other_force_along(self, q: Symbol) -> Expr:
        return self._put_in(self.whole.other_force_along(q))

    def stored_force_along(self, q: Symbol) -> Expr:
        return self._put_in(self.whole.stored_force_along(q))

    def _put_in(self, value: Expr) -> Expr:
        accelerations = {rate(v): by_functions_of_time(found, self.coordinates) for v, found in self.rates}
        return bound(bound(explicit(value), accelerations), dict(self.rates))
