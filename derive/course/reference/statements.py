"""What a document states, as `problems/<set>/reference.yaml` has it: groups of entries, each pinned to what is given.

A value is an expression in the grammar of the problem files (`states:`), or a formula as the document prints it
(`latex:`): a chain whose sides are each compared, or a relation.
"""

from __future__ import annotations

import re
from collections.abc import Mapping as Table
from dataclasses import dataclass, field, replace

from sympy import Expr, Symbol

from derive.algebra.dimensions import Dimension
from derive.course.expression import Declared, read_expression
from derive.course.problem import Problem, ProblemReader, problem_ids
from derive.course.schema import ENTRY_KEYS, ERRATUM_KEYS, GROUP_KEYS, MAX_FIGURES, check_keys, read_text, wrong_type
from derive.course.units import Unit, read_unit
from derive.course.yaml_tree import Mapping, Node, Scalar, Sequence, read_yaml
from derive.errors import Faults, Place, did_you_mean

_LETTER = re.compile(r"[A-Za-z]+(_[A-Za-z0-9_]+)?")
_FIGURES = re.compile(r"[1-9][0-9]?", re.ASCII)
_VALUE = "an expression, a list of 3, or 3 rows of 3"


@dataclass(frozen=True)
class Stated:
    """A value as the document has it: its entries with their dimensions, and how it was written.

    A value with `\\pm` has two branches. Where it is not `homogeneous` its dimensions mean nothing.
    """

    branches: tuple[tuple[tuple[Expr, Dimension], ...], ...]
    shape: tuple[int, ...]
    text: str
    place: Place = field(repr=False)
    homogeneous: bool = True

    @property
    def entries(self) -> tuple[tuple[Expr, Dimension], ...]:
        return self.branches[0]

    @property
    def letters(self) -> set[Symbol]:
        return {letter for entries in self.branches for expr, _ in entries for letter in expr.free_symbols}


@dataclass(frozen=True)
class Statement:
    """A value, a chain of them, or a relation: the sides, and the mark before each, "" before the first as a rule."""

    sides: tuple[Stated, ...]
    marks: tuple[str, ...]
    text: str
    place: Place = field(repr=False)

    @classmethod
    def of(cls, value: Stated) -> Statement:
        return cls((value,), ("",), value.text, value.place)

    @property
    def letters(self) -> set[Symbol]:
        return {letter for side in self.sides for letter in side.letters}


@dataclass(frozen=True)
class Entry:
    """One line of the file; `figures` has one number for each entry of the value, `unit` is of all of them."""

    answer: str
    part: str | None
    states: Statement
    right: Statement | None
    why: str
    figures: tuple[int, ...]
    unit: Unit | None
    place: Place = field(repr=False)
    put_in: tuple[str, ...] = ()
    times: Statement | None = None


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
        return pinned, _entries(node, pinned, faults)
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


def _entries(group: Mapping, pinned: Problem, faults: Faults) -> list[Entry]:
    node = group.get("entries")
    if node is None:
        return []
    if not isinstance(node, Sequence):
        wrong_type(faults, "`entries`", "a list of entries", node)
        return []
    if not node.items:
        faults.error("missing-value", "`entries` must be a list of entries, but it is empty", node.place)
    # No more is assumed of a letter than that it is real, for a component that steps bring in may be negative; what
    # the derivation knows of it comes back when the two are compared.
    letters = {name: replace(known, symbol=Symbol(name, real=True)) for name, known in pinned.symbols.items()}
    numbers = {measured.symbol.name for measured in pinned.measured}
    reader = _EntryReader(
        letters, {**letters, **_called_otherwise(group.get("letters"), letters, faults)}, numbers, faults
    )
    return [entry for item in node.items if (entry := reader.entry(item))]


def _called_otherwise(node: Node | None, letters: Table[str, Declared], faults: Faults) -> dict[str, Declared]:
    """The letters that the document has for ours: `I_1: I_xx`."""
    if node is None:
        return {}
    if not isinstance(node, Mapping):
        wrong_type(faults, "`letters`", "a mapping such as `I_1: I_xx`", node)
        return {}
    found: dict[str, Declared] = {}
    for key, value in node.pairs:
        ours = value.text if isinstance(value, Scalar) else ""
        if not _LETTER.fullmatch(key.text):
            faults.error("letter", f"`{key.text}` is not a letter or a name such as `omega_1`", key.place)
        elif (twice := next((name for name, known in found.items() if known is letters.get(ours)), None)) is not None:
            message = f"`{twice}` and `{key.text}` both stand for `{ours}`, so that one could be taken for the other"
            faults.error("letter-clash", message, value.place)
        elif ours in letters:
            found[key.text] = letters[ours]
        elif not ours:
            wrong_type(faults, f"`{key.text}`", "one of our letters", value)
        else:
            help_line = did_you_mean(ours, letters) or "declare it under `symbols:`"
            faults.error("undeclared-symbol", f"`{ours}` is not declared", value.place, help=help_line)
    return found


