"""Surfaces that move: their shape moves with their material. Positive coordinates keep their sign in constraints."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Expr, Integer, Symbol, cos, sin, symbols

from derive.algebra.expressions import explicit
from derive.building.solution import rendered
from derive.mechanics.lagrange import constraint_forces
from derive.mechanics.model import contacts
from derive.steps.step import is_zero
from tests.stock.described import course_with, edited, messages, solved

BANK = """\
title: A car on a banked curve
solve: system
symbols: {m: mass, R: length, g: acceleration, Omega: angular speed, alpha: 'angle in (0, pi/2)', mu: positive number}
given:
  coordinates: {s: length, n: length, b: length}
  axes: {road: [{z: Omega*t}]}
  particles:
    car: {mass: m, at: {in: road, by: [R + s*cos(alpha) - n*sin(alpha), b, s*sin(alpha) + n*cos(alpha)]}}
  gravity: g
  surfaces:
    bank:
      through: {in: road, by: [R, 0, 0]}
      normal: [-sin(alpha)*cos(Omega*t), -sin(alpha)*sin(Omega*t), cos(alpha)]
      in: road
  contacts: {of: car, on: bank, normal: N, friction: {static: mu, force: F}}
statement: A car drives round a banked curve.
parts:
  - ask: Find the forces.
    answer: [N, F_x]
"""
PLANK = """\
title: A particle on a rod that rotates
solve: system
symbols: {m: mass, M: mass, l: length, g: acceleration}
given:
  coordinates: {x: length, y: length, theta: angle}
  bodies: {rod: {shape: rod, length: l, mass: M, from: [0, 0], along: [cos(theta), sin(theta)]}}
  particles: {p: {mass: m, at: [x, y]}}
  gravity: g
  surfaces: {top: {through: rod, along: [cos(theta), sin(theta)], of: rod}}
  contacts: {of: p, on: top, normal: N}
statement: A particle slides on a rod.
parts:
  - ask: Write the equations.
    answer: motion_theta
"""
INCLINES = """\
title: Two blocks on two inclines
solve: system
symbols: {m: mass, M: mass, l: length, g: acceleration, alpha: 'angle in (0, pi/2)', beta: 'angle in (0, pi/2)'}
given:
  coordinates: {u: positive length, v: positive length, p: length, q: length}
  particles:
    left: {mass: m, at: [-u*cos(alpha) - p*sin(alpha), -u*sin(alpha) + p*cos(alpha)]}
    right: {mass: M, at: [v*cos(beta) + q*sin(beta), -v*sin(beta) + q*cos(beta)]}
  gravity: g
  surfaces:
    a: {through: [0, 0], along: [cos(alpha), sin(alpha)]}
    b: {through: [0, 0], along: [cos(beta), -sin(beta)]}
  contacts: [{of: left, on: a, normal: N}, {of: right, on: b, normal: K}]
  strings: {from: left, over: [[0, 0]], to: right, length: l, tension: S}
statement: A string over the top joins two blocks.
parts:
  - ask: Find the tension.
    answer: S
"""
BELT = """\
title: A block on a belt
solve: system
symbols: {m: mass, k: spring constant, g: acceleration, V: positive velocity, mu: positive number, d: length}
given:
  coordinates: {x: length, y: length}
  particles: {block: {mass: m, at: [x, y]}}
  gravity: g
  springs: {constant: k, from: [-d, 0], to: block, length: d}
  surfaces: {belt: {through: [0, 0], along: [1, 0], velocity: [V, 0]}}
  contacts: {of: block, on: belt, normal: N, friction: {sliding: mu, direction: left}}
statement: A spring holds a block on a belt.
parts:
  - ask: Find the small motions.
    answer: linearised
