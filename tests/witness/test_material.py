"""What moves at a place: a particle of a body, a rod to a particle, the ground, or nothing."""

from __future__ import annotations

from sympy import Rational, cos, sin, symbols

from derive.algebra.expressions import TIME
from derive.witness.description import Body, Description, Particle
from derive.witness.material import moving_alone
from tests.witness.systems import PENDULUM, l, m, phi, theta, x, y

a, w, M = symbols("a omega M", positive=True)
ZERO = Rational(0)
SPREAD = ((M * a**2, 0, 0), (0, M * a**2, 0), (0, 0, M * a**2))
BALL = Description(
    ((x, "length"), (y, "length"), (phi, "angle")), (), (Body(M, (x, y), (ZERO, ZERO), SPREAD, ((2, phi),), (0, 1)),)
)


def test_the_contact_of_a_ball_that_slides_is_not_a_particle_of_it() -> None:
    centre, contact, fixed = (x, y), (x, ZERO), (a, ZERO)
    carried = (x + a * cos(phi), y + a * sin(phi))
    assert moving_alone(BALL, [centre, contact, fixed, carried]) == [1]


def test_a_place_above_a_cart_moves_with_it_and_one_beside_its_end_does_not() -> None:
    cart = Description(((x, "length"),), (Particle(m, (x, ZERO)),))
    assert moving_alone(cart, [(x + l, l), (2 * x, ZERO)]) == [1]


def test_a_place_on_a_massless_rod_to_a_particle_may_be_acted_on() -> None:
    halfway, elsewhere = (l * sin(theta) / 2, -l * cos(theta) / 2), (l * sin(2 * theta), ZERO)
    assert moving_alone(PENDULUM, [halfway, elsewhere]) == [1]


def test_a_place_that_moves_as_the_time_tells_moves_with_the_ground() -> None:
    assert moving_alone(PENDULUM, [(l * cos(w * TIME), l * sin(w * TIME))]) == []
