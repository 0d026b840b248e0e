"""Partial derivatives, in the form that SymPy gives them."""

from __future__ import annotations

import pytest
from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, exp, log, sin, sqrt, symbols

from derive.algebra.derivatives import derivative
from derive.algebra.normal_form import vanishes

a, b = symbols("a b", positive=True)
q, p = symbols("q p", real=True)

VALUES = [
    q,
    a,
    Integer(3),
    a * q**2 / 2 + b * q,
    a * (1 - cos(q - p)) ** 2 * q,
    sin(q) * cos(q) * p / (a + b * sin(q)),
    sin(a * q**2) ** 3,
    1 / q**2,
    (a + q) ** -1,
    sqrt(a**2 + q**2) * q,
    exp(-a * q) * log(q**2 + 1),
    a**q,
    cos(cos(q)),
    3 * (a + q) * sin(q) * (b - q * p),
    -(a + q - 2) * cos(q - p) * sin(p),
]


@pytest.mark.parametrize("value", VALUES, ids=str)
@pytest.mark.parametrize("letter", [q, p])
def test_the_derivative_is_that_of_sympy(value: Expr, letter: Symbol) -> None:
    assert derivative(value, letter) == diff(value, letter)


def test_the_derivative_of_a_distance_along_a_line_is_its_direction() -> None:
    way = a - q
    assert vanishes(derivative(abs(way), q) + way / abs(way))
    assert vanishes(derivative(sqrt(abs(way)), q) + way / (2 * abs(way) ** Rational(3, 2)))
    assert derivative((abs(way) - b) ** 2, q, 2).subs(q, 3 * a).simplify() == 2


@pytest.mark.parametrize("value", VALUES, ids=str)
@pytest.mark.parametrize("by", [(q, 2), (q, p), (q, 0), (p, 2, q)], ids=str)
def test_a_number_says_how_often_one_differentiates_by_the_letter_before_it(
    value: Expr, by: tuple[Symbol | int]
) -> None:
    assert (derivative(value, *by) - diff(value, *by)).equals(0)


def test_a_matrix_is_differentiated_entry_by_entry() -> None:
    matrix = ImmutableDenseMatrix([[q**2, sin(q)], [p, a]])
    assert derivative(matrix, q) == ImmutableDenseMatrix([[2 * q, cos(q)], [0, 0]])
