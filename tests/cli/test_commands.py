"""The command `derive`: what it prints where, and its exit codes."""

from __future__ import annotations

import json
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from fake_course import Course, stand_in_course

import derive
from derive.cli.check_table import HEADING
from derive.cli.options import main
from tests.courses import course_in

PACKAGE = Path(derive.__file__).resolve().parent.parent


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    monkeypatch.delenv("DERIVE_ROOT", raising=False)
    monkeypatch.delenv("DERIVE_DEBUG", raising=False)
    return stand_in_course(tmp_path, monkeypatch)


# The stand-in for the derivation, then the real command, in a process of its own.
STARTED = (
    "import pytest, pathlib, sys; sys.path.insert(0, sys.argv.pop(1)); import fake_course; "
    "from derive.cli.options import main"
)
STAND_IN = f"{STARTED}; m = pytest.MonkeyPatch(); fake_course.replace_derivation(m); sys.exit(main())"


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-c", STAND_IN, str(Path(__file__).parents[1]), *arguments]


def alone(course: Course) -> dict[str, str]:
    return alone_in(course.root)


def alone_in(root: Path) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(PACKAGE), "DERIVE_ROOT": str(root)}


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


def test_a_loop_is_stopped(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "loop")
    assert main(["solve", "hw1/one", "--time-limit", "0.3"]) == 1
    assert capfd.readouterr().err.startswith(
        "problems/hw1/one.yaml:1:1: error[time-limit]: `hw1/one` took over 0.3 s\n"
    )


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


def test_explain_tells_of_one_step_or_lists_them(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "problems/hw1/one.yaml", "torque"]) == 0
    assert capfd.readouterr() == ("torque: first False\n", "")
    assert main(["explain", "hw1/one", "torque", "--format", "json"]) == 0
    assert capfd.readouterr().out == "torque: first True\n"
    assert main(["explain", "hw1/one"]) == 0
    assert capfd.readouterr().out == "step    part\ntorque  first\n"


def test_explain_works_in_a_worker_with_a_limit(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "loop")
    course.problem("two", "refuse")
    assert main(["explain", "hw1/one", "torque", "--time-limit", "0.3"]) == 1
    assert "error[time-limit]" in capfd.readouterr().err
    assert main(["explain", "hw1/two", "torque"]) == 1
    assert "error[wrong-kind]" in capfd.readouterr().err


def test_check_prints_a_table_and_fails_with_any_problem(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("two", "refuse")
    course.problem("three", "differs")
    course.problem("four", "warn")
    assert main(["check"]) == 1
    out, err = capfd.readouterr()
    rows = [re.sub(r"\d+\.\d", "t", line).split() for line in out.partition("\n\n")[0].splitlines()]
    assert rows == [
        list(HEADING),
        ["hw1/one", "7", "6", "0", "0", "1", "15", "1", "3", "t", "ok"],
        ["hw1/two", "t", "failed:", "wrong-kind"],
        ["hw1/four", "7", "6", "0", "0", "1", "15", "1", "3", "t", "ok"],
        ["hw1/three", "7", "6", "0", "0", "1", "15", "1", "3", "t", "differs", "from", "its", "reference"],
    ], "those that the set lists, in its order, and then the others"
    assert "error[wrong-kind]" in err
    assert "warning[unshown]" in err


def test_check_lists_the_faults_of_the_source_and_is_content(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("two", "slips")
    assert main(["check", "hw1"]) == 0
    told = capfd.readouterr().out
    assert "hw1/two: 1 erratum and 1 remark" in told and "hw1/one:" not in told
    assert "line 12" in told and "a slip" in told


def test_check_writes_the_report_and_says_where(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "hw1", "--report"]) == 0
    assert "wrote build/hw1/report.pdf" in capfd.readouterr().err
    assert b"checks of hw1/one" in (course.outputs / "report.pdf").read_bytes()


def test_check_takes_problems_and_sets(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "hw1/two"]) == 0
    assert course.derived() == ["hw1/two None"]
    assert main(["check", "hw1", "hw1/two", "-j", "1"]) == 0
    assert course.derived() == ["hw1/one None", "hw1/two None"]


def test_build_ends_with_one_line_per_set(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["build"]) == 0
    out, err = capfd.readouterr()
    pages = (
        "build/hw1/one.pdf, build/hw1/two.pdf, build/hw1/solutions.pdf, build/hw1/problems.pdf, build/hw1/report.pdf"
    )
    said = re.fullmatch(r"hw1: derived 2 of 2 problems, wrote (.*) \(\d+\.\d s\)\n", out)
    assert said
    assert sorted(said[1].split(", ")) == sorted(pages.split(", "))
    assert err == ""
    main(["build", "hw1"])
    assert capfd.readouterr().out.startswith("hw1: derived 0 of 2 problems, up to date (")
    course.problem("one", "refuse")
    assert main(["build", "hw1"]) == 1
    assert "failed; earlier pages are as they were" in capfd.readouterr().out


