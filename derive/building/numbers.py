"""Answers that should have a number and have none."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Pow, Symbol

from derive.algebra.expressions import TIME, Amount, Relation, explicit
from derive.course.parts import Question
from derive.course.problem import Problem
from derive.course.yaml_tree import Word
from derive.errors import Complaint, Place
from derive.figures.marks import Plot, Recorded
from derive.steps.derivation import Derivation, answering
from derive.steps.step import Step


@dataclass(frozen=True)
class _Answer:
    """An answer that a part asks for, and whether a number was found."""

    key: str
    asked: Word
    part: Question
    value: Any
    numbers: Mapping[Symbol, Amount]
    has_number: bool

    @property
    def letters(self) -> set[Symbol]:
        return {letter for letter in self.value.free_symbols if isinstance(letter, Symbol)}

    @property
    def missing(self) -> list[Symbol]:
        return sorted(self.letters - {*self.numbers}, key=str)

    @property
    def is_halfway(self) -> bool:
        """Whether some of the answer's letters have numbers although the answer itself has none."""
        return not self.has_number and not self.letters.isdisjoint(self.numbers)

    @property
    def why(self) -> str:
        if self.missing:
            return f"{_listed(self.missing)} {'has' if len(self.missing) == 1 else 'have'} no value"
        at = {letter: explicit(self.numbers[letter]) for letter in self.letters}
        below = sorted({str(power.base) for power in self.value.atoms(Pow) if _is_no_root(power, at)})
        return f"with these values {f'`{below[0]}` is negative' if below else 'it is not real'}"

    @property
    def in_form(self) -> Place | None:
        """The place in the file where the form of this answer states a unit or, if `is_halfway`, the number of
        significant figures; otherwise None."""
        form = self.part.form_of(self.asked)
        if form.units:
            return form.units[0].place
        return form.places.get("figures") if self.is_halfway else None


def faults_of_numbers(
    problem: Problem, derivation: Derivation, values: Mapping[str, Step], drawings: Iterable[Recorded]
) -> list[Complaint]:
    """Return errors and warnings about the numbers of the answers.

    It is an error if a form asks for a number that does not exist. Any other answer without a number leads to a
    warning if all its letters have numbers, or if a letter has a number that neither a plot nor an answer with a number
    uses.

    values     the steps that evaluate answers numerically, by key
    drawings   the drawings of the problem
    """
    if not problem.every_amount:
        return []
    answers = list(_answers(problem, derivation, values))
    # The form of a part may be meant for only some of its answers.
    served = [answer.part for answer in answers if answer.has_number]
    wanting = [a for a in answers if not a.has_number and (a.asked in a.part.forms or a.part not in served)]
    said = {(answer.key, answer.why): place for answer in wanting if (place := answer.in_form)}
    return [
        *(Complaint("number-missing", f"`{key}` has no number: {why}", place) for (key, why), place in said.items()),
        *_not_sufficient(problem, [a for a in answers if (a.key, a.why) not in said], _plotted(drawings)),
    ]


def _answers(problem: Problem, derivation: Derivation, values: Mapping[str, Step]) -> Iterator[_Answer]:
    groups = dict(derivation.groups)
    for part in problem.parts:
        cases = problem.cases_of(part)
        for key, asked in answering(part.answers, derivation.steps, groups).items():
            value = _taking_a_number(derivation.step(key).result)
            if value is None:
                continue
            for name, numbers in [(f"{key}_in_case_{case}", numbers) for case, numbers in cases.items()] or [
                (key, problem.amounts)
            ]:
                yield _Answer(key, asked, part, value, numbers, name in values or not value.free_symbols)


def _taking_a_number(result: Any) -> Any | None:
    """Return the expression that is evaluated numerically: the result or, for a condition such as R > a/2, its right
    side. None for a condition that is not solved for a symbol, and for a result that is not an expression."""
    if isinstance(result, Relation):
        solved = isinstance(result.left, Symbol) and not result.right.has(result.left)
        result = result.right if solved else None
    return explicit(result) if hasattr(result, "free_symbols") else None


def _plotted(drawings: Iterable[Recorded]) -> set[Symbol]:
    return {letter for drawing in drawings if isinstance(drawing, Plot) for letter in drawing.letters}


def _not_sufficient(problem: Problem, answers: Sequence[_Answer], plotted: set[Symbol]) -> Iterator[Complaint]:
    own = {declared.symbol for declared in problem.symbols.values()} - {TIME}
    used = plotted.union(*(answer.letters for answer in answers if answer.has_number))
    found: dict[str, list[_Answer]] = {}
    for answer in answers:
        needless = answer.letters & {*answer.numbers} - used
        if answer.is_halfway and own.issuperset(answer.missing) and (needless or not answer.missing):
            found.setdefault(answer.why, []).append(answer)
    for why, of in found.items():
        names = list(dict.fromkeys(answer.key for answer in of))
        place = next((m.place for m in problem.measured if m.symbol in of[0].letters), of[0].asked.place)
        message = f"{_listed(names)} {'has' if len(names) == 1 else 'have'} no number: {why}"
        help_line = "give numbers to all letters that a result depends on, or to none" if of[0].missing else None
        yield Complaint("number-missing", message, place, help=help_line, severity="warning")


def _is_no_root(power: Pow, at: Mapping[Symbol, Any]) -> bool:
    return bool(power.exp.is_Rational and power.exp.q == 2 and power.base.subs(at).is_negative)


def _listed(names: Iterable[Any]) -> str:
    *others, last = (f"`{name}`" for name in names)
    return f"{', '.join(others)} and {last}" if others else last
