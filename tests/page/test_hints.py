"""Hints show the results to find, the laws and the next lines, but no answers."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from sympy import Basic, MatrixBase

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation
from derive.building.derivations import Solved
from derive.course.problem import Problem
from derive.page.chain_lines import ChainLine, Equations
from derive.page.document import document_of
from derive.page.hints import TO_BE_DONE, with_hints
from derive.page.introduced_symbols import expressions_in, letters_in, letters_of, wanting
from derive.page.template import templates_of
from derive.page.tree import Display, Document, Folded, Paragraph
from derive.page.wording import Math, Text, phrases
from derive.steps.level import Level
from derive.steps.step import Step
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(templates_of(ROOT))
PINNED = tuple(f"hw9/{name}" for name in ("euler", "block", "top", "cone", "slab"))
BEGUN = ("new/body", "new/rotation", "new/system")
LIBRARY = tuple(f"library/{name}" for name in ("kepler", "turning_hoop", "bullet", "half_disc"))


@pytest.fixture(scope="module")
def courses(tmp_path_factory: pytest.TempPathFactory) -> Any:
    @cache
    def root(name: str) -> Path:
        folder, _, stem = name.partition("/")
        if folder == "library":
            return ROOT
        course = tmp_path_factory.mktemp(stem)
        if folder == "hw9":
            return course_in(course, problem=stem)
        (course / "templates").symlink_to(ROOT / "templates")
        (course / "problems").mkdir()
        shutil.copytree(ROOT / "templates" / "new", course / "problems" / "new")
        return course

    return root


@cache
def of(courses: Any, name: str) -> tuple[Document, Document, Problem, Solved]:
    problem, solved = solved_once(courses(name), name)
    page, _ = document_of(problem, solved.derivation, solved.values, WORDS, Level.STANDARD)
    return page, with_hints(page, problem, solved.derivation, solved.values, WORDS), problem, solved


def told(hints: Document) -> Iterator[tuple[Folded, Equations, ChainLine]]:
    for part in hints.parts:
        for rung in (block for block in part.blocks if isinstance(block, Folded)):
            for block in (each for each in rung.blocks if isinstance(each, Display)):
                yield from ((rung, group, line) for group in block.groups for line in group.lines)


def sides(value: Any) -> list[Any]:
    found = [value, value.left, value.right] if isinstance(value, Relation) else [value]
    return [each for each in found if isinstance(each, Basic | MatrixBase) and not getattr(each, "is_Atom", False)]


def sides_in(words: Paragraph) -> list[Any]:
    return [side for formula in expressions_in(words) for side in sides(formula)]


def gives_away(line: ChainLine, of: Step, result: Step, names: set[Any]) -> bool:
    """Whether a line of a step shows the result of a step, with nothing left to substitute or to evaluate."""
    whole = line.right if of.symbol is not None or line.left is None else Relation(line.left, "=", line.right)
    shown = [line.left, line.right] if isinstance(whole, Relation) else [line.right]
    still_named = letters_in(shown) & (names - letters_of(of.symbol) - letters_in([result.result]))
    if still_named or any(isinstance(side, Basic | MatrixBase) and side.has(*TO_BE_DONE) for side in shown):
        return False
    return any(equal(one, other) for one in sides(whole) for other in sides(result.result))


@pytest.mark.parametrize("name", [*PINNED, *BEGUN, *LIBRARY])
def test_no_hint_is_the_result_of_its_step_or_of_what_is_asked(courses: Any, name: str) -> None:
    _, hints, problem, solved = of(courses, name)
    steps = {step.key: step for step in (*solved.derivation.steps, *solved.values.values())}
    names = {letter for step in steps.values() for letter in letters_of(step.symbol)}
    asked = [step for part in problem.parts for step in solved.derivation.answering(part.answers)]
    lines = list(told(hints))
    for _, group, line in lines:
        own = steps[group.key]
        assert not any(gives_away(line, own, result, names) for result in (own, *asked)), (group.key, line)
    assert lines


def test_no_answer_is_told_in_words(courses: Any) -> None:
    _, hints, problem, solved = of(courses, "library/power_law")
    asked = [step.result for part in problem.parts for step in solved.derivation.answering(part.answers)]
    worded = [each for part in hints.parts for rung in part.blocks for each in rung.blocks if type(each) is Paragraph]
    assert not any(equal(said, answer) for nodes in worded for said in sides_in(nodes) for answer in asked)


@pytest.mark.parametrize("name", [*PINNED, *BEGUN, *LIBRARY])
def test_the_first_hint_is_one_sentence_and_a_number_has_no_law(courses: Any, name: str) -> None:
    _, hints, _, solved = of(courses, name)
    steps = {step.key: step for step in (*solved.derivation.steps, *solved.values.values())}
    assert not any(line.numeric or steps[group.key].rule.startswith("numeric.") for _, group, line in told(hints))
    firsts = [rung for part in hints.parts for rung in part.blocks[:1] if isinstance(rung, Folded)]
    assert firsts and all(type(block) is Paragraph for rung in firsts for block in rung.blocks[:1])
    symbols = [step.symbol for step in steps.values()]
    for rung in (rung for rung in firsts if rung.title == WORDS.labels["hints"]["first"]):
        (sentence,) = rung.blocks
        assert isinstance(sentence, Paragraph)
        sought = [node.expr for node in sentence.nodes if isinstance(node, Math)]
        assert all(each in symbols for each in sought), "it names what to find, and nothing that was found"


def test_the_words_of_the_author_for_an_answer_are_no_hint(courses: Any) -> None:
    _, hints, _, _ = of(courses, "hw9/euler")
    words = [node.text for part in hints.parts for rung in part.blocks for block in rung.blocks
             if isinstance(block, Paragraph) for node in block.nodes if isinstance(node, Text)]  # fmt: skip
    assert any(text.startswith("Find") for text in words)
    assert not any("no, unless" in text or text.startswith("In space: yes") for text in words)


@pytest.mark.parametrize("name", [*PINNED, *BEGUN, *LIBRARY])
def test_each_letter_is_introduced(courses: Any, name: str) -> None:
    _, hints, problem, solved = of(courses, name)
    steps = solved.derivation.steps
    rungs = [rung for part in hints.parts for rung in part.blocks if isinstance(rung, Folded)]
    left = [line.left for _, _, line in told(hints)]
    worded = expressions_in([block for rung in rungs for block in rung.blocks if isinstance(block, Paragraph)])
    found = letters_in([*expressions_in(left), *worded])
    found |= {letter for step in steps if (own := letters_of(step.symbol)) & found for letter in own}
    moving = letters_in([q for step in steps for q, _ in step.coordinates])
    rates = {letter for letter in letters_in(expressions_in(rungs)) if str(letter).endswith("dot")}
    assert wanting(rungs, set(), steps, {*problem.dimensions, *moving, *rates, *found}) == set()


def test_a_letter_that_only_the_law_has_is_told_without_its_value(courses: Any) -> None:
    _, hints, _, solved = of(courses, "new/body")
    density = next(step for step in solved.derivation.steps if step.rule == "bodies.density")
    worded = [each for part in hints.parts for rung in part.blocks for each in rung.blocks if type(each) is Paragraph]
    shown = list(expressions_in(worded))
    assert density.symbol in shown and density.result not in shown


@pytest.mark.parametrize("name", PINNED)
def test_the_rungs_go_from_what_is_sought_to_how_it_goes_on(courses: Any, name: str) -> None:
    _, hints, _, _ = of(courses, name)
    for part in hints.parts:
        titles = [block.title[:6] for block in part.blocks if isinstance(block, Folded)]
        assert titles == sorted(titles) and titles[:1] == ["Hint 1"]


def test_an_equation_of_motion_has_its_law(courses: Any) -> None:
    _, hints, _, solved = of(courses, "new/system")
    law = next(step.chain[0].expr for step in solved.derivation.steps if step.rule == "lagrange.equation_of_motion")
    assert any(line.left == law.left for rung, _, line in told(hints) if rung.title == WORDS.labels["hints"]["law"])


def test_an_equation_has_its_number_on_every_paper(courses: Any) -> None:
    page, hints, _, _ = of(courses, "hw9/block")
    numbers = {g.key: g.number for part in page.parts for b in part.blocks if isinstance(b, Display) for g in b.groups}
    found = [group for _, group, _ in told(hints)]
    assert found and all(numbers[group.key] == group.number for group in found)
