"""Mass points that move as a body does have its energy, its momentum and its moments of inertia."""

from __future__ import annotations

from sympy import Integer, Matrix, Rational, cos, eye, rot_axis3, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import rate
from derive.mechanics import coordinate
from derive.mechanics.systems.dalembert import Load, MassPoint, Matter, plane_body, symmetric_body
from tests.mechanics.motion import THETA, X, b, g, l, m
from tests.mechanics.slab import I

q, q_dot, q_ddot = THETA.symbol, THETA.rate, THETA.acceleration
x, x_dot = X.symbol, X.rate
A, C = symbols("A C", positive=True)
phi, psi = coordinate("phi"), coordinate("psi")


def test_a_pointer_has_the_moment_of_inertia_of_the_body() -> None:
    turning = plane_body(m, (Integer(0), Integer(0)), I, q, [q])
    assert equal(turning.kinetic_energy(), I * q_dot**2 / 2)
    assert equal(turning.momentum_along(q), I * q_dot)
    assert equal(turning.inertia_along(q), I * q_ddot)


def test_a_particle_has_no_pointer() -> None:
    assert len(plane_body(m, (x, Integer(0)), Integer(0), q, [x, q]).points) == 1


def test_a_pendulum_has_its_moment_about_the_pivot() -> None:
    bob = plane_body(m, (l * sin(q), -l * cos(q)), I, q, [q])
    assert equal(bob.kinetic_energy(), (I + m * l**2) * q_dot**2 / 2)
    assert equal(bob.turning_along(q), 0)


def test_the_weight_does_work_along_a_coordinate() -> None:
    weight = Matter((), (Load((Integer(0), -m * g), (l * sin(q), -l * cos(q))),), (q,))
    assert equal(weight.force_along(q), -m * g * l * sin(q))
    assert weight.kinetic_energy() == 0


def test_momentum_is_the_derivative_of_the_energy_by_the_rate() -> None:
    body = plane_body(m, (x * cos(q), x**2 / b), I, q, [x, q])
    for along in (x, q):
        assert equal(body.momentum_along(along), body.kinetic_energy().diff(rate(along)))
        assert equal(body.turning_along(along), body.kinetic_energy().diff(along))


def test_inertia_is_the_rate_of_momentum_less_what_the_turning_gives() -> None:
    body = plane_body(m, (x * cos(q), x * sin(q)), Integer(0), q, [x, q])
    assert equal(body.inertia_along(x), m * (rate(x, 2) - x * q_dot**2))
    assert equal(body.inertia_along(q), m * (x**2 * q_ddot + 2 * x * x_dot * q_dot))


def test_matter_together_has_the_points_and_loads_of_both_and_each_coordinate_once() -> None:
    one = Matter((MassPoint(m, (x,)),), (), (x, q))
    other = Matter((), (Load((m * g,), (q,)),), (q,))
    both = one + other
    assert (both.points, both.loads, both.coordinates) == (one.points, other.loads, (x, q))


def test_a_symmetric_body_has_the_energy_of_its_angular_velocity() -> None:
    """Turned by phi about the vertical, tilted by theta, spinning by psi: T = A(w_x^2 + w_y^2)/2 + C w_z^2/2."""
    about = {"phi": phi.symbol, "psi": psi.symbol}
    tilt = Matrix([[1, 0, 0], [0, cos(q), -sin(q)], [0, sin(q), cos(q)]])
    axes = rot_axis3(-about["phi"]) * tilt * rot_axis3(-about["psi"])
    top = symmetric_body(A, C, [list(axes[:, i]) for i in range(3)], [phi.symbol, q, psi.symbol])
    across = q_dot**2 + phi.rate**2 * sin(q) ** 2
    assert equal(top.kinetic_energy(), A * across / 2 + C * (psi.rate + phi.rate * cos(q)) ** 2 / 2)


def test_the_moments_of_a_symmetric_body_are_sums_of_its_second_moments() -> None:
    body = symmetric_body(A, C, eye(3).tolist(), [])
    w_x, w_y, w_z = (point.mass for point in body.points)
    assert ((w_y + w_z - A).expand(), (w_x + w_y - C).expand()) == (0, 0)
    assert body.kinetic_energy() == 0


def test_a_flat_disc_has_no_second_moment_along_its_axis() -> None:
    """Perpendicular axes: C = 2A."""
    disc = symmetric_body(m * b**2 / 4, m * b**2 / 2, eye(3).tolist(), [])
    assert disc.points[2].mass == 0
    assert disc.points[0].mass == m * b**2 * Rational(1, 4)
