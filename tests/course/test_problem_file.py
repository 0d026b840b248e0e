"""What a problem's file says before its script is run: its keys and their shapes."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.course.problem_file import ANY_OUTCOME, ProblemKeys, written_problem
from derive.errors import Faults, Rejected
from tests.course.problem_file import at, edited, faults, loaded


def test_wording_is_by_outcome_or_for_any(tmp_path: Path) -> None:
    wording = loaded(tmp_path).wording
    assert wording["torque"]["zero"].text == "No torque is needed."
    assert wording["spin"][ANY_OUTCOME].text == "It turns."


@pytest.mark.parametrize(
    ("edit", "fault"),
    [
        (("parts:\n", "parts: none\nparty:\n"), "unknown-key"),
        (("  - ask: Find the inertia tensor about the centre.\n", "  - \n"), "missing-key"),
        (("answer: angle_between", "answer: []"), "missing-value"),
        (("answer: [torque, magnitude]", "answer: [magnitude, magnitude]"), "duplicate-answer"),
        (("form: {magnitude: {unit: N m}}", "form: {torq: {unit: N m}}"), "unknown-key"),
        (("form: {magnitude: {unit: N m}}", "form: {magnitude: {}, torque: N m}"), "wrong-type"),
        (("form: {magnitude: {unit: N m}}", "form: N m"), "wrong-type"),
        (("solve: block.py", "solve: ../../block.py"), "wrong-type"),
        (("solve: block.py", "solve: blok.py"), "missing-file"),
        (("symbols: {a", "symbols: {sin: length, a"), "symbol"),
        (("show: {spin: result}", "show: [spin]"), "wrong-type"),
        (("title: A block", "title: A #1 block"), "comment-in-text"),
        (("title: A block turning about its long diagonal", "title:"), "missing-value"),
        (("note: Balance your wheels.", "note: {a: b}"), "wrong-type"),
        (("  axis: diagonal\n", ""), "missing-given"),
        (("  rate: omega", "  rate: omega\n  colour: red"), "unknown-given"),
    ],
)
def test_a_key_of_the_wrong_shape_is_refused(edit: tuple[str, str], fault: str, tmp_path: Path) -> None:
    assert fault in [found.partition(" ")[2] for found in faults(tmp_path, edited(edit))]


def test_optional_mappings_may_be_empty(tmp_path: Path) -> None:
    assert loaded(tmp_path, ("show: {spin: result}", "show:")).show == {}


def written(folder: Path, *edits: tuple[str, str]) -> tuple[ProblemKeys, list[tuple[str, str | None]]]:
    faults = Faults()
    found = written_problem(at(folder, edited(*edits)), "hw9/block", faults)
    try:
        faults.stop()
    except Rejected as refused:
        return found, [(complaint.code, complaint.help) for complaint in refused.complaints]
    return found, []


def test_a_file_is_read_without_its_script(tmp_path: Path) -> None:
    found, faults = written(tmp_path, ("solve: block.py", "solve: nowhere.py"))
    assert (found.title and found.title.text, found.points_in_all(Faults())) == (
        "A block turning about its long diagonal",
        10,
    )
    assert faults == []


def test_a_kind_that_is_mistyped_is_not_known(tmp_path: Path) -> None:
    found, faults = written(tmp_path, ("M: mass", "M: mas"), ("omega: angular speed", "omega: zebra"))
    assert {name: kind.known for name, kind in found.symbols.items()} == {"a": True, "M": False, "omega": False}
    assert [code for code, _ in faults] == ["unknown-kind"] * 2
    assert faults[0][1] == "did you mean `mass`?"
    assert (faults[1][1] or "").startswith("the kinds are ")


def test_the_lines_of_a_step_stand_once_in_its_words(tmp_path: Path) -> None:
    found, faults = written(tmp_path, ("spin: It turns.", "spin: So <<chain>> and again <<chain>>."))
    assert [code for code, _ in faults] == ["twice"]
    assert found.wording["spin"][ANY_OUTCOME].text.startswith("So ")
    assert written(tmp_path / "one", ("spin: It turns.", "spin: So <<chain>>."))[1] == []
