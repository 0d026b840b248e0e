"""`derive diff`: its exit codes, where it writes, and that it works in a worker."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import derive.building.diff
import derive.building.set_diff
from derive.building.changes import Change
from derive.building.diff import Diff
from derive.building.set_diff import SetDiff
from derive.cli.options import main
from derive.errors import Complaint
from tests.fake_course import Course

CHANGED = Diff("the last build", (Change("points", "the problem", "10", "12"),))


def compares(monkeypatch: pytest.MonkeyPatch, found: Diff) -> list[tuple[object, ...]]:
    asked: list[tuple[object, ...]] = []
    for name in ("since_build", "since_revision"):

        def stand_in(root: Path, *how: object, name: str = name) -> Diff:
            asked.append((name, *how))
            return found

        monkeypatch.setattr(derive.building.diff, name, stand_in)
    return asked


def test_the_same_is_0_and_another_1(
    course: Course, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = compares(monkeypatch, Diff("the last build", ()))
    assert main(["diff", "problems/hw1/one.yaml"]) == 0
    assert capsys.readouterr() == ("hw1/one: nothing has changed since the last build\n", "")
    assert asked == [("since_build", "hw1/one", None, 120.0)]
    compares(monkeypatch, CHANGED)
    assert main(["diff", "hw1/one"]) == 1
    assert "  ~ the problem: 10 -> 12\n" in capsys.readouterr().out


def test_a_revision_and_a_detail_are_passed_on(
    course: Course, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = compares(monkeypatch, CHANGED)
    assert main(["diff", "hw1/one", "--rev", "HEAD~1", "--detail", "full", "--format", "json"]) == 1
    assert asked == [("since_revision", "hw1/one", "HEAD~1", "full", 120.0)]
    assert json.loads(capsys.readouterr().out)["changes"][0]["after"] == "12"


@pytest.mark.parametrize("no_color", ["", "1"])
def test_colour_is_for_a_terminal_only(
    course: Course, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], no_color: str
) -> None:
    monkeypatch.setenv("NO_COLOR", no_color)
    compares(monkeypatch, CHANGED)
    main(["diff", "hw1/one"])
    assert "\x1b" not in capsys.readouterr().out
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    main(["diff", "hw1/one"])
    assert ("\x1b[31m10\x1b[0m" in capsys.readouterr().out) == (not no_color)


def test_what_cannot_be_compared_is_2(course: Course, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["diff", "hw1/one"]) == 2
    assert "error[not-built]" in capsys.readouterr().err
    assert main(["diff", "hw1/nobody"]) == 2
    assert "error[no-such-problem]" in capsys.readouterr().err


def test_a_problem_that_does_not_derive_is_2_and_so_is_a_fault_of_derive(
    course: Course, capsys: pytest.CaptureFixture[str]
) -> None:
    course.outputs.mkdir(parents=True)
    page = {"detail": "standard", "statement": "", "limits_say": [], "note": "", "warnings": []}
    (course.outputs / "one.json").write_text(json.dumps(page))
    course.problem("one", "refuse")
    assert main(["diff", "hw1/one"]) == 2
    assert "error[wrong-kind]" in capsys.readouterr().err
    course.problem("one", "bug")
    assert main(["diff", "hw1/one"]) == 2
    assert "internal error: ZeroDivisionError" in capsys.readouterr().err


def test_warnings_go_to_standard_error(
    course: Course, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    warning = Complaint("other-engine", "derive itself is another", severity="warning")
    compares(monkeypatch, Diff("the last build", (), (warning,)))
    assert main(["diff", "hw1/one"]) == 0
    assert capsys.readouterr().err == "warning[other-engine]: derive itself is another\n"


def test_of_a_set_the_set_itself_and_what_has_changed_of_its_problems(
    course: Course, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    same = Diff("the last build", ())
    for own, problems, code in ((CHANGED, {"hw1/one": same}, 1), (same, {"hw1/two": CHANGED}, 1), (same, {}, 0)):
        found = SetDiff(own, problems)
        monkeypatch.setattr(derive.building.set_diff, "set_since_build", lambda *how, found=found: found)
        assert main(["diff", "hw1"]) == code
        text = capsys.readouterr().out
        assert (text.count("10 -> 12"), "hw1/one" in text) == (code, False)
        assert main(["diff", "hw1", "--format", "json"]) == code
        data = json.loads(capsys.readouterr().out)
        assert (data["set"], data["changed"], [each["problem"] for each in data["problems"]]) == (
            "hw1",
            bool(code),
            [*problems],
        )
