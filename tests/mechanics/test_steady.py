"""Steady motions and small oscillations about them, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from sympy import Expr, Integer, cos, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation
from derive.algebra.ranges import Range, within
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    RigidBody,
    System,
    X,
    Z,
    conserved,
    coordinate,
    damping,
    effective_potential,
    equilibria,
    euler_angles,
    frequency,
    frequency_squared_about,
    lagrangian,
    point,
    potential,
    roots,
    space,
    stability,
    steady_motion,
    weight,
    where,
)
from derive.mechanics.motion import steady as steady_module
from derive.mechanics.vibrations import about_steady_motion as about_module
from derive.steps.record import recorded
from derive.steps.step import Quantity

m, M, g, l, w, Omega, spin, G, I1, I3, r0 = symbols("m M g l omega Omega omega_3 G I_1 I_3 r_0", positive=True)
alpha = symbols("alpha", real=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[None]:
    with recorded(), within({alpha: Range(Integer(0), pi / 2)}):
        yield


def spherical_pendulum() -> tuple[Quantity, Coordinate, Coordinate]:
    theta, phi = coordinate("theta"), coordinate("phi")
    at = point(l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta))
    return lagrangian(System(Particle(m, at), weight(g))), theta, phi


def planet(symbol: str = "L") -> tuple[Quantity, Coordinate, Coordinate]:
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    attracted = potential(-G * M * m / r)
    return lagrangian(System(Particle(m, point(r * cos(phi), r * sin(phi))), attracted), symbol=symbol), r, phi


def conical() -> tuple[Quantity, Quantity]:
    L, theta, phi = spherical_pendulum()
    steady = one(steady_motion(L, {phi: Omega}, {theta: alpha}))
    return effective_potential(L, conserved(L, phi, "l_z")), steady


def one(found: Quantity | tuple[Quantity, ...]) -> Quantity:
    assert isinstance(found, Quantity)
    return found


def holds(found: Quantity, left: Expr, *nonzero: Expr) -> bool:
    return bool(equal(found.value, Relation(left, "=", 0), nonzero))


def test_the_conical_pendulum_goes_round_at_the_known_rate_and_only_if_fast_enough() -> None:
    """Landau, section 14, problem 1; Taylor, example 7.6: cos(theta) = g/(l Omega^2), which needs Omega^2 > g/l."""
    L, theta, phi = spherical_pendulum()
    steady = one(steady_motion(L, {phi: Omega}))
    (cosine,) = roots(steady, cos(theta.symbol))
    assert equal(cosine.value, g / (l * Omega**2))
    fast = where(cosine, "<", Integer(1), Omega)
    assert fast.value == Relation(Omega, ">", sqrt(g) / sqrt(l))
    (rate,) = roots(one(steady_motion(L, {phi: Omega}, {theta: alpha}, key="at_alpha")), Omega)
    assert equal(rate.value, sqrt(g / (l * cos(alpha))))


def test_about_the_conical_pendulum_it_swings_at_the_known_frequency() -> None:
    """Goldstein, chapter 6, exercises; Taylor, problem 7.38: Omega^2 (1 + 3 cos^2 alpha)."""
    U, steady = conical()
    squared = frequency_squared_about(U, steady)
    assert equal(squared.value, Omega**2 * (1 + 3 * cos(alpha) ** 2))
    assert squared.step.outcome == "stable"
    assert equal(frequency(squared).value, Omega * sqrt(1 + 3 * cos(alpha) ** 2))


def test_the_same_frequency_by_the_weight_in_place_of_the_rate() -> None:
    U, steady = conical()
    squared = frequency_squared_about(U, steady, without=Omega)
    assert equal(squared.value, g * (1 + 3 * cos(alpha) ** 2) / (l * cos(alpha)))
    assert squared.step.outcome == "stable"


def test_a_circular_orbit_its_radius_and_that_it_closes() -> None:
    """Landau, section 15; Goldstein, section 3.6: r_0 = l^2/(G M m^2), and the frequency of r is that of phi."""
    L, r, phi = planet()
    U = effective_potential(L, conserved(L, phi, "l"))
    (circle,) = equilibria(U)
    momentum = symbols("l", real=True)
    assert equal(circle.value, momentum**2 / (G * M * m**2))
    assert stability(U, circle).step.outcome == "stable"
    assert equal(frequency_squared_about(U, circle).value, (G * M) ** 4 * m**6 / momentum**6)
    steady = one(steady_motion(L, {phi: Omega}, {r: r0}))
    assert equal(roots(steady, Omega)[0].value, sqrt(G * M / r0**3))
    assert equal(frequency_squared_about(U, steady, symbol="omega_r", key="radial").value, Omega**2)


def test_a_force_of_another_power_opens_the_orbit() -> None:
    """Goldstein, section 3.6: omega_r^2 = (3 + n) Omega^2 for a force as r^n; 4 Omega^2 for a spring."""
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    L = lagrangian(System(Particle(m, point(r * cos(phi), r * sin(phi))), potential(G * r**2 / 2)))
    steady = one(steady_motion(L, {phi: Omega}, {r: r0}))
    U = effective_potential(L, conserved(L, phi, "l"))
    assert equal(frequency_squared_about(U, steady).value, 4 * Omega**2)


def heavy_top() -> tuple[Quantity, Any, Any, Any]:
    phi, theta, psi = euler_angles()
    axes = space.turned(Z, phi).turned(X, theta).turned(Z, psi)
    body = RigidBody(M, (I1, I1, I3), centre=(0, 0, l)).held(axes, at="pivot")
    return lagrangian(System(body, weight(g))), phi, theta, psi


def test_the_heavy_top_precesses_at_the_roots_of_the_known_equation() -> None:
    """Goldstein, section 5.7; Landau, section 35: I_1 Omega^2 cos(alpha) - I_3 omega_3 Omega + M g l = 0."""
    L, phi, theta, psi = heavy_top()
    steady = one(steady_motion(L, {phi: Omega, psi: spin - Omega * cos(alpha)}, {theta: alpha}))
    assert holds(steady, (I1 * Omega**2 * cos(alpha) - I3 * spin * Omega + M * g * l) * sin(alpha))
    slow, fast = roots(steady, Omega)
    under = sqrt(I3**2 * spin**2 - 4 * I1 * M * g * l * cos(alpha))
    for found, sign in ((slow, -1), (fast, 1)):
        assert equal(found.value, (I3 * spin + sign * under) / (2 * I1 * cos(alpha)))


def test_a_rate_may_be_told_by_the_letter_of_another() -> None:
    L, phi, theta, psi = heavy_top()
    steady = one(steady_motion(L, {psi: spin - phi.rate * cos(alpha)}, {theta: alpha}))
    assert len(roots(steady, phi.rate)) == 2


def test_the_governor_rises_as_it_turns_faster() -> None:
    """Watt's governor: m Omega^2 l cos(alpha) = (m + M) g, and its oscillations."""
    theta, phi = coordinate("theta"), coordinate("phi")
    axes = space.turned(Z, phi)
    balls = [Particle(m, axes.place(side * l * sin(theta), 0, -l * cos(theta))) for side in (1, -1)]
    sleeve = Particle(M, axes.place(0, 0, -2 * l * cos(theta)))
    L = lagrangian(System(*balls, sleeve, weight(g)))
    steady = one(steady_motion(L, {phi: Omega}, {theta: alpha}))
    assert holds(steady, (m * Omega**2 * l * cos(alpha) - (m + M) * g) * sin(alpha))
    squared = frequency_squared_about(effective_potential(L, conserved(L, phi, "p")), steady)
    assert equal(squared.value, m * Omega**2 * (1 + 3 * cos(alpha) ** 2) / (m + 2 * M * sin(alpha) ** 2))


