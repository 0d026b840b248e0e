"""Facts that results hand on besides their value, for the steps that rest on them."""

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
from derive.algebra.ranges import strict_sign_within
from derive.algebra.samples import value_at
from derive.mechanics.hamilton.facts import SeenWith
from derive.mechanics.model.dalembert import Matter
from derive.steps.step import Fact, Quantity

NEAR = Rational(1, 1000)  # to a place


@dataclass(frozen=True)
class RestOf(Fact):
    """The potential energy that a state of rest belongs to, and the coordinates that it was sought in."""

    missing = "is not a state of rest that was found"
    potential: Quantity
    coordinates: tuple[Symbol, ...]


def matter_behind(potential: Quantity) -> Matter | None:
    """What made a potential energy: mass points and forces, or of an effective one those with momenta held constant."""
    seen, own = potential.fact(SeenWith), potential.fact(Matter)
    return seen.matter if seen is not None else own if own is not None and own.is_known else None


@dataclass(frozen=True)
class DerivativeOf(Fact):
    """The potential energy that a slope or curvature is one of, and the coordinate that it was differentiated by."""

    missing = "is not the derivative of a potential energy"
    potential: Quantity
    coordinate: Symbol


@dataclass(frozen=True)
class LowestOrder(Fact):
    """The first order of a potential energy that does not vanish, and its coefficient; (0, 0) if none was found."""

    missing = "is not a potential energy to its lowest order"
    order: int
    coefficient: Expr

    @property
    def is_minimum(self) -> bool:
        return self.order % 2 == 0 and strict_sign_within(self.coefficient) == 1


@dataclass(frozen=True)
class Shape(Fact):
    """The potential energy of which this is the curvature, the place, and a letter with its value on the border."""

    missing = "is not the curvature at a state of rest"
    potential: Quantity
    coordinate: Symbol
    place: Expr
    border: Relation | None


@dataclass(frozen=True)
class StableWhere(Fact):
    """Of one coordinate: the potential energy, the place, the condition, and the letter at its border where a higher
    order decides, with what it decides."""

    missing = "does not depend on a condition, as `stability` may"
    energy: Expr
    coordinate: Symbol
    place: Expr
    condition: Relation
    border: Relation | None
    stable_there: bool | None

    def lifted(self, values: Mapping[Any, Any]) -> Expr:
        """By how much the energy a little beside the place is greater, on the side where that is less."""
        q, energy = self.coordinate, self.energy.xreplace(values)
        place = self.place.xreplace(values)
        at = {s: value_at(energy, {q: place + s * NEAR}) for s in (1, -1)}
        return min(each - value_at(energy, {q: place + NEAR**8}) for each in at.values())
