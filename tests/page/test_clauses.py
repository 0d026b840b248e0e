"""Steps that are told in passing: after the lines that have their letter, once, and in words that go on from these."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.page.clauses import Clauses
from derive.page.wording import Inline, Math, Text, phrases
from derive.steps.step import Step
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(ROOT / "templates")


@pytest.fixture(scope="module")
def density(tmp_path_factory: pytest.TempPathFactory) -> Step:
    _, solved = solved_once(course_in(tmp_path_factory.mktemp("block")), "hw9/block")
    return solved.derivation.step("density")


def written(nodes: tuple[Inline, ...]) -> str:
    return "".join(node.text if isinstance(node, Text) else str(getattr(node, "expr", "")) for node in nodes)


def test_it_waits_for_the_lines_that_have_its_letter_and_is_told_once(density: Step) -> None:
    clauses = Clauses(WORDS)
    clauses.waiting.append(density)
    assert clauses.behind((Math(density.result),)) == ()
    assert clauses.told == set()
    assert written(clauses.behind((Math(density.symbol),))).startswith("where rho = ")
    assert clauses.told == {density.key}
    assert clauses.behind((Math(density.symbol),)) == ()


def test_a_sentence_that_goes_on_from_the_lines_comes_first(density: Step) -> None:
    for sentence, order in (("so that it turns.", 1), ("It turns.", -1)):
        clauses = Clauses(WORDS)
        clauses.waiting.append(density)
        text = written(clauses.around((Text(sentence),), (Math(density.symbol),)))
        assert (text.index("rho") - text.index(sentence)) * order > 0
    assert written(Clauses(WORDS).around((Text("It turns."),), (Math(density.symbol),))) == "It turns."


def test_what_the_lines_say_themselves_is_not_said_again(density: Step) -> None:
    clauses = Clauses(WORDS)
    clauses.waiting.append(density)
    assert clauses.behind((Math(density.symbol), Math(density.result))) == ()
    assert clauses.told == {density.key}


def test_what_is_set_up_is_said_before_the_next_sentence_once() -> None:
    clauses = Clauses(WORDS)
    assert clauses.begun() == ()
    clauses.set_up.append(Text("Take axes."))
    assert written(clauses.begun()) == "Take axes. "
    assert clauses.begun() == ()


def test_each_clause_has_its_definition_or_points_to_one() -> None:
    for rule, outcomes in WORDS.clauses.items():
        for outcome, phrase in outcomes.items():
            assert "<<definition>>" in phrase or "<<shown>>" in phrase, (rule, outcome)
            assert outcome in WORDS.rules[rule]
    assert Path(ROOT / "templates" / "phrases").is_dir()
