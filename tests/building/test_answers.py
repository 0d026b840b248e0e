"""All that a problem's parts may ask for is listed, and each name of the list can be asked for."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.answers import answers_of
from derive.cli.options import main
from tests.courses import course_in
from tests.stock.answering.test_names_of_answers import TABLE
from tests.stock.bodies import CONE
from tests.stock.described import course_with, solved

ORBIT = f"{TABLE}  - {{ask: Find it., answer: lagrangian}}\n"


def test_each_answer_is_told_with_what_it_is_and_its_value(tmp_path: Path) -> None:
    heading, *rows = answers_of(course_with(tmp_path, ORBIT), "trial/one")
    assert heading == ("answer", "is", "value")
    assert ("momentum_phi", "the momentum of phi", "p_φ = m_1 r² φ̇") in rows
    assert ("equations_of_motion", "the equation of motion of each coordinate", "motion_r, motion_phi") in rows
    assert ("rate_phi_by_p_phi", "a step of `routhian`: rate by momenta", "φ̇ = p_φ/(m_1 r²)") in rows
    (made,) = (row for row in rows if row[0] == "radial_equation")
    assert made[1] == "a result, computed from `motion_r`, `rate_phi_by_p_phi`"
    assert "constraints" in {name: value for name, _, value in rows}["multipliers"]  # why there are none
    assert [value.startswith("(not derived") for *_, value in rows] == sorted(
        value.startswith("(not derived") for *_, value in rows
    )


@pytest.mark.parametrize(("text", "own"), [(ORBIT, "answer: lagrangian"), (CONE, "answer: inertia_tensor")])
def test_each_listed_name_can_be_asked_for_alone(text: str, own: str, tmp_path: Path) -> None:
    _, *rows = answers_of(course_with(tmp_path, text), "trial/one")
    names = [name for name, _, value in rows if not value.startswith("(not derived")]
    assert len(names) > 20 and len(set(names)) == len(names)
    for name in names[::4]:
        assert solved(tmp_path, text.replace(own, f"answer: {name}"))


def test_what_a_script_yields_is_listed_too(tmp_path: Path) -> None:
    _, *rows = answers_of(course_in(tmp_path), "hw9/block")
    assert [name for name, is_, _ in rows if is_ == "an answer of the script"]


def test_the_command_prints_the_list(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    root = str(course_with(tmp_path, CONE))
    assert main(["--root", root, "list", "trial/one", "--answers"]) == 0
    lines = capfd.readouterr().out.splitlines()
    assert lines[0].split() == ["answer", "is", "value"]
    assert any(line.startswith("principal_moments ") and "the principal moments of inertia" in line for line in lines)


def test_the_command_needs_a_problem(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["--root", str(course_with(tmp_path, CONE)), "list", "trial", "--answers"]) == 2
    assert "`--answers` lists the answers of one problem" in capfd.readouterr().err
