"""Damped and driven systems to first order, their motions, and rest under given forces, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from sympy import Expr, atan, cos, diff, exp, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    Z,
    conserved,
    coordinate,
    damping,
    effective_potential,
    equation_of_motion,
    equations_of_motion,
    equilibria,
    force,
    kinetic_energy_of,
    lagrangian,
    linearised,
    normal_modes,
    point,
    potential,
    potential_energy_of,
    put_in,
    rate_of,
    solution,
    space,
    spring,
    stability,
    steady_amplitude,
    weight,
)
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.vibrations import linearised as linearised_module
from derive.steps.record import recorded
from derive.steps.step import Quantity

m, g, l, k, c, F, w, a = symbols("m g l k c F omega a", positive=True)
start = symbols("theta_0", real=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[None]:
    with recorded():
        yield


def pendulum(*more: Any, push: Any = None) -> tuple[Quantity, Any]:
    theta = coordinate("theta")
    at = point(l * sin(theta), -l * cos(theta))
    pushed = [force((push, 0), at)] if push is not None else []
    return lagrangian(System(Particle(m, at), weight(g), *pushed, *more)), theta


def damped() -> tuple[Quantity, Any]:
    theta = coordinate("theta")
    at = point(l * sin(theta), -l * cos(theta))
    return equation_of_motion(lagrangian(System(Particle(m, at), weight(g), damping(c, at))), theta), theta


def is_equation(found: Quantity, left: Expr, right: Expr = m - m) -> bool:
    return bool(equal(found.value, Relation(left, "=", right)))


def test_a_damped_pendulum_to_first_order_below_and_above() -> None:
    """Taylor, section 5.4: m l^2 theta_ddot + c l^2 theta_dot + m g l theta = 0; upside down with the other sign."""
    motion, theta = damped()
    below = linearised(motion)
    assert isinstance(below, Quantity)
    assert is_equation(below, m * l**2 * theta.acceleration + c * l**2 * theta.rate + m * g * l * theta.symbol)
    assert below.step.outcome == "damped"
    above = linearised(motion, at=pi, key="above")
    assert isinstance(above, Quantity)
    assert above.step.outcome == "displaced_damped"


@pytest.mark.long
def test_the_damped_pendulum_swings_creeps_or_does_neither() -> None:
    """Taylor, section 5.4, beta = c/(2m): the frequency sqrt(g/l - beta^2); on the border (1 + beta t) e^(-beta t)."""
    motion, theta = damped()
    linear = linearised(motion)
    assert isinstance(linear, Quantity)
    slow = c / (2 * m)
    fast = sqrt(g / l - slow**2)
    under = solution(linear, theta, start, 0, case="underdamped", key="under")
    assert equal(under.value, start * exp(-slow * t) * (cos(fast * t) + slow / fast * sin(fast * t)))
    over = solution(linear, theta, start, 0, case="overdamped", key="over")
    assert equal(over.value.subs(t, 0), start)
    assert equal(diff(over.value, t).subs(t, 0), 0)
    border = put_in(linear, {c: 2 * m * sqrt(g / l)})
    critical = solution(border, theta, start, 0, key="critical")
    assert critical.step.outcome == "critically_damped"
    assert equal(critical.value, start * (1 + sqrt(g / l) * t) * exp(-sqrt(g / l) * t))


def test_a_driven_pendulum_answers_with_the_known_amplitude() -> None:
    """Taylor, section 5.5."""
    theta = coordinate("theta")
    at = point(l * sin(theta), -l * cos(theta))
    parts = Particle(m, at), weight(g), damping(c, at), force((F * cos(w * t), 0), at)
    (linear,) = linearised(equations_of_motion(lagrangian(System(*parts))))
    assert linear.step.outcome == "driven"
    assert is_equation(
        linear,
        m * l**2 * theta.acceleration + c * l**2 * theta.rate + m * g * l * theta.symbol,
        F * l * cos(w * t),
    )
    amplitude, lag = steady_amplitude(linear, theta)
    assert equal(amplitude.value, F / sqrt(m**2 * (g - l * w**2) ** 2 + (c * l * w) ** 2))
    assert equal(lag.value, c * l * w / (m * (g - l * w**2)))
    with pytest.raises(Rejected, match="without a driving force"):
        normal_modes((linear,))


def test_a_pivot_that_is_shaken_sideways_drives_and_one_shaken_upwards_changes_the_coefficients() -> None:
    """Landau, Lifshitz, *Mechanics*, section 5, problem 3: l theta_ddot + g theta = a omega^2 cos(omega t) sideways."""
    theta = coordinate("theta")
    at = point(a * cos(w * t) + l * sin(theta), -l * cos(theta))
    (linear,) = linearised(equations_of_motion(lagrangian(System(Particle(m, at), weight(g)))))
    assert is_equation(linear, l * theta.acceleration + g * theta.symbol, a * w**2 * cos(w * t))
    shaken = point(l * sin(theta), a * cos(w * t) - l * cos(theta))
    motion = equation_of_motion(lagrangian(System(Particle(m, shaken), weight(g)), key="other", symbol="L_2"), theta)
    with pytest.raises(Rejected, match="must be constant"):
        linearised(motion)


def test_two_masses_one_of_them_damped() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    springs = spring(k, point(x, 0), point(0, 0)), spring(k, point(x, 0), point(y, 0))
    L = lagrangian(System(Particle(m, point(x, 0)), Particle(m, point(y, 0)), *springs, damping(c, x)))
    first, second = linearised(equations_of_motion(L))
    assert is_equation(first, m * x.acceleration + c * x.rate + 2 * k * x.symbol - k * y.symbol)
    assert is_equation(second, m * y.acceleration - k * x.symbol + k * y.symbol)
    assert {first.step.outcome, second.step.outcome} == {"damped"}


@pytest.mark.parametrize(
    ("with_a_line_before", "refused_by"), [(True, "does not follow from line 1"), (False, "second_order")]
)
def test_a_drag_that_is_left_out_of_the_linear_equation_is_refused(
    monkeypatch: pytest.MonkeyPatch, with_a_line_before: bool, refused_by: str
) -> None:
    motion, _ = damped()
    whole = linearised_module._coefficients

    def without_rates(*args: Any) -> Any:
        return whole(*args) * (0 if args[-1] == 1 else 1)

    monkeypatch.setattr(linearised_module, "_coefficients", without_rates)
    if not with_a_line_before:
        monkeypatch.setattr(linearised_module, "_with_small_angles", lambda *_: None)
    with pytest.raises(Unverified, match=refused_by):
        linearised(motion)


def test_a_driving_force_that_is_turned_round_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    L, theta = pendulum(push=F * cos(w * t))
    motion = equation_of_motion(L, theta)
    monkeypatch.setattr(Matter, "force_along", lambda matter, q: matter.stored_force_along(q))
    with pytest.raises(Unverified, match="second_order"):
        linearised(motion)


def test_a_pendulum_in_a_steady_wind_hangs_aslant() -> None:
    """tan(theta) = F/(m g): stable; the opposite place is not."""
    L, _ = pendulum(push=F)
    aslant, opposite = equilibria(L)
    assert equal(aslant.value, atan(F / (m * g)))
    assert stability(L, aslant).step.outcome == "stable"
    assert stability(L, opposite).step.outcome == "unstable"


def test_damping_does_not_move_the_places_of_rest() -> None:
    theta = coordinate("theta")
    at = point(l * sin(theta), -l * cos(theta))
    L = lagrangian(System(Particle(m, at), weight(g), damping(c, at)))
    assert [rest.value for rest in equilibria(L)] == [0, pi]


def test_rest_under_a_force_that_is_not_constant_is_not_told() -> None:
    theta = coordinate("theta")
    L, _ = pendulum(push=F * cos(theta))
    with pytest.raises(Rejected, match="not constant"):
        equilibria(L)


def test_what_turns_may_be_held_without_a_minimum_and_is_not_judged_at_rest() -> None:
    """Goldstein, Poole, Safko, section 6.6 and Landau, section 39: the Coriolis force can hold a maximum."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    L = lagrangian(System(Particle(m, space.turned(Z, w * t).place(x, y, 0)), potential(-k * (x**2 + y**2) / 2)))
    (rest,) = equilibria(L)
    with pytest.raises(Rejected, match="may stabilise the equilibrium"):
        stability(L, rest)


