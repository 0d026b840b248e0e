"""Whole documents from solved problems: one solution, all documents of a set, and the web pages of a set."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

from derive.building.document_list import Paper
from derive.course.names import LOGO, MORE, REPORT, SHEET, SOLUTIONS
from derive.course.parts import points_text
from derive.course.problem_set import ProblemSet
from derive.errors import Faults, Place
from derive.page.template import templates_of
from derive.page.wording import Phrases, phrases
from derive.render.notation.latex import unprintable
from derive.render.printing.figure_numbers import equations_numbered, numbered_in_a_row
from derive.render.printing.latex_page import dotted, whole_latex
from derive.render.printing.templates import HTML, filled_html
from derive.render.printing.theorems_once import told_once
from derive.render.rendered import Html, Rendered, Tex
from derive.steps.level import Level

FONT = "math.woff"  # the font for formulas, see tools/webfont.py
COUNTED = (
    "steps_proved", "steps_sampled", "steps_approximation", "steps_definition", "lines",
    "routes", "routes_proved", "checks", "witnesses", "agree", "agree_to_figures", "errata", "remarks",
)  # fmt: skip


@dataclass(frozen=True)
class Listed:
    """A problem in the form that a document of its set shows."""

    number: str
    problem: Rendered
    kind: str = SOLUTIONS

    @property
    def id(self) -> Tex:
        return Tex(self.problem.id)

    @property
    def body(self) -> Tex:
        return Tex(self.problem.documents.get(self.kind, "")) if self.kind in MORE else self.problem.latex

    @property
    def name(self) -> str:
        return self.problem.id.rpartition("/")[2]

    @property
    def anchor(self) -> Tex:
        return Tex(dotted(self.problem.id))

    @property
    def title(self) -> Tex:
        return self.problem.title_latex


def problem_document(root: Path, problem: Rendered, heading: ProblemSet) -> str:
    """Return a complete .tex of one problem, numbered as in its set."""
    return _document(root, "document.tex.j2", heading, [_standalone(problem, heading)])


def set_document(root: Path, heading: ProblemSet, problems: Sequence[Rendered]) -> str:
    """Return a complete .tex of the set: the cover block and the problems in order."""
    return _document(root, "set.tex.j2", heading, _listed(problems))


def sheet_document(root: Path, heading: ProblemSet, problems: Sequence[Rendered]) -> str:
    """Return a complete .tex of the questions alone, for students."""
    return _document(root, "sheet.tex.j2", heading, _listed(problems))


def document_on_request(root: Path, heading: ProblemSet, problems: Sequence[Rendered], kind: str) -> str:
    """Return a complete .tex of one of the documents that are made only on request."""
    return _document(root, "set.tex.j2", heading, _listed(problems, kind), kind)


def document_page(root: Path, heading: ProblemSet, problems: Sequence[Rendered], kind: str) -> str:
    """Return a document that is made only on request, or the sheet, as one page for a browser."""
    label = phrases(templates_of(root), heading.language).labels["documents"][kind]
    listed = _listed(problems, kind)
    printed = [(each.name, each.number, each.problem.documents.get(f"{kind}.html", "")) for each in listed]
    numbered = equations_numbered(zip([each.number for each in listed], told_once(printed), strict=True))
    bodies = numbered_in_a_row(numbered)
    return _page(root, "document.html.j2", heading, listed, kind_of_document=label, bodies=bodies)


def the_document(kind: str) -> Callable[[Path, ProblemSet, Sequence[Rendered]], str]:
    """Return the function that makes the .tex of that kind of document."""
    known = {SOLUTIONS: set_document, SHEET: sheet_document, REPORT: report_document}
    return known.get(kind) or partial(document_on_request, kind=kind)


def report_document(root: Path, heading: ProblemSet, problems: Sequence[Rendered]) -> str:
    """Return a complete .tex for the instructor: how the set was checked, and which errors its source document
    contains."""
    numbers = heading.numbers
    listed = [Listed(str(numbers.get(each.id.rpartition("/")[2], "")), each) for each in problems]
    return _document(root, "report.tex.j2", heading, listed)


def problem_page(root: Path, problem: Rendered, heading: ProblemSet) -> str:
    """Return the page of one problem for a browser: one file with everything that it shows."""
    return _page(root, "solution.html.j2", heading, [_standalone(problem, heading)])


def problem_main(root: Path, problem: Rendered, heading: ProblemSet) -> str:
    """Return the main part of the page of a problem."""
    return _page(root, "main.html.j2", heading, [_standalone(problem, heading)])


def live_page(root: Path, heading: ProblemSet, name: str, main: str) -> str:
    """Return the page of a problem that is being written; `main` is its main part, which `problem_main` made."""
    return _page(root, "live.html.j2", heading, [], name=name, main=Html(main))


def index_page(
    root: Path,
    heading: ProblemSet,
    problems: Sequence[Rendered],
    papers: Sequence[Paper] = (),
    for_students: bool = False,
) -> str:
    """Return the page of a set: links to its documents, and the statements of its problems. The page for students has
    no link to a solution."""
    shown = {"papers": papers, "for_students": for_students}
    questions = numbered_in_a_row(each.card_html for each in problems)
    return _page(root, "index.html.j2", heading, _listed(problems), questions=questions, **shown)


def class_page(root: Path, heading: ProblemSet, students: Sequence[Mapping[str, Any]]) -> str:
    """Return the page with links to the documents of each student of a class."""
    return _page(root, "class.html.j2", heading, [], students=students)


def _page(root: Path, template: str, heading: ProblemSet, problems: Sequence[Listed], **more: Any) -> str:
    templates = templates_of(root)
    font = b64encode(templates.file(f"{HTML}/{FONT}").read_bytes()).decode()
    return filled_html(templates, template, {**_facts(root, heading, problems), "font": font, **more})


def _standalone(problem: Rendered, heading: ProblemSet) -> Listed:
    return Listed(str(heading.numbers.get(problem.id.rpartition("/")[2], "")), problem)


def _listed(problems: Sequence[Rendered], kind: str = SOLUTIONS) -> list[Listed]:
    return [Listed(str(number), problem, kind) for number, problem in enumerate(problems, 1)]


def _document(root: Path, template: str, heading: ProblemSet, problems: Sequence[Listed], kind: str = SOLUTIONS) -> str:
    _check_characters(root, heading)
    facts = _facts(root, heading, problems)
    labels = facts["labels"]
    facts["kind_of_document"] = labels["solutions"] if kind == SOLUTIONS else labels["documents"][kind]
    return whole_latex(templates_of(root), template, facts)


def _check_characters(root: Path, heading: ProblemSet) -> None:
    """Report the words of a heading that the fonts of the PDF cannot print."""
    faults = Faults()
    for fact in filter(lambda fact: unprintable(fact) is not None, (heading.title, *heading.facts)):
        files = (path for path in heading.inputs if path.endswith(".yaml"))
        lines = (
            (path, *line) for path in files for line in enumerate((root / path).read_text("utf-8").splitlines(), 1)
        )
        place = next((Place(path, n, 1, text, len(text)) for path, n, text in lines if fact in text), None)
        help_line = "write it in Latin or Greek letters: the fonts of the PDF have no others"
        faults.error("character", f"`{fact}` cannot be printed", place, help=help_line)
    faults.stop()


def _facts(root: Path, heading: ProblemSet, problems: Sequence[Listed]) -> dict[str, Any]:
    words: Phrases = phrases(templates_of(root), heading.language)
    return {
        "set_id": Tex(heading.id),
        "heading": heading,
        "font_size": Tex((heading.font_size or "").replace(" ", "")),
        "logo_file": Tex(LOGO) if heading.logo else "",
        "logo_data": b64encode(heading.logo).decode() if heading.logo else "",
        "problems": problems,
        "detail": problems[0].problem.detail if problems else Level.STANDARD.value,
        "total": _total(problems),
        "number": words.number,
        "worth": lambda points: words.worth(Fraction(points)) if points else "",
        "rows": _rows(problems, words),
        "columns_of_counts": COUNTED,
        "labels": words.labels,
        "grades": words.grades,
    }


def _rows(problems: Sequence[Listed], words: Phrases) -> list[tuple[str, dict[str, int]]]:
    rows = [(f"{words.labels['problem']} {listed.number}", listed.problem.counts) for listed in problems]
    sums = {name: sum(counts[name] for _, counts in rows) for name in COUNTED}
    return [*rows, (words.labels["report_page"]["all"], sums)] if len(rows) > 1 else rows


def _total(problems: Sequence[Listed]) -> str:
    if not all(listed.problem.points for listed in problems):
        return ""
    total = sum((Fraction(listed.problem.points) for listed in problems), Fraction(0))
    return points_text(total)
