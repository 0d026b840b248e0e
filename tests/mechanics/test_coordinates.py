"""Coordinates, their rates, and the chain rule beside SymPy's own derivative of functions of time."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Derivative, Expr, Function, Integer, Matrix, Symbol, cos, exp, log, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TimeRate, explicit, rate, scalar
from derive.errors import Rejected
from derive.mechanics import equation_of_motion, rate_of, slope
from derive.mechanics.kinematics.coordinates import T as time
from derive.mechanics.kinematics.coordinates import by_functions_of_time, changing, kind_of_rate, letters_of, unchanging
from tests.mechanics.motion import THETA, X, of_system, position
from tests.mechanics.slab import known_slab

q, q_dot, q_ddot = THETA.symbol, THETA.rate, THETA.acceleration
x, x_dot = X.symbol, X.rate
c = symbols("c", positive=True)


def test_a_coordinate_is_real_and_its_rates_carry_its_name() -> None:
    assert q.is_real and q.is_positive is None
    assert (q_dot.name, q_ddot.name) == ("theta_dot", "theta_ddot")
    assert q_dot == rate(q) and q_ddot == rate(q, 2)


def test_coordinates_bring_their_kinds_along() -> None:
    assert letters_of([THETA, X]) == {q: "angle", x: "length"}


@pytest.mark.parametrize(
    ("kind", "faster"),
    [("length", "speed"), ("speed", "acceleration"), ("angle", "angular speed"), ("number", "angular speed")],
)
def test_the_rate_of_a_kind_is_a_kind(kind: str, faster: str) -> None:
    assert kind_of_rate(kind) == faster


def test_a_rate_that_has_no_name_is_refused() -> None:
    with pytest.raises(Rejected, match="is the rate of a quantity of the kind `volume`"):
        kind_of_rate("volume")


@pytest.mark.parametrize(
    ("expr", "expected"),
    [
        (c * q, c * q_dot),
        (sin(q), cos(q) * q_dot),
        (q * q_dot, q_dot**2 + q * q_ddot),
        (x * sin(q), x_dot * sin(q) + x * cos(q) * q_dot),
        (c, 0),
        (exp(q / 2) * log(1 + x**2), exp(q / 2) * (log(1 + x**2) * q_dot / 2 + 2 * x * x_dot / (1 + x**2))),
    ],
)
def test_the_chain_rule_and_functions_of_time_agree(expr: Expr, expected: Any) -> None:
    assert equal(explicit(TimeRate(expr, q, x)), expected)
    assert equal(by_functions_of_time(expr, [q, x]), expected)


def test_a_letter_that_is_no_coordinate_stays_as_it_is() -> None:
    assert by_functions_of_time(x * q, [q]) == x * q_dot


def test_the_second_derivative_has_accelerations_and_squares_of_rates() -> None:
    assert equal(by_functions_of_time(sin(q), [q], 2), cos(q) * q_ddot - sin(q) * q_dot**2)


def test_vectors_are_differentiated_entry_by_entry() -> None:
    assert by_functions_of_time(Matrix([q, q**2]), [q]) == Matrix([q_dot, 2 * q * q_dot])


@settings(max_examples=25, deadline=None, derandomize=True)
@given(st.lists(st.integers(-3, 3), min_size=4, max_size=4))
def test_a_motion_put_in_before_or_after_differentiating_is_the_same(numbers: list[int]) -> None:
    """q = a + b t + c t^2 + d t^3 at t = 1/2, in q^2 sin q."""
    motion = sum((n * time**k for k, n in enumerate(numbers)), Integer(0))
    found = by_functions_of_time(q**2 * sin(q), [q])
    put_in = found.subs({q_dot: motion.diff(time), q: motion})
    directly = (motion**2 * sin(motion)).diff(time)
    assert abs((put_in - directly).subs(time, Integer(1) / 2).evalf()) < 1e-9


def test_names_become_functions_of_time_and_come_back() -> None:
    expr = q_ddot * sin(q) + q_dot**2 * x
    f = Function("theta")(time)
    assert changing(expr, [q]) == Derivative(f, (time, 2)) * sin(f) + Derivative(f, time) ** 2 * x
    assert unchanging(changing(expr, [q, x]), [q, x]) == expr


def test_what_does_not_change_has_no_rate() -> None:
    still = rate_of(position("Y", c, THETA))
    assert (still.value, still.step.outcome) == (0, "zero")
    assert rate_of(position("Y", c * q, THETA)).step.outcome == "generic"


def test_a_rate_is_named_for_its_quantity_and_has_the_kind_of_a_rate() -> None:
    speed = rate_of(position("y", c * sin(q), THETA))
    assert (speed.symbol, speed.key, speed.step.kind) == (Symbol("y_dot", real=True), "y_rate", "speed")
    acceleration = rate_of(speed)
    assert acceleration.symbol == rate(scalar("y"), 2)
    assert (acceleration.key, acceleration.step.kind) == ("y_rate_rate", "acceleration")


def test_what_has_no_letter_takes_no_dot() -> None:
    L = of_system(c * sin(q), -c * cos(q), THETA)
    with pytest.raises(Rejected, match="`rate_of` needs a scalar with a plain symbol, but `equation_of_motion` is"):
        rate_of(equation_of_motion(L, THETA))
    with pytest.raises(Rejected, match="needs a scalar with a plain symbol, but `frequency_squared`"):
        rate_of(known_slab()["frequency_squared"])


def test_a_quantity_of_several_coordinates_or_of_none_has_no_single_one() -> None:
    with pytest.raises(Rejected, match="`y` must depend on one coordinate, but depends on theta, x"):
        slope(position("y", x * sin(q), THETA, X))
    with pytest.raises(Rejected, match="`y` must depend on one coordinate, but depends on none"):
        slope(position("y", c, THETA))
