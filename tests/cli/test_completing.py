"""What a shell completes: names of the course and options, fast, and nothing that derives is loaded."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from derive.cli.completing import offered
from tests.cli.started import alone
from tests.fake_course import Course

RUN = "import sys; from derive.cli.options import main; main()"


def completed(course: Course, line: str) -> list[str]:
    """What a shell is answered that asks as those of argcomplete do: by the file descriptor 8."""
    asks = {"_ARGCOMPLETE": "1", "COMP_LINE": line, "COMP_POINT": str(len(line)), "_ARGCOMPLETE_IFS": "\n"}
    answer = course.root / "answer.txt"
    asks |= {"_ARGCOMPLETE_STDOUT_FILENAME": str(answer), "_ARGCOMPLETE_SUPPRESS_SPACE": "1"}
    subprocess.run([sys.executable, "-P", "-c", RUN], env={**alone(course), **asks}, check=False, capture_output=True)
    return sorted(answer.read_text().split())


@pytest.mark.parametrize(
    ("line", "names"),
    [
        ("derive prev", ["preview"]),
        ("derive solve ", ["hw1/one", "hw1/two"]),
        ("derive solve hw1/t", ["hw1/two"]),
        ("derive build h", ["hw1", "hw1/one", "hw1/two"]),
        ("derive build hw1 --detail ", ["brief", "full", "standard"]),
        ("derive build --fo", ["--force"]),
        ("derive clean ", ["hw1"]),
        ("derive new ", ["hw1/"]),
        ("derive new hw1/x --like hw1/o", ["hw1/one"]),
        ("derive list --topic ", ["tops"]),
        ("derive completion ", ["bash", "fish", "zsh"]),
        ("derive why build/hw1/o", ["build/hw1/one.pdf"]),
    ],
)
def test_each_argument_is_completed_by_names_of_its_sort(course: Course, line: str, names: list[str]) -> None:
    (course.outputs).mkdir(parents=True)
    (course.outputs / "one.pdf").write_text("x")
    (course.folder / "tops").mkdir()
    if "--topic" in line:
        (course.folder / "tops" / "fast.yaml").write_text("x")
    assert completed(course, line) == names


@pytest.mark.parametrize(("line", "keys"), [("one ", ["spin", "torque"]), ("one t", ["torque"]), ("two ", [])])
def test_steps_are_those_that_the_page_was_built_with(course: Course, line: str, keys: list[str]) -> None:
    course.outputs.mkdir(parents=True)
    page = {"steps": [{"key": "torque"}, {"key": "spin"}]}
    (course.outputs / "one.json").write_text(json.dumps(page), encoding="utf-8")
    assert completed(course, f"derive explain hw1/{line}") == keys


@pytest.mark.parametrize("page", ["", "[]", "{}", '{"steps": 3}', '{"steps": [{}]}', "\xff"])
def test_of_a_page_that_is_none_no_steps_are_offered(course: Course, page: str) -> None:
    course.outputs.mkdir(parents=True)
    (course.outputs / "one.json").write_text(page, encoding="latin-1")
    assert offered("steps", "", str(course.root), "hw1/one") == []


def test_a_folder_that_is_named_is_looked_in(course: Course, tmp_path: Path) -> None:
    other = tmp_path / "other" / "problems" / "hw7"
    other.mkdir(parents=True)
    (other / "wheel.yaml").write_text("x")
    assert completed(course, f"derive --root {tmp_path / 'other'} solve ") == ["hw7/wheel"]


def test_where_there_is_no_course_nothing_is_offered(tmp_path: Path) -> None:
    assert offered("ids", "", str(tmp_path)) == []
    assert offered("ids", "", "a\0b") == []


def test_completion_loads_nothing_that_derives(course: Course) -> None:
    assert completed(course, "derive solve hw1/o") == ["hw1/one"]
    asks = {"_ARGCOMPLETE": "1", "COMP_LINE": "derive solve ", "COMP_POINT": "13"}
    asks["_ARGCOMPLETE_STDOUT_FILENAME"] = str(course.root / "answer.txt")
    run = [sys.executable, "-P", "-X", "importtime", "-c", RUN]
    loaded = subprocess.run(run, env={**alone(course), **asks}, check=False, capture_output=True, text=True).stderr
    assert "argcomplete" in loaded
    assert not [name for name in ("sympy", "yaml", "jinja2", "matplotlib") if f"| {name}\n" in loaded]
    assert os.path.getsize(course.root / "answer.txt")
