"""Theorems in their general form: each appears once on a page, before the first step that uses it.

A page is part of several documents: of its problem and of its set. So it has the words for both, and the typeset
document chooses: it states a theorem once, and a later problem names the problem that stated it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from derive.mechanics.theorems import THEOREMS
from derive.page.tree import Block, Document, Folded, Paragraph, PartPage
from derive.page.wording import Inline, Math, Phrases, ToldIn, ToldOnce, filled
from derive.steps.rule import Theorem
from derive.steps.step import Level, Step


def alone(document: Document) -> Document:
    """Return the page as a separate document: a paragraph before the sentence that uses a theorem states it."""

    def of_part(part: PartPage) -> PartPage:
        return replace(part, blocks=tuple(_paragraphs(part.blocks)))

    limits = document.limits and of_part(document.limits)
    return replace(document, parts=tuple(of_part(part) for part in document.parts), limits=limits)


def _paragraphs(blocks: Iterable[Block]) -> Iterator[Block]:
    for block in blocks:
        match block:
            case Paragraph(nodes):
                yield from (Paragraph(node.nodes) for node in nodes if isinstance(node, ToldOnce))
                if rest := tuple(node for node in nodes if not isinstance(node, ToldOnce)):
                    yield Paragraph(rest)
            case Folded(inside, title):
                yield Folded(tuple(_paragraphs(inside)), title)
            case _:
                yield block


class Theorems:
    """The theorems that the page has not stated yet; a brief page only names them, in the sentences of its steps.

    A full page has every line, including the laws of its steps, so it needs no theorem that states them before.
    """

    def __init__(self, words: Phrases, level: Level, steps: Iterable[Step] = ()):
        self._words, self._steps, self._drops_laws = words, tuple(steps), level is Level.STANDARD
        self._left = [] if level is Level.BRIEF else [t for t in THEOREMS if self._drops_laws or not t.prepared]
        self._told: list[Theorem] = []

    def before(self, step: Step) -> tuple[Inline, ...]:
        """Return the theorems to state before that step, at the beginning of its sentence."""
        used = [theorem for theorem in self._left if self._is_told_at(theorem, step)]
        self._left = [theorem for theorem in self._left if theorem not in used]
        self._told += used
        told: list[Inline] = []
        for theorem in used:
            letters = {name: Math(letter) for name, letter in theorem.letters.items()}
            nodes = filled(self._words.theorems[theorem.name], {"formula": Math(theorem.formula), **letters})
            first = ToldIn(self._words.labels["problem"])
            again = filled(self._words.theorems_again[theorem.name], {"problem": first})
            told.append(ToldOnce(theorem.name, nodes, again))
        return tuple(told)

    def without_law(self, step: Step) -> Step:
        """Return the step without the line that repeats a theorem."""
        said = any(theorem.name in step.law_in for theorem in self._told)
        if not (said and self._drops_laws and len(step.chain) > 1 and step.chain[0].because == "law"):
            return step
        return replace(step, chain=step.chain[1:])

    def _is_told_at(self, theorem: Theorem, step: Step) -> bool:
        if not theorem.prepared:
            return _uses(step, theorem)
        resting = (other for other in self._steps if step.key in other.inputs)
        return step.prepares == theorem.name and any(_uses(other, theorem) for other in resting)


def _uses(step: Step, theorem: Theorem) -> bool:
    return theorem.name in step.theorems