"""


def by_name(value: Expr, *zero: str) -> Expr:
    """Return the value with symbols that have only their names, and zero for the named ones."""
    return value.xreplace({s: Integer(0) if s.name in zero else Symbol(s.name) for s in value.free_symbols})


def test_the_normal_of_a_surface_in_rotating_axes_rotates_with_them(tmp_path: Path) -> None:
    steps = solved(tmp_path, BANK)
    N, F = (by_name(explicit(steps[key].value), "s", "s_dot", "b", "b_dot") for key in ("N", "F_x"))
    m, g, R, Omega, alpha = symbols("m g R Omega alpha")
    assert is_zero(N - m * (g * cos(alpha) + R * Omega**2 * sin(alpha)))
    assert is_zero(F - m * (g * sin(alpha) - R * Omega**2 * cos(alpha)))
    fixed = [str(value) for role, value in steps["N"].step.roles if role.startswith("fixed_")]
    assert any("b_dot" in each for each in fixed), "the sentence states the rate that static friction keeps zero"


def test_a_rate_that_static_friction_does_not_keep_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = {symbols(name, real=True): Integer(1) for name in ("s_dot", "b_dot")}
    monkeypatch.setattr(constraint_forces, "rates_at_rest", lambda *_: wrong)
    assert messages(tmp_path, BANK)


@pytest.mark.parametrize(
    ("text", "changes"),
    [
        (BANK, [("[-sin(alpha)*cos(Omega*t), -sin(alpha)*sin(Omega*t), cos(alpha)]", "[-sin(alpha), 0, cos(alpha)]")]),
        (BANK, [("{in: road, by: [R, 0, 0]}", "[R, 0, 0]")]),
        (PLANK, [("along: [cos(theta), sin(theta)], of", "along: [1, 0], of")]),
        (PLANK, [("{through: rod, along: [cos(theta), sin(theta)], of", "{centre: [0, l], radius: l/2, of")]),
    ],
)
def test_a_surface_that_does_not_move_with_its_material_is_refused(
    text: str, changes: list[tuple[str, str]], tmp_path: Path
) -> None:
    assert "the surface does not move with the " in messages(tmp_path, edited(text, *changes))[0]


def test_a_force_on_a_surface_that_leaves_its_body_behind_fails_the_second_route(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(contacts, "_check_moves_with_its_material", lambda surface: None)
    solved(tmp_path, PLANK)
    still = edited(PLANK, ("along: [cos(theta), sin(theta)], of", "along: [1, 0], of"))
    assert "its second route `virtual_work` disagrees" in messages(tmp_path, still)[0]


def test_a_positive_coordinate_stays_positive_where_a_constraint_replaces_it(tmp_path: Path) -> None:
    tension = by_name(explicit(solved(tmp_path, INCLINES)["S"].value))
    m, M, g, alpha, beta = symbols("m M g alpha beta")
    assert is_zero(tension - m * M * g * (sin(alpha) + sin(beta)) / (m + M))


def test_sliding_friction_has_no_equilibrium_for_small_motions(tmp_path: Path) -> None:
    assert "sliding friction does not act at rest" in messages(tmp_path, BELT)[0]


def test_no_size_is_compared_with_a_rate_to_change_the_sign_of_a_normal_force(tmp_path: Path) -> None:
    """N = m (g cos(theta) - R theta_dot**2) vanishes for R = g cos(theta)/theta_dot**2, but it is never negative."""
    text = edited(
        PLANK,
        (
            "coordinates: {x: length, y: length, theta: angle}",
            "coordinates: {r: positive length, theta: 'angle in (0, pi/2)'}",
        ),
        ("  bodies: {rod: {shape: rod, length: l, mass: M, from: [0, 0], along: [cos(theta), sin(theta)]}}\n", ""),
        ("at: [x, y]", "at: [r*sin(theta), r*cos(theta)]"),
        ("{through: rod, along: [cos(theta), sin(theta)], of: rod}", "{centre: [0, 0], radius: l}"),
        ("answer: motion_theta", "answer: N"),
    )
    assert "opposite signs" not in rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"]
