"""What a file says without effect is told, with its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.course.problem import load_problem
from tests.courses import course_in
from tests.stock.bodies import BLOCK, CONE
from tests.stock.described import PENDULUM, edited, loaded

QUIET = edited(PENDULUM, (", k: spring constant, omega: angular speed", ""))
RESULT = ("  gravity: g\n", "  gravity: g\n  results: {short: {limit: motion_theta, for: l, to: 0}}\n")


def warnings(folder: Path, text: str) -> list[str]:
    return [f"{c.place.line}:{c.place.column}: {c.message}" for c in loaded(folder, text).warnings if c.place]


def test_nothing_is_told_of_a_problem_that_uses_all_it_says(tmp_path: Path) -> None:
    assert warnings(tmp_path, QUIET) == []


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ([("l: length,", "l: length, b: length,")], "3:22: `b` is declared, but nothing under `given` uses it"),
        ([("statement: A bob.", "values: {b: 2 m}\nstatement: <<b>>."), ("l: length,", "l: length, b: length,")],
         "3:22: `b` is declared, but nothing under `given` uses it"),
        ([("{theta: angle}", "{theta: angle, x: length}")],
         "5:31: no place, body, force or energy depends on the coordinate `x`"),
        ([RESULT], "9:13: no part asks for the result `short`, directly or through another result"),
        ([("  gravity: g\n", "  gravity: g\n  at: {theta: 0}\n")], "9:3: nothing that is asked for depends on `at`"),
        ([("  gravity: g\n", "  gravity: g\n  axes: {B: [{z: theta}]}\n")],
         "9:10: no other key under `given` uses the axes `B`"),
    ],
)  # fmt: skip
def test_what_a_description_says_without_effect_is_a_warning(
    edits: list[tuple[str, str]], said: str, tmp_path: Path
) -> None:
    assert warnings(tmp_path, edited(QUIET, *edits)) == [said]


@pytest.mark.parametrize(
    "edits",
    [
        [RESULT, ("answer: equations_of_motion", "answer: short")],
        [RESULT, ("answer: equations_of_motion", "answer: short_1")],
        [RESULT, ("parts:", "limits: [{of: short, letter: m}]\nparts:")],
        [("  gravity: g\n", "  gravity: g\n  at: {theta: 0}\n"), ("answer: equations_of_motion", "answer: frequency")],
        [("l: length,", "l: length, b: length,"), ("parts:", "limits: [{of: motion_theta, letter: b}]\nparts:")],
        [("l: length,", "l: length, b: length,"), ("[l*sin(theta), -l*cos(theta)]", "[b*sin(theta), -l*cos(theta)]")],
        [("l: length,", "l: length, b: length,"), ("statement: A bob.", "statement: A bob.\nnote: If $b = 2l$.")],
        [
            ("l: length,", "l: length, b: length,"),
            ("parts:", "limits: [{of: motion_theta, letter: m, why: 'for $b = 2l$'}]\nparts:"),
        ],
        [
            ("l: length,", "l: length, b: length,"),
            ("statement: A bob.", "statement: A bob.\nwording: {motion_theta: 'For $b = 2l$, <<chain>>'}"),
        ],
    ],
)
def test_what_is_used_somewhere_is_not_told_of(edits: list[tuple[str, str]], tmp_path: Path) -> None:
    assert warnings(tmp_path, edited(QUIET, *edits)) == []


def test_a_forgotten_gravity_is_what_the_help_names(tmp_path: Path) -> None:
    (told,) = loaded(tmp_path, edited(QUIET, ("  gravity: g\n", ""))).warnings
    assert (told.severity, told.place and told.place.line) == ("warning", 3)
    assert told.help == "write `gravity: g` under `given`, or leave it out"


@pytest.mark.parametrize(
    ("text", "edits", "said"),
    [
        (CONE, [("  about: apex\n", "  about: apex\n  direction: x\n")], "depends on `direction`"),
        (CONE, [("  about: apex\n", "  about: apex\n  origin: apex\n")], "depends on `origin`"),
        (CONE, [("answer: inertia_tensor", "answer: centre_of_mass")], "depends on `about`"),
        (BLOCK, [("  along: diagonal\n", ""), ("answer: torque", "answer: euler_equations")], "depends on `rate`"),
    ],
)
def test_a_point_or_an_axis_that_no_answer_needs_is_a_warning(
    text: str, edits: list[tuple[str, str]], said: str, tmp_path: Path
) -> None:
    told = [each for each in warnings(tmp_path, edited(text, *edits)) if "is declared" not in each]
    assert [each.partition("that is asked for ")[2] for each in told] == [said]


def test_a_letter_that_waits_for_another_number_is_used(tmp_path: Path) -> None:
    assert load_problem(course_in(tmp_path, problem="top"), "hw9/top").warnings == ()


def test_the_command_line_tells_of_it(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    from derive.cli.options import main

    loaded(tmp_path, edited(QUIET, ("  gravity: g\n", "")))
    assert main(["--root", str(tmp_path), "solve", "trial/one"]) == 0
    assert "problems/trial/one.yaml:3:31: warning[unused-letter]: `g` is declared" in capfd.readouterr().err