def test_about_rest_the_mass_may_depend_on_the_place() -> None:
    """Landau, section 21: omega^2 = k/m with both at rest; on a hoop that turns, Taylor, section 7.6."""
    theta = coordinate("theta")
    bead = Particle(m, space.turned(Z, w * t).place(l * sin(theta), 0, -l * cos(theta)))
    L = lagrangian(System(bead, weight(g)))
    rests = equilibria(L)
    found = [frequency_squared_about(L, rest, symbol=f"omega_{n}", key=f"at_{n}") for n, rest in enumerate(rests, 1)]
    values = [g / l - w**2, -g / l - w**2, w**2 - g**2 / (l * w) ** 2, w**2 - g**2 / (l * w) ** 2]
    assert all(equal(each.value, value) for each, value in zip(found, values, strict=True))
    assert [each.step.outcome for each in found] == ["conditional", "unstable", "stable", "stable"]


def test_two_coordinates_that_stay_have_a_condition_each() -> None:
    r, z, phi = coordinate("r", "length", positive=True), coordinate("z", "length"), coordinate("phi")
    springs = potential(G * (r - l) ** 2 / 2 + G * z**2 / 2)
    L = lagrangian(System(Particle(m, point(r * cos(phi), r * sin(phi), z)), springs, weight(g)))
    found = steady_motion(L, {phi: Omega})
    assert isinstance(found, tuple)
    outward, upward = found
    assert [each.key for each in found] == ["steady_motion_r", "steady_motion_z"]
    assert holds(outward, m * r.symbol * Omega**2 - G * (r.symbol - l))
    assert holds(upward, G * z.symbol + m * g)
    U = effective_potential(L, conserved(L, phi, "p"))
    with pytest.raises(Rejected, match="needs one remaining coordinate"):
        frequency_squared_about(U, outward)


