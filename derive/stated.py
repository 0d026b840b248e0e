"""What a document states, as `problems/<set>/reference.yaml` has it: groups of entries, each pinned to what is given.

An expression is in the grammar of the problem files; `_stated` is where another notation would be told apart.
"""

from __future__ import annotations

import re
from collections.abc import Mapping as Table
from dataclasses import dataclass, field, replace

from sympy import Expr, Symbol

from derive.dimensions import Dimension
from derive.errors import Place
from derive.problem import Problem, ProblemReader, problem_ids
from derive.reading import Declared, read_expression
from derive.schema import MAX_FIGURES, Key, check_keys, read_text, wrong_type
from derive.source import Faults, Mapping, Node, Scalar, Sequence, did_you_mean, read_yaml
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


def reference_path(problem: Problem) -> str:
    """Where the references of its set are, whether or not there are any; relative to the root."""
    return f"problems/{problem.set_id}/reference.yaml"


def stated_groups(problem: Problem) -> list[tuple[Problem, list[Entry]]]:
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
    elif name is None:
        check_keys(node, GROUP_KEYS, "a group", faults)
    elif f"{problem.set_id}/{name}" == problem.id:
        check_keys(node, GROUP_KEYS, "a group", faults)
        pinned = _pinned(problem, node, faults)
        return pinned, _entries(node.get("entries"), pinned.symbols, faults)
    return None


def _pinned(problem: Problem, node: Mapping, faults: Faults) -> Problem:
    """The problem with the symbols, the given and the values of a group; its parts and its words do not matter here."""
    loader = ProblemReader(problem.root, problem.id, reference_path(problem), node)
    loader.faults = faults
    symbols = loader.symbols()
    values = loader.values(symbols)
    givens, symbols = loader.givens(problem.script, symbols, values) if node.get("given") else ((), symbols)
    measured = (*values, *(measured for given in givens for measured in given.measured))
    return replace(problem, symbols=symbols, givens=givens, measured=measured, places=loader.places)


def _entries(node: Node | None, symbols: Table[str, Declared], faults: Faults) -> list[Entry]:
    if node is None:
        return []
    if not isinstance(node, Sequence):
        wrong_type(faults, "`entries`", "a list of entries", node)
        return []
    if not node.items:
        faults.error("missing-value", "`entries` must be a list of entries, but it is empty", node.place)
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
    if node is None:
        return None
    rows = [_items(item) for item in _items(node)]
    nested = any(isinstance(item, Sequence) for item in _items(node))
    lengths = [len(row) for row in rows]
    shape = (3, 3) if nested else (3, 1) if isinstance(node, Sequence) else ()
    scalars = [item for row in rows for item in row if isinstance(item, Scalar)]
    if isinstance(node, Mapping) or lengths != {(): [1], (3, 1): [1] * 3, (3, 3): [3] * 3}[shape]:
        found = f"has rows of {', '.join(map(str, lengths))}" if nested else f"has {len(rows)}"
        message = f"{key} must be {_VALUE}, but it {found if shape else 'is a mapping'}"
        faults.error("wrong-length" if shape else "wrong-type", message, node.place)
        return None
    if len(scalars) < sum(lengths):
        wrong_type(faults, f"an entry of {key}", "an expression", next(i for r in rows for i in r if i not in scalars))
        return None
    entries = []
    for scalar in scalars:
        with faults:
            entries.append(read_expression(scalar, letters))
    return None if len(entries) < len(scalars) else Stated(tuple(entries), shape, _text(node), node.place)


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
