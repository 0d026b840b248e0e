"""The free symmetric body: Goldstein section 5.6, Landau section 33, Taylor section 10.8."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import ImmutableDenseMatrix, Rational, sqrt, symbols, tan

import derive.mechanics.rotation.cones as cones
from derive.algebra.equality import equal
from derive.algebra.expressions import Norm, Ratio
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Cuboid,
    Disc,
    RigidBody,
    angular_momentum,
    axis_of_symmetry,
    changing_angular_velocity,
    inertia_tensor,
    momentary_angular_velocity,
    precession_rate,
    tangent_between,
    torque,
    vector_component,
)
from derive.steps.step import Level, Quantity

A, B, C, a, M, p, r = symbols("A B C a M p r", positive=True)


def free(*moments: Any, omega: Any = (p, 0, r)) -> tuple[Quantity, Quantity, Quantity]:
    tensor = RigidBody(moments=moments).tensor
    velocity = momentary_angular_velocity(omega, through="centre_of_mass")
    return tensor, velocity, angular_momentum(tensor, velocity)


def test_the_axis_goes_round_the_angular_momentum() -> None:
    """Landau, section 33: M/I_1, here sqrt(A^2 p^2 + C^2 r^2)/A."""
    tensor, _, L = free(A, A, C)
    assert equal(precession_rate(tensor, L).value, sqrt(A**2 * p**2 + C**2 * r**2) / A)


def test_the_cones_of_body_and_axis() -> None:
    """Goldstein, section 5.6: the axis and omega make tan = p/r; the axis and L tan = A p/(C r)."""
    tensor, omega, L = free(A, A, C)
    axis = axis_of_symmetry(tensor)
    assert equal(tangent_between(axis, omega, "alpha", "body_cone").value, p / r)
    assert equal(tangent_between(axis, L, "beta", "tilt").value, A * p / (C * r))


def test_a_plate_wobbles_twice_as_fast_as_it_spins() -> None:
    """Taylor, problem 10.46: of a thin disc C = 2 A, and with a small tilt L/A = 2 r. With p = r: sqrt 5 r."""
    tensor, _, L = free(A, A, 2 * A, omega=(r, 0, r))
    assert equal(precession_rate(tensor, L).value, sqrt(5) * r)
    disc = Disc(a, M)
    spinning = momentary_angular_velocity((r, 0, r))
    tensor = inertia_tensor(disc)
    assert equal(precession_rate(tensor, angular_momentum(tensor, spinning)).value, sqrt(5) * r)


def test_the_axis_may_be_any_of_the_three() -> None:
    tensor, omega, _ = free(C, A, A, omega=(r, p, 0))
    axis = axis_of_symmetry(tensor)
    assert axis.value == ImmutableDenseMatrix([1, 0, 0])
    assert equal(tangent_between(axis, omega).value, p / r)


def test_tangents_are_written_as_such() -> None:
    alpha = symbols("alpha", real=True)
    _, omega, L = free(A, A, C, omega=(0, 0, r))
    assert tangent_between(omega, L).step.outcome == "parallel"
    assert cones._with_tangents(A * cones.sin(alpha) / (C * cones.cos(alpha))) == A * tan(alpha) / C


def test_one_component_of_a_vector() -> None:
    _, _, L = free(A, B, C, omega=(p, 0, r))
    assert [vector_component(L, axis, key=f"L_{axis}").value for axis in "xyz"] == [A * p, 0, C * r]
    assert vector_component(L, "z", key="again").symbol.name == "L_z"


def test_a_component_with_the_symbol_of_its_vector_has_its_value_as_the_only_line() -> None:
    """L_z = (L)_z would only rename it; v_z = (L)_z says more."""
    _, _, L = free(A, B, C, omega=(p, 0, r))
    lines = {
        symbol: [
            form.expr for form in vector_component(L, "z", symbol, "own").step.chain if form.level is not Level.FULL
        ]
        for symbol in (None, "v")
    }
    assert lines[None] == [C * r]
    assert len(lines["v"]) == 2


@pytest.mark.parametrize("moments", [(A, B, C), (A, A, A)])
def test_without_an_axis_of_symmetry_there_are_no_cones(moments: Any) -> None:
    tensor, _, L = free(*moments)
    with pytest.raises(Rejected, match="two equal principal moments"):
        precession_rate(tensor, L)


def test_other_questions_that_do_not_fit() -> None:
    tensor, omega, L = free(A, A, C, omega=(0, 0, r))
    with pytest.raises(Rejected, match="direction is then constant"):
        precession_rate(tensor, L)
    with pytest.raises(Rejected, match="at one instant, use `momentary_angular_velocity`"):
        precession_rate(tensor, angular_momentum(tensor, changing_angular_velocity(through="centre_of_mass")))
    with pytest.raises(Rejected, match="known at one instant only"):
        torque(omega, L)
    with pytest.raises(Rejected, match="are perpendicular"):
        tangent_between(axis_of_symmetry(tensor), free(A, A, C, omega=(p, 0, 0))[1])
    with pytest.raises(Rejected, match="its axes are not principal axes"):
        axis_of_symmetry(inertia_tensor(Cuboid((a, a, a), M), "corner"))


@pytest.mark.parametrize("factor", [2, Rational(1, 2), -1])
def test_a_wrong_rate_of_precession_is_refused(factor: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cones, "Ratio", lambda above, below: Ratio(factor * above, below))
    tensor, _, L = free(A, A, C)
    with pytest.raises(Unverified, match="precession_rate"):
        precession_rate(tensor, L)


def test_a_wrong_tangent_or_axis_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    tensor, _, L = free(A, A, C)
    axis = axis_of_symmetry(tensor)
    with monkeypatch.context() as wrong:
        wrong.setattr(cones, "Norm", lambda v: 2 * Norm(v))
        with pytest.raises(Unverified, match="tangent"):
            tangent_between(axis, L)
    monkeypatch.setattr(cones, "axis_number", lambda inertia: 0)
    with pytest.raises(Unverified, match="axis_of_symmetry"):
        axis_of_symmetry(tensor)
