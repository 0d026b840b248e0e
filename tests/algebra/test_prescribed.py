"""Prescribed functions of the time as symbols: derivatives, dimensions, encoding."""

from __future__ import annotations

import pickle

import pytest
from sympy import cos, diff, sin

from derive.algebra.derivatives import derivative
from derive.algebra.encoding import decoded, encoded
from derive.algebra.expressions import TIME, Prescribed, TimeRate, explicit, prescribed_in, rate, scalar
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.taylor import NoSeries, slope, taylor
from derive.errors import Rejected
from derive.steps.homogeneity import dimension_of

X = Prescribed("X", "length")
L = Prescribed("L", "length", above=True)
q = scalar("q")
FORMULA = q * X**2 * sin(X) + X.rate() ** 2 * cos(q) + TIME


def test_the_derivative_by_the_time_includes_the_function() -> None:
    expected = q * X.rate() * (2 * X * sin(X) + X**2 * cos(X)) + 2 * X.rate() * X.rate(2) * cos(q) + 1
    for found in (diff(FORMULA, TIME), derivative(FORMULA, TIME), slope(FORMULA, TIME)):
        assert (found - expected).expand() == 0
    along = explicit(TimeRate(FORMULA, q))
    assert (along - expected - rate(q) * diff(FORMULA, q)).expand() == 0


def test_the_other_variables_do_not_change_the_function() -> None:
    assert derivative(FORMULA, X.rate()) == 2 * X.rate() * cos(q)
    assert diff(X, q) == diff(X.rate(), X) == 0
    assert diff(X, TIME, 2) == X.rate(2) == rate(X, 2)
    assert taylor(q * X, {q: (q, 1)}, 1) == (q * X, X)


def test_a_series_along_another_time_is_unknown() -> None:
    with pytest.raises(NoSeries):
        taylor(X, {TIME: (q, 1)}, 1)


def test_a_rate_belongs_to_its_function() -> None:
    assert L.rate(2).order == 2
    assert L.rate(2).function == L
    assert L.is_positive
    assert L.rate().is_positive is None
    assert prescribed_in(FORMULA) == [X, X.rate()]
    with pytest.raises(Rejected, match="higher order than 3"):
        X.rate(4)


def test_a_function_has_its_dimension_and_survives_encoding() -> None:
    assert dimension_of(X.rate(2), {}) == dimension_of_kind("acceleration")
    for each in (X, L, L.rate()):
        assert decoded(encoded(each)) == each == pickle.loads(pickle.dumps(each))
    assert X not in (scalar("X"), Prescribed("X", "angle"), Prescribed("X", "length", above=True))
