"""Facts that results hand on besides their value, for the steps that rest on them."""

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
    """That a momentum does not change, and the coordinate that it belongs to."""

    missing = "is not the momentum of a cyclic coordinate, as `conserved` yields it"
    coordinate: Coordinate


@dataclass(frozen=True)
class SeenWith(Fact):
    """What sees an effective potential energy: the Lagrangian, the constant momenta, and the matter that has these."""

    missing = "is not an effective potential energy"
    lagrangian: Quantity
    constants: tuple[Quantity, ...]
    matter: Matter

    def with_values(self, values: Mapping[Symbol, Expr]) -> SeenWith | None:
        """The same where the letters of some momenta have values; nothing where other letters have."""
        if not isinstance(self.matter, ReducedMatter) or not set(values) <= {p.symbol for p in self.constants}:
            return None
        rates = tuple((v, tidied(bound(found, values))) for v, found in self.matter.rates)
        return replace(self, matter=replace(self.matter, rates=rates))


@dataclass(frozen=True)
class PhaseSpace(Fact):
    """What is a function of coordinates and momenta, and the Lagrangian whose momenta they are."""

    missing = "is not a function of coordinates and their momenta"
    coordinates: tuple[Coordinate, ...]
    momenta: tuple[Quantity, ...]
    lagrangian: Quantity

    @property
    def pairs(self) -> tuple[tuple[Symbol, Symbol], ...]:
        return tuple((q.symbol, letter_of_momentum(q)) for q in self.coordinates)

    @property
    def in_rates(self) -> dict[Symbol, Expr]:
        """Each momentum as it depends on the rates, which the mass points have confirmed."""
        return {p.symbol: explicit(p.value) for p in self.momenta}


@dataclass(frozen=True)
class ReducedMatter(Matter):
    """Matter whose cyclic coordinates move as their constant momenta tell: what it does along the others.

    whole   the matter with all its coordinates
    rates   those of the cyclic coordinates, by the others and by the constants
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
