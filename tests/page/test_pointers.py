"""Tests of sentences that point to earlier lines in place of repeating their results."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from sympy import ImmutableDenseMatrix, Integer

from derive.building.derivations import Solved
from derive.course.problem import Problem
from derive.page.document import document_of
from derive.page.pointers import pointed_out, that_have_it
from derive.page.selection import OWN, POINTED_OUT, Selection
from derive.page.template import templates_of
from derive.page.tree import Display, Document, Paragraph
from derive.page.wording import Chain, Math, Ref, Text, phrases
from derive.steps.step import Form, Level
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(templates_of(ROOT))
Known = tuple[Problem, Solved]


def solved(folder: Path, problem: str) -> Known:
    return solved_once(course_in(folder, problem=problem), f"hw9/{problem}")


@pytest.fixture(scope="module")
def top(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return solved(tmp_path_factory.mktemp("top"), "top")


@pytest.fixture(scope="module")
def cone(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return solved(tmp_path_factory.mktemp("cone"), "cone")


def page(known: Known, level: Level) -> Document:
    problem, found = known
    document, faults = document_of(problem, found.derivation, found.values, WORDS, level)
    assert faults == []
    return document


def displayed(document: Document) -> dict[str, int]:
    blocks = [block for part in document.parts for block in part.blocks if isinstance(block, Display)]
    return {group.key: group.framed for block in blocks for group in block.groups}


def nodes(document: Document) -> list[object]:
    paragraphs = [block for part in document.parts for block in part.blocks if isinstance(block, Paragraph)]
    return [node for block in paragraphs for node in block.nodes]


def test_a_root_is_in_the_lines_of_both_roots(top: Known) -> None:
    derivation = top[1].derivation
    for key, sign in (("slow_precession", "lower"), ("fast_precession", "upper")):
        step = derivation.step(key)
        assert dict(step.words)["sign"] == sign
        (having_it,) = that_have_it(step, derivation)
        assert having_it.key == "precession_rates"
        said = pointed_out((Text("It is "), Chain()), step, (having_it,), WORDS)
        assert [node for node in said if isinstance(node, Ref)] == [Ref("precession_rates")]
        assert any(isinstance(node, Text) and sign in node.text for node in said)
        assert not any(isinstance(node, Chain) for node in said)


def test_principal_moments_are_in_the_lines_of_the_entries(cone: Known) -> None:
    derivation = cone[1].derivation
    step = derivation.step("principal_moments")
    having_it = that_have_it(step, derivation)
    assert [each.symbol.name for each in having_it] == ["I_xx", "I_zz"]
    said = pointed_out((Chain(),), step, having_it, WORDS)
    names = [node.expr.right.name for node in said if isinstance(node, Math)]
    assert names == ["I_xx", "I_zz"], "each value once, by the letter of its line"
    assert said[-1] == Text(".")


def test_where_a_value_has_no_line_nothing_is_pointed_to(cone: Known) -> None:
    derivation = cone[1].derivation
    step = derivation.step("principal_moments")
    others = Form(ImmutableDenseMatrix([1, 2, Integer(3)]), "result")
    changed = replace(step, chain=(*step.chain[:-1], others))
    assert that_have_it(changed, derivation) == ()


def test_the_rule_says_which_lines_may_have_its_result(cone: Known) -> None:
    derivation = cone[1].derivation
    step = derivation.step("principal_moments")
    assert that_have_it(replace(step, display=replace(step.display, result_in=())), derivation) == ()


@pytest.mark.parametrize("level", [Level.BRIEF, Level.STANDARD])
def test_the_lines_that_are_pointed_to_have_the_frame_of_the_answer(cone: Known, level: Level) -> None:
    framed = displayed(page(cone, level))
    assert "principal_moments" not in framed
    assert framed["inertia_tensor_xx"] == framed["inertia_tensor_zz"] == 1
    assert {"I_1", "I_3"} <= {
        str(s) for node in nodes(page(cone, level)) if isinstance(node, Math) for s in node.expr.atoms()
    }


def test_at_full_each_result_has_lines_of_its_own(cone: Known, top: Known) -> None:
    framed = displayed(page(cone, Level.FULL))
    assert framed["principal_moments"] and not framed["inertia_tensor_xx"]
    assert {"slow_precession", "fast_precession"} <= displayed(page(top, Level.FULL)).keys()


def test_an_answer_of_another_part_is_pointed_out_only_beside_its_number(top: Known) -> None:
    problem, found = top
    asked = {"slow_precession"}
    with_number = Selection(found.derivation, Level.STANDARD, asked, {}, values=found.values)
    assert with_number.manner("slow_precession") is POINTED_OUT
    assert Selection(found.derivation, Level.STANDARD, asked, {}).manner("slow_precession") is OWN
    shown = Selection(found.derivation, Level.STANDARD, asked, {"slow_precession": "result"}, values=found.values)
    assert shown.manner("slow_precession") is OWN
    assert problem.show.get("slow_precession") is None
