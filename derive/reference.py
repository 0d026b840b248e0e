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

import re
from collections.abc import Mapping as Table
from collections.abc import Sequence as Row
from dataclasses import dataclass, field, replace
from typing import Any

from sympy import Add, Expr, Integer, MatrixSymbol, Rational, Symbol

from derive.derivation import returned_quantities, with_ancestors
from derive.dimensions import NUMBER, Dimension, dimension_of_kind, kind_with_article, named
from derive.errors import Complaint, DeriveError, Place
from derive.evidence import Grade, Verdict, equal
from derive.expressions import AXES, component_names, explicit
from derive.problem import Problem, _Loader, problem_ids, run_solve
from derive.reading import Declared, read_expression
from derive.rounding import Rounded, off_by_more_than_half_a_unit
from derive.schema import MAX_FIGURES, Key, check_keys, read_text, wrong_type
from derive.source import Faults, Mapping, Node, Scalar, Sequence, did_you_mean, read_yaml
from derive.step import Quantity
from derive.units import Unit, read_unit

GROUP_KEYS: Table[str, Key] = {
    "problem": Key("the problem of this set that the document solves", {}, required=True),
    "symbols": Key("letters of the document and their kinds, also those that steps bring in", {}),
    "given": Key("what the document starts from, as in the problem's file", {}, required=True),
    "values": Key("numbers for letters, put in where a stated value lacks the letter", {}),
    "entries": Key("the values that the document states", {}, required=True),
}
ENTRY_KEYS: Table[str, Key] = {
    "part": Key("the part of the document", {}),
    "answer": Key("the key of the step that has this value", {}, required=True),
    "states": Key("the value: an expression, 3 of them, or 3 rows of 3", {}, required=True),
    "to": Key("decimals agree to so many figures; a list has one number for each entry", {}),
    "in": Key("the unit of the stated value", {}),
    "erratum": Key("the document is wrong here", {}),
}
ERRATUM_KEYS: Table[str, Key] = {
    "why": Key("what is wrong, in a few words", {}, required=True),
    "right": Key("the value that it should state", {}, required=True),
}

_FIGURES = re.compile(r"[1-9][0-9]?", re.ASCII)
_VALUE = "an expression, a list of 3, or 3 rows of 3"


@dataclass(frozen=True)
class Stated:
    """A value as the document has it: its entries with their dimensions, and how it was written."""

    entries: tuple[tuple[Expr, Dimension], ...]
    shape: tuple[int, ...]
    text: str
    place: Place = field(repr=False)

    @property
    def letters(self) -> set[Symbol]:
        return {letter for expr, _ in self.entries for letter in expr.free_symbols}


@dataclass(frozen=True)
class Entry:
    """One line of the file; `figures` has one number for each entry of the value, `unit` is of all of them."""

    answer: str
    part: str | None
    states: Stated
    right: Stated | None
    why: str
    figures: tuple[int, ...]
    unit: Unit | None
    place: Place = field(repr=False)


@dataclass(frozen=True)
class Comparison:
    """What became of one entry; `complaint` says what is wrong if it counts as a failure."""

    problem: str
    entry: Entry
    outcome: str
    grade: Grade | None
    detail: str
    complaint: Complaint | None = None

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


def reference_path(problem: Problem) -> str:
    """Where the references of its set are, whether or not there are any; relative to the root."""
    return f"problems/{problem.set_id}/reference.yaml"


def comparisons(problem: Problem, known: Steps) -> tuple[Comparison, ...]:
    """Every entry about this problem, compared; `known` are its steps for what its own file gives."""
    derived: list[tuple[dict[str, Any], Steps]] = [(_given(problem), known)]
    found = []
    for pinned, entries in _groups(problem):
        given = _given(pinned)
        steps = next((steps for other, steps in derived if other == given), None)
        if steps is None:
            steps = _derived_again(pinned)
            derived.append((given, steps))
        found += [_comparison(entry, steps, pinned) for entry in entries]
    return tuple(found)


