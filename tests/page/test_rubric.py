"""Tests of rubrics: the points of the steps of a part add up to the points of the part."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.building.solution import rendered
from derive.errors import Rejected
from derive.page.chain_lines import ChainLine, Equations
from derive.page.numbering import Number
from derive.page.rubric import ANSWER, NUMBER, STEP, Credit, Weighed, _shared, _weighed
from derive.page.template import templates_of
from derive.page.tree import Display, PartPage
from derive.page.wording import phrases
from tests.courses import ROOT, course_in, rendered_once
from tests.rules import records

HALF = Fraction(1, 2)


def groups(framed: list[bool], numbers: int = 0) -> list[Weighed]:
    weights = [ANSWER if answer else STEP for answer in framed] + [NUMBER] * numbers
    line = ChainLine("T", "equals", 1)
    return [Weighed(Equations(f"step_{i}", (line,), Number(i + 1)), weight) for i, weight in enumerate(weights)]


@given(st.integers(1, 60), st.lists(st.booleans(), min_size=1, max_size=10), st.integers(0, 4))
def test_a_number_is_worth_half_a_point_at_most_and_no_more_than_a_step(
    halves: int, framed: list[bool], n: int
) -> None:
    shares = _shared(halves * HALF, groups(framed, n))
    assert sum(shares.values()) == halves * HALF
    numbers = [shares.get(f"step_{len(framed) + i}", Fraction(0)) for i in range(n)]
    answers = [shares.get(f"step_{i}", Fraction(0)) for i, answer in enumerate(framed) if answer]
    assert all(share in (0, HALF) for share in numbers)
    assert not any(numbers) or all(share >= HALF for share in answers)


def test_the_formula_of_a_number_is_the_answer_and_a_number_alone_is_one() -> None:
    line = ChainLine("T", "equals", 1)
    keys = {"mass": 0, "speed": 0, "speed_value": 1, "other_value": 1}
    equations = tuple(Equations(key, (line,), Number(i), framed) for i, (key, framed) in enumerate(keys.items(), 1))
    part = PartPage("a", (), Fraction(3), (Display(equations),))
    weighed = _weighed(part, {"speed_value": ("speed",), "other_value": ("elsewhere",)})
    assert [each.weight for each in weighed] == [STEP, ANSWER, NUMBER, ANSWER]


@given(st.integers(1, 60), st.lists(st.booleans(), min_size=1, max_size=30))
def test_points_that_are_shared_add_up_and_none_is_negative(halves: int, framed: list[bool]) -> None:
    points = halves * HALF
    shares = _shared(points, groups(framed))
    assert sum(shares.values()) == points
    assert all(share > 0 for share in shares.values())


@given(st.integers(2, 60), st.lists(st.booleans(), min_size=2, max_size=10))
def test_an_answer_is_worth_no_less_than_a_step(halves: int, framed: list[bool]) -> None:
    shares = _shared(halves * HALF, groups(framed))
    answers = [shares.get(f"step_{i}", 0) for i, answer in enumerate(framed) if answer]
    steps = [shares.get(f"step_{i}", 0) for i, answer in enumerate(framed[:-1]) if not answer]
    assert not answers or not steps or min(answers) + HALF >= max(steps)


def test_points_are_halves_where_there_are_enough() -> None:
    assert set(_shared(Fraction(5), groups([False] * 3 + [True])).values()) <= {HALF * n for n in range(1, 10)}


def test_a_row_has_every_value_of_its_step_each_with_its_left_side() -> None:
    lines = (
        ChainLine("x_dot", "equals", 1),
        ChainLine("y_dot", "equals", 2, beside=True, because="law"),
        ChainLine(None, "equals", 3, because="result"),
    )
    found = Credit(Equations("rates", lines, Number(1)), HALF, "solves for the rates").results
    assert [(line.left, line.right) for line in found] == [("x_dot", 1), ("y_dot", 3)]


def test_each_rule_has_words_for_a_rubric_and_no_words_are_left_over() -> None:
    own = {rule.name for *_, rule in records() if not rule.name.startswith("observations.")}  # they have no points
    assert set(phrases(templates_of(ROOT)).tasks) == own


def rubric(tmp_path: Path, said: str) -> str:
    root = course_in(tmp_path, {"    answer: inertia_tensor\n    points: 3\n": f"    answer: inertia_tensor\n{said}"})
    return rendered(root, "hw9/block", documents=("rubric",)).documents["rubric"]


def test_what_an_instructor_says_stands_and_the_rest_is_shared(tmp_path: Path) -> None:
    said = rubric(tmp_path, "    points: 3\n    rubric: {inertia_tensor: 2.5}\n")
    shown = said[said.index("part a") : said.index("part b")]
    points = [
        Fraction(line.rpartition("{")[2].rstrip("}")) for line in shown.splitlines() if line.startswith("\\credit")
    ]
    assert sum(points) == 3 and Fraction("2.5") in points


@pytest.mark.parametrize(
    ("said", "complaint"),
    [
        ("    points: 3\n    rubric: {inertia_tenser: 1}\n", "did you mean `inertia_tensor`"),
        ("    points: 3\n    rubric: {inertia_tensor: 5}\n", "has 3"),
        ("    rubric: {inertia_tensor: 9}\n", "has no points"),
        ("    points: 3\n    rubric: {inertia_tensor: much}\n", "a number from 0 to 9999.5 in steps of 0.5"),
    ],
)
def test_a_rubric_that_does_not_fit_its_part_is_refused(tmp_path: Path, said: str, complaint: str) -> None:
    with pytest.raises(Rejected, match=complaint):
        rubric(tmp_path, said)


def test_a_key_says_what_the_steps_are_worth(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    rendered_once(root, "hw9/block")
    key = rendered(root, "hw9/block", documents=("key",)).documents
    lines = [line for line in key["key"].splitlines() if "Points:" in line]
    assert lines and all(line.endswith(r"\par\nobreak") for line in lines)  # no page ends after the points
    assert "Points:" in key["key.html"]
