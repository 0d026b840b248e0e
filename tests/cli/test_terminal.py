"""What the command line shows: each fault once, columns aligned, colour and progress on a terminal alone."""

from __future__ import annotations

import io
import sys

import pytest

from derive.cli import terminal
from derive.cli.terminal import EVERY, MOST, complain, faults_of_source, in_colour, note, paced, table, tell
from derive.errors import Complaint, Place


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("COLUMNS", "20")
    monkeypatch.setenv("TERM", "xterm")
    shown = Terminal()
    monkeypatch.setattr(sys, "stderr", shown)
    return shown


def test_of_very_many_faults_fifty_are_told_and_the_rest_counted(capsys: pytest.CaptureFixture[str]) -> None:
    complain(Complaint("x", f"fault {n}") for n in range(20_000))
    lines = capsys.readouterr().err.splitlines()
    assert (len(lines), lines[-2:]) == (MOST + 1, ["error[x]: fault 49", "and 19950 more"])


def test_the_same_fault_is_told_once_in_the_order_of_the_first(capsys: pytest.CaptureFixture[str]) -> None:
    one, two = Complaint("x", "one"), Complaint("x", "two", severity="warning")
    complain([two, one, two, one])
    assert capsys.readouterr().err == "warning[x]: two\nerror[x]: one\n"
    complain([])
    assert capsys.readouterr().err == ""


def test_only_the_head_of_a_fault_has_colour(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = on_a_terminal(monkeypatch)
    fault = Complaint("bad", "error[x]: in words", Place("a.yaml", 1, 1, "error[y]:", 1))
    complain([fault])
    assert terminal.getvalue().count("\x1b[1;31m") == 1
    assert "\x1b[1;31merror[bad]:\x1b[0m error[x]" in terminal.getvalue()
    complain([Complaint("odd", "x", severity="warning")])
    assert "\x1b[1;33mwarning[odd]:" in terminal.getvalue()
    monkeypatch.setenv("NO_COLOR", "1")
    before = terminal.getvalue()
    complain([fault])
    assert "\x1b" not in terminal.getvalue().removeprefix(before)


def test_progress_is_one_line_that_fits(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = on_a_terminal(monkeypatch)
    tell("x" * 40)
    tell("")
    assert terminal.getvalue() == "\r\x1b[K" + "x" * 19 + "\r\x1b[K"


def test_into_a_file_progress_is_a_line_now_and_then(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = [0.0]
    monkeypatch.setattr(terminal.time, "monotonic", lambda: clock[0])
    tell("before a command")
    with paced():
        for second in range(3 * EVERY):
            clock[0] = second
            tell(f"{second} s")
            tell("")
    assert capsys.readouterr().err == f"{EVERY} s\n{2 * EVERY} s\n"


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("block 2 s, top 1 s", "block 2 s, top 1 s"),
        ("block 2 s, top 1 s, a", "block 2 s, ..."),
        ("block 2 s, a, top 1 s", "block 2 s, a, ..."),
    ],
)
def test_a_list_that_is_too_long_for_the_line_ends_behind_an_item(
    monkeypatch: pytest.MonkeyPatch, text: str, shown: str
) -> None:
    terminal = on_a_terminal(monkeypatch)
    tell(text)
    assert terminal.getvalue() == f"\r\x1b[K{shown}"


def test_what_is_done_stays_over_what_is_under_way_with_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = on_a_terminal(monkeypatch)
    monkeypatch.setenv("NO_COLOR", "1")
    note("derived", "hw9/block", 1.25)
    note("kept", "hw9/top", 0.0)
    assert terminal.getvalue() == "\r\x1b[Kderived hw9/block (1.2 s)\n\r\x1b[Kkept hw9/top\n"


def test_colour_is_for_terminals_that_know_it_and_where_nobody_says_no(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not in_colour()
    on_a_terminal(monkeypatch)
    monkeypatch.setenv("TERM", "xterm")
    assert in_colour()
    monkeypatch.setenv("TERM", "dumb")
    assert not in_colour()


def test_progress_is_silent_in_a_pipe(capsys: pytest.CaptureFixture[str]) -> None:
    tell("derived 1 of 2")
    assert capsys.readouterr() == ("", "")


def test_words_stand_to_the_left_and_numbers_to_the_right() -> None:
    rows = [("problem", "lines", "s"), ("hw9/block", "83", "1.5"), ("hw9/top", "7", "12.25")]
    assert table(rows).splitlines() == [
        "problem    lines      s",
        "hw9/block     83    1.5",
        "hw9/top        7  12.25",
    ]
    assert table([("a", "b"), ("", "x")]) == "a  b\n   x"


def test_the_faults_of_a_source_are_told_with_line_quotation_and_why() -> None:
    faults = [
        ("erratum", "312", "13/22", "13/12", "a slip of the pen"),
        ("remark", "", "a\x1b[31mcube", "", "a block"),
    ]
    assert faults_of_source("hw9/block", faults).splitlines() == [
        "hw9/block: 1 erratum and 1 remark",
        "  line 312   erratum  13/22",
        "               right: 13/12",
        "                 why: a slip of the pen",
        "  printed    remark   a [31mcube",
        "                 why: a block",
    ]


def test_a_long_quotation_is_wrapped_and_loses_nothing() -> None:
    lines = faults_of_source("hw9/block", [("remark", "3", "x " * 99, "", "why " * 60)] * 2).splitlines()
    assert lines[0].endswith("2 remarks")
    assert all(len(line) <= 100 for line in lines)
    assert "".join(lines).count("x") == 2 * 99
