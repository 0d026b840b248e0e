"""Formulas of answers, rates of motions and steady motions, by the `results:` of a description."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Rational, exp, pi, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, explicit
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
"""


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
    [("turning/2", "Omega/2"), ("about**2*r_0/3", "omega_0**2*r_0/3"), ("-2*added", "-2*added")],
)
def test_a_formula_may_hold_letters_and_powers_and_another_formula(made: str, value: str, tmp_path: Path) -> None:
    text = edited(ORBIT, ('"pi*turning/about", symbol: psi', f'"{made}"'))
    text = edited(text, ("  results:\n", "  results:\n    added: {value: turning + about}\n"))
    assert str(solved(tmp_path, text)["made"].step.chain[0].expr) == value


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ("turning + r_0", "they cannot be added"),
        ("turnig/about", "`turnig` is not the name of an answer"),
        ("orbit/2", "`orbit` is not a number"),
        ("made/2", "`made` is computed from itself"),
        ("equations_of_motion/2", "`equations_of_motion` denotes 2 answers, not one"),
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
        ("values: {r: r_0}", "values: {m: r_0}", "but `m` is neither"),
        ("symbol: Omega", "symbol: [Omega, Xi]", "one symbol for each free cyclic rate (phi_dot), but"),
        ("symbol: Omega", "symbol: r_0", "`r_0` already denotes something else"),
        ("results: orbit, for: Omega", "for: Omega", "`frequency` needs `results`"),
    ],
)
def test_what_is_no_steady_motion_is_told(old: str, new: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(ORBIT, (old, new)))
    assert any(said in message for message in found), found


SPRING = """\
title: A particle on a spring in space
solve: system
symbols: {m: mass, k: spring constant}
given:
  coordinates: {x: length, y: length, z: length}
  places: {O: [0, 0, 0], P: [x, y, z]}
  particles: {particle: {mass: m, at: P}}
  springs: {constant: k, from: O, to: P}
  results:
    L_x: {value: y*p_z - z*p_y}
    L_y: {value: z*p_x - x*p_z}
    L_z: {value: x*p_y - y*p_x}
    both: {bracket: [L_x, L_y], results: L_z}
    kept: {bracket: [L_z, hamiltonian]}
    plain: {bracket: [x**2, p_x]}
    turning: {noether: lagrangian, values: {x: -y, y: x}, symbol: Q}
statement: A particle.
parts:
  - ask: Find it.
    answer: [both, kept, plain, turning]
"""


def test_brackets_of_formulas_in_coordinates_and_momenta(tmp_path: Path) -> None:
    """Goldstein, section 9.7: {L_x, L_y} = L_z; an isotropic oscillator keeps L_z, by Noether's theorem too."""
    steps = solved(tmp_path, SPRING)
    assert str(steps["both"].step.chain[-1].expr) == "L_z"
    assert steps["kept"].step.outcome == "conserved"
    assert str(steps["plain"].value) == "2*x"
    assert str(steps["turning"].value) == "m*(x*y_dot - x_dot*y)"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[x**2, p_x]", "[x**2]", "`bracket` needs two functions, not 1"),
        ("[x**2, p_x]", "[x**2, equations_of_motion]", "`equations_of_motion` denotes 3 answers, not one"),
        ("[x**2, p_x]", "[x**2, p_w]", "`p_w` is not the name of an answer"),
        ("[x**2, p_x]", "[x_dot, p_x]", "but x_dot contains x_dot"),
        ("{x: -y, y: x}", "{x: -y, m: x}", "`noether` shifts coordinates, but `m` is not a coordinate"),
        ("{x: -y, y: x}", "{x: y, y: x}", "the shift is not a symmetry"),
    ],
)
def test_what_is_no_bracket_or_symmetry_is_told(old: str, new: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(SPRING, (old, new)))
    assert any(said in message for message in found), found


ATWOOD = """\
title: Two weights on a string
solve: system
symbols: {m: mass, M: mass, g: acceleration, l: length}
given:
  coordinates: {x: length, y: length}
  particles: {one: {mass: m, at: [0, -x]}, other: {mass: M, at: [0, -y]}}
  gravity: g
  constraints: {condition: x + y, equals: l, force: S}
  results:
    tension: {value: -S}
    fall: {solution: acceleration_x, for: x, start: 0}
statement: Atwood's machine.
parts:
  - ask: How does it move?
    answer: [tension, fall]
"""


def test_a_force_that_is_found_is_itself_in_a_formula_and_an_acceleration_is_integrated(tmp_path: Path) -> None:
    """Morin, section 3.1: S = 2 m M g/(m + M), and the fall with (m - M) g/(m + M)."""
    M = symbols("M", positive=True)
    found = solved(tmp_path, ATWOOD)
    assert equal(found["tension"].value, 2 * m * M * g / (m + M))
    assert equal(found["fall"].value, (m - M) * g * TIME**2 / (2 * (m + M)))


def test_the_unit_of_an_angle_in_a_formula_is_not_the_name_of_an_answer(tmp_path: Path) -> None:
    found = solved(tmp_path, edited(BALL, ("value: final/v_0,", "value: final/v_0*cos(60 deg),")))
    assert equal(explicit(found["made"].value), Rational(5, 14))
