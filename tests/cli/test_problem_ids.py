"""What a command is asked about: the folder of the course, and wrong usage."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.cli.options import main
from derive.cli.problem_ids import problem_id_of
from tests.fake_course import Course


@pytest.mark.parametrize(
    "arguments",
    [[], ["nonsense"], ["solve"], ["solve", "hw1/one", "--format", "docx"], ["solve", "x/y", "--time-limit", "0"]]
    + [["build", "-j", "0"], ["solve", "hw1/one", "--detail", "huge"]],
)
def test_wrong_usage_is_exit_code_2(course: Course, arguments: list[str], capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    assert "usage:" in capfd.readouterr().err


def test_the_path_of_a_problem_may_begin_anywhere(
    course: Course, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    file = course.folder / "one.yaml"
    elsewhere = tmp_path / "other" / "problems" / "hw1" / "one.yaml"  # a problem of another course
    elsewhere.parent.mkdir(parents=True)
    elsewhere.touch()
    monkeypatch.chdir(course.folder)
    assert {problem_id_of(path) for path in ("one.yaml", str(file), "../hw1/one.yaml", "hw1/one")} == {"hw1/one"}
    assert problem_id_of(str(elsewhere)) != "hw1/one"
    assert {problem_id_of(path) for path in (".", str(course.folder), "../hw1/", "hw1")} == {"hw1"}


def test_the_root_is_found_above_and_by_name(
    course: Course, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(course.folder)
    assert main(["solve", "hw1/one"]) == 0
    (tmp_path / "elsewhere").mkdir()
    assert main(["--root", str(tmp_path / "elsewhere"), "solve", "hw1/one"]) == 2
    assert "no folder `problems` was found in" in capfd.readouterr().err
    monkeypatch.chdir("/")
    assert main(["--root", str(course.root), "solve", "hw1/one"]) == 0
    monkeypatch.setenv("DERIVE_ROOT", str(course.root))
    assert main(["solve", "hw1/one"]) == 0
