"""Signs that are settled where a letter lies between two numbers, and those that are not."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from sympy import Abs, Expr, Integer, Rational, Symbol, atan, cos, oo, pi, sin, sqrt, symbols, tan

from derive.algebra.equality import equal
from derive.algebra.ranges import (
    POSITIVE,
    Range,
    ends_within,
    never_vanishes_within,
    rational_in_range,
    sign_within,
    strict_sign_within,
    with_positive_factors_out,
    within,
    without_abs,
)
from derive.algebra.tidy import tidied

alpha = Symbol("alpha", positive=True)
beta = Symbol("beta", real=True)
a, b = symbols("a b", positive=True)
x, P, E = symbols("x P E", real=True)


@pytest.fixture(autouse=True)
def acute() -> Iterator[None]:
    acute = Range(Integer(0), pi / 2)
    with within({alpha: acute, beta: Range(-pi / 2, pi / 2), P: POSITIVE, E: Range(-oo, Integer(0))}):
        yield


@pytest.mark.parametrize(
    ("expr", "sign"),
    [
        (sin(alpha), 1),
        (cos(alpha), 1),
        (tan(alpha), 1),
        (sin(2 * alpha), 1),
        (cos(2 * alpha), None),
        (sin(alpha - pi), -1),
        (sin(alpha + pi / 2), 1),
        (sin(3 * alpha), None),
        (cos(beta), 1),
        (sin(beta), None),
        (alpha - pi / 2, -1),
        (a * sin(alpha) ** 3 / cos(alpha), 1),
        (-a * cos(beta), -1),
        (alpha - beta, None),
        (alpha - a, None),
        (1 + 2 * cos(alpha) ** 2, 1),
        (1 - cos(alpha), 1),
        (1 - cos(beta), None),  # it vanishes within
        (sin(alpha) - 1, -1),
        (3 * cos(alpha) - 2, None),
        (sqrt(cos(alpha)) * a, 1),
        (sqrt(sin(beta)), None),
        (a + x**2 * sin(alpha), 1),
        (a - x**2 * sin(alpha), None),
        (-a - x**2 * sin(alpha), -1),
        (a + b - b * cos(x) ** 2, 1),
        (Abs(sin(alpha)) * x, None),
        (P, 1),
        (P - 1, None),
        (x - E, None),
        (E, -1),
        (a - E, 1),
        (pi - atan(a / b), 1),
        (pi / 2 - atan(x), 1),
        (atan(x) - 2, -1),
        (atan(x) + pi / 3, None),
        (pi / 4 - atan(a / b), None),
        (a * sin(x) ** 2 + b * cos(x) ** 2, 1),
        (-a * sin(x) ** 2 - b * cos(x) ** 2, -1),
        (a * sin(x) ** 2 + b * cos(P) ** 2, None),  # it vanishes at x = 0, P = pi/2
        (a * sin(x) ** 2 - b * cos(x) ** 2, None),
        (9 * a + 4 * b * (1 + cos(x) + sin(x) ** 2), 1),
        (9 * a + 4 * b * (cos(x) + sin(x) ** 2), None),  # negative at cos(x) = -1 for a small a
        (-2 * a - b - b * cos(x) - a * cos(x) ** 2, -1),
        (a + a * cos(x) - a * cos(x) ** 2, None),
        (cos(alpha / 2) - cos(alpha), 1),
        (a * cos(2 * alpha) - a * cos(alpha), -1),
        (sin(2 * alpha) - sin(alpha), None),
        (sin(alpha) + sin(2 * alpha), 1),
        (sin(alpha) - sin(alpha / 2), 1),
    ],
)
def test_a_sign_is_told_where_it_is_one_in_the_whole_range(expr: Expr, sign: int | None) -> None:
    assert sign_within(expr) == sign


def test_an_absolute_value_goes_where_its_sign_is_settled() -> None:
    assert without_abs(Abs(sin(alpha)) + Abs(sin(beta))) == sin(alpha) + Abs(sin(beta))
    assert tidied(sqrt(a**2 * sin(alpha) ** 2)) == a * sin(alpha)
    assert tidied(sqrt(1 - cos(alpha) ** 2)) == sin(alpha)


def test_a_root_of_a_power_of_a_positive_quantity_is_a_power() -> None:
    third = Rational(1, 3)
    assert without_abs((sin(alpha) ** 3) ** (2 * third) + (sin(beta) ** 3) ** third) == (
        sin(alpha) ** 2 + (sin(beta) ** 3) ** third
    )
    assert without_abs((sin(alpha) ** 3 * cos(beta)) ** -third) == cos(beta) ** -third / sin(alpha)


def test_what_is_equal_in_the_range_is_equal() -> None:
    assert equal(sqrt(sin(alpha) ** 2), sin(alpha))
    assert not equal(sqrt(sin(beta) ** 2), sin(beta))
    assert not equal(sqrt(cos(2 * alpha) ** 2), cos(2 * alpha))


def test_nothing_is_known_outside() -> None:
    with within({alpha: Range(-pi, pi)}):
        assert not equal(Abs(sin(alpha)), sin(alpha))


def test_an_end_that_is_reached_may_be_a_zero() -> None:
    with within({beta: Range(Integer(0), pi / 2, (True, True))}):
        assert sign_within(sin(beta)) == 1
        assert strict_sign_within(sin(beta)) is None
        assert not never_vanishes_within(sin(beta))
        assert ends_within(sin(beta)) is None
    assert never_vanishes_within(a * sin(alpha) / cos(beta))
    assert not never_vanishes_within(x * sin(alpha))


@pytest.mark.parametrize(
    ("expr", "ends"),
    [
        (cos(alpha), (0, 1)),
        (sin(alpha), (0, 1)),
        (sin(beta), (-1, 1)),
        (cos(beta), None),  # it rises and falls
        (P, (0, oo)),
        (E, (-oo, 0)),
        (2 * alpha - pi, (-pi, 0)),
        (x, None),
    ],
)
def test_ends_are_those_of_what_only_rises_or_falls(expr: Expr, ends: tuple[object, object] | None) -> None:
    assert ends_within(expr) == ends


@pytest.mark.parametrize("letter", [alpha, beta, P, E])
def test_numbers_are_drawn_from_the_range(letter: Symbol) -> None:
    for number in (Rational(1, 1000), Integer(1), Integer(1000)):
        there = rational_in_range(letter, number)
        ends = ends_within(letter)
        assert ends is not None
        assert there.is_Rational
        assert ends[0] < there < ends[1]
    assert rational_in_range(P, Integer(7)) == 7
    assert rational_in_range(a, Integer(7)) == 7


@pytest.mark.parametrize(
    ("number", "closed", "held"),
    [
        (pi / 4, (False, False), True),
        (pi / 2, (False, False), False),
        (pi / 2, (False, True), True),
        (Integer(0), (False, True), False),
        (Integer(0), (True, False), True),
        (Rational(-1), (True, True), False),
        (Rational(157, 100), (False, False), True),
        (Rational(158, 100), (False, True), False),
    ],
)
def test_a_range_holds_the_numbers_between_its_ends(number: Expr, closed: tuple[bool, bool], held: bool) -> None:
    assert Range(Integer(0), pi / 2, closed).holds(number) is held


def test_a_range_without_an_end_holds_whatever_is_large() -> None:
    assert POSITIVE.holds(Integer(10) ** 12)
    assert not POSITIVE.holds(Integer(0))


def test_factors_whose_sign_a_range_settles_leave_a_root() -> None:
    root = sqrt(x**2 / sin(alpha) ** 2 + a**2)
    assert with_positive_factors_out(root) == sqrt(x**2 + a**2 * sin(alpha) ** 2) / sin(alpha)
    assert with_positive_factors_out(sqrt(x**2 / sin(beta) ** 2 + a**2)) == sqrt(x**2 / sin(beta) ** 2 + a**2)
    assert equal(x / (root * sin(alpha)), x / sqrt(x**2 + a**2 * sin(alpha) ** 2))


@pytest.mark.parametrize(
    ("expr", "sign"),
    [(sin(x), 1), (cos(x), None), (a * sin(x) ** 2 + b * cos(x) ** 2, 1), (1 - cos(x), 1), (a + cos(x), 1)],
)
def test_a_strict_sign_is_tried_at_the_ends_that_belong_to_a_range(expr: Expr, sign: int | None) -> None:
    with within({x: Range(Integer(0), pi / 2, closed=(False, True))}):
        assert strict_sign_within(expr) == sign
