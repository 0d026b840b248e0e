"""The statements of a document in `problems/<set>/reference.yaml`: groups of entries. Each group states its own given
values, which replace those of the problem.

A value is an expression in the grammar of the problem files (`states:`), or a formula as the document prints it
(`latex:`). Such a formula may be a relation, or a chain of values, each of which is compared.
"""

from __future__ import annotations

import re
from collections.abc import Mapping as Table
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from sympy import Expr, Symbol

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.expressions import AXES, TIME
from derive.course.declarations import declared_letters
from derive.course.expression import Declared, read_expression
from derive.course.problem import Problem, pinned_by
from derive.course.problem_set import mapping_in, problem_ids
from derive.course.reference.keys import DocumentKeys, EntryKeys, GroupKeys, OwnKeys
from derive.course.reference.quotes import Lines, Remark, unquotable
from derive.course.schema import (
    MAX_FIGURES,
    TEXT,
    check_keys,
    keys_of,
    read_record,
    wrong_type,
)
from derive.course.yaml_tree import Mapping, Scalar, Sequence, Tree, Word, read_yaml
from derive.errors import Faults, Place, Rejected, did_you_mean
from derive.units import Unit, read_unit

if TYPE_CHECKING:
    from derive.course.reference.cited import Cited, Formula

_LETTER = re.compile(r"[A-Za-z]+(_[A-Za-z0-9_]+)?")
_FIGURES = re.compile(r"[1-9][0-9]?", re.ASCII)
DOCUMENTS = frozenset([".tex", ".ltx", ".md", ".markdown", ".ipynb", ".txt"])
_VALUE = "an expression, a list of 3, or 3 rows of 3"


@dataclass(frozen=True)
class Stated:
    """A value as the document states it: its entries with their dimensions, and its original text.

    A value with `\\pm` has two branches. If `homogeneous` is false, the dimensions are unknown.
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
    """A value, a chain of values, or a relation: the sides, and the sign before each side, such as `=` or `<`."""

    sides: tuple[Stated, ...]
    marks: tuple[str, ...]
    text: str
    place: Place = field(repr=False)
    is_named: bool = False  # whether the first side is a letter, which is perhaps just a name of the value: `T = ...`

    @classmethod
    def of(cls, value: Stated) -> Statement:
        return cls((value,), ("",), value.text, value.place)

    @property
    def letters(self) -> set[Symbol]:
        return {letter for side in self.sides for letter in side.letters}


@dataclass(frozen=True)
class Entry:
    """One entry of the file.

    states      the value in the document; None if nothing is compared, as for an erratum that is only quoted
    right       the value that the document should state, for an erratum
    figures     the significant figures: one number, or one for each component or branch; empty for an exact value
    unit        the unit of every component
    put_in      the names of the letters that the document has replaced by numbers
    times       the factor by which the document has multiplied the derived equation
    quote       what the document prints, in its own letters
    instead     what the document should print, in its own letters
    """

    answer: str
    part: str | None
    states: Statement | None
    right: Statement | None
    why: str
    figures: tuple[int, ...]
    unit: Unit | None
    place: Place = field(repr=False)
    put_in: tuple[str, ...] = ()
    times: Statement | None = None
    line: int | None = None
    quote: str = ""
    instead: str = ""
    remark: Remark | None = None
    document: str = ""
    symbol: str = ""  # the letter that a chain of a section begins with, if the entry does not name a step


def reference_path(problem: Problem) -> str:
    """Return the path of the reference file of the problem's set, relative to the root; the file need not exist."""
    return f"problems/{problem.set_id}/reference.yaml"


def reference_paths(problem: Problem) -> list[str]:
    """Return the paths of the reference file of the problem's set and of the documents that it may cite. These are the
    documents in its folder."""
    folder = Path("problems", problem.set_id)
    documents = sorted((problem.root / folder).glob("*.*"))
    cited = [f"{folder.as_posix()}/{file.name}" for file in documents if file.suffix.lower() in DOCUMENTS]
    return [reference_path(problem), *cited]


