"""No code in the current folder is run: each Python starts with `-P` or `-I`."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.preview.worker_control import Warm
from tests.courses import ROOT, course_in

TEXTS = ("Makefile", "README.md", "CONTRIBUTING.md", ".ci/run", ".pre-commit-config.yaml", "pyproject.toml")
FOLDERS = ("derive", "tools", "bench", "tests", "docs", "templates", "problems")
SUFFIXES = {".py", ".md", ".yaml", ".j2"}
# Patterns of a Python and its first option: by its name, by a variable of the Makefile, or by `sys.executable`.
STARTS = (
    re.compile(r"\bpython[\d.]*\s+(-\w+)"),
    re.compile(r"\$\(PYTHON\)\s+(\S+)"),
    re.compile(r"\$\$python\s+(\S+)"),
    re.compile(r"\bsys\.executable(?:\)|\}| *\+ *\")?[,\s]+\"?(-\w+|\w+)"),
    re.compile(r"\brun\(python, \"(-\w+)"),  # in bench
)
ISOLATED = ("-P", "-I", "--version")


def files() -> Iterator[Path]:
    yield from (ROOT / name for name in TEXTS)
    for folder in FOLDERS:
        found = (path for path in (ROOT / folder).rglob("*") if path.suffix in SUFFIXES and path.is_file())
        yield from (path for path in found if "decisions" not in path.parts and path != Path(__file__))


def test_each_place_that_starts_python_isolates_it() -> None:
    found, wrong = 0, []
    for path in files():
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            options = [option for start in STARTS for option in start.findall(line)]
            found += len(options)
            if "without `-P`" in line:
                continue
            bad = [option for option in options if option.startswith(("-", "_")) and option not in ISOLATED]
            wrong += [f"{path.relative_to(ROOT)}:{number}: {line.strip()}"] if bad else []
    assert wrong == []
    assert found > 60, "the places are no longer recognised"


@pytest.fixture
def hostile(tmp_path: Path) -> Path:
    """Return a folder whose files have the names of modules that derive, its worker and SymPy import."""
    folder = tmp_path / "here"
    folder.mkdir()
    for name in ("sympy", "random", "yaml", "pathlib", "tempfile", "mpmath", "jinja2", "json"):
        (folder / f"{name}.py").write_text(
            f"open({str(tmp_path / 'taken')!r}, 'a').write({name!r})\nraise SystemExit\n"
        )
    return folder


def test_the_worker_of_a_preview_runs_nothing_of_the_folder_that_one_is_in(
    hostile: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(hostile)
    warm = Warm(course_in(tmp_path), limit=60)
    try:
        shown = warm.page("hw9/block", None)
    finally:
        warm.end()
    assert shown and shown.main
    assert not (tmp_path / "taken").exists()


@pytest.mark.parametrize("options", [[], ["-P"]])
def test_the_command_runs_nothing_of_the_folder_that_one_is_in(
    hostile: Path, tmp_path: Path, options: list[str]
) -> None:
    command = [sys.executable, *options, "-m", "derive", "--root", str(course_in(tmp_path)), "list"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    run = subprocess.run(command, cwd=hostile, env=environment, capture_output=True, text=True)
    assert (run.returncode, run.stderr) == (0, "")
    assert "hw9/block" in run.stdout
    assert not (tmp_path / "taken").exists()


def test_make_runs_nothing_of_the_folder_that_one_is_in(hostile: Path, tmp_path: Path) -> None:
    course_in(hostile)
    for name in ("Makefile", "pyproject.toml", "locks/runtime.txt", "locks/tests.txt", "tools/bootstrap.py"):
        (hostile / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, hostile / name)
    python = hostile / ".venv" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text(f'#!/bin/sh\nPYTHONPATH={ROOT} exec {sys.executable} "$@"\n')
    python.chmod(0o755)
    (hostile / ".venv" / ".runtime").touch()
    run = subprocess.run(["make", "check"], cwd=hostile, capture_output=True, text=True)
    assert (run.returncode, run.stderr) == (0, "")
    assert "hw9/block" in run.stdout
    assert not (tmp_path / "taken").exists()
