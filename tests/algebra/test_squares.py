"""Squares as they are read."""

from __future__ import annotations

import pytest
from sympy import Expr, cos, symbols

from derive.algebra.squares import differences_of_squares, with_squares

a, b, I, M, R = symbols("a b I M R", positive=True)
phi = symbols("phi", real=True)


@pytest.mark.parametrize(
    ("product", "expected"),
    [
        (M * a * (a + b) * (a - b), M * a * (a**2 - b**2)),
        ((b - a) * (a + b), b**2 - a**2),
        ((a + b) * (a - R), (a + b) * (a - R)),
        ((a + 2 * b) * (a - 2 * b), (a + 2 * b) * (a - 2 * b)),
        (a + b, a + b),
    ],
)
def test_a_sum_times_a_difference(product: Expr, expected: Expr) -> None:
    found = differences_of_squares(product)
    assert str(found) == str(expected)
    assert (found - product).expand() == 0


def test_a_square_among_the_terms_of_a_sum() -> None:
    value = I + M * R**2 - 2 * M * R * a + M * a**2
    assert with_squares(value) == I + M * (R - a) ** 2
    assert with_squares(value).is_positive


def test_other_sums_stay() -> None:
    for value in (I + M * R**2, I + M * R**2 + M * a**2 - 2 * M * R * a * cos(phi), M * R**2 + M * a * R + M * a**2):
        assert with_squares(value) == value
