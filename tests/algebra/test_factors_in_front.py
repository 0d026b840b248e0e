"""Common factors in front and one line under a sum of fractions: as SymPy has them, and no value changes."""

from __future__ import annotations

import pytest
from hypothesis import given
from sympy import Expr, Integer, Rational, Symbol, cos, factor_terms, sin, sqrt, symbols, together

from derive.algebra.equality import equal
from derive.algebra.factors_in_front import in_front, product_of
from tests.algebra.test_tidy import bounded, expressions

a, b, c = symbols("a b c", positive=True)
x, y, p, n = symbols("x y p n", real=True)

VALUES = [
    a * b - a * c,
    2 * a + 2 * b,
    -2 * a - 4 * b,
    a / 2 + b / 3,
    -a / 2 - b / 3,
    3 * a * b / 2 + 3 * a * c / 2,
    -a * b - a * c,
    a**2 * x - a * x**2,
    a * sin(p) - b * sin(p),
    Integer(0),
    Rational(3, 4) * a,
    a / x + b / x**2,
    (a + b) * x + (a + b) * y,
    a / (a + b) + b / (a + b) ** 2,
    x * (2 * a + 4 * b) / 6 - x,
    1 / (1 / a + 1 / b),
    sqrt(a) * x + a ** Rational(3, 2) * y,
    sqrt(a / b + b / a),
    2 * (a + b) * x + x,
    a / (x - y),
    (x - y) ** 2 / 4,
]


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_factors_in_front_stand_in_front_as_sympy_puts_them(value: Expr) -> None:
    numerator, denominator = together(value).as_numer_denom()
    assert in_front(value) == factor_terms(numerator) / factor_terms(denominator)


@bounded
@given(expressions)
def test_no_value_changes_and_what_is_in_front_stays_there(value: Expr) -> None:
    found = in_front(value)
    assert equal(found, value)
    assert in_front(found) == found


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (a / (x**2 - x - 1), -a / (-(x**2) + x + 1)),  # the terms with a plus are in the majority
        ((x - y) / (x - a - b), (y - x) / (a + b - x)),
        (cos(p + b * p / a), cos(p * (a + b) / a)),
        (cos(2 * p + 2 * x), cos(2 * p + 2 * x)),
        ((a / b) ** n / a ** (n - 1), a ** (1 - n) * a**n / b**n),
        (x * (y + 1) - 2 * (a + b) * x + 2 * a * x + 2 * b * x, x * (y + 1)),
    ],
    ids=str,
)
def test_signs_angles_and_powers(value: Expr, expected: Expr) -> None:
    assert in_front(value) == expected


def test_a_product_is_a_number_and_powers() -> None:
    assert product_of(Rational(13, 24) * x + Rational(10, 24) * y) == (Rational(1, 24), {13 * x + 10 * y: 1})
    assert product_of(a**2 / (b * c) / 2) == (Rational(1, 2), {a: 2, b: -1, c: -1})


def test_one_over_what_is_seen_to_vanish_is_left_alone() -> None:
    held = Symbol("u") * (2 * (a + b) * x - 2 * a * x - 2 * b * x) ** -1
    assert in_front(held) == held
