"""Theorems in their general form: each stands once on a page, before the first step that uses it.

A page is a part of several documents, its own and that of its set. So it has the words for both, and the document that
is typeset has the choice: it tells a theorem once, and in a later problem says which one has told it.
"""

from __future__ import annotations

from derive.mechanics.theorems import THEOREMS
from derive.page.wording import Inline, Math, Phrases, ToldIn, ToldOnce, filled
from derive.steps.step import Level, Step


class Theorems:
    """Those that the page has not told yet; a brief page has only their names, in the sentences of its steps."""

    def __init__(self, words: Phrases, level: Level):
        self._words = words
        self._left = [] if level == Level.BRIEF else list(THEOREMS)

    def before(self, step: Step) -> list[tuple[Inline, ...]]:
        """What is told before that step."""
        used = [theorem for theorem in self._left if theorem.is_used_by(step.rule, step.outcome)]
        self._left = [theorem for theorem in self._left if theorem not in used]
        told: list[tuple[Inline, ...]] = []
        for theorem in used:
            letters = {name: Math(letter) for name, letter in theorem.letters.items()}
            nodes = filled(self._words.theorems[theorem.name], {"formula": Math(theorem.formula), **letters})
            first = ToldIn(self._words.labels["problem"])
            again = filled(self._words.theorems_again[theorem.name], {"problem": first})
            told.append((ToldOnce(theorem.name, nodes, again),))
        return told
