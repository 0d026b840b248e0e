"""Places and particles of bodies, with their velocities."""

from __future__ import annotations

import numpy as np
import pytest
from sympy import Rational, symbols

from derive.witness.description import Body, Description, Force
from derive.witness.dynamics import Blueprint, Dynamics
from derive.witness.geometry import State
from tests.witness.systems import g, phi, x, y

M, a, mu = symbols("M a mu", positive=True)
ZERO = Rational(0)
MOMENT = M * a**2 / 5
BALL = Body(M, (x, y), (ZERO, ZERO), ((MOMENT, 0, 0), (0, MOMENT, 0), (0, 0, MOMENT)), ((2, -phi),), (0, 1))
SLIDING = Description(
    ((x, "length"), (y, "length"), (phi, "angle")),
    (),
    (BALL,),
    gravity=g,
    forces=(Force((-mu, ZERO), (x, y - a), body=0),),
)
STATE = State(np.array([1.0, 0.5, 0.3]), np.array([2.0, 0.0, 3.0]))


def sliding() -> Dynamics:
    return Blueprint(SLIDING).with_numbers({M: 2.0, a: 0.5, g: 9.0, mu: 3.0})


def test_a_particle_of_a_body_moves_as_the_body_turns() -> None:
    """v + omega x r: at the lowest point of a ball that turns clockwise by phi."""
    (ball,) = sliding().placed(STATE).bodies
    lowest = np.array([1.0, 0.0])
    assert ball.velocity_at(lowest) == pytest.approx([2 - 0.5 * 3, 0], abs=1e-12)
    assert ball.jacobian_at(lowest) == pytest.approx(np.array([[1, 0, -0.5], [0, 1, 0]]), abs=1e-12)


def test_a_force_on_the_particle_at_the_contact_turns_the_body() -> None:
    """Kleppner, Kolenkow, example 6.17: friction f at the contact gives the angular acceleration f a/I."""
    found = sliding().response(STATE)
    assert found.a[0] == pytest.approx(-1.5, rel=1e-12)
    assert found.a[2] == pytest.approx(3 * 0.5 / (0.4 * 2 * 0.25), rel=1e-10)
