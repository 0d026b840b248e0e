"""Which described bodies are drawn."""

from __future__ import annotations

from pathlib import Path

from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.figures.annotations import AngleMark
from derive.figures.marks import Drawing
from derive.steps.record import Run
from tests.figures.machines import of
from tests.stock.bodies import CONE, CONE_IS
from tests.stock.described import course_with, edited, loaded


def test_a_body_with_an_outline_is_drawn_and_another_is_not(tmp_path: Path) -> None:
    assert "[figure:" in rendered(course_with(tmp_path, CONE), "trial/one", only={"text"}).texts["text"]
    text = edited(CONE, (CONE_IS, "{shape: torus, radius: R, section: R/2, mass: M}"), ("  about: apex\n", ""))
    assert "[figure:" not in rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"]


LEANING = """\
title: A rod on a shaft
solve: rotation
symbols: {l: length, M: mass, alpha: "angle in (0, pi/2)", omega: angular speed}
given:
  body: {shape: rod, length: l, mass: M}
  rate: omega
  along: [sin(alpha), 0, cos(alpha)]
statement: A rod is fixed to a shaft.
parts:
  - ask: What is its energy?
    answer: kinetic_energy
"""


def arcs(folder: Path, text: str) -> list[str]:
    run = Run()
    run_solve(loaded(folder, text), run)
    return [str(mark.label) for drawn in run.drawings if isinstance(drawn, Drawing) for mark in of(drawn, AngleMark)]


def test_the_angle_of_an_axis_of_rotation_is_drawn_where_it_is_a_letter(tmp_path: Path) -> None:
    assert arcs(tmp_path, LEANING) == ["alpha"]
    for along in ("[1, 0, 1]", "[2*sin(alpha), 0, cos(alpha)]", "x"):
        assert arcs(tmp_path, edited(LEANING, ("[sin(alpha), 0, cos(alpha)]", along))) == []
