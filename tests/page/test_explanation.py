"""Tests of the explanation of a step: why it is needed, how it was checked, and the code of its law."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import derive
from derive.algebra.equality import Compared, Evidence, Grade
from derive.building.derivations import Solved
from derive.course.problem import Problem
from derive.page.explanation import Explanation, explanation_of, told_of
from derive.page.template import templates_of
from derive.page.wording import Text, phrases
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(templates_of(ROOT))
OWN = "wording: {torque: {generic: Hold it., zero: Let it.}}\nshow: {spin: result}\n"


Block = tuple[Problem, Solved]


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Block:
    return solved_once(course_in(tmp_path_factory.mktemp("block"), {"parts:\n": f"{OWN}parts:\n"}), "hw9/block")


def explained(block: Block, key: str) -> Explanation:
    problem, solved = block
    steps = {step.key: step for step in [*solved.derivation.steps, *solved.values.values()]}
    return explanation_of(steps[key], problem, solved.derivation, solved.values, WORDS)


def said(block: Block, key: str) -> dict[str, str]:
    sections = told_of(explained(block, key), WORDS)
    assert all(isinstance(node, Text) for _, lines in sections for line in lines for node in line)
    return {heading: "\n".join("".join(n.text for n in line) for line in lines) for heading, lines in sections}  # type: ignore[union-attr]


def test_a_step_is_there_for_the_nearest_answers_that_rest_on_it(block: Block) -> None:
    needs = [(need.part, need.answer, need.through) for need in explained(block, "axis_vector").needed]
    assert needs[0] == ("b", "kinetic_energy_about_axis", ("spin",))
    assert ("d", "torque", ("spin",)) in needs
    assert "magnitude" not in [answer for _, answer, _ in needs]  # the magnitude depends on the step through the torque
    assert explained(block, "torque").needed[0].through == ()


def test_the_part_is_the_first_that_shows_a_step(block: Block) -> None:
    assert [explained(block, key).part for key in ("density", "spin", "torque")] == ["a", "b", "d"]


def test_how_it_was_checked_is_told_by_grade_and_route(block: Block) -> None:
    torque = explained(block, "torque")
    assert torque.lines == {"proved": len(torque.step.chain) - 1}
    assert torque.routes == (("the rotating angular momentum differentiated in the inertial frame", "proved"),)
    assert said(block, "axis_vector")["checked"] == "Grade: by definition."


def test_the_stock_sentence_is_where_it_is_said_to_be(block: Block) -> None:
    path, _, line = explained(block, "torque").sentence_at.partition(":")
    assert (ROOT / path).read_text().splitlines()[int(line) - 1].strip().startswith("generic:")


def test_the_law_is_where_it_is_said_to_be(block: Block) -> None:
    path, _, line = explained(block, "torque").step.law_at.partition(":")
    lines = (Path(derive.__file__).parents[1] / path).read_text().splitlines()
    assert "establish(" in lines[int(line) - 1]


def test_the_words_of_the_problem_are_told_with_their_place(block: Block) -> None:
    place = explained(block, "torque").own_words
    assert place is not None
    assert "Hold it." in place.text
    assert f"{place.path}:{place.line}" in said(block, "torque")["words"]
    assert "instead" not in said(block, "spin")["words"]


def test_what_replaces_the_words_is_told_with_the_names_that_they_may_have(block: Block) -> None:
    words = said(block, "torque")["words"]
    assert "`wording: {torque: {generic: ...}}`" in words
    assert "<<momentum>>" in words
    assert "<<point>>" not in words  # phrases only test this name


def test_show_says_what_the_problem_says(block: Block) -> None:
    assert said(block, "spin")["shown"].startswith("`show:` says result")
    assert "--detail" in said(block, "torque")["shown"]


def test_the_number_of_an_answer_has_no_words_of_the_problem(block: Block) -> None:
    told = said(block, "angle_between_value")
    assert told["why"].startswith("Part (c) asks for it.")
    assert "shown" not in told
    assert "wording:" not in told["words"]


def test_a_motion_that_was_followed_is_told_with_its_grade(block: Block) -> None:
    problem, solved = block
    torque = next(step for step in solved.derivation.steps if step.key == "torque")
    motion = Evidence("motion", Compared.WITNESS, Grade.SAMPLED, "12 states")
    step = replace(torque, evidence=(*torque.evidence, motion))
    found = explanation_of(step, problem, solved.derivation, solved.values, WORDS)
    assert found.facts()["witnesses"] == [{"detail": "12 states", "grade": "sampled"}]
    (checked,) = (lines for heading, lines in told_of(found, WORDS) if heading == "checked")
    assert "followed numerically" in "".join(node.text for node in checked[-1] if isinstance(node, Text))
    assert explained(block, "torque").facts()["witnesses"] == []


def test_the_facts_are_those_of_the_text(block: Block) -> None:
    facts = explained(block, "torque").facts()
    assert (facts["key"], facts["part"], facts["grade"], facts["inputs"]) == (
        "torque",
        "d",
        "proved",
        ["spin", "angular_momentum", *(f"inertia_tensor_{axis * 2}" for axis in "xyz"), "inertia_tensor"],
    )
    assert facts["wording_at"].startswith("problems/hw9/block.yaml:")
