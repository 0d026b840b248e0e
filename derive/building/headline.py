"""What a list of problems tells of one, without deriving it: its points and its title."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from derive.course.parts import points_text
from derive.course.written import written_problem
from derive.errors import Faults


def headline(root: Path, problem_id: str) -> tuple[str, str]:
    """A problem's points and title; a step that the title mentions is named by its key.

    Mathematics is loaded only for a title that mentions something, and to tell of a file what is wrong with it first.
    """
    faults = Faults()
    written = written_problem(root, problem_id, faults)
    points = written.points_in_all(faults)
    if faults or not written.title or written.title.mentions:
        title = _title_with_mathematics(root, problem_id)
    else:
        title = " ".join(written.title.text.split())
    return "" if points is None else points_text(points), title


def _title_with_mathematics(root: Path, problem_id: str) -> str:
    from derive.course.problem import load_problem
    from derive.page.template import template_folder
    from derive.page.wording import AXIS_NAMES, Text, given_words, phrases, told
    from derive.render.notation.notation import Notation
    from derive.render.printing.text_page import inline_text

    problem = load_problem(root, problem_id)
    words = phrases(template_folder(root))
    names: dict[str, Any] = {g.name: given_words(g, problem.measured, words) for g in problem.givens}
    names.update({m.name: Text(m.name) for m in problem.title.mentions if m.name not in names})
    title = told(problem.title.pieces, {**AXIS_NAMES, **names}, lambda name, place: None)
    return inline_text(title, Notation(problem.dimensions))
