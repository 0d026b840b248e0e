"""Numbers that no text of a problem mentions follow the statement."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.derivations import Solved
from derive.course.problem import Problem, load_problem
from derive.page.document import document_of
from derive.page.template import templates_of
from derive.page.tree import Document
from derive.page.wording import phrases
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.steps.level import Level
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(templates_of(ROOT))


@pytest.fixture(scope="module")
def top(tmp_path_factory: pytest.TempPathFactory) -> tuple[Problem, Solved]:
    return solved_once(course_in(tmp_path_factory.mktemp("top"), problem="top"), "hw9/top")


def page(solved: tuple[Problem, Solved], problem: Problem) -> Document:
    found = solved[1]
    document, faults = document_of(
        problem, found.derivation, found.values, WORDS, Level.STANDARD, drawings=found.drawings
    )
    assert faults == []
    return document


def told(nodes: object) -> str:
    return inline_text(nodes, Notation())  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("instead", "added"),
    [
        ("<<gravity>>", ""),
        ("$g$", " Take g = 9.8 m/s^2."),
        ("9.8 m/s²", ""),
        (r"$g = 9.8\,\mathrm{m/s^2}$", ""),
        ("19.8 m/s²", " Take g = 9.8 m/s^2."),
        ("that of free fall", " Take g = 9.8 m/s^2."),
    ],
)
def test_a_number_that_no_text_gives_follows_the_statement(
    top: tuple[Problem, Solved], tmp_path: Path, instead: str, added: str
) -> None:
    course = course_in(tmp_path, {"<<gravity>>": instead}, problem="top")
    statement = told(page(top, load_problem(course, "hw9/top")).statement)
    assert statement.endswith(added)
    assert ("Take" in statement) == bool(added)
