"""Graded hints derived from a solution: first what to compute, then the law, then the next lines.

A line gives the result away if nothing is left to do: no result to substitute, no derivative or integral to
evaluate. Hints omit such a line and all lines after it. A step that only substitutes numbers has no hint.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from sympy import Basic, Derivative, Integral, MatrixBase, Symbol

from derive.algebra.equality import equal
from derive.algebra.expressions import BLANK, MassIntegral, Partial, Relation, Slope, TimeRate, explicit, rate
from derive.course.problem import Problem
from derive.course.transcript import Transcript
from derive.page.chain_lines import ChainLine, Equations
from derive.page.clauses import Clauses
from derive.page.folding import Sentence, sentences
from derive.page.introduced import expressions_in, letters_in, letters_of, wanting
from derive.page.tree import Block, Display, Document, Folded, Paragraph, PartPage
from derive.page.wording import Inline, Math, Phrases, Text
from derive.steps.derivation import Derivation
from derive.steps.step import NUMBERS, Step

_FULL_STOP = re.compile(r"[.:] (?=[A-Z]|$)")
TO_BE_DONE = (Derivative, Integral, MassIntegral, Partial, Slope, TimeRate)


def with_hints(
    document: Document, problem: Problem, derivation: Derivation, values: Mapping[str, Step], words: Phrases
) -> Document:
    """Return the page with hints instead of the derivation."""
    hints = _Hints([*derivation.steps, *values.values()], problem.dimensions, words)
    hints.answers = {_of(s.result) for part in problem.parts for s in derivation.answering(part.answers)}
    parts = tuple(hints.of(part) for part in document.parts_shown)
    return replace(document, parts=parts, limits=None, note=(), closing=())


@dataclass
class _Hints:
    """The hints of one page.

    introduced  symbols that the statement or a hint has explained
    """

    steps: Sequence[Step]
    given: Collection[Any]
    words: Phrases
    answers: set[Any] = field(default_factory=set)

    def __post_init__(self) -> None:
        moving = {q for step in self.steps for q, _ in step.coordinates}
        self.introduced = {*self.given, *moving, *(rate(q, order) for q in moving for order in (1, 2))}
        self.by_key = {step.key: step for step in self.steps}
        self.names = {letter for step in self.steps for letter in letters_of(step.symbol)}
        self.results = {found for step in self.steps if not getattr(found := _of(step.result), "is_Atom", False)}
        self.clauses = Clauses(self.words)

    def of(self, part: PartPage) -> PartPage:
        """Return the part with folded hints in place of its blocks."""
        titles = self.words.labels["hints"]
        told = [each for each in sentences(part.blocks) if any(isinstance(block, Display) for block in each)]
        rungs = (
            ("first", [block for sentence in told for block in self._what(sentence)]),
            ("law", [block for sentence in told for block in self._cut(sentence, slice(1))]),
            ("goes_on", [block for sentence in told for block in self._cut(sentence, slice(1, None))]),
        )
        found = tuple(Folded(tuple(blocks), titles[name]) for name, blocks in rungs if blocks)
        return replace(part, blocks=found)

    def _what(self, sentence: Sentence) -> list[Block]:
        """Return the first hint of a sentence: the words before each display, and the display with ? in place of
        results. Of the words before an answer only the last sentence remains: the others may state a verdict."""
        found: list[Block] = []
        before: list[Block] = []
        for block in sentence:
            if isinstance(block, Display):
                sought = tuple(replace(group, lines=self._sought(group), framed=0) for group in block.groups)
                found += [*before, replace(block, groups=sought, end="")]
                before = []
            elif isinstance(block, Paragraph):
                nodes = _last_sentence(block.nodes) if _is_answer_next(sentence, block) else block.nodes
                before += [Paragraph(nodes)] if not self._tells(nodes) else []
        self._introduce(letters_in(expressions_in(found)))
        return found

    def _sought(self, group: Equations) -> tuple[ChainLine, ...]:
        """Return T = ?; for a relation return ? = ?, or ? = 0 if the right side is 0."""
        firsts = [lines[0] for lines in group.chains]
        if self.by_key[group.key].symbol is not None or isinstance(firsts[0].left, Symbol):
            return tuple(ChainLine(line.left, line.relation, BLANK, beside=line.beside) for line in firsts)
        return (ChainLine(BLANK, firsts[0].relation, firsts[0].right if firsts[0].right == 0 else BLANK),)

    def _cut(self, sentence: Sentence, rung: slice) -> list[Block]:
        """Return the law of each chain in a sentence, or the lines after the law, as `rung` selects; results are left
        out."""
        found: list[Block] = []
        for display in (block for block in sentence if isinstance(block, Display)):
            groups = tuple(cut for group in display.groups if (cut := self._part_of(group, rung)))
            due = self._due(groups)
            clause = self.clauses.meanings(due)
            found += [replace(display, groups=groups, end="," if clause else ".")] if groups else []
            found += [Paragraph(clause)] if clause else []
        return found

    def _due(self, shown: Any) -> list[Step]:
        """Return the steps whose symbols first appear in `shown`, and mark these symbols as introduced."""
        due = wanting(shown, set(), self.steps, self.introduced)
        found = [step for step in self.steps if step.key in due]
        self._introduce({letter for step in found for letter in letters_of(step.symbol)})
        return found

    def _introduce(self, letters: set[Any]) -> None:
        """Mark symbols as introduced; a vector also introduces its components."""
        known = [letters_of(step.symbol) for step in self.steps]
        self.introduced |= letters.union(*(each for each in known if each & letters))

    def _part_of(self, group: Equations, rung: slice) -> Equations | None:
        lines = tuple(line for chain in group.chains for line in self._kept(chain, self.by_key[group.key], rung))
        return replace(group, lines=lines, framed=0) if lines else None

    def _kept(self, chain: Sequence[ChainLine], step: Step, rung: slice) -> list[ChainLine]:
        """Return the lines of a chain for one hint; the first line has the left side of the chain."""
        lines = [*_law_behind(chain, step), *(line for line in chain if not line.numeric)]
        if lines[0].because != "law" or any(form.because in NUMBERS for form in step.chain):
            return []
        told = next(
            i for i, line in enumerate(lines) if line is lines[-1] or self._tells_a_result(line, lines[-1], step)
        )
        kept = lines[:told][rung]
        if kept and kept[0].left is None:
            kept[0] = replace(kept[0], left=lines[0].left)
        return kept

    def _tells_a_result(self, line: ChainLine, result: ChainLine, step: Step) -> bool:
        """Return whether nothing is left to do in the line, or whether its right side is the result of some step."""
        names = self.names - letters_in(_sides(result, step)) - letters_of(step.symbol)
        has_names = bool(letters_in(_sides(line, step)) & names)
        return not (has_names or _is_to_be_done(line) and not _is_to_be_done(result)) or _of(line.right) in self.results

    def _tells(self, nodes: Sequence[Inline]) -> bool:
        """Return whether a formula in the words is an answer."""
        written = [node.expr for node in nodes if isinstance(node, Math) and not isinstance(node.expr, Symbol)]
        formulas = [value for each in written for value in (each.values if isinstance(each, Transcript) else (each,))]
        return any(_of(formula) in self.answers or self._is_answer(formula) for formula in formulas)

    def _is_answer(self, formula: Any) -> bool:
        """Return whether a formula equals an answer; a law with a derivative or integral to evaluate does not count."""
        is_plain = isinstance(formula, Basic) and not formula.is_Atom and not formula.has(*TO_BE_DONE)
        return is_plain and any(equal(formula, answer) for answer in self.answers)


def _is_answer_next(sentence: Sentence, block: Block) -> bool:
    """Return whether the display after a paragraph contains an answer."""
    following = next((each for each in sentence[sentence.index(block) :] if isinstance(each, Display)), None)
    return following is not None and any(group.framed for group in following.groups)


def _last_sentence(nodes: Sequence[Inline]) -> tuple[Inline, ...]:
    """Return the nodes after the last full stop that another sentence follows."""
    for i in range(len(nodes) - 1, -1, -1):
        node = nodes[i]
        if isinstance(node, Text) and (ends := [*_FULL_STOP.finditer(node.text)]):
            return (Text(node.text[ends[-1].end() :]), *nodes[i + 1 :])
    return tuple(nodes)


def _law_behind(chain: Sequence[ChainLine], step: Step) -> list[ChainLine]:
    """Return the law of a step if the page omits the law because a theorem or an earlier equation states it."""
    law = step.chain[0]
    if law.because != "law" or chain[0].because == "law" or not isinstance(law.expr, Relation):
        return []
    return [ChainLine(law.expr.left, law.expr.word, law.expr.right, because="law")]


def _sides(line: ChainLine, step: Step) -> list[Any]:
    """Return the expressions of a line: both sides for a relation, else the right side."""
    return [line.right] if step.symbol is not None else [line.left, line.right]


def _is_to_be_done(line: ChainLine) -> bool:
    sides = [side for side in (line.left, line.right) if isinstance(side, Basic | MatrixBase)]
    return any(side.has(*TO_BE_DONE) for side in sides)


def _of(value: Any) -> Any:
    """Return a value in a standard form, so that formulas that are only written differently compare as equal."""
    return explicit(value) if isinstance(value, Basic | MatrixBase) else value