def test_straight_down_any_rate_will_do() -> None:
    L, theta, phi = spherical_pendulum()
    assert one(steady_motion(L, {phi: Omega}, {theta: 0})).step.outcome == "always"


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda L, theta, phi: steady_motion(L, {theta: Omega}), "a rate is given for theta, which is not cyclic"),
        (lambda L, theta, phi: steady_motion(L, {phi: Omega}, {phi: 0}), "a value is given for phi"),
        (lambda L, theta, phi: steady_motion(L, {phi: Omega * t}), "needs a constant rate"),
        (lambda L, theta, phi: steady_motion(L, {phi: theta.rate}), "needs a constant rate"),
        (lambda L, theta, phi: steady_motion(L, {phi: Omega}, {theta: theta.symbol}), "needs a constant value"),
    ],
)
def test_wrong_questions_are_refused(ask: Any, message: str) -> None:
    L, theta, phi = spherical_pendulum()
    with pytest.raises(Rejected, match=message):
        ask(L, theta, phi)


def test_what_is_pushed_apart_has_no_circular_orbit() -> None:
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    L = lagrangian(System(Particle(m, point(r * cos(phi), r * sin(phi))), potential(G / r)))
    with pytest.raises(Rejected, match="there is no such steady motion"):
        steady_motion(L, {phi: Omega}, {r: r0})


def test_a_drag_lets_no_motion_be_steady() -> None:
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    at = point(r * cos(phi), r * sin(phi))
    L = lagrangian(System(Particle(m, at), potential(G * r**2), damping(M, at)))
    with pytest.raises(Rejected, match="some have no potential energy"):
        steady_motion(L, {phi: Omega})


def test_the_steady_motion_of_another_system_is_refused() -> None:
    _, steady = conical()
    L, _, phi = planet("L_2")
    U = effective_potential(L, conserved(L, phi, "j", key="other_momentum"), symbol="V_eff", key="other")
    with pytest.raises(Rejected, match="belong to different Lagrangians"):
        frequency_squared_about(U, steady)


def test_a_letter_that_the_condition_does_not_hold_cannot_be_taken_out() -> None:
    U, steady = conical()
    with pytest.raises(Rejected, match="cannot be solved for m"):
        frequency_squared_about(U, steady, without=m)


def test_a_condition_that_forgets_the_turning_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    L, theta, phi = spherical_pendulum()
    monkeypatch.setattr(steady_module, "Partial", lambda L, q: (L - phi.rate**2 * L.coeff(phi.rate, 2)).diff(q))
    with pytest.raises(Unverified):
        steady_motion(L, {phi: Omega}, {theta: alpha})


def test_a_curvature_with_the_rate_held_in_place_of_the_momentum_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    U, steady = conical()
    wrong = Omega**2 * (1 - cos(alpha) ** 2)  # that of a hoop driven at this rate
    monkeypatch.setattr(about_module, "by_one_square", lambda _: wrong)
    monkeypatch.setattr(about_module, "Ratio", lambda *_: wrong)
    with pytest.raises(Unverified):
        frequency_squared_about(U, steady)


def test_a_wrong_mass_is_refused_by_the_second_route(monkeypatch: pytest.MonkeyPatch) -> None:
    U, steady = conical()
    plain = about_module.tidied
    monkeypatch.setattr(about_module, "tidied", lambda value: 2 * plain(value))
    with pytest.raises(Unverified, match="all_coordinates"):
        frequency_squared_about(U, steady, without=g)
