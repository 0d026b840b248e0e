"""What parts may ask of a system by name, and when a name does not apply."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.stock.described import PENDULUM, edited, messages, solved

PLANET = """\
title: A planet
solve: system
symbols: {m: mass, k: coupling constant}
given:
  coordinates: {r: positive length, phi: angle}
  places: {sun: [0, 0], planet: [r*cos(phi), r*sin(phi)]}
  particles: {planet: {mass: m, at: planet}}
  central: {energy: -k/d, distance: d, from: sun, to: planet}
  conserved: {phi: l}
statement: A planet.
parts:
  - ask: Find it.
    answer: [conserved, effective_potential, equilibria]
"""


@pytest.mark.parametrize(
    ("asked", "keys"),
    [
        ("[kinetic_energy, potential_energy]", {"kinetic_energy", "potential_energy"}),
        ("momenta", {"p_theta"}),
        ("energy_function", {"energy_function"}),
        ("[hamiltonian, hamilton_equations]", {"hamiltonian", "canonical_theta", "canonical_p_theta"}),
        ("[linearised, normal_modes, period]", {"linearised_theta", "frequency", "period"}),
        ("[equilibria, stability]", {"rest_1", "rest_2"}),
    ],
)
def test_a_pendulum_answers_by_name(asked: str, keys: set[str], tmp_path: Path) -> None:
    assert keys <= solved(tmp_path, edited(PENDULUM, ("equations_of_motion", asked))).keys()


def test_a_planet_has_a_circular_orbit(tmp_path: Path) -> None:
    """Goldstein, section 3.3: r = l^2/(m k)."""
    steps = solved(tmp_path, PLANET)
    assert str(steps["rest"].value) == "l**2/(k*m)"


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("multipliers", "`multipliers` needs constraints that forces keep"),
        ("conserved", "no coordinate of this system is cyclic"),
        ("no_slip", "nothing rolls in this system"),
        ("lagrangan", "there is no answer `lagrangan`"),
    ],
)
def test_an_ask_that_does_not_apply_is_told_where_it_is_asked(asked: str, said: str, tmp_path: Path) -> None:
    (found,) = messages(tmp_path, edited(PENDULUM, ("equations_of_motion", asked)))
    assert found.startswith("12: ") and said in found
