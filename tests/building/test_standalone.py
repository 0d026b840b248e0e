"""What is typeset apart from a build: one solution, and the report of a set or of a problem that was checked."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.standalone import reports, typeset_standalone
from tests.fake_course import Course, rendered, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    return stand_in_course(tmp_path, monkeypatch)


def test_a_document_is_typeset_and_nothing_else_is_written(course: Course) -> None:
    pdf = typeset_standalone(course.outputs, "one", "said\n", (), None, 20)
    assert pdf.startswith(b"%PDF") and b"said" in pdf
    assert not course.outputs.exists()


def test_a_set_that_was_checked_has_one_report(course: Course) -> None:
    solved = {each: rendered(course.root, each) for each in ("hw1/one", "hw1/two")}
    written = reports(course.root, solved, None, 20)
    assert list(written) == [str(course.outputs / "report.pdf")]
    assert b"checks of hw1/two" in written[str(course.outputs / "report.pdf")]


def test_the_report_of_one_problem_does_not_take_the_place_of_that_of_its_set(course: Course) -> None:
    written = reports(course.root, {"hw1/one": rendered(course.root, "hw1/one")}, None, 20)
    assert list(written) == [str(course.outputs / "one-report.pdf")]
