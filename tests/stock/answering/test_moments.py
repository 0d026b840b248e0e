"""The moments that a description knows, for the arrows of its drawing."""

from __future__ import annotations

from pathlib import Path

from derive.course.problem import run_solve
from derive.figures.annotations import Arrow
from derive.figures.marks import Drawing
from derive.steps.record import Run
from tests.figures.machines import labels
from tests.stock.described import edited, loaded

STONE = """\
title: A stone
solve: system
symbols: {m: mass, g: acceleration, v_0: speed, alpha: 'angle in (0, pi/2)', J: momentum, h: length}
given:
  coordinates: {x: length, z: length}
  particles: {stone: {mass: m, at: [x, z]}}
  gravity: g
  results:
    path_x: {solution: motion_x, for: x, start: 0, start_rate: v_0*cos(alpha)}
    path_z: {solution: motion_z, for: z, start: h, start_rate: v_0*sin(alpha)}
statement: A stone is thrown.
parts:
  - ask: Find the kinetic energy.
    answer: kinetic_energy
"""
IMPACT = "  impact: {impulses: {components: [0, J], at: [x, z]}, before: {x_dot: v_0}}\n"


def arrows(folder: Path, text: str) -> list[str]:
    run = Run()
    run_solve(loaded(folder, text), run)
    (found,) = run.drawings
    assert isinstance(found, Drawing)
    return labels(found, Arrow)


def test_how_a_motion_begins_is_drawn(tmp_path: Path) -> None:
    assert arrows(tmp_path, STONE) == ["v_0"]


def test_a_motion_of_which_half_the_start_is_known_has_no_arrow(tmp_path: Path) -> None:
    one = "    path_x: {solution: motion_x, for: x, start: 0, start_rate: v_0*cos(alpha)}\n"
    assert arrows(tmp_path, edited(STONE, (one, ""))) == []


def test_an_impact_has_what_acts_and_what_moved_before(tmp_path: Path) -> None:
    text = STONE[: STONE.index("  results")] + IMPACT + STONE[STONE.index("statement") :]
    assert arrows(tmp_path, text) == ["v_0", "J"]
