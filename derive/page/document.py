"""The page as a tree, independent of formats: title, statement, parts, steps, answers, and checks.

Equations are numbered here, so every format and every reference has the same numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import accumulate
from typing import Any

from sympy import MatrixBase, preorder_traversal

from derive.algebra.dimensions import Dimension
from derive.algebra.equality import Compared
from derive.algebra.expressions import Amount, rate
from derive.algebra.kinds import unit_of_kind
from derive.course.names import EvidenceShown
from derive.course.parts import Question
from derive.course.placement import STATEMENT
from derive.course.problem import Problem
from derive.course.problem_file import ANY_OUTCOME
from derive.course.prose import FIGURE, TexFormula, latex_in
from derive.course.reference.comparison import Told
from derive.errors import Complaint, Place, did_you_mean
from derive.figures.marks import Plot, Recorded
from derive.page.assumptions import between_bounds, not_implied, says_the_same, with_units
from derive.page.chain_lines import ChainWriter, Equations, conditions_of, without_inserted
from derive.page.checks import checks_of, second_ways_of
from derive.page.clauses import Clauses, continues_sentence
from derive.page.closing import limiting_cases, limits_left_out, sort_of_cases
from derive.page.cross_references import References, found_before
from derive.page.depiction import (
    caption_numbers,
    depictions,
    keys_without_effect,
    leads_to,
    letters_not_drawn,
    misspelt,
    not_drawn,
    placed_after,
)
from derive.page.figures_named import figures_mentioned
from derive.page.formulas import Formulas
from derive.page.inline_formulas import in_words
from derive.page.introduced_symbols import references_in, wanting
from derive.page.names import page_names
from derive.page.numbering import Numbering
from derive.page.numbers_given import are_told, numbers_left, numbers_of_cases, take
from derive.page.paragraphs import without_short_paragraphs
from derive.page.pointers import pointed_out
from derive.page.reasons import framed_once, without_known_reasons
from derive.page.repeated_formulas import AGAIN, Stated, noted, results, told_by_number
from derive.page.selection import NOTHING_NEEDED, OWN, POINTED_OUT, TOLD, Needed, Selection
from derive.page.theorems import Theorems
from derive.page.tree import Block, Display, Document, Illustration, Paragraph, PartPage
from derive.page.unused import laws_without_steps, unused_definitions
from derive.page.wording import (
    Chain,
    Inline,
    Math,
    NewParagraph,
    Phrases,
    Ref,
    Text,
    around_chain,
    conversions,
    equation_of,
    filled,
    in_turn,
    joined,
    names_of_step,
    stated_once,
    told,
    unknown_keys,
    with_verdict,
)
from derive.steps.derivation import Derivation
from derive.steps.homogeneity import dimension_table
from derive.steps.step import NUMBERS, Level, Step

HIDDEN_STEP = "hidden"  # under `show:`, the value for a step whose lines the author hides
CASES = "cases"  # `<<cases>>` in a question prints the numbers of the cases of the plots in this part
HOMOGENEITY = "look for a law that has a wrong input"


def document_of(
    problem: Problem,
    derivation: Derivation,
    values: Mapping[str, Step],
    words: Phrases,
    level: Level,
    compared: Sequence[Told] = (),
    others: Mapping[str, int] | None = None,
    drawings: Sequence[Recorded] = (),
    evidence: EvidenceShown = EvidenceShown.NONE,
    like: Document | None = None,
) -> tuple[Document, list[Complaint]]:
    """Return the page and its errors, such as undefined names and lines that are not homogeneous.

    others   the problems of the set to which prose may refer: their numbers, by name
    like     a page of less detail, whose equation numbers this page uses
    """
    needed = NOTHING_NEEDED
    while True:
        writer = _Writer(problem, derivation, values, words, level, others or {}, drawings, needed, like)
        document = writer.document([c for c in compared if c.here], evidence)
        more = needed.with_more(*writer.needs(document))
        if more == needed and level is not Level.FULL:
            more = replace(needed, in_words={**needed.in_words, **in_words(document, derivation, problem.wording)})
        if more == needed:
            return document, [*writer.faults, *writer.without_number(document)]
        needed = more


class _Writer:
    """Visits the parts once, numbers equations and writes the words of steps."""

    def __init__(
        self,
        problem: Problem,
        derivation: Derivation,
        values: Mapping[str, Step],
        words: Phrases,
        level: Level,
        others: Mapping[str, int],
        drawings: Sequence[Recorded],
        needed: Needed,
        like: Document | None,
    ):
        self.problem, self.derivation, self.values, self.words, self.level = problem, derivation, values, words, level
        self.drawings = drawings
        self.theorems = Theorems(words, level)
        self.numbers = Numbering(like.numbers if like else None)
        self.shown_in: dict[str, str] = {}
        self.faults: list[Complaint] = []
        self.dimensions = dict(like.dimensions) if like else self._dimensions()
        self.formulas = Formulas(problem, self.dimensions, [*derivation.steps, *values.values()])
        figures = caption_numbers(problem, drawings, derivation)
        self.references = References(problem.set_id, others, figures, self._away(), words, self.faults)
        self.converted, self.stated = set[Any](), Stated()
        self.before: Step | None = None  # the last step shown; the words of the next step may depend on it
        self.rest: list[Step] = []  # the steps that the part shows after the current step
        # the last sentence of a step without lines refers to the lines of these steps
        self.pointed_to: tuple[Step, ...] = ()
        self.told_before = ""  # the key of a step that shares the sentence of the step before
        self.framed: set[str] = set()  # steps whose result is framed as an answer
        # Whether the current part frames a result even if an earlier part has framed this result. A part does so if it
        # has `box:` or only one framed answer.
        self.frames_again = False
        self.unplaced: set[str] = set()  # steps that the page has not yet described
        self.symbols = {step.key: step.symbol for step in derivation.steps}
        away, names = self.references.away, page_names(problem, derivation, words)
        self.page_names = {name: away.get(name, own) if isinstance(own, Ref) else own for name, own in names.items()}
        answered = [step for part in problem.parts for step in derivation.answering(part.answers)]
        self.asked = {step.key for step in answered}
        self.selection = Selection(derivation, level, self.asked, problem.show, problem.wording, needed, values)
        self.clauses = Clauses(words)
        drawn = [label for drawing in drawings if isinstance(drawing, Plot) for label in drawing.labels]
        self.lines = ChainWriter(derivation, values, words, self.page_names, self.numbers, drawn)

    def _dimensions(self) -> dict[Any, Dimension | None]:
        table, unlike = dimension_table(self.problem.dimensions, [*self.derivation.steps, *self.values.values()])
        # All lines that follow from a wrong line are wrong too, so only the first error is reported.
        self.faults += [replace(fault, place=self.problem.place_of("solve"), help=HOMOGENEITY) for fault in unlike[:1]]
        return {**table, **{a: self.problem.dimensions.get(letter) for letter, a in self.problem.every_amount}}

    def _away(self) -> dict[str, Inline]:
        """Return the equations of the steps that are only in parts that this level hides, by key."""
        here = [self.level.shows(part.detail) for part in self.problem.parts]
        shown = {key for keys, is_here in zip(self.derivation.parts, here, strict=True) if is_here for key in keys}
        steps = [self.derivation.step(key) for keys in self.derivation.parts for key in keys if key not in shown]
        return {step.key: equation_of(step) for step in steps}

    def document(self, compared: Sequence[Told], evidence: EvidenceShown) -> Document:
        problem = self.problem
        self.references.check_title(problem.title.mentions, self.page_names)
        in_question = self.formulas.in_question
        stated = self._told(problem.statement.pieces, formula=in_question)
        illustrations = self._illustrations()
        parts = tuple(self._part(i, part, illustrations) for i, part in enumerate(problem.parts))
        statement = stated_once(stated, self.words.labels["with"], self.words.labels["and"]) + self._assumed()
        asked = [node for part in parts for node in part.ask]
        statement += numbers_left(problem, [*statement, *asked], self.words)
        limits = None if self.level is Level.BRIEF else self._limits()
        in_solution = self.formulas.in_solution
        strategy = self._told(problem.strategy.pieces, formula=in_solution) if problem.strategy else ()
        paragraphs = [self._told(each, formula=in_solution) for each in problem.note.paragraphs] if problem.note else []
        note = tuple(node for i, each in enumerate(paragraphs) for node in (*([NewParagraph()] if i else []), *each))
        self.references.check(self.numbers, self.symbols)
        title = told(problem.title.pieces, self.page_names, self._unknown, formula=self.formulas.node)
        self.faults += self.formulas.faults
        checks = checks_of([*self.selection.steps, *self.values.values()], self.words, compared)
        self.faults += unknown_keys(problem, self.derivation, self.words)
        return Document(
            id=problem.id,
            title=title,
            points=problem.points,
            statement=statement,
            strategy=strategy,
            limits=limits,
            illustrations=tuple(illustrations),
            parts=parts,
            note=note,
            checks=checks,
            closing=checks.closing(self.words, evidence),
            numbers=self.numbers,
            symbols={**self.symbols, **{value.key: value.symbol for value in self.values.values()}},
            shown_in=self.shown_in,
            dimensions=self.dimensions,
            warnings=(
                # An author cannot edit a script that the engine writes, so warnings about unused results are left out.
                *(() if problem.described else self.derivation.warnings(problem.place_of("solve"))),
                *filter(None, map(latex_in, problem.texts)),
                *self.formulas.warnings,
                *unused_definitions(problem, self.derivation),
                *laws_without_steps(problem, self.derivation, self.words),
                *letters_not_drawn(problem, self.drawings),
                *keys_without_effect(problem, self.drawings),
                *misspelt(problem, self.drawings),
                *not_drawn(problem, self.drawings),
                *limits_left_out(problem, self.derivation),
            ),
            evidence=evidence,
        )

    def needs(self, document: Document) -> tuple[set[str], set[str]]:
        """Return the hidden steps whose symbols or equations the page needs."""
        shown = (document.title, document.statement, document.strategy, document.illustrations)
        whole = (shown, document.parts, document.limits, document.note)
        moving = {q for step in self.derivation.steps for q, _ in step.coordinates}
        known = {*self.problem.dimensions, *moving, *(rate(q, order) for q in moving for order in (1, 2))}
        steps = sorted(self.derivation.steps, key=lambda step: self.problem.show.get(step.key) == HIDDEN_STEP)
        letters = wanting(whole, {*self.numbers, *self.clauses.told}, steps, known)
        numbers = (references_in(whole) | self.references.named) & set(self.symbols) - set(self.numbers)
        could_stand = self.selection.could_stand
        defined = set(filter(could_stand, letters)) | set(filter(self._can_be_defined, letters))
        return defined, set(filter(could_stand, numbers))

    def _can_be_defined(self, key: str) -> bool:
        """Return whether a clause may define the symbol of this step."""
        step = self.derivation.step(key)
        if self.problem.show.get(key) != HIDDEN_STEP or not self.clauses.can_define(step):
            return False
        texts = self.problem.texts
        said = {name for prose in texts for formula in prose.formulas for name in formula.names}
        return not {step.symbol.name, key} & {*said, *(each.name for prose in texts for each in prose.mentions)}

    def without_number(self, document: Document) -> list[Complaint]:
        """Return an error for each hidden equation to which the sentence of another step refers."""
        wanted = references_in((document.parts, document.limits)) - {*self.numbers} - self.references.named
        return [
            Complaint(
                "not-shown",
                f"a sentence of the page refers to the equation of `{key}`, which is hidden",
                self.problem.place_of("show", key),
                help=f"write `{key}: result`, or change that sentence under `wording`",
            )
            for key in sorted(wanted)
            if self.problem.show.get(key) == "hidden"
        ]

    def _told(
        self,
        pieces: Any,
        names: Mapping[str, Any] | None = None,
        formula: Callable[[TexFormula], Inline] | None = None,
    ) -> tuple[Inline, ...]:
        names = {**self.page_names, **(names or {})}
        self.references.note(pieces, names)
        return told(pieces, names, self._unknown, self.references.node, formula or self.formulas.node)

    def _unknown(self, name: str, place: Place) -> None:
        help_line = (
            did_you_mean(name, self.page_names) or "use a key of `given:` or of a step on which the answers depend"
        )
        self.faults.append(
            Complaint("undefined-name", f"nothing on this page is called `{name}`", place, help=help_line)
        )

    def _assumed(self) -> tuple[Inline, ...]:
        """Return a sentence, to follow the statement, with the assumptions about symbols. Assumptions that the
        statement, a question or the words of a step already contain are left out."""
        assumed = [each for each in not_implied(self.derivation.assumed) if each not in self.derivation.in_words]
        assumed = [each for each in assumed if not any(says_the_same(each, other) for other in self.formulas.stated)]
        if not assumed:
            return ()
        units = {letter.symbol: unit_of_kind(letter.kind) for letter in self.problem.letters if letter.kind}
        stated = [with_units(each, units) for each in between_bounds(assumed)]
        conditions = joined([(Math(each),) for each in stated], self.words.labels["and"])
        return (Text(" "), *filled(self.words.labels["assumed"], {"conditions": conditions}))

    def _illustrations(self) -> list[Illustration]:
        found, faults = depictions(self.problem, self.drawings, self.derivation, self.words, self._told)
        self.faults += faults
        stem = self.problem.id.rpartition("/")[2]
        away = {chr(ord("a") + i) for i, part in enumerate(self.problem.parts) if not self.level.shows(part.detail)}
        here = [d for d in found if d.at not in away]  # drawings of parts that are not shown are left out
        own: list[Illustration] = []
        if figure := self.problem.figure:
            caption = self._told(figure.caption.pieces) if figure.caption else ()
            alt = self._told(figure.alt.pieces)
            number = self.references.figures.get(figure.key)
            own = [Illustration(figure.key, f"{stem}-{figure.key}", alt, number, caption, STATEMENT)]
        return own + [
            Illustration(
                d.key,
                f"{stem}-{d.key}",
                d.alt,
                d.number,
                d.caption,
                d.at,
                placed_after(d.drawing, d.placement),
                leads_to(d.drawing),
            )
            for d in here
        ]

    def _part(self, index: int, part: Question, illustrations: Sequence[Illustration]) -> PartPage:
        label = chr(ord("a") + index)
        if not self.level.shows(part.detail):
            return PartPage(label, (), None, (), part.extra, shown=False)
        answers = self.derivation.answering(part.answers)
        blocks: list[Block] = [Paragraph(nodes) for nodes in found_before(answers, self.shown_in, self.words)]
        begins: dict[str, int] = {}
        ends: dict[str, int] = {}
        self.before = None  # the first sentence of a part is a complete sentence
        boxed = {step.key for step in (answers if part.boxed is None else self.derivation.answering(part.boxed))}
        framed = self._framed(self.derivation.parts[index], {step.key for step in answers}, boxed)
        self.frames_again = len(framed) == 1 or part.boxed is not None
        for key in self.derivation.parts[index]:
            self.shown_in[key] = label
            begins[key] = len(blocks)
            self.rest = self.selection.standing_after(key, self.derivation.parts[index])
            step = self.selection.step(self.derivation.step(key))
            self._append(blocks, step, framed=key in framed, verdict=key in boxed and step.display.verdict)
            self.before = self.derivation.step(key) if self._is_told(key) else self.before
            ends |= dict.fromkeys(self._completed(key), len(blocks))
        blocks.extend([Paragraph(clause)] if (clause := (*self._clause(blocks), *self.clauses.begun())) else [])
        steps, self.rest = len(blocks), []
        values = [(s.key, v) for s in answers if (v := self.values.get(s.key)) and v.key not in self.numbers]
        for i, (key, value) in enumerate((key, v) for key, v in values if v.outcome != "exact"):
            self._append(blocks, value, goes_on=i > 0, framed=key in boxed and value.chain[-1].because in NUMBERS)
        in_cases = set(self.problem.keys_in_cases(part, boxed))
        for each in self.problem.keys_in_cases(part, [step.key for step in answers]):
            if (found := self.values.get(each)) is not None:
                self._append(blocks, found, framed=each in in_cases)
        blocks += [Paragraph(said) for said in [self._observed(index)] if said]
        own = [illustration for illustration in illustrations if illustration.at == label]
        placed = _illustrated(_punctuated(blocks), own, begins, ends, steps)
        drawings = {each.key: each for each in self.drawings}
        placed = figures_mentioned(placed, drawings, self._figures_named(), self.words)
        placed = framed_once(without_known_reasons(without_short_paragraphs(placed), self.numbers))
        return PartPage(label, self._question(label, part, illustrations), part.points, placed, part.extra)

    def _question(self, label: str, part: Question, drawings: Sequence[Illustration]) -> tuple[Inline, ...]:
        """Return the question of a part, with the numbers of the cases of a plot if the reader needs them."""
        mentioned = next((each for each in part.ask.mentions if each.name == CASES and not each.of), None)
        with_cases = {each.key: each.cases for each in self.problem.drawings if each.cases}
        there = [drawing for drawing in drawings if drawing.key in with_cases]
        plots = {part.cases, *(drawing.key for drawing in there if mentioned and drawing.at == label)}
        cases = [numbers for key, numbers in with_cases.items() if key in plots]
        if mentioned and not cases and CASES not in self.page_names:
            self.faults.append(_without_cases(mentioned.place, label, there))
            return ()
        numbers = joined([numbers_of_cases(each, self.words) for each in cases], self.words.labels["and"])
        asked = self._told(part.ask.pieces, {CASES: numbers} if cases else {}, self.formulas.in_question)
        if mentioned or all(are_told(each, asked) for each in cases):
            return asked
        return (*asked, *take(numbers, self.words))

    def _figures_named(self) -> set[str]:
        """Return the keys of the drawings that a text of the author mentions."""
        mentions = (mention for prose in self.problem.texts for mention in prose.mentions)
        return {mention.name for mention in mentions if mention.of == FIGURE}

    def _observed(self, index: int) -> tuple[Inline, ...]:
        keys = self.derivation.observed[index] if self.derivation.observed and self.level is not Level.BRIEF else ()
        said = [self._without_lines(self._phrase(self.derivation.step(key))) for key in keys]
        return tuple(node for i, nodes in enumerate(said) for node in ((Text(" "),) if i else ()) + nodes)

    def _without_lines(self, nodes: tuple[Inline, ...]) -> tuple[Inline, ...]:
        """Return the words for an observation, which has no lines."""
        kept = [node for node in nodes if not isinstance(node, Chain)]
        return (*kept[:-1], Text(kept[-1].text.rstrip())) if kept and isinstance(kept[-1], Text) else tuple(kept)

    def _limits(self) -> PartPage | None:
        """Return the limiting cases as the last part; None without limiting cases."""
        blocks: list[Block] = []
        for each in limiting_cases(self.problem, self.derivation, self.words, self._phrase, self._told, self.numbers):
            if isinstance(each, Step):
                self._append(blocks, self.selection.step(each))
                self.before = each
            else:
                blocks.append(Paragraph(each))
        title = self.words.labels[sort_of_cases(self.problem, self.derivation)]
        return PartPage("", (Text(title),), None, _punctuated(blocks)) if blocks else None

    def _framed(self, keys: Sequence[str], asked: Collection[str], boxed: Collection[str]) -> set[str]:
        derived = max((i for i, key in enumerate(keys) if key not in asked), default=-1)
        measured = {key for key in keys[derived + 1 :] if (v := self.values.get(key)) and v.outcome == "measured"}
        verdicts = {key for key in asked if self.derivation.step(key).display.verdict}
        return self.selection.standing_for(set(boxed) - measured - verdicts)

    def _append(
        self, blocks: list[Block], step: Step, goes_on: bool = False, framed: bool = False, verdict: bool = False
    ) -> None:
        """Add the words and lines of a step; a step that continues the step before needs no words.

        A hidden result that a part asks for appears without words.

        framed   whether the result is an answer, which is framed
        verdict  whether the answer is a word of the sentence, such as "stable"
        """
        mode = self.problem.show.get(step.key, "")
        if mode == HIDDEN_STEP and step.key not in self.asked or self.selection.is_behind_quoted(step.key):
            if step.key in self.selection.needed.letters:
                self.clauses.define_at_use(step)
            return
        if self._is_repeated(step):
            self.numbers[step.key] = self.numbers[step.display.repeats]
            return
        if (manner := self.selection.manner(step.key)) is not OWN:
            self.clauses.set_aside(step, manner is TOLD)
            if manner is POINTED_OUT:
                lines_of = self.selection.having_it(step)
                said = pointed_out(self._phrase(step), step, lines_of, self.words, again=lines_of == self.pointed_to)
                self.clauses.point_out(step, said)
                self.pointed_to = lines_of
            return
        follows_words = bool(blocks) and not isinstance(blocks[-1], Display)
        is_silent = goes_on or mode == HIDDEN_STEP or step.key == self.told_before
        nodes = (Chain(),) if is_silent else self._phrase(step, follows_words)
        nodes = (*self.theorems.before(step), *(with_verdict(nodes, self.words) if verdict else nodes))
        self.numbers.add(step.key)
        lines = self.stated.without_repeats(self.lines.of(self.theorems.without_law(step), mode), self.symbols.values())
        if self.level is not Level.FULL:
            short = [each.symbol for each in self.clauses.waiting] if self.level is Level.BRIEF else []
            lines = without_inserted(
                lines, [*short, *(self.symbols[key] for key in self.symbols if self._is_told(key))]
            )
        again = self.stated.noted(step.key, lines)
        if again is not None and step.outcome in AGAIN and nodes == (Chain(),) and self.level is not Level.FULL:
            self.numbers[step.key] = self.numbers[again]
            return  # the sentence of the step before is about this step too
        if again is not None and (sentence := told_by_number(step, nodes, self.level)):
            self.numbers[step.key] = self.numbers[again]
            blocks.append(Paragraph((*self._clause(blocks), *self.clauses.begun(), *sentence)))
            return
        lines = noted(lines, self.words.beside_answer(step, again)) if framed else lines
        count = results(step, lines) if framed and (again not in self.framed or self.frames_again) else 0
        self.framed |= {step.key} if count else set()
        conditions = conditions_of(step) if count else ()
        lines, count = (*lines, *conditions), count + len(conditions)
        equations = Equations(step.key, lines, self.numbers[step.key], count)
        before, after = around_chain(nodes)
        if step.key in self.selection.needed.in_words and step.key not in self.selection.needed.numbers:
            blocks.append(
                Paragraph((*self._clause(blocks), *self.clauses.begun(), *self._in_words(step, before, after)))
            )
            return
        routes, checks = (second_ways_of(step, sort, self.words) for sort in (Compared.ROUTE, Compared.CHECK))
        display = Display((equations,), frozenset({step.grade}), routes, checks=checks)
        if blocks and isinstance(blocks[-1], Display) and (not before or self._is_only_and(before)):
            beside = self._share_a_row(step, equations, blocks[-1].groups[-1])
            blocks[-1] = blocks[-1].with_more(display, beside)
            if beside:
                self.numbers[step.key] = blocks[-1].groups[-1].number
        else:
            before = (*self.clauses.begun(), *before)
            before = (*self._clause(blocks, before), *before)
            self.clauses.said = before
            blocks.extend([Paragraph(before)] if before else [])
            blocks.append(display)
        if after:
            blocks.append(Paragraph(self.clauses.around(after, blocks[-1])))

    def _in_words(self, step: Step, before: Sequence[Inline], after: Sequence[Inline]) -> tuple[Inline, ...]:
        """Return the sentence of a step with its equation, which then has no number."""
        del self.numbers[step.key]
        self.clauses.told.add(step.key)
        is_named = self.selection.needed.in_words[step.key]
        told = equation_of(step) if is_named else Math(step.result)
        return (*before, told, Text("."), *([Text(" "), *after] if after else []))

    def _is_only_and(self, before: Sequence[Inline]) -> bool:
        return all(isinstance(n, Text) for n in before) and _text_of(before).strip() == self.words.labels["and"].strip()

    def _clause(self, blocks: Sequence[Block], following: Sequence[Inline] = ()) -> tuple[Inline, ...]:
        """Return a clause that defines waiting symbols in the lines just shown; it ends with a comma if the words that
        follow continue the sentence."""
        told = self.clauses.behind(blocks[-1]) if blocks and isinstance(blocks[-1], Display) else ()
        if told and following and continues_sentence(following) and isinstance(told[-1], Text):
            told = (*told[:-1], Text(told[-1].text.rstrip(".") + ","))
        return (*told, Text(" ")) if told else ()

    def _share_a_row(self, step: Step, own: Equations, above: Equations) -> bool:
        """Return whether a step and the step before may share a row and its number."""
        steps = (self.before, step)
        if self.level is Level.FULL or any(each is None or each.symbol is None for each in steps):
            return False
        if own.framed or above.framed:
            vectors = all(each and isinstance(each.result, MatrixBase) and each.result.cols == 1 for each in steps)
            if not (own.framed and above.framed and vectors):
                return False
        pair = (own, above)
        return all(e.lines[-1].left is not None and not any(line.reason for line in e.lines) for e in pair)

    def _following(self, key: str) -> Step | None:
        if self.level is Level.FULL or not self.rest or {key, self.rest[0].key} & set(self.problem.wording):
            return None
        return self.rest[0] if self.rest[0].display.told_along else None

    def _completed(self, key: str) -> set[str]:
        """Return the steps whose description is complete with this step."""
        self.unplaced.add(key)
        if not self._is_told(key):
            return set()
        found = {each for each in self.unplaced if self.selection.manner(each) is not TOLD or each in self.clauses.told}
        self.unplaced -= found
        return found

    def _is_told(self, key: str) -> bool:
        """Return whether the page has shown the equation of a step, in a display or in a sentence."""
        in_words = key in self.selection.needed.in_words and key in self.clauses.told
        return in_words or key in self.numbers and not self._is_repeated(self.derivation.step(key))

    def _is_repeated(self, step: Step) -> bool:
        """Return whether no part asks for this step, and its result is already an equation of the page."""
        return step.key not in self.asked and step.display.repeats in self.numbers

    def _phrase(self, step: Step, follows_words: bool = False) -> tuple[Inline, ...]:
        own = names_of_step(step, self.words, self.dimensions.get(step.symbol))
        override = self.problem.wording.get(step.key, {})
        own |= {"amounts": self._amounts(step), **in_turn(step, self.rest, self.words)}
        own |= {"slider": self.words.term("body")} if not self._states(dict(step.words).get("slider", "")) else {}
        prose = override.get(step.outcome) or override.get(ANY_OUTCOME)
        if prose is not None:
            nodes = self._told(prose.pieces, own, partial(self.formulas.in_solution, key=step.key))
            return nodes if any(isinstance(node, Chain) for node in nodes) else (*nodes, Text(" "), Chain())
        both = self.words.of_both(step, following) if (following := self._following(step.key)) else ""
        self.told_before = following.key if following and both else ""
        if following and both:
            own = {**names_of_step(following, self.words, self.dimensions.get(following.symbol)), **own}
        said = filled(both or self.words.phrase(step, self.before), own)  # a phrase cannot mention keys of other steps
        return filled(self.words.phrase(step), own) if follows_words and continues_sentence(said) else said

    def _states(self, name: str) -> bool:
        """Return whether the statement uses the name that the author gave to a body."""
        return name.casefold() in self.problem.statement.text.casefold()

    def _amounts(self, step: Step) -> tuple[Inline, ...]:
        """Return the unit conversions of the numbers that this step is the first to substitute."""
        used = {node for form in step.chain for node in preorder_traversal(form.expr) if isinstance(node, Amount)}
        new, self.converted = used - self.converted, self.converted | used
        return joined(conversions(self.problem, new), self.words.labels["and"])


def _text_of(nodes: Sequence[Inline]) -> str:
    return "".join(node.text for node in nodes if isinstance(node, Text))


def _without_cases(place: Place, label: str, plots: Sequence[Illustration]) -> Complaint:
    """Return the error for `<<cases>>` in a part without a plot that has cases; `plots` are the plots with cases
    elsewhere."""
    help_line = "give `cases` to a plot in this part"
    if plots:
        key, at = plots[0].key, plots[0].at
        where = "the statement" if at == STATEMENT else f"part {at}"
        help_line = f"the plot `{key}` is in {where}: mention `<<{CASES}>>` there, or move the plot with `at: {label}`"
    message = f"`<<{CASES}>>` prints the numbers of a plot in the same part, but no plot in part {label} has `cases`"
    return Complaint("undefined-name", message, place, help=help_line)


def _punctuated(blocks: list[Block]) -> tuple[Block, ...]:
    """End a display with a comma if the next block continues the sentence."""
    result: list[Block] = []
    for block, following in zip(blocks, [*blocks[1:], None], strict=True):
        if isinstance(block, Display) and following is not None and _goes_on(following):
            block = replace(block, end=",")
        result.append(block)
    return tuple(result)


def _parts_nothing(blocks: Sequence[Block], i: int) -> bool:
    """Return whether a drawing may precede this block: words stay next to the lines that they describe."""
    introduced = i > 0 and isinstance(blocks[i - 1], Paragraph) and isinstance(blocks[i], Display)
    return not introduced and not (i > 0 and _goes_on(blocks[i]))


def _goes_on(block: Block) -> bool:
    return isinstance(block, Paragraph) and continues_sentence(block.nodes)


def _illustrated(
    blocks: tuple[Block, ...],
    own: Sequence[Illustration],
    begins: Mapping[str, int],
    ends: Mapping[str, int],
    steps: int,
) -> tuple[Block, ...]:
    """Insert each drawing before the first of its steps in `leads_to`, or after the last of its steps in `rests_on`; a
    drawing without steps begins the part. Words stay next to the lines that they describe, so a drawing may move by
    some blocks."""
    without = [steps if drawing.rests_on else 0 for drawing in own]
    completed = [
        min((begins[k] for k in d.leads_to if k in begins), default=0)
        if d.leads_to
        else max((ends[k] for k in d.rests_on if k in ends), default=n)
        for d, n in zip(own, without, strict=True)
    ]
    places = [
        next(i for i in range(place, -1, -1) if i == 0 or _parts_nothing(blocks, i))
        if drawing.leads_to
        else next(i for i in range(place, steps + 1) if i == steps or _parts_nothing(blocks, i))
        for drawing, place in zip(own, completed, strict=True)
    ]
    places = list(accumulate(places, max))  # the drawings stay in the order of their numbers
    before_values = steps if steps < len(blocks) and _parts_nothing(blocks, steps) else steps - 1
    found: list[Block] = []
    for i, block in enumerate(blocks):
        found += [drawing for drawing, place in zip(own, places, strict=True) if place == i <= before_values]
        found.append(block)
    return (*found, *(drawing for drawing, place in zip(own, places, strict=True) if place > before_values))
