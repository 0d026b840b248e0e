"""Extrema of a curve: found from its exact derivative, and believed only if the curve agrees."""

from __future__ import annotations

from math import pi, tan

import pytest
from sympy import Integer, Rational, Symbol, cos, diff, exp, log, sin, tanh

from derive.errors import Rejected, Unverified
from derive.figures import extrema as module
from derive.figures.extrema import MAXIMUM, MINIMUM, extrema, values_along

x = Symbol("x", real=True)


def kinds(expr: object, lower: float = -1.5, upper: float = 1.5) -> list[str]:
    return [found.kind for found in extrema(expr, x, lower, upper)]


def slab_energy(radius: Rational, thickness: Rational) -> object:
    """Of a slab of one kilogram on a cylinder, in metres and joules."""
    return Rational(98, 10) * (radius * x * sin(x) + (radius + thickness / 2) * cos(x))


def test_extrema_alternate_along_a_cosine() -> None:
    found = extrema(cos(x), x, -4, 4)
    assert [each.kind for each in found] == [MINIMUM, MAXIMUM, MINIMUM]
    assert [each.at for each in found] == pytest.approx([-pi, 0, pi], abs=1e-12)
    assert [each.value for each in found] == pytest.approx([-1, 1, -1])


def test_a_zero_in_the_middle_of_a_symmetric_range_is_found_once() -> None:
    found = extrema(x**2, x, -1, 1)
    assert [(each.at, each.value, each.kind) for each in found] == [(0.0, 0.0, MINIMUM)]


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


def test_a_curve_that_only_rises_has_no_extremum() -> None:
    assert kinds(tanh(x)) == []
    assert kinds(exp(x)) == []
    assert kinds(x**3) == [], "its slope vanishes and does not change its sign"


def test_a_wrong_derivative_is_refused_by_the_curve(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "diff", lambda expr, variable: -diff(expr, variable))
    with pytest.raises(Unverified, match="the curve has no maximum"):
        extrema(x**2, x, -1, 1)
    monkeypatch.setattr(module, "diff", lambda expr, variable: diff(expr, variable) - Rational(1, 2))
    with pytest.raises(Unverified, match="the curve has no minimum"):
        extrema(x**2, x, -1, 1)


def test_points_of_a_curve_are_evenly_spaced_and_on_it() -> None:
    assert values_along(x**2, x, 0, 1, 2) == [(0.0, 0.0), (0.5, 0.25), (1.0, 1.0)]


@pytest.mark.parametrize("expr", [log(x), 1 / x, (x - Integer(2)) ** Rational(1, 2)])
def test_a_curve_that_is_not_real_is_refused(expr: object) -> None:
    with pytest.raises(Rejected, match="not real and finite"):
        values_along(expr, x, -1, 1, 2)
