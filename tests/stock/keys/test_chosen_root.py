"""One of several roots is named, chosen, put in and used."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import cos, sin, sqrt, symbols

from derive.algebra.equality import equal
from tests.stock.described import complaints, edited, solved

g, h, v_0 = symbols("g h v_0", positive=True)
alpha = symbols("alpha", positive=True)  # in (0, pi/2)

FALL = """\
title: A fall
solve: system
symbols: {m: mass, g: acceleration, h: length}
given:
  coordinates: {z: length}
  particles: {ball: {mass: m, at: [0, z]}}
  gravity: g
  results:
    fall: {solution: motion_z, for: z, start: h}
    down: {roots: fall, for: t, root: CHOICE}
    speed_then: {rate: fall}
    hits: {put_in: speed_then, results: down}
statement: A ball falls from <<h>>.
parts:
  - ask: When is it down, and how fast?
    answer: [down, hits]
"""
THROWN = """\
title: The range of a projectile
solve: system
symbols: {m: mass, g: acceleration, v_0: speed, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, y: length}
  particles: {ball: {mass: m, at: [x, y]}}
  gravity: g
  results:
    along: {solution: motion_x, for: x, start: 0, start_rate: v_0*cos(alpha)}
    up: {solution: motion_y, for: y, start: 0, start_rate: v_0*sin(alpha)}
    landing: {roots: up, for: t}
    range: {put_in: along, results: [landing_2]}
statement: A ball of mass <<m>> is thrown with the speed <<v_0>> at the angle <<alpha>>.
parts:
  - ask: How far does it get?
    answer: [landing_2, range]
"""


@pytest.mark.parametrize("choice", ["positive", "largest", "2"])
def test_one_of_two_roots_is_chosen_and_put_in(choice: str, tmp_path: Path) -> None:
    """By hand: h = g t^2/2, and then z_dot = -g t = -sqrt(2 g h)."""
    found = solved(tmp_path, edited(FALL, ("CHOICE", choice)))
    assert equal(found["down_2"].value, sqrt(2 * h / g))
    assert equal(found["hits"].value, -sqrt(2 * g * h))


@pytest.mark.parametrize("choice", ["negative", "smallest", "1"])
def test_the_other_root_is_chosen(choice: str, tmp_path: Path) -> None:
    assert equal(solved(tmp_path, edited(FALL, ("CHOICE", choice)))["down_1"].value, -sqrt(2 * h / g))


@pytest.mark.parametrize(
    ("choice", "said"),
    [
        ("3", "`root: 3` does not determine one root: there are 2 roots"),
        ("0", "`root: 0` does not determine one root: there are 2 roots"),
        ("latest", "`latest` does not say which root is meant"),
    ],
)
def test_a_choice_that_fits_no_root_is_told_at_its_place(choice: str, said: str, tmp_path: Path) -> None:
    first, *_ = complaints(tmp_path, edited(FALL, ("CHOICE", choice)))
    assert (first.message, first.place.line) == (said, 10)


def test_a_root_by_its_number_is_put_in(tmp_path: Path) -> None:
    """By hand: t = 2 v_0 sin(alpha)/g, and v_0 cos(alpha) t."""
    found = solved(tmp_path, THROWN)
    assert equal(found["landing_2"].value, 2 * v_0 * sin(alpha) / g)
    assert equal(found["range"].value, 2 * v_0**2 * sin(alpha) * cos(alpha) / g)
