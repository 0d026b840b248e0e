"""What forces without a potential energy, and conditions that move, do to the energy function and to Hamilton's
equations, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Expr, cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit, rate
from derive.errors import Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    constraint,
    coordinate,
    damping,
    energy_function,
    energy_function_rate,
    equilibria,
    force,
    hamilton_equations,
    hamiltonian,
    lagrangian,
    point,
    potential,
    spring,
    t,
    weight,
)
from derive.mechanics.hamilton import canonical
from derive.mechanics.lagrange import energy_function as energy
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity

m, M, g, l, k, b, a, w, F = symbols("m M g l k b a omega F", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def on_spring(*others: Callable[[Any], Any]) -> tuple[Quantity, Coordinate]:
    x = coordinate("x", "length")
    at = point(x, 0)
    return lagrangian(System(Particle(m, at), spring(k, point(0, 0), at), *(other(at) for other in others))), x


def rate_of_energy(L: Quantity) -> Quantity:
    return energy_function_rate(energy_function(L))


def test_drag_takes_twice_the_dissipation_function() -> None:
    """Goldstein, section 1.5: dE/dt = -2 F, with Rayleigh's function F = (1/2) b v^2."""
    L, x = on_spring(lambda at: damping(b, at))
    h, found = energy_function(L), rate_of_energy(L)
    assert h.step.outcome == "work_energy"
    assert found.step.outcome == "lost"
    assert equal(explicit(found.value.right), -b * x.rate**2)


@pytest.mark.parametrize(("coupling", "is_lost"), [(0, True), (b, True), (-2 * b, True), (3 * b, False), (a, False)])
def test_energy_is_called_lost_only_if_no_velocity_makes_the_power_positive(
    coupling: Expr, is_lost: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The power is -b v_x^2 - b v_y^2 + c v_x v_y, at most zero for c^2 <= 4 b^2; both squares have a minus sign."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    h = energy_function(
        lagrangian(System(Particle(m, point(x, y)), force((coupling * y.rate - b * x.rate, -b * y.rate), point(x, y))))
    )
    monkeypatch.setattr(energy, "_sort_of_rate", lambda *_: "lost")
    if is_lost:
        assert energy_function_rate(h).step.outcome == "lost"
    else:
        with pytest.raises(Unverified):
            energy_function_rate(h)


def test_a_force_that_drives_does_the_work_force_times_velocity() -> None:
    """Taylor, section 5.5, and problem 5.37: P = F v."""
    L, x = on_spring(lambda at: force((F * cos(w * t), 0), at))
    found = rate_of_energy(L)
    assert found.step.outcome == "work"
    assert equal(explicit(found.value.right), F * cos(w * t) * x.rate)


def test_a_drag_and_a_force_against_it_may_do_either() -> None:
    L, x = on_spring(lambda at: damping(b, at), lambda at: force((F, 0), at))
    found = rate_of_energy(L)
    assert found.step.outcome == "work"
    assert equal(explicit(found.value.right), F * x.rate - b * x.rate**2)


def test_work_and_a_moving_support_both_change_the_energy_function() -> None:
    x = coordinate("x", "length")
    at = point(x, 0)
    L = lagrangian(System(Particle(m, at), damping(b, at), potential(k * (x - a * sin(w * t)) ** 2 / 2)))
    found = rate_of_energy(L)
    assert found.step.outcome == "work_and_time"
    expected = -b * x.rate**2 - k * (x.symbol - a * sin(w * t)) * a * w * cos(w * t)
    assert equal(explicit(found.value.right), expected)


def test_a_force_across_the_velocity_does_no_work() -> None:
    """Goldstein, section 1.5: forces that do no work leave the energy as it is."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    at = point(x, y)
    L = lagrangian(System(Particle(m, at), force((b * y.rate, -b * x.rate), at)))
    assert energy_function(L).step.outcome == "energy"
    assert rate_of_energy(L).step.outcome == "conserved"


def test_what_keeps_a_condition_works_only_where_the_condition_moves() -> None:
    """Goldstein, section 2.4: a block on a floor that is lifted takes up N times the velocity of the floor."""
    y = coordinate("y", "length")
    resting, lifted = (
        lagrangian(System(Particle(m, point(0, y)), weight(g), constraint(y, height, force="N")))
        for height in (l, a * t**2 / 2)
    )
    assert energy_function(resting).step.outcome == "energy"
    assert rate_of_energy(resting).step.outcome == "conserved"
    N = next(c.force for c in lifted.needed(energy.Constrained).constraints)
    assert equal(explicit(rate_of_energy(lifted).value.right), N * a * t)


def test_hamiltons_equations_have_the_generalized_force() -> None:
    """Goldstein, section 8.1: p_dot = -dH/dq + Q; a drag is written by the momentum, -b p/m."""
    L, x = on_spring(lambda at: damping(b, at), lambda at: force((F, 0), at))
    H = hamiltonian(L)
    p = H.needed(canonical.PhaseSpace).pairs[0][1]
    _, pushed = hamilton_equations(H)
    assert H.step.outcome == "work_energy"
    assert pushed.step.outcome == "applied"
    assert equal(explicit(pushed.value.right), F - k * x.symbol - b * p / m)
    assert pushed.value.left == rate(p)


def test_a_constant_force_moves_the_state_of_rest() -> None:
    """Taylor, problem 5.3: k x = F."""
    L, _ = on_spring(lambda at: force((F, 0), at))
    assert equal(equilibria(L)[0].value, F / k)


@pytest.mark.parametrize(
    ("module", "name", "wrong"),
    [
        (energy, "Factors", lambda *factors: 2 * factors[0] * factors[1]),
        (energy, "_powers_of_conditions", lambda of: [b]),
        (canonical, "spread", lambda value: 2 * value),
    ],
)
def test_a_wrong_power_is_refused(module: Any, name: str, wrong: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    L, _ = on_spring(lambda at: damping(b, at), lambda at: constraint(at.components[0], a * t, force="N"))
    h, H = energy_function(L), hamiltonian(L)
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises(Unverified):
        _ = energy_function_rate(h), hamilton_equations(H)
