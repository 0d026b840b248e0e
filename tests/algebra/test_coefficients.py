"""What stands before products of powers: as SymPy has it."""

from __future__ import annotations

from random import Random

import pytest
from sympy import Add, Expr, Integer, Mul, Rational, Symbol, cos, expand, sin, sqrt, symbols

from derive.algebra.coefficients import Expanded, Outside, coefficients, is_multiplied_out
from derive.algebra.normal_form import vanishes

a, b, c = symbols("a b c", positive=True)
x, y, p, q = symbols("x y p q", real=True)

VALUES = [
    (a * x + b * y) ** 2 / 2 + c * x,
    a * (b + 1) * x**2 * y - (a - b) ** 2 * y / 3 + Rational(1, 7),
    (a + b) * (cos(p) * cos(q) + sin(p) * sin(q)) * x * y + b * sin(p - q) * x,
    (x * cos(p)) ** 2 + (x * sin(p)) ** 2,
    c,
    x + y - y,
]


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_coefficients_are_those_of_the_polynomial_in_its_order(value: Expr) -> None:
    expected = value.expand().as_poly(x, y).terms()
    found = coefficients(value, (x, y))
    assert [powers for powers, _ in found] == [powers for powers, _ in expected]
    for (_, coefficient), (_, other) in zip(found, expected, strict=True):
        assert vanishes(coefficient.whole() - other)
        assert coefficient.terms == len(other.expand().as_ordered_terms())


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_a_coefficient_in_two_factors_is_their_product(value: Expr) -> None:
    for _, coefficient in coefficients(value, (x, y)):
        if coefficient.written:
            letters = coefficient.written(Integer(3), Integer(1)).value
            assert not letters.has(sin, cos)
            assert vanishes(letters * coefficient.angles - 3 * coefficient.whole())
            assert vanishes(coefficient.written(Integer(1), a).value * coefficient.angles - a * coefficient.whole())


def test_angles_stand_apart_where_all_terms_share_them() -> None:
    ((_, shared),) = coefficients((a + b) * cos(p) * x + (a + b) * sin(q) * x, (x,))
    assert shared.written is not None
    assert {shared.angles, shared.written(Integer(1), Integer(1)).value} == {cos(p) + sin(q), a + b}
    ((_, mixed),) = coefficients(a * cos(p) * x + b * sin(q) * x, (x,))
    assert mixed.written is None


@pytest.mark.parametrize(
    ("value", "is_prime"),
    [
        ((a + b) * x, True),
        (3 * a * x, True),
        (a * (b - c) * x, True),
        ((a * b + a * c + b**2) * x, True),
        ((a**2 - b**2) * x, False),
        ((a**2 + 2 * a * b + b**2) * x, False),
        ((a / 2 + b / 3) * x, False),
    ],
    ids=str,
)
def test_a_sum_that_is_linear_in_a_letter_has_no_factors(value: Expr, is_prime: bool) -> None:
    ((_, coefficient),) = coefficients(value, (x,))
    assert coefficient.written is not None
    assert coefficient.written(Integer(1), Integer(1)).is_prime is is_prime


@pytest.mark.parametrize("value", [sqrt(a) * x, x / (a + b), x**-1, abs(x), sin(p / (a + b)) * x, cos(sqrt(a)) * x])
def test_what_is_no_polynomial_is_left_to_others(value: Expr) -> None:
    with pytest.raises(Outside):
        coefficients(value, (x,))


def test_sums_of_products_are_told_from_what_is_to_be_multiplied_out() -> None:
    assert is_multiplied_out(a**2 * sin(p) / 3 - b + 1)
    assert not any(map(is_multiplied_out, (a * (b + c), (a + b) ** 2, 1 / a, sqrt(a), sin(2 * p))))


def test_terms_are_put_together_as_sympy_itself_has_them() -> None:
    letters = [*symbols("x y z a_1 rho R_10 R_2", positive=True), Symbol("theta"), cos(Symbol("theta"))]
    drawn = Random(2026)
    for _ in range(150):
        factors = [drawn.choice(letters) ** drawn.randint(0, 3) for _ in range(12)]
        parts = [
            Mul(*drawn.sample(factors, 3)) * Rational(drawn.randint(-6, 6), drawn.choice([1, 2, 3])) for _ in range(5)
        ]
        ring, value = Expanded(), expand(Add(*parts))
        form = ring.form(value)
        found = ring.expression(form.terms, form.below)
        assert (found, found.func, found.args) == (value, value.func, value.args)
