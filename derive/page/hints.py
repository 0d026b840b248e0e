"""A ladder of hints, made of a solution: what to compute next, then its law, then how it goes on.

A line tells its result where nothing of it is left to do: neither another result to put in, nor a derivative or an
integral to carry out. Such a line is on no rung, and neither is what follows from it; a number has no law.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

from sympy import Basic, Derivative, Integral, MatrixBase, Symbol

from derive.algebra.equality import equal
from derive.algebra.expressions import BLANK, MassIntegral, Partial, Relation, Slope, TimeRate, explicit, rate
from derive.course.problem import Problem
from derive.page.chain_lines import ChainLine, Equations
from derive.page.clauses import Clauses
from derive.page.folding import Sentence, sentences
from derive.page.introduced import expressions_in, letters_in, letters_of, wanting
from derive.page.tree import Block, Display, Document, Folded, Paragraph, PartPage
from derive.page.wording import Inline, Math, Phrases
from derive.steps.derivation import Derivation
from derive.steps.step import Step

OF_NUMBERS = "numeric."  # the rules of steps that only put numbers in
TO_BE_DONE = (Derivative, Integral, MassIntegral, Partial, Slope, TimeRate)


def with_hints(
    document: Document, problem: Problem, derivation: Derivation, values: Mapping[str, Step], words: Phrases
) -> Document:
    """The page with its hints in place of what is derived."""
    hints = _Hints([*derivation.steps, *values.values()], problem.dimensions, words)
    hints.answers = {_of(s.result) for part in problem.parts for s in derivation.answering(part.answers)}
    parts = tuple(hints.of(part) for part in document.parts_shown)
    return replace(document, parts=parts, limits=None, note=(), closing=())


@dataclass
class _Hints:
    """Those of one page.

    introduced  letters that need no word any more
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
        """A part with its rungs, each folded."""
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
        """The words that lead to a display, and what they lead to, as yet unknown."""
        found: list[Block] = []
        before: list[Block] = []
        for block in sentence:
            if isinstance(block, Display):
                sought = tuple(replace(group, lines=self._sought(group), framed=0) for group in block.groups)
                found += [*before, replace(block, groups=sought, end="")]
                before = []
            elif isinstance(block, Paragraph) and not self._tells(block.nodes):
                before.append(block)
        self._introduce(letters_in(expressions_in(found)))
        return found

    def _sought(self, group: Equations) -> tuple[ChainLine, ...]:
        """T = ?; of an equation its left side too is sought, if it is no plain letter."""
        firsts = [lines[0] for lines in _chains(group)]
        if self.by_key[group.key].symbol is not None or isinstance(firsts[0].left, Symbol):
            return tuple(ChainLine(line.left, line.relation, BLANK, beside=line.beside) for line in firsts)
        return (ChainLine(BLANK, firsts[0].relation, firsts[0].right if firsts[0].right == 0 else BLANK),)

    def _cut(self, sentence: Sentence, rung: slice) -> list[Block]:
        """Of the chains of a sentence the law, or what follows it, as far as it tells no result."""
        found: list[Block] = []
        for display in (block for block in sentence if isinstance(block, Display)):
            groups = tuple(cut for group in display.groups if (cut := self._part_of(group, rung)))
            due = self._due(groups)
            clause = self.clauses.meanings(due)
            found += [replace(display, groups=groups, end="," if clause else ".")] if groups else []
            found += [Paragraph(clause)] if clause else []
        return found

    def _due(self, shown: Any) -> list[Step]:
        """The steps whose letters are shown for the first time, and that no rung has."""
        due = wanting(shown, set(), self.steps, self.introduced)
        found = [step for step in self.steps if step.key in due]
        self._introduce({letter for step in found for letter in letters_of(step.symbol)})
        return found

    def _introduce(self, letters: set[Any]) -> None:
        """A vector brings its components along."""
        known = [letters_of(step.symbol) for step in self.steps]
        self.introduced |= letters.union(*(each for each in known if each & letters))

    def _part_of(self, group: Equations, rung: slice) -> Equations | None:
        lines = tuple(line for chain in _chains(group) for line in self._kept(chain, self.by_key[group.key], rung))
        return replace(group, lines=lines, framed=0) if lines else None

    def _kept(self, chain: Sequence[ChainLine], step: Step, rung: slice) -> list[ChainLine]:
        """The lines of a rung, the first of which has the left side."""
        lines = [*_law_behind(chain, step), *(line for line in chain if not line.numeric)]
        if step.rule.startswith(OF_NUMBERS) or lines[0].because != "law":
            return []
        told = next(
            i for i, line in enumerate(lines) if line is lines[-1] or self._tells_a_result(line, lines[-1], step)
        )
        kept = lines[:told][rung]
        if kept and kept[0].left is None:
            kept[0] = replace(kept[0], left=lines[0].left)
        return kept

    def _tells_a_result(self, line: ChainLine, result: ChainLine, step: Step) -> bool:
        """Whether nothing of it is left to do, or it is what another step has found."""
        names = self.names - letters_in(_sides(result, step)) - letters_of(step.symbol)
        has_names = bool(letters_in(_sides(line, step)) & names)
        return not (has_names or _is_to_be_done(line) and not _is_to_be_done(result)) or _of(line.right) in self.results

    def _tells(self, nodes: Sequence[Inline]) -> bool:
        """Whether the words themselves have an answer in them."""
        formulas = [node.expr for node in nodes if isinstance(node, Math) and not isinstance(node.expr, Symbol)]
        return any(_of(formula) in self.answers or self._is_answer(formula) for formula in formulas)

    def _is_answer(self, formula: Any) -> bool:
        """Whether it is one, written differently; a general law is none, though for some letters it says 0 = 0."""
        is_plain = isinstance(formula, Basic) and not formula.is_Atom and not formula.has(*TO_BE_DONE)
        return is_plain and any(equal(formula, answer) for answer in self.answers)


def _chains(group: Equations) -> Iterator[tuple[ChainLine, ...]]:
    """The lines of each step that stands in them; of a list of results each is one."""
    starts = [
        i for i, line in enumerate(group.lines) if not i or line.beside or (line.left is not None and not line.because)
    ]
    return (group.lines[i:j] for i, j in pairwise([*starts, len(group.lines)]))


def _law_behind(chain: Sequence[ChainLine], step: Step) -> list[ChainLine]:
    """The law of an equation that the page leaves out, for a theorem or an equation before it has said it."""
    law = step.chain[0]
    if law.because != "law" or chain[0].because == "law" or not isinstance(law.expr, Relation):
        return []
    return [ChainLine(law.expr.left, law.expr.word, law.expr.right, because="law")]


def _sides(line: ChainLine, step: Step) -> list[Any]:
    """What it says: of an equation both sides."""
    return [line.right] if step.symbol is not None else [line.left, line.right]


def _is_to_be_done(line: ChainLine) -> bool:
    sides = [side for side in (line.left, line.right) if isinstance(side, Basic | MatrixBase)]
    return any(side.has(*TO_BE_DONE) for side in sides)


def _of(value: Any) -> Any:
    """A value as it is compared: as one formula, however it is written."""
    return explicit(value) if isinstance(value, Basic | MatrixBase) else value
