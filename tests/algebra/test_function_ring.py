"""The ring of all functions: what is equal has no terms left, and what is something for sure is known to be."""

from __future__ import annotations

import pytest
from sympy import (
    Abs,
    E,
    Expr,
    Function,
    I,
    Rational,
    S,
    Symbol,
    acos,
    cbrt,
    cos,
    cosh,
    cot,
    csc,
    diff,
    exp,
    log,
    pi,
    sec,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    tanh,
    zoo,
)
from sympy import sign as sgn

from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.function_ring import HIGHEST, FunctionRing, factors_under_a_root
from derive.algebra.normal_form import vanishes
from derive.algebra.sparse_polynomials import Outside
from derive.algebra.trig_polynomials import asked

a, b, c, g, k, m = symbols("a b c g k m", positive=True)
x, y, t = symbols("x y t", real=True)
n = Symbol("n", negative=True)
i = Symbol("i", integer=True)
z = Symbol("z")
f, q = Function("f"), Function("q")(t)

EQUAL = [
    # functions of functions, with roots inside
    (
        sin(a * sin(t * sqrt(g)) + b * cos(t * sqrt(g))),
        sin(a * sin(t * sqrt(g))) * cos(b * cos(t * sqrt(g))) + cos(a * sin(t * sqrt(g))) * sin(b * cos(t * sqrt(g))),
    ),
    (sgn(x - a), (x - a) / Abs(x - a)),
    (sgn(x - a) ** 3, -sgn(a - x)),
    # roots
    (
        sqrt((a * cos(x) - a) ** 2 + (a * sin(x) + 2 * y) ** 2),  # one angle: 1/4 of it here, 1/2 of it there
        sqrt(2) * sqrt(a**2 - a**2 * cos(x) + 2 * a * y * sin(x) + 2 * y**2),
    ),
    (sqrt(6), sqrt(2) * sqrt(3)),
    (sqrt(a**2 - b**2), sqrt(a + b) * sqrt(a - b)),
    (1 / sqrt(x**2 + a), sqrt(x**2 + a) / (x**2 + a)),
    ((x**2 + a) ** Rational(-5, 2) * (x**2 + a) ** 2, 1 / sqrt(x**2 + a)),
    (cbrt(a**4 * b), a * cbrt(a * b)),
    (cbrt(x + a) ** 4, (x + a) * cbrt(x + a)),
    (sqrt(a + sqrt(b)) * sqrt(a - sqrt(b)) * x, x * sqrt(a + sqrt(b)) * sqrt(a - sqrt(b))),
    (sqrt(sqrt(a) + 1) ** 4, a + 2 * sqrt(a) + 1),
    (a / sqrt(a**2 * sin(x) ** 2 + a**2 * (1 - sin(x) ** 2)), S.One),
    (sqrt(5 + 2 * sqrt(6)) ** 3, (sqrt(2) + sqrt(3)) ** 3),
    (sqrt(-a) ** 3, -a * sqrt(-a)),
    (1 / (1 + sqrt(a) + sqrt(b)), (1 + sqrt(a) - sqrt(b)) / ((1 + sqrt(a)) ** 2 - b)),
    # absolute values, either sign
    (Abs(a * x - b * y) ** 3, Abs(b * y - a * x) * (a * x - b * y) ** 2),
    (1 / Abs(x * y), Abs(x) * Abs(y) / (x * y) ** 2),
    ((x + PLUS_MINUS * y) * (x - PLUS_MINUS * y), x**2 - y**2),
    # quotients of sines
    (sec(x) ** 2, 1 + tan(x) ** 2),
    (cot(x) * sec(x), csc(x)),
    (tanh(x) ** 2, 1 - 1 / cosh(x) ** 2),
    # exponential functions and powers
    (exp(x + 2 * y), exp(x) * exp(y) ** 2),
    (exp(x / 2) ** 2 * exp(-x), S.One),
    (E * exp(x), exp(x + 1)),
    (exp(I * x) * exp(-a * t), exp(I * x - a * t)),
    (sinh(3 * x), 3 * sinh(x) + 4 * sinh(x) ** 3),
    (a ** (x + 2), a**2 * a**x),
    ((a * b) ** x, a**x * b**x),
    (n**i * n, n ** (i + 1)),
    (z ** (x + y), z**x * z**y),
    (log(a**2 / b) - log(a), log(a) - log(b)),
    (sin(sqrt(k / m) * t) * m, m * sin(sqrt(k) * t / sqrt(m))),
    # other functions
    (acos((x**2 - 1) / (x - 1)), acos(x + 1)),
    (f(x) * diff(q, t) * (a + b), a * diff(q, t) * f(x) + b * diff(q, t) * f(x)),
    (pi * acos(2 * x) / pi, acos(x + x)),
]
UNEQUAL = [
    (sqrt(x**2), x),
    (cbrt(x**3), x),
    (sqrt(x * y), sqrt(x) * sqrt(y)),
    (sqrt(z**2), z),
    ((z * x) ** y, z**y * x**y),
    (log(x**2), 2 * log(x)),
    (exp(x) * exp(y), exp(x * y)),
    (a**x * b**x, (a + b) ** x),
    (Abs(x) * x, x**2),
    (PLUS_MINUS * x, x),
    (f(x) + f(y), f(x + y)),
    (tanh(x), sinh(x)),
    (exp(I * x), exp(x)),
]