def reference_of_set(root: Path, set_id: str) -> Tree | None:
    """Return the contents of the reference file of a set; None if there is no such file."""
    path = f"problems/{set_id}/reference.yaml"
    return read_yaml(root / path, path) if (root / path).exists() else None


def read_ahead(root: Path, set_id: str) -> None:
    """Read the reference of a set and the document that it names, so that worker processes share them."""
    node = reference_of_set(root, set_id)
    first = node.items[0] if isinstance(node, Sequence) and node.items else None
    named = first.get("document") if isinstance(first, Mapping) else None
    if isinstance(named, Scalar):
        from derive.course.reference.cited import cited

        cited(root, set_id, named.text.strip())


def stated_groups(problem: Problem) -> list[tuple[Problem, list[Entry]]]:
    """Return a pair for each group about this problem: the problem with the group's input, and the group's entries.
    Raise `Rejected` if there are errors.

    Errors inside groups for other problems are not reported.
    """
    faults = Faults()
    own = [_own_group(problem, faults)] if problem.reference else []
    node = reference_of_set(problem.root, problem.set_id)
    if node is None:
        faults.stop()
        return own
    if not isinstance(node, Sequence):
        wrong_type(faults, "a reference", "a list of groups, each with `problem`, `given` and `entries`", node)
    ids = problem_ids(problem.root)
    items = node.items if isinstance(node, Sequence) else ()
    document = ""
    if items and isinstance(items[0], Mapping) and items[0].get("document") is not None:
        document = read_record(DocumentKeys, items[0], "a document", faults).document or ""
        items = items[1:]
    groups = [group for item in items if (group := _group(item, problem, ids, document, faults))]
    faults.stop()
    return [*own, *groups]


def _own_group(problem: Problem, faults: Faults) -> tuple[Problem, list[Entry]]:
    node = mapping_in(problem.root, problem.path, "a problem").get("reference")
    assert isinstance(node, Mapping)
    group = read_record(OwnKeys, node, "`reference`", faults)
    described = problem.described.letters if problem.described else {}
    symbols = {**problem.symbols, **described, **declared_letters(group.symbols, faults)}
    pinned = replace(problem, symbols=symbols)
    return pinned, _entries(group, pinned, group.source or "", faults, has_lines=False)


def _group(
    node: Tree, problem: Problem, ids: list[str], document: str, faults: Faults
) -> tuple[Problem, list[Entry]] | None:
    if not isinstance(node, Mapping):
        wrong_type(faults, "a group", "a mapping with `problem`, `given` and `entries`", node)
        return None
    named = node.get("problem")
    name = TEXT.read(named, "problem", faults) if named else None
    if name is None:
        check_keys(node, keys_of(GroupKeys), "a group", faults)
    elif f"{problem.set_id}/{name}" not in ids:
        help_line = did_you_mean(name, (i.partition("/")[2] for i in ids if i.startswith(f"{problem.set_id}/")))
        faults.error("no-such-problem", f"no problem of this set is called `{name}`", name.place, help=help_line)
    elif f"{problem.set_id}/{name}" == problem.id:
        group = read_record(GroupKeys, node, "a group", faults)
        # The group replaces the input of the problem.
        script = problem.script if "given" in group.places else None
        pins = pinned_by(group.symbols, group.values, group.given, group.places, script, faults)
        pinned = replace(problem, places=group.places, **vars(pins))
        return pinned, _entries(group, pinned, document, faults)
    return None