def _given(problem: Problem) -> dict[str, Any]:
    return {given.name: given.value for given in problem.givens}


def _derived_again(pinned: Problem) -> Steps:
    try:
        return with_ancestors(returned_quantities(run_solve(pinned)))
    except DeriveError as error:
        place = pinned.place_of("given")
        note = f"this is for what is given at {place.path}:{place.line}"
        raise type(error)(replace(c, notes=(*c.notes, note)) for c in error.complaints) from error


# --- comparing -------------------------------------------------------------------------------------------------------


def _comparison(entry: Entry, steps: Steps, pinned: Problem) -> Comparison:
    def comparison(outcome: str, grade: Grade | None, detail: str, complaint: Complaint | None = None) -> Comparison:
        return Comparison(pinned.id, entry, outcome, grade, detail, complaint)

    def fault(code: str, message: str, place: Place, *notes: str, help: str | None = None) -> Complaint:
        return Complaint(code, message, place, notes, help, severity="warning")

    step = steps.get(entry.answer)
    if step is None:
        message = f"no step is called `{entry.answer}`"
        help_line = did_you_mean(entry.answer, steps)
        complaint = fault("unknown-step", message, entry.place, help=help_line)
        return comparison("unknown step", None, message, complaint)
    verdict = _verdict(entry.states, step, entry, pinned)
    said = _said(verdict)
    if entry.right is not None and verdict:
        message = f"the document is right about `{entry.answer}`, so this is no erratum"
        return comparison("differs", verdict.grade, message, fault("no-erratum", message, entry.states.place, said))
    wrong = entry.states
    if entry.right is not None:
        wrong, verdict = entry.right, _verdict(entry.right, step, entry, pinned)
        if verdict:
            return comparison("erratum", verdict.grade, f"{entry.why}: {said}")
    if not verdict:
        what = "what the document states" if wrong is entry.states else "`right`"
        notes = (f"derived    {_short(step.value)}", f"stated against derived: {_said(verdict)}")
        complaint = fault("differs", f"`{entry.answer}` differs from {what}", wrong.place, *notes)
        return comparison("differs", verdict.grade, _said(verdict), complaint)
    figures = min(entry.figures, default=0)
    plural = "figure" if figures == 1 else "figures"
    return comparison(f"agrees to {figures} {plural}" if figures else "agrees", verdict.grade, verdict.detail)


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
        return Verdict(Grade.REFUTED, f"{_SHAPES.get(stated.shape)} against {_SHAPES.get(shape, 'another shape')}")
    letters = _meanings(stated, step, derived, pinned)
    values = [explicit(expr.xreplace(letters)) for expr, _ in stated.entries]
    numbers = {m.symbol: m.si for m in pinned.measured if not any(m.symbol in v.free_symbols for v in values)}
    factor = entry.unit.factor if entry.unit else Integer(1)
    worst = Verdict(Grade.PROVED, "identical")
    for i, right in enumerate(derived if shape else [derived]):
        right, dimension = (
            right.xreplace(numbers),
            stated.entries[i][1] * (entry.unit.dimension if entry.unit else NUMBER),
        )
        verdict = _of_kind(dimension, values[i], step.step.kind) if not numbers else None
        if verdict is None and entry.figures:
            verdict = _to_figures(values[i], right / factor, entry.figures[i % len(entry.figures)])
        verdict = verdict or equal(values[i] * factor, right)
        if not verdict:
            return replace(verdict, detail=_named_entry(i, shape) + verdict.detail)
        if worst.grade is Grade.PROVED and verdict.detail != "identical":
            worst = verdict
    return worst


_SHAPES: Table[tuple[int, ...], str] = {(): "a scalar", (3, 1): "a vector", (3, 3): "a tensor"}


