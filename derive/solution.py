"""From a problem's id to its solution in every format: load, derive, number, word, print.

Everything that leaves this module is plain text and numbers, so that it can cross from a worker to its parent.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sympy import Integer, Symbol

from derive.derivation import Derivation, derivation_of, returned_quantities, with_ancestors
from derive.dimensions import dimension_of_kind, kind_with_article, unit_of_kind
from derive.document import document_of
from derive.errors import Complaint, Rejected
from derive.expressions import rate
from derive.numbers import coefficient_of, comparison_of, value_of
from derive.parts import Part, points_text
from derive.problem import Problem, load_problem, problem_set, run_solve
from derive.reference import comparisons
from derive.render.contract import contract
from derive.render.latex import unprintable
from derive.render.latex_page import problem_latex, whole_latex
from derive.render.notation import Notation
from derive.render.text_page import inline_text, page_text
from derive.source import did_you_mean
from derive.stated import reference_path
from derive.step import Level, Quantity, Step, recorded
from derive.stored import Solved, keep, key_of, recalled
from derive.units import read_unit
from derive.wording import AXIS_NAMES, Phrases, Text, given_words, phrases, told


@dataclass(frozen=True)
class Rendered:
    """One problem, solved and printed."""

    id: str
    title: str
    points: str
    latex: str
    text: str
    json: str
    warnings: tuple[Complaint, ...]
    inputs: tuple[str, ...]
    grades: dict[str, int]
    agreed: bool


def rendered(root: Path, problem_id: str, detail: str | None = None, kept: Path | None = None) -> Rendered:
    """Derive a problem and print it in every format; raises `DeriveError` with everything that is wrong.

    `kept` is a file in which the steps are kept for the next time, and from which they are taken if they still hold.
    """
    problem = load_problem(root, problem_id)
    _check_characters(problem)
    words = phrases(template_folder(root))
    solved, failures = _solved(problem, kept)
    derivation, values = solved.derivation, solved.values
    document, faults = document_of(problem, derivation, values, words, Level(detail or "standard"), solved.compared)
    if faults:
        raise Rejected(faults)
    notation = Notation(document.dimensions)
    return Rendered(
        id=problem_id,
        title=inline_text(document.title, notation),
        points="" if problem.points is None else points_text(problem.points),
        latex=problem_latex(document, words, notation, template_folder(root)),
        text=page_text(document, words, notation),
        json=contract(
            problem, derivation, values, document, notation, reference=[told.facts for told in solved.compared]
        ),
        warnings=(*document.warnings, *failures),
        inputs=(*problem.inputs, reference_path(problem)),
        grades=_grades(derivation, values),
        agreed=not failures,
    )


def _solved(problem: Problem, kept: Path | None) -> tuple[Solved, tuple[Complaint, ...]]:
    """The steps, as they were kept or derived now, and what disagrees with the reference."""
    key = key_of(problem) if kept else ""
    solved = recalled(kept, key) if kept else None
    if solved is not None:
        return solved, ()
    derivation, values, known = _derived(problem)
    compared = comparisons(problem, known)
    failures = tuple(c.complaint for c in compared if c.complaint)
    solved = Solved(derivation, values, tuple(c.told() for c in compared))
    if kept and not failures:
        keep(kept, key, solved)
    return solved, failures


def _check_characters(problem: Problem) -> None:
    """Prose may only have characters that can be printed."""
    texts = [problem.title, problem.statement, *(part.ask for part in problem.parts)]
    texts += [prose for by_outcome in problem.wording.values() for prose in by_outcome.values()]
    faults = []
    for prose in texts:
        at = unprintable(prose.scalar.text)
        if at is not None:
            message = f"`{prose.scalar.text[at]}` cannot be printed"
            help_line = "the fonts of the page have Latin and Greek letters and the usual signs"
            faults.append(Complaint("character", message, prose.scalar.place_within(at), help=help_line))
    if faults:
        raise Rejected(faults)


def headline(root: Path, problem_id: str) -> tuple[str, str]:
    """A problem's points and title without deriving it; a step that the title mentions is named by its key."""
    problem = load_problem(root, problem_id)
    words = phrases(template_folder(root))
    names: dict[str, Any] = {g.name: given_words(g, problem.measured, words) for g in problem.givens}
    names.update({m.name: Text(m.name) for m in problem.title.mentions if m.name not in names})
    title = told(problem.title.pieces, {**AXIS_NAMES, **names}, lambda name, place: None)
    points = "" if problem.points is None else points_text(problem.points)
    return points, inline_text(title, Notation(problem.dimensions))


