"""Tests of the extrema of curves, and of the errors for expressions that have no curve."""

from __future__ import annotations

from math import pi, tan

import pytest
from sympy import Abs, Expr, Integer, Rational, cos, diff, exp, log, sin, sqrt, symbols, tanh

from derive.errors import Rejected, Unverified
from derive.figures import extrema as module
from derive.figures.extrema import MAXIMUM, MINIMUM, extrema, meetings, values_along, zeros

x = symbols("x", real=True)


def slab_energy(radius: Rational, thickness: Rational) -> object:
    return Rational(98, 10) * (radius * x * sin(x) + (radius + thickness / 2) * cos(x))


@pytest.mark.parametrize(
    ("expr", "found"),
    [
        (x**2, [(0, 0, MINIMUM)]),
        (x**3 - 3 * x, [(-1, 2, MAXIMUM), (1, -2, MINIMUM)]),
        (sin(x), [(-pi / 2, -1, MINIMUM), (pi / 2, 1, MAXIMUM)]),
        (exp(x), []),
        (tanh(x), []),
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
    assert extrema(sin(x), x, 0, pi / 2) == ()


def test_points_of_a_curve_are_evenly_spaced_with_both_ends() -> None:
    assert values_along(x**2, x, -1, 1, 4) == [(-1, 1), (-0.5, 0.25), (0, 0), (0.5, 0.25), (1, 1)]


@pytest.mark.parametrize("expr", [1 / x, sqrt(x), log(Abs(x)), exp(1000 * x + 800), symbols("k") * x], ids=str)
def test_a_curve_that_is_not_real_and_finite_throughout_is_refused(expr: Expr) -> None:
    with pytest.raises(Rejected, match="is not real and finite over its whole range"):
        values_along(expr, x, -1, 1, 4)


def test_extrema_alternate_along_a_cosine() -> None:
    found = extrema(cos(x), x, -4, 4)
    assert [each.kind for each in found] == [MINIMUM, MAXIMUM, MINIMUM]
    assert [each.at for each in found] == pytest.approx([-pi, 0, pi], abs=1e-12)
    assert [each.value for each in found] == pytest.approx([-1, 1, -1])


def test_a_thin_slab_on_a_wide_cylinder_has_its_minimum_upright() -> None:
    (found,) = extrema(slab_energy(Rational(1, 5), Rational(1, 20)), x, -1.4, 1.4)
    assert (found.at, found.kind) == (0.0, MINIMUM)
    assert found.value == pytest.approx(9.8 * 0.225)


def test_a_thick_slab_on_a_narrow_cylinder_has_its_maximum_upright() -> None:
    (found,) = extrema(slab_energy(Rational(1, 10), Rational(3, 10)), x, -1.4, 1.4)
    assert (found.at, found.kind) == (0.0, MAXIMUM)
    assert found.value == pytest.approx(9.8 * 0.25)


def test_a_stable_slab_tips_over_where_the_tangent_says_so() -> None:
    """R x cos x = (a/2) sin x: tan x = 2 R x/a."""
    radius, thickness = Rational(1, 5), Rational(3, 10)
    low, top, high = extrema(slab_energy(radius, thickness), x, -1.5, 1.5)
    assert (low.kind, top.kind, high.kind) == (MAXIMUM, MINIMUM, MAXIMUM)
    assert tan(high.at) == pytest.approx(float(2 * radius / thickness) * high.at)
    assert low.at == pytest.approx(-high.at)


def test_a_wrong_derivative_is_refused_by_the_curve(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "diff", lambda expr, variable: -diff(expr, variable))
    with pytest.raises(Unverified, match="the curve has no maximum"):
        extrema(x**2, x, -1, 1)
    monkeypatch.setattr(module, "diff", lambda expr, variable: diff(expr, variable) - Rational(1, 2))
    with pytest.raises(Unverified, match="the curve has no minimum"):
        extrema(x**2, x, -1, 1)


@pytest.mark.parametrize("place", [Rational(1, 2), Rational(7, 22), Integer(0)])
def test_a_pole_inside_the_range_is_an_error(place: Rational) -> None:
    with pytest.raises(Rejected, match="infinite or not real near"):
        extrema(1 / Abs(x - place), x, -1, 2)


def test_two_curves_may_meet_where_they_start() -> None:
    assert meetings(1 + sqrt(x), 1 - sqrt(x), x, 0.0, 1.0) == (0.0,)
    assert meetings(x, 2 * x, x, 0.0, 1.0) == (), "both start from zero"
    assert meetings(x, 1 - x, x, 0.0, 1.0) == (pytest.approx(0.5),)


@pytest.mark.parametrize(
    ("expr", "lower", "upper", "found"),
    [(x, -1, 1, (0,)), (x**2, -1, 1, ()), (x - 1, 0, 1, (1,)), (x, 0, 1, ()), (sin(x), -1.0, 4.0, (0, pi))],
)
def test_a_zero_is_found_wherever_the_curve_is_calculated(
    expr: Expr, lower: float, upper: float, found: tuple[float, ...]
) -> None:
    assert zeros(expr, x, lower, upper) == pytest.approx(found)
