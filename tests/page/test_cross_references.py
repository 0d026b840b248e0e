"""Tests of references by number to equations, drawings and problems, and of their errors."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from derive.algebra.expressions import scalar
from derive.course.prose import EQUATION, FIGURE, PROBLEM, Mention
from derive.errors import Complaint, Place
from derive.page.cross_references import References, each_number_once, found_before
from derive.page.numbering import Number
from derive.page.template import templates_of
from derive.page.wording import FigureRef, Inline, Math, Phrases, ProblemRef, Ref, Text, phrases
from tests.courses import ROOT

HERE = Place("problems/hw9/block.yaml", 7, 3, "<<eq torque>>")


@pytest.fixture(scope="module")
def words() -> Phrases:
    return phrases(templates_of(ROOT))


@pytest.fixture
def faults() -> list[Complaint]:
    return []


@pytest.fixture
def references(words: Phrases, faults: list[Complaint]) -> References:
    return References("hw9", {"top": 3}, {"axes": 2}, {}, words, faults)


def mention(of: str, name: str) -> Mention:
    return Mention(name, HERE, of)


def test_each_sort_of_reference_has_its_number(references: References, faults: list[Complaint]) -> None:
    assert references.node(mention(PROBLEM, "top")) == ProblemRef("hw9/top", "Problem 3")
    assert references.node(mention(FIGURE, "axes")) == FigureRef("Figure\u00a02", "axes", 2)
    assert references.node(mention(EQUATION, "torque")) == Ref("torque")
    references.check({"torque": 4}, ["torque"])
    assert faults == []


@pytest.mark.parametrize(
    ("of", "name", "code", "help_line"),
    [
        (PROBLEM, "tpo", "no-such-problem", "did you mean `top`?"),
        (PROBLEM, "zebra", "no-such-problem", "use the name of a problem that `set.yaml` lists"),
        (FIGURE, "axis", "undefined-name", "did you mean `axes`?"),
        (FIGURE, "zebra", "undefined-name", "use the name of a drawing, and write its `caption:` under `drawings:`"),
    ],
)
def test_what_has_no_number_is_told_with_what_was_meant(
    references: References, faults: list[Complaint], of: str, name: str, code: str, help_line: str
) -> None:
    assert references.node(mention(of, name)) is None
    assert [(fault.code, fault.place, fault.help) for fault in faults] == [(code, HERE, help_line)]


def test_an_equation_is_looked_for_once_all_numbers_are_known(references: References, faults: list[Complaint]) -> None:
    for name in ("torque", "hidden", "torqe"):
        references.node(mention(EQUATION, name))
    assert faults == []
    references.check({"torque": 1}, ["torque", "hidden"])
    assert [fault.code for fault in faults] == ["not-shown", "undefined-name"]
    assert faults[0].help == "change `hidden: hidden` under `show`, or write `<<hidden>>`"
    assert faults[1].help == "did you mean `torque`?"


def test_a_name_that_stands_for_an_equation_needs_its_number_too(
    references: References, faults: list[Complaint]
) -> None:
    references.note(["by ", mention("", "law"), mention("", "mass")], {"law": Ref("law"), "mass": Math(scalar("M"))})
    references.check({}, [])
    assert [fault.message for fault in faults] == ["no step on this page is called `law`"]


def test_a_title_refers_to_nothing_that_has_a_number(references: References, faults: list[Complaint]) -> None:
    references.check_title([mention("", "mass")], {"mass": Math(scalar("M"))})
    assert faults == []
    references.check_title([mention(PROBLEM, "top"), mention("", "law")], {"law": Ref("law")})
    assert [fault.code for fault in faults] == ["mention", "mention"]


def test_what_earlier_parts_have_found_is_told_part_by_part(words: Phrases) -> None:
    def step(key: str) -> Any:
        return SimpleNamespace(key=key, symbol=scalar(key))

    shown_in = {"T": "a", "L": "b", "U": "a"}
    sentences = found_before([step("T"), step("L"), step("U")], shown_in, words)
    names = [[node.expr.name for node in nodes if isinstance(node, Math)] for nodes in sentences]
    assert names == [["T", "U"], ["L"]]
    assert [node.key for node in sentences[1] if isinstance(node, Ref)] == ["L"]


@pytest.mark.parametrize(
    ("said", "once"),
    [
        (["from ", "x", " and ", "y"], ["from ", "x"]),
        (["from ", "w", ", ", "x", " and ", "y"], ["from ", "w", " and ", "x"]),
        (["x", ", ", "y", " and ", "z", "."], ["x", " and ", "z", "."]),
        (["x", " follows from ", "y"], ["x", " follows from ", "y"]),
        (["w", " and ", "z"], ["w", " and ", "z"]),
    ],
)
def test_equations_that_share_a_number_are_named_once(said: list[str], once: list[str]) -> None:
    numbers = {"w": Number(4), "x": Number(5), "y": Number(5), "z": Number(6)}

    def nodes(words: list[str]) -> tuple[Inline, ...]:
        return tuple(Ref(word) if word in numbers else Text(word) for word in words)

    assert each_number_once(nodes(said), numbers) == nodes(once)