def _derived(problem: Problem) -> tuple[Derivation, dict[str, Step], dict[str, Quantity]]:
    """The steps behind every answer, the step that gives each answer its number, and all steps by key."""
    with recorded() as established:
        answers = returned_quantities(run_solve(problem), problem.script.returns)
    known = with_ancestors(answers, problem.script.returns)
    _check_answers(problem, known)
    _check_letters(problem, known)
    derivation = derivation_of([part.answers for part in problem.parts], known, established)
    values: dict[str, Step] = {}
    for part in problem.parts:
        for key in part.answers:
            value = _value(problem, part, known[key])
            if value is not None and value.step.chain not in [other.chain for other in values.values()]:
                values[key] = value.step  # two answers may be the same condition, which is compared once
    return derivation, values, known


def _check_answers(problem: Problem, known: dict[str, Quantity]) -> None:
    faults = [
        Complaint(
            "no-such-answer",
            f"`solve()` returns nothing called `{key}`",
            part.place_of(key),
            help=did_you_mean(key, known)
            or "the steps are " + ", ".join(f"`{name}`" for name in known if "_" not in name),
        )
        for part in problem.parts
        for key in part.answers
        if key not in known
    ]
    if faults:
        raise Rejected(faults)


def _check_letters(problem: Problem, known: dict[str, Quantity]) -> None:
    """A letter of the problem's own may not also be what a step calls its result, or a coordinate or its rate."""
    faults = []
    coordinates = dict.fromkeys(q for quantity in known.values() for q in quantity.coordinates)
    for name in dict.fromkeys(rate(q, n).name for q in coordinates for n in range(3)):
        if name in problem.symbols:
            message = f"`{name}` is a letter of this problem, but the script has a coordinate of that name"
            help_line = 'use another letter, or another name in `coordinate("...")`'
            faults.append(Complaint("letter-clash", message, problem.place_of("symbols"), help=help_line))
    for key, quantity in known.items():
        symbol = quantity.symbol
        if isinstance(symbol, Symbol) and symbol.name in problem.symbols:
            message = f"`{symbol.name}` is a letter of this problem, but the step `{key}` calls its result so too"
            help_line = 'use another letter, or give the verb `symbol="..."`'
            faults.append(Complaint("letter-clash", message, problem.place_of("symbols"), help=help_line))
    if faults:
        raise Rejected(faults)


def _value(problem: Problem, part: Part, answer: Quantity) -> Quantity | None:
    """The number of an answer: in the unit and to the figures that the part asks for."""
    form = part.form_of(answer.key)
    kind = answer.step.kind or "number"
    unit, factor = unit_of_kind(kind), Integer(1)
    if form.unit is not None:
        asked = read_unit(form.unit, part.ask.place)
        if asked.dimension != dimension_of_kind(kind):
            message = f"`{answer.key}` is {kind_with_article(kind)}, which is not measured in `{form.unit}`"
            raise Rejected(Complaint("wrong-unit", message, part.place_of(answer.key)))
        unit, factor = form.unit, asked.factor
    figures = form.figures or problem.figures
    value = value_of(answer, problem.amounts, unit, factor, figures) or comparison_of(answer, problem.amounts)
    return value or (coefficient_of(answer, figures) if not problem.measured else None)


def _grades(derivation: Derivation, values: Mapping[str, Step]) -> dict[str, int]:
    counts = derivation.grades()
    for step in values.values():
        for evidence in step.evidence:
            counts[evidence.grade.value] += 1
    return counts


# --- whole documents ---


def problem_document(root: Path, problem: Rendered, set_id: str) -> str:
    """A complete .tex of one problem, numbered as in its set."""
    heading = problem_set(root, set_id)
    ids = [name if "/" in name else f"{set_id}/{name}" for name in heading.problems]
    number = ids.index(problem.id) + 1 if problem.id in ids else ""
    head = _head(root, heading, cover="")
    return whole_latex(template_folder(root), head, [problem.latex.replace("@NUMBER@", str(number))])


def set_document(root: Path, set_id: str, problems: list[Rendered]) -> str:
    """A complete .tex of the set: cover block, then its problems in order."""
    heading = problem_set(root, set_id)
    facts = [heading.course, heading.instructor, heading.date]
    head = _head(root, heading, cover=", ".join(str(fact) for fact in facts if fact) or heading.title)
    fragments = [problem.latex.replace("@NUMBER@", str(i)) for i, problem in enumerate(problems, 1)]
    return whole_latex(template_folder(root), head, fragments)


def _head(root: Path, heading: Any, cover: str) -> dict[str, str]:
    words: Phrases = phrases(template_folder(root))
    running = " \u00b7 ".join(str(part) for part in (heading.course, heading.title) if part)
    return {
        "title": heading.title,
        "pdf_title": heading.title,
        "running": running,
        "kind": words.labels["solutions"],
        "cover": cover,
    }


def template_folder(root: Path) -> Path:
    """The course's own templates if it has them, else those of the installation."""
    package = Path(__file__).parent
    for folder in (root / "templates", package / "templates", package.parent / "templates"):
        if (folder / "phrases" / "en.yaml").is_file():
            return folder
    raise Rejected(Complaint("no-templates", "no `templates/` with phrases was found"))
