"""`derive new` and `derive schema`: files for whoever begins, and what is said of them."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from derive.cli.options import main
from tests.courses import course_in


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = course_in(tmp_path)
    monkeypatch.setenv("DERIVE_ROOT", str(root))
    monkeypatch.chdir(root)
    return root


def test_a_new_problem_can_be_solved_at_once(root: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "hw10/wheel", "--like", "body"]) == 0
    said = capfd.readouterr().out
    assert "wrote problems/hw10/wheel.yaml\n" in said and "wrote problems/hw10/set.yaml\n" in said
    assert "derive preview hw10/wheel" in said
    assert main(["solve", "hw10/wheel"]) == 0


def test_an_editor_finds_the_schema_that_a_new_problem_names(root: Path) -> None:
    main(["new", "hw10/wheel"])
    file = root / "problems" / "hw10" / "wheel.yaml"
    named = file.read_text().splitlines()[0].partition("$schema=")[2]
    assert json.loads((file.parent / named).read_text())["title"] == "A problem"


def test_the_schemas_are_written_or_one_is_printed(root: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    assert capfd.readouterr().out.count("wrote ") == 4
    assert main(["schema", "set"]) == 0
    assert json.loads(capfd.readouterr().out)["title"] == "A set of problems"


def test_what_is_there_stays_as_it_is(root: Path, capfd: pytest.CaptureFixture[str]) -> None:
    before = (root / "problems" / "hw9" / "block.yaml").read_text()
    assert main(["new", "hw9/block"]) == 2
    assert "already" in capfd.readouterr().err
    assert (root / "problems" / "hw9" / "block.yaml").read_text() == before


@pytest.fixture
def outside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("DERIVE_ROOT", raising=False)
    monkeypatch.setattr("derive.cli.problem_ids.found_root", lambda named: _course_above(named))
    monkeypatch.setattr("derive.cli.commands.beginning.found_root", lambda named: _course_above(named))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _course_above(named: str | None) -> Path | None:
    folder = Path(named) if named else Path.cwd()
    return folder if (folder / "problems").is_dir() else None


def test_a_new_course_can_be_checked_at_once(outside: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["init", "physics", "--title", "Waves"]) == 0
    assert "cd physics; derive preview week1/bead" in capfd.readouterr().out
    assert main(["--root", "physics", "check", "week1"]) == 0
    assert main(["init", "physics"]) == 2
    assert "is a course already" in capfd.readouterr().err
    (outside / "problems").mkdir()
    assert main(["init", "."]) == 2


def test_a_new_course_is_not_made_within_a_course(outside: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["init", "physics"]) == 0
    assert main(["init", "physics/problems/week2"]) == 2
    shown = capfd.readouterr().err
    assert "would be within the course" in shown and "derive new SET/PROBLEM" in shown
    assert not (outside / "physics" / "problems" / "week2").exists()
    (outside / "physics" / "course.yaml").unlink()
    assert main(["init", "physics/other"]) == 0, "a folder `problems` alone may belong to another program"


def test_a_problem_begins_like_one_of_the_library_of_derive(outside: Path, capfd: pytest.CaptureFixture[str]) -> None:
    main(["init", "."])
    assert main(["new", "week1/rod", "--like", "library/rod_pendulum"]) == 0
    assert (outside / "problems" / "week1" / "rod.yaml").read_text().count("pendulum")
    assert main(["list", "library", "--topic", "rolling"]) == 0
    assert "library/race" in capfd.readouterr().out


@pytest.mark.parametrize(("answer", "code", "made"), [("y\n", 0, True), ("n\n", 2, False), ("", 2, False)])
def test_without_a_course_one_is_offered_at_a_terminal(
    outside: Path,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    answer: str,
    code: int,
    made: bool,
) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.setattr("sys.stdin", Terminal(answer))
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    assert main(["new", "week1/rod"]) == code
    assert (outside / "course.yaml").exists() == made
    if not made:
        assert "`derive init FOLDER` makes a course" in capfd.readouterr().err
