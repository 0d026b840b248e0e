"""Marks that name a thing of a body, such as its centre of mass, in addition to the outline."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from sympy import symbols

from derive.algebra.expressions import scalar, vector
from derive.course.problem import run_solve
from derive.figures.annotations import AngleMark, Arrow, Axis, CentreMark, Line, PointMark, Projection
from derive.figures.marks import Drawing, Mark
from derive.figures.surfaces import SliceMark
from derive.page.depiction import misspelt
from derive.steps.record import Run
from tests.stock.described import complaints, edited, loaded

a, b, M = symbols("a b M", positive=True)

PLATE = """\
title: A plate
solve: body
symbols: {a: length, M: mass}
given:
  body: {shape: triangle, corners: [[0, 0], [a, 0], [0, a]], mass: M}
  about: first corner
statement: A plate.
parts:
  - ask: Where is its centre of mass, and what are its principal axes?
    answer: [centre_of_mass, principal_axes]
drawings:
  axes: {marks: [{mark: centre_of_mass}, {mark: principal_axes}], caption: The axes.}
"""


def marks_of(folder: Path, text: str, name: str) -> list[Mark]:
    run = Run()
    run_solve(loaded(folder, text), run)
    drawing: Any = next(each for each in run.drawings if each.key == name)
    assert isinstance(drawing, Drawing)
    return list(drawing.marks)


def body(given: str, marks: str, answer: str = "moment_of_inertia_z") -> str:
    return edited(
        PLATE,
        ("{shape: triangle, corners: [[0, 0], [a, 0], [0, a]], mass: M}", given),
        ("  about: first corner\n", ""),
        ("[centre_of_mass, principal_axes]\ndrawings", f"{answer}\ndrawings"),
        ("axes: {marks: [{mark: centre_of_mass}, {mark: principal_axes}]", f"body: {{marks: [{{mark: {marks}}}]"),
        ("symbols: {a: length, M: mass}", "symbols: {a: length, b: length, M: mass, theta: angle, phi: angle}"),
    )


def test_a_further_drawing_shows_the_centre_of_mass_and_the_principal_axes(tmp_path: Path) -> None:
    marks = marks_of(tmp_path, PLATE, "axes")
    (centre,) = [mark for mark in marks if isinstance(mark, CentreMark)]
    assert (centre.label, [*centre.at]) == (scalar("C"), [a / 3, a / 3, 0])
    arrows = [mark for mark in marks if isinstance(mark, Arrow)]
    assert [mark.label for mark in arrows] == [vector(f"e_{k}") for k in (1, 2, 3)]
    assert arrows[0].keys == ("principal_axis_1",)  # so the drawing follows the step that finds the axis
    assert not any(isinstance(mark, CentreMark) for mark in marks_of(tmp_path, PLATE, "body"))


def test_marks_in_a_plane_make_a_drawing_without_the_body(tmp_path: Path) -> None:
    line = "{mark: line, from: [0, 0], to: [a, a]}"
    sketch = edited(PLATE, ("{mark: centre_of_mass}, {mark: principal_axes}", line), ("The axes", "A line"))
    (drawn,) = marks_of(tmp_path, sketch, "axes")
    assert isinstance(drawn, Line)
    assert list(drawn.end) == [a, a]
    problem = loaded(tmp_path, sketch)
    run = Run()
    run_solve(problem, run)
    assert not misspelt(problem, run.drawings)
    (warning,) = misspelt(loaded(tmp_path, edited(sketch, ("  axes: {marks", "  bdy: {marks"))), run.drawings)
    assert "`bdy` is a new drawing" in warning.message and "`body`" in str(warning.help)
    in_space = edited(sketch, ("[0, 0], to: [a, a]", "[0, 0, 0], to: [a, a, 0]"))
    assert "draws nothing called `axes`" in str(complaints(tmp_path, in_space))


def test_the_masses_are_at_the_centres_of_the_parts(tmp_path: Path) -> None:
    parts = "{parts: {rod: {shape: rod, length: a, mass: M}, ball: {shape: ball, radius: b, mass: M, at: [0, 0, a]}}}"
    points = [mark for mark in marks_of(tmp_path, body(parts, "masses"), "body") if isinstance(mark, PointMark)]
    assert [(point.label, [*point.at]) for point in points] == [(M, [0, 0, a / 2]), (M, [0, 0, a])]


def test_the_element_of_a_cone_is_a_slice_and_that_of_a_torus_a_point_of_its_section(tmp_path: Path) -> None:
    cone = marks_of(tmp_path, body("{shape: cone, radius: b, height: a, mass: M}", "element"), "body")
    assert any(isinstance(mark, SliceMark) for mark in cone)
    torus = marks_of(tmp_path, body("{shape: torus, radius: a, section: b, mass: M}", "element"), "body")
    assert [mark.label for mark in torus if isinstance(mark, AngleMark)] == [scalar("u")]
    assert {mark.label for mark in torus if isinstance(mark, Line)} == {b, scalar("s")}


def test_a_direction_is_drawn_with_its_two_angles(tmp_path: Path) -> None:
    text = edited(
        body("{shape: cuboid, sides: [a, a, a], mass: M}", "direction", "moment_about"),
        ("statement:", "  direction: [sin(theta)*cos(phi), sin(theta)*sin(phi), cos(theta)]\nstatement:"),
    )
    marks = marks_of(tmp_path, text, "body")
    assert {mark.label for mark in marks if isinstance(mark, AngleMark)} == {scalar("theta"), scalar("phi")}
    (flat,) = [mark for mark in marks if isinstance(mark, Projection)]
    assert flat.in_words() is None


@pytest.mark.parametrize(
    ("edits", "words"),
    [
        (
            (("{mark: principal_axes}", "{mark: principal_axes, label: a}"),),
            "`label` has no effect on the mark `principal_axes`",
        ),
        (
            (("{marks: [", "{plot: mass, against: a, range: [1 m, 2 m], marks: ["),),
            "the mark `centre_of_mass` has no effect on `axes`, which is not the drawing of a `body`",
        ),
    ],
)
def test_a_name_that_cannot_be_drawn_is_an_error(tmp_path: Path, edits: Any, words: str) -> None:
    assert words in {each.message for each in complaints(tmp_path, edited(PLATE, *edits))}


def test_an_axis_begins_outside_the_ball_at_the_end_of_a_rod(tmp_path: Path) -> None:
    parts = (
        "{parts: {rod: {shape: rod, length: 2*a, mass: M}, ball: {shape: ball, radius: b, mass: M, at: [0, 0, a + b]}}}"
    )
    axes = [mark for mark in marks_of(tmp_path, body(parts, "masses"), "body") if isinstance(mark, Axis)]
    assert [[*axis.start] for axis in axes] == [[0, 0, 0], [0, 0, 0], [0, 0, a + 2 * b]]
