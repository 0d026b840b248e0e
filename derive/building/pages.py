"""The page of a derived problem, in every requested format and document.

The result is plain data that a worker can send to its parent process.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from derive.algebra.dimensions import Dimension
from derive.building.cache import NO_CACHE, Cache
from derive.building.derivations import Solved
from derive.building.drawings import drawing_files
from derive.building.numbers import faults_of_numbers
from derive.course.names import HINTS, KEY, EvidenceShown
from derive.course.parts import points_text
from derive.course.problem import Problem
from derive.course.problem_set import ProblemSet, language_of, problem_set
from derive.course.prose import PROBLEM
from derive.course.reference.comparison import Told
from derive.course.reference.statements import reference_paths
from derive.course.yaml_tree import Word
from derive.errors import Complaint, Faults
from derive.page.document import document_of
from derive.page.folding import with_details
from derive.page.hints import with_hints
from derive.page.rubric import Credit, credits_of, faults_of_rubric
from derive.page.template import Templates, templates_of
from derive.page.theorems import standalone
from derive.page.tree import Document
from derive.page.wording import Phrases, phrases
from derive.render.formats import HTML, TYPESET, Solution, built_formats, formats
from derive.render.notation.notation import Notation
from derive.render.notation.text import in_one_line
from derive.render.printing.documents import document_fragments
from derive.render.printing.html_page import NO_HTML, HtmlFragments, problem_html
from derive.render.printing.latex_page import NOT_TYPESET, Fragments, problem_latex
from derive.render.printing.text_page import inline_text
from derive.render.rendered import Files, Rendered, SourceFault
from derive.steps.step import Level


@dataclass(frozen=True)
class Wanted:
    """What a caller requests for a problem: formats, documents and the level of detail.

    detail      how much algebra the page shows; by default `standard`
    draws       whether the files of the drawings are also requested
    only        the formats; by default all formats of a build
    evidence    how much the page shows about its checks
    documents   other documents, such as the key, hints or a rubric
    width       the text width, in centimetres, of the LaTeX document that includes a fragment
    """

    detail: str | None = None
    draws: bool = False
    only: Collection[str] | None = None
    evidence: EvidenceShown = EvidenceShown.NONE
    documents: Collection[str] = ()
    width: float | None = None

    @property
    def level(self) -> Level:
        return Level(self.detail or "standard")

    @property
    def formats(self) -> set[str]:
        return {*built_formats(), *TYPESET, HTML} if self.only is None else {*self.only}


def printed(
    problem: Problem,
    solved: Solved,
    wanted: Wanted,
    cache: Cache = NO_CACHE,
    failures: tuple[Complaint, ...] = (),
) -> Rendered:
    """Return the page of a derived problem; raise `Rejected` if there are errors.

    cache      the cache that stores the files of the drawings
    failures   the disagreements with the reference, which are added to the warnings
    """
    return _Printing(problem, solved, wanted, cache, failures).rendered()


def rubric_of(problem: Problem, solved: Solved) -> dict[str, dict[str, Fraction]]:
    """Return the points that steps earn, by the label of the part and the key of the step; {} if the problem has no
    points."""
    if problem.points is None:
        return {}
    rubric = _Printing(problem, solved, Wanted(only=()), NO_CACHE, ()).points
    return {label: {each.equations.key: each.points for each in found} for label, found in rubric.items()}


class _Printing:
    def __init__(
        self, problem: Problem, solved: Solved, wanted: Wanted, cache: Cache, failures: tuple[Complaint, ...]
    ) -> None:
        self.problem, self.solved, self.wanted, self.cache, self.failures = problem, solved, wanted, cache, failures
        self.level = wanted.level

    def rendered(self) -> Rendered:
        problem, solved, document, notation = self.problem, self.solved, self.document, self.notation
        # These calls raise `Rejected` if the file of the problem has errors.
        warnings, files, documents = self._warnings(), self.files, self._documents()
        latex, html = self._latex(), self._html()
        return Rendered(
            id=problem.id,
            detail=self.level.value,
            title=inline_text(document.title, notation),
            points="" if problem.points is None else points_text(problem.points),
            latex=latex.solution,
            title_latex=latex.title,
            sheet=latex.sheet,
            report=latex.report,
            source=latex.source,
            html=html.solution,
            title_html=html.title,
            card_html=html.card,
            documents=documents,
            texts=self._texts(warnings),
            warnings=warnings,
            inputs=self._inputs(),
            grades=_grades(solved),
            counts=document.checks.counts(),
            steps=len(solved.derivation.steps) + len(solved.values),
            compared=len(solved.compared),
            agreed=not self.failures,
            source_faults=_source_faults(solved.compared, notation),
            files=files,
        )

    def _inputs(self) -> tuple[str, ...]:
        problem, figure = self.problem, self.problem.figure
        of_set = self.heading.inputs if self.heading else ()
        return (*problem.inputs, *([figure.path] if figure else []), *reference_paths(problem), *of_set)

    # --- what the formats share ---

    @cached_property
    def templates(self) -> Templates:
        return templates_of(self.problem.root)

    @cached_property
    def words(self) -> Phrases:
        return phrases(self.templates, language_of(self.problem.root, self.problem.set_id))

    @cached_property
    def heading(self) -> ProblemSet | None:
        """The set of the problem; None if the prose does not refer to other problems by number."""
        mentions = (mention for prose in self.problem.texts for mention in prose.mentions)
        refers = any(mention.of == PROBLEM for mention in mentions)
        return problem_set(self.problem.root, self.problem.set_id) if refers else None

    @cached_property
    def document(self) -> Document:
        return self._page(self.level, self._page(Level.STANDARD) if self.level is Level.FULL else None)

    @cached_property
    def full(self) -> Document:
        return self.document if self.level is Level.FULL else self._page(Level.FULL, self.document)

    def _page(self, level: Level, like: Document | None = None) -> Document:
        solved, others = self.solved, self.heading.numbers if self.heading else {}
        document, faults = document_of(
            self.problem,
            solved.derivation,
            solved.values,
            self.words,
            level,
            solved.compared,
            others,
            solved.drawings,
            self.wanted.evidence,
            like,
        )
        Faults(faults).stop()
        return document

    @cached_property
    def notation(self) -> Notation:
        words = self.words
        dimensions = tuple(self.document.dimensions.items())
        return _notation(dimensions, self.level is Level.BRIEF, tuple(words.labels["language"].items()))

    @cached_property
    def files(self) -> Files:
        if not self.wanted.draws:
            return ()
        drawings = self.solved.drawings
        return drawing_files(self.problem, drawings, self.document, self.words, self.notation, self.cache)

    @cached_property
    def rubric(self) -> Mapping[str, Mapping[Word, Fraction]]:
        """The points that the author gives for single steps, by the label of their part."""
        rubric = {chr(ord("a") + i): part.rubric for i, part in enumerate(self.problem.parts)}
        Faults(faults_of_rubric(self.document, rubric)).stop()
        return rubric

    # --- the formats ---

    def _warnings(self) -> tuple[Complaint, ...]:
        """Return the warnings for the author; raise `Rejected` with errors in the numbers of the problem."""
        solved = self.solved
        of_numbers = faults_of_numbers(self.problem, solved.derivation, solved.values, solved.drawings)
        Faults(fault for fault in of_numbers if fault.severity == "error").stop()
        return (*self.problem.warnings, *self.document.warnings, *of_numbers, *self.failures)

    def _latex(self) -> Fragments:
        if self.wanted.formats.isdisjoint(TYPESET):
            return NOT_TYPESET
        return problem_latex(self.document, self.words, self.notation, self.templates)

    def _html(self) -> HtmlFragments:
        if HTML not in self.wanted.formats:
            return NO_HTML
        whole = self.document if self.level is Level.FULL else with_details(self.document, self.full)
        return problem_html(whole, self.words, self.notation, self.templates, self.files)

    def _texts(self, warnings: Sequence[Complaint]) -> dict[str, str]:
        solved = self.solved
        solution = Solution(
            standalone(self.document),
            self.words,
            self.notation,
            self.problem,
            solved.derivation,
            solved.values,
            solved.compared,
            warnings,
            self.level.value,
            self.wanted.width,
        )
        return {name: form.render(solution) for name, form in formats().items() if name in self.wanted.formats}

    @cached_property
    def points(self) -> dict[str, tuple[Credit, ...]]:
        """The points that steps earn, by the label of the part."""
        values = self.solved.values.values()
        steps = [*self.solved.derivation.steps, *values]
        # For a rule of an author's script, the phrases do not say what a student does.
        tasks = {step.key: self.words.tasks.get(step.rule, "") for step in steps}
        return credits_of(self.document, self.rubric, tasks, values)

    def _documents(self) -> dict[str, str]:
        points = self.points
        kinds = self.wanted.documents
        return document_fragments(kinds, self._page_for, points, self.words, self.notation, self.templates, self.files)

    def _page_for(self, kind: str) -> Document:
        solved = self.solved
        if kind == HINTS:
            return with_hints(self.document, self.problem, solved.derivation, solved.values, self.words)
        return self.full if kind == KEY else self.document


@lru_cache(maxsize=4)
def _notation(
    dimensions: tuple[tuple[Any, Dimension | None], ...], flat: bool, language: tuple[tuple[str, str], ...]
) -> Notation:
    return Notation(dict(dimensions), flat, dict(language))


def _source_faults(compared: Sequence[Told], notation: Notation) -> tuple[SourceFault, ...]:
    if not any(told.erratum or told.remark for told in compared):
        return ()
    from derive.render.notation.from_latex import in_plain_text  # needed by few problems

    found: list[tuple[int, SourceFault]] = []
    for told in compared:
        if told.erratum:
            of = told.erratum
            printed, right = (
                in_plain_text(quote) if quote else in_one_line(notation.result(value))
                for quote, value in ((of.quote, of.printed), (of.instead, of.right))
            )
            found.append((of.line or 0, ("erratum", str(of.line or ""), printed, right, in_plain_text(of.why))))
        if told.remark:
            note = told.remark
            told_in_words = (in_plain_text(note.quote), "", in_plain_text(note.why))
            found.append((note.line or 0, ("remark", str(note.line or ""), *told_in_words)))
    return tuple(fault for _, fault in sorted(found, key=lambda each: each[0]))


def _grades(solved: Solved) -> dict[str, int]:
    counts = solved.derivation.grades()
    for step in solved.values.values():
        for evidence in step.evidence:
            counts[evidence.grade.value] += 1
    return counts
