"""The time of a quarter of a swing, in powers of its amplitude."""

from __future__ import annotations

import pytest
from sympy import Expr, Integer, Rational, cos, elliptic_k, nan, pi, series, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expansion import NoExpansion
from derive.algebra.expressions import explicit
from derive.algebra.period_series import SwingTime, quarter_swing

q, A = symbols("q A", real=True)
w, c = symbols("omega c", positive=True)


def test_a_harmonic_oscillator_needs_the_same_time_whatever_its_amplitude() -> None:
    assert equal(quarter_swing(w**2 * (A**2 - q**2), q, A, 4), pi / (2 * w))


@pytest.mark.parametrize("order", [0, 2, 4, 6])
def test_the_pendulum_swings_as_the_elliptic_integral_says(order: int) -> None:
    """Landau, Lifshitz, section 11, problem 1: T/4 = K(sin^2(A/2))/omega; K by SymPy's series."""
    expected = series(elliptic_k(sin(A / 2) ** 2), A, 0, order + 1).removeO()
    assert equal(quarter_swing(2 * w**2 * (cos(q) - cos(A)), q, A, order), expected / w)


def test_a_stiffening_spring_swings_faster() -> None:
    """Landau, Lifshitz, section 28: omega grows by 3 c A^2/(8 omega) for the force -omega^2 q - c q^3."""
    f = w**2 * (A**2 - q**2) + c * (A**4 - q**4) / 2
    assert equal(quarter_swing(f, q, A, 2), pi / (2 * w) * (1 - Rational(3, 8) * c * A**2 / w**2))


@pytest.mark.parametrize("f", [w**2 * (A - q), w**2 * (A**2 - q**2) + 1, c * (A**4 - q**4)])
def test_what_is_no_swing_about_zero_is_refused(f: Expr) -> None:
    with pytest.raises(NoExpansion):
        quarter_swing(f, q, A, 2)


def test_the_node_stands_for_its_terms_or_for_nothing() -> None:
    assert equal(explicit(SwingTime(w**2 * (A**2 - q**2), q, A, Integer(2))), pi / (2 * w))
    assert explicit(SwingTime(w**2 * (A - q), q, A, Integer(2))) is nan
    assert sqrt(w**2) == w
