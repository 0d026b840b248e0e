"""Mass points that move as a body does have its energy, its momentum and its moments of inertia."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Integer, Rational, cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import rate
from derive.mechanics import Particle, RigidBody, System, Z, charge, euler_angles, point, space
from derive.mechanics import X as ACROSS
from derive.mechanics.model.dalembert import Load, MassPoint, Matter
from derive.steps.record import coordinate_named, recorded
from tests.mechanics.motion import THETA, X, b, g, l, m
from tests.mechanics.slab import I

q, q_dot, q_ddot = THETA.symbol, THETA.rate, THETA.acceleration
x, x_dot = X.symbol, X.rate
A, C = symbols("A C", positive=True)


def matter_of(part: Callable[[], Any]) -> Matter:
    with recorded():
        for known in (THETA, X):
            coordinate_named(known.symbol, known.kind)
        return System(part()).matter


def body_in_a_plane(*place: Any) -> Matter:
    return matter_of(lambda: RigidBody(m, I).placed(q, point(*place)))


def top_of(*moments: Any) -> Matter:
    def held() -> Any:
        precession, tilt, spin = euler_angles()
        axes = space.turned(Z, precession).turned(ACROSS, tilt).turned(Z, spin)
        return RigidBody(m, moments, about="fixed_point").held(axes, at="pivot")

    return matter_of(held)


def test_the_points_of_a_body_that_turns_have_its_moment_of_inertia() -> None:
    turning = body_in_a_plane(0, 0)
    assert equal(turning.kinetic_energy(), I * q_dot**2 / 2)
    assert equal(turning.momentum_along(q), I * q_dot)
    assert equal(turning.inertia_along(q), I * q_ddot)


def test_a_particle_is_one_point() -> None:
    assert matter_of(lambda: Particle(m, point(x, 0))).points == (MassPoint(m, (x, Integer(0))),)


def test_a_pendulum_has_its_moment_about_the_pivot() -> None:
    bob = body_in_a_plane(l * sin(q), -l * cos(q))
    assert equal(bob.kinetic_energy(), (I + m * l**2) * q_dot**2 / 2)
    assert equal(bob.turning_along(q), 0)


def test_the_weight_does_work_along_a_coordinate() -> None:
    weight = Matter((), (Load((Integer(0), -m * g), (l * sin(q), -l * cos(q))),), (q,))
    assert equal(weight.force_along(q), -m * g * l * sin(q))
    assert weight.kinetic_energy() == 0


def test_momentum_is_the_derivative_of_the_energy_by_the_rate() -> None:
    body = body_in_a_plane(x * cos(q), x**2 / b)
    for along in (x, q):
        assert equal(body.momentum_along(along), body.kinetic_energy().diff(rate(along)))
        assert equal(body.turning_along(along), body.kinetic_energy().diff(along))


def test_what_turns_in_a_magnetic_field_gives_with_the_deflection_the_slope_of_the_energy_in_the_field() -> None:
    with recorded():
        for known in (THETA, X):
            coordinate_named(known.symbol, known.kind)
        place = point(x * cos(q), x * sin(q))
        matter = System(Particle(m, place), charge(A, place, B=b)).matter
    for along in (x, q):
        in_field = matter.turning_along(along) - matter.kinetic_energy().diff(along)
        assert equal(in_field + matter.deflection_along(along), matter.energy_in_fields().diff(along))
    assert not equal(matter.deflection_along(x), 0)


def test_inertia_is_the_rate_of_momentum_less_what_the_turning_gives() -> None:
    body = matter_of(lambda: Particle(m, point(x * cos(q), x * sin(q))))
    assert equal(body.inertia_along(x), m * (rate(x, 2) - x * q_dot**2))
    assert equal(body.inertia_along(q), m * (x**2 * q_ddot + 2 * x * x_dot * q_dot))


def test_matter_together_has_the_points_and_loads_of_both_and_each_coordinate_once() -> None:
    one = Matter((MassPoint(m, (x,)),), (), (x, q))
    other = Matter((), (Load((m * g,), (q,)),), (q,))
    both = one + other
    assert (both.points, both.loads, both.coordinates) == (one.points, other.loads, (x, q))


def test_a_symmetric_body_has_the_energy_of_its_angular_velocity() -> None:
    """Turned by phi about the vertical, tilted by theta, spinning by psi: T = A(w_x^2 + w_y^2)/2 + C w_z^2/2."""
    phi_dot, psi_dot = rate(symbols("phi", real=True)), rate(symbols("psi", real=True))
    across = q_dot**2 + phi_dot**2 * sin(q) ** 2
    assert equal(top_of(A, A, C).kinetic_energy(), A * across / 2 + C * (psi_dot + phi_dot * cos(q)) ** 2 / 2)


def test_the_second_moments_of_a_body_make_its_moments_of_inertia() -> None:
    w_x, w_y, w_z = (each.mass for each in top_of(A, A, C).points if each.mass != m)
    assert ((w_y + w_z - A).expand(), (w_x + w_y - C).expand()) == (0, 0)


def test_a_flat_disc_has_no_second_moment_along_its_axis() -> None:
    """Perpendicular axes: C = 2A."""
    disc = top_of(m * b**2 / 4, m * b**2 / 4, m * b**2 / 2)
    assert [each.mass for each in disc.points if each.mass.has(b)] == [m * b**2 * Rational(1, 4)] * 2
