"""What a command writes arrives, or a message says why not; letters of all alphabets are shown."""

from __future__ import annotations

import shlex
import subprocess

import pytest

from tests.cli.started import alone, command
from tests.fake_course import Course


@pytest.mark.parametrize("shell", ["{} --version > /dev/full", "{} --help > /dev/full", "{} solve --help > /dev/full"])
def test_what_is_shown_at_once_has_to_arrive_too(course: Course, shell: str) -> None:
    run = in_a_shell(course, shell)
    assert run.returncode == 1
    assert run.stderr == "error[cannot-write]: cannot write `standard output`: the disk is full\n"


def in_a_shell(course: Course, shell: str, **environment: str) -> subprocess.CompletedProcess[str]:
    program = shlex.join(command())
    run = ["bash", "-c", shell.format(program)]
    return subprocess.run(run, env={**alone(course), **environment}, capture_output=True, encoding="utf-8")


@pytest.mark.parametrize("shell", ["{} list", "{} solve hw1/one", "{} explain hw1/one"])
def test_letters_of_all_alphabets_are_shown_where_the_system_has_no_language(course: Course, shell: str) -> None:
    course.problem("one", "ω and é")
    without = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "PYTHONIOENCODING": ""}
    run = in_a_shell(course, shell, **without)
    assert (run.returncode, run.stderr) == (0, "")
    assert "ω and é" in run.stdout


def test_what_a_terminal_cannot_show_is_written_by_its_number(course: Course) -> None:
    course.problem("one", "ω and x")
    assert r"\u03c9 and x" in in_a_shell(course, "{} list", PYTHONIOENCODING="latin-1").stdout
