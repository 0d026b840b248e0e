"""Points and values: the same in every run, of all scales, and believed only where more digits confirm them."""

from __future__ import annotations

from itertools import islice

import pytest
from mpmath import mp
from sympy import (
    Expr,
    Function,
    I,
    Integer,
    Matrix,
    Rational,
    Sum,
    Symbol,
    atanh,
    cos,
    exp,
    log,
    pi,
    sin,
    sqrt,
    symbols,
    tan,
)

from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.samples import (
    NoNumber,
    Undefined,
    compared_at,
    generic_rank,
    is_zero_everywhere,
    letters_of,
    points,
    seed_of,
    shown,
    value_at,
)

a, b = symbols("a b", positive=True)
x = symbols("x", real=True)


def test_points_are_of_several_scales_and_of_both_signs() -> None:
    drawn = list(islice(points({x, a}, 7), 26))
    for letter, signs in ((x, {1, -1}), (a, {1})):
        values = [point[letter] for point in drawn]
        assert {1 if value > 0 else -1 for value in values} == signs
        assert min(map(abs, values)) < Rational(1, 10**12) and max(map(abs, values)) > 10**6
        assert all(Rational(1, 10) < abs(value) < 10 for value in values[:6])


def test_each_comparison_has_points_of_its_own_and_the_same_ones_in_every_run() -> None:
    assert seed_of(sin(x) / 3, x**2) == 3165798072
    assert seed_of(x**2, sin(x) / 3) != seed_of(sin(x) / 3, x**2)
    assert next(points({x}, 1)) == next(points({x}, 1)) != next(points({x}, 2))


def test_a_letter_is_drawn_within_what_is_assumed_of_it() -> None:
    even, odd = Symbol("m", even=True), Symbol("n", odd=True)
    negative, imaginary, free = Symbol("d", negative=True), Symbol("z", imaginary=True), Symbol("f")
    drawn = list(islice(points({even, odd, negative, imaginary, free, PLUS_MINUS}, 3), 30))
    assert {point[even] % 2 for point in drawn} == {0}
    assert {point[odd] % 2 for point in drawn} == {1}
    assert all(point[negative] < 0 for point in drawn)
    assert all(point[imaginary] / I == point[imaginary].as_real_imag()[1] != 0 for point in drawn)
    assert {point[PLUS_MINUS] for point in drawn} == {1, -1}
    assert {point[free].is_real for point in drawn} == {True, False}, "what may be complex is so in some points"


def test_bound_letters_are_not_varied_and_functions_of_time_are() -> None:
    t, n = symbols("t n")
    q = Function("q")(t)
    assert letters_of(Sum(n * x, (n, 0, a))) == {x, a}
    assert letters_of(q.diff(t) + a) == {t, q, q.diff(t), a}


def test_a_difference_is_seen_at_a_point_and_rounding_is_none() -> None:
    point = {x: Rational(1, 3)}
    assert compared_at(sin(x) ** 2 + cos(x) ** 2, Integer(1), point).agree
    assert compared_at(x, x + Rational(1, 10**80), point, thoroughly=True).agree is False
    assert not compared_at(x, x * (1 + Rational(1, 10**30)), point).agree


@pytest.mark.parametrize("expr", [1 / x, log(x), 1 / log(x), atanh(1 + x), tan(pi / 2 + x)])
def test_what_has_no_value_at_a_point_is_said_to_be_undefined(expr: Expr) -> None:
    with pytest.raises(Undefined):
        compared_at(expr, x, {x: Integer(0)})
    with pytest.raises(Undefined):
        value_at(expr, {x: Integer(0)})


def test_a_value_is_taken_in_digits_enough_however_much_cancels() -> None:
    small = Rational(1, 10**14)
    value = value_at(exp(x) - 1 - x, {x: small})
    assert abs(value / (small**2 / 2 * (1 + small / 3)) - 1) < Rational(1, 10**20)
    assert value_at(sin(x) ** 2 + cos(x) ** 2 - 1, {x: Rational(1, 3)}) == 0


def test_a_value_that_rounds_to_zero_in_few_digits_only_is_zero() -> None:
    y = Symbol("y")
    point = {x: Rational(47, 2100), y: Rational(-31, 2400)}
    assert value_at(x - x * (y + 1) + x * y, point) == 0
    assert value_at(x - x * (y + 1) + x * y + Rational(1, 10**50), point) != 0


@pytest.mark.parametrize(
    ("expr", "zero"),
    [
        (sin(x) ** 2 + cos(x) ** 2 - 1, True),
        (x, False),
        (sqrt(x**2) - x, False),
        (sqrt(a**2) - a, True),
        (Rational(1, 10**60) * x, False),
        (sqrt(2) - sqrt(2 + Rational(1, 10**40)), False),
        (Function("f")(a) - Function("f")(a) + 1 / (x - x * (sin(a) ** 2 + cos(a) ** 2)), None),
    ],
    ids=str,
)
def test_zero_is_what_no_point_shows_to_be_anything_else(expr: Expr, zero: bool | None) -> None:
    assert is_zero_everywhere(expr) is zero


def test_a_value_is_shown_in_few_figures_and_without_what_is_but_noise() -> None:
    assert str(shown(mp.mpf(2) / 3)) == "0.666667"
    assert str(shown(mp.mpc(1, mp.mpf(10) ** -200), 3)) == "1.00"
    assert shown(mp.mpc(0, 1)).is_real is False


def test_the_rank_is_that_of_almost_all_points() -> None:
    rows = Matrix([[sin(x), cos(x), a], [2 * sin(x), 2 * cos(x), 2 * a], [a, x, 1]])
    assert [generic_rank(m) for m in (rows, rows[:2, :], Matrix([[sin(x) ** 2 + cos(x) ** 2 - 1]]))] == [2, 1, 0]
    with pytest.raises(NoNumber):
        generic_rank(Matrix([[1 / (sin(x) ** 2 + cos(x) ** 2 - 1)]]))
