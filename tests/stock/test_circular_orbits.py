"""Circular orbits at a given radius, and powers whose exponent is a letter, in YAML alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Expr, pi, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from derive.solving import zeros
from tests.stock.described import complaints, course_with, edited, messages, solved

ORBIT = """\
title: An orbit
solve: system
symbols: {m: mass, K: positive energy, a: length, r_0: length, n: number}
given:
  coordinates: {r: positive length, phi: angle}
  particles: {p: {mass: m, at: [r*cos(phi), r*sin(phi)]}}
  potential: K*(r/a)**n/n
  conserved: {phi: positive l}
  results:
    circle: {steady: lagrangian, values: {r: r_0}, symbol: Omega}
    rate: {roots: circle, for: Omega}
    radial: {frequency: effective_potential, results: circle, for: Omega}
    ratio: {value: radial/rate, symbol: nu}
    apsidal: {value: pi*rate/radial, symbol: psi}
    stable: {where: radial_squared, is: '>', for: n}
statement: A particle.
parts:
  - ask: Find the orbit.
    answer: [rate, radial, ratio, stable]
"""
YUKAWA = (("K*(r/a)**n/n", "-K*a*exp(-r/a)/r"), ("[rate, radial, ratio, stable]", "apsidal"))

m, a, r_0 = symbols("m a r_0", positive=True)
n = symbols("n", real=True)


def test_the_power_law(tmp_path: Path) -> None:
    """Goldstein, section 3.6: omega_r/omega = sqrt(n + 2) of the potential r^n, stable where n > -2."""
    steps = solved(tmp_path, ORBIT)
    assert equal(steps["ratio"].value, sqrt(n + 2))
    assert steps["stable"].value == Relation(n, ">", -2)


CONE = """\
title: A particle in a cone
solve: system
symbols: {m: mass, g: acceleration, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {r: positive length, phi: angle}
  particles: {ball: {mass: m, at: [r*sin(alpha)*cos(phi), r*sin(alpha)*sin(phi), r*cos(alpha)]}}
  conserved: {phi: positive l}
  gravity: g
statement: A particle in a cone.
parts:
  - ask: Find the frequency of small radial oscillations.
    answer: frequency
"""


def test_the_range_of_an_angle_decides_the_sign_of_a_ratio(tmp_path: Path) -> None:
    """Goldstein, exercise 2.17: the ratio is sqrt(3) sin(alpha), without an absolute value."""
    page = rendered(course_with(tmp_path, CONE), "trial/one", only={"text"}).texts["text"]
    assert "is √3 sin α" in " ".join(page.split())


def test_the_apsidal_angle_of_a_yukawa_orbit(tmp_path: Path) -> None:
    """Goldstein, exercise 3.19: psi = pi sqrt((1 + x)/(1 + x - x^2)) with x = r_0/a."""
    steps = solved(tmp_path, edited(ORBIT, *YUKAWA))
    x = r_0 / a
    assert equal(explicit(steps["apsidal"].value), pi * sqrt((1 + x) / (1 + x - x**2)))


def test_where_an_orbit_of_a_power_law_is(tmp_path: Path) -> None:
    """r^(n + 2) = l^2 a^n/(m K)."""
    ranged = (("n: number", "n: 'number in (-2, 0)'"), ("[rate, radial, ratio, stable]", "equilibria"))
    rest = next(q for key, q in solved(tmp_path, edited(ORBIT, *ranged)).items() if key.startswith("rest"))
    value: Expr = explicit(rest.value)
    K, l = (next(s for s in value.free_symbols if s.name == name) for name in "Kl")
    assert equal(value ** (n + 2), l**2 * a**n / (m * K))


def test_a_wrong_root_of_two_powers_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = zeros._of_two_powers
    monkeypatch.setattr(zeros, "_of_two_powers", lambda factor, q: [2 * value for value in right(factor, q)])
    ranged = (("n: number", "n: 'number in (-2, 0)'"), ("[rate, radial, ratio, stable]", "equilibria"))
    found = messages(tmp_path, edited(ORBIT, *ranged))
    assert any("disagrees" in said or "not so" in said for said in found), found


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (("(r/a)**n", "r**n"), "7: `r` is a length, but the exponent `n` needs a dimensionless base"),
        (("(r/a)**n", "sin(phi)**n"), "7: the base `sin(phi)` of the exponent `n` is not known to be positive"),
        (("(r/a)**n", "(r/a)**(a)"), "7: the exponent"),
    ],
)
def test_a_power_that_means_nothing_is_refused(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(ORBIT, edit))
    assert any(message.startswith(said) for message in found), found


def test_what_to_ask_for_where_a_place_is_no_rest(tmp_path: Path) -> None:
    at = ("  results:", "  at: {r: r_0}\n  results:")
    found = complaints(tmp_path, edited(ORBIT, at, ("[rate, radial, ratio, stable]", "stability")))
    assert any("`steady`" in (c.help or "") for c in found), found
    found = complaints(tmp_path, edited(ORBIT, ("results: circle, for: Omega", "results: circle, for: a")))
    assert any("Omega" in (c.help or "") for c in found), found
