"""Steps that are told in passing, behind the first lines that have their letters: `where rho = M/V`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import MatrixBase

from derive.algebra.expressions import explicit
from derive.page.introduced import expressions_in, letters_in, letters_of
from derive.page.wording import Inline, Math, Phrases, Text, filled, joined, names_asked, names_of_step
from derive.steps.step import Step

BY_VALUE = "<<definition>>"  # of a step for which there are no words


class Clauses:
    """Those of one page.

    waiting  steps that are to be told as soon as their letter is used
    told     keys of those that were
    set_up   what steps without lines of their own say of axes and coordinates, before the next sentence
    """

    def __init__(self, words: Phrases):
        self.words = words
        self.waiting: list[Step] = []
        self.told: set[str] = set()
        self.set_up: list[Inline] = []

    def set_aside(self, step: Step, is_told: bool) -> None:
        """A step without lines of its own: what it sets up is said, and then or later what its letter is."""
        phrase = self.words.setup(step)
        self.set_up += filled(phrase, self._names(step))
        if "definition" in names_asked(phrase):
            self.told.add(step.key)
        elif is_told:
            self.waiting.append(step)

    def point_out(self, step: Step, said: tuple[Inline, ...]) -> None:
        """A step whose sentence points to lines above."""
        self.set_up += [*([Text(" ")] if self.set_up else []), *said]
        self.told.add(step.key)

    def begun(self) -> tuple[Inline, ...]:
        """What is set up, to stand before the sentence that comes."""
        said, self.set_up = self.set_up, []
        return (*said, Text(" ")) if said else ()

    def behind(self, lines: Any) -> tuple[Inline, ...]:
        """What the letters in these lines stand for, as a sentence that goes on from them."""
        return self._sentence("where", self._due(lines))

    def around(self, sentence: tuple[Inline, ...], lines: Any) -> tuple[Inline, ...]:
        """A sentence behind the lines: it begins after the clause, unless it goes on from the lines itself."""
        due = self._due(lines)
        first = sentence[0]
        if isinstance(first, Text) and first.text.lstrip()[:1].islower():
            clause = self._sentence("here", due)
            return (*sentence, *((Text(" "),) if clause else ()), *clause)
        return (*(self._sentence("where", due)), *((Text(" "),) if due else ()), *sentence)

    def meanings(self, steps: Sequence[Step]) -> tuple[Inline, ...]:
        """What their letters are, without their values where there are words for it: `where rho is the density`."""
        return self._sentence("where", steps, by_value=False)

    def _due(self, lines: Any) -> list[Step]:
        letters = letters_in(expressions_in(lines)) if self.waiting else set()
        due = [step for step in self.waiting if letters_of(step.symbol) & letters]
        self.waiting = [step for step in self.waiting if step not in due]
        self.told |= {step.key for step in due}
        return [step for step in due if step.result not in expressions_in(lines)]

    def _sentence(self, label: str, due: Sequence[Step], by_value: bool = True) -> tuple[Inline, ...]:
        if not due:
            return ()
        told = joined([self._told(step, by_value) for step in due], self.words.labels["and"])
        return filled(self.words.labels[label], {"definitions": told})

    def _told(self, step: Step, by_value: bool) -> tuple[Inline, ...]:
        """`rho = M/(6 a^3) is the density`: in a sentence the value alone."""
        phrase = self.words.clauses.get(step.rule, {}).get(step.outcome, BY_VALUE)
        names = self._names(step)
        return filled(phrase, names if by_value or phrase == BY_VALUE else {**names, "definition": Math(step.symbol)})

    def _names(self, step: Step) -> dict[str, Any]:
        definition = (Math(step.symbol), Text(" = "), *_in_a_row(step.result))
        return {**names_of_step(step, self.words, None), "definition": definition}


def _in_a_row(value: Any) -> tuple[Inline, ...]:
    """A value as a sentence has it: a vector as (a, 2a, 3a), and not as a column."""
    shown = explicit(value)
    if not isinstance(shown, MatrixBase):
        return (Math(value),)
    entries = [node for entry in shown for node in (Text(", "), Math(entry))]
    return Text("("), *entries[1:], Text(")")
