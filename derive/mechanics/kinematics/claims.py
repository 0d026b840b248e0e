"""Predicates of kinematics: each decides whether an outcome, or a fact in the sentence of an outcome, is correct."""

from __future__ import annotations

from sympy import Symbol

from derive.algebra.expressions import Partial, rate
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.steps.rule import Judged, handed_on_by


def of_its_coordinate(facts: Judged, fact: OfCoordinate) -> bool:
    """Whether the fact names the coordinate of the result."""
    q, symbol = fact.coordinate.symbol, facts.symbol
    if isinstance(symbol, Partial):
        return symbol.args[1] in (q, rate(q))
    if isinstance(symbol, Symbol) and symbol.name.endswith("_ddot"):
        return bool(symbol == rate(q, 2))
    return bool(facts.inputs.get("coordinate", q) == q)


handed_on_by(OfCoordinate, of_its_coordinate)
