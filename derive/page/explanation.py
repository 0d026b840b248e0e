"""The explanation of one step: why the page needs it, how it was checked, its sentence, how the page shows it, and the
place of its law in the code."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from derive.algebra.equality import Compared
from derive.course.problem import Problem
from derive.course.problem_file import ANY_OUTCOME, SHOWN
from derive.errors import Place
from derive.page.phrasebook import Phrase
from derive.page.wording import AXIS_NAMES, Inline, Phrases, Text, filled, joined, names_of_step
from derive.steps.derivation import Derivation
from derive.steps.step import Step


@dataclass(frozen=True)
class Need:
    """A part that asks for an answer, and the steps that lead from the explained step to this answer."""

    part: str
    answer: str
    through: tuple[str, ...]


@dataclass(frozen=True)
class Explanation:
    """The explanation of a step in `part`.

    own_words   the place of the problem's own `wording:` for the `sentence`
    names       the names that a rewording may mention; empty if the step cannot be reworded
    """

    step: Step
    part: str
    needed: tuple[Need, ...]
    lines: Mapping[str, int]
    routes: tuple[tuple[str, str], ...]
    checks: tuple[tuple[str, str], ...]
    witnesses: tuple[tuple[str, str], ...]
    sentence: str
    own_words: Place | None
    outcomes: tuple[str, ...]
    names: tuple[str, ...]
    shown: str

    @property
    def sentence_at(self) -> str:
        place = self.sentence.place if isinstance(self.sentence, Phrase) else None
        return f"{place.path}:{place.line}" if place else ""

    def facts(self) -> dict[str, Any]:
        """Return the explanation as data for other programs."""
        return {
            "key": self.step.key,
            "part": self.part,
            "rule": self.step.rule,
            "needed": [{"part": n.part, "answer": n.answer, "through": list(n.through)} for n in self.needed],
            "inputs": list(self.step.inputs),
            "grade": self.step.grade.value,
            "lines": dict(self.lines),
            "routes": [{"words": words, "grade": grade} for words, grade in self.routes],
            "checks": [{"words": words, "grade": grade} for words, grade in self.checks],
            "witnesses": [{"detail": detail, "grade": grade} for detail, grade in self.witnesses],
            "outcome": self.step.outcome,
            "outcomes": list(self.outcomes),
            "sentence": str(self.sentence),
            "sentence_at": self.sentence_at,
            "wording_at": f"{self.own_words.path}:{self.own_words.line}" if self.own_words else None,
            "names": list(self.names),
            "show": self.shown or None,
            "law_at": self.step.law_at,
        }


def explanation_of(
    step: Step, problem: Problem, derivation: Derivation, values: Mapping[str, Step], words: Phrases
) -> Explanation:
    asked = _asked(problem, derivation, values)
    shown_in = next((_label(i) for i, keys in enumerate(derivation.parts) if step.key in keys), "")
    ways = {
        sort: tuple((words.route(step, e.claim), e.grade.value) for e in step.evidence if e.compared is sort)
        for sort in (Compared.ROUTE, Compared.CHECK)
    }
    named = names_of_step(step, words, None) if shown_in else ()
    unprintable = {name for name, word in step.words if name in words.compared(step.rule) or word not in words.terms}
    return Explanation(
        step=step,
        part=shown_in or asked.get(step.key, ""),
        needed=tuple(sorted(_needs(step, asked, derivation.steps), key=lambda need: need.part)),
        lines=Counter(e.grade.value for e in step.evidence if e.compared is Compared.LINES),
        routes=ways[Compared.ROUTE],
        checks=ways[Compared.CHECK],
        witnesses=tuple((e.detail, e.grade.value) for e in step.evidence if e.compared is Compared.WITNESS),
        sentence=words.phrase(step),
        own_words=_own_words(step, problem),
        outcomes=tuple(words.rules[step.rule]),
        names=tuple(name for name in named if name not in {*AXIS_NAMES, *unprintable}),
        shown=problem.show.get(step.key, ""),
    )


def _own_words(step: Step, problem: Problem) -> Place | None:
    told = problem.wording.get(step.key, {})
    prose = told.get(step.outcome) or told.get(ANY_OUTCOME)
    return prose.place if prose else None


def _label(index: int) -> str:
    return chr(ord("a") + index)


def _asked(problem: Problem, derivation: Derivation, values: Mapping[str, Step]) -> dict[str, str]:
    """Return a mapping from the key of each answer to the part that asks for it."""
    answers = [derivation.answering(part.answers) for part in problem.parts]
    asked = {step.key: _label(i) for i, steps in reversed(list(enumerate(answers))) for step in steps}
    return asked | {value.key: asked[key] for key, value in values.items() if key in asked}


def _needs(step: Step, asked: Mapping[str, str], steps: Sequence[Step]) -> Iterator[Need]:
    """Yield the step itself if it is an answer. Also yield each answer that depends on the step without another answer
    in between, with the steps that lead to it."""
    if step.key in asked:
        yield Need(asked[step.key], step.key, ())
    ways: deque[tuple[str, ...]] = deque([(step.key,)])
    seen = {step.key}
    while ways:
        way = ways.popleft()
        for key in [each.key for each in steps if way[-1] in each.inputs and each.key not in seen]:
            seen.add(key)
            if key in asked:
                yield Need(asked[key], key, way[1:])
            else:
                ways.append((*way, key))


# --- in words --------------------------------------------------------------------------------------------------------

Section = tuple[str, tuple[tuple[Inline, ...], ...]]  # a heading, and the sentences under it


def told_of(explanation: Explanation, words: Phrases) -> list[Section]:
    """Return the explanation of a step in words, divided into sections."""
    say = _Teller(explanation, words)
    headings = words.labels["explain_headings"]
    sections = (say.why(), say.checked(), say.wording(), say.shown(), say.law())
    return [(heading, tuple(lines)) for heading, lines in zip(headings, sections, strict=True) if lines]


class _Teller:
    """Writes the facts of an explanation in sentences that it takes from the phrases."""

    def __init__(self, explanation: Explanation, words: Phrases):
        self.of, self.step, self.words = explanation, explanation.step, words

    def line(self, name: str, **names: Any) -> tuple[Inline, ...]:
        texts = {name: Text(value) if isinstance(value, str) and value else value for name, value in names.items()}
        return filled(self.words.labels["explain"][name], {"key": Text(self.step.key), **texts})

    def listed(self, names: Sequence[str], last: str = "and") -> tuple[Inline, ...]:
        return joined([Text(name) for name in names], self.words.labels[last])

    def why(self) -> list[tuple[Inline, ...]]:
        needs = [
            self.line("needed", part=n.part, through=self.listed(n.through), answer=n.answer)
            if n.answer != self.step.key
            else self.line("asked", part=n.part)
            for n in self.of.needed
        ]
        needs = needs or [self.line("closing")]
        return [*needs, self.line("rests_on", inputs=self.listed(self.step.inputs))]

    def checked(self) -> list[tuple[Inline, ...]]:
        grades = self.words.grades
        counts = self.listed([f"{count} {grades[grade]}" for grade, count in self.of.lines.items()])
        compared = [self.line("lines", count=sum(self.of.lines.values()), counts=counts)] if self.of.lines else []
        routes = [self.line("route", words=words, grade=grades[grade]) for words, grade in self.of.routes]
        checks = [self.line("check", words=words, grade=grades[grade]) for words, grade in self.of.checks]
        motions = [self.line("motion", grade=grades[grade]) for _, grade in self.of.witnesses]
        return [self.line("grade", grade=grades[self.step.grade.value]), *compared, *routes, *checks, *motions]

    def wording(self) -> list[tuple[Inline, ...]]:
        stock = self.line("sentence", place=self.of.sentence_at, sentence=" ".join(self.of.sentence.split()))
        if not self.of.names:
            return [stock]
        own = self.of.own_words
        replaced = [self.line("own_words", place=f"{own.path}:{own.line}")] if own else []
        names = self.listed([f"<<{name}>>" for name in self.of.names])
        outcomes = self.listed([outcome for outcome in self.of.outcomes if outcome != self.step.outcome])
        return [*replaced, stock, self.line("replace", outcome=self.step.outcome, outcomes=outcomes, names=names)]

    def shown(self) -> list[tuple[Inline, ...]]:
        if not self.of.names:
            return []
        return [self.line("show", now=self.of.shown, values=self.listed(SHOWN, "or"))]

    def law(self) -> list[tuple[Inline, ...]]:
        return [(Text(self.step.law_at),)] if self.step.law_at else []
