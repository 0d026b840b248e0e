"""A problem as checked values: its YAML, its script, and the match of `given:` to the signature of `solve()`.

`load_problem` finds every fault of a file before it gives up. Names in prose and answer keys are checked later, by
whoever knows the steps; `Prose.place_of` and `Problem.place_of` say where to point.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from collections.abc import Mapping as Table
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

from sympy import Integer, Symbol

from derive.algebra.dimensions import KINDS, Dimension, kind_with_article, unit_of_kind
from derive.algebra.expressions import TIME, Amount, explicit
from derive.course.expression import RESERVED, Declared
from derive.course.given import Given, Measured, read_givens, read_measured, symbol_of_kind
from derive.course.parts import Part, points_text, read_parts, read_points
from derive.course.placement import Placement, read_placements
from derive.course.prose import Prose, read_prose
from derive.course.schema import (
    DEFAULT_FIGURES,
    PROBLEM_KEYS,
    SET_KEYS,
    SHOWN,
    check_keys,
    read_figures,
    read_text,
    wrong_type,
)
from derive.course.script import Script, imported_script, run
from derive.course.yaml_tree import Mapping, Node, Scalar, Sequence, read_yaml, shape_of
from derive.errors import Complaint, Faults, Misused, Place, Rejected, did_you_mean, nearest
from derive.steps.record import Run, recorded

ANY_OUTCOME = ""
CHAIN = "chain"  # what a sentence calls the lines of its step

_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
_SYMBOL = re.compile(r"[A-Za-z][A-Za-z0-9]{0,15}(_[A-Za-z0-9]{1,8}){0,2}")
_SCRIPT = re.compile(r"[A-Za-z0-9_-]{1,64}\.py")
DOCUMENTS = ("solutions", "problems")  # what a build calls the documents of the whole set
_NOT_PROBLEMS = ("set", "reference")


@dataclass(frozen=True)
class Problem:
    """Everything that a problem's file says, checked; paths are relative to the root."""

    id: str
    path: str
    root: Path
    title: Prose
    statement: Prose
    symbols: Table[str, Declared]
    givens: tuple[Given, ...]
    measured: tuple[Measured, ...]
    parts: tuple[Part, ...]
    points: Fraction | None
    wording: Table[str, Table[str, Prose]]
    show: Table[str, str]
    figures: int
    drawings: tuple[Placement, ...]
    script: Script = field(repr=False)
    script_path: str
    places: Table[str, Place] = field(repr=False)
    note: Prose | None = None

    @property
    def set_id(self) -> str:
        return self.id.partition("/")[0]

    @property
    def inputs(self) -> tuple[str, ...]:
        """The files it was read from."""
        return (self.path, self.script_path)

    @property
    def solve(self) -> Callable[..., object]:
        return self.script.solve

    @property
    def dimensions(self) -> dict[Symbol, Dimension]:
        """The dimension of every letter, also of those that were introduced for numbers."""
        return {declared.symbol: declared.dimension for declared in self.symbols.values()}

    @property
    def amounts(self) -> dict[Symbol, Amount]:
        """The number behind each letter that has one, in the coherent SI unit."""
        units = {m.symbol: unit_of_kind(self.symbols[m.symbol.name].kind) for m in self.measured}
        return {m.symbol: Amount(m.si, units[m.symbol], Integer(1)) for m in self.measured}

    @property
    def texts(self) -> tuple[Prose, ...]:
        """All prose that is printed."""
        wording = (prose for by_outcome in self.wording.values() for prose in by_outcome.values())
        captions = (placement.caption for placement in self.drawings if placement.caption)
        note = (self.note,) if self.note else ()
        return (self.title, self.statement, *(part.ask for part in self.parts), *note, *wording, *captions)

    def place_of(self, *keys: str) -> Place:
        """Where a key was written: `place_of("show", "spin")`, `place_of("given")`."""
        return self.places[".".join(keys)]


def problem_ids(root: Path) -> list[str]:
    """`hw9/block` for every problem file below the root."""
    files = sorted((root / "problems").glob("*/*.yaml"))
    return [f"{file.parent.name}/{file.stem}" for file in files if file.stem not in _NOT_PROBLEMS and _named_well(file)]


