"""`derive completion`: a script for each shell, and bash completes by it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from derive.cli.command_options import SHELLS
from derive.cli.options import main
from tests.cli.started import alone
from tests.fake_course import Course

ASKED = r"""
eval "$(derive completion bash)"
COMP_LINE="derive solve hw1/t"; COMP_POINT=${#COMP_LINE}; COMP_TYPE=9; COMPREPLY=()
registered=$(complete -p derive | sed 's/.*-F \([^ ]*\).*/\1/')
"$registered" derive
echo "${COMPREPLY[@]}"
"""


def programs(root: Path) -> Path:
    folder = root / "bin"
    (folder / "derive").write_text(f"#!{sys.executable} -P\nfrom derive.cli.options import main\nmain()\n")
    (folder / "derive").chmod(0o755)
    return folder


def test_bash_completes_the_names_of_problems(course: Course) -> None:
    environment = alone(course)
    environment["PATH"] = f"{programs(course.root)}:{environment['PATH']}"
    done = subprocess.run(["bash", "--norc", "-c", ASKED], capture_output=True, text=True, env=environment)
    assert (done.stdout.strip(), done.stderr) == ("hw1/two", "")


@pytest.mark.parametrize("shell", SHELLS)
def test_each_shell_has_a_script_of_its_own(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    sign = {"bash": "complete -o", "zsh": "compdef", "fish": "complete --"}[shell]
    assert sign in script
    assert "derive" in script


def test_the_script_of_fish_names_a_program_that_is_found(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", os.devnull)
    monkeypatch.setattr(sys, "argv", [".venv/bin/derive"])
    main(["completion", "fish"])
    assert f"{Path.cwd()}/.venv/bin/derive 8>&1" in capsys.readouterr().out
