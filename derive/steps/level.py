"""The amount of algebra on a page, and the manner in which a page shows a step; this module works without SymPy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any


class Manner(StrEnum):
    """How a step appears on a page."""

    OWN = "own"  # with its sentence and its lines
    TOLD = "told"  # in a clause after the first lines that contain its symbol: "where rho = M/V"
    TAKEN_IN = "taken_in"  # within the step that uses it: there the value replaces the symbol of this step
    LEFT_OUT = "left_out"
    POINTED_OUT = "pointed_out"  # with its sentence, which points to earlier lines that contain its result


class Level(StrEnum):
    """How much algebra a page shows. A line of a step is shown at its own level and at every higher level."""

    BRIEF = "brief"
    STANDARD = "standard"
    FULL = "full"

    def shows(self, other: Level) -> bool:
        order = list(Level)
        return order.index(other) <= order.index(self)


@dataclass(frozen=True)
class Display:
    """How a page below the level `full` shows a step, as the rule of the step specifies.

    brief, standard   the manner at these levels
    told_along        whether the sentence of the step before may state the result of this step
    first_only        whether only the first of several steps of the same rule is shown
    only_explains     whether the step only explains the steps that use it, so that the author's words may replace it
    result_again      the highest level at which a step directly after a similar step shows only its result
    each_worked_out   whether a step after a similar step also shows all lines of the level. Otherwise it shows only its
                      result and its lines of the level `brief`
    abbreviates       whether the result is a square root for which later steps may write the symbol of the step
    names_formula     whether the sentence names the formula, so that a line within a text needs no left side
    repeats           the key of the equation that the step repeats, if any
    result_in         names of rules. If such a rule made an input, the lines of this input may already contain the
                      result, and the sentence may point to these lines
    conditions        roles of those conditions in the sentence that are part of the answer
    quoted            whether only the result is shown, unless a part asks for the step, the level is `full`, or `show:`
                      states `full` for the step
    verdict           whether the answer is the sentence, and the formula only its reason
    """

    brief: Manner = Manner.OWN
    standard: Manner = Manner.OWN
    told_along: bool = True
    first_only: bool = False
    only_explains: bool = False
    result_again: Level | None = None
    each_worked_out: bool = False
    abbreviates: bool = False
    names_formula: bool = False
    repeats: str = ""
    result_in: tuple[str, ...] = ()
    conditions: tuple[str, ...] = ()
    quoted: bool = False
    verdict: bool = False

    def manner(self, level: Level) -> Manner:
        return self.brief if level is Level.BRIEF else self.standard

    def shows_result_alone(self, level: Level) -> bool:
        """Whether `result_again` applies at this level."""
        return self.result_again is not None and self.result_again.shows(level)


@dataclass(frozen=True)
class Shown:
    """How a page shows the steps of a rule; by default each step appears with its sentence and its lines.

    outcomes      outcome -> the manners at the levels `brief` and `standard`, in place of the fields with these names
    told_along    outcomes for which the sentence of the step before may state the result of this step
    condition_if  a predicate of the step: whether its sentence states a condition that is stated nowhere else
    taken_in_if   a predicate of the step: whether the step is shown within the step that uses it
    repeats       a function of the step that returns the key of the equation that the step repeats, or ""
    result_in     outcome -> names of rules, as for `Display`
    quoted        outcomes whose steps show only their result, as for `Display`
    verdicts      outcomes for which the answer is the sentence, such as "stable"

    The other fields are those of `Display`.
    """

    brief: Manner = Manner.OWN
    standard: Manner = Manner.OWN
    outcomes: Mapping[str, tuple[Manner, Manner]] = field(default_factory=dict)
    told_along: frozenset[str] = frozenset({"generic"})
    first_only: bool = False
    only_explains: bool = False
    result_again: Level | None = None
    each_worked_out: bool = False
    abbreviates: bool = False
    names_formula: bool = False
    condition_if: Callable[[Any], bool] = lambda step: False
    taken_in_if: Callable[[Any], bool] = lambda step: False
    repeats: Callable[[Any], str] = lambda step: ""
    result_in: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    conditions: tuple[str, ...] = ()
    quoted: frozenset[str] = frozenset()
    verdicts: frozenset[str] = frozenset()

    def of(self, step: Any) -> Display:
        """Return how this step is shown."""
        brief, standard = self.outcomes.get(step.outcome, (self.brief, self.standard))
        if self.taken_in_if(step):
            brief = standard = Manner.TAKEN_IN
        return Display(
            brief=brief,
            standard=standard,
            told_along=step.outcome in self.told_along and not self.condition_if(step),
            first_only=self.first_only,
            only_explains=self.only_explains,
            result_again=self.result_again,
            each_worked_out=self.each_worked_out,
            abbreviates=self.abbreviates,
            names_formula=self.names_formula,
            repeats=self.repeats(step),
            result_in=self.result_in.get(step.outcome, ()),
            conditions=self.conditions,
            quoted=step.outcome in self.quoted,
            verdict=step.outcome in self.verdicts,
        )


ON_ITS_OWN = Display()
SHOWN = Shown()
