"""Numbers are rounded once, from the exact value, and every figure that is printed counts."""

from __future__ import annotations

from decimal import Decimal
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sympy import Integer, Matrix, Rational, acos, cos, pi, sqrt, symbols

from derive.algebra.expressions import Amount, Factors, MatrixAmount, scaled
from derive.algebra.rounding import Rounded, decimal_text, off_by_more_than_half_a_unit, rounded, rounded_form

a = symbols("a", positive=True)


@pytest.mark.parametrize(
    ("exact", "figures", "text"),
    [
        (7 * sqrt(2779) / 397, 5, "0.92951"),
        (acos(7 * sqrt(2779) / 397) * 180 / pi, 4, "21.64"),
        (sqrt(42) / 28, 4, "0.2315"),
        (Rational(216, 10), 4, "21.60"),
        (Integer(1), 1, "1"),
        (Integer(1), 3, "1.00"),
        (pi, 15, "3.14159265358979"),
        (-Rational(1, 3), 3, "-0.333"),
        (Rational("9.9996"), 4, "10.00"),
        (Rational("99.95"), 3, "100"),
        (Integer(123456), 6, "123456"),
        (Integer(1234567), 4, "1.235e6"),
        (Integer(20000), 2, "2.0e4"),
        (Rational(65, 100000), 4, "6.500e-4"),
        (Rational("0.00001234"), 3, "1.23e-5"),
        (cos(1) * 10**-8, 3, "5.40e-9"),
        (Rational("2.5"), 1, "2"),
        (Rational("3.5"), 1, "4"),
        (Rational("0.2345"), 3, "0.234"),
        (Rational("0.2345") + Rational(1, 10**20), 3, "0.235"),
    ],
)
def test_a_number_is_printed_with_the_figures_that_were_asked_for(exact: Any, figures: int, text: str) -> None:
    assert decimal_text(rounded_form(exact, figures)) == text


def test_zero_has_no_figures() -> None:
    assert rounded_form(Integer(0), 4) == 0
    assert rounded_form(Matrix([0, a - a, pi]), 3)[:2] == [0, 0]


def test_entries_of_a_vector_are_rounded_each_to_its_own_figures() -> None:
    texts = [decimal_text(entry) for entry in rounded_form(Matrix([pi, 100 * pi, pi / 100]), 3)]
    assert texts == ["3.14", "314", "0.0314"]


def test_a_rounded_number_that_is_carried_out_is_a_rational() -> None:
    assert rounded_form(pi, 3).doit() == Rational(314, 100)


numbers = st.fractions(min_value=-(10**6), max_value=10**6, max_denominator=10**4).filter(bool)
figures_asked = st.integers(1, 12)
bounded = settings(max_examples=60, deadline=None, derandomize=True)


@bounded
@given(numbers, figures_asked)
def test_rounding_is_the_nearest_decimal_of_so_many_figures(number: Any, figures: int) -> None:
    exact = Rational(number.numerator, number.denominator)
    value = rounded(exact, figures)
    place = Decimal(f"{float(abs(exact)):e}").adjusted() - figures + 1
    assert abs(value - exact) <= Rational(10) ** place / 2
    assert rounded(value, figures) == value


@bounded
@given(numbers, figures_asked)
def test_the_printed_text_has_that_value_and_those_figures(number: Any, figures: int) -> None:
    shown = rounded_form(Rational(number.numerator, number.denominator), figures)
    text = decimal_text(shown)
    assert Rational(text) == shown.doit()
    digits = text.partition("e")[0].lstrip("-").replace(".", "").lstrip("0")
    assert len(digits) == figures


@bounded
@given(numbers, figures_asked)
def test_what_rounding_yields_passes_the_check_of_it(number: Any, figures: int) -> None:
    exact = Rational(number.numerator, number.denominator) * sqrt(2)
    assert off_by_more_than_half_a_unit(exact, rounded_form(exact, figures)) is None


@bounded
@given(numbers, st.integers(2, 12), st.sampled_from([1, -1]))
def test_a_last_figure_that_is_off_by_one_is_found(number: Any, figures: int, step: int) -> None:
    exact = Rational(number.numerator, number.denominator) * sqrt(2)
    right = rounded_form(exact, figures)
    unit = Rational(10) ** (Decimal(decimal_text(right)).adjusted() - figures + 1)
    assume(rounded(right.args[0] + step * unit, figures) == right.args[0] + step * unit)
    assert off_by_more_than_half_a_unit(exact, Rounded(right.args[0] + step * unit, Integer(figures))) is not None


def test_a_wrong_unit_is_found_by_its_factor() -> None:
    right = Amount(rounded_form(Rational(1, 3) / Rational(1, 100), 4), "cm", Rational(1, 100))
    wrong = Amount(rounded_form(Rational(1, 3), 4), "cm", Rational(1, 100))
    assert off_by_more_than_half_a_unit(Rational(1, 3), right) is None
    assert off_by_more_than_half_a_unit(Rational(1, 3), wrong) is not None


def test_each_entry_of_a_vector_is_checked() -> None:
    exact = Matrix([pi, sqrt(2), 0])
    right = rounded_form(exact, 4)
    wrong = Matrix([right[0], Rounded(Rational("1.415"), Integer(4)), 0])
    assert off_by_more_than_half_a_unit(exact, MatrixAmount(right, "N m", Integer(1))) is None
    assert off_by_more_than_half_a_unit(exact, MatrixAmount(wrong, "N m", Integer(1))) is not None


def test_a_rounded_number_before_letters_is_checked_against_the_exact_one() -> None:
    exact = sqrt(42) / 28 * a**2
    assert off_by_more_than_half_a_unit(exact, Factors(rounded_form(sqrt(42) / 28, 4), a**2)) is None
    assert off_by_more_than_half_a_unit(exact, Factors(rounded_form(sqrt(42) / 27, 4), a**2)) is not None


def test_a_vector_of_rounded_numbers_behind_letters_is_checked_entry_by_entry() -> None:
    exact = a**2 / 28 * Matrix([-5, 4, -1])
    right, wrong = (Matrix([Rational(-5, 28), x, Rational(-1, 28)]) for x in (Rational(1, 7), Rational(1, 8)))
    assert off_by_more_than_half_a_unit(exact, scaled(a**2, rounded_form(right, 4))) is None
    assert off_by_more_than_half_a_unit(exact, scaled(a**2, rounded_form(wrong, 4))) is not None


def test_a_number_without_figures_must_be_exact() -> None:
    assert off_by_more_than_half_a_unit(Rational(1, 4), Rational(1, 4)) is None
    assert off_by_more_than_half_a_unit(Rational(1, 4), Rational(1, 4) + Rational(1, 10**20)) is not None
