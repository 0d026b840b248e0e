"""`derive why`: an answer is no failure, whatever it is, and loads nothing that derives."""

from __future__ import annotations

import subprocess
import sys

import pytest

from derive.cli.options import main
from tests.cli.started import alone
from tests.fake_course import Course


def test_why_names_the_edited_file_and_the_mend(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    main(["build"])
    capfd.readouterr()
    assert main(["why", "build/hw1/one.pdf"]) == 0
    assert capfd.readouterr().out == "build/hw1/one.pdf is up to date\n"
    course.problem("one", "edited")
    assert main(["why", "problems/hw1/one.yaml"]) == 0
    assert capfd.readouterr().out.splitlines() == [
        "hw1/one is out of date:",
        "  `problems/hw1/one.yaml` has changed",
        "to bring it up to date: `derive build hw1/one`",
    ]
    assert main(["why", "build/hw1/one.doc"]) == 2
    assert capfd.readouterr().err.startswith("error[no-such-output]: no build makes `build/hw1/one.doc`\n")


def test_why_imports_no_sympy(course: Course) -> None:
    main(["build"])
    code = (
        "import sys; from derive.cli.options import main; main(['why', 'hw1'])\n"
        "print(sorted({'sympy', 'jinja2', 'yaml'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, env=alone(course))
    assert done.stdout.splitlines() == ["hw1 is up to date", "[]"]