def _entries(
    group: GroupKeys | OwnKeys, pinned: Problem, document: str, faults: Faults, has_lines: bool = True
) -> list[Entry]:
    # A letter is assumed only to be real, because a component that steps introduce may be negative.
    known_to_all = {TIME.name: Declared(TIME.name, TIME, "time"), **pinned.symbols}
    letters = {name: replace(known, symbol=Symbol(name, real=True)) for name, known in known_to_all.items()}
    numbers = {measured.symbol.name for measured in pinned.measured}
    vectors = {name: value for name, value in group.letters.items() if isinstance(value, Sequence)}
    others = {name: value for name, value in group.letters.items() if name not in vectors}
    printed = {**letters, **_called_otherwise(others, letters, faults)}
    for name, vector in vectors.items():
        printed |= _components(name, vector, letters, faults)
    reader = _EntryReader(letters, printed, numbers, faults, pinned, document if has_lines else "")
    for written in group.entries:
        lines = written.line is not None or written.lines is not None
        if document and has_lines and not lines and (written.erratum or written.remark):
            faults.error("missing-key", f"errata and remarks need `line`: a line of `{document}`", written.places[""])
    found = [(written, entry) for written in group.entries for entry in reader.entries(written)]
    return [replace(entry, document=str(written.document or document)) for written, entry in found]


def _called_otherwise(written: Table[Word, Tree], letters: Table[str, Declared], faults: Faults) -> dict[str, Declared]:
    """Return the letters that the document uses in place of the problem's letters: `I_1: I_xx`."""
    found: dict[str, Declared] = {}
    for name, value in written.items():
        ours = value.text if isinstance(value, Scalar) else ""
        if not _LETTER.fullmatch(name):
            faults.error("letter", f"`{name}` is not a letter or a name such as `omega_1`", name.place)
        elif (twice := next((other for other, known in found.items() if known is letters.get(ours)), None)) is not None:
            message = f"`{twice}` and `{name}` both stand for `{ours}`, so one could be taken for the other"
            faults.error("letter-clash", message, value.place)
        elif ours in letters:
            found[str(name)] = letters[ours]
        elif not ours:
            wrong_type(faults, f"`{name}`", "a letter of the problem", value)
        else:
            help_line = did_you_mean(ours, letters) or "declare it under `symbols:`"
            faults.error("undeclared-symbol", f"`{ours}` is not declared", value.place, help=help_line)
    return found


@dataclass(frozen=True)
class _Component(Declared):
    """A component of a vector of the document, as an expression in the problem's letters."""

    measured: Dimension = NUMBER

    @property
    def dimension(self) -> Dimension:
        return self.measured


def _components(name: Word, vector: Sequence, letters: Table[str, Declared], faults: Faults) -> dict[str, Declared]:
    """Return the components of a vector that the document names by a letter: `L: [I_x*omega_x, 0, 0]`."""
    stated = _stated(vector, f"`{name}`", letters, faults)
    if stated is None or stated.shape != (3, 1):
        return {}
    names = [f"{name}_{axis}" for axis in AXES]
    found = zip(names, stated.entries, strict=True)
    return {axis: _Component(axis, expr, "", measured=dimension) for axis, (expr, dimension) in found}


def is_quoted_only(written: EntryKeys) -> bool:
    """Return whether an entry only quotes a misprint, so that there is nothing to compare."""
    states = (written.answer, written.latex, written.states, written.remark)
    quotes = written.quote is not None or written.lines is not None
    return written.erratum is not None and quotes and all(each is None for each in states)


