"""A command carried out: bugs, readers that have had enough, nothing heavy for help."""

from __future__ import annotations

import subprocess
import sys

import pytest
from fake_course import Course

from derive.cli.options import main
from tests.cli.started import PACKAGE, alone, command


def test_help_and_version_import_no_heavy_package() -> None:
    code = (
        "import sys; from derive.cli.options import main\n"
        "try: main([sys.argv[1]])\n"
        "except SystemExit: print(sorted({'sympy', 'jinja2', 'yaml'} & set(sys.modules)), file=sys.stderr)"
    )
    for option in ("--help", "--version"):
        done = subprocess.run([sys.executable, "-c", code, option], capture_output=True, text=True, cwd=PACKAGE)
        assert done.stderr == "[]\n"
        assert "derive" in done.stdout


def test_a_bug_is_told_with_how_to_report_it_and_a_traceback_on_request(
    course: Course, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    course.problem("one", "bug")
    line = (
        "internal error: ZeroDivisionError: nobody thought of that (DERIVE_DEBUG=1 shows the traceback)\n"
        "   = help: this is a fault of derive: report it with the traceback and the files of the problem\n"
    )
    for arguments in (["solve", "hw1/one"], ["build"], ["check", "hw1/one"]):
        assert main(arguments) == 1
        assert capfd.readouterr().err.endswith(line)
    assert main(["solve", "hw1/one"]) == 1
    assert capfd.readouterr().err == line
    monkeypatch.setenv("DERIVE_DEBUG", "1")
    main(["solve", "hw1/one"])
    assert "fake_course.py" in capfd.readouterr().err


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
