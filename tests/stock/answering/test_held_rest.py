"""Rest where forces keep conditions, in YAML alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import cos, sin, symbols

from derive.algebra.equality import equal
from derive.mechanics.answers import linear_equations as solving
from tests.stock.described import edited, messages, solved

BLOCKS = """\
title: Two blocks on a string
solve: system
symbols: {m: mass, M: mass, g: acceleration, k: spring constant, d: length, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, y: length}
  places: {A: [x*cos(alpha), x*sin(alpha)], B: [0, -y]}
  particles: {one: {mass: m, at: A}, other: {mass: M, at: B}}
  gravity: g
  potential: k*x**2/2
  constraints: [{condition: x + y, equals: d, force: Q}]
statement: Blocks.
parts:
  - ask: Where are they at rest?
    answer: equilibria
"""
m, M, g, k, alpha = symbols("m M g k alpha", positive=True)


def test_the_tension_at_rest(tmp_path: Path) -> None:
    """Q = -M g carries the hanging block, and k x = -(M + m sin(alpha)) g."""
    steps = solved(tmp_path, BLOCKS)
    assert equal(steps["rest_Q"].value, -M * g)
    assert equal(steps["rest_x"].value, -(M + m * sin(alpha)) * g / k)


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (("  potential: k*x**2/2\n", ""), "the number of unknowns is 1: Q"),
        (("k*x**2/2", "k*x**4/(4*d**2)"), "linear"),
        (("answer: equilibria", "answer: stability"), "maintains the constraint x + y = d"),
    ],
)
def test_a_rest_that_is_not_told_is_refused(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(BLOCKS, edit))
    assert any(said in message for message in found), found


def test_a_wrong_solution_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = solving.tidied
    monkeypatch.setattr(solving, "tidied", lambda value: 2 * right(value))
    assert messages(tmp_path, BLOCKS)


LADDER = """\
title: A ladder between two rough surfaces
solve: system
symbols: {M: mass, l: length, g: acceleration, mu: positive number}
given:
  coordinates: {x: length, y: length, theta: 'angle in (0, pi/2)'}
  bodies: {ladder: {shape: rod, length: l, mass: M, along: [-cos(theta), sin(theta)], centre: [x, y]}}
  gravity: g
  surfaces: {wall: {through: [0, 0], along: [0, -1]}, floor: {through: [0, 0], along: [1, 0]}}
  contacts:
    - {of: ladder.far_end, on: wall, normal: K, friction: {static: mu, force: G}}
    - {of: ladder.end, on: floor, normal: N, friction: {static: mu, force: F}}
statement: A ladder.
parts:
  - ask: Find the forces at rest.
    answer: equilibria
"""


def test_four_forces_on_one_body_in_a_plane_are_not_determined(tmp_path: Path) -> None:
    assert "the number of static equations is 3, too few for the 4 forces K, G, N, F" in messages(tmp_path, LADDER)[0]


LAMP = """\
title: A lamp on two strings
solve: system
symbols: {m: mass, a: length, b: length, g: acceleration, alpha: 'angle in (0, pi/2)', beta: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, y: length}
  particles: {lamp: {mass: m, at: [x, y]}}
  strings:
    - {from: [-a*cos(alpha), a*sin(alpha)], to: lamp, length: a, tension: S_1}
    - {from: [b*cos(beta), b*sin(beta)], to: lamp, length: b, tension: S_2}
  gravity: g
statement: A lamp hangs on two strings.
parts:
  - ask: Find the tensions.
    answer: equilibria
"""


def test_two_strings_keep_a_lamp_at_one_place(tmp_path: Path) -> None:
    """S_1 cos(alpha) = S_2 cos(beta) and S_1 sin(alpha) + S_2 sin(beta) = m g."""
    beta = symbols("beta", positive=True)
    steps = solved(tmp_path, LAMP)
    assert equal(steps["rest_S_1"].value, m * g * cos(beta) / sin(alpha + beta))
    assert equal(steps["rest_S_2"].value, m * g * cos(alpha) / sin(alpha + beta))