def test_an_up_to_date_build_imports_no_sympy(course: Course) -> None:
    main(["build"])
    code = (
        "import sys; from derive.cli.options import main; main(['build'])\n"
        "print(sorted({'sympy', 'jinja2', 'yaml'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=alone(course))
    assert done.stdout.splitlines()[1:] == ["[]"]


@pytest.mark.parametrize(
    "arguments",
    [[], ["nonsense"], ["solve"], ["solve", "hw1/one", "--format", "docx"], ["solve", "x/y", "--time-limit", "0"]]
    + [["build", "-j", "0"], ["solve", "hw1/one", "--detail", "huge"]],
)
def test_wrong_usage_is_exit_code_2(course: Course, arguments: list[str], capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    assert "usage:" in capfd.readouterr().err


def test_an_unknown_set_is_exit_code_2(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "hw2"]) == 2
    assert capfd.readouterr().err == "error[no-such-set]: there is no set `hw2`\n   = help: did you mean `hw1`?\n"


def test_list_shows_problems_even_if_one_does_not_read(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    course.problem("one", "A block")
    course.problem("two", "refuse")
    assert main(["list"]) == 0
    heading, first, second = capfd.readouterr().out.splitlines()
    assert heading.split() == ["problem", "points", "title"]
    assert first.split() == ["hw1/one", "3", "A", "block"]
    assert second.split(maxsplit=1) == ["hw1/two", "(does not read: `mass` must be a mass)"]


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
        "(does not read: `hw1/two` ended without a word: signal 9)",
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
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=alone_in(root), cwd=root)
    first, _, wrong, right, last = done.stdout.splitlines()
    assert first == "('10', 'A block turning about its axis') []"
    assert wrong.split(maxsplit=1) == ["hw8/block", "(does not read: a part has no key `answers`)"]
    assert right.split(maxsplit=2) == ["hw9/block", "10", "A block turning about its axis"]
    assert last == "False"


def test_the_root_is_found_above_and_by_name(
    course: Course, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(course.folder)
    assert main(["solve", "hw1/one"]) == 0
    (tmp_path / "elsewhere").mkdir()
    assert main(["--root", str(tmp_path / "elsewhere"), "solve", "hw1/one"]) == 2
    assert "there is no folder `problems` in" in capfd.readouterr().err
    monkeypatch.chdir("/")
    assert main(["--root", str(course.root), "solve", "hw1/one"]) == 0
    monkeypatch.setenv("DERIVE_ROOT", str(course.root))
    assert main(["solve", "hw1/one"]) == 0


def test_clean_takes_away_what_builds_made(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "--engine", "pdflatex", "hw1"]) == 0
    capfd.readouterr()
    assert main(["clean", "--cache", "build/hw1/"]) == 0
    out, err = capfd.readouterr()
    assert re.fullmatch(r"removed .*build/hw1/\.derived \(\d+\.\d MB\)\n", out)
    assert err == ""
    assert (course.outputs / "one.pdf").exists()
    assert not (course.outputs / ".derived").exists()
    assert main(["build", "--engine", "pdflatex", "hw1"]) == 0, "which still knows that all is current"
    assert main(["clean"]) == 0
    assert not course.outputs.exists()
    assert (course.root / "problems" / "hw1").exists()
    capfd.readouterr()
    assert main(["clean"]) == 0
    assert capfd.readouterr() == ("", "")


def test_clean_knows_no_set_of_another_name(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["clean", "hw"]) == 2
    assert "error[no-such-set]: there is no set `hw`, and nothing built of one" in capfd.readouterr().err


def test_doctor_names_the_engine_and_where_it_is(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor"]) == 0
    out = capfd.readouterr().out
    assert f"pdflatex from PATH, {Path('bin/pdflatex')}" in out
    assert "problems, with hw1" in out
    assert "build can be written" in out


def test_doctor_says_what_is_missing_with_the_mend(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor", "--engine", "tectonic"]) == 1
    assert "no  TeX       the TeX engine `tectonic` is not installed\n" in capfd.readouterr().out
    (course.root / "build").rmdir()
    (course.root / "build").write_text("")
    assert main(["doctor"]) == 1
    assert "no  outputs" in capfd.readouterr().out


def test_doctor_tries_the_engine(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    (course.root / "bin" / "pdflatex").write_text("#!/bin/sh\nexit 1\n")
    assert main(["doctor"]) == 1
    assert "no  test page TeX failed" in capfd.readouterr().out


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


@pytest.mark.parametrize(
    ("signum", "code", "said"), [(signal.SIGINT, 130, b"interrupted\n"), (signal.SIGTERM, 143, b"")]
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
    assert "hw1: 0 of 2 derived" in seen
    assert "\x1b[1;31merror[wrong-kind]:\x1b[0m" in seen
    assert "\x1b[1;31m" not in on_a_terminal(course, {"NO_COLOR": "1"})
    piped = subprocess.run(command("build"), capture_output=True, text=True, env=alone(course))
    assert "\x1b" not in piped.stderr + piped.stdout
    assert "of 2 derived" not in piped.stderr


def on_a_terminal(course: Course, environment: dict[str, str]) -> str:
    ours, theirs = pty.openpty()
    run = subprocess.Popen(
        command("build"), stdin=theirs, stdout=theirs, stderr=theirs, env={**alone(course), **environment}
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


def until(condition: object) -> None:
    assert callable(condition)
    for _ in range(1500):
        if condition():
            return
        time.sleep(0.02)
    raise AssertionError("it never came")
