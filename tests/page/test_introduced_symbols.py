"""Tests of the symbols that a piece of a page uses and introduces; tests/printed/test_levels.py tests whole pages."""

from __future__ import annotations

from pathlib import Path

from sympy import Symbol

from derive.algebra.expressions import component_names, scalar, vector
from derive.course.problem import load_problem
from derive.page.introduced_symbols import letters_in, letters_of, references_in, wanting
from derive.page.template import templates_of
from derive.page.wording import Math, Ref, Text, phrases
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(templates_of(ROOT))


def test_the_letters_of_a_step_are_its_symbol_and_the_components_of_a_vector() -> None:
    v = scalar("v")
    assert letters_of(v) == letters_of(v**2) == {v}
    assert letters_of(vector("omega")) == {vector("omega"), *component_names("omega")}
    assert letters_of(None) == letters_of(v + 1) == set()


def test_what_is_within_dm_is_not_seen(tmp_path: Path) -> None:
    _, solved = solved_once(course_in(tmp_path), "hw9/block")
    definition = next(step for step in solved.derivation.steps if step.rule == "rotation.inertia_definition")
    density = next(step for step in solved.derivation.steps if step.rule == "bodies.density")
    assert definition.chain[0].expr.has(density.symbol)
    assert density.symbol not in letters_in([definition.chain[0].expr])


def test_a_letter_that_is_used_and_not_told_wants_the_step_that_brings_it_in(tmp_path: Path) -> None:
    _, solved = solved_once(course_in(tmp_path), "hw9/block")
    steps = solved.derivation.steps
    density = next(step for step in steps if step.rule == "bodies.density")
    sentence = (Text("with "), Math(density.symbol), Ref("torque"))
    assert wanting(sentence, set(), steps, set()) == {density.key}
    assert wanting(sentence, {density.key}, steps, set()) == set()
    assert wanting(sentence, set(), steps, {density.symbol}) == set()
    assert references_in(sentence) == {"torque"}
    assert wanting((Math(Symbol("q")),), set(), steps, set()) == set()
    assert load_problem(ROOT, "hw9/block").id == "hw9/block"
