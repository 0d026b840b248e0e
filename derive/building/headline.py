"""The points and the title of a problem, for a list of problems, without deriving the problem."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive.course.parts import POINTS, Question, points_in_all, points_text
from derive.course.problem_file import ProblemKeys, written_problem
from derive.course.problem_set import language_of, mapping_in, path_of
from derive.course.prose import Prose, TexFormula
from derive.course.schema import check_keys, keys_of
from derive.course.yaml_tree import Mapping, Sequence, Tree
from derive.errors import DeriveError, Faults

if TYPE_CHECKING:
    from derive.page.wording import Inline

_OF_POINTS = ("points", "extra", "rubric")


def headline(root: Path, problem_id: str, path: str = "") -> tuple[str, str]:
    """Return a problem's points and title; a step that the title mentions is named by its key.

    path   the problem's file, relative to `root`; by default it is found from the id

    The whole file is read only if the title needs it, or if the file has an error.
    """
    return _at_a_glance(root, path or path_of(root, problem_id)) or _in_full(root, problem_id)


def _at_a_glance(root: Path, path: str) -> tuple[str, str] | None:
    faults = Faults()
    try:
        node = mapping_in(root, path, "a problem", quickly=True)
    except DeriveError:
        return None
    keys, listed = keys_of(ProblemKeys), node.get("parts")
    check_keys(node, keys, "a problem", faults)
    parts = [_glanced(part, faults) for part in (listed.items if isinstance(listed, Sequence) else ())]
    named, stated = node.get("title"), node.get("points")
    title = keys["title"].reader.read(named, "title", faults) if named is not None else None
    points = POINTS.read(stated, "points", faults) if stated is not None else None
    total = points_in_all(points, None, parts, faults)
    if faults or not isinstance(title, Prose) or title.plain is None:
        return None
    return "" if total is None else points_text(total), title.plain


def _glanced(node: Tree, faults: Faults) -> Question:
    if not isinstance(node, Mapping):
        return Question({}, {})
    keys = keys_of(Question)
    check_keys(node, keys, "a part", faults)
    found = {name: keys[name].reader.read(under, name, faults) for name in _OF_POINTS if (under := node.get(name))}
    return Question({}, {}, **{name: value for name, value in found.items() if value is not None})


def _in_full(root: Path, problem_id: str) -> tuple[str, str]:
    faults = Faults()
    written = written_problem(root, problem_id, faults, quickly=True)
    points = written.points_in_all(faults)
    title = written.title.plain if written.title and not faults else None
    if title is None:
        title = _title_with_mathematics(root, problem_id)
    return "" if points is None else points_text(points), title


def _unread(formula: TexFormula) -> Inline:
    """Return a formula as it is written, because its letters are known only after the derivation."""
    from derive.course.latex.quoting import Unquotable, quoted_formula
    from derive.course.transcript import Transcript
    from derive.page.wording import Math, Text

    try:
        return Math(Transcript(quoted_formula(formula.tex)))
    except Unquotable:
        return Text(f"${formula.tex}$")


def _title_with_mathematics(root: Path, problem_id: str) -> str:
    from derive.course.problem import load_problem
    from derive.page.template import templates_of
    from derive.page.wording import AXIS_NAMES, Text, given_words, phrases, told
    from derive.render.notation.notation import Notation
    from derive.render.printing.text_page import inline_text

    problem = load_problem(root, problem_id)
    words = phrases(templates_of(root), language_of(root, problem.set_id))
    names: dict[str, Any] = {g.name: given_words(g, problem.measured, words) for g in problem.givens}
    names.update({m.name: Text(m.name) for m in problem.title.mentions if m.name not in names})
    title = told(problem.title.pieces, {**AXIS_NAMES, **names}, lambda name, place: None, formula=_unread)
    return inline_text(title, Notation(problem.dimensions, language=words.labels["language"]))
