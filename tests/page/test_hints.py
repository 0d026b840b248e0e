"""Hints: what to compute, its law, what is known; and never the answer."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.algebra.expressions import BLANK, Relation
from derive.page.document import document_of
from derive.page.hints import with_hints
from derive.page.tree import Display, Document, Folded
from derive.page.wording import phrases
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain
from derive.render.printing.text_page import page_text
from derive.steps.level import Level
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(ROOT / "templates")
PROBLEMS = ("euler", "block", "top", "cone", "slab")


def of(tmp_path: Path, name: str) -> tuple[Document, Document, list[str]]:
    """A page, its hints, and the answers of its parts as they would be printed."""
    problem, solved = solved_once(course_in(tmp_path, problem=name), f"hw9/{name}")
    page, _ = document_of(problem, solved.derivation, solved.values, WORDS, Level.STANDARD)
    answered = [step for part in problem.parts for step in solved.derivation.answering(part.answers)]
    notation = Notation(page.dimensions)
    shown = [(plain(notation.result(step.result)), isinstance(step.result, Relation)) for step in answered]
    printed = [text if is_relation else f"= {text}" for text, is_relation in shown]
    return page, with_hints(page, answered, WORDS), [text for text in printed if len(text) > 6]


@pytest.mark.parametrize("name", PROBLEMS)
def test_no_hint_tells_an_answer(tmp_path: Path, name: str) -> None:
    page, hints, answers = of(tmp_path, name)
    said = " ".join(page_text(hints, WORDS, Notation(page.dimensions)).split())
    assert answers and [answer for answer in answers if " ".join(answer.split()) in said] == []


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_rungs_go_from_what_is_sought_to_what_is_known(tmp_path: Path, name: str) -> None:
    _, hints, _ = of(tmp_path, name)
    for part in hints.parts:
        rungs = [block for block in part.blocks if isinstance(block, Folded)]
        titles = [rung.title[:6] for rung in rungs]
        assert titles == sorted(titles) and titles[:1] == ["Hint 1"]
        first = [g for block in rungs[0].blocks if isinstance(block, Display) for g in block.groups]
        assert all(group.lines[0].right == BLANK for group in first)


def test_an_equation_has_its_number_on_every_paper(tmp_path: Path) -> None:
    page, hints, _ = of(tmp_path, "block")
    numbers = {g.key: g.number for part in page.parts for b in part.blocks if isinstance(b, Display) for g in b.groups}
    rungs = [rung for part in hints.parts for rung in part.blocks if isinstance(rung, Folded)]
    told = {g.key: g.number for rung in rungs for b in rung.blocks if isinstance(b, Display) for g in b.groups}
    assert told and all(numbers[key] == number for key, number in told.items())
