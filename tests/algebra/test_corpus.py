"""Pairs of expressions as mechanics has them: equal in another form, and different by one slip. All are decided right.

A slip is a sign, a factor, an index, two arguments exchanged or a term left out, in one place of an equal form. Whether
it makes a difference is told by plain floating-point numbers, which share nothing with the code under test.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest
from sympy import (
    Abs,
    Add,
    Expr,
    Function,
    I,
    Integer,
    Max,
    Mul,
    Piecewise,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cbrt,
    cos,
    cosh,
    diff,
    exp,
    lambdify,
    log,
    preorder_traversal,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    tanh,
)

from derive.algebra.equality import Grade, equal

a, b, c, h, m, M, R, g, k = symbols("a b c h m M R g k", positive=True)
x, y, z, theta, phi, psi = symbols("x y z theta phi psi", real=True)
I_x, I_y, I_z = symbols("I_x I_y I_z", positive=True)
omega_x, omega_y, omega_z, theta_dot, phi_dot = symbols("omega_x omega_y omega_z theta_dot phi_dot", real=True)
t = Symbol("t", real=True)
q, f = Function("q")(t), Function("f")
half = Rational(1, 2)

PROVED = [
    # polynomials and rational functions
    ((a + b) ** 3 - (a - b) ** 3, 6 * a**2 * b + 2 * b**3),
    ((x + y + z) ** 2, x**2 + y**2 + z**2 + 2 * x * y + 2 * y * z + 2 * x * z),
    ((x**3 - y**3) / (x - y), x**2 + x * y + y**2),
    (1 / (x - y) + 1 / (x + y), 2 * x / (x**2 - y**2)),
    (m * M / (m + M), 1 / (1 / m + 1 / M)),
    (M * a**2 / 12 + M * (a / 2) ** 2, M * a**2 / 3),
    (3 * M * (R**2 + h**2 / 4) / 20 + 9 * M * h**2 / 16, 3 * M * (R**2 + 4 * h**2) / 20),
    ((I_x - I_y) * omega_x * omega_y + I_y * omega_x * omega_y, I_x * omega_x * omega_y),
    ((a / b) / (c / h), a * h / (b * c)),
    ((x**4 - 1) / (x**2 + 1) / (x + 1), x - 1),
    (1 / (1 + 1 / (1 + 1 / a)), (a + 1) / (2 * a + 1)),
    (a**2 / (a - b) / (a - c) + b**2 / (b - a) / (b - c) + c**2 / (c - a) / (c - b), Integer(1)),
    (I_x * omega_x**2 / 2 + I_y * omega_y**2 / 2, (I_x * omega_x**2 + I_y * omega_y**2) / 2),
    (omega_y * (I_z * omega_z) - omega_z * (I_y * omega_y), -(I_y - I_z) * omega_y * omega_z),
    (k * x**2 / 2 - k * (x - a) ** 2 / 2, k * a * x - k * a**2 / 2),
    # sines of sums and multiples
    (sin(x + y), sin(x) * cos(y) + cos(x) * sin(y)),
    (cos(x - y), cos(x) * cos(y) + sin(x) * sin(y)),
    (sin(x + y) + sin(x - y), 2 * sin(x) * cos(y)),
    (cos(theta) ** 2 - sin(theta) ** 2, 2 * cos(theta) ** 2 - 1),
    (sin(2 * theta) / 2, sin(theta) * cos(theta)),
    (cos(3 * x), 4 * cos(x) ** 3 - 3 * cos(x)),
    (sin(x) ** 4 + cos(x) ** 4, 1 - sin(2 * x) ** 2 / 2),
    (tan(x / 2), sin(x) / (1 + cos(x))),
    (tan(x + y), (tan(x) + tan(y)) / (1 - tan(x) * tan(y))),
    (1 - cos(theta), 2 * sin(theta / 2) ** 2),
    (sin(x) * sin(y), (cos(x - y) - cos(x + y)) / 2),
    (sin(theta) ** 2 * phi_dot**2 + cos(theta) ** 2 * phi_dot**2 + theta_dot**2, theta_dot**2 + phi_dot**2),
    ((cos(phi) * theta_dot) ** 2 + (sin(phi) * theta_dot) ** 2, theta_dot**2),
    (cos(psi) * sin(theta) * sin(psi) - sin(psi) * sin(theta) * cos(psi), Integer(0)),
    ((1 - cos(theta)) / sin(theta) ** 2, 1 / (1 + cos(theta))),
    (sin(x + y + z), sin(x + y) * cos(z) + cos(x + y) * sin(z)),
    (sin(theta + phi) ** 2 + cos(theta + phi) ** 2, Integer(1)),
    (cos(x) / (1 - sin(x)), (1 + sin(x)) / cos(x)),
    (m * g * R * (1 - cos(theta)) - m * g * R, -m * g * R * cos(theta)),
    (diff(sin(x) ** 3 * cos(x), x), 3 * sin(x) ** 2 * cos(x) ** 2 - sin(x) ** 4),
    (diff(cos(2 * x) / (1 + x**2), x), -2 * sin(2 * x) / (1 + x**2) - 2 * x * cos(2 * x) / (1 + x**2) ** 2),
    # roots, nested ones too
    (sqrt(12), 2 * sqrt(3)),
    (sqrt(a**2 * b), a * sqrt(b)),
    (sqrt(a / b), sqrt(a * b) / b),
    (1 / (sqrt(a) + sqrt(b)), (sqrt(a) - sqrt(b)) / (a - b)),
    (sqrt(5 + 2 * sqrt(6)), sqrt(2) + sqrt(3)),
    (sqrt(5 - 2 * sqrt(6)), sqrt(3) - sqrt(2)),
    (sqrt(3 + 2 * sqrt(2)) * a, a + a * sqrt(2)),
    (sqrt(2 + sqrt(3)), (sqrt(6) + sqrt(2)) / 2),
    (1 / sqrt(7 - 4 * sqrt(3)), 2 + sqrt(3)),
    (sqrt(14) / 28 * sqrt(3), sqrt(42) / 28),
    (7 / sqrt(14), sqrt(14) / 2),
    (sqrt(a**2 + 2 * a * b + b**2), a + b),
    (sqrt(M * g / k) * sqrt(k), sqrt(M * g)),
    (sqrt(x**2 + y**2) ** 4, (x**2 + y**2) ** 2),
    (sqrt(g / R) ** 3, g * sqrt(g * R) / R**2),
    (cbrt(a**2) * cbrt(a), a),
    (cbrt(16), 2 * cbrt(2)),
    ((sqrt(a + b) - sqrt(a)) * (sqrt(a + b) + sqrt(a)), b),
    (sqrt(sqrt(a)) ** 2, sqrt(a)),
    (sqrt(1 + sqrt(a)) * sqrt(1 + sqrt(a)) - 1, sqrt(a)),
    ((a + sqrt(b)) / (a - sqrt(b)), (a + sqrt(b)) ** 2 / (a**2 - b)),
    (sqrt(2 * a**2 * (1 + cos(x))) ** 2, 4 * a**2 * cos(x / 2) ** 2),
    # absolute values
    (sqrt(x**2), Abs(x)),
    (sqrt(x**2 * y**2), Abs(x) * Abs(y)),
    (Abs(x - y), Abs(y - x)),
    (Abs(a * x), a * Abs(x)),
    (Abs(x) ** 2, x**2),
    (Abs(x / y), Abs(x) / Abs(y)),
    (sqrt((x - a) ** 2 * b), Abs(x - a) * sqrt(b)),
    (1 / Abs(x), Abs(x) / x**2),
    (sin(acos(x / sqrt(x**2 + y**2))), Abs(y) / sqrt(x**2 + y**2)),
    # inverse and unknown functions
    (acos((x**2 - y**2) / (x - y) / 3), acos((x + y) / 3)),
    (atan(sqrt(6) / sqrt(2)), atan(sqrt(3))),
    (diff(q**2 / 2, t), q * diff(q, t)),
    (diff(sin(q), t, 2), cos(q) * diff(q, t, 2) - sin(q) * diff(q, t) ** 2),
    ((q + diff(q, t)) * (q - diff(q, t)), q**2 - diff(q, t) ** 2),
    (f(x) * (sin(y) ** 2 + cos(y) ** 2) + f(y), f(x) + f(y)),
    (log(a) * (a - b) / (a**2 - b**2), log(a) / (a + b)),
    # exponential functions, and powers with letters
    (sinh(2 * x), 2 * sinh(x) * cosh(x)),
    (log(a**2 / b), 2 * log(a) - log(b)),
    (tanh(x), (exp(2 * x) - 1) / (exp(2 * x) + 1)),
    (exp(x) ** 2 - exp(x) * (exp(x) - 1), exp(x)),
    (sinh(x + y), sinh(x) * cosh(y) + cosh(x) * sinh(y)),
    (exp(I * x - y), exp(-y) * (cos(x) + I * sin(x))),
    ((a / b) ** x * b ** (x + 2), b**2 * a**x),
    (exp(sqrt(k / m) * x) * exp(-x * sqrt(k) / sqrt(m)), Integer(1)),
]  # fmt: skip

SAMPLED = [
    (sqrt(a + b + 2 * sqrt(a * b)), sqrt(a) + sqrt(b)),
    (sqrt(1 - sin(x) ** 2), Abs(cos(x))),
    (cos(2 * acos(x / 3)), 2 * x**2 / 9 - cosh(x) ** 2 + sinh(x) ** 2),
    (Piecewise((x, x > 0), (-x, True)), Abs(x)),
    (Max(x, y), (x + y + Abs(x - y)) / 2),
    (atan2(y, x), 2 * atan(y / (sqrt(x**2 + y**2) + x))),
]

# true for small or for ordinary numbers, or on one side of zero
FALSE = [
    (tanh(500 * a), Integer(1)),
    (acos(cos(a)), a),
    (asin(sin(x)), x),
    (atan2(sin(a), cos(a)), a),
    (atan2(y, x), atan(y / x)),
    (atan(tan(a)), a),
    (Abs(x), x),
    (Max(a, Rational(1, 100)), a),
    (Max(a, 1000), Integer(1000)),
    (Piecewise((x, x < 100), (x + 1, True)), x),
    (Piecewise((x, x > 0), (0, True)), Piecewise((x, x > Rational(1, 1000)), (0, True))),
    (a + exp(-1000 * a), a),
    (cosh(a / 10**6), Integer(1)),
    (sin(a) / a, 1 + a**2 / 10**30),
    (sqrt(x**2 + Rational(1, 10**20)), Abs(x)),
    (exp(-(x**2)), Integer(0)),
    (cbrt(x**3), x),
    (sqrt(x) * sqrt(y), sqrt(x * y)),
    (log(x**2), 2 * log(x)),
    (sqrt(x**2 - 2 * x + 1), x - 1),
    (f(x), f(-x)),
    (f(x) + f(y), f(x + y)),
]


def told(pair: tuple[Expr, Expr]) -> str:
    return f"{pair[0]}  {pair[1]}"


@pytest.mark.parametrize("pair", PROVED, ids=told)
def test_what_is_equal_in_another_form_is_proved(pair: tuple[Expr, Expr]) -> None:
    assert equal(*pair).grade is Grade.PROVED


@pytest.mark.parametrize("pair", SAMPLED, ids=told)
def test_what_is_equal_beyond_the_exact_methods_is_sampled(pair: tuple[Expr, Expr]) -> None:
    assert equal(*pair).grade is Grade.SAMPLED


@pytest.mark.parametrize("pair", FALSE, ids=told)
def test_what_holds_for_some_sizes_and_signs_alone_is_refuted(pair: tuple[Expr, Expr]) -> None:
    for left, right in (pair, pair[::-1]):
        verdict = equal(left, right)
        assert (verdict.grade, bool(verdict.point)) == (Grade.REFUTED, True)


# --- slips -----------------------------------------------------------------------------------------------------------

INDICES = {omega_x: omega_y, I_x: I_z, x: y, theta: phi, a: b, b: a, y: x}


def slips(expr: Expr) -> Iterator[tuple[str, Expr]]:
    for node in dict.fromkeys(preorder_traversal(expr)):
        if isinstance(node, Add):
            *others, last = node.args
            yield "a sign", expr.xreplace({node: Add(*others, -last)})
            yield "a term left out", expr.xreplace({node: Add(*node.args[1:])})
            yield "a factor", expr.xreplace({node: Add(*others, 2 * last)})
        elif isinstance(node, sin | cos | sinh | cosh):
            other = {sin: cos, cos: sin, sinh: cosh, cosh: sinh}[node.func]
            yield "another function", expr.xreplace({node: other(*node.args)})
        elif isinstance(node, atan2):
            yield "arguments exchanged", expr.xreplace({node: atan2(*reversed(node.args))})
        elif isinstance(node, Mul) and node.args[0].is_Rational:
            yield "a number", expr.xreplace({node: Mul(node.args[0] + 1, *node.args[1:])})
        elif node in INDICES:
            yield "an index", expr.xreplace({node: INDICES[node]})


def apart(left: Expr, right: Expr) -> bool:
    """Whether two expressions differ at one of two points, in the machine's own numbers."""
    functions = {q: Symbol("q"), diff(q, t): Symbol("q_dot"), diff(q, t, 2): Symbol("q_ddot")}
    put_in = dict(reversed(functions.items()))
    sides = [side.xreplace(put_in).replace(f, lambda u: log(3 + u**2)) for side in (left, right)]
    letters = sorted({letter for side in sides for letter in side.free_symbols}, key=str)
    for start in (0.37, 1.91):
        numbers = [start + 0.61 * i - 0.07 * i * i for i in range(len(letters))]
        try:
            u, v = (complex(lambdify(letters, side, ["math", cmath_functions()])(*numbers)) for side in sides)
        except (ValueError, ZeroDivisionError, TypeError):
            return False
        if abs(u - v) > 1e-6 * (abs(u) + abs(v)):
            return True
    return False


def cmath_functions() -> dict[str, Any]:
    names = ("sin", "cos", "tan", "sinh", "cosh", "tanh", "sqrt", "exp", "log", "acos", "asin", "atan")
    return {name: getattr(cmath, name) for name in names}


@cache
def slips_of_the_corpus() -> list[tuple[str, Expr, Expr]]:
    """The slips that make a difference. Made when they are needed, because the comparison takes longer than an import
    should."""
    return [
        (what, left, slipped)
        for left, right in PROVED + SAMPLED[:3]
        for what, slipped in list(slips(right))[:4]
        if apart(left, slipped)
    ]


def test_there_are_slips_of_every_sort() -> None:
    assert len(slips_of_the_corpus()) > 120
    assert {what for what, *_ in slips_of_the_corpus()} >= {
        *("a sign", "a term left out", "a factor", "another function", "an index")
    }


def test_every_slip_is_refuted() -> None:
    wrong = [each for each in slips_of_the_corpus() if equal(*each[1:]).grade is not Grade.REFUTED]
    assert not wrong
