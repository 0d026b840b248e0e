"""Accelerations in numbers against textbooks, which know nothing of places and multipliers."""

from __future__ import annotations

from math import cos as c
from math import sin as s

import numpy as np
import pytest
from sympy import Rational, cos, sin, symbols

from derive.algebra.expressions import TIME, rate, scalar
from derive.witness.description import Body, Charge, Condition, Description, Drag, Force, Pair, Particle
from derive.witness.dynamics import Blueprint, Singular
from derive.witness.geometry import State
from derive.witness.tape import Compiled
from tests.witness.systems import ON_A_STRING, PENDULUM, dynamics, g, l, m, phi, theta, x, y

M, R, w, q, B, b = symbols("M R omega q B b", positive=True)


def at(places: list[float], rates: list[float], time: float = 0.0) -> State:
    return State(np.array(places), np.array(rates), time)


def test_a_pendulum_falls_back() -> None:
    assert dynamics(PENDULUM).response(at([0.4], [2.0])).a[0] == pytest.approx(-9 / 0.7 * s(0.4), rel=1e-11)


def test_a_string_pulls_with_the_weight_and_what_keeps_the_circle() -> None:
    """S = m g cos(theta) + m l theta_dot^2 pulls inwards: with f = l - r its multiplier is positive."""
    found = dynamics(ON_A_STRING).response(at([0.7, 0.4], [0.0, 2.0]))
    assert found.multipliers[0] == pytest.approx(1.3 * 9 * c(0.4) + 1.3 * 0.7 * 4, rel=1e-10)
    assert found.a == pytest.approx([0, -9 / 0.7 * s(0.4)], abs=1e-9)


def test_a_bead_on_a_turning_hoop_feels_the_frame() -> None:
    """Taylor, equation 7.69: theta_ddot = (omega^2 cos(theta) - g/R) sin(theta)."""
    place = (R * sin(theta) * cos(w * TIME), R * sin(theta) * sin(w * TIME), -R * cos(theta))
    of = Description(((theta, "angle"),), (Particle(m, place),), gravity=g)
    found = Blueprint(of).with_numbers({m: 1.3, R: 0.7, g: 9.0, w: 5.0}).response(at([0.4], [1.5], 0.3))
    assert found.a[0] == pytest.approx((25 * c(0.4) - 9 / 0.7) * s(0.4), rel=1e-9)


def test_a_disc_rolls_down_an_incline_at_two_thirds_of_the_slope() -> None:
    slope = Rational(1, 3)
    disc = Body(
        M, (x * cos(slope) + y * sin(slope), y * cos(slope) - x * sin(slope)), (0, 0), _disc(), ((2, -phi),), (0, 1)
    )
    kept = (Condition(y - R, multiplier=scalar("N")), Condition(rate(x) - R * rate(phi), True, scalar("F")))
    of = Description(((x, "length"), (y, "length"), (phi, "angle")), (), (disc,), gravity=g, conditions=kept)
    found = Blueprint(of).with_numbers({M: 2.0, R: 0.5, g: 9.0}).response(at([1, 0.5, 0.2], [1, 0, 2]))
    assert found.a[0] == pytest.approx(2 / 3 * 9 * s(1 / 3), rel=1e-10)
    assert found.multipliers == pytest.approx([2 * 9 * c(1 / 3), -2 * 9 * s(1 / 3) / 3], rel=1e-10)


def _disc() -> tuple[tuple[object, ...], ...]:
    moment = M * R**2 / 4
    return ((moment, 0, 0), (0, moment, 0), (0, 0, 0))


def test_a_top_precesses_as_euler_says() -> None:
    """Moments A, A, C about a fixed point: the torque that holds theta at steady precession, Goldstein 5.7."""
    psi = scalar("psi")
    A, C = Rational(2), Rational(3, 2)
    spread = ((C / 2, 0, 0), (0, C / 2, 0), (0, 0, A - C / 2))
    zero = Rational(0)
    top = Body(M, (zero, zero, zero), (0, 0, 0), spread, ((2, phi), (0, theta), (2, psi)), (0, 1, 2))
    of = Description(((phi, "angle"), (theta, "angle"), (psi, "angle")), (), (top,))
    found = Blueprint(of).with_numbers({M: 1.0}).response(at([0.3, 0.8, 0.1], [1.2, 0.0, 2.0]))
    spin = 2.0 + 1.2 * c(0.8)
    assert found.a[1] == pytest.approx((2 * 1.44 * c(0.8) - 1.5 * spin * 1.2) * s(0.8) / 2, rel=1e-9)


