"""Charges in uniform magnetic fields: what their Lagrangian has of the field, and what follows from it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from sympy import cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME
from derive.errors import Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    charge,
    conserved,
    coordinate,
    effective_potential,
    energy_function,
    equations_of_motion,
    hamiltonian,
    lagrangian,
    noether,
    point,
    potential_energy_of,
)
from derive.mechanics.lagrange.facts import Energies
from derive.mechanics.model import dalembert, forces
from derive.steps.record import Run, recorded

m, q, B, E, ell = symbols("m q B E ell", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def lengths(*names: str) -> tuple[Coordinate, ...]:
    return tuple(coordinate(name, "length") for name in names)


def in_cylinder() -> tuple[Coordinate, Coordinate, Coordinate, Any]:
    rho, phi, (z,) = coordinate("rho", "length", positive=True), coordinate("phi"), lengths("z")
    at = point(rho * cos(phi), rho * sin(phi), z)
    return rho, phi, z, lagrangian(System(Particle(m, at), charge(q, at, B=(0, 0, B))))


def test_a_uniform_field_in_cylindrical_coordinates() -> None:
    """Taylor, problem 7.49: L = m (rho_dot^2 + rho^2 phi_dot^2 + z_dot^2)/2 + q B rho^2 phi_dot/2."""
    rho, phi, z, L = in_cylinder()
    free = m * (rho.rate**2 + rho.symbol**2 * phi.rate**2 + z.rate**2) / 2
    assert equal(L.value, free + q * B * rho.symbol**2 * phi.rate / 2)
    assert L.step.outcome == "in_field"


def test_the_canonical_momentum_has_the_field_in_it() -> None:
    """Goldstein, section 2.6: p = m v + q A, of which the component about the field is conserved."""
    rho, phi, z, L = in_cylinder()
    assert equal(conserved(L, phi).value, m * rho.symbol**2 * phi.rate + q * B * rho.symbol**2 / 2)
    assert equal(conserved(L, z).value, m * z.rate)


def test_the_effective_potential_of_the_distance_from_the_axis() -> None:
    """Landau, Lifshitz, *Fields*, section 21: (l - q B rho^2/2)^2/(2 m rho^2)."""
    rho, phi, z, L = in_cylinder()
    V = effective_potential(L, conserved(L, phi, value=ell), conserved(L, z, value=symbols("p", real=True)))
    left = (ell - q * B * rho.symbol**2 / 2) ** 2 / (2 * m * rho.symbol**2)
    assert equal(V.value.diff(rho.symbol), left.diff(rho.symbol))


def test_the_hamiltonian_is_the_square_of_what_is_left_of_the_momentum() -> None:
    """Goldstein, section 8.1: H = (p - q A)^2/(2 m) + q Phi, with A = (-B y, B x)/2."""
    x, y = lengths("x", "y")
    at = point(x, y)
    L = lagrangian(System(Particle(m, at), charge(q, at, E=(E, 0), B=B)))
    p_x, p_y = symbols("p_x p_y", real=True)
    squares = (p_x + q * B * y.symbol / 2) ** 2 + (p_y - q * B * x.symbol / 2) ** 2
    assert equal(hamiltonian(L).value, squares / (2 * m) - q * E * x.symbol)


def test_the_energy_does_not_know_the_field() -> None:
    x, y = lengths("x", "y")
    L = lagrangian(System(Particle(m, point(x, y)), charge(q, point(x, y), B=B)))
    h = energy_function(L)
    assert equal(h.value, m * (x.rate**2 + y.rate**2) / 2)
    assert h.step.outcome == "energy"
    assert equal(L.needed(Energies).whole, h.value)


def test_a_shift_across_the_field_is_a_symmetry_with_a_gain() -> None:
    """Landau, Lifshitz, *Fields*, section 21: p_x of the gauge A = (-B y, 0), m x_dot - q B y, is conserved."""
    x, y = lengths("x", "y")
    L = lagrangian(System(Particle(m, point(x, y)), charge(q, point(x, y), B=B)))
    Q = noether(L, {x: 1}, gained=q * B * y / 2)
    assert equal(Q.value, m * x.rate - q * B * y.symbol)


@pytest.mark.parametrize("factor", [-1, 2])
def test_a_wrong_vector_potential_is_refused(factor: int, monkeypatch: pytest.MonkeyPatch) -> None:
    right = dalembert.MagneticForce.vector_potential.fget
    assert right is not None
    wrong = property(lambda self: tuple(factor * c for c in right(self)))
    monkeypatch.setattr(dalembert.MagneticForce, "vector_potential", wrong)
    x, y = lengths("x", "y")
    with pytest.raises(Unverified):
        equations_of_motion(lagrangian(System(Particle(m, point(x, y)), charge(q, point(x, y), B=B))))


@pytest.mark.parametrize("field", [E, E * cos(TIME)])
def test_the_energy_in_an_electric_field_is_that_of_the_force(field: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """U = -q E y; the force q E is known without it, so the other sign is refused."""
    (x, y) = lengths("x", "y")

    def potential() -> Any:
        return potential_energy_of(System(Particle(m, point(x, y)), charge(q, point(x, y), E=(0, field)))).value

    assert equal(potential(), -q * field * y.symbol)
    right = forces.Charge.stored.fget

    def turned(of: Any) -> Any:
        return replace(right(of), energy=-right(of).energy)

    monkeypatch.setattr(forces.Charge, "stored", property(turned))
    with pytest.raises(Unverified, match="second route `work` disagrees"):
        potential()
