"""What must be true of a result for its outcome to be right, and of what its sentence names."""

from __future__ import annotations

from sympy import Symbol

from derive.algebra.expressions import Partial, rate
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.steps.rule import Judged, handed_on_by


def of_its_coordinate(facts: Judged, fact: OfCoordinate) -> bool:
    """It is the one by which the left side is a derivative, or which the sentence names."""
    q, symbol = fact.coordinate.symbol, facts.symbol
    if isinstance(symbol, Partial):
        return symbol.args[1] in (q, rate(q))
    if isinstance(symbol, Symbol) and symbol.name.endswith("_ddot"):
        return bool(symbol == rate(q, 2))
    return bool(facts.inputs.get("coordinate", q) == q)


handed_on_by(OfCoordinate, of_its_coordinate)
