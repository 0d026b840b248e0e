"""`derive new` and `derive schema`: files for whoever begins, and what is said of them."""

from __future__ import annotations

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
    assert capfd.readouterr().out.count("wrote ") == 3
    assert main(["schema", "set"]) == 0
    assert json.loads(capfd.readouterr().out)["title"] == "A set of problems"


def test_what_is_there_stays_as_it_is(root: Path, capfd: pytest.CaptureFixture[str]) -> None:
    before = (root / "problems" / "hw9" / "block.yaml").read_text()
    assert main(["new", "hw9/block"]) == 2
    assert "already" in capfd.readouterr().err
    assert (root / "problems" / "hw9" / "block.yaml").read_text() == before
