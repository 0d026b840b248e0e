"""Tests of products: the order of factors, and the marks between them."""

from __future__ import annotations

import pytest
from sympy import Expr, Integer, Matrix, Mul, Rational, Symbol, cos, pi, sin, sqrt, symbols, tan

from derive.algebra.dimensions import NUMBER
from derive.algebra.expressions import Root, explicit
from derive.algebra.kinds import dimension_of_kind
from derive.render.notation.layout import Applied, Digits, Fenced, Fraction, Layout, Name, Operator, Raised, Row
from derive.render.notation.notation import Notation
from derive.render.notation.products import (
    between_factors,
    decimal,
    higher_roots_together,
    number_and_letters,
    positive_first,
    powers_together,
    present,
    rank_of_dimension,
    root_cancelled,
    roots_together,
    rounded_number,
    side_by_side,
    under_one_root,
    with_content_apart,
)
from derive.render.notation.text import plain

a, b, M, g = symbols("a b M g", positive=True)
A, B, TWO = Name("a"), Name("b"), Digits("2")


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Rational(3, 2), "1.5"),
        (Rational(-1, 8), "-0.125"),
        (Integer(12), "12"),
        (Rational(1, 3), "1/3"),
        (Rational(-7, 6), "-7/6"),
        (Integer(0), "0"),
    ],
)
def test_a_number_is_decimal_where_it_can_be(number: Rational, text: str) -> None:
    assert plain(decimal(number)) == text


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Rational(2657, 10**29), "2.657×10⁻²⁶"),
        (Rational(-1, 10**5), "-1×10⁻⁵"),
        (Rational(1, 10**4), "0.0001"),
        (Rational(2 * 10**30), "2×10³⁰"),
        (Rational(5974, 1) * 10**21, "5.974×10²⁴"),
        (Rational(299792458), "299792458"),
        (Rational(384400), "384400"),
        (Rational(0), "0"),
    ],
)
def test_what_is_very_small_or_large_and_round_has_its_power_of_ten(number: Rational, text: str) -> None:
    assert plain(decimal(number)) == text


def test_below_the_root_of_a_fraction_goes_what_it_is_divided_by() -> None:
    """A rod that swings about a point at the distance x from its middle: 2 pi sqrt((l^2 + 12 x^2)/(12 g x)). Source:
    Morin, section 8.4."""
    a, g, x = symbols("a g x", positive=True)
    assert plain(Notation().layout(pi * sqrt(3) * sqrt(a**2 + 12 * x**2) / (3 * sqrt(g * x)))) == (
        "π √((a² + 12x²)/(3g x))"
    )
    assert plain(Notation().layout(2 * pi / 3 * sqrt(6 * a / g))) == "2π √(2a/(3g))"


def test_a_common_factor_stands_before_a_vector_and_changes_nothing() -> None:
    vector = Matrix([2 * a * M, 4 * a * M, 0])
    shown = present(vector)
    assert shown != vector
    assert explicit(shown) == explicit(vector)
    for plain_one in (Matrix([a, b, 0]), Matrix([0, 0, 0]), a * M):
        assert present(plain_one) == plain_one


@pytest.mark.parametrize(
    ("above", "below", "shown"),
    [
        ([sqrt(14)], [Integer(14)], ([], [sqrt(14)])),
        ([sqrt(14)], [Integer(7)], ([2], [sqrt(14)])),
        ([sqrt(14), a], [Integer(168)], ([a], [12, sqrt(14)])),
        ([sqrt(42)], [Integer(28)], ([sqrt(42)], [28])),
        ([a], [Integer(14)], ([a], [14])),
        ([sqrt(14)], [a], ([sqrt(14)], [a])),
    ],
)
def test_a_root_is_cancelled_where_that_is_shorter(above: list, below: list, shown: tuple) -> None:
    assert root_cancelled(above, below) == shown


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (7 * sqrt(2779) / 397, "7√(7/397)"),
        (2 * sqrt(30) / 15, "2√(2/15)"),
        (-sqrt(6) / 3, "-√(2/3)"),
        (sqrt(42) / 28, "√42/28"),
        (sqrt(10) / 4, "√10/4"),
        (sqrt(3) / 2, "√3/2"),
        (sqrt(2) / 2, "1/√2"),
        (5 * sqrt(3) / 6, "5/(2√3)"),
        (sqrt(6), "√6"),
    ],
)
def test_a_root_of_a_fraction_is_written_where_it_is_shorter(number: Expr, text: str) -> None:
    assert plain(Notation().layout(number)) == text
    factors = under_one_root(number)
    assert not factors or explicit(Mul(*factors)) == abs(number)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (a / 2, "a/2"),
        (a * sin(b) / 2, "a/2 sin b"),
        (M * a / 2, "1/2 M a"),
        (a**2 / 2, "1/2 a²"),
        (3 * a / 2, "3/2 a"),
        (Symbol("x_dot") / 2, "1/2 x\u0307"),
    ],
)
def test_a_letter_that_is_halved_is_a_fraction(value: Expr, text: str) -> None:
    assert plain(Notation().layout(value)) == text


def test_an_acceleration_that_is_halved_is_a_factor_before_a_function() -> None:
    known = Notation({g: dimension_of_kind("acceleration")})
    assert [plain(known.layout(value)) for value in (g / 2, g * sin(b) / 2)] == ["g/2", "1/2 g sin b"]


