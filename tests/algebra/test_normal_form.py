"""What is shown to vanish: exactly, in no time, and never what does not."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest
from sympy import Abs, Add, Expr, Function, I, Integer, Matrix, Rational, cos, nan, pi, sin, sqrt, symbols, tan, zoo

from derive.algebra.expressions import PLUS_MINUS, Dot, column
from derive.algebra.normal_form import vanishes

a, b, c = symbols("a b c", positive=True)
x, y = symbols("x y", real=True)
f = Function("f")

NOTHING = [
    Integer(0),
    (a + b) ** 2 - a**2 - 2 * a * b - b**2,
    1 / (a - b) - 1 / (a + b) - 2 * b / (a**2 - b**2),
    sin(x) ** 2 + cos(x) ** 2 - 1,
    sin(2 * x) - 2 * sin(x) * cos(x),
    cos(3 * x) - 4 * cos(x) ** 3 + 3 * cos(x),
    sin(x + y) * sin(x - y) - cos(y) ** 2 + cos(x) ** 2,
    tan(x) * cos(x) - sin(x),
    sin(x / 2) * cos(x / 2) - sin(x) / 2,
    sqrt(8) - 2 * sqrt(2),
    sqrt(a**2 * b) - a * sqrt(b),
    1 / (sqrt(a) + sqrt(b)) - (sqrt(a) - sqrt(b)) / (a - b),
    sqrt(5 + 2 * sqrt(6)) - sqrt(2) - sqrt(3),
    Abs(x) ** 2 - x**2,
    PLUS_MINUS**2 - 1,
    (1 + I) ** 2 - 2 * I,
    f(x) * (a + b) - a * f(x) - b * f(x),
    Dot(column(a, b, 0), column(b, -a, 0)),
    cos(pi / 6) - sqrt(3) / 2,
]
SOMETHING = [
    Integer(1),
    a - b,
    sin(x) ** 2 - cos(x) ** 2 - 1,
    sin(x + y) - sin(x) - sin(y),
    sqrt(x**2) - x,
    Abs(x) - x,
    sqrt(a + b) - sqrt(a) - sqrt(b),
    PLUS_MINUS - 1,
    f(x) - f(y),
    sqrt(2) - Rational(141421356237, 10**11),
    nan,
    zoo,
    x / (sin(y) ** 2 + cos(y) ** 2 - 1) * (sin(x) ** 2 + cos(x) ** 2 - 1),
]


@pytest.mark.parametrize("expr", NOTHING, ids=str)
def test_nothing_in_disguise_vanishes(expr: Expr) -> None:
    assert vanishes(expr)
    assert not vanishes(expr + Rational(1, 10**30))


@pytest.mark.parametrize("expr", SOMETHING, ids=str)
def test_what_is_something_or_undefined_is_never_said_to_vanish(expr: Expr) -> None:
    assert not vanishes(expr)


def test_a_matrix_has_no_normal_form() -> None:
    assert not vanishes(Matrix([0, 0]))


@pytest.mark.parametrize(
    "made",
    [
        lambda: (a + b + c) ** 400 - (c + b + a) ** 399 * (a + b),
        lambda: (a + 1) ** 501 - (a + 1) ** 500 * (a + 1 + b),
        lambda: Add(*(sin(n * x) for n in range(2500))),
        lambda: sin(1000 * x) - sin(x),
    ],
    ids=["terms", "power", "operations", "angle"],
)
def test_what_is_too_large_to_multiply_out_is_left_undecided_at_once(made: Callable[[], Expr]) -> None:
    expr, started = made(), time.monotonic()
    assert not vanishes(expr)
    assert time.monotonic() - started < 10
