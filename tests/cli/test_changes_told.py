"""How changes are told: under headings, one line where there is room, in colour only where it is asked for."""

from __future__ import annotations

import json

from derive.building.changes import ADDED, EQUAL, REMOVED, Change
from derive.building.diff import Diff
from derive.cli.change_report import as_json, told
from derive.cli.terminal import WIDTH
from derive.render.notation.text import columns


def text(*changes: Change, coloured: bool = False) -> list[str]:
    return told("hw9/block", Diff("the last build", changes), coloured).splitlines()


def test_nothing_changed_is_one_line() -> None:
    assert text() == ["hw9/block: nothing has changed since the last build"]


def test_each_sort_has_its_heading_and_is_counted() -> None:
    assert text(
        Change("points", "the problem", "10", "12"),
        Change("part", "part b", "Find it.", ""),
        Change("part", "part b", "part c", "part b"),
        Change("answer", "torque", "tau = 1", "tau = 2"),
        Change("step", "spin", "", "omega"),
        Change("step", "torque", "1", "2", facets=(("result", "1", "2"), ("lines", "x", "y"), ("outcome", "a", "b"))),
        Change("number", "torque", "(3)", "(4)"),
        Change("order", "steps", "a b", "b a"),
    ) == [
        "hw9/block: changed since the last build: 1 number of points, 2 parts, 1 answer, 2 steps, 1 number",
        "of an equation, 1 other order",
        "",
        "points",
        "  ~ the problem: 10 -> 12",
        "",
        "parts",
        "  - part b: Find it.",
        "  part c is now part b",
        "",
        "answers",
        "  ~ torque: tau = 1 -> tau = 2",
        "",
        "steps",
        "  + spin: omega",
        "  ~ torque: 1 -> 2",
        "      outcome: a -> b",
        "",
        "numbers of equations",
        "  torque (3) -> (4)",
        "",
        "order",
        "  the remaining steps are in a different order",
    ]


def test_what_is_long_stands_one_above_the_other() -> None:
    old, new = "x" * 60, "y" * 60
    assert text(Change("answer", "torque", old, new))[-3:] == ["  ~ torque", f"      - {old}", f"      + {new}"]


def test_of_many_lines_on_the_way_the_first_are_shown() -> None:
    lines = "\n".join("abcdefg")
    shown = text(Change("step", "torque", "1", "1", facets=(("lines", lines, "z"),)))
    assert shown[-5:] == ["        - a", "        - b", "        - c", "        - and 4 more", "        + z"]


SENTENCE = Change(
    "sentence",
    "statement",
    "before",
    "after",
    ((EQUAL, "It is a very long way from here to there, and"), (REMOVED, "back again."), (ADDED, "no further.")),
)


def test_a_sentence_has_marks_and_the_words_next_to_them() -> None:
    assert text(SENTENCE)[-2:] == [
        "  statement",
        "      … way from here to there, and [-back again.-] {+no further.+}",
    ]


def test_colours_take_no_room_and_are_left_out_of_plain_text() -> None:
    long = Change("sentence", "note", "x", "y", ((REMOVED, "word " * 60 + "end"), (ADDED, "other")))
    plain, coloured = text(long), text(long, coloured=True)
    assert "\x1b[31m" in "".join(coloured)
    assert "\x1b" not in "".join(plain)
    stripped = [line.replace("\x1b[31m", "").replace("\x1b[32m", "").replace("\x1b[0m", "") for line in coloured]
    assert stripped == plain
    assert max(map(columns, plain)) <= WIDTH


def test_programs_get_the_same() -> None:
    data = json.loads(as_json("hw9/block", Diff("`HEAD`", (SENTENCE,))))
    assert (data["problem"], data["since"], data["changed"]) == ("hw9/block", "`HEAD`", True)
    (change,) = data["changes"]
    assert (change["of"], change["how"], change["words"][1]) == ("sentence", "changed", ["removed", "back again."])
    assert json.loads(as_json("hw9/block", Diff("`HEAD`", ())))["changed"] is False
