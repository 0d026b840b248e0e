"""Tests of the steps and lines that a level of detail shows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from derive.building.derivations import Solved
from derive.course.problem import Problem, load_problem
from derive.page.document import document_of
from derive.page.introduced_symbols import expressions_in, letters_in
from derive.page.selection import (
    LEFT_OUT,
    NOTHING_NEEDED,
    OWN,
    TAKEN_IN,
    TOLD,
    Selection,
)
from derive.page.template import templates_of
from derive.page.tree import Display, Document, Paragraph
from derive.page.wording import Text, phrases
from derive.steps.rule import RULES
from derive.steps.step import Level
from tests.courses import ROOT, course_in, rendered_once, solved_once
from tests.rules import records

WORDS = phrases(templates_of(ROOT))
Known = tuple[Problem, Solved]


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return solved_once(course_in(tmp_path_factory.mktemp("block")), "hw9/block")


@pytest.fixture(scope="module")
def slab(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return solved_once(course_in(tmp_path_factory.mktemp("slab"), problem="slab"), "hw9/slab")


@pytest.fixture(scope="module")
def cone(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return solved_once(course_in(tmp_path_factory.mktemp("cone"), problem="cone"), "hw9/cone")


def selection(known: Known, level: Level, **changed: object) -> Selection:
    problem, solved = known
    asked = {step.key for part in problem.parts for step in solved.derivation.answering(part.answers)}
    facts: dict[str, object] = {"asked": asked, "shown": {}, **changed}
    return Selection(solved.derivation, level, **facts)  # type: ignore[arg-type]


def page(known: Known, level: Level, **changed: object) -> Document:
    problem, solved = known
    problem = replace(problem, **changed)  # type: ignore[arg-type]
    document, faults = document_of(problem, solved.derivation, solved.values, WORDS, level, drawings=solved.drawings)
    assert faults == []
    return document


def lines(document: Document) -> dict[str, int]:
    displays = [block for part in document.parts for block in part.blocks if isinstance(block, Display)]
    return {group.key: len(group.lines) for display in displays for group in display.groups}


def said(document: Document) -> str:
    paragraphs = [block for part in document.parts for block in part.blocks if isinstance(block, Paragraph)]
    return " ".join(node.text for block in paragraphs for node in block.nodes if isinstance(node, Text))


def test_the_exceptions_are_for_outcomes_that_the_rule_has() -> None:
    for *_, rule in records():
        assert set(rule.shown.outcomes) <= set(rule.outcomes), rule.name


def test_each_sum_shows_by_which_identity_its_terms_cancel(tmp_path: Path) -> None:
    known = solved_once(course_in(tmp_path, problem="euler"), "hw9/euler")
    shown = lines(page(known, Level.STANDARD))
    assert shown["kinetic_energy_sum"] == shown["squared_momentum_sum"] == 2


def test_a_result_may_be_in_the_lines_of_rules_that_exist() -> None:
    for *_, rule in records():
        assert set(rule.shown.result_in) <= set(rule.outcomes), rule.name
        assert {each for rules in rule.shown.result_in.values() for each in rules} <= RULES.keys(), rule.name


def test_a_lower_level_leaves_out_no_less() -> None:
    order = (OWN, TOLD, TAKEN_IN, LEFT_OUT)
    for *_, rule in records():
        for brief, standard in ((rule.shown.brief, rule.shown.standard), *rule.shown.outcomes.values()):
            assert order.index(brief) >= order.index(standard), rule.name


def test_at_full_every_step_stands_on_its_own_with_every_line(block: Known) -> None:
    chosen = selection(block, Level.FULL)
    for step in block[1].derivation.steps:
        assert chosen.manner(step.key) is OWN
        assert chosen.step(step) == step


def test_the_density_is_told_behind_the_first_lines_that_have_its_letter(block: Known) -> None:
    document = page(block, Level.STANDARD)
    assert "density" not in document.numbers
    assert "where " in said(document)
    density = block[1].derivation.step("density")
    blocks = list(document.parts[0].blocks)
    first = next(i for i, each in enumerate(blocks) if isinstance(each, Display) and _has(each, density.symbol))
    assert density.result in set(expressions_in(blocks[first + 1]))


def _has(display: Display, letter: object) -> bool:
    return letter in letters_in(expressions_in(display))


def test_a_volume_is_taken_in_by_the_density_that_alone_uses_it(cone: Known) -> None:
    chosen = selection(cone, Level.STANDARD)
    volume, density = (cone[1].derivation.step(key) for key in ("volume", "density"))
    assert chosen.manner("volume") is TAKEN_IN
    assert not any(form.expr.has(volume.symbol) for form in chosen.step(density).chain)


def test_of_entries_of_one_form_the_first_is_worked_out(block: Known) -> None:
    standard, full = (lines(page(block, level)) for level in (Level.STANDARD, Level.FULL))
    moments = [f"corner_tensor_{entry}" for entry in ("xx", "yy", "zz")]
    assert standard[moments[0]] > standard[moments[1]] == standard[moments[2]] == 2
    assert full[moments[0]] == full[moments[1]] == full[moments[2]]


def test_a_tensor_of_entries_that_were_listed_stands_only_where_it_is_asked_for(block: Known) -> None:
    document = page(block, Level.STANDARD)
    assert "corner_tensor" not in document.numbers
    assert "inertia_tensor" in document.numbers


def test_show_and_wording_and_the_number_of_an_equation_bring_a_step_back(block: Known, tmp_path: Path) -> None:
    for i, added in enumerate(("show: {density: full}", "wording: {density: It weighs}", "note: By <<eq density>>.")):
        folder = course_in(tmp_path / str(i), {"parts:\n": f"{added}\nparts:\n"})
        other = load_problem(folder, "hw9/block"), block[1]
        assert "density" in page(other, Level.BRIEF).numbers, added
    assert "density" not in page(block, Level.BRIEF, show={"density": "hidden"}).numbers


def test_a_letter_that_a_sentence_needs_brings_its_step_back(block: Known, tmp_path: Path) -> None:
    folder = course_in(tmp_path, {"parts:\n": "note: About <<corner_tensor>>.\nparts:\n"})
    problem = load_problem(folder, "hw9/block")
    assert "corner_tensor" not in page(block, Level.BRIEF).numbers
    shown = page((problem, block[1]), Level.BRIEF)
    assert "corner_tensor" in shown.numbers or "corner_tensor_definition" in shown.numbers


def test_what_is_needed_after_all_is_first_told_and_then_stands_on_its_own(cone: Known) -> None:
    needed, manners = NOTHING_NEEDED, []
    for _ in range(3):
        manners.append(selection(cone, Level.STANDARD, needed=needed).manner("volume"))
        needed = needed.with_more(["volume"], [])
    assert manners == [TAKEN_IN, TOLD, OWN]
    numbered = NOTHING_NEEDED.with_more([], ["volume"])
    assert selection(cone, Level.STANDARD, needed=numbered).manner("volume") is OWN


def test_a_condition_is_the_relation_and_its_solution(slab: Known) -> None:
    counts = [lines(page(slab, level))["stable_by_frequency"] for level in Level] if _has_key(slab) else [1, 2, 3]
    assert counts == sorted(set(counts))


def _has_key(slab: Known) -> bool:
    return any(step.key == "stable_by_frequency" for step in slab[1].derivation.steps)


def test_lines_that_a_level_writes_anew_are_counted_and_those_of_full_are_as_they_were(tmp_path: Path) -> None:
    root = course_in(tmp_path, problem="slab")
    lines = {
        detail: rendered_once(root, "hw9/slab", detail=detail, only={"json"}).counts["lines"]
        for detail in ("full", "standard")
    }
    assert lines["standard"] > lines["full"]
