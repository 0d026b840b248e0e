"""Steps whose definitions follow the first lines that use their symbols: `where rho = M/V`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import MatrixBase, MatrixSymbol, Symbol

from derive.algebra.expressions import explicit
from derive.page.introduced_symbols import expressions_in, letters_in, letters_of
from derive.page.selection import is_short
from derive.page.wording import EQUALS, Inline, Math, Phrases, Text, filled, joined, names_asked, names_of_step
from derive.steps.step import Step

BY_VALUE = "<<definition>>"  # the clause of a step without a phrase: symbol = value


class Clauses:
    """The clauses of one page.

    waiting  steps whose symbols are to be defined at the first use
    by_name  keys of the steps whose clause states the meaning of the symbol and not its value
    told     keys of the steps whose symbols have been defined
    said     the sentence before the lines just shown; the clause after the lines also defines symbols of this sentence
    set_up   text from steps without lines, for example about axes, that is printed before the next sentence
    """

    def __init__(self, words: Phrases):
        self.words = words
        self.waiting: list[Step] = []
        self.by_name: set[str] = set()
        self.told: set[str] = set()
        self.said: tuple[Inline, ...] = ()
        self.set_up: list[Inline] = []

    def set_aside(self, step: Step, is_told: bool) -> None:
        """Store the words of a step without lines.

        If `is_told` and these words do not define the symbol of the step, a clause defines the symbol at its first use.
        """
        phrase = self.words.setup(step)
        self.set_up += filled(phrase, self._names(step))
        if "definition" in names_asked(phrase):
            self.told.add(step.key)
        elif is_told:
            self.waiting.append(step)

    def define_at_use(self, step: Step) -> None:
        """Store a step that the page does not show. A clause will define the symbol of the step where the page first
        uses this symbol. The clause leaves out a long result: `where J is the inertia tensor`."""
        self.waiting.append(step)
        self.by_name |= set() if is_short(step) else {step.key}

    def can_define(self, step: Step) -> bool:
        """Return whether a clause can define the symbol of a step. The step must have a single symbol; its result must
        be short, or a phrase must state the meaning of the symbol."""
        has_phrase = step.outcome in self.words.clauses.get(step.rule, {})
        return isinstance(step.symbol, Symbol | MatrixSymbol) and (is_short(step) or has_phrase)

    def point_out(self, step: Step, said: tuple[Inline, ...]) -> None:
        """Store the sentence of a step whose result earlier lines already show."""
        self.set_up += [*([Text(" ")] if self.set_up else []), *said]
        self.told.add(step.key)

    def begun(self) -> tuple[Inline, ...]:
        """Return the stored text that belongs before the next sentence, and delete this text from the store."""
        said, self.set_up = self.set_up, []
        return (*said, Text(" ")) if said else ()

    def behind(self, lines: Any) -> tuple[Inline, ...]:
        """Return a clause that continues the sentence of these lines. The clause defines the waiting symbols in the
        lines, except symbols that the lines themselves define."""
        return self._sentence("where", self._due(lines))

    def around(self, sentence: tuple[Inline, ...], lines: Any) -> tuple[Inline, ...]:
        """Return the sentence that follows some lines, with a clause that defines the symbols in these lines."""
        due = self._due(lines)
        if continues_sentence(sentence):
            clause = self._sentence("here", due)
            return (*sentence, *((Text(" "),) if clause else ()), *clause)
        return (*(self._sentence("where", due)), *((Text(" "),) if due else ()), *sentence)

    def meanings(self, steps: Sequence[Step]) -> tuple[Inline, ...]:
        """Return the meanings of the symbols: `where rho is the density`, or `where rho = M/V` if there is no
        phrase."""
        return self._sentence("where", steps, by_value=False)

    def _due(self, lines: Any) -> list[Step]:
        letters = letters_in(expressions_in((self.said, lines))) if self.waiting else set()
        for step in reversed(self.waiting):  # a definition may contain the symbol of an earlier definition
            letters |= letters_in(expressions_in(step.result)) if letters_of(step.symbol) & letters else set()
        due = [step for step in self.waiting if letters_of(step.symbol) & letters]
        self.waiting, self.said = [step for step in self.waiting if step not in due], ()
        self.told |= {step.key for step in due}
        return [step for step in due if step.result not in expressions_in(lines)]

    def _sentence(self, label: str, due: Sequence[Step], by_value: bool = True) -> tuple[Inline, ...]:
        if not due:
            return ()
        told = joined([self._told(step, by_value) for step in due], self.words.labels["and"])
        return filled(self.words.labels[label], {"definitions": told})

    def _told(self, step: Step, by_value: bool) -> tuple[Inline, ...]:
        """Return `rho = M/(6 a^3) is the density`, or `rho = M/(6 a^3)` if there is no phrase. A clause with a phrase
        may leave out the value: `rho is the density`."""
        phrase = self.words.clauses.get(step.rule, {}).get(step.outcome, BY_VALUE)
        names, by_value = self._names(step), by_value and step.key not in self.by_name
        return filled(phrase, names if by_value or phrase == BY_VALUE else {**names, "definition": Math(step.symbol)})

    def _names(self, step: Step) -> dict[str, Any]:
        definition = (Math(step.symbol), EQUALS, *_in_a_row(step.result))
        return {**names_of_step(step, self.words, None), "definition": definition}


def continues_sentence(sentence: Sequence[Inline]) -> bool:
    """Return whether the words continue a sentence: they begin with a small letter."""
    return isinstance(sentence[0], Text) and sentence[0].text.lstrip()[:1].islower()


def _in_a_row(value: Any) -> tuple[Inline, ...]:
    """Return a value for use in a sentence: a vector is written (a, 2a, 3a) instead of as a column."""
    shown = explicit(value)
    if not isinstance(shown, MatrixBase) or shown.shape[1] > 1:
        return (Math(value),)
    entries = [node for entry in shown for node in (Text(", "), Math(entry))]
    return Text("("), *entries[1:], Text(")")
