"""What `limit:` asks for: the limiting case of a value, or what is left of an equation."""

from __future__ import annotations

from typing import Any

from sympy import Expr

from derive.algebra.expressions import Relation
from derive.errors import Complaint, Rejected
from derive.mechanics import equation_in_limit, limiting_case
from derive.steps.step import Quantity


def in_limit(of: Quantity, letter: Expr, symbol: str | None = None, **given: Any) -> Quantity:
    """By the verb that is about values, or by that about equations, which have no letter of their own."""
    if not isinstance(of.value, Relation):
        return limiting_case(of, letter, symbol=symbol, **given)
    if symbol is not None:
        raise Rejected(Complaint("wrong-argument", f"`{of.key}` is an equation, which has no letter of its own"))
    return equation_in_limit(of, letter, **given)
