"""What a document states, compared with what is derived: `problems/<set>/reference.yaml`.

The file is a list of groups. A group names a problem and pins it by `symbols:`, `given:` and `values:` of its own, so
that an edit of the problem neither breaks the comparison nor has wrong numbers compared. Each of its entries states a
value of one step:

    agrees               equal, with the grade of the evidence
    agrees to n figures  decimals, `to` so many of them
    erratum              the document is wrong: `states` is refuted and `right` agrees
    differs              refuted, at a point; or an erratum that is none
    unknown step         no step has that key

A letter that the step's value lacks stands for what the steps before it found: `rho`, `J_xx`, or `omega_x` of a spin.
"""

from __future__ import annotations

from collections.abc import Mapping as Table
from dataclasses import dataclass, replace
from typing import Any

from sympy import Add, Expr, Integer, MatrixSymbol, Rational, Symbol

from derive.derivation import returned_quantities, with_ancestors
from derive.dimensions import Dimension, dimension_of_kind, kind_with_article, named
from derive.errata import Erratum, erratum_of
from derive.errors import Complaint, DeriveError, Place
from derive.evidence import Grade, Verdict, equal
from derive.expressions import AXES, Relation, component_names, explicit
from derive.problem import Problem, run_solve
from derive.rounding import Rounded, off_by_more_than_half_a_unit
from derive.source import did_you_mean
from derive.stated import Entry, Stated, stated_groups
from derive.step import Quantity
from derive.units import read_unit


@dataclass(frozen=True)
class Told:
    """What a page and its JSON say of a comparison."""

    facts: dict[str, Any]
    here: bool
    erratum: Erratum | None = None

    @property
    def outcome(self) -> str:
        return str(self.facts["outcome"])


@dataclass(frozen=True)
class Comparison:
    """What became of one entry; `complaint` says what is wrong if it counts as a failure."""

    problem: str
    entry: Entry
    outcome: str
    grade: Grade | None
    detail: str
    complaint: Complaint | None = None
    here: bool = True  # pinned to what the problem now gives, so that its page may speak of it

    def told(self) -> Told:
        return Told(self.facts(), self.here, erratum_of(self.entry) if self.outcome == "erratum" else None)

    def facts(self) -> dict[str, Any]:
        """The entry in the JSON of a solution."""
        return {
            "problem": self.problem,
            "part": self.entry.part,
            "answer": self.entry.answer,
            "states": self.entry.states.text,
            "outcome": self.outcome,
            "grade": self.grade.value if self.grade else None,
            "detail": self.detail,
        }


Steps = Table[str, Quantity]


def comparisons(problem: Problem, known: Steps) -> tuple[Comparison, ...]:
    """Every entry about this problem, compared; `known` are its steps for what its own file gives."""
    derived: list[tuple[dict[str, Any], Steps]] = [(_given(problem), known)]
    found = []
    for pinned, entries in stated_groups(problem):
        given = _given(pinned)
        steps = next((steps for other, steps in derived if other == given), None)
        if steps is None:
            steps = _derived_again(pinned)
            derived.append((given, steps))
        here = given == _given(problem)
        found += [replace(_comparison(entry, steps, pinned), here=here) for entry in entries]
    return tuple(found)


def _given(problem: Problem) -> dict[str, Any]:
    return {given.name: given.value for given in problem.givens}


def _derived_again(pinned: Problem) -> Steps:
    try:
        return with_ancestors(returned_quantities(run_solve(pinned), pinned.script.returns), pinned.script.returns)
    except DeriveError as error:
        place = pinned.place_of("given")
        note = f"this is for what is given at {place.path}:{place.line}"
        raise type(error)(replace(c, notes=(*c.notes, note)) for c in error.complaints) from error


# --- comparing -------------------------------------------------------------------------------------------------------


