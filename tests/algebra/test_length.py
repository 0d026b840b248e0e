"""The length of an expression is what SymPy counts, and of forms of one length always the same is taken."""

from __future__ import annotations

import pytest
from hypothesis import given
from sympy import Add, E, Expr, Function, I, Integer, Mul, Rational, cos, exp, pi, sin, sqrt, symbols

from derive.algebra.length import length, shortest
from tests.algebra.test_tidy import bounded, expressions

a, b, x, y, n = symbols("a b x y n", real=True)

VALUES = [
    Integer(1),
    Integer(-3),
    Rational(-2, 3),
    -x,
    3 / x,
    -3 / x,
    1 / (a + b),
    (a - b) / 2,
    -(a - b) / (2 * x),
    -a - b,
    a - b + x,
    Mul(2, a + b, evaluate=False),
    Mul(-1, a + b, evaluate=False) + x,
    a / (2 * (a + b)),
    2 * (a + b) / x,
    x**-2 * y**3 / sqrt(a),
    a**-n * b**n,
    sin(2 * x + pi) ** 2 * E,
    exp(-2 * x),
    Function("f")(x, y) * I,
    sqrt(2) * (1 - cos(x)) / 4,
]


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_it_is_the_count_of_operations(value: Expr) -> None:
    assert length(value) == int(value.count_ops())


@bounded
@given(expressions)
def test_it_is_so_of_any_expression(value: Expr) -> None:
    assert length(value) == int(value.count_ops())


def test_of_forms_of_one_length_the_first_by_its_text_is_taken() -> None:
    forms = [a + b, Add(x, y), x * y + 1]
    assert shortest(forms) == shortest(forms[::-1]) == a + b
