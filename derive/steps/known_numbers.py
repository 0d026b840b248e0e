"""The numbers that a problem gives for its symbols. A derivation stays symbolic: the numbers decide between cases, test
statements and set the proportions of drawings."""

from __future__ import annotations

from typing import Any

from sympy import Expr

from derive.algebra.expressions import bound, explicit
from derive.steps.record import current_run, question


@question
def with_numbers(expr: Expr) -> Expr:
    """Substitute the numbers that the problem gives for symbols of the expression."""
    run = current_run.get()
    return explicit(bound(explicit(expr), run.numbers if run else {}))


def have_numbers(*values: Any) -> bool:
    """Whether the problem gives a number for each symbol of these vectors."""
    return not any(with_numbers(entry).free_symbols for value in values for entry in value)
