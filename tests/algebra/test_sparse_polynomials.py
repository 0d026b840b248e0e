"""Sums of monomials as whole numbers: what is added, multiplied and counted."""

from __future__ import annotations

import pytest
from sympy import Expr, Integer, Symbol, sin, sqrt, symbols

from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.sparse_polynomials import FARTHEST, Form, Outside, Ring

a, b = symbols("a b", positive=True)


def at(ring: Ring, **powers: int) -> int:
    return sum(n << ring.place(Symbol(name, positive=True)) for name, n in powers.items())


def test_a_form_has_whole_numbers_over_one() -> None:
    ring = Ring()
    found = ring.form(a**2 / 2 + 2 * a * b / 3 - 1)
    assert found.below == 6
    assert found.terms == {at(ring, a=2): 3, at(ring, a=1, b=1): 4, 0: -6}


def test_what_cancels_leaves_no_term() -> None:
    ring = Ring()
    assert ring.form((a + b) * (a - b) - a**2 + b**2).terms == {}
    assert ring.difference(ring.form(a + b), ring.form(b + a)).terms == {}
    assert ring.product(ring.form(a + b), Form({})).terms == {}


def test_a_factor_i_twice_is_minus_one() -> None:
    ring, i = Ring(), Form({1: 1})
    assert ring.product(i, i).terms == {0: -1}
    assert ring.power(i, 3).terms == {1: -1}
    assert ring.power(ring.sum([i, Form({0: 1})]), 2).terms == {1: 2}


def test_the_work_of_an_expression_is_counted_whatever_is_known() -> None:
    ring, value = Ring(), (a + b) ** 4 + a * b
    first = ring.form(value).cost
    ring.forms.pop(value)
    assert ring.form(value).cost == first > 0


@pytest.mark.parametrize(
    "value",
    [
        sqrt(a),
        sin(a),
        1 / a,
        PLUS_MINUS,
        a**b,
        Symbol("x", commutative=False),
        (a + b) ** 61,
        ((a + b) ** 50 + 1) ** 50,
        a ** (FARTHEST + 1),
        ((a**1000) ** 1000 * b) ** 10,
    ],
)
def test_what_is_no_such_sum_or_too_large_is_refused(value: Expr) -> None:
    with pytest.raises(Outside):
        Ring().form(value)


def test_a_high_power_of_a_letter_is_one_term() -> None:
    ring = Ring()
    assert ring.form(a**500).terms == {at(ring, a=500): 1}
    assert ring.form(Integer(0)).terms == {}


def test_a_table_with_many_letters_is_full() -> None:
    ring = Ring()
    assert not ring.is_full
    for letter in symbols("x_1:400"):
        ring.form(letter)
    assert ring.is_full