class _EntryReader:
    """Reads the entries of one group; `printed` contains the letters that the document's formulas may use."""

    def __init__(
        self,
        letters: Table[str, Declared],
        printed: Table[str, Declared],
        numbers: set[str],
        faults: Faults,
        problem: Problem,
        document: str,
    ):
        self.letters = letters
        self.printed = printed
        self.numbers = numbers
        self.faults = faults
        self.problem = problem
        self.document = document
        self.lacks_document = False

    def entries(self, written: EntryKeys) -> list[Entry]:
        """Return one entry, or several for a section."""
        if written.lines is None or not written.lines.section:
            entry = self.entry(written)
            return [entry] if entry else []
        other = written.values_at.keys() - {"lines", "part", "document"}
        if other:
            message = f"an entry with a section cannot have `{min(other)}`"
            self.faults.error("two-values", message, written.places[min(other)], help="give the lines of one formula")
            return []
        document = self.cited(written)
        if document is None:
            self.no_document(written)
            return []
        from derive.course.latex.values import Letters

        found: list[Entry] = []
        place = written.lines.place
        with self.faults:
            for letter, formula in document.section(written.lines.section, written.lines.place):
                if letter is not None and (states := self.of_document(formula, True, place)) is not None:
                    declared = Letters(self.printed).named(letter.base, letter.sub)
                    name = f"{letter.base}_{letter.sub}" if letter.sub else letter.base
                    symbol = declared.symbol.name if declared else name
                    line = formula.scalar.place.line
                    entry = Entry("", written.part, states, None, "", (), None, formula.scalar.place)
                    found.append(replace(entry, line=line, symbol=symbol))
        return found

    def entry(self, written: EntryKeys) -> Entry | None:
        formula = self.formula(written)
        if written.lines is not None and formula is None:
            return None
        self.check_quoted(written)
        if is_quoted_only(written):
            return self.slip(written, formula)
        put_in = self.put_in(written.put_in)
        states = self.statement(written, put_in, formula)
        why, right = self.erratum(written, put_in, formula is not None)
        factor = self.factor(written, formula is not None)
        unit = None
        with self.faults:
            unit = self.unit(written, formula)
        figures = _figures(written.to, states, self.faults)
        quote, instead = self.quotes(written, formula, unit)
        line = self.line(written)
        remark = Remark(written.part, line, quote, written.remark) if written.remark else None
        if remark and not quote and "quote" not in written.values_at:
            self.faults.error("missing-key", "a remark needs `quote`: what the document prints", written.places[""])
        if written.answer is None and (states is not None or not remark):
            message = f"an entry needs `answer`: {keys_of(EntryKeys)['answer'].meaning}"
            self.faults.error("missing-key", message, written.places[""])
        if remark and written.answer is None and states is None:
            place = written.places["remark"]
            return Entry("", written.part, None, None, "", (), None, place, line=line, remark=remark)
        if written.answer is None or states is None:
            return None
        entry = Entry(
            written.answer, written.part, states, right, why, figures, unit, written.answer.place, put_in, factor
        )
        return replace(entry, line=line, quote=quote, instead=instead, remark=remark)

    def line(self, written: EntryKeys) -> int | None:
        if written.line is None and written.lines is not None:
            return written.lines.ranges[0][0]
        return written.line

    # -- the document ---------------------------------------------------------------------------------------------

    def cited(self, written: EntryKeys) -> Cited | None:
        """Return the document of an entry; None if no document is named, or if it is not a file of the set."""
        name = str(written.document or self.document)
        if not name:
            return None
        from derive.course.reference.cited import cited  # imported here, because few references have a document

        return cited(self.problem.root, self.problem.set_id, name)

    def formula(self, written: EntryKeys) -> Formula | None:
        """Return the formula of the document that an entry cites by its lines; None if the entry cites no formula, or
        if the formula cannot be read."""
        has_value = written.latex is not None or written.states is not None
        lines = written.lines
        if lines is None and written.line is not None and not has_value and (written.answer or written.quote is None):
            lines = Lines(((written.line, written.line),), "", written.values_at["line"])
        if lines is None:
            return None
        document = self.cited(written)
        if document is None:
            if written.lines is not None:
                self.no_document(written)
            return None
        with self.faults:
            return document.formula(lines.ranges, written.side, lines.place)
        return None

    def no_document(self, written: EntryKeys) -> None:
        """Report once that the cited document is not a file of the set."""
        if not self.lacks_document:
            self.lacks_document = True
            name = written.document or self.document
            folder = f"problems/{self.problem.set_id}"
            message = f"`{folder}` has no document `{name}`" if name else "this reference does not name a document"
            help_line = f"name a file of `{folder}` in this entry: `document: solutions.md`"
            self.faults.error("no-document", message, written.values_at["lines"], help=help_line)

    def check_quoted(self, written: EntryKeys) -> None:
        """Check that the document has the quoted text at the line of the entry."""
        line = self.line(written)
        quoted = [each for each in (written.quote, written.latex) if each is not None]
        if line is None or not quoted or (document := self.cited(written)) is None:
            return
        for each in quoted:
            text = each.text if isinstance(each, Scalar) else str(each)
            if not document.quotes(text, line):
                name, near = document.file.path, document.lines_of(text)
                help_line = f"the text is in line {near}" if near else f"the line is `{document.shown(line)}`"
                message = f"`{name}` does not have this text in line {line}"
                self.faults.error("quotation", message, each.place, help=help_line)

    def unit(self, written: EntryKeys, formula: Formula | None) -> Unit | None:
        stated = read_unit(written.unit, written.unit.place) if written.unit else None
        printed = formula.unit if formula else None
        if stated and printed and (stated.factor, stated.dimension) != (printed.factor, printed.dimension):
            message = f"the document has the unit `{printed.text}`, not `{stated.text}`"
            self.faults.error("wrong-unit", message, written.values_at["in"])
        return stated or printed

    def slip(self, written: EntryKeys, formula: Formula | None) -> Entry | None:
        """Return an entry for an erratum that is only quoted and corrected; None if its correction cannot be quoted."""
        assert written.erratum is not None
        right, place = written.erratum.right, written.places.get("quote") or written.places[""]
        instead = right.text if isinstance(right, Scalar) else ""
        if right is not None and (why := unquotable(instead) if instead else "it is not text") is not None:
            self.faults.error("quotation", f"`right`: {why}", right.place)
            return None
        quote = str(written.quote or (formula and formula.quotation) or "")
        told = written.erratum.why or ""
        return Entry(
            "", written.part, None, None, told, (), None, place, line=self.line(written), quote=quote, instead=instead
        )

    def quotes(self, entry: EntryKeys, formula: Formula | None, unit: Unit | None) -> tuple[str, str]:
        """Return what the document prints, and what it should print.

        Both are empty for an entry that is neither an erratum nor a remark.
        """
        if entry.erratum is None and entry.remark is None:
            return "", ""
        is_printed = entry.latex is not None or formula is not None
        should = entry.erratum.right if entry.erratum and is_printed else None
        printed = formula.quotation if formula else _in_dollars(entry.latex)
        right = _in_dollars(should)
        for text in (printed, right):
            if (why := unquotable(text)) is not None:
                self.faults.error("quotation", f"this cannot be quoted: {why}", entry.places[""])
                return "", ""
        suffix = f" {unit.text}" if unit and right else ""  # the correct value is followed by its unit
        return str(entry.quote or printed), f"{right}{suffix}"

    def factor(self, entry: EntryKeys, is_cited: bool) -> Statement | None:
        node = entry.times
        if node is None:
            return None
        read = self.one(node, "`times`", is_cited or entry.latex is not None, True)
        if read and (len(read.sides) > 1 or read.sides[0].shape or len(read.sides[0].branches) > 1):
            self.faults.error("wrong-type", "`times` must be one scalar", node.place)
        return read

    def statement(self, entry: EntryKeys, put_in: tuple[str, ...], formula: Formula | None) -> Statement | None:
        """Read the value of an entry from `states:` or `latex:`, or from the formula that the entry cites. Return
        None if no value can be read.
        """
        plain, printed, keys = entry.states, entry.latex, keys_of(EntryKeys)
        homogeneous = "erratum" not in entry.values_at and not put_in
        if plain is not None and printed is not None:
            self.faults.error("two-values", "an entry cannot have both `states` and `latex`", entry.places["latex"])
        elif formula is not None and entry.answer is not None and plain is None and printed is None:
            return self.of_document(formula, homogeneous, entry.places[""])
        elif plain is None and printed is None and entry.remark is None:
            # A key that could not be read already has an error of its own.
            if entry.values_at.keys() <= keys.keys() - {"states", "latex"}:
                message = f"an entry needs `states` or `latex`: {keys['states'].meaning}"
                self.faults.error("missing-key", message, entry.places[""])
        elif printed is not None:
            return self.one(printed, "`latex`", True, homogeneous)
        return self.one(plain, "`states`", False, True) if plain is not None else None

    def of_document(self, formula: Formula, homogeneous: bool, place: Place) -> Statement | None:
        """Read a chain of the document; None if it cannot be read. A first letter that cannot be read is left out,
        because it only names the value.
        """
        named = bool(formula.head)
        if named:
            try:
                self.in_latex(formula.scalar.piece(0, len(formula.head)), homogeneous)
            except Rejected:
                formula, named = formula.without_head, False
        with self.faults:
            try:
                return replace(self.in_latex(formula.scalar, homogeneous), is_named=named)
            except Rejected as error:
                note = f"the formula is cited at {place.path}:{place.line}"
                raise Rejected(replace(c, notes=(*c.notes, note)) for c in error.complaints) from None
        return None

    def one(self, node: Tree, key: str, printed: bool, homogeneous: bool) -> Statement | None:
        if not printed:
            value = _stated(node, key, self.letters, self.faults)
            return Statement.of(value) if value else None
        if not isinstance(node, Scalar) or node.empty:
            wrong_type(self.faults, key, "a formula in LaTeX", node)
            return None
        with self.faults:
            return self.in_latex(node, homogeneous)
        return None

    def in_latex(self, scalar: Scalar, homogeneous: bool) -> Statement:
        from derive.course.latex import read_latex  # imported here because few files need LaTeX

        read = read_latex(scalar, self.printed, homogeneous=homogeneous)
        sides = tuple(Stated(s.branches, s.shape, s.text, s.place, homogeneous) for s in read.sides)
        return Statement(sides, read.marks, " ".join(scalar.text.split()), scalar.place)

    def erratum(self, entry: EntryKeys, put_in: tuple[str, ...], is_cited: bool) -> tuple[str, Statement | None]:
        written = entry.erratum
        if written is None or written.right is None:
            return (written and written.why) or "", None
        printed = is_cited or entry.latex is not None
        return written.why or "", self.one(written.right, "`right`", printed, not put_in)

    def put_in(self, node: Tree | None) -> tuple[str, ...]:
        """Return the letters whose numbers the document has substituted."""
        names = []
        for item in _items(node) if node is not None else ():
            name = item.text.strip() if isinstance(item, Scalar) else ""
            known = self.printed.get(name)
            if not name:
                wrong_type(self.faults, "`with`", "letters that have numbers", item)
            elif known is None or known.symbol.name not in self.numbers:
                help_line = "give its number under `values:` or `given:`"
                self.faults.error("no-number", f"`{name}` has no number to substitute", item.place, help=help_line)
            else:
                names.append(known.symbol.name)
        return tuple(names)


