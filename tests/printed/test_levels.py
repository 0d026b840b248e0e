"""Every page at every level: no letter comes from nowhere, and a higher level has no fewer lines."""

from __future__ import annotations

from itertools import pairwise

import pytest

from derive.algebra.expressions import Relation, rate
from derive.building.derivations import Solved, steps_key
from derive.building.solution import derived
from derive.course.problem import Problem, load_problem
from derive.page.document import document_of
from derive.page.introduced_symbols import expressions_in, letters_in, letters_of
from derive.page.template import templates_of
from derive.page.tree import Display, Document
from derive.page.wording import Math, Text, ToldOnce, phrases
from derive.steps.step import Level
from tests.courses import ROOT, kept, rendered_once

WORDS = phrases(templates_of(ROOT))
SETS = [f"{path.parent.name}/{path.stem}" for path in sorted((ROOT / "problems" / "hw9").glob("*.yaml"))]
SETS += [f"library/{path.stem}" for path in sorted((ROOT / "problems" / "library").rglob("*.yaml"))]
PROBLEMS = [name for name in SETS if name.rpartition("/")[2] not in ("set", "reference")]


def page(known: tuple[Problem, Solved], level: Level) -> Document:
    problem, solved = known
    document, faults = document_of(
        problem, solved.derivation, solved.values, WORDS, level, others={}, drawings=solved.drawings
    )
    assert [fault for fault in faults if fault.code != "no-such-problem"] == []
    return document


def steps_of(problem_id: str) -> tuple[Problem, Solved]:
    rendered_once(ROOT, problem_id, only=())
    problem = load_problem(ROOT, problem_id)
    kept_steps = Solved.from_data(kept().get_data(steps_key(problem)))
    if kept_steps is None:
        derivation, values, _, run = derived(problem)
        kept_steps = Solved(derivation, values, (), tuple(run.drawings))
    return problem, kept_steps


def lines(document: Document) -> int:
    blocks = [block for part in document.parts for block in part.blocks]
    groups = [group for block in blocks if isinstance(block, Display) for group in block.groups]
    theorems = [node for block in blocks for node in getattr(block, "nodes", ()) if isinstance(node, ToldOnce)]
    return sum(len(group.lines) for group in groups) + len(theorems)


def shown(document: Document) -> tuple[object, ...]:
    return document.title, document.statement, document.illustrations, document.parts, document.note


def equated(document: Document) -> set[object]:
    displays = [block for part in document.parts for block in part.blocks if isinstance(block, Display)]
    groups = [group for display in displays for group in display.groups]
    lefts = [line.left for group in groups for line in group.lines if line.left is not None]
    lefts += [line.right for group in groups for line in group.lines[:-1] if letters_of(line.right)]  # a = b = 2
    rights = [line.right for group in groups for line in group.lines]
    lefts += [each.left for each in rights if isinstance(each, Relation) and each.operator == "="]  # F ≈ F_max = 2
    found = {letter for left in lefts for letter in (letters_of(left) or letters_in(expressions_in(left)))}
    written = [getattr(block, "nodes", ()) for part in document.parts for block in part.blocks]
    for nodes in (*written, document.note):
        found |= {
            letter
            for node, sign in pairwise(nodes)
            if isinstance(node, Math) and isinstance(sign, Text) and sign.text.startswith(" = ")
            for letter in letters_of(node.expr)
        }
        said = [node.expr for node in nodes if isinstance(node, Math) and isinstance(node.expr, Relation)]
        found |= {letter for each in said if each.operator == "=" for letter in letters_in([each.left])}  # I_1 = I_xx
    return found


@pytest.mark.parametrize("problem_id", PROBLEMS)
def test_every_letter_of_a_page_is_introduced_and_a_higher_level_has_no_fewer_lines(problem_id: str) -> None:
    known = steps_of(problem_id)
    problem, solved = known
    moving = {q for step in solved.derivation.steps for q, _ in step.coordinates}
    given = {*problem.dimensions, *moving, *(rate(q, order) for q in moving for order in (1, 2))}
    given |= letters_in(expressions_in(page(known, Level.FULL).statement))
    here = [
        step for step in solved.derivation.steps if problem.show.get(step.key) != "hidden"
    ]  # the instructor decides
    known_letters = {letter for step in here for letter in letters_of(step.symbol)} - given
    counts = []
    for level in Level:
        document = page(known, level)
        used = letters_in(expressions_in(shown(document))) & known_letters
        assert used - equated(document) == set(), (level, problem_id)
        counts.append(lines(document))
    assert counts == sorted(counts)
