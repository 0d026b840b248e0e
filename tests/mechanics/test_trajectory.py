"""A motion followed in numbers: what it confirms, and what it refuses."""

from __future__ import annotations

import pytest
from sympy import Expr, Integer, Rational, cos, sin, sqrt, symbols

from derive.algebra.equality import Grade
from derive.algebra.expressions import TIME, rate, scalar
from derive.mechanics.motion.trajectory import followed

theta, phi, x = scalar("theta"), scalar("phi"), scalar("x")
g, l = symbols("g l", positive=True)
theta_dot, phi_dot = rate(theta), rate(phi)

# Taylor, *Classical Mechanics*, problem 7.40: the spherical pendulum, theta counted from the downward vertical.
PENDULUM = {
    rate(theta, 2): -g / l * sin(theta) + phi_dot**2 * sin(theta) * cos(theta),
    rate(phi, 2): -2 * phi_dot * theta_dot * cos(theta) / sin(theta),
}
ENERGY = (theta_dot**2 + sin(theta) ** 2 * phi_dot**2) / 2 - g / l * cos(theta)
MOMENTUM = sin(theta) ** 2 * phi_dot


@pytest.mark.parametrize(
    ("value", "its_rate"),
    [
        (ENERGY, Integer(0)),
        (MOMENTUM, Integer(0)),
        (cos(theta), -sin(theta) * theta_dot),
        (TIME * theta, theta + TIME * theta_dot),
        (sqrt(sin(theta) - 2), cos(theta) * theta_dot / (2 * sqrt(sin(theta) - 2))),
    ],
    ids=str,
)
def test_the_change_along_a_motion_is_the_integral_of_the_rate(value: Expr, its_rate: Expr) -> None:
    assert followed(value, its_rate, PENDULUM).grade is Grade.APPROXIMATION


@pytest.mark.parametrize(
    ("value", "its_rate"),
    [
        (ENERGY, g / 10**6),
        (MOMENTUM, theta_dot / 10**7),
        (cos(theta), sin(theta) * theta_dot),
        (ENERGY + MOMENTUM, -MOMENTUM),
    ],
    ids=str,
)
def test_another_rate_is_refused_however_small_the_difference(value: Expr, its_rate: Expr) -> None:
    verdict = followed(value, its_rate, PENDULUM)
    assert verdict.grade is Grade.REFUTED
    assert {name for name, _ in verdict.point} >= {"theta", "theta_dot"}


def test_a_motion_of_high_frequency_takes_shorter_steps() -> None:
    waves = {rate(x, 2): -(40**2) * x}
    assert followed(rate(x) ** 2 + 1600 * x**2, Integer(0), waves)
    assert not followed(rate(x) ** 2 + 1601 * x**2, Integer(0), waves)


def test_a_motion_that_runs_to_infinity_before_the_end_confirms_nothing() -> None:
    """x'' = 600 (x^2 + x'^2) has a pole long before t = 1, from where no number comes back."""
    assert not followed(x, rate(x) + Rational(1, 10**9), {rate(x, 2): 600 * x**2 + 600 * rate(x) ** 2})