def test_in_a_turning_frame_a_minimum_is_stable() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    L = lagrangian(System(Particle(m, space.turned(Z, w * t).place(x, y, 0)), potential(m * w**2 * (x**2 + 2 * y**2))))
    (rest,) = equilibria(L)
    assert stability(L, rest).step.outcome == "stable"


def test_a_momentum_that_a_drag_takes_is_not_conserved() -> None:
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    at = point(r * cos(phi), r * sin(phi))
    L = lagrangian(System(Particle(m, at), damping(c, at), potential(k * r**2 / 2)))
    with pytest.raises(Rejected, match="a force that is not in `lagrangian` acts along phi"):
        conserved(L, phi)


def test_an_effective_potential_under_given_forces_is_refused() -> None:
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    at = point(r * cos(phi), r * sin(phi))
    outwards = force((F * cos(phi), F * sin(phi)), at)
    L = lagrangian(System(Particle(m, at), outwards, potential(k * r**2 / 2)))
    with pytest.raises(Rejected, match="without a potential energy acts along r"):
        effective_potential(L, conserved(L, phi))


def test_what_is_known_at_one_moment_has_no_rate() -> None:
    theta = coordinate("theta")
    at = point(l * sin(theta), -l * cos(theta))
    T = kinetic_energy_of(System(Particle(m, at), weight(g), potential(k * theta.symbol**2)))
    U = potential_energy_of(System(Particle(m, at), weight(g)))
    lowest = put_in(U, theta=0)
    with pytest.raises(Rejected, match="`potential_energy_at_theta` is known only for one value of theta"):
        rate_of(lowest)
    again = put_in(put_in(T, {theta.rate: w}), {m: 2 * m}, key="heavier", symbol="K")
    with pytest.raises(Rejected, match="known only for one value of theta"):
        rate_of(again)
    assert rate_of(put_in(U, {g: 2 * g}, key="elsewhere", symbol="W")).value != 0