def is_zero(expr: Expr) -> bool:
    return asked(FunctionRing, lambda ring: ring.is_zero(ring.form(expr)), expr)


@pytest.mark.parametrize(("left", "right"), EQUAL, ids=str)
def test_what_is_equal_has_one_form(left: Expr, right: Expr) -> None:
    assert is_zero(left - right)
    assert vanishes(right - left)
    for other in (right + Rational(1, 10**9), right * (1 + a / 10**9), -right):
        assert not vanishes(left - other)


@pytest.mark.parametrize(("left", "right"), UNEQUAL, ids=str)
def test_what_holds_for_some_signs_alone_is_not_shown(left: Expr, right: Expr) -> None:
    assert not is_zero(left - right)
    assert not vanishes(left - right)


@pytest.mark.parametrize(
    ("base", "order", "factors"),
    [
        (12 * a**2 * b, 2, {(2, 2), (3, 1), (a, 2), (b, 1)}),
        (a**2 - b**2, 2, {(a + b, 1), (a - b, 1)}),
        (x**2 * a, 2, {(a, 1), (Abs(x), 2)}),
        (x**3, 2, {(Abs(x), 2), (x, 1)}),
        (x**3, 3, {(x**3, 1)}),
        (x * y / a, 2, {(a, -1), (x * y, 1)}),
    ],
)
def test_only_what_is_not_negative_leaves_a_common_root(base: Expr, order: int, factors: set[tuple[Expr, int]]) -> None:
    assert set(factors_under_a_root(base, order)) == factors


@pytest.mark.parametrize(
    ("value", "sure"),
    [(x + a, True), (sin(x) ** 2 - 1, True), (1 / (a + b) - 1 / a, True), (x - x * 1, False), (sqrt(x) - y, False)],
)
def test_what_is_something_for_sure_has_no_letters_that_may_depend_on_one_another(value: Expr, sure: bool) -> None:
    assert asked(FunctionRing, lambda ring: ring.is_nonzero(ring.form(value)), value) is sure


@pytest.mark.parametrize(
    "value", [(a + b) ** (HIGHEST + 1), x + zoo, sin((HIGHEST + 1) * x), Symbol("n", commutative=False)]
)
def test_what_is_undefined_or_too_large_is_left_open(value: Expr) -> None:
    with pytest.raises(Outside):
        is_zero(value)


NOTHING = [
    sqrt(a**2 + 2 * a * b + b**2) - a - b,
    (exp(x) + 1) ** 2 - exp(2 * x) - 2 * exp(x) - 1,
    log(a * (a + b)) - log(a) - log(a + b),
    Abs(x - y) - Abs(y - x) + acos(sin(x) ** 2 - 1) - acos(-(cos(x) ** 2)),
]


@pytest.mark.parametrize("nothing", NOTHING, ids=str)
def test_a_quotient_of_nothing_by_nothing_is_not_zero(nothing: Expr) -> None:
    assert vanishes(nothing)
    assert not vanishes(nothing / nothing**2 * x)
    for other in NOTHING:
        assert not vanishes(x * other / (nothing + nothing * y))
