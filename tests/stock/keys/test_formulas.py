"""Formulas of answers, rates of motions and steady motions, by the `results:` of a description."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Expr, Rational, exp, pi, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit
from tests.stock.described import edited, messages, solved

m, A, a, r_0, g, mu, v_0 = symbols("m A a r_0 g mu v_0", positive=True)

ORBIT = """\
title: Circular orbits
solve: system
symbols: {m: mass, A: coupling constant, a: length, r_0: length}
given:
  coordinates: {r: positive length, phi: angle}
  places: {O: [0, 0], P: [r*cos(phi), r*sin(phi)]}
  particles: {particle: {mass: m, at: P}}
  central: {energy: -A*exp(-d/a)/d, distance: d, from: O, to: P}
  conserved: {phi: positive l}
  results:
    orbit: {steady: lagrangian, values: {r: r_0}, symbol: Omega}
    turning: {roots: orbit, for: Omega}
    about: {frequency: effective_potential, results: orbit, for: Omega}
    made: {value: "pi*turning/about", symbol: psi}
statement: A particle.
parts:
  - ask: Find it.
    answer: [turning, about, made]
"""
BALL = """\
title: A ball that slides until it rolls
solve: system
symbols: {m: mass, R: length, g: acceleration, mu: 'number in (0, 2)', v_0: speed}
given:
  coordinates: {x: length, phi: angle}
  particles: {ball: {mass: m, at: [x, 0]}}
  bodies: {ball: {moments: 2*m*R**2/5, mass: m, turned: -phi, centre: [x, R]}}
  forces: [{components: [-mu*m*g, 0], at: [x, R]}, {torque: mu*m*g*R, on: phi}]
  results:
    x_of_t: {solution: motion_x, for: x, start: 0, start_rate: v_0}
    phi_of_t: {solution: motion_phi, for: phi, start: 0}
    v: {rate: x_of_t}
    w: {rate: phi_of_t}
    slip: {value: v - R*w, symbol: u}
    begin: {where: slip, is: '=', for: t}
    final: {put_in: v, results: begin}
    made: {value: final/v_0, symbol: f}
statement: A ball.
parts:
  - ask: Find it.
    answer: [made, begin]
""".replace("  particles: {ball: {mass: m, at: [x, 0]}}\n", "")


def test_the_apsidal_angle_of_a_nearly_circular_orbit(tmp_path: Path) -> None:
    """Goldstein, chapter 3, exercise 19, on Yukawa's potential: Omega^2 = U'/(m r), omega^2 = (3 U'/r + U'')/m."""
    steps = solved(tmp_path, ORBIT)
    slope = A * exp(-r_0 / a) * (1 / r_0**2 + 1 / (a * r_0))
    assert equal(explicit(steps["Omega"].value) ** 2, slope / (m * r_0))
    squared = (3 * slope / r_0 + slope.diff(r_0)) / m
    assert equal(explicit(steps["about"].value) ** 2, squared)
    assert equal(explicit(steps["made"].value), pi * sqrt(a * (a + r_0) / (a**2 + a * r_0 - r_0**2)))
    assert str(steps["made"].symbol) == "psi"


def test_a_ball_slides_until_the_place_of_contact_is_at_rest(tmp_path: Path) -> None:
    """Goldstein, section 1.3 and Kleppner, Kolenkow, problem 7.39: (5/7) v_0, after the time 2 v_0/(7 mu g)."""
    steps = solved(tmp_path, BALL)
    assert explicit(steps["made"].value) == Rational(5, 7)
    found = explicit(steps["begin"].value).right
    mu_here = next(s for s in found.free_symbols if s.name == "mu")
    assert equal(found.xreplace({mu_here: mu}), 2 * v_0 / (7 * g * mu))


@pytest.mark.parametrize(
    ("made", "value"),
    [("turning/2", None), ("about**2*r_0/3", None), ("-2*orbit_rate", None)],
)
def test_a_formula_may_hold_letters_and_powers(made: str, value: Expr | None, tmp_path: Path) -> None:
    text = edited(ORBIT, ('"pi*turning/about", symbol: psi', f'"{made}"'))
    text = edited(text, ("  results:\n", "  results:\n    orbit_rate: {value: turning + about}\n"))
    assert "made" in solved(tmp_path, text)


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ("turning + r_0", "they cannot be added"),
        ("turnig/about", "there is no answer `turnig`"),
        ("orbit/2", "`orbit` is no number"),
        ("made/2", "`made` is made of itself"),
        ("equations_of_motion/2", "`equations_of_motion` stands for 2 answers"),
        ("turning^2", "`^` is not part of an expression"),
        ("sin(turning)", "`sin` takes an angle or a number"),
    ],
)
def test_what_cannot_be_meant_by_a_formula_is_told(made: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(ORBIT, ("pi*turning/about", made)))
    assert any(said in message for message in found), found


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("values: {r: r_0}", "values: {s: r_0}", "but `s` is none"),
        ("symbol: Omega", "symbol: [Omega, Xi]", "`steady` has letters for the rates of 1 cyclic"),
        ("symbol: Omega", "symbol: r_0", "`r_0` stands for something else already"),
        ("results: orbit, for: Omega", "for: Omega", "`frequency` needs the steady motion"),
    ],
)
def test_what_is_no_steady_motion_is_told(old: str, new: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(ORBIT, (old, new)))
    assert any(said in message for message in found), found
