"""What a quantity says of a state of the system, for the verbs and for the witness alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from derive.algebra.expressions import Relation
from derive.steps.step import Fact


@dataclass(frozen=True)
class Rest(Fact):
    """A state of rest: the values of the coordinates, and where it exists; a coordinate left out may have any value."""

    missing = "is not a state of rest"
    values: Mapping[Symbol, Expr]
    exists: Relation | None = None


@dataclass(frozen=True)
class Around(Fact):
    """That an equation is one to first order about a place: the values of the coordinates there.

    displaced   letter of a displacement -> the coordinate that it is a displacement of
    """

    missing = "is not an equation to first order about a place"
    values: Mapping[Symbol, Expr]
    exists: Relation | None = None
    displaced: Mapping[Symbol, Symbol] = field(default_factory=dict)
