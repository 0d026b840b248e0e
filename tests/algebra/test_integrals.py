"""Definite integrals of the known kinds, against SymPy's where it is right and against numbers where it is not."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, Integral, Rational, cos, exp, integrate, nan, pi, simplify, sin, sqrt, symbols

from derive.algebra.expressions import explicit
from derive.algebra.integrals import antiderivative, definite, sine_and_cosine_integral

x, y, z, u = symbols("x y z u", real=True)
R, h, w = symbols("R h w", positive=True)


@pytest.mark.parametrize(
    "f", [Integer(1), x**3, x * w + 2, sin(x), cos(2 * x), sin(x) ** 2 * cos(x) ** 2, w * cos(x) ** 3]
)
def test_an_antiderivative_has_the_derivative_that_it_should(f: Any) -> None:
    assert simplify(antiderivative(f, x).diff(x) - f) == 0


def test_what_is_of_no_known_kind_has_none() -> None:
    assert antiderivative(1 / (1 + x**2), x) is None
    assert definite(1 / (1 + x**2), [(x, Integer(0), Integer(1))]) is None


@pytest.mark.parametrize("m", range(5))
@pytest.mark.parametrize("n", range(5))
def test_the_recurrence_of_wallis_is_the_integral(m: int, n: int) -> None:
    assert simplify(integrate(sin(u) ** m * cos(u) ** n, (u, -pi / 2, pi / 2)) - sine_and_cosine_integral(m, n)) == 0


@pytest.mark.parametrize(("m", "k"), [(0, 1), (2, 1), (0, 3), (1, 1), (4, 1), (2, 3)])
def test_a_chord_integral_is_the_numerical_one(m: int, k: int) -> None:
    exact = definite(y**m * (w**2 - y**2) ** Rational(k, 2), [(y, -w, w)])
    width = Rational(13, 10)
    numerical = Integral(y**m * (width**2 - y**2) ** Rational(k, 2), (y, -width, width)).evalf(20)
    assert abs(exact.subs(w, width) - numerical) < 1e-12


def test_the_cross_sections_of_a_cone_add_up_to_its_volume() -> None:
    r = R * (h - z) / h
    half = sqrt(r**2 - y**2)
    assert definite(Integer(1), [(x, -half, half), (y, -r, r), (z, Integer(0), h)]) == pi * R**2 * h / 3


def test_a_radius_that_may_be_negative_gives_no_value() -> None:
    """y = w sin u needs w >= 0; here w changes its sign within the outer limits."""
    r = R * (h - z) / h
    limits = [(y, -r, r), (z, Integer(0), 2 * h)]
    assert definite(sqrt(r**2 - y**2), limits) is None
    assert explicit(Integral(sqrt(r**2 - y**2), *limits)) is nan


@pytest.mark.parametrize(
    "value",
    [x**3 * sin(2 * x), x**2 * cos(3 * x + 1), x**4 * exp(-x / 2), x * exp(x), 1 / x, x ** Rational(3, 2), x**-3],
)
def test_powers_with_a_sine_or_an_exponential_are_integrated_by_parts(value: Any) -> None:
    assert (antiderivative(value, x).diff(x) - value).expand() == 0


def test_what_has_no_simple_antiderivative_gives_none() -> None:
    assert antiderivative(exp(-(x**2)), x) is None
    assert antiderivative(x ** Rational(1, 2) * exp(x), x) is None


def test_an_odd_power_of_a_sine_is_integrated_as_a_polynomial_in_the_cosine() -> None:
    assert antiderivative(sin(x) ** 3, x) == cos(x) ** 3 / 3 - cos(x)
    assert antiderivative(sin(2 * x) ** 2 * cos(2 * x), x) == sin(2 * x) ** 3 / 6
    assert antiderivative(sin(x) * cos(x), x) == sin(x) ** 2 / 2
