"""The symmetric top: what it says about itself, in letters and with numbers, at every tilt."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Integer, Rational, Symbol, cos, pi, sin, sqrt

from derive.algebra.equality import Grade
from derive.algebra.expressions import PLUS_MINUS, Relation, explicit, rate, scalar
from derive.errors import Rejected
from derive.mechanics import (
    precession_condition,
    precession_rates,
    roots_of,
    steady_precession,
    steady_rates,
    turning_rate,
)
from derive.steps.establish import Lines, establish
from derive.steps.known_numbers import sign_known
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity
from tests.mechanics.spinning_top import S, a, g, m, motion_of, sleeping
from tests.mechanics.verbs import verbs_as_imported

DISC_ON_ROD = {a: Rational(1, 10), g: Rational(49, 5), S: 30 * pi}
phi_dot, theta = scalar("phi_dot"), scalar("theta")


@pytest.fixture(scope="module")
def top() -> SimpleNamespace:
    return motion_of(verbs_as_imported())


@pytest.fixture(scope="module")
def steady(top: SimpleNamespace) -> Quantity:
    return steady_precession(top.tilt)


def at(steady: Quantity, tilt: Any, numbers: dict[Symbol, Any] | None = None) -> tuple[Quantity, Quantity, Quantity]:
    with recorded(Run(numbers=numbers or {})):
        rates = precession_rates(steady, tilt)
        return rates, *steady_rates(rates, precession_condition(rates, S))


def test_the_disc_on_the_rod_has_the_moments_of_the_book(top: SimpleNamespace) -> None:
    mass, distance, across, along = (q.value for q in top.top.values)
    assert (mass, distance) == (3 * m / 2, a / 2)
    assert (along, across) == (m * a**2 / 2, 2 * m * a**2 / 3)


def test_the_tilt_obeys_the_equation_of_fowles_and_cassiday(top: SimpleNamespace) -> None:
    M, l, I_x, I_z = (q.symbol for q in top.top.values)
    theta_ddot = rate(theta, 2)
    expected = (
        I_x * theta_ddot
        + I_z * S * phi_dot * sin(theta)
        - I_x * phi_dot**2 * sin(theta) * cos(theta)
        - M * g * l * sin(theta)
    )
    assert (top.tilt.value.left - expected).expand() == 0


def test_steady_precession_is_a_quadratic_in_its_rate(top: SimpleNamespace, steady: Quantity) -> None:
    M, l, I_x, I_z = (q.symbol for q in top.top.values)
    assert (steady.value.left - (I_x * cos(theta) * phi_dot**2 - I_z * S * phi_dot + M * g * l)).expand() == 0


def test_at_45_degrees_there_are_two_rates_and_their_numbers_are_these(steady: Quantity) -> None:
    rates, slow, fast = at(steady, pi / 4, DISC_ON_ROD)
    assert rates.step.outcome == "two"
    both = 3 * sqrt(2) / 8 * (S + PLUS_MINUS * sqrt(S**2 - 4 * sqrt(2) * g / a))
    assert (explicit(rates.value) - both).expand() == 0
    numbers = [float(explicit(rate.value).subs(DISC_ON_ROD)) for rate in (slow, fast)]
    assert numbers == pytest.approx([1.5848446, 98.3800215], abs=1e-6)
    assert [each * 30 / float(pi) for each in numbers] == pytest.approx([15.134, 939.460], abs=1e-3)


def test_the_condition_for_two_rates_is_solved_for_the_spin(steady: Quantity) -> None:
    condition = precession_condition(precession_rates(steady, pi / 4), S)
    assert condition.value.left == S and condition.value.mark == ">="
    assert (condition.value.right**2 - 4 * sqrt(2) * g / a).expand() == 0


def test_a_spin_below_the_threshold_has_no_steady_precession(steady: Quantity) -> None:
    rates, slow, fast = at(steady, pi / 4, {**DISC_ON_ROD, S: 20 * pi / 3})
    assert rates.step.outcome == "none"
    assert slow is fast
    assert slow.step.stands_for == ("slow_precession", "fast_precession")
    assert isinstance(slow.value, Relation) and slow.value.mark == "<"


def test_at_the_threshold_the_two_rates_coincide(steady: Quantity) -> None:
    rates, slow, fast = at(steady, pi / 3, {a: Rational(1, 10), g: Integer(10), S: Integer(20)})
    assert rates.step.outcome == "double"
    assert slow is fast and slow.step.outcome == "coinciding"
    assert explicit(slow.value).subs({a: Rational(1, 10), g: 10, S: 20}) == 15


def test_a_horizontal_axis_has_one_rate(steady: Quantity) -> None:
    rates, slow, fast = at(steady, pi / 2)
    assert rates.step.outcome == "linear"
    assert rates is slow is fast
    assert rates.value == 3 * g / (2 * a * S)


def test_below_the_horizontal_one_rate_goes_forward_and_one_backward_at_any_spin(steady: Quantity) -> None:
    rates, slow, fast = at(steady, 2 * pi / 3)
    assert (rates.step.outcome, slow.step.outcome, fast.step.outcome) == ("opposite", "forward", "backward")
    numbers = {a: 1, g: 1, S: Rational(1, 100)}
    assert explicit(slow.value).subs(numbers) > 0 > explicit(fast.value).subs(numbers)
    assert precession_condition(rates, S).step.outcome == "always"


def test_a_reversed_spin_reverses_both_rates(top: SimpleNamespace, steady: Quantity) -> None:
    verbs = verbs_as_imported()
    turning = verbs.conserved_momentum(top.L, top.angles.psi)
    spin = verbs.constant_spin(top.omega, -S, turning, top.top)
    tilt = verbs.tilt_equation(verbs.equation_of_motion(top.L, top.angles.theta), spin, top.top, g)
    _, slow, fast = at(steady_precession(tilt), pi / 4, DISC_ON_ROD)
    _, slow_before, fast_before = at(steady, pi / 4, DISC_ON_ROD)
    assert (explicit(slow.value) + explicit(slow_before.value)).expand() == 0
    assert (explicit(fast.value) + explicit(fast_before.value)).expand() == 0


def test_a_tilt_in_letters_leaves_the_square_of_the_spin(steady: Quantity) -> None:
    rates, slow, fast = at(steady, theta)
    condition = precession_condition(rates, S)
    assert rates.step.outcome == "conditional"
    assert (slow.step.outcome, fast.step.outcome) == ("slow_where_real", "fast_where_real")
    assert condition.step.outcome == "squared"
    assert condition.value == Relation(S**2, ">=", 8 * g * cos(theta) / a)


@pytest.mark.parametrize("tilt", [Integer(0), pi])
def test_a_vertical_axis_has_no_rate_of_precession(steady: Quantity, tilt: Any) -> None:
    with pytest.raises(Rejected, match="the axis is vertical"):
        precession_rates(steady, tilt)


def test_every_line_of_precession_is_proved(steady: Quantity) -> None:
    for quantity in at(steady, pi / 6, DISC_ON_ROD):
        assert {evidence.grade for evidence in quantity.step.evidence} == {Grade.PROVED}


def test_the_top_sleeps_at_the_border_too() -> None:
    found = sleeping(verbs_as_imported())
    assert found.step.outcome == "with_border"
    assert found.value.mark == ">="
    assert found.value.right.subs(DISC_ON_ROD) == 28


def test_a_tilt_that_is_given_is_a_definition(steady: Quantity) -> None:
    held = next(parent for parent in precession_rates(steady, pi / 4).parents if parent.key == "tilt")
    assert (held.symbol, held.value) == (theta, pi / 4)
    assert [evidence.grade for evidence in held.step.evidence] == [Grade.DEFINITION]


def test_the_energy_wants_an_angular_velocity_in_eulers_angles(top: SimpleNamespace) -> None:
    verbs = verbs_as_imported()
    with pytest.raises(Rejected, match="Euler's angles"):
        verbs.top_kinetic_energy(top.top, verbs.any_angular_velocity())


def test_turning_about_the_axis_alone_is_along_it(top: SimpleNamespace) -> None:
    still = turning_rate(top.angles).value.subs({rate(theta): 0, phi_dot: 0})
    assert list(still) == [0, 0, rate(scalar("psi"))]


def test_only_quadratic_equations_have_these_roots() -> None:
    x = scalar("x")
    cubic = establish(
        "equations.let",
        None,
        lambda: Relation(x**3 - 1, "=", 0),
        {},
        outcome="equation",
        key="cubic",
        definition=True,
        lines=Lines(arranged=explicit),
    )
    with pytest.raises(Rejected, match="not a linear or quadratic equation in x"):
        roots_of(cubic, x)


def test_the_sign_of_an_expression_is_told_by_its_letters_or_else_by_their_numbers() -> None:
    b = Symbol("b", real=True)
    assert (sign_known(a * g), sign_known(-a), sign_known(b), sign_known(a - a)) == (1, -1, None, 0)
    with recorded(Run(numbers={b: Integer(-2)})):
        assert (sign_known(b), sign_known(a * b), sign_known(b + 2)) == (-1, -1, 0)
    assert sign_known(b) is None