class TestAloneInItsEquation:
    """A puck on a turntable: Taylor, problem 9.20. The other coordinate moves, so its rate is no constant."""

    def turntable(self) -> tuple[Any, Any, tuple[Quantity, ...]]:
        x, y = coordinate("x", "length"), coordinate("y", "length")
        table = space.turned(Z, w * t)
        return x, y, equations_of_motion(lagrangian(System(Particle(m, table.place(x, y, 0)))))

    def test_rate_of_another_coordinate_is_no_constant(self) -> None:
        x, _, (along_x, _) = self.turntable()
        with pytest.raises(Rejected, match="it also contains y_dot"):
            solution(along_x, x, a)

    def test_nor_is_its_acceleration(self) -> None:
        """A bead on a helical track of a cylinder that turns: Goldstein, problem 8.24."""
        theta, phi = coordinate("theta"), coordinate("phi")
        helix = space.turned(Z, theta).place(a * cos(phi), a * sin(phi), -l * phi)
        motion = equations_of_motion(lagrangian(System(Particle(m, helix), weight(g))))[1]
        with pytest.raises(Rejected, match="it also contains theta_ddot"):
            solution(motion, phi, 0)

    def test_start_that_moves_is_refused(self) -> None:
        x, y, (along_x, _) = self.turntable()
        still = put_in(along_x, {y.rate: 0})
        with pytest.raises(Rejected, match="constant start"):
            solution(still, x, y.symbol)

    def test_a_coordinate_that_is_substituted_must_stay_so(self) -> None:
        """With y_dot = 0 for one instant the equation is that of cosh, but the Coriolis force sets y moving."""
        x, y, (along_x, _) = self.turntable()
        with pytest.raises(Unverified, match="the described motion from this start is a different one"):
            solution(put_in(along_x, {y.rate: 0}), x, a)