def _comparison(entry: Entry, steps: Steps, pinned: Problem) -> Comparison:
    step = steps.get(entry.answer)
    if step is None:
        message = f"no step is called `{entry.answer}`"
        fault = _fault("unknown-step", message, entry.place, help=did_you_mean(entry.answer, steps))
        return Comparison(pinned.id, entry, "unknown step", None, message, fault)
    verdict = _verdict(entry.states, step, entry, pinned)
    if entry.right is None:
        return _agreement(entry, step, verdict, pinned)
    if verdict:
        message = f"the document is right about `{entry.answer}`, so this is no erratum"
        fault = _fault("no-erratum", message, entry.states.place, verdict.detail)
        return Comparison(pinned.id, entry, "differs", verdict.grade, message, fault)
    right = _verdict(entry.right, step, entry, pinned)
    if right:
        return Comparison(pinned.id, entry, "erratum", right.grade, f"{entry.why}: {_said(verdict)}")
    return _difference(entry, step, right, pinned, "`right`", entry.right.place)


def _agreement(entry: Entry, step: Quantity, verdict: Verdict, pinned: Problem) -> Comparison:
    if not verdict:
        return _difference(entry, step, verdict, pinned, "what the document states", entry.states.place)
    figures = min(entry.figures, default=0)
    outcome = f"agrees to {figures} figure{'s' * (figures > 1)}" if figures else "agrees"
    return Comparison(pinned.id, entry, outcome, verdict.grade, verdict.detail)


def _difference(entry: Entry, step: Quantity, verdict: Verdict, pinned: Problem, what: str, place: Place) -> Comparison:
    notes = (f"derived: {_short(step.value)}", f"stated against derived: {_said(verdict)}")
    fault = _fault("differs", f"`{entry.answer}` differs from {what}", place, *notes)
    return Comparison(pinned.id, entry, "differs", verdict.grade, _said(verdict), fault)


def _fault(code: str, message: str, place: Place, *notes: str, help: str | None = None) -> Complaint:
    """A warning, for the derivation is right by its own evidence; `derive check` fails on it all the same."""
    return Complaint(code, message, place, notes, help, severity="warning")


def _said(verdict: Verdict) -> str:
    at = ", ".join(f"{name} = {value}" for name, value in verdict.point)
    return verdict.detail + (f" at {at}" if at else "")


def _short(value: Any) -> str:
    text = str(value.tolist() if hasattr(value, "tolist") else value)
    return text if len(text) <= 200 else text[:200] + " ..."


def _verdict(stated: Stated, step: Quantity, entry: Entry, pinned: Problem) -> Verdict:
    """Entry by entry; as sure as the least sure of them."""
    derived = explicit(step.value)
    shape = tuple(int(n) for n in getattr(derived, "shape", ()))
    if shape != stated.shape:
        return Verdict(Grade.REFUTED, f"{_SHAPES[stated.shape]} against {_SHAPES.get(shape, 'another shape')}")
    letters = _meanings(stated, step, derived, pinned)
    values = [explicit(expr.xreplace(letters)) for expr, _ in stated.entries]
    kept = {letter for value in values for letter in value.free_symbols}
    numbers = {m.symbol: m.si for m in pinned.measured if m.symbol not in kept}
    unit = entry.unit or read_unit("rad")
    if isinstance(derived, Relation):  # an equation is stated by what vanishes in it
        wrong = _of_kind(stated.entries[0][1] * unit.dimension, values[0], step.step.kind)
        return wrong or equal(Relation(values[0], "=", Integer(0)), derived)
    worst = Verdict(Grade.PROVED, "identical")
    for i, right in enumerate(derived if shape else [derived]):
        right = right.xreplace(numbers)
        verdict = _of_kind(stated.entries[i][1] * unit.dimension, values[i], step.step.kind)
        if verdict is None and entry.figures:
            verdict = _to_figures(values[i], right / unit.factor, entry.figures[i % len(entry.figures)])
        if verdict is None:
            verdict = equal(values[i] * unit.factor, right)
        if not verdict:
            return replace(verdict, detail=_named_entry(i, shape) + verdict.detail)
        if worst.grade is Grade.PROVED and verdict.detail != "identical":
            worst = verdict
    names = ", ".join(sorted(letter.name for letter, value in letters.items() if str(value) != letter.name))
    return replace(worst, detail=f"{worst.detail}, for {names} as derived") if names else worst