def _named_well(file: Path) -> bool:
    return bool(_ID.fullmatch(file.stem) and _ID.fullmatch(file.parent.name))


def load_problem(root: Path, problem_id: str) -> Problem:
    """The problem, or one `Rejected` with every fault of its file and its script."""
    known = problem_ids(root)
    if problem_id not in known:
        raise Misused(
            Complaint("no-such-problem", f"there is no problem `{problem_id}`", help=_meant(problem_id, known))
        )
    path = f"problems/{problem_id}.yaml"
    node = read_yaml(root / path, path)
    if not isinstance(node, Mapping):
        raise Rejected(
            Complaint("wrong-type", f"a problem must be a mapping, but this is {shape_of(node)}", node.place)
        )
    return ProblemReader(root, problem_id, path, node).problem()


def _meant(problem_id: str, known: list[str]) -> str:
    """The nearest id, by the whole or by the name after the set."""
    by_name = {full.partition("/")[2]: full for full in reversed(known)}
    close = nearest(problem_id, known) or by_name.get(nearest(problem_id.rpartition("/")[2], by_name) or "")
    return f"did you mean `{close}`?" if close else "`derive list` shows the problems"


def run_solve(problem: Problem, record: Run | None = None) -> object:
    """What the script's `solve()` returns for what is given; what else it leaves is on the record."""
    record = record or Run()
    record.numbers = {letter: explicit(amount) for letter, amount in problem.amounts.items()}
    written = {given.name: problem.places.get(f"given.{given.name}") for given in problem.givens}
    record.places = {name: place for name, place in written.items() if place}
    with recorded(record):
        return run(problem.script, {given.name: given.value for given in problem.givens})