class _EntryReader:
    """Reads the entries of one group: `letters` are ours, `printed` those that the document's formulas may use."""

    def __init__(self, letters: Table[str, Declared], printed: Table[str, Declared], numbers: set[str], faults: Faults):
        self.letters = letters
        self.printed = printed
        self.numbers = numbers
        self.faults = faults

    def entry(self, node: Node) -> Entry | None:
        if not isinstance(node, Mapping):
            wrong_type(self.faults, "an entry", "a mapping with `answer` and `states` or `latex`", node)
            return None
        check_keys(node, ENTRY_KEYS, "an entry", self.faults)
        answer, part, unit = (read_text(node, key, self.faults) for key in ("answer", "part", "in"))
        put_in = self.put_in(node.get("with"))
        states = self.statement(node, put_in)
        why, right = self.erratum(node, put_in)
        factor = self.factor(node)
        read = None
        with self.faults:
            read = read_unit(unit, _place(node, "in")) if unit else None
        figures = _figures(node.get("to"), states, self.faults)
        if answer is None or states is None:
            return None
        return Entry(answer, part, states, right, why, figures, read, _place(node, "answer"), put_in, factor)

    def factor(self, entry: Mapping) -> Statement | None:
        node = entry.get("times")
        if node is None:
            return None
        read = self.one(node, "`times`", entry.get("latex") is not None, True)
        if read and (len(read.sides) > 1 or read.sides[0].shape or len(read.sides[0].branches) > 1):
            self.faults.error("wrong-type", "`times` must be one scalar", node.place)
        return read

    def statement(self, node: Mapping, put_in: tuple[str, ...]) -> Statement | None:
        """What the entry states, in the one notation or the other; a slip of the document need not be homogeneous."""
        plain, printed = node.get("states"), node.get("latex")
        if plain is not None and printed is not None:
            key = node.key("latex")
            message = "an entry has `states` or `latex`, not both"
            self.faults.error("two-values", message, key.place if key else node.place)
        elif plain is None and printed is None:
            if not any(key.text not in ENTRY_KEYS for key, _ in node.pairs):  # a mistyped key is one fault, not two
                message = f"an entry needs `states` or `latex`: {ENTRY_KEYS['states'].meaning}"
                self.faults.error("missing-key", message, node.place)
        elif printed is not None:
            return self.one(printed, "`latex`", True, node.get("erratum") is None and not put_in)
        return self.one(plain, "`states`", False, True) if plain is not None else None

    def one(self, node: Node, key: str, printed: bool, homogeneous: bool) -> Statement | None:
        if not printed:
            value = _stated(node, key, self.letters, self.faults)
            return Statement.of(value) if value else None
        if not isinstance(node, Scalar) or node.empty:
            wrong_type(self.faults, key, "a formula in LaTeX", node)
            return None
        from derive.course.latex import read_latex  # a grammar that few files need

        with self.faults:
            read = read_latex(node, self.printed, homogeneous=homogeneous)
            sides = tuple(Stated(s.branches, s.shape, s.text, s.place, homogeneous) for s in read.sides)
            return Statement(sides, read.marks, " ".join(node.text.split()), node.place)
        return None

    def erratum(self, entry: Mapping, put_in: tuple[str, ...]) -> tuple[str, Statement | None]:
        node = entry.get("erratum")
        if node is None:
            return "", None
        if not isinstance(node, Mapping):
            wrong_type(self.faults, "`erratum`", "a mapping with `why` and `right`", node)
            return "", None
        check_keys(node, ERRATUM_KEYS, "an erratum", self.faults)
        right = node.get("right")
        why = read_text(node, "why", self.faults) or ""
        return why, self.one(right, "`right`", entry.get("latex") is not None, not put_in) if right else None

    def put_in(self, node: Node | None) -> tuple[str, ...]:
        """The letters whose numbers the document has put in; each must have a number of its own."""
        names = []
        for item in _items(node) if node is not None else ():
            name = item.text.strip() if isinstance(item, Scalar) else ""
            known = self.printed.get(name)
            if not name:
                wrong_type(self.faults, "`with`", "letters that have numbers", item)
            elif known is None or known.symbol.name not in self.numbers:
                help_line = "numbers stand under `values:` or `given:`"
                self.faults.error("no-number", f"`{name}` has no number to be put in", item.place, help=help_line)
            else:
                names.append(known.symbol.name)
        return tuple(names)


def _place(node: Mapping, key: str) -> Place:
    value = node.get(key)
    return value.place if value else node.place


def _stated(node: Node, key: str, letters: Table[str, Declared], faults: Faults) -> Stated | None:
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
    return None if len(entries) < len(scalars) else Stated((tuple(entries),), shape, _text(node), node.place)


def _items(node: Node) -> tuple[Node, ...]:
    return node.items if isinstance(node, Sequence) else (node,)


def _text(node: Node) -> str:
    if isinstance(node, Sequence):
        return "[" + ", ".join(_text(item) for item in node.items) + "]"
    return " ".join(node.text.split()) if isinstance(node, Scalar) else ""


def _figures(node: Node | None, states: Statement | None, faults: Faults) -> tuple[int, ...]:
    if node is None:
        return ()
    items = _items(node)
    for item in items:
        text = item.text if isinstance(item, Scalar) else ""
        if not _FIGURES.fullmatch(text) or int(text) > MAX_FIGURES:
            wrong_type(faults, "`to`", f"a whole number from 1 to {MAX_FIGURES}, or a list of them", item)
            return ()
    wanted = len(_values(states.sides[0])) if states else len(items)
    if isinstance(node, Sequence) and len(items) != wanted:
        message = f"`to` has {len(items)} numbers, but the value has {wanted} entries"
        faults.error("wrong-length", message, node.place)
    return tuple(int(item.text) for item in items if isinstance(item, Scalar))


def _values(value: Stated) -> tuple[tuple[Expr, Dimension], ...]:
    """What a list of figures counts: the entries of a vector or tensor, the branches of a scalar."""
    return value.entries if value.shape else tuple(entries[0] for entries in value.branches)
