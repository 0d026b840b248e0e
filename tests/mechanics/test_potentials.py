"""The shape of a potential energy: beads on wires of every form, and the slab on its border."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Expr, Rational, cos, cosh, pi, sin, symbols

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import Relation
from derive.errors import Rejected
from derive.mechanics import extreme_value, leading_order, slope, stability
from derive.steps.step import Quantity
from tests.mechanics.motion import THETA, X, b, g, l, m, potential
from tests.mechanics.slab import M, R, a, known_slab

q, x = THETA.symbol, X.symbol
c = symbols("c", real=True)


def bead(height: Expr) -> Quantity:
    return potential(x, height, X)


PENDULUM = potential(l * sin(q), -l * cos(q), THETA)


def test_slope_and_curvature_are_derivatives() -> None:
    assert slope(PENDULUM).value == m * g * l * sin(q)
    assert slope(PENDULUM, 2).value == m * g * l * cos(q)
    assert equal(slope(PENDULUM, 3).value, -m * g * l * sin(q))
    assert [slope(PENDULUM, n).step.outcome for n in (1, 2, 3)] == ["slope", "curvature", "higher"]


def test_less_the_slope_is_the_force_where_nothing_moves() -> None:
    found = known_slab()
    force = found["force_theta"].value.subs(THETA.rate, 0)
    assert equal(found["potential_energy_slope"].value, -force)


@pytest.mark.parametrize(("place", "value", "outcome"), [(0, m * g * l, "stable"), (pi, -m * g * l, "unstable")])
def test_a_pendulum_is_stable_below_and_unstable_above(place: Any, value: Expr, outcome: str) -> None:
    found = stability(PENDULUM, {THETA: place})
    assert (found.value, found.step.outcome) == (value, outcome)


def test_a_curvature_of_unknown_sign_is_conditional() -> None:
    assert known_slab()["curvature"].step.outcome == "depends_unstable_on_border"


def test_where_the_potential_is_not_level_there_is_no_equilibrium() -> None:
    with pytest.raises(Rejected) as refusal:
        leading_order(PENDULUM, at=pi / 2)
    (complaint,) = refusal.value.complaints
    assert complaint.code == "no-equilibrium"
    assert complaint.message == "`potential_energy` is not stationary at theta = pi/2"


@pytest.mark.parametrize(
    ("height", "order", "outcome"),
    [
        (x**2 / b, 2, "minimum"),
        (-(x**2) / b, 2, "maximum"),
        (x**3 / b**2, 3, "inflection"),
        (x**4 / b**3, 4, "minimum"),
        (b * cos(x / b) + x**2 / (2 * b), 4, "minimum"),
        (b * cosh(x / b), 2, "minimum"),
        (c * x**2, 2, "conditional"),
        (c * x**3, 3, "inflection"),
        (x**5 / b**4 - x**6 / b**5, 5, "inflection"),
    ],
)
def test_the_lowest_order_decides(height: Expr, order: int, outcome: str) -> None:
    found = leading_order(bead(height))
    assert found.step.outcome == outcome
    assert found.step.result.args[3] == order


def test_what_is_level_to_the_eighth_order_is_not_decided() -> None:
    found = leading_order(bead(x**10 / b**9))
    assert found.step.outcome == "flat"
    assert Grade.APPROXIMATION not in {e.grade for e in found.step.evidence}


def test_a_higher_derivative_of_unknown_sign_decides_nothing_and_is_told() -> None:
    open_, level = stability(bead(c * x**4), {X: 0}), stability(bead(x**10 / b**9), {X: 0}, key="level")
    assert (open_.step.outcome, level.step.outcome) == ("flat", "flat")
    assert equal(dict(open_.step.roles)["higher"], 24 * m * g * c)
    assert "higher" not in dict(level.step.roles)


def test_near_another_equilibrium_the_series_is_in_the_distance_from_it() -> None:
    found = leading_order(PENDULUM, at=pi)
    assert found.step.outcome == "maximum"
    assert equal(found.step.result.args[0], m * g * l - m * g * l * (q - pi) ** 2 / 2)


# --- the slab ---


def test_on_the_border_the_fourth_order_decides_that_the_slab_is_unstable() -> None:
    found = known_slab()["leading_order"]
    assert found.step.outcome == "maximum_at_bound"
    assert equal(found.step.result.args[0], M * symbols("g", positive=True) * a * (1 - q**4 / 24))


@pytest.mark.parametrize(("radius", "outcome"), [(2 * a, "minimum"), (a / 4, "maximum"), (a / 2, "maximum")])
def test_away_from_letters_the_slab_is_decided_at_once(radius: Any, outcome: str) -> None:
    assert known_slab(radius=radius)["leading_order"].step.outcome == outcome


def test_a_stable_slab_has_another_equilibrium_to_either_side_and_a_thick_one_has_none() -> None:
    """tan(theta) = 2 R theta/a has a root below a quarter turn for 2R > a, beyond which the slab falls off."""
    slope_of = known_slab()["potential_energy_slope"].value
    stable = slope_of.subs({R: Rational(1), a: Rational(1), M: 1, symbols("g", positive=True): 1})
    assert stable.subs(q, Rational(1, 2)).evalf() > 0 > stable.subs(q, Rational(3, 2)).evalf()
    unstable = slope_of.subs({R: Rational(1, 4), a: Rational(1), M: 1, symbols("g", positive=True): 1})
    assert all(unstable.subs(q, Rational(n, 10)).evalf() < 0 for n in range(1, 16))


def test_a_border_may_be_given_by_hand() -> None:
    potential = known_slab()["potential_energy"]
    assert leading_order(potential, where=Relation(R, "=", a / 2)).step.outcome == "maximum_at_bound"


def test_a_case_in_which_the_curvature_does_not_vanish_is_no_border() -> None:
    with pytest.raises(Rejected, match="not a boundary"):
        leading_order(known_slab()["potential_energy"], where=Relation(R, "=", 2 * a))


@pytest.mark.parametrize(("place", "outcome"), [(0, "minimum"), (pi, "maximum")])
def test_a_value_where_the_slope_vanishes_is_a_minimum_or_a_maximum(place: Any, outcome: str) -> None:
    found = extreme_value(PENDULUM, at=place + 0 * q)
    assert (found.step.outcome, found.value) == (outcome, -m * g * l if place == 0 else m * g * l)


@pytest.mark.parametrize(("height", "outcome"), [(c * x**2, "conditional"), (x**4 / b**3, "level")])
def test_a_value_may_be_neither(height: Expr, outcome: str) -> None:
    assert extreme_value(bead(height)).step.outcome == outcome


def test_on_a_slope_there_is_no_extreme_value() -> None:
    with pytest.raises(Rejected, match="is not stationary at theta = 1"):
        extreme_value(PENDULUM, at=Rational(1))
