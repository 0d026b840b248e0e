"""Compares what a document states with the derived steps; `problems/<set>/reference.yaml` lists its statements.

The file is a list of groups. A group names a problem and fixes the problem's input by its own `symbols:`, `given:` and
`values:`. So an edit of the problem's input does not break the comparison. A problem's own file can also have entries,
under `reference:`; they are compared for the problem's input. An entry usually states a value of one step. The
comparison of an entry has one of these outcomes:

    agrees               equal, with the grade of the evidence
    agrees to n figures  decimals, equal to that many figures
    erratum              the document is wrong: `states` is refuted and `right` agrees; or the error is only quoted
    differs              refuted, for example by values at a point; or stated as an erratum, but the document is right
    unknown step         no step has the key, or the symbol, that the entry names
    remark               nothing is compared: a claim of the document is quoted, with a comment

Each side of a chain of values is one comparison, except a first letter that only names the value.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping as Table
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import Relation
from derive.algebra.ranges import within
from derive.course.problem import Problem, run_solve
from derive.course.reference.agreement import given_values, verdict_on
from derive.course.reference.errata import Erratum, erratum_of, quoted_erratum
from derive.course.reference.quotes import Remark
from derive.course.reference.statements import Entry, Statement, stated_groups
from derive.course.script import Script
from derive.course.stock import StockScript
from derive.errors import Complaint, DeriveError, Place, did_you_mean
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.memory import Memory
from derive.steps.record import Run
from derive.steps.step import Quantity


@dataclass(frozen=True)
class Told:
    """The data of a comparison, for a page and its JSON.

    here   whether the entry is compared for the given values of the problem's file, not for other values of its group
    """

    facts: dict[str, Any]
    here: bool
    erratum: Erratum | None = None
    remark: Remark | None = None

    @property
    def outcome(self) -> str:
        return str(self.facts["outcome"])


@dataclass(frozen=True)
class Comparison:
    """The outcome of one entry; `complaint` says what is wrong if the outcome counts as a failure."""

    problem: str
    entry: Entry
    outcome: str
    grade: Grade | None
    detail: str
    complaint: Complaint | None = None
    erratum: Erratum | None = None
    here: bool = True  # whether the input of the entry is the input in the problem's file

    def told(self) -> Told:
        return Told(self.facts(), self.here, self.erratum, self.entry.remark)

    def facts(self) -> dict[str, Any]:
        """Return this comparison as an entry in the JSON of a solution."""
        return {
            "problem": self.problem,
            "part": self.entry.part,
            "document": self.entry.document,
            "line": self.entry.line,
            "answer": self.entry.answer,
            "states": self.entry.states.text if self.entry.states else None,
            "outcome": self.outcome,
            "grade": self.grade.value if self.grade else None,
            "detail": self.detail,
            "remark": self.entry.remark.why if self.entry.remark else None,
        }


Steps = Table[str, Quantity]


def comparisons(problem: Problem, known: Steps, memory: Memory | None = None) -> tuple[Comparison, ...]:
    """Compare every entry about this problem. `known` contains the steps for the input in the problem's file.

    The steps for a group with a different input are derived; `memory` provides stored results.
    """
    with within(problem.ranges):
        return _comparisons(problem, known, memory)


def _comparisons(problem: Problem, known: Steps, memory: Memory | None) -> tuple[Comparison, ...]:
    derived: list[tuple[object, Steps]] = [(_what_is_given(problem), known)]
    found = []
    for pinned, entries in stated_groups(problem):
        given = _what_is_given(pinned)
        steps = next((steps for other, steps in derived if other == given), None)
        if steps is None:
            steps = _pinned_steps(pinned, problem, memory) if memory else _derived_again(pinned, memory)
            derived.append((given, steps))
        here = given == _what_is_given(problem)
        for entry in entries:
            compared = _by_symbol(entry, steps, pinned) if entry.symbol else _by_key(entry, steps, pinned)
            found += [replace(comparison, here=here) for comparison in compared]
    return tuple(found)


def _what_is_given(problem: Problem) -> object:
    return problem.described or given_values(problem)


def _pinned_steps(pinned: Problem, problem: Problem, memory: Memory | None) -> Steps:
    """Return the steps for the input of a group. They are cached, because a preview compares after each edit."""
    depends = (_text_of(pinned.script), _what_is_given(pinned), pinned.symbols, pinned.ranges, problem.ranges)
    found = next((steps for other, steps in _pinned_before if other == depends), None)
    if found is None:
        found = _derived_again(pinned, memory)
        _pinned_before.append((depends, found))
    return found


def _text_of(script: Script | StockScript) -> object:
    if isinstance(script, StockScript):
        return script.stock
    return script.source.text, tuple(module.read_bytes() for module in script.modules)


_pinned_before: deque[tuple[object, Steps]] = deque(maxlen=4)


def _derived_again(pinned: Problem, memory: Memory | None) -> Steps:
    try:
        returned = run_solve(pinned, Run(memory=memory and memory.of_another_run()))
        return with_ancestors(returned_quantities(returned, pinned.script.returns), pinned.script.returns)
    except DeriveError as error:
        place = pinned.place_of("given")
        note = f"this error is for the input at {place.path}:{place.line}"
        raise type(error)(replace(c, notes=(*c.notes, note)) for c in error.complaints) from error


# --- comparing -------------------------------------------------------------------------------------------------------


def _one_by_one(entry: Entry, steps: Steps) -> list[Entry]:
    """Return the sides of a chain as separate entries."""
    step = steps.get(entry.answer)
    if step is None or entry.states is None or isinstance(step.value, Relation):
        return [entry]
    again = replace(entry, remark=None)  # only the entry of the first side keeps the remark
    begins = 1 if entry.states.is_named else 0
    sides = zip(entry.states.sides[begins:], entry.states.marks[begins:], strict=True)
    return [
        replace(again if i else entry, states=Statement((side,), (mark,), side.text, side.place))
        for i, (side, mark) in enumerate(sides)
    ]


def _by_key(entry: Entry, steps: Steps, pinned: Problem) -> list[Comparison]:
    return [_comparison(one, steps, pinned) for one in _one_by_one(entry, steps)]


def _by_symbol(entry: Entry, steps: Steps, pinned: Problem) -> list[Comparison]:
    """Compare a chain with the steps that have its first letter as their symbol."""
    keys = [key for key, step in steps.items() if getattr(step.symbol, "name", "") == entry.symbol]
    if not keys:
        message = f"no step has the symbol `{entry.symbol}`"
        help_line = "give the lines of this formula, and name its step under `answer`"
        fault = _fault("unknown-step", message, entry.place, help=help_line)
        return [Comparison(pinned.id, entry, "unknown step", None, message, fault)]
    by_step = [_by_key(replace(entry, answer=key, symbol=""), steps, pinned) for key in keys]
    longest = max(map(len, by_step))
    sides = zip(*(found for found in by_step if len(found) == longest), strict=True)
    return [next((each for each in side if each.complaint is None), side[-1]) for side in sides]


def _comparison(entry: Entry, steps: Steps, pinned: Problem) -> Comparison:
    if entry.states is None and entry.instead:
        return Comparison(pinned.id, entry, "erratum", None, f"{entry.why}: quoted", erratum=quoted_erratum(entry))
    if entry.states is None:
        return Comparison(pinned.id, entry, "remark", None, "nothing to compare")
    step = steps.get(entry.answer)
    if step is None:
        message = f"no step is called `{entry.answer}`"
        fault = _fault("unknown-step", message, entry.place, help=did_you_mean(entry.answer, steps))
        return Comparison(pinned.id, entry, "unknown step", None, message, fault)
    verdict = verdict_on(entry.states, step, entry, pinned)
    if entry.right is None:
        return _agreement(entry, step, verdict, pinned, entry.states.place)
    if verdict:
        message = f"the document is right about `{entry.answer}`, so this is not an erratum"
        fault = _fault("no-erratum", message, entry.states.place, verdict.detail)
        return Comparison(pinned.id, entry, "differs", verdict.grade, message, fault)
    right = verdict_on(entry.right, step, entry, pinned)
    if right:
        erratum = erratum_of(entry, {name: known.symbol for name, known in pinned.symbols.items()})
        told = f"{entry.why}: {_said(verdict)}"
        return Comparison(pinned.id, entry, "erratum", right.grade, told, erratum=erratum)
    return _difference(entry, step, right, pinned, "`right`", entry.right.place)


def _agreement(entry: Entry, step: Quantity, verdict: Verdict, pinned: Problem, place: Place) -> Comparison:
    if not verdict:
        return _difference(entry, step, verdict, pinned, "what the document states", place)
    figures = min(entry.figures, default=0)
    outcome = f"agrees to {figures} figure{'s' * (figures > 1)}" if figures else "agrees"
    return Comparison(pinned.id, entry, outcome, verdict.grade, verdict.detail)


def _difference(entry: Entry, step: Quantity, verdict: Verdict, pinned: Problem, what: str, place: Place) -> Comparison:
    notes = (f"derived: {_short(step.value)}", f"stated against derived: {_said(verdict)}")
    fault = _fault("differs", f"`{entry.answer}` differs from {what}", place, *notes)
    return Comparison(pinned.id, entry, "differs", verdict.grade, _said(verdict), fault)


def _fault(code: str, message: str, place: Place, *notes: str, help: str | None = None) -> Complaint:
    """Return a warning and not an error, because the derivation has its own evidence."""
    return Complaint(code, message, place, notes, help, severity="warning")


def _said(verdict: Verdict) -> str:
    at = ", ".join(f"{name} = {value}" for name, value in verdict.point)
    return verdict.detail + (f" at {at}" if at else "")


def _short(value: Any) -> str:
    text = str(value.tolist() if hasattr(value, "tolist") else value)
    return text if len(text) <= 200 else text[:200] + " ..."
