"""An answer that could have a number has one or a word why not, and the text mentions the numbers."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.errors import Complaint, Rejected
from tests.courses import ROOT

SCRIPT = '''"""Lengths and times that are only named."""

from sympy import pi, sqrt

from derive.given import Acceleration, Length, Mass
from derive.mechanics import let


def solve(length: Length, radius: Length, mass: Mass, gravity: Acceleration):
    return (
        let("period", lambda: 2 * pi * sqrt(length / gravity), symbol="T_0", kind="time"),
        let("chord", lambda: sqrt(4 * radius**2 - length**2), symbol="c", kind="length"),
        let("weight", lambda: mass * gravity, symbol="W", kind="force"),
        let("share", lambda: length / (5 * length), symbol="s"),
    )
'''
PROBLEM = """title: A pendulum
solve: pendulum.py
symbols: {l: length, R: length, m: mass, g: acceleration}
given: {length: l, radius: R, mass: m, gravity: g}
"""
TOLD = "A thread <<length>>, a ring <<radius>>, <<mass>> and <<gravity>>."


def warnings_of(folder: Path, values: str, parts: str, statement: str = TOLD, given: str = "") -> list[Complaint]:
    problems = folder / "problems" / "set"
    problems.mkdir(parents=True)
    (folder / "templates").symlink_to(ROOT / "templates")
    (problems / "pendulum.py").write_text(SCRIPT, encoding="utf-8")
    text = PROBLEM.replace("gravity: g", f"gravity: {given or 'g'}")
    text += f"values: {{{values}}}\nstatement: {statement}\nparts:\n{parts}"
    (problems / "pendulum.yaml").write_text(text, encoding="utf-8")
    found = rendered(folder, "set/pendulum", only=["text"]).warnings
    return [warning for warning in found if warning.code != "not-shown"]  # what the script has for other tests


def part(answers: str, form: str = "") -> str:
    return f"  - ask: What is it?\n    answer: {answers}\n" + (f"    form: {form}\n" if form else "")


ALL = part("[period, chord, weight, share]")


def told(found: list[Complaint]) -> list[tuple[str, str, str]]:
    at = [c.place.text[c.place.column - 1 :].partition(",")[0].strip("} \n") if c.place else "" for c in found]
    return [(c.code, c.message, place) for c, place in zip(found, at, strict=True)]


@pytest.mark.parametrize("values", ["", "l: 1 m, R: 2 m, m: 1 kg, g: 9.8 m/s^2"])
def test_numbers_for_all_letters_or_for_none_are_as_they_should_be(values: str, tmp_path: Path) -> None:
    assert warnings_of(tmp_path, values, ALL) == []


def test_answers_that_lack_the_same_number_are_told_together(tmp_path: Path) -> None:
    found = warnings_of(tmp_path, "l: 1 m, R: 2 m, m: 1 kg", part("[period, weight, share]"))
    said = "`period` and `weight` have no number: `g` has no value"
    assert told(found) == [("number-missing", said, "1 m")]
    assert found[0].severity == "warning"


def test_a_number_that_another_answer_needs_may_be_all_that_there_is(tmp_path: Path) -> None:
    assert warnings_of(tmp_path, "l: 1 m, g: 9.8 m/s^2", part("[period, weight]")) == []


def test_what_is_not_real_has_no_number_and_a_word_why(tmp_path: Path) -> None:
    found = warnings_of(tmp_path, "l: 5 m, R: 2 m, m: 1 kg, g: 9.8 m/s^2", ALL)
    said = "`chord` has no number: with these values `4*R**2 - l**2` is negative"
    assert told(found) == [("number-missing", said, "5 m")]


@pytest.mark.parametrize(
    ("values", "parts", "said"),
    [
        ("l: 1 m", part("period", "{unit: ms}"), [("`period` has no number: `g` has no value", "ms")]),
        ("l: 1 m", part("period", "{figures: 2}"), [("`period` has no number: `g` has no value", "figures: 2")]),
        ("R: 1 m", part("period", "{unit: ms}"), [("`period` has no number: `g` and `l` have no value", "ms")]),
        (
            "l: 5 m, R: 2 m",
            part("[share, chord]", "{chord: {unit: cm}}"),
            [("`chord` has no number: with these values `4*R**2 - l**2` is negative", "cm")],
        ),
        (
            "l: 1 m, m: 1 kg",
            part("[period, weight]", "{figures: 2}"),
            [
                ("`period` has no number: `g` has no value", "figures: 2"),
                ("`weight` has no number: `g` has no value", "figures: 2"),
            ],
        ),
    ],
)
def test_a_form_that_asks_for_a_number_gets_one_or_is_refused(
    values: str, parts: str, said: list[tuple[str, str]], tmp_path: Path
) -> None:
    with pytest.raises(Rejected) as caught:
        warnings_of(tmp_path, values, parts)
    assert [(message, at) for _, message, at in told(list(caught.value.complaints))] == said
    assert {c.severity for c in caught.value.complaints} == {"error"}


@pytest.mark.parametrize(
    ("values", "parts", "said"),
    [
        ("", part("period", "{unit: ms, figures: 2}"), []),  # it waits for numbers
        ("l: 5 m, R: 20 m", part("[period, chord]", "{figures: 2}"), []),  # it is for the one that has a number
        (
            "m: 1 kg",
            part("[period, weight]", "{period: {figures: 2}}"),  # nothing in it has a number
            ["`weight` has no number: `g` has no value"],
        ),
    ],
)
def test_a_form_may_wait_for_numbers(values: str, parts: str, said: list[str], tmp_path: Path) -> None:
    assert [c.message for c in warnings_of(tmp_path, values, parts)] == said


def test_a_number_that_no_text_mentions_needs_no_warning_since_the_page_adds_it(tmp_path: Path) -> None:
    assert warnings_of(tmp_path, "l: 1 m, m: 1 kg, g: 9.8 m/s^2", part("period"), "A thread <<length>>.") == []
