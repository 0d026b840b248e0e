"""A body that turns freely: Euler's equations, and what is constant for whom."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from sympy import Expr, Integer, Matrix, Rational, Symbol, diff, expand, lambdify, symbols

from derive.algebra.equality import Grade
from derive.algebra.expressions import Relation, component_names, explicit, rate, scalar
from derive.algebra.normal_form import vanishes
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    RigidBody,
    angular_momentum,
    any_angular_velocity,
    changing_angular_velocity,
    euler_equations,
    kinetic_energy,
    rate_in_body,
    rate_in_space,
    rate_under,
    squared_magnitude,
)
from derive.steps.derivation import derivation_of, from_json, to_json, with_ancestors
from derive.steps.establish import Scope, establish
from derive.steps.rule import RULES
from derive.steps.step import Level, Quantity

I_x, I_y, I_z, A, C = symbols("I_x I_y I_z A C", positive=True)
N = symbols("N_x N_y N_z", real=True)
NONE = (Integer(0), Integer(0), Integer(0))
w_x, w_y, w_z = component_names("omega")
GENERAL = (I_x, I_y, I_z)


@cache
def found(moments: tuple[Expr, Expr, Expr] = GENERAL, torque: tuple[Expr, Expr, Expr] = NONE) -> dict[str, Quantity]:
    body, omega = RigidBody(moments=moments), changing_angular_velocity()
    L = angular_momentum(body.tensor, omega)
    equations = euler_equations(rate_in_space(L, omega), torque)
    in_body = rate_in_body(L, omega, equations)
    answers = [
        rate_under(kinetic_energy(body.tensor, omega), equations),
        rate_under(squared_magnitude(L), equations),
        rate_in_space(L, omega, in_body, key="in_space"),
    ]
    return with_ancestors(answers)


def component(i: int) -> Quantity:
    names = component_names("omega")
    return establish(
        RULES["answers.let"],
        scalar("n"),
        lambda: names[i],
        {},
        key="n",
        kind="angular speed",
        scope=Scope(coordinates=dict.fromkeys(names, "angular speed")),
    )


def equations(moments: tuple[Expr, Expr, Expr] = GENERAL) -> list[Quantity]:
    return [found(moments)[f"euler_{axis}"] for axis in "xyz"]


# --- Euler's equations ---


def test_eulers_equations_are_those_of_the_books() -> None:
    expected = [
        I_x * rate(w_x) - (I_y - I_z) * w_y * w_z,
        I_y * rate(w_y) - (I_z - I_x) * w_z * w_x,
        I_z * rate(w_z) - (I_x - I_y) * w_x * w_y,
    ]
    for equation, left in zip(equations(), expected, strict=True):
        assert expand(equation.value.left - left) == 0
        assert equation.value.right == 0


def test_with_a_torque_each_component_stands_on_the_right() -> None:
    driven = found(torque=N)
    assert [driven[f"euler_{axis}"].value.right for axis in "xyz"] == list(N)
    assert driven["euler_x"].step.outcome == "driven"


def test_a_symmetric_body_keeps_its_spin() -> None:
    symmetric = equations((A, A, C))
    assert symmetric[2].value == Relation(C * rate(w_z), "=", 0)
    assert [equation.step.outcome for equation in symmetric] == ["coupled", "coupled", "uncoupled"]
    assert rate_under(component(2), symmetric).step.outcome == "conserved"
    assert rate_under(component(0), symmetric).step.outcome == "changes"


def test_a_body_of_unequal_moments_keeps_no_component() -> None:
    general = equations()
    rates = [rate_under(component(i), general).value for i in range(3)]
    assert vanishes(rates[0] - (I_y - I_z) / I_x * w_y * w_z)
    assert all(value != 0 for value in rates)


def test_with_equal_moments_nothing_couples_the_components() -> None:
    assert [e.value.left for e in equations((A, A, A))] == [A * rate(w) for w in (w_x, w_y, w_z)]
    assert found((A, A, A))["euler_x"].step.outcome == "isotropic"


def test_the_other_axis_of_symmetry_is_told_at_once() -> None:
    assert found((C, A, A))["euler_x"].step.outcome == "uncoupled"


# --- what is constant ---


@pytest.mark.parametrize("moments", [GENERAL, (A, A, C), (C, A, A), (A, A, A), (A, 2 * A, 3 * A)])
def test_energy_and_length_are_constant_for_every_shape(moments: tuple[Expr, Expr, Expr]) -> None:
    for key in ("kinetic_energy_rate", "squared_magnitude_rate"):
        assert found(moments)[key].value == 0
        assert found(moments)[key].step.outcome == "conserved"


def test_every_line_and_every_route_but_the_numerical_ones_is_proved() -> None:
    evidence = [e for quantity in found().values() for e in quantity.step.evidence]
    assert {e.grade for e in evidence if e.claim != "followed"} == {Grade.PROVED, Grade.DEFINITION}
    assert {e.grade for e in evidence if e.claim == "followed"} == {Grade.APPROXIMATION}


def test_a_torque_works_at_the_rate_of_its_power() -> None:
    power = found(torque=N)["kinetic_energy_rate"]
    assert power.step.outcome == "changes"
    assert vanishes(power.value - sum(n * w for n, w in zip(N, (w_x, w_y, w_z), strict=True)))


def test_a_torque_changes_the_length_by_its_part_along_the_momentum() -> None:
    momentum = [I_x * w_x, I_y * w_y, I_z * w_z]
    along = sum(n * l for n, l in zip(N, momentum, strict=True))
    assert vanishes(found(torque=N)["squared_magnitude_rate"].value - 2 * along)


def test_the_factors_are_found_and_not_guessed() -> None:
    steps = found()
    by_energy = [dict(steps[f"kinetic_energy_euler_{axis}"].step.roles)["factor"] for axis in "xyz"]
    by_length = [dict(steps[f"squared_magnitude_euler_{axis}"].step.roles)["factor"] for axis in "xyz"]
    assert by_energy == [w_x, w_y, w_z]
    assert by_length == [I_x * w_x, I_y * w_y, I_z * w_z]


def test_the_momentum_changes_in_the_body_and_not_in_space() -> None:
    assert list(found()["momentum_rate_in_body"].value) != [0, 0, 0]
    assert found()["momentum_rate_in_body"].step.outcome == "in_general"
    assert list(found()["in_space"].value) == [0, 0, 0]
    assert found()["in_space"].step.outcome == "zero"


def test_the_momentum_of_an_isotropic_body_is_constant_in_both_frames() -> None:
    assert found((A, A, A))["momentum_rate_in_body"].step.outcome == "zero"
    assert found((A, A, A))["in_space"].step.outcome == "zero_in_both"


def test_the_momentum_rests_in_the_body_where_it_turns_about_a_principal_axis() -> None:
    in_body = found()["momentum_rate_in_body"].value
    for kept in (w_x, w_y, w_z):
        others = {w: 0 for w in (w_x, w_y, w_z) if w != kept}
        assert list(in_body.subs(others)) == [0, 0, 0]


def test_with_a_torque_the_momentum_in_space_changes_by_it() -> None:
    assert list(found(torque=N)["in_space"].value) == list(N)
    assert found(torque=N)["momentum_rate_in_body"].step.outcome == "driven"


# --- other ways to the same ---


def test_energy_and_length_are_constant_in_any_axes_of_the_body() -> None:
    """With products of inertia, from I omega_dot = -omega x I omega alone."""
    six = iter(symbols("J_xx J_xy J_xz J_yy J_yz J_zz", real=True))
    entries = {(i, j): next(six) for i in range(3) for j in range(i, 3)}
    tensor = Matrix(3, 3, lambda i, j: entries[(min(i, j), max(i, j))])
    omega = Matrix([w_x, w_y, w_z])
    torque_of_turning = -omega.cross(tensor * omega)  # I omega_dot
    assert expand(omega.dot(torque_of_turning)) == 0
    assert expand((tensor * omega).dot(torque_of_turning)) == 0


def test_a_motion_followed_in_small_steps_keeps_what_is_said_to_be_constant() -> None:
    moments = (Integer(2), Integer(3), Integer(4))
    steps = found(moments)
    accelerations = rates_by(steps)
    follow = [lambdify((w_x, w_y, w_z), accelerations[rate(w)], "math") for w in (w_x, w_y, w_z)]
    start = [1.0, 0.2, -0.5, *(float(i == j) for i in range(3) for j in range(3))]
    end = followed(start, lambda state: turned(state, follow), step=0.005, count=1600)
    energy = lambdify((w_x, w_y, w_z), steps["kinetic_energy"].value, "math")
    square = lambdify((w_x, w_y, w_z), steps["squared_magnitude"].value, "math")
    assert abs(energy(*end[:3]) - energy(*start[:3])) < 1e-9
    assert abs(square(*end[:3]) - square(*start[:3])) < 1e-9
    before, after = momentum_in_space(start, moments), momentum_in_space(end, moments)
    assert max(abs(p - q) for p, q in zip(before, after, strict=True)) < 1e-8
    seen = [float(m) * (p - q) for m, p, q in zip(moments, start[:3], end[:3], strict=True)]
    assert max(map(abs, seen)) > 0.1


def rates_by(steps: dict[str, Quantity]) -> dict[Symbol, Expr]:
    solved = {}
    for axis, w in zip("xyz", (w_x, w_y, w_z), strict=True):
        residual = explicit(steps[f"euler_{axis}"].value).residual.expand()
        solved[rate(w)] = -residual.subs(rate(w), 0) / diff(residual, rate(w))
    return solved


def turned(state: list[float], follow: list[Any]) -> list[float]:
    w, axes = state[:3], [state[3 + 3 * i : 6 + 3 * i] for i in range(3)]
    spin = [[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]]
    rows = [[sum(axes[i][k] * spin[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return [*(f(*w) for f in follow), *(entry for row in rows for entry in row)]


def followed(state: list[float], rates: Any, step: float, count: int) -> list[float]:
    def moved(at: list[float], along: list[float], by: float) -> list[float]:
        return [p + by * v for p, v in zip(at, along, strict=True)]

    for _ in range(count):
        one = rates(state)
        two = rates(moved(state, one, step / 2))
        three = rates(moved(state, two, step / 2))
        four = rates(moved(state, three, step))
        mean = [(p + 2 * q + 2 * r + s) / 6 for p, q, r, s in zip(one, two, three, four, strict=True)]
        state = moved(state, mean, step)
    return state


def momentum_in_space(state: list[float], moments: tuple[Expr, ...]) -> list[float]:
    own = [float(m) * w for m, w in zip(moments, state[:3], strict=True)]
    return [sum(state[3 + 3 * i + j] * own[j] for j in range(3)) for i in range(3)]


# --- bodies ---


def test_the_particles_have_the_moments_of_the_body() -> None:
    body = RigidBody(moments=GENERAL)
    for i, moment in enumerate(GENERAL):
        across = sum(mass * sum(x**2 for k, x in enumerate(place) if k != i) for mass, place in body.particles())
        assert expand(across - moment) == 0


@pytest.mark.parametrize("moments", [(Integer(1), Integer(2), Integer(4)), (3 * A, A, A), (A, Rational(5, 2) * A, A)])
def test_no_body_has_a_moment_above_the_other_two_together(moments: tuple[Expr, Expr, Expr]) -> None:
    with pytest.raises(Rejected) as refusal:
        RigidBody(moments=moments)
    assert refusal.value.complaints[0].code == "no-such-body"


def test_a_flat_body_may_have_one_moment_equal_to_the_other_two_together() -> None:
    assert RigidBody(moments=(A, 2 * A, 3 * A)).second_moments == (2 * A, A, 0)


def test_a_body_may_turn_about_a_fixed_point() -> None:
    body = RigidBody(moments=GENERAL, about="fixed_point")
    held = changing_angular_velocity(through="fixed_point")
    assert dict(angular_momentum(body.tensor, held).step.words)["about"] == "fixed_point"
    with pytest.raises(Rejected):
        angular_momentum(body.tensor, changing_angular_velocity())


def test_arguments_of_another_kind_are_refused() -> None:
    L, omega = found()["angular_momentum"], found()["angular_velocity"]
    with pytest.raises(Rejected):
        rate_in_space(omega, L)
    with pytest.raises(Rejected):
        rate_in_body(omega, L, equations())


def test_equations_of_another_body_are_refused() -> None:
    with pytest.raises(Unverified):
        rate_in_body(found()["angular_momentum"], found()["angular_velocity"], equations((A, A, C)))


def test_a_steady_angular_velocity_has_no_rates() -> None:
    body = RigidBody(moments=GENERAL, about="centre_of_mass")
    steady = any_angular_velocity(through="centre_of_mass")
    L = angular_momentum(body.tensor, steady)
    assert not any(s.name.endswith("_dot") for s in rate_in_space(L, steady).value.free_symbols)


# --- steps are data ---


@pytest.mark.parametrize("torque", [NONE, N])
def test_the_steps_go_to_json_and_back(torque: tuple[Expr, Expr, Expr]) -> None:
    known = found(torque=torque)
    derivation = derivation_of([["kinetic_energy_rate", "squared_magnitude_rate"], ["in_space"]], known)
    assert from_json(to_json(derivation)) == derivation


@pytest.mark.parametrize("torque", [NONE, N])
def test_only_at_full_is_the_torque_found_from_what_was_found_from_it(torque: tuple[Expr, Expr, Expr]) -> None:
    """dL/dt = -omega x L + omega x L = 0 uses Euler's equations, which are dL/dt = 0."""
    chain = found(torque=torque)["in_space"].step.chain
    assert [form.level for form in chain[:-1]] == [Level.FULL] * (len(chain) - 1) and len(chain) > 1