def _in_dollars(node: Tree | None) -> str:
    return f"${' '.join(node.text.split())}$" if isinstance(node, Scalar) else ""


def _stated(node: Tree, key: str, letters: Table[str, Declared], faults: Faults) -> Stated | None:
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


def _items(node: Tree) -> tuple[Tree, ...]:
    return node.items if isinstance(node, Sequence) else (node,)


def _text(node: Tree) -> str:
    if isinstance(node, Sequence):
        return "[" + ", ".join(_text(item) for item in node.items) + "]"
    return " ".join(node.text.split()) if isinstance(node, Scalar) else ""


def _figures(node: Tree | None, states: Statement | None, faults: Faults) -> tuple[int, ...]:
    if node is None:
        return ()
    items = _items(node)
    for item in items:
        text = item.text if isinstance(item, Scalar) else ""
        if not _FIGURES.fullmatch(text) or int(text) > MAX_FIGURES:
            wrong_type(faults, "`to`", f"a whole number from 1 to {MAX_FIGURES}, or a list of them", item)
            return ()
    wanted = len(_values(states.sides[int(states.is_named)])) if states else len(items)
    if isinstance(node, Sequence) and len(items) != wanted:
        message = f"`to` has {len(items)} numbers, but the value has {wanted} entries"
        faults.error("wrong-length", message, node.place)
    return tuple(int(item.text) for item in items if isinstance(item, Scalar))


def _values(value: Stated) -> tuple[tuple[Expr, Dimension], ...]:
    """Return the values to which a list of figures refers."""
    return value.entries if value.shape else tuple(entries[0] for entries in value.branches)