def test_a_charge_is_turned_aside_and_drag_slows_it() -> None:
    of = Description(
        ((x, "length"), (y, "length")),
        (Particle(m, (x, y)),),
        charges=(Charge(q, (x, y), (0, 0), (B,)),),
        drags=(Drag(b, (x, y)),),
    )
    found = Blueprint(of).with_numbers({m: 2.0, q: 1.5, B: 4.0, b: 0.5}).response(at([0, 0], [1.0, 2.0]))
    assert found.a == pytest.approx([(1.5 * 4 * 2 - 0.5) / 2, (-1.5 * 4 - 1.0) / 2], rel=1e-12)


def test_a_spring_pulls_along_its_line() -> None:
    d = scalar("d", positive=True)
    of = Description(((x, "length"),), (Particle(m, (x, 0)),), pairs=(Pair((0, l), (x, 0), d, 2 * (d - l) ** 2),))
    found = dynamics(of).response(at([0.4], [0.0]))
    length = np.hypot(0.4, 0.7)
    assert found.a[0] == pytest.approx(-4 * (length - 0.7) * 0.4 / length / 1.3, rel=1e-12)


def test_friction_goes_with_its_normal_force() -> None:
    N, mu = scalar("N"), symbols("mu", positive=True)
    of = Description(
        ((x, "length"), (y, "length")),
        (Particle(m, (x, y)),),
        gravity=g,
        forces=(Force((-mu * N, 0), (x, y)),),
        conditions=(Condition(y, multiplier=N),),
    )
    found = Blueprint(of).with_numbers({m: 2.0, g: 9.0, mu: 0.25}).response(at([0, 0], [1.0, 0.0]))
    assert found.a[0] == pytest.approx(-0.25 * 9, rel=1e-12)


def test_a_given_lagrangian_moves_by_its_second_derivatives() -> None:
    """A relativistic particle: p = gamma m v changes by the force."""
    L = -m * (1 - rate(x) ** 2) ** Rational(1, 2) - x
    found = dynamics(Description(((x, "length"),), lagrangian=L)).response(at([0.2], [0.6]))
    assert found.a[0] == pytest.approx(-((1 - 0.36) ** 1.5) / 1.3, rel=1e-8)


def test_where_a_mass_vanishes_nothing_is_determined() -> None:
    of = Description(((theta, "angle"),), (Particle(m, (l * sin(theta), 0)),))
    with pytest.raises(Singular):
        dynamics(of).response(at([np.pi / 2], [0.0]))


def test_a_condition_whose_gradient_vanishes_keeps_nothing() -> None:
    of = Description(
        ((x, "length"), (y, "length")), (Particle(m, (x, y)),), gravity=g, conditions=(Condition((x - y) ** 2),)
    )
    with pytest.raises(Singular):
        dynamics(of).response(at([0.5, 0.5], [1.0, 1.0]))


def test_of_two_equal_conditions_one_follows_from_the_other() -> None:
    twice = (Condition(x - y), Condition(2 * x - 2 * y))
    of = Description(((x, "length"), (y, "length")), (Particle(m, (x, y)),), gravity=g, conditions=twice)
    found = dynamics(of).response(at([0.5, 0.5], [1.0, 1.0]))
    assert found.rank == 1
    assert found.a == pytest.approx([-4.5, -4.5], rel=1e-9)


def test_the_results_of_one_state_share_their_derivatives(monkeypatch: pytest.MonkeyPatch) -> None:
    evaluated, call = [], Compiled.__call__
    monkeypatch.setattr(Compiled, "__call__", lambda self, points: (evaluated.append(points), call(self, points))[1])
    system, one, other = dynamics(ON_A_STRING), at([0.7, 0.4], [0.0, 2.0]), at([0.7, 0.8], [0.0, 1.0])
    evaluated.clear()
    for state in (one, other):
        system.gradients(state), system.response(state), system.kinetic_energy(state)
    assert len(evaluated) == 4  # places and conditions of two states
    assert system.kinetic_energy(one) != pytest.approx(system.kinetic_energy(other))
