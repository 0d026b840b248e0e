"""Expressions and equations in natural quantities."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Abs, Expr, Integer, Rational, Symbol, acos, asin, cos, exp, sin, sqrt, symbols

from derive.algebra.expressions import TIME, Relation
from derive.algebra.natural import compared, shortened

m, b, k, x_0, G, M, l, g, R, J, Omega = symbols("m b k x_0 G M l g R J Omega", positive=True)
r_0, theta_0, beta, omega_0, omega_1 = (Symbol(n, real=True) for n in ("r_0", "theta_0", "beta", "omega_0", "omega_1"))
x, x_dot, x_ddot = (Symbol(n, real=True) for n in ("x", "x_dot", "x_ddot"))
DAMPED = {beta: b / (2 * m), omega_0: sqrt(k / m)}
WEAK = {beta: b / (2 * m), omega_1: sqrt(k / m - b**2 / (4 * m**2))}
ROOT = sqrt(4 * k * m - b**2)


@pytest.mark.parametrize(
    ("value", "quantities", "short"),
    [
        (G**2 * M**2 * m**3 / l**3, {r_0: l**2 / (G * M * m**2)}, l / (m * r_0**2)),
        (sqrt(k * g / (m * g + k * l)), {r_0: l + m * g / k}, sqrt(g / r_0)),
        (
            sqrt(3 * M * g * (M * m * g / J**2) ** Rational(1, 3) / (M + m)),
            {r_0: (J**2 / (M * m * g)) ** Rational(1, 3)},
            sqrt(3 * M * g / ((M + m) * r_0)),
        ),
        (m * M * g / (m + M), {beta: m * M / (m + M)}, beta * g),
        (sqrt(Omega**2 - g**2 / (Omega**2 * R**2)), {theta_0: acos(g / (Omega**2 * R))}, Omega * sin(theta_0)),
        (
            x_0 * exp(-b * TIME / (2 * m)) * (cos(ROOT * TIME / (2 * m)) + b / ROOT * sin(ROOT * TIME / (2 * m))),
            WEAK,
            x_0 * exp(-beta * TIME) * (cos(omega_1 * TIME) + beta / omega_1 * sin(omega_1 * TIME)),
        ),
    ],
)
def test_the_textbook_form_is_found(value: Expr, quantities: dict[Symbol, Expr], short: Expr) -> None:
    found = shortened(value, quantities, {TIME})
    assert found is not None
    positive = {name: Symbol(name.name, positive=True) for name in found.used}
    assert (found.value - short).xreplace(positive).equals(0)


def test_an_equation_is_divided_by_the_mass() -> None:
    found = shortened(Relation(m * x_ddot + b * x_dot + k * x, "=", Integer(0)), DAMPED, {x, x_dot, x_ddot})
    assert found is not None
    assert (found.value.left - (x_ddot + 2 * beta * x_dot + omega_0**2 * x)).expand() == 0
    assert found.nonzero == (m,)


def test_a_condition_between_squares_becomes_one_between_roots() -> None:
    found = shortened(Relation(b**2, "<", 4 * k * m), DAMPED)
    assert found is not None
    assert found.value == Relation(beta, "<", omega_0)
    assert compared(m * x_0**2, ">", m * l**2) == Relation(x_0, ">", l)


@pytest.mark.parametrize(
    ("value", "quantities"),
    [
        (m * x_dot**2 / 2 - k * x**2 / 2, DAMPED),  # an energy does not become shorter
        (sqrt(b**2 - 4 * k * m), {omega_1: WEAK[omega_1]}),  # not real where omega_1 is
        (g / l, DAMPED),
        (Integer(3), DAMPED),
    ],
)
def test_a_form_that_is_no_shorter_or_not_real_is_not_used(value: Any, quantities: dict[Symbol, Expr]) -> None:
    assert shortened(value, quantities, {x, x_dot}) is None


def test_a_coordinate_is_not_eliminated() -> None:
    assert shortened(x**2 / 4, {r_0: x / 2}) is not None
    assert shortened(x**2 / 4, {r_0: x / 2}, {x}) is None


def test_only_the_whole_formula_of_a_quantity_is_replaced_in_a_value_that_changes() -> None:
    m1, m2, mu = (Symbol(name, positive=True) for name in ("m_1", "m_2", "mu"))
    reduced = {mu: m1 * m2 / (m1 + m2)}
    energy = (m1 + m2) * x_dot**2 / 2 + m1 * m2 * x**2 / (2 * (m1 + m2))
    found = shortened(energy, reduced, only_whole=True)
    assert found is not None and found.value == (m1 + m2) * x_dot**2 / 2 + mu * x**2 / 2
    assert shortened(m1 * x**2 / (m1 + m2) ** 2, reduced, only_whole=True) is None


def test_no_form_gains_an_absolute_value() -> None:
    value = sqrt(m**2 * g**2 - k**2)
    found = shortened(value, {theta_0: asin(k / (m * g))})
    assert found is None or not found.value.has(Abs)