def test_numbers_are_one_fraction_and_roots_behind_it() -> None:
    assert number_and_letters(13 * sqrt(14) * pi * a / 12) == ([Rational(13, 12), pi, sqrt(14)], [a])
    assert number_and_letters(a) == ([], [a])
    assert with_content_apart(12 * a + 12 * b) == (12, a + b)
    assert with_content_apart(a / 2 + b) == (a / 2 + b,)


def test_roots_of_letters_are_one_root_and_keep_their_value() -> None:
    expr = sqrt(M) * sqrt(g) / sqrt(a + b)
    together = roots_together(expr)
    assert together != expr
    assert (explicit(together) / expr).simplify() == 1


def test_a_positive_term_leads() -> None:
    assert positive_first([-(a**2), b**2]) == [b**2, -(a**2)]
    assert positive_first([-a, -b]) == [-a, -b]
    assert positive_first([]) == []


def test_what_divides_a_root_goes_under_it_where_that_cancels() -> None:
    assert str(roots_together(2 * pi / 3 * sqrt(6) * sqrt(a) / sqrt(g))) == str(2 * pi * Root(2 * a / (3 * g)))
    assert roots_together(sqrt(a + b) * sqrt(2) / 2) == Root(Mul(2, a + b, evaluate=False)) / 2
    assert roots_together(a ** Rational(3, 2) * sqrt(g)) == a * Root(a * g), "not a^(3/2) sqrt(g)"


def test_masses_stand_before_accelerations_lengths_numbers_and_rates() -> None:
    kinds = ["mass", "moment of inertia", "density", "acceleration", "length", "speed", "angular speed"]
    ranks = [rank_of_dimension(dimension_of_kind(kind)) for kind in kinds]
    assert ranks == sorted(ranks)
    assert ranks[0] == ranks[1] == ranks[2] < ranks[3]
    assert rank_of_dimension(None) == rank_of_dimension(NUMBER)


@pytest.mark.parametrize(
    ("items", "text"),
    [
        ([TWO, A], "2a"),
        ([A, TWO], "a·2"),
        ([Applied("cos", A), B], "cos a·b"),
        ([Applied("cos", Fenced(A)), B], "cos(a) b"),
        ([Fenced(A), Fenced(B)], "(a) (b)"),
    ],
)
def test_a_dot_stands_where_factors_would_run_together(items: list[Layout], text: str) -> None:
    assert plain(side_by_side(items)) == text


@pytest.mark.parametrize(
    ("before", "after", "mark"),
    [
        (A, B, None),
        (A, A, Operator("dot")),
        (A, TWO, Operator("dot")),
        (TWO, A, Operator("space")),
        (A, Fenced(B), Operator("space")),
        (A, Applied("sin", B), Operator("space")),
        (Raised(A, TWO), B, None),
        (Fraction(A, TWO), B, Operator("dot")),
        (Row((A, Name("d"))), Name("L", style="vector"), Operator("space")),
        (Row((Fraction(Digits("1"), Digits("2")), A)), B, None),
        (Row((A, B)), B, Operator("dot")),
    ],
)
def test_what_stands_between_two_factors_as_they_are_written(
    before: Layout, after: Layout, mark: Operator | None
) -> None:
    assert between_factors(before, after) == mark


def test_cube_roots_of_letters_are_one_root_and_keep_their_value() -> None:
    J, M, g = symbols("J M g", positive=True)
    value = J ** Rational(2, 3) / (M ** Rational(1, 3) * g ** Rational(1, 3))
    found = higher_roots_together(value)
    assert plain(Notation().layout(value)) == "(J²/(M g))^(1/3)"
    assert explicit(found).equals(value)
    assert higher_roots_together(sqrt(M) * sqrt(g)) == sqrt(M) * sqrt(g)
    assert plain(Notation().layout(2 * M ** Rational(2, 3))) == "2M^(2/3)", "one root keeps its exponent"


def test_powers_of_a_letter_with_a_letter_stand_together() -> None:
    n = symbols("n", real=True)
    assert powers_together(Mul(a**n, 1 / a, b, evaluate=False)) == a ** (n - 1) * b
    assert powers_together(a**2 * b**n / g) == a**2 * b**n / g
    assert roots_together(1 / sqrt(a) / sqrt(g)) == 1 / Root(Mul(a, g, evaluate=False))


@pytest.mark.parametrize(("text", "shown"), [("-1.50", "-1.50"), ("2.66e-26", "2.66×10⁻²⁶"), ("3e4", "3×10⁴")])
def test_the_digits_that_were_kept_are_shown(text: str, shown: str) -> None:
    assert plain(rounded_number(text)) == shown


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (2 * sin(a) / cos(a), 2 * tan(a)),
        (g * (1 + M * sin(a) ** 2 / cos(a) ** 2), g * (1 + M * tan(a) ** 2)),
        (sqrt(g * sin(a) / (b * cos(a))), sqrt(g * tan(a) / b)),
        (M * cos(a) / sin(a), M * cos(a) / sin(a)),
        (sin(a) ** 2 / cos(a), sin(a) ** 2 / cos(a)),
        (sin(a) / cos(b), sin(a) / cos(b)),
    ],
)
def test_a_result_has_a_tangent_for_a_quotient_of_sine_and_cosine(value: Expr, shown: Expr) -> None:
    assert present(value) == shown
