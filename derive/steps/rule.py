"""Rules: one record for each law that makes steps, in the module of the verb that uses the law.

A verb chooses an outcome, such as "zero", "unstable" or "slow", and a page chooses its sentence by this outcome. For
each outcome the rule has a predicate that must be true of the result. `establish` evaluates the predicate.

Predicates are in the files `claims.py` of the folders of verbs, or in `derive/steps/claims.py`. Predicates may use the
facts of a result and the descriptions of bodies and systems. The files `claims.py` in the folders of verbs import no
module of `derive/mechanics` that defines a rule, except the module for coordinates as functions of the time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from derive.algebra.equality import Compared
from derive.steps.level import SHOWN
from derive.steps.level import Shown as Shown  # other modules import `Shown` from here
from derive.steps.subject import NOTHING, Mixed, Subject

GENERIC = "generic"  # the default outcome
CENTRE_OF_MASS = "centre_of_mass"  # the word for a centre of mass if another point may be called "centre"
ZERO = "zero"  # the outcome for a result that vanishes
AXES = ("x", "y", "z")
ROUTE, CHECK = Compared.ROUTE, Compared.CHECK
TRIALS = "trials"  # a claim under `evidence` of a rule: the predicate of the outcome tests the result at trial numbers


@dataclass(frozen=True)
class Judged:
    """The data that a predicate judges.

    result      the value of the step
    inputs      role -> value, for the inputs, the objects that only the sentence contains, and the outcome data
    quantities  role -> quantity, for the inputs and other quantities that the sentence mentions
    symbol      the symbol of the result on the page
    subject     the subject of the result
    words       term of the phrase -> its word
    """

    result: Any
    inputs: Mapping[str, Any] = field(default_factory=dict)
    quantities: Mapping[str, Any] = field(default_factory=dict)
    symbol: Any = None
    subject: Subject = NOTHING
    words: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Doubt:
    """The reason, in words, why a sentence is not confirmed. A predicate may return a doubt in place of False."""

    reason: str
    help: str | None = None

    def __bool__(self) -> bool:
        return False


Predicate = Callable[[Judged], "bool | Doubt"]
Statement = Callable[[Judged, str], "bool | Doubt"]
Naming = Callable[[Judged, Any], bool]


def anything(facts: Judged) -> bool:
    """The predicate of an outcome that claims nothing."""
    return True


@dataclass(frozen=True)
class Theorem:
    """A theorem in its general form. A page above the level `brief` states it before the first step that uses it.

    formula   what the theorem states, as a relation or an expression
    source    the book and the section that state the theorem
    letters   further symbols that the phrase names, with their names in the phrase
    """

    name: str
    formula: Any
    source: str
    letters: tuple[tuple[str, Any], ...] = ()


@dataclass(frozen=True)
class Quote:
    """The use of a theorem by the steps of a rule.

    outcomes   outcomes whose steps use the theorem; if empty, the steps of all outcomes use the theorem
    law_in     outcomes in which the theorem is the law of the step, so the step need not repeat the law
    between    values of the term `between` in the phrase of a step; only steps with one of them use the theorem; if
               empty, all steps
    """

    theorem: Theorem
    outcomes: frozenset[str] = frozenset()
    law_in: frozenset[str] = frozenset()
    between: frozenset[str] = frozenset()

    def fits(self, outcome: str, between: str) -> bool:
        """Whether a step with this outcome, and with this word for the term `between`, uses the theorem."""
        in_outcome = not self.outcomes or outcome in self.outcomes
        return in_outcome and (not self.between or between in self.between)


@dataclass(frozen=True, eq=False)
class Rule:
    """A law that makes steps.

    name         the topic, usually the folder of the verb, and the default key of a step: "lagrange.lagrangian"
    source       the book and the section that state the law
    outcomes     outcome -> the predicate that must be true of the result
    evidence     claim -> ROUTE or CHECK, for each second derivation of the result. A route uses other physics, so it
                 reveals a wrong law; a check reveals an error of algebra. The claim TRIALS is tested by the predicate
                 of the outcome, at trial numbers. A rule without evidence is a definition
    statements   predicates that must be true of the sentence for every outcome
    named        role -> the predicate of an object that only the sentence names
    shown        how a page shows the steps of this rule
    quotes       the theorems that the steps of this rule use
    names_value  whether the symbol of a result may replace its value in later results
    """

    name: str
    source: str = ""
    outcomes: Mapping[str, Predicate] = field(default_factory=lambda: {GENERIC: anything})
    evidence: Mapping[str, Compared] = field(default_factory=dict)
    statements: Sequence[Statement] = ()
    named: Mapping[str, Naming] = field(default_factory=dict)
    shown: Shown = SHOWN
    quotes: Sequence[Quote] = ()
    names_value: bool = False

    def __post_init__(self) -> None:
        RULES[self.name] = self

    @property
    def key(self) -> str:
        """Return the default key of a step of this rule."""
        return self.name.rpartition(".")[2]

    @property
    def is_definition(self) -> bool:
        return not self.evidence

    def verdict(self, outcome: str, facts: Judged) -> bool | Doubt:
        """Whether the outcome and all other statements of the sentence are true."""
        predicate = self.outcomes.get(outcome)
        verdict = predicate is not None and predicate(facts)
        return verdict and self._stated(outcome, facts)

    def _stated(self, outcome: str, facts: Judged) -> bool | Doubt:
        if not _names_its_point(facts):
            return Doubt("the sentence names a point other than the reference point of the result")
        if not _names_its_axis(facts):
            return Doubt("the sentence names an axis other than the axis of the result")
        if not _letter_of_its_axis(facts):
            return Doubt("the letter of the result has the index of another axis")
        return next((said for each in self.statements if not (said := each(facts, outcome))), True)

    def theorems(self, outcome: str, words: Mapping[str, str]) -> dict[str, Any]:
        """Return the fields of a `Step` that concern theorems."""
        quotes = [each for each in self.quotes if each.fits(outcome, words.get("between", ""))]
        return {
            "theorems": tuple(each.theorem for each in quotes),
            "law_in": tuple(each.theorem.name for each in quotes if outcome in each.law_in),
        }

    def wrongly_named(self, facts: Judged, named: Mapping[str, Any]) -> str | None:
        """Return the first role that has no predicate or whose predicate is false; None if every role is right."""
        for role, value in named.items():
            judge = self.named.get(role) or self.named.get(role.rstrip("0123456789").removesuffix("_"))
            if judge is None or not judge(facts, value):
                return role
        return None


RULES: dict[str, Rule] = {}  # name -> rule; each module of verbs adds its rules when it is loaded
_HANDED_ON: dict[type[Any], Naming] = {}


def handed_on_by(kind: type[Any], predicate: Naming) -> None:
    """Register the predicate that judges whether a fact of this kind fits the step that returns it."""
    _HANDED_ON[kind] = predicate


def wrongly_handed_on(facts: Judged, handed_on: Sequence[Any]) -> Any | None:
    """Return the first fact that does not fit the step that returns it, or None."""
    return next((f for f in handed_on if (judge := _HANDED_ON.get(type(f))) and not judge(facts, f)), None)


def judged_facts() -> frozenset[type[Any]]:
    """Return the kinds of fact that have a predicate."""
    return frozenset(_HANDED_ON)


def _names_its_point(facts: Judged) -> bool:
    """Whether the words name no point other than the reference point of the result, if this is known."""
    known = getattr(facts.subject.point, "name", None)
    in_full = {CENTRE_OF_MASS: "centre"} if known == "centre" else {}
    named = {in_full.get(facts.words[word], facts.words[word]) for word in ("about", "point") if word in facts.words}
    return not isinstance(known, str) or isinstance(facts.subject.point, Mixed) or named <= {known}


def _names_its_axis(facts: Judged) -> bool:
    """Whether the words name no axis other than the axis of the result, if this is known."""
    axis = facts.subject.axis
    named = {facts.words[word] for word in ("axis", "axis_letter") if word in facts.words}
    return not isinstance(axis, str) or named <= {axis}


def _letter_of_its_axis(facts: Judged) -> bool:
    """Whether the index of a symbol, such as z in I_z, agrees with the axis that the sentence names, if any."""
    axis = facts.words.get("whole", facts.words.get("axis"))
    index = str(getattr(facts.symbol, "name", "")).rpartition("_")[2]
    return index not in AXES or axis not in AXES or index == axis
