"""Theorems in their general form: a page states each theorem at most once, before the first step that uses it.

A page is part of several documents: the document of its problem and the documents of its set. In a document of a set,
the first problem that uses a theorem states it in full, and later problems refer to this problem. So a page contains a
long and a short sentence for each theorem, and each document prints one of the two.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from derive.page.tree import Block, Document, Folded, Paragraph, PartPage
from derive.page.wording import Inline, Math, Phrases, ToldIn, ToldOnce, filled
from derive.steps.step import Level, Step


def standalone(document: Document) -> Document:
    """Return the page as a separate document: a paragraph states each theorem before the sentence that uses it."""

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
    """The theorems that a page states before its steps; a brief page only names theorems in its sentences."""

    def __init__(self, words: Phrases, level: Level):
        self._words, self._level = words, level
        self._told: set[str] = set()

    def before(self, step: Step) -> tuple[Inline, ...]:
        """Return the theorems that the page has not stated yet and must state before this step."""
        quoted = () if self._level is Level.BRIEF else step.theorems
        used = [theorem for theorem in quoted if theorem.name not in self._told]
        self._told |= {theorem.name for theorem in used}
        told: list[Inline] = []
        for theorem in used:
            names = {"formula": Math(theorem.formula)} | {name: Math(letter) for name, letter in theorem.letters}
            nodes = filled(self._words.theorems[theorem.name], names)
            first = ToldIn(self._words.labels["problem"])
            again = filled(self._words.theorems_again[theorem.name], {"problem": first, **names})
            told.append(ToldOnce(theorem.name, nodes, again))
        return tuple(told)

    def without_law(self, step: Step) -> Step:
        """Return the step without its line for the law, if the page has stated the law: as a theorem at the level
        `standard`, or for an earlier step at the level `brief`."""
        is_stated = self._level is not Level.FULL and not self._told.isdisjoint(step.law_in)
        if self._level is Level.BRIEF:
            self._told |= set(step.law_in)
        if not (is_stated and len(step.chain) > 1 and step.chain[0].because == "law"):
            return step
        return replace(step, chain=step.chain[1:])