_SHAPES: Table[tuple[int, ...], str] = {(): "a scalar", (3, 1): "a vector", (3, 3): "a tensor"}


def _named_entry(i: int, shape: tuple[int, ...]) -> str:
    if not shape:
        return ""
    return f"{AXES[i]}: " if shape[1] == 1 else f"{AXES[i // 3]}{AXES[i % 3]}: "


def _meanings(stated: Stated, step: Quantity, derived: Any, pinned: Problem) -> dict[Symbol, Expr]:
    """What each letter of a stated value is in the derivation: the same letter, or what an earlier step found."""
    own = {letter.name: letter for letter in derived.free_symbols}
    given = {letter.name for expr in _expressions(_given(pinned).values()) for letter in expr.free_symbols}
    found = {name: values for name, values in _found_before(step).items() if name not in {*own, *given}}
    declared = {name: own.get(name, known.symbol) for name, known in pinned.symbols.items()}
    # A name that stands for two things among the steps before (the tensors of two bodies, say) stands for none here.
    return {
        letter: values[0] if len(values := found.get(letter.name, [])) == 1 else declared[letter.name]
        for letter in stated.letters
    }


def _expressions(values: Any) -> list[Expr]:
    return [expr for v in values for expr in (v if isinstance(v, tuple) else (v,)) if isinstance(expr, Expr)]


def _found_before(step: Quantity) -> dict[str, list[Any]]:
    """Name -> the different values that it has among the steps behind this one; those of general vectors left out."""
    found: dict[str, list[Any]] = {}
    for quantity in with_ancestors(step.parents).values():
        names: tuple[Symbol, ...] = (quantity.symbol,) if isinstance(quantity.symbol, Symbol) else ()
        values = [quantity.value]
        if isinstance(quantity.symbol, MatrixSymbol) and quantity.symbol.shape == (3, 1):
            names, values = component_names(quantity.symbol.name), list(quantity.value)
        for name, value in zip(names, values, strict=False):
            if value != name and value not in found.setdefault(name.name, []):
                found[name.name].append(value)
    return found


def _of_kind(dimension: Dimension, value: Expr, kind: str | None) -> Verdict | None:
    """The refutation that a unit or a letter too many gives at once."""
    if kind is None or value == 0 or dimension == dimension_of_kind(kind):
        return None
    return Verdict(Grade.REFUTED, f"{named(dimension)} against {kind_with_article(kind)}")


def _to_figures(stated: Expr, derived: Expr, figures: int) -> Verdict:
    """Whether each printed decimal is within half a unit of its last place; letters behind it must be the same."""
    printed, exact = _coefficients(stated), _coefficients(derived)
    if printed.keys() != exact.keys():
        return Verdict(Grade.REFUTED, f"{stated} against {derived}")
    for letters, number in printed.items():
        decimal = Rounded(Rational(str(number.evalf(40))), Integer(figures))
        if off_by_more_than_half_a_unit(exact[letters], decimal):
            return Verdict(Grade.REFUTED, f"{number.evalf(figures)} against {exact[letters].evalf(figures + 2)}")
    return Verdict(Grade.APPROXIMATION, "within half a unit of the last place")


def _coefficients(expr: Expr) -> dict[Expr, Expr]:
    """Letters -> the number in front of them."""
    found: dict[Expr, Expr] = {}
    for term in Add.make_args(expr.expand()):
        number, letters = term.as_independent(*expr.free_symbols, as_Add=False)
        if number != 0:
            found[letters] = found.get(letters, Integer(0)) + number
    return found
