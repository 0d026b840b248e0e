"""Lagrangians that are given as formulas, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from sympy import Expr, Rational, cos, exp, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    conserved,
    coordinate,
    couple,
    damping,
    energy_function,
    energy_function_rate,
    equation_of_motion,
    equations_of_motion,
    equilibria,
    given_lagrangian,
    hamilton_equations,
    hamiltonian,
    lagrangian,
    linearised,
    noether,
    normal_modes,
    poisson_bracket,
    routhian,
    stability,
)
from derive.mechanics.lagrange import energy_function as energy_module
from derive.mechanics.lagrange import lagrangian as lagrangian_module
from derive.mechanics.lagrange.facts import Varied
from derive.mechanics.rest import equilibria as equilibria_module
from derive.solving.zeros import Zero
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity

m, c, k, g, G = symbols("m c k g gamma", positive=True)
L1, C1, R1 = symbols("L_1 C_1 R_1", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def relativistic() -> Quantity:
    x = coordinate("x", "length")
    return given_lagrangian(-m * c**2 * sqrt(1 - x.rate**2 / c**2) - k * x.symbol**2 / 2)


def test_a_relativistic_oscillator() -> None:
    """Goldstein, section 7.9: p = m v/sqrt(1 - v^2/c^2), H = sqrt(m^2 c^4 + p^2 c^2) + V."""
    L = relativistic()
    x = coordinate("x", "length")
    motion = explicit(equation_of_motion(L, x).value)
    assert equal(motion, Relation(m * x.acceleration / (1 - x.rate**2 / c**2) ** Rational(3, 2) + k * x.symbol, "=", 0))
    h = energy_function(L)
    assert h.step.outcome == "given_conserved"
    assert equal(h.value, m * c**2 / sqrt(1 - x.rate**2 / c**2) + k * x.symbol**2 / 2)
    H = hamiltonian(L)
    p = symbols("p_x", real=True)
    assert equal(H.value, sqrt(m**2 * c**4 + p**2 * c**2) + k * x.symbol**2 / 2)
    assert len(hamilton_equations(H)) == 2


@pytest.mark.long
def test_a_relativistic_particle_in_a_plane_in_a_magnetic_field() -> None:
    """Goldstein, section 7.9, with the potential A = B(-y, x)/2: p = m v/sqrt(1 - v^2/c^2) + q A."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    b = symbols("b", real=True)  # q B/2
    slow = sqrt(1 - (x.rate**2 + y.rate**2) / c**2)
    L = given_lagrangian(-m * c**2 * slow + b * (x.symbol * y.rate - y.symbol * x.rate))
    H = hamiltonian(L)
    px, py = symbols("p_x p_y", real=True)
    square = (px + b * y.symbol) ** 2 + (py - b * x.symbol) ** 2
    assert equal(H.value, c * sqrt(m**2 * c**2 + square))
    turned = poisson_bracket(x.symbol * py - y.symbol * px, H)
    assert turned.value == 0
    Q = noether(L, {x: -y.symbol, y: x.symbol})
    assert equal(Q.value, m * (x.symbol * y.rate - y.symbol * x.rate) / slow + b * (x.symbol**2 + y.symbol**2))


def test_an_oscillator_that_the_time_damps() -> None:
    """Goldstein, exercise 2.14, L = e^(gamma t) (m q_dot^2/2 - k q^2/2): x_ddot + gamma x_dot + (k/m) x = 0."""
    x = coordinate("x", "length")
    L = given_lagrangian(exp(G * t) * (m * x.rate**2 - k * x.symbol**2) / 2)
    motion = explicit(equation_of_motion(L, x).value)
    assert equal(motion, Relation(m * x.acceleration + m * G * x.rate + k * x.symbol, "=", 0))
    h = energy_function(L)
    assert h.step.outcome == "given_changing"
    lost = energy_function_rate(h)
    assert equal(explicit(lost.value).right, -G * exp(G * t) * (m * x.rate**2 - k * x.symbol**2) / 2)


def test_a_circuit_with_a_resistance() -> None:
    """Goldstein, section 2.5, equation (2.66): L q_ddot + R q_dot + q/C = 0."""
    q = coordinate("q", "charge")
    L = given_lagrangian(L1 * q.rate**2 / 2 - q.symbol**2 / (2 * C1), damping(R1, q))
    motion = explicit(equation_of_motion(L, q).value)
    assert equal(motion, Relation(L1 * q.acceleration + R1 * q.rate + q.symbol / C1, "=", 0))
    h = energy_function(L)
    assert h.step.outcome == "given_work"
    assert equal(explicit(energy_function_rate(h).value).right, -R1 * q.rate**2)


