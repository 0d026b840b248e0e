"""`derive solve` and `derive explain`: what they print where, and what stops them."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from derive.cli.options import main
from tests.courses import course_in
from tests.fake_course import Course


def test_solve_prints_the_text_and_nothing_else(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "print")
    assert main(["solve", "hw1/one"]) == 0
    out, err = capfd.readouterr()
    assert out == "print ω\n"
    assert err == "chatter of the script\n"


def test_solve_gives_json_and_latex(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    main(["solve", "hw1/one", "--format", "json"])
    assert json.loads(capfd.readouterr().out)["steps"] == [{}, {}]
    main(["solve", "hw1/one", "--format", "latex"])
    assert capfd.readouterr().out == "%% derive: hw1/one\nfirst\n"


def test_solve_passes_the_detail_on(course: Course) -> None:
    main(["solve", "hw1/one", "--detail", "full", "-o", "one.txt"])
    assert course.derived() == ["hw1/one full"]
    assert (course.root / "one.txt").read_text() == "first ω\n"


def test_solve_says_where_its_pdf_is(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "hw1/one", "--format", "pdf"]) == 0
    assert capfd.readouterr().err == "wrote build/hw1/one.pdf\n"
    assert main(["solve", "hw1/one", "--format", "pdf", "--detail", "brief"]) == 0
    assert capfd.readouterr().err == "wrote build/hw1/one-brief.pdf\n"
    assert main(["solve", "hw1/one", "--format", "pdf", "-o", "-"]) == 0
    assert "first" in capfd.readouterr().out


def test_a_path_completed_by_the_shell_names_a_problem(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "problems/hw1/one.yaml"]) == 0
    assert capfd.readouterr().out == "first ω\n"


def test_a_fault_is_shown_on_standard_error_with_exit_code_1(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "refuse")
    assert main(["solve", "hw1/one"]) == 1
    out, err = capfd.readouterr()
    assert out == ""
    assert err == ("problems/hw1/one.yaml:1:1: error[wrong-kind]: `mass` must be a mass\n  1 | refuse\n    | ^^^^^^\n")


@pytest.mark.usefixtures("workers")
def test_a_loop_is_stopped(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "loop")
    assert main(["solve", "hw1/one", "--time-limit", "0.3"]) == 1
    assert capfd.readouterr().err.startswith(
        "problems/hw1/one.yaml:1:1: error[time-limit]: `hw1/one` took over 0.3 s of processor time\n"
    )


def test_explain_tells_of_one_step_or_lists_them(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "problems/hw1/one.yaml", "torque"]) == 0
    assert capfd.readouterr() == ("torque: first False\n", "")
    assert main(["explain", "hw1/one", "torque", "--format", "json"]) == 0
    assert capfd.readouterr().out == "torque: first True\n"
    assert main(["explain", "hw1/one"]) == 0
    assert capfd.readouterr().out == "step    part\ntorque  first\n"


@pytest.mark.usefixtures("workers")
def test_explain_works_in_a_worker_with_a_limit(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "loop")
    course.problem("two", "refuse")
    assert main(["explain", "hw1/one", "torque", "--time-limit", "0.3"]) == 1
    assert "error[time-limit]" in capfd.readouterr().err
    assert main(["explain", "hw1/two", "torque"]) == 1
    assert "error[wrong-kind]" in capfd.readouterr().err


def test_a_page_in_a_file_has_the_drawings_that_it_refers_to_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(course_in(tmp_path))
    assert main(["solve", "hw9/block", "--format", "markdown", "-o", "page.md"]) == 0
    linked = re.findall(r"\]\((.*\.svg)\)", Path("page.md").read_text(encoding="utf-8"))
    assert len(linked) == 2
    assert sorted(path.name for path in tmp_path.glob("*.svg")) == sorted(linked)
    assert not [*tmp_path.glob("*.pdf")]
    assert main(["solve", "hw9/block", "--format", "markdown", "-o", "page.md"]) == 0, "it may be written again"
