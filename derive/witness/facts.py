"""Facts about the equilibrium to which a quantity belongs, for verbs and for the witness."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from derive.algebra.expressions import Relation
from derive.steps.step import Fact


@dataclass(frozen=True)
class Rest(Fact):
    """An equilibrium: the values of the coordinates, and the condition under which it exists."""

    missing = "is not an equilibrium"
    values: Mapping[Symbol, Expr]
    exists: Relation | None = None


@dataclass(frozen=True)
class Around(Fact):
    """The equilibrium about which an equation holds to first order.

    exists      the condition under which the equilibrium exists
    displaced   symbol of a displacement -> the displaced coordinate
    """

    missing = "is not an equation to first order about an equilibrium"
    values: Mapping[Symbol, Expr]
    exists: Relation | None = None
    displaced: Mapping[Symbol, Symbol] = field(default_factory=dict)
