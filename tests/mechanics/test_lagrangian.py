"""Lagrange's equations of systems whose motion is known: pendulums, beads on wires, what has a cyclic coordinate."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, cos, sin, symbols

from derive.algebra.equality import Compared, Grade, equal
from derive.algebra.expressions import Relation
from derive.errors import Rejected
from derive.mechanics import (
    Particle,
    System,
    coordinate,
    equation_of_motion,
    generalized_force,
    generalized_momentum,
    lagrangian,
    point,
    weight,
)
from derive.steps.record import recorded
from derive.steps.step import Quantity
from tests.mechanics.motion import THETA, X, b, g, l, m, motion, of_system
from tests.mechanics.slab import I as moment
from tests.mechanics.slab import M, R, a, known_slab

q, q_dot, q_ddot = THETA.symbol, THETA.rate, THETA.acceleration
x, x_dot, x_ddot = X.symbol, X.rate, X.acceleration
r, phi = coordinate("r", "length"), coordinate("phi")
m_3 = symbols("m_3", positive=True)

PENDULUM = (l * sin(q), -l * cos(q), THETA)


def energies(*place: Any, **named: Any) -> tuple[Quantity, Quantity]:
    L = of_system(*place, **named).parents
    return L[0], L[1]


def says(found: Relation, left: Any) -> bool:
    return bool(equal(found, Relation(left, "=", 0)))


# --- energies ---


def test_the_energies_of_a_pendulum_are_the_known_ones() -> None:
    T, U = energies(*PENDULUM)
    assert (T.value - m * l**2 * q_dot**2 / 2).expand() == 0
    assert U.value == -m * g * l * cos(q)
    assert T.step.kind == "energy"


def pulleys() -> Quantity:
    with recorded():
        down, inside = coordinate("x", "length"), coordinate("y", "length")
        heights = {M: -1 * down, m: down - l - inside, m_3: down - l + inside}
        return lagrangian(System(*(Particle(mass, point(0, height)) for mass, height in heights.items()), weight(g)))


def test_each_coordinate_occurs_once_in_an_energy_that_is_linear_in_the_coordinates() -> None:
    L = pulleys()
    _, U = L.parents
    last = U.step.chain[-1].expr
    assert [str(last).count(name) for name in ("x", "y")] == [1, 1]
    assert equal(U.value, g * ((m + m_3 - M) * x + (m_3 - m) * coordinate("y", "length").symbol - (m + m_3) * l))


def test_a_difference_of_constants_changes_its_sign_in_the_lagrangian() -> None:
    *_, with_x, with_y, constant = pulleys().step.chain[-1].expr.args
    assert equal(with_x, (M - m - m_3) * g * x) and M - m - m_3 in with_x.args
    assert m - m_3 in with_y.args
    assert not constant.has(x)


def test_a_body_that_turns_has_the_energy_of_its_rotation_besides() -> None:
    T, _ = energies(*PENDULUM, inertia=moment, turning=THETA)
    assert (T.value - (m * l**2 + moment) * q_dot**2 / 2).expand() == 0


def test_a_turning_that_is_no_coordinate_of_the_place_is_a_coordinate_all_the_same() -> None:
    T, _ = energies(x, 0, X, inertia=moment, turning=THETA)
    assert set(of_system(x, 0, X, inertia=moment, turning=THETA).coordinates) == {x, q}
    assert (T.value - m * x_dot**2 / 2 - moment * q_dot**2 / 2).expand() == 0


def test_a_lagrangian_is_that_of_a_system() -> None:
    T, _ = energies(*PENDULUM)
    with pytest.raises(Rejected, match="`lagrangian` needs a `System`"):
        lagrangian(T)  # type: ignore[arg-type]


def test_no_potential_is_no_force() -> None:
    L = of_system(x, 0, X)
    assert L.parents[1].value == 0
    found = equation_of_motion(L, X)
    assert found.step.outcome == "cyclic"
    assert says(found.value, m * x_ddot)


# --- equations of motion ---


def test_a_pendulum_obeys_its_equation() -> None:
    assert says(motion(*PENDULUM).value, l * q_ddot + g * sin(q))


def test_a_physical_pendulum_obeys_the_law_of_moments_about_its_pivot() -> None:
    found = motion(*PENDULUM, inertia=moment, turning=THETA)
    assert says(found.value, (moment + m * l**2) * q_ddot + m * g * l * sin(q))


def test_a_bead_on_a_parabola_feels_the_slope_and_the_centripetal_term() -> None:
    found = motion(x, x**2 / (2 * b), X)
    assert says(found.value, (1 + x**2 / b**2) * x_ddot + x * x_dot**2 / b**2 + g * x / b)


def test_a_bead_on_a_straight_wire_has_the_acceleration_of_the_slope() -> None:
    """Down a wire inclined by 30 degrees: s_ddot = -g/2."""
    s = coordinate("s", "length")
    found = motion(s.symbol * cos(Integer(0)), s.symbol, s)
    assert says(found.value, 2 * s.acceleration + g)


def test_a_body_on_a_turning_arm_has_two_equations() -> None:
    """With weight: m (r_ddot - r phi_dot^2) = -m g sin phi and d(m r^2 phi_dot)/dt = -m g r cos phi."""
    L = of_system(r.symbol * cos(phi.symbol), r.symbol * sin(phi.symbol), r, phi)
    radial, angular = equation_of_motion(L, r, key="radial"), equation_of_motion(L, phi, key="angular")
    R_, F_ = r.symbol, phi.symbol
    assert says(radial.value, r.acceleration - R_ * phi.rate**2 + g * sin(F_))
    by_moments = R_ * phi.acceleration + 2 * r.rate * phi.rate + g * cos(F_)
    assert says(angular.value, R_ * by_moments)
    assert not says(angular.value, by_moments)  # r may vanish


def test_without_forces_the_angle_is_cyclic_and_its_momentum_is_the_angular_momentum() -> None:
    with recorded():
        distance, angle = coordinate("r", "length"), coordinate("phi")
        at = point(distance * cos(angle), distance * sin(angle), 0)
        L = lagrangian(System(Particle(m, at), weight(g)))
        found = equation_of_motion(L, angle)
        assert found.step.outcome == "cyclic"
        momentum = generalized_momentum(L, angle)
        assert momentum.value == m * distance.symbol**2 * angle.rate
        assert generalized_force(L, angle).step.outcome == "zero"
        assert generalized_force(L, distance).value == m * distance.symbol * angle.rate**2


def test_a_coordinate_that_the_lagrangian_does_not_have_is_refused() -> None:
    L = of_system(*PENDULUM)
    with pytest.raises(Rejected) as refusal:
        equation_of_motion(L, X)
    (complaint,) = refusal.value.complaints
    assert complaint.message == "`equation_of_motion`: `lagrangian` does not depend on the coordinate x"
    assert complaint.help == "it depends on theta"


def test_the_energy_of_the_slab_is_constant_along_its_motion() -> None:
    found = known_slab()
    energy = found["kinetic_energy"].value + found["potential_energy"].value
    changes = energy.diff(q) * q_dot + energy.diff(q_dot) * q_ddot
    assert equal(changes, q_dot * found["equation_of_motion"].value.left).grade is Grade.PROVED


def test_the_equation_of_the_slab_is_that_of_the_moments_about_the_contact() -> None:
    """The contact is at rest: (I + M d^2) q_ddot + M (d^2)'/2 q_dot^2 is the moment of the weight, d its distance."""
    distance_squared = R**2 * q**2 + a**2 / 4
    left = (moment + M * distance_squared) * q_ddot + M * distance_squared.diff(q) / 2 * q_dot**2
    lever = a / 2 * sin(q) - R * q * cos(q)
    assert says(known_slab()["equation_of_motion"].value, left - M * symbols("g", positive=True) * lever)


def test_every_step_of_the_slab_is_proved_but_the_series() -> None:
    evidence = [e for step in known_slab().values() for e in step.step.evidence]
    grades = {e.grade for e in evidence if e.compared is not Compared.WITNESS}
    assert grades == {Grade.PROVED, Grade.APPROXIMATION}
    series = [s.key for s in known_slab().values() if any(e.grade is Grade.APPROXIMATION for e in s.step.evidence)]
    assert series == ["leading_order"]
