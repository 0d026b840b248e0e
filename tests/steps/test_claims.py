"""Predicates of signs: what vanishes only where two symbols are equal is met by no trial number, and is still seen."""

from __future__ import annotations

import pytest
from sympy import Expr, symbols

from derive.algebra.expressions import Relation, scalar
from derive.steps.claims import has_sign, is_negative, may_be_zero, not_negative, same_equation, says_what_it_divides_by
from derive.steps.rule import Judged
from derive.steps.trial_numbers import sign_found

k, m = symbols("k m", positive=True)
u, v = scalar("u"), scalar("v")
ZERO_SOMEWHERE = ((k - m) ** 2, (k - 3 * m) ** 2 * (k + m), u**2 + v**2)


@pytest.mark.parametrize("value", ZERO_SOMEWHERE)
def test_a_value_that_vanishes_where_symbols_are_equal_has_no_sign(value: Expr) -> None:
    assert sign_found(value) == 1
    assert not has_sign(value, 1)
    assert may_be_zero(value)
    assert not same_equation(value * k, k)


@pytest.mark.parametrize("value", ZERO_SOMEWHERE[:2])
def test_a_divisor_that_vanishes_where_symbols_are_equal_must_be_excluded(value: Expr) -> None:
    assert not says_what_it_divides_by(Judged(1 / value), "generic")
    assert says_what_it_divides_by(Judged(1 / value, {"excluded": Relation(value, "!=", 0)}), "generic")
    assert says_what_it_divides_by(Judged(1 / (k + m)), "generic")


def test_a_sign_that_symbols_and_trial_numbers_show() -> None:
    assert has_sign(k + m, 1) and has_sign(-k, -1) and has_sign(k - m, None)
    assert not has_sign(k + m, -1) and not has_sign(k - m, 1) and not has_sign(k, None)
    assert is_negative(-k * m) and not is_negative(k - m)
    assert not_negative(Judged(k), "") and not not_negative(Judged(-k), "")
