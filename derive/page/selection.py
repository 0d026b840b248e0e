"""The effect of a level of detail: how each step appears, and which of its lines are shown.

    brief      the set-up, the law, the result
    standard   what a good teacher writes; mental arithmetic is left out
    full       every line of every step

Each rule specifies, for all problems, how its steps are shown. Independently of the level, answers and reworded steps
have lines of their own, unless earlier lines show their result. A step whose symbol or equation the page needs
(`Needed`) is shown, too. So a page does not use a symbol or an equation number that it has not introduced.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from sympy import MatrixBase, preorder_traversal

from derive.algebra.expressions import Relation
from derive.page.pointers import that_have_it
from derive.steps.condensing import condensed
from derive.steps.derivation import Derivation
from derive.steps.level import Level, Manner
from derive.steps.step import Form, Step

OWN, TOLD, TAKEN_IN, LEFT_OUT, POINTED_OUT = Manner
LESS = {
    TAKEN_IN: TOLD,
    TOLD: OWN,
    LEFT_OUT: OWN,
    POINTED_OUT: OWN,
    OWN: OWN,
}  # manner of a step -> the manner to try next if the page needs the symbol of the step

LONGEST_CLAUSE = 24  # greatest number of nodes in the expression tree of a result that appears in a clause


@dataclass(frozen=True)
class Needed:
    """The hidden steps that the page needs, found from earlier versions of the page. `letters` contains the hidden
    steps whose symbols the page uses, and `numbers` the hidden steps to whose equations it refers.

    in_words   key of a step whose equation is in its sentence -> whether the sentence must name the step's symbol
    """

    letters: Mapping[str, int]  # key of a step -> number of versions of the page that lacked the symbol of the step
    numbers: frozenset[str] = frozenset()
    in_words: Mapping[str, bool] = field(default_factory=dict)

    def with_more(self, letters: Iterable[str], numbers: Iterable[str]) -> Needed:
        counts = dict(self.letters)
        for key in letters:
            counts[key] = counts.get(key, 0) + 1
        return replace(self, letters=counts, numbers=self.numbers | frozenset(numbers))


NOTHING_NEEDED = Needed({})


class Selection:
    """The steps of a derivation with the lines that a page of this level shows.

    asked   keys of the answers
    shown   the values under the problem's `show:`, by key of the step
    worded  keys of the steps that the problem rewords
    values  the numbers of answers, by key; a number may be shown instead of the formula
    """

    def __init__(
        self,
        derivation: Derivation,
        level: Level,
        asked: Collection[str],
        shown: Mapping[str, str],
        worded: Collection[str] = (),
        needed: Needed = NOTHING_NEEDED,
        values: Mapping[str, Step] | None = None,
    ):
        self.level, self.asked, self.shown, self.worded, self.needed = level, asked, shown, worded, needed
        self.measured = {key for key, value in (values or {}).items() if value.outcome == "measured"}
        self._having_it = {step.key: that_have_it(step, derivation) for step in derivation.steps}
        self._parts = derivation.parts
        self._behind_quoted = self._only_for_quoted(derivation.steps)
        self._behind_worded = self._only_for_worded(derivation.steps)
        self._manners: dict[str, Manner] = {}
        for step in derivation.steps:
            rules = {other.rule for other in derivation.steps if self._manners.get(other.key) is OWN}
            self._manners[step.key] = self._manner(step, repeats=step.rule in rules)
        self._steps = self._as_shown(derivation)

    @property
    def steps(self) -> Collection[Step]:
        """Return all steps, shown or hidden, with their lines at this level and the evidence for rewritten lines."""
        return self._steps.values()

    def manner(self, key: str) -> Manner:
        return self._manners.get(key, OWN)

    def is_behind_quoted(self, key: str) -> bool:
        """Return whether the page leaves out a step on which only quoted results depend.

        A quoted result is stated without its derivation.
        """
        return key in self._behind_quoted and self.manner(key) is LEFT_OUT

    def having_it(self, step: Step) -> tuple[Step, ...]:
        """Return the steps whose lines show the result of the given step."""
        return self._having_it[step.key]

    def standing_for(self, keys: Collection[str]) -> set[str]:
        """Return the given keys; the key of a step that points to earlier lines is replaced by the keys of the steps
        with these lines."""
        pointed = {key for key in keys if self.manner(key) is POINTED_OUT}
        return (set(keys) - pointed) | {each.key for key in pointed for each in self._having_it[key]}

    def step(self, step: Step) -> Step:
        """Return the step with only the lines that the page shows."""
        return self._steps.get(step.key, step)

    def standing_after(self, key: str, keys: Sequence[str]) -> list[Step]:
        """Return the steps of a part that are shown after the step `key`."""
        return [self._steps[each] for each in keys[keys.index(key) + 1 :] if self.stands(each)]

    def stands(self, key: str) -> bool:
        return self.manner(key) is OWN and self.shown.get(key) != "hidden"

    def could_stand(self, key: str) -> bool:
        """Return whether the level, but not the author, hides the lines of a step."""
        return self.manner(key) is not OWN and self.shown.get(key) != "hidden"

    def _can_be_pointed_out(self, step: Step) -> bool:
        """Return whether the sentence of a step can point to earlier lines, in place of lines of its own."""
        having_it = {each.key for each in self._having_it[step.key]}
        if not having_it or step.key in self.shown or step.key in self.needed.numbers or self.level is Level.FULL:
            return False
        together = step.key not in self.asked or any({step.key, *having_it} <= set(part) for part in self._parts)
        return all(map(self.stands, having_it)) and (together or step.key in self.measured)

    def _manner(self, step: Step, repeats: bool) -> Manner:
        if self._can_be_pointed_out(step):
            return POINTED_OUT
        if self.level is Level.FULL or step.key in self.asked or step.key in self.worded or step.key in self.shown:
            return OWN
        if step.key in self.needed.numbers:
            return OWN
        manner = LEFT_OUT if step.key in self._behind_quoted | self._behind_worded else step.display.manner(self.level)
        if repeats and step.display.first_only:
            manner = LEFT_OUT
        for _ in range(self.needed.letters.get(step.key, 0)):
            manner = LESS[manner]
        return OWN if manner is TOLD and not is_short(step) else manner

    def _only_for_quoted(self, steps: Sequence[Step]) -> set[str]:
        """Return the steps on which only quoted results depend, such as the density for a quoted moment of inertia."""
        quoted = {step.key for step in steps if step.display.quoted and step.key not in self.asked}
        found: set[str] = set()
        for step in reversed(steps):
            users = {other.key for other in steps if step.key in other.inputs}
            if users and users <= quoted | found:
                found.add(step.key)
        return found

    def _only_for_worded(self, steps: Sequence[Step]) -> set[str]:
        """Return the steps that only explain reworded steps."""
        found: set[str] = set()
        for step in reversed(steps) if self.worded else ():
            users = {other.key for other in steps if step.key in other.inputs}
            if step.display.only_explains and users and users <= {*self.worded} | found:
                found.add(step.key)
        return found

    def _as_shown(self, derivation: Derivation) -> dict[str, Step]:
        found: dict[str, Step] = {}
        known: dict[Any, Step] = {}
        seen: set[tuple[str, tuple[str, ...]]] = set()
        before: Step | None = None
        for step in derivation.steps:
            used = {name: other for name, other in known.items() if name in dict(step.names)}
            whole = condensed(step, used)
            manner = self._manners[step.key]
            if manner is TAKEN_IN:
                known[step.symbol] = replace(whole, chain=step.chain)
            form = (step.rule, tuple(form.because for form in step.chain))
            in_turn = before is not None and (before.rule, before.outcome) == (step.rule, step.outcome)
            chain = self._lines(whole, repeats=form in seen, in_turn=in_turn)
            found[step.key] = replace(whole, chain=chain)
            if manner is OWN:
                seen.add(form)
                before = step
        return found

    def _lines(self, step: Step, repeats: bool, in_turn: bool) -> tuple[Form, ...]:
        """Return the lines at this level. A step like an earlier step may show fewer lines."""
        if self.level is Level.FULL or self.shown.get(step.key) == "full":
            return step.chain
        if step.display.quoted and step.key not in self.asked:
            return step.chain[-1:]
        if repeats and in_turn and step.display.shows_result_alone(self.level):
            return step.chain[-1:]
        level = Level.BRIEF if repeats and not step.display.each_worked_out else self.level
        return tuple(form for form in step.chain[:-1] if level.shows(form.level)) + step.chain[-1:]


def is_short(step: Step) -> bool:
    """Return whether the step has a symbol and a result that is short enough for a sentence: `rho = M/V`."""
    value = step.result
    if step.symbol is None or isinstance(value, Relation | MatrixBase) and not _is_row(value):
        return False
    return _length(value) <= LONGEST_CLAUSE


def _length(value: Any) -> int:
    return sum(1 for _ in preorder_traversal(value))


def _is_row(value: Any) -> bool:
    """Return whether the value is a vector, which a sentence can show in a row."""
    return isinstance(value, MatrixBase) and value.shape[1] == 1