def _named_entry(i: int, shape: tuple[int, ...]) -> str:
    if not shape:
        return ""
    return f"{AXES[i]}: " if shape[1] == 1 else f"{AXES[i // 3]}{AXES[i % 3]}: "


def _meanings(stated: Stated, step: Quantity, derived: Any, pinned: Problem) -> dict[Symbol, Expr]:
    """What each letter of a stated value is in the derivation: the same letter, or what an earlier step found."""
    own = {letter.name: letter for letter in derived.free_symbols}
    own |= {declared.name: declared.symbol for declared in pinned.symbols.values() if declared.name not in own}
    given = {letter.name for expr in _expressions(_given(pinned).values()) for letter in expr.free_symbols}
    found = _found_before(step)
    meanings = {}
    for letter in stated.letters:
        values = found.get(letter.name, [])
        is_own = letter in {*derived.free_symbols} or letter.name in given or len(values) != 1
        meanings[letter] = (
            own[letter.name] if is_own or letter.name in {s.name for s in derived.free_symbols} else values[0]
        )
    return meanings


def _expressions(values: Any) -> list[Expr]:
    return [expr for v in values for expr in (v if isinstance(v, tuple) else (v,)) if isinstance(expr, Expr)]


def _found_before(step: Quantity) -> dict[str, list[Any]]:
    """Name -> the different values that it has among the steps behind this one; those of general vectors left out."""
    found: dict[str, list[Any]] = {}
    for quantity in with_ancestors(step.parents).values():
        names: Row[Symbol] = [quantity.symbol] if isinstance(quantity.symbol, Symbol) else []
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


# --- reading ---------------------------------------------------------------------------------------------------------


def _groups(problem: Problem) -> list[tuple[Problem, list[Entry]]]:
    """The groups about this problem, each as the problem with what it pins, or `Rejected` with every fault.

    Groups of other problems are read when those are derived: their faults are not faults of this one.
    """
    path = reference_path(problem)
    if not (problem.root / path).exists():
        return []
    node = read_yaml(problem.root / path, path)
    faults = Faults()
    if not isinstance(node, Sequence):
        wrong_type(faults, "a reference", "a list of groups, each with `problem`, `given` and `entries`", node)
    ids = problem_ids(problem.root)
    items = node.items if isinstance(node, Sequence) else ()
    groups = [group for item in items if (group := _group(item, problem, ids, faults))]
    faults.stop()
    return groups


def _group(node: Node, problem: Problem, ids: list[str], faults: Faults) -> tuple[Problem, list[Entry]] | None:
    if not isinstance(node, Mapping):
        wrong_type(faults, "a group", "a mapping with `problem`, `given` and `entries`", node)
        return None
    name = read_text(node, "problem", faults)
    if name is not None and f"{problem.set_id}/{name}" not in ids:
        place = node.get("problem")
        help_line = did_you_mean(name, (i.partition("/")[2] for i in ids if i.startswith(f"{problem.set_id}/")))
        message = f"there is no problem `{name}` in this set"
        faults.error("no-such-problem", message, place.place if place else node.place, help=help_line)
    elif name is None or f"{problem.set_id}/{name}" == problem.id:
        check_keys(node, GROUP_KEYS, "a group", faults)
        pinned = _pinned(problem, node, faults)
        return (pinned, _entries(node.get("entries"), pinned.symbols, faults)) if name else None
    return None


def _pinned(problem: Problem, node: Mapping, faults: Faults) -> Problem:
    """The problem with the symbols, the given and the values of a group; its parts and its words do not matter here."""
    loader = _Loader(problem.root, problem.id, reference_path(problem), node)
    loader.faults = faults
    symbols = loader.symbols()
    values = loader.values(symbols)
    givens, symbols = loader.givens(problem.script, symbols, values) if node.get("given") else ((), symbols)
    measured = (*values, *(measured for given in givens for measured in given.measured))
    return replace(problem, symbols=symbols, givens=givens, measured=measured, places=loader.places)


