"""A steady rotation that is disturbed, and the free symmetric body: Landau section 37, Goldstein 5.6, Taylor 10.8."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Expr, Rational, pi, sqrt, symbols

import derive.mechanics.rotation.perturbed_rotation as wobble
from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Cuboid,
    RigidBody,
    angular_momentum,
    body_cone_rate,
    changing_angular_velocity,
    constant_angular_velocity,
    euler_equations,
    inertia_tensor,
    kinetic_energy,
    linearised_rotation,
    period,
    perturbation_rate,
    perturbation_rate_squared,
    rate_in_space,
    torque,
)
from derive.steps.step import Quantity

A, B, C, a, M, omega = symbols("A B C a M omega", positive=True)
x, y, z = symbols("omega_x omega_y omega_z", real=True)
x_dot, y_dot, z_dot = symbols("omega_x_dot omega_y_dot omega_z_dot", real=True)
NOTHING = (0 * A, 0 * A, 0 * A)


def equations(moments: tuple[Expr, Expr, Expr], torque: Any = NOTHING) -> tuple[Quantity, Quantity, Quantity]:
    body, velocity = RigidBody(moments=moments), changing_angular_velocity()
    return euler_equations(rate_in_space(angular_momentum(body.tensor, velocity), velocity), torque)


def squared(moments: tuple[Expr, Expr, Expr], axis: str) -> Quantity:
    return perturbation_rate_squared(linearised_rotation(equations(moments), axis, omega))


def test_euler_equations_to_first_order() -> None:
    first, second = linearised_rotation(equations((A, B, C)), "z", omega)
    assert equal(first.value, Relation(A * x_dot + (C - B) * omega * y, "=", 0))
    assert equal(second.value, Relation(B * y_dot + (A - C) * omega * x, "=", 0))


def test_a_common_factor_is_divided_out_of_eulers_equations() -> None:
    first, *_ = equations((13 * A, 10 * A, 5 * A))
    assert not first.value.left.has(A)


def test_the_square_of_the_wobble() -> None:
    """Landau, section 37, by hand: (I_z - I_x)(I_z - I_y) omega^2/(I_x I_y)."""
    found = squared((A, B, C), "z")
    assert equal(found.value, (C - A) * (C - B) * omega**2 / (A * B))
    assert found.step.outcome == "conditional"


@pytest.mark.parametrize(
    ("axis", "square", "outcome", "letter", "rate"),
    [
        ("x", Rational(1, 6), "least", "Omega", sqrt(6) / 6),
        ("y", Rational(1, 3), "greatest", "Omega", sqrt(3) / 3),
        ("z", Rational(-1, 8), "unstable", "kappa", sqrt(2) / 4),
    ],
)
def test_about_the_intermediate_axis_it_grows(axis: str, square: Expr, outcome: str, letter: str, rate: Expr) -> None:
    """Moments A, 2A and 3A/2: about x (-1)(-1/2)/(2 3/2), about y (1)(1/2)/(3/2), about z (1/2)(-1/2)/2."""
    found = squared((A, 2 * A, 3 * A / 2), axis)
    assert equal(found.value, square * omega**2)
    assert found.step.outcome == outcome
    root = perturbation_rate(found)
    assert root.symbol.name == letter
    assert equal(root.value, rate * omega)


def test_a_symmetric_body_wobbles_about_its_axis() -> None:
    found = squared((A, A, C), "z")
    assert found.step.outcome == "symmetric"
    assert equal(found.value, ((C - A) / A * omega) ** 2)
    assert equal(explicit(perturbation_rate(squared((A, A, 2 * A), "z")).value), omega)


def test_across_the_axis_of_a_symmetric_body_it_grows_as_the_time() -> None:
    found = squared((A, A, C), "x")
    assert (found.value, found.step.outcome) == (0, "marginal")
    with pytest.raises(Rejected, match="grows at most linearly in time"):
        perturbation_rate(found)


def test_of_a_block_too() -> None:
    velocity = changing_angular_velocity("centre")
    L = angular_momentum(inertia_tensor(Cuboid((a, 2 * a, 3 * a), M)), velocity)
    found = perturbation_rate_squared(linearised_rotation(euler_equations(rate_in_space(L, velocity)), "y", omega))
    assert equal(found.value, -Rational(3, 13) * omega**2)


@pytest.mark.parametrize(
    ("moments", "rate", "outcome"),
    [
        ((A, A, C), (C - A) / A * z, "generic"),
        ((A, A, 2 * A), z, "oblate"),
        ((2 * A, 2 * A, A), -z / 2, "prolate"),
    ],
)
def test_the_body_cone(moments: tuple[Expr, Expr, Expr], rate: Expr, outcome: str) -> None:
    """Goldstein, section 5.6: Omega = (I_3 - I_1) omega_3/I_1."""
    found = body_cone_rate(equations(moments))
    assert equal(found.value, rate)
    assert found.step.outcome == outcome


def test_chandlers_period_for_a_rigid_earth() -> None:
    """(C - A)/A = 1/305: some 305 days, which are turns of the Earth."""
    found = period(perturbation_rate(squared((A, A, A * Rational(306, 305)), "z")))
    assert equal(found.value, 305 * 2 * pi / omega)


def test_components_that_are_given() -> None:
    """L = (A p, B q, 0), T = (A p^2 + B q^2)/2, torque omega x L = (0, 0, (B - A) p q)."""
    p, q = symbols("p q", positive=True)
    body = RigidBody(moments=(A, B, C))
    velocity = constant_angular_velocity((p, q, 0), through="centre_of_mass")
    L = angular_momentum(body.tensor, velocity)
    assert equal(kinetic_energy(body.tensor, velocity).value, (A * p**2 + B * q**2) / 2)
    assert list(torque(velocity, L).value.expand()) == [0, 0, B * p * q - A * p * q]


@pytest.mark.parametrize(
    ("question", "message"),
    [
        (lambda: linearised_rotation(equations((A, B, C)), "w", omega), 'must be "x", "y" or "z"'),
        (lambda: linearised_rotation(equations((A, B, C), (M, 0 * M, 0 * M)), "z", omega), "does not satisfy"),
        (lambda: linearised_rotation(equations((A, B, C))[:2], "z", omega), "all three Euler equations"),
        (lambda: body_cone_rate(equations((A, B, C))), "are equal"),
        (lambda: body_cone_rate(equations((A, A, A))), "three moments are equal"),
        (lambda: body_cone_rate(equations((A, A, C), (M, 0 * M, 0 * M))), "without torque"),
        (lambda: constant_angular_velocity((omega, omega)), "three components, not 2"),
        (lambda: constant_angular_velocity((0, 0, 0)), "does not rotate"),
    ],
)
def test_wrong_questions_are_refused(question: Any, message: str) -> None:
    with pytest.raises(Rejected) as refused:
        question()
    assert message in str(refused.value)


@pytest.mark.parametrize(
    ("part", "wrong"),
    [
        ("_by_curvatures", lambda disturbed: -(omega**2)),
        ("_trace_of_squared_motion", lambda disturbed: omega**2),
        ("_stability", lambda value, disturbed: "greatest"),
    ],
)
def test_what_disagrees_is_refused(part: str, wrong: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wobble, part, wrong)
    with pytest.raises(Unverified):
        squared((A, 2 * A, 3 * A / 2), "z")


def test_a_wrong_linear_equation_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The coupling with the other sign: then every axis but the intermediate one would be unstable."""
    right = wobble.diff
    monkeypatch.setattr(wobble, "diff", lambda f, *by: -right(f, *by) if by == (y,) else right(f, *by))
    with pytest.raises(Unverified, match="linearised"):
        linearised_rotation(equations((A, B, C)), "z", omega)


@pytest.mark.parametrize("points", [None, 1])
def test_the_root_with_the_other_sign_is_refused(monkeypatch: pytest.MonkeyPatch, points: int | None) -> None:
    found, right = squared((A, B, C), "z"), wobble._root_of
    monkeypatch.setattr(wobble, "_root_of", lambda square: -right(square))
    if points is not None:
        monkeypatch.setattr(wobble, "prime", lambda _: points)
    with pytest.raises(Unverified):
        perturbation_rate(found)


@pytest.mark.parametrize(("other", "said"), [("omega_y", True), ("Omega_y", False), ("omega_x", False)])
def test_the_small_components_belong_to_one_vector(other: str, said: bool) -> None:
    small = symbols(other, real=True)
    facts: Any = SimpleNamespace(inputs={"along": z, "small_1": x, "small_2": small})
    assert wobble.claims.another_component(facts, x) is said
