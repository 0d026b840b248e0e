"""Where a curve turns: found between the ends, confirmed by the curve itself, refused where it is no curve."""

from __future__ import annotations

import math

import pytest
from sympy import Abs, Expr, Integer, cos, exp, log, sin, sqrt, symbols

from derive.errors import Rejected, Unverified
from derive.figures import extrema as module
from derive.figures.extrema import MAXIMUM, MINIMUM, extrema, values_along

x = symbols("x", real=True)


@pytest.mark.parametrize(
    ("expr", "found"),
    [
        (x**2, [(0, 0, MINIMUM)]),
        (x**3 - 3 * x, [(-1, 2, MAXIMUM), (1, -2, MINIMUM)]),
        (sin(x), [(-math.pi / 2, -1, MINIMUM), (math.pi / 2, 1, MAXIMUM)]),
        (exp(x), []),
        (x**3, []),
        (Integer(3) * x, []),
        ((x - 1) ** 4, [(1, 0, MINIMUM)]),
        (exp(-((x - 1) ** 2)) * 10**12, [(1, 10**12, MAXIMUM)]),
    ],
    ids=str,
)
def test_every_extremum_within_the_range_is_found(expr: Expr, found: list[tuple[float, float, str]]) -> None:
    turns = extrema(expr, x, -3, 3)
    assert [turn.kind for turn in turns] == [kind for *_, kind in found]
    for turn, (at, value, _) in zip(turns, found, strict=True):
        assert turn.at == pytest.approx(at, abs=1e-3)
        assert turn.value == pytest.approx(value, abs=1e-6)


def test_the_middle_of_a_symmetric_curve_is_exactly_zero() -> None:
    assert extrema(cos(x), x, -1, 1)[0].at == 0.0


def test_what_lies_at_an_end_is_no_extremum() -> None:
    assert extrema(x**2, x, 0, 1) == ()
    assert extrema(sin(x), x, 0, math.pi / 2) == ()


def test_a_turn_that_the_curve_does_not_show_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "diff", lambda expr, letter: -2 * letter)
    with pytest.raises(Unverified, match="the curve has no maximum, though its slope says so"):
        extrema(x**2, x, -1, 1)


def test_points_of_a_curve_are_evenly_spaced_with_both_ends() -> None:
    assert values_along(x**2, x, -1, 1, 4) == [(-1, 1), (-0.5, 0.25), (0, 0), (0.5, 0.25), (1, 1)]


@pytest.mark.parametrize("expr", [1 / x, sqrt(x), log(Abs(x)), exp(1000 * x + 800), symbols("k") * x], ids=str)
def test_a_curve_that_is_not_real_and_finite_throughout_is_refused(expr: Expr) -> None:
    with pytest.raises(Rejected, match="is not real and finite over its whole range"):
        values_along(expr, x, -1, 1, 4)
