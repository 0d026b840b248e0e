"""Graded hints derived from a solution: first what to find and in which order, then the laws, then the next lines.

A line gives the result away if its right side is a result, or if nothing remains to be substituted or evaluated. Hints
omit this line and the lines after it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from sympy import Basic, Derivative, Integral, MatrixBase, MatrixSymbol, Symbol

from derive.algebra.equality import equal
from derive.algebra.expressions import MassIntegral, Partial, Relation, Slope, TimeRate, explicit, rate
from derive.course.problem import Problem
from derive.course.transcript import Transcript
from derive.page.chain_lines import ChainLine, Equations
from derive.page.clauses import Clauses
from derive.page.folding import Sentence, groups_in, sentences
from derive.page.introduced_symbols import expressions_in, letters_in, letters_of, wanting
from derive.page.tree import Block, Display, Document, Folded, Paragraph, PartPage
from derive.page.wording import Inline, Math, Phrases, Text, filled
from derive.steps.derivation import Derivation
from derive.steps.step import NUMBERS, Step

LETTERS = Symbol, MatrixSymbol, type(None)  # None for a relation, which has no symbol
TO_BE_DONE = (Derivative, Integral, MassIntegral, Partial, Slope, TimeRate)


def with_hints(
    document: Document, problem: Problem, derivation: Derivation, values: Mapping[str, Step], words: Phrases
) -> Document:
    """Return the page with hints instead of the derivation."""
    hints = _Hints([*derivation.steps, *values.values()], problem.dimensions, words)
    asked = [step for part in problem.parts for step in derivation.answering(part.answers)]
    hints.answers = {_of(step.result) for step in asked}
    hints.shown = {part for step in derivation.steps if step.key in document.numbers for part in _parts(step.result)}
    hints.worded_answers = {step.key for step in asked if step.key in problem.wording}
    parts = tuple(hints.of(part) for part in document.parts_shown)
    return replace(document, parts=parts, limits=None, note=(), closing=())


@dataclass
class _Hints:
    """The hints of one page.

    given           symbols of the problem
    answers         results that the parts ask for
    shown           the results on the page; for a vector or a tensor, its components
    introduced      symbols that the statement or a hint has explained
    worded_answers  keys of the answers whose sentence the author wrote; this sentence may give the answer away
    """

    steps: Sequence[Step]
    given: Collection[Any]
    words: Phrases
    answers: set[Any] = field(default_factory=set)
    shown: set[Any] = field(default_factory=set)
    worded_answers: set[str] = field(default_factory=set)

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
            ("first", self._in_order([group for sentence in told for group in groups_in(sentence)])),
            ("law", [block for sentence in told for block in self._laws(sentence)]),
            ("goes_on", [block for sentence in told for block in self._cut(sentence, slice(1, None))]),
        )
        found = tuple(Folded(tuple(blocks), titles[name]) for name, blocks in rungs if blocks)
        return replace(part, blocks=found)

    def _in_order(self, groups: Sequence[Equations]) -> list[Block]:
        formulas = [group for group in groups if not any(f.because in NUMBERS for f in self.by_key[group.key].chain)]
        items: list[tuple[str, list[Any]]] = []
        for group in formulas or groups:
            step = self.by_key[group.key]
            letters = [] if step.symbol is None else [lines[0].left for lines in group.chains]
            name = self._name(step)
            if name and items and items[-1][0] == name:
                items[-1][1].extend(letters)
            elif letters or name:
                items.append((name, letters))
        if not items:
            return []
        self._introduce(letters_in(expressions_in([each for _, letters in items for each in letters])))
        told = [self._item(name, letters) for name, letters in items]
        listed = tuple(node for nodes in told for node in (self.words.semicolon, *nodes))[1:]
        return [Paragraph(filled(self.words.labels["sought"], {"items": listed, "several": len(told) > 1}))]

    def _name(self, step: Step) -> str:
        """Return the name of the quantity that a step derives."""
        if step.rule in self.words.labels["unnamed"] or not isinstance(step.symbol, LETTERS):
            return ""
        name = self.words.rule(step.rule)
        if step.symbol is not None:
            return name
        (told,) = filled(self.words.labels["of_relation"], {"name": name})
        return told.text if isinstance(told, Text) else name

    def _item(self, name: str, letters: Sequence[Any]) -> tuple[Inline, ...]:
        """Return symbols followed by their common name: `I_1, I_2 (principal moment)`."""
        shown = tuple(node for i, each in enumerate(letters) for node in ((Text(", "),) if i else ()) + (Math(each),))
        if not shown:
            return (Text(name),)
        return (*shown, Text(f" ({name})")) if name else shown

    def _laws(self, sentence: Sentence) -> list[Block]:
        """Return the laws of a sentence. Its words precede the laws, unless the words may contain an answer."""
        words = [block for block in sentence[:1] if isinstance(block, Paragraph) and not self._tells(block.nodes)]
        is_safe = not any(group.key in self.worded_answers for group in groups_in(sentence))
        laws = self._cut(sentence, slice(1))
        if not (laws and is_safe):
            return laws
        self._introduce(letters_in(expressions_in(words)))
        return [*words, *laws]

    def _cut(self, sentence: Sentence, rung: slice) -> list[Block]:
        """Return the law of each chain in a sentence, or the lines after the law, as the slice `rung` selects."""
        found: list[Block] = []
        for display in (block for block in sentence if isinstance(block, Display)):
            groups = tuple(cut for group in display.groups if (cut := self._part_of(group, rung)))
            due = self._due(groups)
            clause = self.clauses.meanings([step for step in due if self.shown.isdisjoint(_parts(step.result))])
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
        """Return the lines of a chain for one hint."""
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
        names = self.names - letters_in(_sides(result, step)) - letters_of(step.symbol)
        has_names = bool(letters_in(_sides(line, step)) & names)
        return not (has_names or _is_to_be_done(line) and not _is_to_be_done(result)) or _of(line.right) in self.results

    def _tells(self, nodes: Sequence[Inline]) -> bool:
        """Return whether a formula in the words is an answer."""
        written = [node.expr for node in nodes if isinstance(node, Math) and not isinstance(node.expr, Symbol)]
        formulas = [value for each in written for value in (each.values if isinstance(each, Transcript) else (each,))]
        return any(_of(formula) in self.answers or self._is_answer(formula) for formula in formulas)

    def _is_answer(self, formula: Any) -> bool:
        is_plain = isinstance(formula, Basic) and not formula.is_Atom and not formula.has(*TO_BE_DONE)
        return is_plain and any(equal(formula, answer) for answer in self.answers)


def _law_behind(chain: Sequence[ChainLine], step: Step) -> list[ChainLine]:
    """Return the law of a step if the page omits the law because a theorem or an earlier equation states it."""
    law = step.chain[0]
    if law.because != "law" or chain[0].because == "law" or not isinstance(law.expr, Relation):
        return []
    return [ChainLine(law.expr.left, law.expr.word, law.expr.right, because="law")]


def _sides(line: ChainLine, step: Step) -> list[Any]:
    """Return the expressions of a line that may give a result away."""
    return [line.right] if step.symbol is not None else [line.left, line.right]


def _is_to_be_done(line: ChainLine) -> bool:
    sides = [side for side in (line.left, line.right) if isinstance(side, Basic | MatrixBase)]
    return any(side.has(*TO_BE_DONE) for side in sides)


def _parts(value: Any) -> list[Any]:
    """Return the formulas in a value: the value itself, or the components of a vector or tensor."""
    found = _of(value)
    components = list(found) if isinstance(found, MatrixBase) else [found]
    return [each for each in components if not getattr(each, "is_Atom", False)]


def _of(value: Any) -> Any:
    return explicit(value) if isinstance(value, Basic | MatrixBase) else value
