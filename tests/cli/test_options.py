"""The command line: what the commands are handed, wrong usage, help, and how little help loads."""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from argparse import Namespace
from collections.abc import Sequence

import pytest

from derive.cli.options import main, parser_of_commands
from derive.cli.running import COMMANDS
from tests.cli.started import PACKAGE


def test_a_command_has_its_defaults_and_its_exit_code_is_passed_on(handed: list[Namespace]) -> None:
    assert main(["build"]) == 7
    (found,) = handed
    assert (found.command, found.sets, found.force, found.jobs, found.detail) == ("build", [], False, 0, None)
    assert (found.engine, found.time_limit, found.root) == (None, 120.0, None)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "COMMAND"),
        (["bild"], "bild"),
        (["solve"], "ID"),
        (["solve", "hw9/block", "--format", "word"], "word"),
        (["build", "--detail", "none"], "none"),
        (["build", "--time-limit", "0"], "`0` is not a positive time in seconds below 1000000, such as 60"),
        (["build", "--time-limit", "inf"], "`inf` is not a positive time in seconds below 1000000, such as 60"),
        (["build", "--time-limit", "nan"], "`nan` is not a positive time in seconds below 1000000, such as 60"),
        (["check", "-j", "0"], "`0` is not a whole number from 1 to 999999999, such as 4"),
        (["check", "-j", "1.5"], "`1.5` is not a whole number from 1 to 999999999, such as 4"),
        (["list", "hw9", "hw10"], "hw10"),
    ],
)
def test_what_is_no_command_line_is_wrong_usage(
    handed: list[Namespace], arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    assert said in capsys.readouterr().err
    assert handed == []


def commands(words: Sequence[str] | None = None) -> dict[str, argparse.ArgumentParser]:
    (found,) = (a for a in parser_of_commands(words)._actions if isinstance(a, argparse._SubParsersAction))
    return dict(found.choices)


def screen(arguments: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> list[str]:
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit) as ended:
        main([*arguments, "--help"])
    assert ended.value.code == 0
    return capsys.readouterr().out.splitlines()


@pytest.mark.parametrize("name", ["", *COMMANDS])
def test_help_fits_a_screen_and_shows_an_example(
    name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = screen([name] if name else [], capsys, monkeypatch)
    assert len(lines) <= 24
    assert max(map(len, lines)) <= 80
    (example,) = [line for line in lines if line.startswith("example: ")]
    for said in example.removeprefix("example: ").split(", then "):
        program, command, *rest = said.split()
        assert program == "derive"
        assert not name or command == name
        assert commands()[command].parse_args(rest)


def test_each_command_is_listed_and_has_help_of_its_own(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = screen([], capsys, monkeypatch)
    assert commands().keys() == COMMANDS.keys()
    for command in COMMANDS:
        alone = [line for line in whole if line.startswith(f"  {command} ")]
        assert alone or re.search(rf"^also: .*\b{command}\b", "\n".join(whole), re.MULTILINE), command
        assert screen([command], capsys, monkeypatch)[0].startswith(f"usage: derive {command}")


@pytest.mark.parametrize("option", ["--help", "--version"])
def test_help_and_version_load_no_more_than_the_names_of_commands(option: str) -> None:
    code = (
        "import sys; from derive.cli.options import main\n"
        "try: main([sys.argv[1]])\n"
        "except SystemExit: print(*(name for name in sys.modules if name.startswith('derive')), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-P", "-c", code, option], capture_output=True, text=True, cwd=PACKAGE)
    assert set(done.stderr.split()) == {"derive", "derive.cli", "derive.cli.options", "derive.cli.streams"}
    assert "derive" in done.stdout


def test_only_the_commands_that_are_named_have_their_options() -> None:
    with_options = {name for name, each in commands(["--root", "list", "solve", "x"]).items() if len(each._actions) > 1}
    assert with_options == {"list", "solve"}
    assert all(len(each._actions) > 1 for each in commands().values())
