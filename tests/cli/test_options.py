"""The options of the command line: defaults, limits, and what the commands are handed."""

from __future__ import annotations

import argparse
from argparse import Namespace

import pytest

from derive.cli import running
from derive.cli.options import main, parser_of_commands
from derive.cli.running import COMMANDS


@pytest.fixture
def handed(monkeypatch: pytest.MonkeyPatch) -> list[Namespace]:
    """What the commands are handed, which then do nothing."""
    found: list[Namespace] = []

    def take(arguments: Namespace) -> int:
        found.append(arguments)
        return 7

    monkeypatch.setattr(running, "exit_code", take)
    return found


def test_a_command_has_its_defaults_and_its_exit_code_is_passed_on(handed: list[Namespace]) -> None:
    assert main(["build"]) == 7
    (found,) = handed
    assert (found.command, found.sets, found.force, found.jobs, found.detail) == ("build", [], False, 0, None)
    assert (found.engine, found.time_limit, found.root) == (None, 120.0, None)


def test_options_are_read_wherever_they_stand(handed: list[Namespace]) -> None:
    main(["--root", "course", "solve", "-o", "-", "hw9/block", "--format", "json", "--detail", "full"])
    (found,) = handed
    assert (found.root, found.id, found.output, found.format, found.detail) == (
        "course",
        "hw9/block",
        "-",
        "json",
        "full",
    )
    main(["check", "hw9", "hw1/one", "-j", "3", "--time-limit", "0.5"])
    assert (handed[1].ids, handed[1].jobs, handed[1].time_limit) == (["hw9", "hw1/one"], 3, 0.5)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "COMMAND"),
        (["bild"], "bild"),
        (["solve"], "ID"),
        (["solve", "hw9/block", "--format", "word"], "word"),
        (["build", "--detail", "none"], "none"),
        (["build", "--time-limit", "0"], "invalid time limit value: '0'"),
        (["build", "--time-limit", "inf"], "invalid time limit value: 'inf'"),
        (["build", "--time-limit", "nan"], "invalid time limit value: 'nan'"),
        (["check", "-j", "0"], "invalid count value: '0'"),
        (["check", "-j", "1.5"], "invalid count value: '1.5'"),
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


def commands() -> dict[str, argparse.ArgumentParser]:
    (found,) = (a for a in parser_of_commands()._actions if isinstance(a, argparse._SubParsersAction))
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
        assert [line for line in whole if line.startswith(f"  {command} ")], command
        assert screen([command], capsys, monkeypatch)[0].startswith(f"usage: derive {command}")


def test_to_tell_more_and_to_tell_nothing_exclude_each_other(handed: list[Namespace]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["build", "-q", "-v"])
    assert ended.value.code == 2
    main(["check", "-q"])
    assert (handed[0].quiet, handed[0].verbose) == (True, False)
