"""A command carried out: bugs, slips, readers that have had enough."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from derive.cli.options import main
from tests.cli.started import PACKAGE, alone, command
from tests.fake_course import Course


def test_a_bug_is_told_with_how_to_report_it_and_a_traceback_on_request(
    course: Course, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    course.problem("one", "bug")
    line = (
        "internal error: ZeroDivisionError: nobody thought of that (DERIVE_DEBUG=1 shows the traceback)\n"
        "   = help: this is a bug in derive: report it with the traceback and the files of the problem\n"
    )
    for arguments in (["solve", "hw1/one"], ["build"], ["check", "hw1/one"]):
        assert main(arguments) == 1
        assert capfd.readouterr().err.endswith(line)
    assert main(["solve", "hw1/one"]) == 1
    assert capfd.readouterr().err == line
    monkeypatch.setenv("DERIVE_DEBUG", "1")
    main(["solve", "hw1/one"])
    assert "fake_course.py" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("solve hw1/onne", "no problem is called `hw1/onne`"),
        ("solve one", "did you mean `hw1/one`?"),
        ("solve hw1", "`hw1` is a set"),
        ("explain hw1", "name one of its problems: hw1/one"),
        ("solve hw1/one --format wodr", "derive solve: error: argument --format: invalid choice: 'wodr'"),
        ("solve hw1/one --format jsno", "; did you mean `json`?"),
        ("slove hw1/one", "; did you mean `solve`?"),
        ("build hw1 --only hits", "argument --only: `hits` is not a document: choose from solutions, problems,"),
        ("build hw1 hw2", "no set is called `hw2`"),
        ("check hw2", "no set is called `hw2`"),
        ("check hw1/one hw1/onne", "no problem is called `hw1/onne`"),
        ("list --topic tops", "topics are folders within a set, and none was found"),
        ("why nowhere.pdf", "no build makes `nowhere.pdf`"),
        ("why build", "no build makes `build`"),
        ("why build/hw2/one.pdf", "no set is called `hw2`"),
        ("why /etc", "name a page such as `build/hw9/block.pdf`, a problem or a set"),
        ("new hw1/one/two", "`hw1/one/two` is not a valid name of a set and a problem"),
        ("new one", "`one` is not a valid name of a set and a problem"),
        ("new ../one", "a set cannot be called `..`"),
        ("new build/one", "`make` has a target of that name"),
        ("new hw1/three --like hw1/onne", "no problem is called `hw1/onne`"),
        ("clean hw2", "no set is called `hw2`"),
    ],
)
def test_a_slip_is_met_with_one_message_and_nothing_is_done(
    course: Course, capfd: pytest.CaptureFixture[str], asked: str, told: str
) -> None:
    before = {*course.root.rglob("*")}
    try:
        code = main(asked.split())
    except SystemExit as error:
        code = error.code  # type: ignore[assignment]
    output, complaint = capfd.readouterr()
    assert (code, output) == (2, "")
    assert told in complaint and "Traceback" not in complaint and complaint.count("error") == 1
    assert {*course.root.rglob("*")} == before


def test_a_reader_that_has_had_enough_is_no_error(course: Course) -> None:
    course.problem("one", "x" * 500_000)
    piped = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command("solve", "hw1/one"), env=alone(course), **piped) as run:
        assert run.stdout
        run.stdout.read(1)
        run.stdout.close()
        assert run.stderr
        assert run.stderr.read() == b""
    assert run.returncode == 141


def test_an_interrupt_inside_code_that_runs_a_string_ends_the_command_as_any_interrupt_does(tmp_path: Path) -> None:
    """Python kills a module run with -m at its end if a KeyboardInterrupt passed through `exec`, even if it was
    caught."""
    lines = (
        "import sys",
        "from argparse import Namespace",
        "from derive.cli import running",
        "interrupt = 'import os, signal; os.kill(os.getpid(), signal.SIGINT)'",
        "running._command = lambda name: lambda arguments: exec(interrupt)",
        "sys.exit(running.exit_code(Namespace(command='list')))",
    )
    (tmp_path / "interrupted.py").write_text("\n".join(lines))
    started = {**os.environ, "PYTHONPATH": f"{PACKAGE}{os.pathsep}{tmp_path}"}
    run = subprocess.run(
        [sys.executable, "-P", "-m", "interrupted"], capture_output=True, text=True, env=started, check=False
    )
    assert (run.returncode, run.stderr) == (130, "interrupted\n")