def test_geodesics_on_a_sphere() -> None:
    """Goldstein, exercise 2.4: sin^2 theta phi_dot over the speed is constant; the energy function vanishes."""
    theta, phi = coordinate("theta"), coordinate("phi")
    size = sqrt(theta.rate**2 + sin(theta.symbol) ** 2 * phi.rate**2)
    L = given_lagrangian(size, kind="angular speed")
    assert len(equations_of_motion(L)) == 2
    kept = conserved(L, phi)
    assert kept.step.outcome == "other"
    assert equal(kept.value, sin(theta.symbol) ** 2 * phi.rate / size)
    assert energy_function(L).value == 0
    with pytest.raises(Rejected, match="rates follow from momenta only if"):
        hamiltonian(L)


def test_rest_modes_and_routhian_of_what_is_given() -> None:
    """Landau, section 14: the spherical pendulum by its Lagrangian alone; Taylor, problem 11.5 for two circuits."""
    theta, phi = coordinate("theta"), coordinate("phi")
    l = symbols("l", positive=True)
    kinetic = m * l**2 * (theta.rate**2 + sin(theta.symbol) ** 2 * phi.rate**2) / 2
    L = given_lagrangian(kinetic + m * g * l * cos(theta.symbol))
    R = routhian(L, conserved(L, phi))
    p = symbols("p_phi", real=True)
    expected = (
        m * l**2 * theta.rate**2 / 2 - p**2 / (2 * m * l**2 * sin(theta.symbol) ** 2) + m * g * l * cos(theta.symbol)
    )
    assert equal(R.value, expected)
    one, two = coordinate("q_1", "charge"), coordinate("q_2", "charge")
    mutual = L1 / 3  # one above L1 would make the kinetic energy negative somewhere, and the circuits unstable
    value: Expr = L1 * (one.rate**2 + two.rate**2) / 2 + mutual * one.rate * two.rate
    circuits = given_lagrangian(value - (one.symbol**2 + two.symbol**2) / (2 * C1), symbol="L_2", key="lagrangian_2")
    rest = equilibria(circuits)
    assert len(rest) == 1
    assert stability(circuits, rest[0]).step.outcome == "stable"
    modes = normal_modes(linearised(equations_of_motion(circuits)))
    assert any(equal(mode.value, 1 / sqrt(C1 * (L1 + mutual))) for mode in modes if mode.key.startswith("frequency"))


def test_what_needs_bodies_is_refused() -> None:
    x = coordinate("x", "length")
    with pytest.raises(Rejected, match="needs the rate of a coordinate"):
        given_lagrangian(k * x.symbol**2)
    with pytest.raises(Rejected, match="but not x_ddot"):
        given_lagrangian(m * x.rate**2 + m * x.symbol * x.acceleration)
    with pytest.raises(Rejected):
        lagrangian(relativistic())


def test_a_wrong_energy_function_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """h = q_dot dL/dq_dot + L changes along the motion."""
    real = energy_module.Terms
    monkeypatch.setattr(energy_module, "Terms", lambda *terms: real(*terms[:-1], -terms[-1]))
    monkeypatch.setattr(energy_module, "beside_potential", lambda value, of, *_: value + 2 * explicit(of.value))
    with pytest.raises(Unverified, match="second route"):
        energy_function(relativistic())


def test_the_energy_identity_alone_refuses_a_wrong_equation(monkeypatch: pytest.MonkeyPatch) -> None:
    """d/dt dL/dq_dot + dL/dq = 0, where the varied action has the same slip."""
    right = Varied.turning_along
    monkeypatch.setattr(Varied, "turning_along", lambda self, q: -right(self, q))
    partial = lagrangian_module.Partial
    x = coordinate("x", "length")
    monkeypatch.setattr(lagrangian_module, "Partial", lambda L, s: -partial(L, s) if s == x.symbol else partial(L, s))
    with pytest.raises(Unverified):
        equation_of_motion(relativistic(), x, derivatives=False)


def twisted() -> Quantity:
    theta = coordinate("theta")
    return given_lagrangian(m * theta.rate**2 / 2 - k * theta.symbol**2 / 2, couple(g, theta))


def test_a_twisted_wire_rests_where_it_balances_a_couple_perhaps_after_many_turns() -> None:
    (rest,) = equilibria(twisted())
    assert equal(rest.value, g / k)
    assert stability(twisted(), rest).step.outcome == "stable"


@pytest.mark.parametrize("found", [[-g / k], [2 * g / k], [g / k, -g / k], [g / k, 0], []])
def test_another_rest_of_the_wire_is_refused(found: list[Expr], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(equilibria_module, "zeros_of", lambda force, q: [Zero(value + 0 * k) for value in found])
    with pytest.raises(Unverified if found else Rejected):
        equilibria(twisted())


def test_a_force_that_comes_back_after_a_turn_is_counted_once_round() -> None:
    theta = coordinate("theta")
    pushed = given_lagrangian(m * theta.rate**2 / 2 + k * cos(theta.symbol), couple(k / 2, theta))
    assert {rest.value for rest in equilibria(pushed)} == {pi / 6, 5 * pi / 6}
