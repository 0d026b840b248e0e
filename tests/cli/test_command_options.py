"""The options of each command: where they may stand, what each may be, and which exclude each other."""

from __future__ import annotations

import argparse
from argparse import Namespace

import pytest

from derive.cli.command_options import add_options
from derive.cli.options import main
from derive.cli.running import COMMANDS


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


def test_to_tell_more_and_to_tell_nothing_exclude_each_other(handed: list[Namespace]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["build", "-q", "-v"])
    assert ended.value.code == 2
    main(["check", "-q"])
    assert (handed[0].quiet, handed[0].verbose) == (True, False)


@pytest.mark.parametrize("name", COMMANDS)
def test_each_option_of_a_command_has_help(name: str) -> None:
    command = argparse.ArgumentParser()
    add_options(name, command)
    own = command._actions[1:]  # the first is `--help`
    assert own
    assert [action.dest for action in own if not action.help] == []
