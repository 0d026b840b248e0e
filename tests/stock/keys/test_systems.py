"""A Lagrangian that a description gives itself, and what may not stand beside it."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from tests.stock.described import course_with, edited, messages, solved

CIRCUIT = """\
title: A circuit
solve: system
symbols: {L_1: inductance, C_1: capacitance, R_1: resistance, m: mass, l: length, g: acceleration}
given:
  coordinates: {q: charge}
  lagrangian: L_1*q_dot**2/2 - q**2/(2*C_1)
statement: A circuit.
parts:
  - ask: Find the motion.
    answer: [equations_of_motion, energy_function, normal_modes]
"""

RELATIVISTIC = """\
title: A relativistic particle
solve: system
symbols: {m: mass, c: speed}
given:
  coordinates: {r: positive length, phi: angle}
  lagrangian: -m*c**2*sqrt(1 - (r_dot**2 + r**2*phi_dot**2)/c**2)
  conserved: {phi: l}
statement: A particle.
parts:
  - ask: Find the energy.
    answer: [conserved, hamiltonian]
"""

L_1, C_1, R_1, m, c, r = symbols("L_1 C_1 R_1 m c r", positive=True)
q, q_dot, q_ddot, p_r, p_phi = symbols("q q_dot q_ddot p_r p_phi", real=True)


def test_a_circuit_swings(tmp_path: Path) -> None:
    """Goldstein, section 2.5: omega^2 = 1/(L C)."""
    steps = solved(tmp_path, CIRCUIT)
    assert equal(explicit(steps["motion_q"].value), Relation(L_1 * q_ddot + q / C_1, "=", 0))
    frequencies = [step.value for key, step in steps.items() if key == "frequency"]
    assert len(frequencies) == 1
    assert equal(frequencies[0], 1 / sqrt(L_1 * C_1))


def test_a_circuit_with_a_resistance(tmp_path: Path) -> None:
    damped = ("statement:", "  damping: {constant: R_1, on: q}\nstatement:")
    steps = solved(tmp_path, edited(CIRCUIT, damped, (", normal_modes", "")))
    assert equal(explicit(steps["motion_q"].value), Relation(L_1 * q_ddot + R_1 * q_dot + q / C_1, "=", 0))


def test_the_page_says_that_it_is_given(tmp_path: Path) -> None:
    assert (
        "The given Lagrangian is" in rendered(course_with(tmp_path, CIRCUIT), "trial/one", only={"text"}).texts["text"]
    )


def test_a_free_relativistic_particle_in_polar_coordinates(tmp_path: Path) -> None:
    """Goldstein, section 8.4: H = c sqrt(m^2 c^2 + p_r^2 + p_phi^2/r^2)."""
    H = solved(tmp_path, RELATIVISTIC)["hamiltonian"]
    assert equal(H.value, c * sqrt(m**2 * c**2 + p_r**2 + p_phi**2 / r**2))


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (
            ("  lagrangian", "  gravity: g\n  lagrangian"),
            "6: `gravity` cannot be combined with `lagrangian`, which replaces bodies and forces",
        ),
        (("q_dot**2/2", "q_dot**2/2 + m"), "6: "),
        (("L_1*q_dot**2/2 - ", "-"), "5: a given Lagrangian needs the rate of a coordinate"),
        (("normal_modes", "kinetic_energy"), "10: this answer needs bodies and forces"),
        (("normal_modes", "multipliers"), "10: `multipliers`"),
    ],
)
def test_what_does_not_fit_is_refused(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(CIRCUIT, edit))
    assert any(message.startswith(said) for message in found), found
