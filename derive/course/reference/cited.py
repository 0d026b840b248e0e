r"""The formulas of a document that a reference cites by their lines.

A line refers to the rows of displays that cover it, or to a formula in a sentence. A row that begins with a relation
continues the row before.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from derive.course.yaml_tree import Scalar, Source
from derive.documents.layout import Document, Row, Side, Statement, read_document
from derive.documents.parser import Unreadable, parsed
from derive.documents.source import SUFFIXES, Format, read_source
from derive.documents.syntax import Apply, Der, EvalBar, Group, Letter, Node, Open
from derive.documents.vocabulary import TEXTS
from derive.errors import Complaint, Place, Rejected, did_you_mean
from derive.units import Unit, read_unit

MARKS = {"=": "=", "<": "<", ">": ">", "<=": r"\leq", ">=": r"\geq", "!=": r"\neq", "~": r"\approx", ":=": "="}
_WORD = rf"\\(?:{'|'.join(sorted(map(re.escape, TEXTS), key=len, reverse=True))})\s*\{{\s*([A-Za-z]+)\s*\}}"
_UNIT = re.compile(rf"(?<=[\d\s}}~,])(?:{_WORD}(?:\^\{{?-?\d\}}?)?(?:\s|\\,|~|/)*)+$")
_DEGREES = re.compile(r"(?<=\d)\s*\^\s*\{?\s*(?:0|\\circ)\s*\}?$")
_SAME_UNIT = {"sec": "s", "RPM": "rpm"}
_LAYOUT = re.compile(r"\\(?:begin|end)\s*\{array\}(?:\{[lcr|\s]*\})?|\\\\|\s+|[&$]")


@dataclass(frozen=True)
class Formula:
    """A chain of sides in the document, such as `a = b = c`, and the unit of its last side.

    head    the name at the beginning of the chain, such as `T` in `T = ... = ...`; empty if the chain has no name
    """

    scalar: Scalar
    head: str
    unit: Unit | None

    @property
    def without_head(self) -> Formula:
        begins = len(self.head) + len(" = ") if self.head else 0
        return Formula(self.scalar.piece(begins, len(self.scalar.text) - begins), "", self.unit)

    @property
    def quotation(self) -> str:
        return f"${' '.join(self.without_head.scalar.text.split())}$"


class Cited:
    """A document, and the formulas at its lines."""

    def __init__(self, document: Document):
        self.document = document
        self.text = document.source.text
        self.file = Source(document.source.path, document.source.written)

    def formula(self, lines: Iterable[tuple[int, int]], wanted: tuple[int, ...], place: Place) -> Formula:
        """Return the chain at these lines, or only its sides with the numbers `wanted`, counted from 1. First sides
        that only name the value of the next side are left out."""
        sides: list[tuple[str, Side]] = []
        others: list[Side] = []  # further values of the last side: `x = a or b`
        for first, last in lines:
            for row in self.rows(first, last, place):
                for statement in row.statements:
                    if statement.link == "or" and not statement.relations and sides:
                        others += statement.sides
                    else:
                        sides += _new_sides(statement, bool(sides))
        if wanted:
            if max(wanted) > len(sides):
                told = f"the formula at this line has {len(sides)} side{'s' * (len(sides) > 1)}"
                raise Rejected(Complaint("no-formula", told, place))
            sides = [sides[number - 1] for number in wanted]
        while len(sides) > 1 and sides[1][0] == "=" and self.is_title(sides[0][1]):
            sides = sides[1:]
        named = len(sides) > 1 and sides[1][0] == "=" and _lone_letter(sides[0][1]) is not None
        return self.joined(sides, others, named)

    def section(self, number: str, place: Place) -> list[tuple[Letter | None, Formula]]:
        """Return the displayed chains of a section, each with the letter that is its first side. The letter is None if
        the first side is not a single letter, or if the chain has only one side."""
        headings = _numbers(self.document)
        if number not in headings:
            known = [each for each in headings if each]
            help_line = did_you_mean(number, known) or ("the headings have no numbers" if not known else None)
            message = f"`{self.file.path}` has no section {number}"
            raise Rejected(Complaint("no-formula", message, place, (), help_line))
        first = headings.index(number)
        after = (i for i in range(first + 1, len(headings)) if not f"{headings[i] or number}.".startswith(f"{number}."))
        last = next(after, len(headings))
        chains: list[list[tuple[str, Side]]] = []
        for row in self.document.rows:
            if row.block.display and first <= row.block.heading < last:
                for statement in row.statements:
                    if statement.follows is None or not chains:
                        chains.append([])
                    chains[-1] += _new_sides(statement, bool(chains[-1]))
        if not chains:
            raise Rejected(Complaint("no-formula", f"section {number} has no displayed formula", place))
        letters = [_lone_letter(sides[0][1]) if len(sides) > 1 else None for sides in chains]
        return [(letter, self.joined(sides, [], True)) for letter, sides in zip(letters, chains, strict=True)]

    def rows(self, first: int, last: int, place: Place) -> list[Row]:
        """Return the rows of displays that cover these lines, or the formula of a sentence there."""
        found = [row for row in self.document.rows if row.line <= last and self.last_line(row) >= first]
        shown = [row for row in found if row.block.display]
        stated = shown or [row for row in found if any(statement.relations for statement in row.statements)]
        where = f"line {first}" if first == last else f"lines {first} to {last}"
        if not stated or any(not row.statements for row in stated):
            near = min(
                (row.line for row in self.document.rows if row.block.display),
                default=None,
                key=lambda n: abs(n - first),
            )
            help_line = f"the nearest display is in line {near}" if near else None
            is_partly = any(row.statements for row in stated)
            message = (
                f"`{self.file.path}` has a row without a formula at {where}"
                if is_partly
                else f"`{self.file.path}` has no formula at {where}"
            )
            raise Rejected(Complaint("no-formula", message, place, (), help_line))
        if not shown and len(stated) > 1:
            message = f"there are {len(stated)} formulas in sentences at {where}"
            help_line = "write the formula that you mean under `latex:`"
            raise Rejected(Complaint("no-formula", message, place, (), help_line))
        return stated

    def last_line(self, row: Row) -> int:
        ends = [side.span.end for statement in row.statements for side in statement.sides]
        return self.document.source.line_of(max([row.span.end, *ends]) - 1)

    def is_title(self, side: Side) -> bool:
        r"""Return whether a first side is only a name for the value of the next side: `U'(\theta) =`, `\frac{d}{dt} L^2
        =`."""
        node = _parsed(side)
        if node is None:
            return False
        if any(isinstance(each, Der) or isinstance(each, Letter) and each.primes for each in node.walk()):
            return True
        if isinstance(node, Open) and node.kind == "apply":
            node = node.alternatives[0]
        return isinstance(node, Apply)

    def joined(self, sides: list[tuple[str, Side]], others: list[Side], named: bool) -> Formula:
        """Return the sides as one text, in which every character keeps its place in the file."""
        pieces: list[tuple[str, int | None]] = []
        unit: Unit | None = None
        for number, (mark, side) in enumerate(sides):
            pieces += [(f" {MARKS.get(mark, mark)} ", None)] if number else []
            start, end, unit = self.without_unit(side)
            pieces.append((self.text[start:end], start))
        for side in others:
            start, end, unit = self.without_unit(side)
            pieces += [(r" \text{ or } ", None), (self.text[start:end], start)]
        head = self.text[sides[0][1].span.start : sides[0][1].span.end] if named else ""
        return Formula(self.scalar(pieces), head, unit)

    def scalar(self, pieces: list[tuple[str, int | None]]) -> Scalar:
        spans: list[tuple[int, int]] = []
        origins = self.document.source.origins
        begins = next(start for _, start in pieces if start is not None)
        for text, start in pieces:
            if start is None:
                at = spans[-1][1] if spans else origins[begins]
                spans += [(at, at)] * len(text)
            else:
                spans += [(origins[start + i], origins[start + i] + 1) for i in range(len(text))]
        scalar = Scalar("".join(text for text, _ in pieces), "", spans[0][0], spans[-1][1], self.file)
        scalar.__dict__["_spans"] = spans
        return scalar

    def without_unit(self, side: Side) -> tuple[int, int, Unit | None]:
        """Return where the value of a side begins and ends, and the unit after it (None if there is no known unit)."""
        start, end = side.span.start, side.span.end
        text = self.text[start:end]
        if found := _DEGREES.search(text):
            return start, start + found.start(), read_unit("deg")
        if found := _UNIT.search(text):
            written = re.sub(_WORD, lambda word: f" {_SAME_UNIT.get(word[1], word[1])}", found[0])
            try:
                unit = read_unit(re.sub(r"\\,|~", " ", written).translate(str.maketrans("", "", "{}")).strip())
            except Rejected:
                return start, end, None
            return start, start + found.start(), unit
        return start, end, None

    def shown(self, line: int) -> str:
        """Return the beginning of a line, for a message."""
        count = self.file.text.count("\n") + 1
        text = self.file.line(line).strip() if line <= count else ""
        return text if len(text) <= 60 else f"{text[:60]} ..."

    def lines_of(self, quote: str) -> int | None:
        """Return the line in which a text begins; None if the document does not have this text."""
        return next((first for first, _ in self.found(_LAYOUT.sub("", quote))), None)

    def quotes(self, quote: str, line: int) -> bool:
        """Return whether the document has this text at a line; differences of layout are ignored."""
        wanted = _LAYOUT.sub("", quote)
        return any(first <= line <= last for first, last in self.found(wanted))

    def found(self, wanted: str) -> Iterator[tuple[int, int]]:
        at = self.plain[0].find(wanted)
        while at >= 0 and wanted:
            lines = self.plain[1]
            yield lines[at], lines[at + len(wanted) - 1]
            at = self.plain[0].find(wanted, at + 1)

    @property
    def plain(self) -> tuple[str, list[int]]:
        return _plain(self.file)


@lru_cache(maxsize=4)
def _plain(file: Source) -> tuple[str, list[int]]:
    """Return the text without its layout, and the line of each of its characters."""
    kept: list[str] = []
    lines: list[int] = []
    starts = [0, *(found.end() for found in re.finditer("\n", file.text))]
    done = 0
    for found in [*_LAYOUT.finditer(file.text), None]:
        end = found.start() if found else len(file.text)
        kept.append(file.text[done:end])
        lines += [bisect_right(starts, at) for at in range(done, end)]
        done = found.end() if found else end
    return "".join(kept), lines


_NUMBER = re.compile(r"\d+(?:\.\d+)*(?=[\s.:)]|$)")


def _numbers(document: Document) -> list[str]:
    """Return the number of each heading, as it is written or as LaTeX counts it; "" for a heading without a number. A
    heading with a star counts, too, although LaTeX prints no number for it.
    """
    found: list[str] = []
    counts: dict[int, int] = {}
    for heading in document.headings:
        written = _NUMBER.match(heading.text)
        if document.source.format is Format.TEX and 1 <= heading.level <= 3 and not written:
            counts = {level: count for level, count in counts.items() if level <= heading.level}
            counts[heading.level] = counts.get(heading.level, 0) + 1
            found.append(".".join(str(counts.get(level, 0)) for level in range(1, heading.level + 1)))
        else:
            found.append(written[0] if written else "")
    return found


def _new_sides(statement: Statement, goes_on: bool) -> list[tuple[str, Side]]:
    """Return the sides that a statement adds to a chain, each with the relation before it."""
    sides, marks = statement.sides, statement.relations
    if statement.follows is None:
        first = [("", sides[0])] if not goes_on or _lone_letter(sides[0]) is None else []
        return [*first, *zip(marks, sides[1:], strict=True)]
    new = list(zip(marks, sides[1:], strict=True))
    if goes_on or marks[0] in ("=", "~", ":="):
        return new if goes_on else [("", new[0][1]), *new[1:]]
    head = statement
    while head.follows is not None:
        head = head.follows
    return [("", head.sides[0]), *new]


def _parsed(side: Side) -> Node | None:
    try:
        return parsed(side.tokens)
    except (Unreadable, RecursionError):
        return None


def _lone_letter(side: Side) -> Letter | None:
    """Return the letter if a side is a single letter, also in brackets; otherwise None."""
    node = _parsed(side)
    while isinstance(node, Group | EvalBar):
        node = node.inner
    return node if isinstance(node, Letter) else None


@lru_cache(maxsize=4)
def _read(path: Path, shown: str, changed: int) -> Cited:
    return Cited(read_document(read_source(path, shown)))


def cited(root: Path, set_id: str, name: str) -> Cited | None:
    """Return the document with this name in the folder of a set; None if there is no such file."""
    shown = f"problems/{set_id}/{name}"
    path = root / shown
    if not is_a_file(root, set_id, name):
        return None
    return _read(path, shown, path.stat().st_mtime_ns)


def is_a_file(root: Path, set_id: str, name: str) -> bool:
    """Return whether the folder of a set has a document with this name."""
    folder = root / "problems" / set_id
    path = folder / name
    if Path(name).name != name or path.suffix.lower() not in {*SUFFIXES} - {""} or not path.is_file():
        return False
    return path.resolve().parent == folder.resolve()
