"""Taylor series along a motion agree with derivatives, which have no part in them."""

from __future__ import annotations

import pytest
from sympy import Expr, Integer, Rational, Symbol, cos, diff, exp, factorial, log, sin, sqrt, symbols, tan

from derive.algebra.normal_form import vanishes
from derive.algebra.taylor import NoSeries, arithmetic_along, coefficient_along, slope, taylor

a, b, s = symbols("a b s", positive=True)
q, v, w = symbols("q v w", real=True)
LINE = {q: (q, v, w / 2, Integer(0))}  # q + v s + w s^2/2

VALUES = [
    q,
    a,
    a * q + b,
    q**3 * sin(q),
    cos(a * q) ** 2 * (1 + q) ** 2,
    1 / (a + q),
    (1 + q) ** -3 * cos(q),
    sin(q**2 + a),
    sin(cos(q)),
    sqrt(a) * q,
    Integer(0),
    exp(-a) * q,
    sqrt(a**2 + q**2) * sin(q),
    (a + q**2) ** b,
    (a + q) ** Rational(-3, 2),
    exp(-a * q) / (a + q),
    tan(a * q) ** 2,
]


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_coefficients_are_the_derivatives_along_the_motion(value: Expr) -> None:
    along = value.xreplace({q: q + v * s + w * s**2 / 2})
    for n, coefficient in enumerate(taylor(value, LINE, 3)):
        assert vanishes(coefficient - diff(along, s, n).subs(s, 0) / factorial(n))


@pytest.mark.parametrize("value", [q**q, log(q)])
def test_a_function_without_a_series_here_is_refused(value: Expr) -> None:
    with pytest.raises(NoSeries):
        taylor(value, LINE, 1)


def test_a_size_has_a_series_where_it_does_not_vanish() -> None:
    assert taylor(abs(q), {q: (-b, Integer(1), Integer(0))}, 2) == (b, -1, 0)
    with pytest.raises(NoSeries):
        taylor(abs(q), {q: (Integer(0), Integer(1))}, 1)


def test_a_root_of_what_vanishes_has_no_series() -> None:
    with pytest.raises(NoSeries):
        taylor(sqrt(q), {q: (Integer(0), Integer(1))}, 1)


def test_what_changes_to_a_higher_order_only_is_taken_at_the_place() -> None:
    from_rest = {q: (Integer(0), Integer(1))}
    assert taylor(sin(q) ** 2 + b, from_rest, 1) == (b, 0)
    assert taylor((a - q**2) ** 2, from_rest, 1) == (a**2, 0)


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize(
    "value",
    [
        (1 - cos(q)) / sin(q),
        (1 - cos(q)) ** 2 / sin(q) ** 2 + a * q,
        sin(a * q) / q,
        (sin(q) ** 2 + (cos(q) - 1) * (cos(q) + 1) + q**2) / q,
    ],
    ids=str,
)
def test_a_quotient_of_what_vanishes_has_the_coefficients_of_its_series(value: Expr, order: int) -> None:
    found = coefficient_along(value, {q: Integer(0)}, {q: Integer(1)}, order)
    assert vanishes(found - value.series(q, 0, order + 1).removeO().expand().coeff(q, order))


def test_in_a_direction_of_several_letters() -> None:
    found = coefficient_along(q**2 * w + sin(q * w), {q: a, w: Integer(0)}, {q: v, w: b}, 2)
    assert vanishes(found - (2 * a * v * b + v * b))


def test_a_series_that_is_too_short_is_refused() -> None:
    assert taylor(q**2, {q: (q, v)}, 1) == (q**2, 2 * q * v)
    with pytest.raises(NoSeries):
        taylor(q**2, {q: (q, v)}, 2)


@pytest.mark.parametrize("value", [*VALUES, sqrt(q**2 + a**2), exp(-a * q), 1])
@pytest.mark.parametrize("letter", [q, a, Symbol("other")])
def test_the_slope_is_the_derivative_by_one_letter(value: Expr, letter: Symbol) -> None:
    assert vanishes(slope(value, letter) - diff(value, letter))


def test_the_arithmetic_alone_reaches_a_quotient_of_what_vanishes() -> None:
    assert list(arithmetic_along((1 - cos(q)) / q**2, {q: Integer(0)}, {q: Integer(1)}, 2)) == [
        Rational(1, 2), 0, -Rational(1, 24),
    ]  # fmt: skip
    with pytest.raises(NoSeries):
        arithmetic_along(log(q), {q: Integer(1)}, {q: Integer(1)}, 1)
