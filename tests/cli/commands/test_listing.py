"""`derive list`: problems, topics, and problems that cannot be read."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from derive.cli.options import main
from tests.cli.started import alone_in
from tests.courses import course_in
from tests.fake_course import Course


def test_list_shows_problems_even_if_one_does_not_read(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "A block")
    course.problem("two", "refuse")
    assert main(["list"]) == 0
    heading, first, second = capfd.readouterr().out.splitlines()
    assert heading.split() == ["problem", "points", "title"]
    assert first.split() == ["hw1/one", "3", "A", "block"]
    assert second.split(maxsplit=1) == ["hw1/two", "(cannot be read: `mass` must be a mass)"]


def test_the_list_warns_of_errors_in_the_files_of_sets(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    file = course.folder / "set.yaml"
    file.write_text(file.read_text() + "leters: x\n")
    (course.root / "course.yaml").write_text("titel: Physics\n")
    assert main(["list"]) == 0
    shown = capfd.readouterr()
    assert "hw1/one" in shown.out
    assert "problems/hw1/set.yaml:6:1: warning[unknown-key]: a set has no key `leters`" in shown.err
    assert "course.yaml:1:1: warning[unknown-key]: a course has no key `titel`" in shown.err


@pytest.mark.usefixtures("workers")
def test_a_problem_that_ends_its_reader_costs_the_list_nothing_else(
    course: Course, capfd: pytest.CaptureFixture[str]
) -> None:
    for name, said in {"one": "A block", "two": "die", "three": "A cone"}.items():
        course.problem(name, said)
    assert main(["list"]) == 0
    lines = capfd.readouterr().out.splitlines()[1:]
    assert [line.split(maxsplit=1)[1] for line in lines] == [
        "3  A block",
        "3  A cone",
        "(cannot be read: `hw1/two` ended without a message: signal 9)",
    ]


def test_a_list_may_be_of_one_topic(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "A block")
    rotation = course.root / "problems" / "hw1" / "rotation"
    rotation.mkdir()
    (rotation / "wheel.yaml").write_text("A wheel")
    assert main(["list", "--topic", "rotation"]) == 0
    heading, line = capfd.readouterr().out.splitlines()
    assert (heading.split(), line.split()) == (
        ["problem", "topic", "points", "title"],
        ["hw1/wheel", "rotation", "3", "A", "wheel"],
    )
    assert main(["list", "--topic", "rotaton"]) == 2
    assert "did you mean `rotation`?" in capfd.readouterr().err


def test_a_list_may_be_of_one_set(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "A block")
    other = course.root / "problems" / "hw2"
    other.mkdir()
    (other / "set.yaml").write_text("problems: [two]\n")
    (other / "two.yaml").write_text("A wheel")
    assert main(["list", "problems/hw2/"]) == 0
    assert [line.split()[0] for line in capfd.readouterr().out.splitlines()] == ["problem", "hw2/two"]
    assert main(["list", "hw3"]) == 2
    assert "no set is called `hw3`" in capfd.readouterr().err


def test_a_list_loads_no_mathematics_for_titles_that_have_none(tmp_path: Path) -> None:
    title = {"about <<axis>>\nsolve": "about its axis\nsolve"}
    root = course_in(tmp_path, title)
    course_in(tmp_path / "wrong", {**title, "answer: inertia_tensor": "answers: inertia_tensor"})
    shutil.copytree(tmp_path / "wrong" / "problems" / "hw9", tmp_path / "problems" / "hw8")
    code = (
        "import sys; from derive.building.headline import headline; from pathlib import Path\n"
        "print(headline(Path.cwd(), 'hw9/block'), sorted({'sympy', 'derive.course.latex'} & set(sys.modules)))\n"
        "from derive.cli.options import main; main(['list']); print('sympy' in sys.modules)\n"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", code], capture_output=True, text=True, env=alone_in(root), cwd=root
    )
    first, _, wrong, right, last = done.stdout.splitlines()
    assert first == "('10', 'A block turning about its axis') []"
    assert wrong.split(maxsplit=1) == ["hw8/block", "(cannot be read: a part has no key `answers`)"]
    assert right.split(maxsplit=2) == ["hw9/block", "10", "A block turning about its axis"]
    assert last == "False"
