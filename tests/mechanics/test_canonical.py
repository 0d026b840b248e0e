"""Momenta, energy functions, Hamiltonians and Hamilton's equations, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Expr, cos, sin, symbols

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    Z,
    central,
    conjugate,
    conjugate_momentum,
    conserved,
    coordinate,
    energy_function,
    energy_function_rate,
    hamilton_equations,
    hamiltonian,
    in_momenta,
    kinetic_energy_of,
    lagrangian,
    let,
    momenta,
    point,
    rate_under,
    space,
    spring,
    weight,
)
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity

m, M, g, l, k, R, w, a = symbols("m M g l k R omega a", positive=True)
m1, m2, l1, l2 = symbols("m_1 m_2 l_1 l_2", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def pendulum() -> Quantity:
    q = coordinate("theta")
    return lagrangian(System(Particle(m, point(l * sin(q), -l * cos(q))), weight(g)))


def spherical_pendulum() -> Quantity:
    q, phi = coordinate("theta"), coordinate("phi")
    at = point(l * sin(q) * cos(phi), l * sin(q) * sin(phi), -l * cos(q))
    return lagrangian(System(Particle(m, at), weight(g)))


def bead_on_turning_hoop() -> Quantity:
    q = coordinate("theta")
    return lagrangian(System(Particle(m, space.turned(Z, w * t).place(R * sin(q), 0, -R * cos(q))), weight(g)))


def in_elevator() -> Quantity:
    z = coordinate("z", "length")
    return lagrangian(System(Particle(m, point(0, z + a * t**2 / 2)), weight(g)))


def pendulum_on_cart() -> Quantity:
    x, q = coordinate("x", "length"), coordinate("theta")
    return lagrangian(System(Particle(M, point(x, 0)), Particle(m, point(x + l * sin(q), -l * cos(q))), weight(g)))


def letters(text: str) -> Any:
    return symbols(text, real=True)


def same(found: Quantity, expected: Expr) -> bool:
    return bool(equal(explicit(found.value), expected)) and found.step.grade is Grade.PROVED


# --- momenta ---


def test_the_momentum_of_an_angle_is_an_angular_momentum() -> None:
    (p,) = momenta(pendulum())
    assert same(p, m * l**2 * letters("theta_dot"))
    assert (p.key, p.symbol, p.step.kind) == ("p_theta", letters("p_theta"), "angular momentum")


def test_the_momentum_of_a_length_is_a_momentum() -> None:
    x, q = momenta(pendulum_on_cart())
    assert same(x, (M + m) * letters("x_dot") + m * l * letters("theta_dot") * cos(letters("theta")))
    assert (x.step.kind, q.step.kind) == ("momentum", "angular momentum")


def test_a_momentum_may_have_another_letter() -> None:
    L = pendulum()
    found = conjugate_momentum(L, coordinate("theta"), symbol="J")
    assert (found.symbol, found.key) == (letters("J"), "J")


# --- the energy function ---


def test_a_pendulum_conserves_its_energy() -> None:
    h = energy_function(pendulum())
    assert same(h, m * l**2 * letters("theta_dot") ** 2 / 2 - m * g * l * cos(letters("theta")))
    assert h.step.outcome == "energy"
    assert energy_function_rate(h).step.outcome == "conserved"


def test_what_a_bead_on_a_turning_hoop_conserves_is_not_its_energy() -> None:
    """Goldstein, section 2.7; Taylor, problem 7.35: h = T_2 - T_0 + U, which is not T + U."""
    h = energy_function(bead_on_turning_hoop())
    q, rate = letters("theta theta_dot")
    assert same(h, m * R**2 * (rate**2 - w**2 * sin(q) ** 2) / 2 - m * g * R * cos(q))
    assert h.step.outcome == "conserved"
    told = dict(h.step.roles)["excess"]
    assert equal(told, m * R**2 * w**2 * sin(q) ** 2)


def test_in_an_elevator_that_accelerates_nothing_of_the_kind_is_conserved() -> None:
    h = energy_function(in_elevator())
    z, v = letters("z z_dot")
    assert same(h, m * v**2 / 2 - m * a**2 * t**2 / 2 + m * g * (z + a * t**2 / 2))
    assert h.step.outcome == "changing"
    rate = energy_function_rate(h)
    assert rate.step.outcome == "changes"
    assert equal(explicit(rate.value).right, -m * a * v - m * a**2 * t + m * g * a * t)


# --- Hamiltonians ---


def test_the_hamiltonian_of_a_pendulum() -> None:
    H = hamiltonian(pendulum())
    p, q = letters("p_theta theta")
    assert same(H, p**2 / (2 * m * l**2) - m * g * l * cos(q))
    assert H.step.outcome == "energy"


def test_the_hamiltonian_of_a_planet() -> None:
    """Goldstein, section 8.1: p_r^2/2m + p_phi^2/2mr^2 + U."""
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    at, d = point(r * cos(phi), r * sin(phi)), symbols("d", positive=True)
    H = hamiltonian(lagrangian(System(Particle(m, at), central(-k / d, d, point(0, 0), at))))
    p_r, p_phi = letters("p_r p_phi")
    assert same(H, p_r**2 / (2 * m) + p_phi**2 / (2 * m * r.symbol**2) - k / r.symbol)


def test_the_hamiltonian_of_a_spherical_pendulum() -> None:
    """Taylor, problem 13.14."""
    H = hamiltonian(spherical_pendulum())
    p, p_phi, q = letters("p_theta p_phi theta")
    assert same(H, p**2 / (2 * m * l**2) + p_phi**2 / (2 * m * l**2 * sin(q) ** 2) - m * g * l * cos(q))


def test_the_hamiltonian_of_a_bead_on_a_turning_hoop_is_not_its_energy() -> None:
    H = hamiltonian(bead_on_turning_hoop())
    p, q = letters("p_theta theta")
    assert same(H, p**2 / (2 * m * R**2) - m * R**2 * w**2 * sin(q) ** 2 / 2 - m * g * R * cos(q))
    assert H.step.outcome == "conserved"


def test_the_hamiltonian_in_an_elevator_contains_the_time() -> None:
    H = hamiltonian(in_elevator())
    p, z = letters("p_z z")
    assert same(H, p**2 / (2 * m) - a * t * p + m * g * (z + a * t**2 / 2))
    assert H.step.outcome == "changing"


def test_coupled_momenta_are_solved_together() -> None:
    """A pendulum on a cart: the mass matrix has the determinant m l^2 (M + m sin^2 theta)."""
    H = hamiltonian(pendulum_on_cart())
    p_x, p, q = letters("p_x p_theta theta")
    moving = m * l**2 * p_x**2 + (M + m) * p**2 - 2 * m * l * p_x * p * cos(q)
    assert same(H, moving / (2 * m * l**2 * (M + m * sin(q) ** 2)) - m * g * l * cos(q))
    rate = next(parent for parent in H.parents if parent.key == "hamiltonian_rate_x")
    assert same(rate, (l * p_x - p * cos(q)) / (l * (M + m * sin(q) ** 2)))


def test_atwoods_machine_moves_as_one_mass() -> None:
    """Taylor, example 13.2."""
    x = coordinate("x", "length")
    H = hamiltonian(lagrangian(System(Particle(m1, -x * Z), Particle(m2, (x - l) * Z), weight(g))))
    p = letters("p_x")
    assert same(H, p**2 / (2 * (m1 + m2)) - m1 * g * x.symbol + m2 * g * (x.symbol - l))


# --- Hamilton's equations ---


def test_hamiltons_equations_of_a_spherical_pendulum() -> None:
    found = hamilton_equations(hamiltonian(spherical_pendulum()))
    p, p_phi, q = letters("p_theta p_phi theta")
    expected = {
        "canonical_theta": p / (m * l**2),
        "canonical_p_theta": p_phi**2 * cos(q) / (m * l**2 * sin(q) ** 3) - m * g * l * sin(q),
        "canonical_phi": p_phi / (m * l**2 * sin(q) ** 2),
        "canonical_p_phi": 0,
    }
    assert [each.key for each in found] == list(expected)
    assert [each.step.outcome for each in found] == ["rate", "force", "rate", "cyclic"]
    for each in found:
        name = each.key.removeprefix("canonical_")
        assert equal(each.value, Relation(letters(f"{name}_dot"), "=", expected[each.key]))


def test_hamiltons_equations_serve_as_equations_of_motion() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    at = point(x, y)
    H = hamiltonian(lagrangian(System(Particle(m, at), spring(k, point(0, 0), at))))
    p_x, p_y = conjugate(x), conjugate(y)
    turning = let("J", lambda: x * p_y.symbol - y * p_x.symbol)
    assert rate_under(turning, hamilton_equations(H)).step.outcome == "conserved"


def test_a_conserved_momentum_is_written_by_the_momenta() -> None:
    L = spherical_pendulum()
    found = in_momenta(conserved(L, coordinate("phi"), value="J"), hamiltonian(L))
    assert same(found, letters("p_phi"))


# --- what is refused ---


def test_a_massless_coordinate_has_no_hamiltonian() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    with pytest.raises(Rejected, match="do not determine"):
        hamiltonian(lagrangian(System(Particle(m, point(x + y, 0)))))


def test_a_chain_that_is_coupled_too_far_is_refused_at_once() -> None:
    angles = [coordinate(f"theta_{i}") for i in range(1, 4)]
    at, bobs = point(0, 0), []
    for q in angles:
        at = at + point(l * sin(q), -l * cos(q))
        bobs.append(Particle(m, at))
    with pytest.raises(Rejected, match="must be solved"):
        hamiltonian(lagrangian(System(*bobs)))


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: hamilton_equations(pendulum()), "not a function of coordinates and their momenta"),
        (lambda: energy_function(kinetic_energy_of(System(Particle(m, point(coordinate("x"), 0))))), "not a Lagr"),
        (lambda: conjugate_momentum(pendulum(), coordinate("phi")), "does not depend on the coordinate"),
        (lambda: energy_function_rate(pendulum()), "does not come from a Lagrangian"),
        (lambda: in_momenta(hamiltonian(pendulum()), hamiltonian(pendulum())), "contains no rate"),
        (lambda: conjugate(coordinate("A", "mass")), "no known kind"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong()


@pytest.mark.parametrize(
    ("name", "wrong", "verb"),
    [
        ("hamilton.canonical.Factors", lambda *f: 2 * f[0] * f[1], hamiltonian),
        ("hamilton.canonical.bound", lambda value, _: value, hamiltonian),
        ("lagrange.energy_function.Factors", lambda *f: f[0] * f[1] / 2, energy_function),
        (
            "lagrange.energy_function.Partial",
            lambda f, x: -f.diff(x),
            lambda L: energy_function_rate(energy_function(L)),
        ),
        ("lagrange.momenta.Partial", lambda f, x: 2 * explicit(f).diff(x), momenta),
        ("hamilton.canonical.Partial", lambda f, x: -explicit(f).diff(x), lambda L: hamilton_equations(hamiltonian(L))),
    ],
)
def test_a_wrong_law_is_refused(
    name: str, wrong: Callable[..., Any], verb: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    L = bead_on_turning_hoop() if "energy" in name else pendulum()
    monkeypatch.setattr(f"derive.mechanics.{name}", wrong)
    with pytest.raises(Unverified):
        verb(L)
