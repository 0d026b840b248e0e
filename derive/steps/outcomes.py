"""Outcomes: the words that choose a step's sentence, each with the predicate that must hold for it.

A verb says how it came out, "zero", "unstable", "slow", and the page's sentence is chosen by that word. Here stands,
apart from the code that chose it, what has to be true of the result for the word to be right. `establish` asks.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from derive.steps.subject import NOTHING, Mixed, Subject

GENERIC = "generic"  # the word where nothing is to be chosen
CENTRE_OF_MASS = "centre_of_mass"  # a word for the point "centre" of a body that has another one too
ZERO = "zero"  # the word for a result that vanishes


@dataclass(frozen=True)
class Judged:
    """What an outcome is judged by.

    result      what was established
    inputs      role -> value
    quantities  role -> the quantity that the value came from, where one did, and what the sentence points to
    symbol      what the page calls the result
    subject     what the result is about
    words       the terms that the phrase has
    """

    result: Any
    inputs: Mapping[str, Any] = field(default_factory=dict)
    quantities: Mapping[str, Any] = field(default_factory=dict)
    symbol: Any = None
    subject: Subject = NOTHING
    words: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Doubt:
    """Why a sentence is not confirmed, in words: a predicate may return this in place of False."""

    reason: str
    help: str | None = None

    def __bool__(self) -> bool:
        return False


Predicate = Callable[[Judged], "bool | Doubt"]

_PREDICATES: dict[str, dict[str, Predicate]] = {}
_TOLD: dict[str, Callable[[Judged, str], bool | Doubt]] = {}


def outcomes_of(rule: str, predicates: Mapping[str, Predicate]) -> None:
    """Say which outcomes a rule has, and what must hold for each."""
    _PREDICATES[rule] = dict(predicates)


def told_by(rule: str, predicate: Callable[[Judged, str], bool | Doubt]) -> None:
    """Say what must hold of the roles and formulas that the sentences of a rule tell, by facts and outcome."""
    _TOLD[rule] = predicate


def told_rightly(rule: str, outcome: str, facts: Judged) -> bool | Doubt:
    """Whether what the sentence tells besides its chain is true: the point and axis that it names, roles, formulas."""
    if not _names_its_point(facts):
        return Doubt("it names a point that the result is not about")
    if not _names_its_axis(facts):
        return Doubt("it names an axis that the result is not about")
    return rule not in _TOLD or _TOLD[rule](facts, outcome)


def _names_its_point(facts: Judged) -> bool:
    """Whether the point that is named is the one that the result is about, where that is known."""
    known = getattr(facts.subject.point, "name", None)
    in_full = {CENTRE_OF_MASS: "centre"} if known == "centre" else {}
    named = {in_full.get(facts.words[word], facts.words[word]) for word in ("about", "point") if word in facts.words}
    return not isinstance(known, str) or isinstance(facts.subject.point, Mixed) or named <= {known}


def _names_its_axis(facts: Judged) -> bool:
    """Whether the axis that is named is the one that the result is about, where that is known."""
    axis = facts.subject.axis
    named = {facts.words[word] for word in ("axis", "axis_letter") if word in facts.words}
    return not isinstance(axis, str) or named <= {axis}


def holds(rule: str, outcome: str, facts: Judged) -> bool | Doubt:
    """Whether the outcome is one that the rule has, and is true.

    A rule of which nothing was said has the outcome that chooses nothing, and that of a result which vanishes.
    """
    predicates = _PREDICATES.get(rule)
    if predicates is None:
        return outcome in {GENERIC, ZERO}  # `establish` itself sees to it that zero is zero
    predicate = predicates.get(outcome)
    return predicate is not None and predicate(facts)


def known_outcomes() -> dict[str, tuple[str, ...]]:
    """The outcomes of every rule that has a choice."""
    return {rule: tuple(predicates) for rule, predicates in _PREDICATES.items()}
