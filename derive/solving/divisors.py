"""Conditions under which the divisors of a result do not vanish; a sentence of the page states these conditions."""

from __future__ import annotations

from collections.abc import Iterable

from sympy import Expr, Integer, Mul, lcm

from derive.algebra.expressions import Relation
from derive.algebra.lowest_terms import factored
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.solving.relations import positive
from derive.steps.signs import sign_known
from derive.steps.step import is_zero


def may_vanish(*values: Expr) -> Relation | None:
    """The condition that none of these values vanishes; it contains only the factors that may vanish. None if there are
    no such factors."""
    factors = [f.as_base_exp()[0] for value in values for f in Mul.make_args(factored(tidied(value)))]
    unsure = [f for f in dict.fromkeys(factors) if sign_known(f) is None and not f.is_nonzero]
    return Relation(Mul(*unsure), "!=", Integer(0)) if unsure else None


def told_of_divisors(values: Iterable[Expr]) -> dict[str, tuple[Relation, Relation]]:
    """The condition that no denominator vanishes, as data for a sentence; it contains only the factors that may vanish.

    The result is empty if there are no such factors.
    """
    below: Expr = Integer(1)
    for value in values:
        below = lcm(below, tidied(value).as_numer_denom()[1])
    excluded = may_vanish(below) if below.free_symbols else None
    return {} if excluded is None else {"excluded": (excluded, Relation(excluded.right, "!=", excluded.left))}


def different_from_zero(value: Expr) -> Relation | None:
    """The condition that a divisor does not vanish, omega^2 != k/m; None if the sign of the divisor is known."""
    if sign_known(value) is not None:
        return None
    condition = positive(tidied(value).as_numer_denom()[0])
    return Relation(condition.left, "!=", condition.right)


def check_no_resonance(stiffness: Expr) -> None:
    """Reject a driving frequency w for which c - a w^2 vanishes with the given numbers: this is resonance."""
    if not is_zero(stiffness) and sign_known(stiffness) == 0:
        message = f"with the given numbers {stiffness} vanishes: this motion is at resonance"
        help_line = "write the driving frequency in symbols, such as `sqrt(k/m)`"
        raise Rejected(Complaint("resonance", message, help=help_line))