class ProblemReader:
    """Reads one mapping key by key; a fault in one key does not hide those of the others."""

    def __init__(self, root: Path, problem_id: str, path: str, node: Mapping):
        self.root, self.id, self.path, self.node = root, problem_id, path, node
        self.faults = Faults()
        self.places: dict[str, Place] = {key.text: key.place for key, _ in node.pairs}

    def problem(self) -> Problem:
        check_keys(self.node, PROBLEM_KEYS, "a problem", self.faults)
        title, statement, note = (self.prose(key) for key in ("title", "statement", "note"))
        script_path, script = self.script()
        symbols = self.symbols()
        values = self.values(symbols)
        givens, symbols = self.givens(script, symbols, values)
        parts = read_parts(self.node.get("parts"), self.faults)
        points = self.points(parts)
        wording, show = self.wording(), self.show()
        figures = read_figures(self.node.get("figures"), self.faults) or DEFAULT_FIGURES
        drawings = read_placements(self.mapping("drawings"), symbols, len(parts), self.faults)
        self.faults.stop()
        assert title is not None
        assert statement is not None
        assert script is not None
        return Problem(
            id=self.id,
            path=self.path,
            root=self.root,
            title=title,
            statement=statement,
            symbols=symbols,
            givens=givens,
            measured=(*values, *(measured for given in givens for measured in given.measured)),
            parts=parts,
            points=points,
            wording=wording,
            show=show,
            figures=figures,
            drawings=drawings,
            script=script,
            script_path=script_path,
            places=self.places,
            note=note,
        )

    # -- shapes ---------------------------------------------------------------------------------------------------

    def mapping(self, key: str) -> Mapping:
        """The mapping under a key, empty if the key is absent or has nothing under it."""
        node = self.node.get(key)
        if isinstance(node, Mapping):
            self.places.update({f"{key}.{inner.text}": inner.place for inner, _ in node.pairs})
            return node
        if node is not None and not (isinstance(node, Scalar) and node.empty):
            wrong_type(self.faults, f"`{key}`", "a mapping", node)
        return Mapping((), self.node.place)

    def prose(self, key: str) -> Prose | None:
        node = self.node.get(key)
        if node is None:
            return None
        if isinstance(node, Scalar) and node.empty:
            wrong_type(self.faults, f"`{key}`", "text", node)
        return read_prose(node, key, self.faults)

    # -- keys -----------------------------------------------------------------------------------------------------

    def script(self) -> tuple[str, Script | None]:
        name, node = read_text(self.node, "solve", self.faults), self.node.get("solve")
        if name is None or node is None:
            return "", None
        folder = (self.root / self.path).parent
        if not _SCRIPT.fullmatch(name):
            wrong_type(self.faults, "`solve`", "the name of a script beside this file, such as `block.py`", node)
        elif not (folder / name).exists():
            help_line = did_you_mean(name, (file.name for file in folder.glob("*.py")))
            self.faults.error("missing-file", f"there is no script `{name}`", node.place, help=help_line)
        else:
            shown_as = f"problems/{self.id.partition('/')[0]}/{name}"
            with self.faults:
                module = "derive_problem_" + re.sub(r"\W", "_", f"{self.id}_{name.removesuffix('.py')}")
                return shown_as, imported_script(folder / name, shown_as, module)
        return "", None

    def symbols(self) -> dict[str, Declared]:
        symbols = {}
        for key, node in self.mapping("symbols").pairs:
            name = key.text
            if not _SYMBOL.fullmatch(name) or name in RESERVED:
                why = "has a meaning of its own" if name in RESERVED else "is not a letter or a name such as `omega_0`"
                self.faults.error("symbol", f"`{name}` {why}, so it cannot be declared", key.place)
            kind = node.text if isinstance(node, Scalar) else ""
            if kind not in KINDS:
                close = nearest(kind, KINDS)
                help_line = f"did you mean `{close}`?" if close else f"the kinds are {', '.join(KINDS)}"
                message = f"the kind of `{name}` must be one that is known, but it is {shape_of(node)}"
                self.faults.error("unknown-kind", message, node.place, help=help_line)
                kind = close or "number"  # what was meant, so that one slip is not told again at every use
            elif name == TIME.name and kind != "time":
                message = f"`t` is the time, but it is declared as {kind_with_article(kind)}"
                self.faults.error("time", message, key.place, help="use another letter")
            symbols[name] = Declared(name, symbol_of_kind(name, kind), kind)
        return symbols

    def values(self, symbols: Table[str, Declared]) -> tuple[Measured, ...]:
        found = []
        for key, node in self.mapping("values").pairs:
            with self.faults:
                found.append(read_measured(key, node, symbols))
        return tuple(found)

    def givens(
        self, script: Script | None, symbols: dict[str, Declared], values: tuple[Measured, ...]
    ) -> tuple[tuple[Given, ...], dict[str, Declared]]:
        node = self.mapping("given")
        if script is None:
            return (), symbols
        asked = {parameter.name: parameter for parameter in script.parameters}
        missing = [name for name, parameter in asked.items() if parameter.required and name not in node.names]
        for key, _ in node.pairs:
            if key.text not in asked:
                close = nearest(key.text, missing)
                if close:
                    missing.remove(close)
                help_line = f"did you mean `{close}`?" if close else None
                message = f"`solve()` does not ask for `{key.text}`"
                self.faults.error("unknown-given", message, key.place, help=help_line)
        for name in missing:
            place = self.places.get("given", self.node.place)
            self.faults.error("missing-given", f"`given` lacks `{name}`", place, notes=(asked[name].note,))
        return read_givens(
            {key.text: value for key, value in node.pairs if key.text in asked},
            {name: parameter.kind for name, parameter in asked.items()},
            symbols,
            self.faults,
            notes={name: parameter.note for name, parameter in asked.items()},
            used=[str(measured.symbol) for measured in values],
            numbers={measured.symbol: measured.si for measured in values},
        )

    def points(self, parts: tuple[Part, ...]) -> Fraction | None:
        node = self.node.get("points")
        stated = read_points(node, self.faults)
        counted = [part.points for part in parts if part.points is not None]
        total = sum(counted, Fraction(0))
        if node is None or stated is None or not parts:
            return total if counted else None
        complete = len(counted) == len(parts)
        if total > stated or (complete and total < stated):
            added = f"those of the parts {'' if complete else 'already '}add up to {points_text(total)}"
            self.faults.error("points", f"`points` is {points_text(stated)}, but {added}", node.place)
        return stated

    def wording(self) -> dict[str, dict[str, Prose]]:
        wording = {}
        for key, node in self.mapping("wording").pairs:
            pairs = node.pairs if isinstance(node, Mapping) else ()
            self.places.update({f"wording.{key.text}.{outcome.text}": outcome.place for outcome, _ in pairs})
            entries = [(o.text, n) for o, n in pairs] if isinstance(node, Mapping) else [(ANY_OUTCOME, node)]
            read = {outcome: read_prose(entry, key.text, self.faults) for outcome, entry in entries}
            wording[key.text] = {outcome: prose for outcome, prose in read.items() if prose}
            for prose in wording[key.text].values():
                for again in [mention for mention in prose.mentions if mention.name == CHAIN and not mention.of][1:]:
                    message = f"`<<{CHAIN}>>` stands for the lines of the step, which are printed once"
                    self.faults.error("twice", message, again.place, help="leave all but one of them out")
        return wording

    def show(self) -> dict[str, str]:
        shown = {}
        for key, node in self.mapping("show").pairs:
            if not isinstance(node, Scalar) or node.text not in SHOWN:
                help_line = did_you_mean(node.text, SHOWN) if isinstance(node, Scalar) else None
                wrong_type(self.faults, f"`{key.text}`", "full, result or hidden", node, help_line)
            else:
                shown[key.text] = node.text
        return shown


