"""Facts about results, in addition to their values, for later steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sympy import Expr, Symbol

from derive.steps.step import Fact, Quantity


@dataclass(frozen=True)
class Steady(Fact):
    """A steady motion: constant values of coordinates, constant rates of cyclic coordinates, and the conditions."""

    missing = "is not the condition of a steady motion, as `steady_motion` yields it"
    lagrangian: Quantity
    values: Mapping[Symbol, Expr]
    rates: Mapping[Symbol, Expr]
    conditions: tuple[Expr, ...]


@dataclass(frozen=True)
class ByEnergy(Fact):
    """The start of a motion of one coordinate, and the acceleration from the equation of motion."""

    missing = "is not the square of a rate from conservation of energy"
    coordinate: Symbol
    start: Expr
    start_rate: Expr
    acceleration: Expr
