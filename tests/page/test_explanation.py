"""One line explained: why it is there, how it was checked, in what words, and where its law stands."""

from __future__ import annotations

from pathlib import Path

import pytest

import derive
from derive.building.solved import Solved, steps_key
from derive.course.problem import Problem, load_problem
from derive.page.explanation import Explanation, explanation_of, told_of
from derive.page.wording import Text, phrases
from tests.courses import ROOT, course_in, kept, rendered_once

WORDS = phrases(ROOT / "templates")
OWN = "wording: {torque: {generic: Hold it., zero: Let it.}}\nshow: {spin: result}\n"


@pytest.fixture(scope="module")
def problem(tmp_path_factory: pytest.TempPathFactory) -> Problem:
    root = course_in(tmp_path_factory.mktemp("block"), {"parts:\n": f"{OWN}parts:\n"})
    rendered_once(root, "hw9/block")
    return load_problem(root, "hw9/block")


def explained(problem: Problem, key: str) -> Explanation:
    solved = Solved.from_data(kept().recalled_data(steps_key(problem)))
    assert solved is not None
    steps = {step.key: step for step in [*solved.derivation.steps, *solved.values.values()]}
    return explanation_of(steps[key], problem, solved.derivation, solved.values, WORDS)


def said(problem: Problem, key: str) -> dict[str, str]:
    sections = told_of(explained(problem, key), WORDS)
    assert all(isinstance(node, Text) for _, lines in sections for line in lines for node in line)
    return {heading: "\n".join("".join(n.text for n in line) for line in lines) for heading, lines in sections}  # type: ignore[union-attr]


def test_a_step_is_there_for_the_nearest_answers_that_rest_on_it(problem: Problem) -> None:
    needs = [(need.part, need.answer, need.through) for need in explained(problem, "axis_vector").needed]
    assert needs[0] == ("b", "kinetic_energy_about_axis", ("spin",))
    assert ("d", "torque", ("spin",)) in needs
    assert "magnitude" not in [answer for _, answer, _ in needs]  # which rests on it through the torque
    assert explained(problem, "torque").needed[0].through == ()


def test_the_part_is_the_first_that_shows_a_step(problem: Problem) -> None:
    assert [explained(problem, key).part for key in ("density", "spin", "torque")] == ["a", "b", "d"]


def test_how_it_was_checked_is_told_by_grade_and_route(problem: Problem) -> None:
    torque = explained(problem, "torque")
    assert torque.lines == {"proved": len(torque.step.chain) - 1}
    assert torque.routes == (("the angular momentum carried round the axis and differentiated", "proved"),)
    assert said(problem, "axis_vector")["checked"] == "Grade: by definition."


def test_the_stock_sentence_is_where_it_is_said_to_be(problem: Problem) -> None:
    path, _, line = explained(problem, "torque").sentence_at.partition(":")
    assert (ROOT / path).read_text().splitlines()[int(line) - 1].strip().startswith("generic:")


def test_the_law_is_where_it_is_said_to_be(problem: Problem) -> None:
    path, _, line = explained(problem, "torque").step.law_at.partition(":")
    lines = (Path(derive.__file__).parents[1] / path).read_text().splitlines()
    assert "establish(" in lines[int(line) - 1]


def test_the_words_of_the_problem_are_told_with_their_place(problem: Problem) -> None:
    place = explained(problem, "torque").own_words
    assert place is not None
    assert "Hold it." in place.text
    assert f"{place.path}:{place.line}" in said(problem, "torque")["words"]
    assert "instead" not in said(problem, "spin")["words"]


def test_what_replaces_the_words_is_told_with_the_names_that_they_may_have(problem: Problem) -> None:
    words = said(problem, "torque")["words"]
    assert "`wording: {torque: {generic: ...}}`" in words
    assert "<<momentum>>" in words
    assert "<<point>>" not in words  # by which a phrase only chooses


def test_show_says_what_the_problem_says(problem: Problem) -> None:
    assert said(problem, "spin")["shown"].startswith("`show:` says result")
    assert "--detail" in said(problem, "torque")["shown"]


def test_the_number_of_an_answer_has_no_words_of_the_problem(problem: Problem) -> None:
    told = said(problem, "angle_between_value")
    assert told["why"].startswith("Part (c) asks for it.")
    assert "shown" not in told
    assert "wording:" not in told["words"]


def test_the_facts_are_those_of_the_text(problem: Problem) -> None:
    facts = explained(problem, "torque").facts()
    assert (facts["key"], facts["part"], facts["grade"], facts["inputs"]) == (
        "torque",
        "d",
        "proved",
        ["spin", "angular_momentum"],
    )
    assert facts["wording_at"].startswith("problems/hw9/block.yaml:")
