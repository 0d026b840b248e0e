"""`derive check`: its table, the faults of the source, the report."""

from __future__ import annotations

import re

import pytest

from derive.cli.check_table import HEADING
from derive.cli.options import main
from tests.fake_course import Course


def test_check_prints_a_table_and_fails_with_any_problem(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("two", "refuse")
    course.problem("three", "differs")
    course.problem("four", "warn")
    assert main(["check"]) == 1
    out, err = capfd.readouterr()
    rows = [re.sub(r"\d+\.\d", "t", line).split() for line in out.partition("\n\n")[0].splitlines()]
    assert rows == [
        list(HEADING),
        ["hw1/one", "7", "6", "0", "0", "1", "15", "1", "3", "t", "ok"],
        ["hw1/two", "t", "failed:", "wrong-kind"],
        ["hw1/four", "7", "6", "0", "0", "1", "15", "1", "3", "t", "ok"],
        ["hw1/three", "7", "6", "0", "0", "1", "15", "1", "3", "t", "differs", "from", "its", "reference"],
    ], "those that the set lists, in its order, and then the others"
    assert "error[wrong-kind]" in err
    assert "warning[unshown]" in err


def test_check_lists_the_faults_of_the_source_and_is_content(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("two", "slips")
    assert main(["check", "hw1"]) == 0
    told = capfd.readouterr().out
    assert "hw1/two: 1 erratum and 1 remark" in told and "hw1/one:" not in told
    assert "line 12" in told and "a slip" in told


def test_check_writes_the_report_and_says_where(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "hw1", "--report"]) == 0
    assert "wrote build/hw1/report.pdf" in capfd.readouterr().err
    assert b"checks of hw1/one" in (course.outputs / "report.pdf").read_bytes()


def test_check_takes_problems_and_sets(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "hw1/two"]) == 0
    assert course.derived() == ["hw1/two None"]
    assert main(["check", "hw1", "hw1/two", "-j", "1"]) == 0
    assert course.derived() == ["hw1/one None", "hw1/two None"]