# -- sets -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class ProblemSet:
    """The heading of a set, and the ids of its problems (`hw9/block`) in order."""

    id: str
    course: str
    title: str
    date: str | None
    instructor: str | None
    problems: tuple[str, ...]
    inputs: tuple[str, ...]

    @property
    def numbers(self) -> dict[str, int]:
        """The number of each problem in the set, by its name."""
        return {full.partition("/")[2]: number for number, full in enumerate(self.problems, 1)}


def set_ids(root: Path) -> list[str]:
    """Every folder below `problems/` that says it is a set."""
    folders = sorted(file.parent.name for file in (root / "problems").glob("*/set.yaml"))
    return [name for name in folders if _ID.fullmatch(name)]


def problem_set(root: Path, set_id: str) -> ProblemSet:
    """The set, or one `Rejected` with every fault of its file."""
    known = set_ids(root)
    if set_id not in known:
        help_line = did_you_mean(set_id, known) or "`derive list` shows the sets"
        raise Misused(Complaint("no-such-set", f"there is no set `{set_id}`", help=help_line))
    path = f"problems/{set_id}/set.yaml"
    node = read_yaml(root / path, path)
    if not isinstance(node, Mapping):
        raise Rejected(Complaint("wrong-type", f"a set must be a mapping, but this is {shape_of(node)}", node.place))
    faults = Faults()
    check_keys(node, SET_KEYS, "a set", faults)
    course, title, date, instructor = (
        read_text(node, key, faults) for key in ("course", "title", "date", "instructor")
    )
    problems = _listed(node.get("problems"), set_id, problem_ids(root), faults)
    faults.stop()
    return ProblemSet(set_id, course or "", title or "", date, instructor, problems, (path,))


def _listed(node: Node | None, set_id: str, known: list[str], faults: Faults) -> tuple[str, ...]:
    if node is None:
        return ()
    if not isinstance(node, Sequence) or not node.items:
        wrong_type(faults, "`problems`", "a list of names", node)
        return ()
    names = [full.partition("/")[2] for full in known if full.startswith(f"{set_id}/")]
    found: list[str] = []
    for item in node.items:
        if not isinstance(item, Scalar) or item.empty:
            wrong_type(faults, "a problem of the set", "a name", item)
        elif item.text in DOCUMENTS:
            message = f"a problem cannot be called `{item.text}`, for a document of the set has that name"
            faults.error("reserved-name", message, item.place, help="rename its files")
        elif item.text not in names:
            help_line = did_you_mean(item.text, names)
            message = f"there is no problem `{item.text}` in this set"
            if item.text in known and not item.text.startswith(f"{set_id}/"):
                message = f"`{item.text}` is a problem of another set"
                help_line = f"copy its files to `problems/{set_id}/` and list it by its name alone"
            faults.error("no-such-problem", message, item.place, help=help_line)
        elif f"{set_id}/{item.text}" in found:
            faults.error("duplicate-problem", f"`{item.text}` is listed twice", item.place)
        else:
            found.append(f"{set_id}/{item.text}")
    return tuple(found)
