"""`derive build`: what it says, interrupted, killed, on a terminal and in a pipe."""

from __future__ import annotations

import os
import pty
import re
import signal
import subprocess
import sys

import pytest

from derive.cli.options import main
from tests.cli.started import alone, command
from tests.fake_course import Course
from tests.waiting import until


def test_build_ends_with_one_line_per_set(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["build"]) == 0
    out, err = capfd.readouterr()
    pages = [f"build/hw1/{name}.pdf" for name in ("one", "two", "solutions", "problems", "report")]
    pages += [f"build/hw1/{name}.html" for name in ("one", "two", "index", "problems")]
    said = re.fullmatch(r"hw1: derived 2 of 2 problems, wrote (.*) \(\d+\.\d s\)\n", out)
    assert said
    assert sorted(said[1].split(", ")) == sorted(pages)
    assert err == ""
    main(["build", "hw1"])
    assert capfd.readouterr().out.startswith("hw1: derived 0 of 2 problems, up to date (")
    course.problem("one", "refuse")
    assert main(["build", "hw1"]) == 1
    assert "failed; earlier pages are unchanged" in capfd.readouterr().out


def test_an_up_to_date_build_imports_no_sympy(course: Course) -> None:
    main(["build"])
    code = (
        "import sys; from derive.cli.options import main; main(['build'])\n"
        "print(sorted({'sympy', 'jinja2', 'yaml'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, env=alone(course))
    assert done.stdout.splitlines()[1:] == ["[]"]


def test_an_unknown_set_is_exit_code_2(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "hw2"]) == 2
    assert capfd.readouterr().err == "error[no-such-set]: no set is called `hw2`\n   = help: did you mean `hw1`?\n"


@pytest.mark.parametrize(
    ("signum", "code", "said"),
    [(signal.SIGINT, 130, b"interrupted\n"), pytest.param(signal.SIGTERM, 143, b"", marks=pytest.mark.long)],
)
def test_an_interrupted_build_says_one_line_and_can_be_resumed(
    course: Course, signum: signal.Signals, code: int, said: bytes
) -> None:
    course.problem("one", "loop")
    run = subprocess.Popen(command("build"), stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=alone(course))
    until(lambda: (course.outputs / "two.pdf").is_file())
    run.send_signal(signum)
    assert run.communicate() == (b"", said)
    assert run.returncode == code
    course.problem("one", "first")
    assert main(["build"]) == 0
    assert course.derived() == ["hw1/one None", "hw1/two None"]  # what was done before is not done again


def test_a_killed_build_leaves_whole_files_and_the_next_run_works(course: Course) -> None:
    course.problem("two", "SLOW")
    run = subprocess.Popen(command("build"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=alone(course))
    until(lambda: (course.outputs / "one.pdf").is_file())
    run.kill()
    run.wait()
    assert (course.outputs / "one.pdf").read_text().endswith("%% derive: hw1/one\nfirst\nstartxref\n%%EOF\n")
    course.problem("two", "second")
    assert main(["build"]) == 0
    assert not [name for name in course.contents() if name.startswith(".")]


def test_a_terminal_sees_progress_and_colour_and_a_pipe_neither(course: Course) -> None:
    course.problem("one", "refuse")
    seen = on_a_terminal(course, {})
    assert re.search(r"hw1: 0 of 2 derived \(\d+ s\); [\w ,]*(one|two) \d+ s", seen)
    assert "\x1b[1;31merror[wrong-kind]:\x1b[0m" in seen
    assert "\x1b[1;31m" not in on_a_terminal(course, {"NO_COLOR": "1"})
    piped = subprocess.run(command("build"), capture_output=True, text=True, env=alone(course))
    assert "\x1b" not in piped.stderr + piped.stdout
    assert "of 2 derived" not in piped.stderr


@pytest.mark.parametrize("verb", ["build", "check"])
def test_with_v_a_terminal_lists_each_problem_with_its_time_as_it_ends(course: Course, verb: str) -> None:
    course.problem("two", "refuse")
    seen = on_a_terminal(course, {}, verb, "-v")
    done = {"build": "derived", "check": "checked"}[verb]
    assert re.search(rf"\r\x1b\[K\x1b\[32m{done}\x1b\[0m hw1/one \(\d+\.\d s\)\r\n", seen)
    assert re.search(r"\x1b\[1;31mfailed\x1b\[0m hw1/two \(\d+\.\d s\)\r\n", seen)
    plain = on_a_terminal(course, {"NO_COLOR": "1"}, verb, "-v")
    assert re.search(r"failed hw1/two \(\d+\.\d s\)\r\n", plain)
    assert not re.search(r"\x1b\[[\d;]*m", plain)


@pytest.mark.parametrize("verb", ["build", pytest.param("check", marks=pytest.mark.long)])
def test_with_q_a_terminal_sees_complaints_and_nothing_else(course: Course, verb: str) -> None:
    assert on_a_terminal(course, {}, verb, "-q").replace("\r\x1b[K", "") == ""
    course.problem("one", "refuse")
    seen = on_a_terminal(course, {"NO_COLOR": "1"}, verb, "-q").replace("\r\x1b[K", "")
    assert seen.splitlines()[0] == "problems/hw1/one.yaml:1:1: error[wrong-kind]: `mass` must be a mass"
    assert len(seen.splitlines()) == 3


def test_v_lists_pages_that_are_kept_and_documents_in_a_pipe_too(
    course: Course, capfd: pytest.CaptureFixture[str]
) -> None:
    main(["build"])
    capfd.readouterr()
    course.problem("one", "edited")
    main(["build", "-v"])
    out, err = capfd.readouterr()
    told = [re.sub(r" \(\d+\.\d s\)$", "", line) for line in err.splitlines()]
    assert {"derived hw1/one", "kept hw1/two", "typeset hw1/solutions.pdf"} <= set(told)
    assert out.count("\n") == 1


def on_a_terminal(course: Course, environment: dict[str, str], *arguments: str) -> str:
    ours, theirs = pty.openpty()
    run = subprocess.Popen(
        command(*(arguments or ("build",))),
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        env={**alone(course), **environment},
    )
    os.close(theirs)
    seen = b""
    while True:
        try:
            piece = os.read(ours, 65536)
        except OSError:  # how Linux says that the other side is closed
            break
        if not piece:
            break
        seen += piece
    run.wait()
    os.close(ours)
    return seen.decode()
