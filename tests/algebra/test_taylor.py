"""Taylor series along a motion agree with derivatives, which have no part in them."""

from __future__ import annotations

import pytest
from sympy import Expr, Integer, Symbol, cos, diff, exp, factorial, log, sin, sqrt, symbols

from derive.algebra.normal_form import vanishes
from derive.algebra.taylor import NoSeries, slope, taylor

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
    exp(a * q) * (1 + q),
    sqrt(a**2 + q**2) * sin(q),
    (a + q**2) ** b,
]


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_coefficients_are_the_derivatives_along_the_motion(value: Expr) -> None:
    along = value.xreplace({q: q + v * s + w * s**2 / 2})
    for n, coefficient in enumerate(taylor(value, LINE, 3)):
        assert vanishes(coefficient - diff(along, s, n).subs(s, 0) / factorial(n))


@pytest.mark.parametrize("value", [q**q, log(q), abs(q) + q])
def test_a_function_without_a_series_here_is_refused(value: Expr) -> None:
    with pytest.raises(NoSeries):
        taylor(value, LINE, 1)


def test_a_series_that_is_too_short_is_refused() -> None:
    assert taylor(q**2, {q: (q, v)}, 1) == (q**2, 2 * q * v)
    with pytest.raises(NoSeries):
        taylor(q**2, {q: (q, v)}, 2)


@pytest.mark.parametrize("value", [*VALUES, sqrt(q**2 + a**2), exp(-a * q), 1])
@pytest.mark.parametrize("letter", [q, a, Symbol("other")])
def test_the_slope_is_the_derivative_by_one_letter(value: Expr, letter: Symbol) -> None:
    assert vanishes(slope(value, letter) - diff(value, letter))