def _entries(node: Node | None, symbols: Table[str, Declared], faults: Faults) -> list[Entry]:
    if node is None:
        return []
    if not isinstance(node, Sequence) or not node.items:
        wrong_type(faults, "`entries`", "a list of entries", node)
        return []
    # No more is assumed of a letter than that it is real, for a component that steps bring in may be negative; what
    # the derivation knows of it comes back when the two are compared.
    letters = {name: replace(known, symbol=Symbol(name, real=True)) for name, known in symbols.items()}
    return [entry for item in node.items if (entry := _entry(item, letters, faults))]


def _entry(node: Node, letters: Table[str, Declared], faults: Faults) -> Entry | None:
    if not isinstance(node, Mapping):
        wrong_type(faults, "an entry", "a mapping with `answer` and `states`", node)
        return None
    check_keys(node, ENTRY_KEYS, "an entry", faults)
    answer, part, unit = (read_text(node, key, faults) for key in ("answer", "part", "in"))
    states = _stated(node.get("states"), "`states`", letters, faults)
    why, right = _erratum(node.get("erratum"), letters, faults)
    read = None
    with faults:
        read = read_unit(unit, _place(node, "in")) if unit else None
    figures = _figures(node.get("to"), states, faults)
    if answer is None or states is None:
        return None
    return Entry(answer, part, states, right, why, figures, read, _place(node, "answer"))


def _place(node: Mapping, key: str) -> Place:
    value = node.get(key)
    return value.place if value else node.place


def _erratum(node: Node | None, letters: Table[str, Declared], faults: Faults) -> tuple[str, Stated | None]:
    if node is None:
        return "", None
    if not isinstance(node, Mapping):
        wrong_type(faults, "`erratum`", "a mapping with `why` and `right`", node)
        return "", None
    check_keys(node, ERRATUM_KEYS, "an erratum", faults)
    return read_text(node, "why", faults) or "", _stated(node.get("right"), "`right`", letters, faults)


def _stated(node: Node | None, key: str, letters: Table[str, Declared], faults: Faults) -> Stated | None:
    """A stated value. It is in the grammar of the problem files; another notation would be told apart here."""
    if node is None:
        return None
    rows = [_items(item) for item in _items(node)]
    scalars = [item for row in rows for item in row if isinstance(item, Scalar)]
    lengths = {len(row) for row in rows}
    is_list = isinstance(node, Sequence)
    nested = is_list and any(isinstance(item, Sequence) for item in _items(node))
    if len(scalars) != (9 if nested else 3 if is_list else 1) or lengths != {3 if nested else 1}:
        wrong_type(faults, key, _VALUE, node)
        return None
    entries = []
    for scalar in scalars:
        with faults:
            entries.append(read_expression(scalar, letters))
    shape = (3, 3) if nested else (3, 1) if is_list else ()
    return Stated(tuple(entries), shape, _text(node), node.place)


def _items(node: Node) -> tuple[Node, ...]:
    return node.items if isinstance(node, Sequence) else (node,)


def _text(node: Node) -> str:
    if isinstance(node, Sequence):
        return "[" + ", ".join(_text(item) for item in node.items) + "]"
    return " ".join(node.text.split()) if isinstance(node, Scalar) else ""


def _figures(node: Node | None, states: Stated | None, faults: Faults) -> tuple[int, ...]:
    if node is None:
        return ()
    items = _items(node)
    for item in items:
        text = item.text if isinstance(item, Scalar) else ""
        if not _FIGURES.fullmatch(text) or int(text) > MAX_FIGURES:
            wrong_type(faults, "`to`", f"a whole number from 1 to {MAX_FIGURES}, or a list of them", item)
            return ()
    if isinstance(node, Sequence) and states and len(items) != len(states.entries):
        message = f"`to` has {len(items)} numbers, but the value has {len(states.entries)} entries"
        faults.error("wrong-length", message, node.place)
    return tuple(int(item.text) for item in items if isinstance(item, Scalar))
