"""Textbook forms of results."""

from __future__ import annotations

from sympy import cos, sin, symbols

from derive.solving.presentation import presented, without_sine_below

A, C, s, p = symbols("A C s p", positive=True)
theta = symbols("theta", real=True)


def test_a_sine_leaves_the_denominator_only_if_something_cancels() -> None:
    assert without_sine_below((1 - cos(theta)) ** 2 / sin(theta) ** 2) == (1 - cos(theta)) / (1 + cos(theta))
    effective = (p - C * s * cos(theta)) ** 2 / (2 * A * sin(theta) ** 2) + C * s**2 / 2
    assert presented(effective).has(sin(theta) ** -2)
