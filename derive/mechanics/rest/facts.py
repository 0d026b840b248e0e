"""Facts that results carry in addition to their value, for later steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sympy import (
    Expr,
    Rational,
    Symbol,
)

from derive.algebra.expressions import (
    Relation,
)
from derive.algebra.samples import value_at
from derive.mechanics.hamilton.facts import SeenWith
from derive.mechanics.model.dalembert import Matter
from derive.steps.step import Fact, Quantity

NEAR = Rational(1, 1000)  # distance from an equilibrium at which the energy is compared


@dataclass(frozen=True)
class RestOf(Fact):
    """The potential energy from which an equilibrium was found, and the coordinates for which the equilibrium
    conditions were solved."""

    missing = "is not an equilibrium that `equilibria` returned"
    potential: Quantity
    coordinates: tuple[Symbol, ...]


def matter_behind(potential: Quantity) -> Matter | None:
    """Return the mass points and forces to which a potential energy belongs; None if they are unknown.

    For an effective potential energy, the mass points and forces do not contain the coordinates that were eliminated
    with constant momenta.
    """
    seen, own = potential.fact(SeenWith), potential.fact(Matter)
    return seen.matter if seen is not None else own if own is not None and own.is_known else None


@dataclass(frozen=True)
class Shape(Fact):
    """The curvature of a potential energy at an equilibrium.

    place    the equilibrium value of the coordinate
    border   a symbol and its value on the boundary of stability, where the curvature vanishes; None if there is no
             boundary, or if no higher order decides there
    """

    missing = "is not the curvature at an equilibrium"
    potential: Quantity
    coordinate: Symbol
    place: Expr
    border: Relation | None


@dataclass(frozen=True)
class StableWhere(Fact):
    """The condition for stability in one coordinate.

    energy         the potential energy, J
    place          the equilibrium value of the coordinate
    border         a symbol and its value on the boundary of the condition; None if no higher order decides there
    stable_there   whether the equilibrium is stable on the boundary; None if no higher order decides there
    """

    missing = "is not a result of `stability` that depends on a condition"
    energy: Expr
    coordinate: Symbol
    place: Expr
    condition: Relation
    border: Relation | None
    stable_there: bool | None

    def lifted(self, values: Mapping[Any, Any]) -> Expr:
        """Return the rise of the energy close to the equilibrium, on the side where the rise is smaller."""
        q, energy = self.coordinate, self.energy.xreplace(values)
        place = self.place.xreplace(values)
        at = {s: value_at(energy, {q: place + s * NEAR}) for s in (1, -1)}
        return min(each - value_at(energy, {q: place + NEAR**8}) for each in at.values())
