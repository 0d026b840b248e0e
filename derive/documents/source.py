"""The text of a document, tidied for reading, and the place in the file that each of its characters comes from."""

from __future__ import annotations

import json
import re
from array import array
from bisect import bisect_right
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from itertools import islice
from pathlib import Path

from derive.errors import Complaint, Misused, Place, Rejected

LARGEST = 4_000_000  # characters of a document


class Format(StrEnum):
    TEX = "tex"
    MARKDOWN = "md"
    NOTEBOOK = "ipynb"
    PLAIN = "plain"


SUFFIXES = {
    ".tex": Format.TEX,
    ".ltx": Format.TEX,
    ".md": Format.MARKDOWN,
    ".markdown": Format.MARKDOWN,
    ".ipynb": Format.NOTEBOOK,
    ".txt": Format.PLAIN,
    "": Format.PLAIN,
}


@dataclass(frozen=True, order=True)
class Span:
    """A part of the tidied text: the position of its first character and the position after its last."""

    start: int
    end: int

    def to(self, other: Span) -> Span:
        return Span(self.start, other.end)


@dataclass(frozen=True)
class Edit:
    """One change made by the tidying: the text in a line of the file, and the text that is read instead."""

    line: int
    was: str
    reads: str


@dataclass
class Source:
    """A document: `written` is the text of the file; `text` is the tidied text that all later layers read."""

    path: str
    format: Format
    written: str
    text: str = ""
    origins: array[int] = field(default_factory=lambda: array("L"))
    edits: list[Edit] = field(default_factory=list)
    included: str = ""  # the texts of the main document and of all included files; they may define macros

    def __post_init__(self) -> None:
        if not self.text:
            self.text = self.written
        if len(self.origins) != len(self.text):
            self.origins = array("L", range(len(self.text)))

    @cached_property
    def line_starts(self) -> list[int]:
        return [0, *(found.end() for found in re.finditer(r"\n", self.written))]

    def line_of(self, position: int) -> int:
        """Return the number, from 1, of the line of the file that a position in the tidied text comes from."""
        return bisect_right(self.line_starts, self._origin(position))

    def place(self, span: Span) -> Place:
        start, end = self._origin(span.start), self._origin(max(span.start, span.end - 1)) + 1
        line = bisect_right(self.line_starts, start)
        begins = self.line_starts[line - 1]
        text = self.written[begins:].partition("\n")[0]
        width = max(1, min(end, begins + len(text)) - start)
        return Place(self.path, line, start - begins + 1, text, width)

    def _origin(self, position: int) -> int:
        if not self.origins:
            return 0
        return self.origins[position] if position < len(self.origins) else self.origins[-1] + 1

    def replace(self, pattern: str, reads: str | Callable[[re.Match[str]], str], within: str | None = None) -> None:
        """Replace each match of a pattern and record it; with `within`, only inside matches of `within`."""
        zones = [(0, len(self.text))]
        if within is not None:
            zones = [found.span() for found in re.finditer(within, self.text, re.DOTALL)]
        pieces, places, done = [], array("L"), 0
        for zone_start, zone_end in zones:
            for found in re.compile(pattern).finditer(self.text, zone_start, zone_end):
                new = reads(found) if callable(reads) else found.expand(reads)
                if new == found[0]:
                    continue
                self.edits.append(Edit(self.line_of(found.start()), found[0], new))
                pieces += [self.text[done : found.start()], new]
                places += self.origins[done : found.start()]
                places.extend([self._origin(found.start())] * len(new))
                done = found.end()
        if pieces:
            places += self.origins[done:]
            self.text, self.origins = "".join([*pieces, self.text[done:]]), places


def read_source(path: Path, shown: str | None = None) -> Source:
    """Return a document as tidied text."""
    kind = SUFFIXES.get(path.suffix.lower())
    if kind is None:
        known = ", ".join(sorted(filter(None, SUFFIXES)))
        message = f"`{path.name}` is not a document that derive reads"
        raise Misused(
            Complaint("unknown-format", message, help=f"its name must have no ending, or end in one of {known}")
        )
    name = shown or str(path)
    try:
        if path.stat().st_size > 4 * LARGEST:
            raise Rejected(Complaint("too-large", f"`{name}` is larger than {4 * LARGEST // 1_000_000} million bytes"))
        text = _file_text(path.read_bytes(), kind).replace("\r\n", "\n").replace("\r", "\n")
    except OSError as error:
        raise Misused(Complaint("unreadable", f"`{name}` cannot be read: {error.strerror}")) from error
    except UnicodeDecodeError as error:
        message = f"`{name}` is not in UTF-8; the first byte that does not fit is at position {error.start}"
        raise Rejected(Complaint("encoding", message)) from error
    source = source_of(text, kind, name)
    if kind is Format.TEX:
        source.included = "\n".join(_included(text, *_main_document(text, path.resolve()), {path.resolve()}))
    return source


_INPUTENC = re.compile(rb"\\usepackage\s*\[\s*(\w+)\s*\]\s*\{inputenc\}")
_ENCODINGS = {
    b"latin1": "latin-1",
    b"latin2": "latin2",
    b"latin9": "iso8859-15",
    b"applemac": "mac-roman",
    b"cp850": "cp850",
}


def _file_text(content: bytes, kind: Format) -> str:
    """Return the text of a file. An old LaTeX file that is not in UTF-8 has the encoding that it declares, or that of
    Windows; other files must be in UTF-8."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        if kind is not Format.TEX or b"\0" in content or content[:2] in (b"\xff\xfe", b"\xfe\xff"):
            raise
    declared = _INPUTENC.search(content)
    return content.decode(_ENCODINGS.get(declared[1] if declared else b"", "cp1252"), errors="replace")


_INCLUSION = re.compile(
    r"(?<![\\%])\\(?P<command>input|include|subfile|usepackage|RequirePackage|documentclass)\s*(?:\[[^\]]*\])?"
    r"\s*\{(?P<names>[^{}]*)\}"
)
_ENDINGS = {"usepackage": ".sty", "RequirePackage": ".sty", "documentclass": ".cls"}
MOST_INCLUDED = 50  # files


def _main_document(text: str, path: Path) -> tuple[str, Path]:
    """Return the main document that includes a text, and the folder of this document. If the text is itself a main
    document, or if no document near it includes it, return the text and its own folder."""
    if r"\documentclass" not in text:
        for folder in (path.parent, path.parent.parent):
            for file in islice(sorted(folder.glob("*.tex")), MOST_INCLUDED):
                main = _read(file)
                if r"\documentclass" in main and path in _files_in(main, folder):
                    return main, folder
    return text, path.parent


def _files_in(text: str, folder: Path) -> Iterator[Path]:
    """Yield the files inside a folder that a document includes."""
    for found in _INCLUSION.finditer(re.sub(r"(?<!\\)%.*", "", text)):
        ending = _ENDINGS.get(found["command"], ".tex")
        for name in found["names"].split(","):
            for file in (folder / name.strip(), folder / (name.strip() + ending)):
                with suppress(OSError, ValueError):  # a name that is not a path
                    if file.resolve().is_relative_to(folder) and file.is_file():
                        yield file.resolve()


def _included(text: str, main: str, folder: Path, done: set[Path]) -> Iterator[str]:
    """Yield the texts, except `text`, of the main document and of the files that it includes; a file comes before the
    files that use it."""
    for file in _files_in(main, folder):
        if file not in done and len(done) < MOST_INCLUDED:
            done.add(file)
            yield from _included(text, _read(file), folder, done)
    if main != text:
        yield main


def _read(file: Path) -> str:
    try:
        return file.read_bytes()[: 4 * LARGEST].decode("utf-8-sig", errors="replace")
    except OSError:
        return ""


def source_of(text: str, kind: Format, path: str = "") -> Source:
    """Return a text as a tidied document."""
    if len(text) > LARGEST:
        raise Rejected(Complaint("too-large", f"`{path}` is larger than {LARGEST // 1_000_000} million characters"))
    source = Source(path, kind, text)
    if kind is Format.NOTEBOOK:
        _keep_prose_of_notebook(source)
    if kind in (Format.MARKDOWN, Format.NOTEBOOK):
        _undo_escapes(source)
    return source


_FORMULA = (
    r"(?<!\\)\$\$.*?\$\$|(?<![\\$])\$(?![$\s]).*?(?<![\\$\s])\$|\\\[.*?\\\]|\\\(.*?\\\)"
    r"|\\begin\{(?P<name>[a-z]+\*?)\}.*?\\end\{(?P=name)\}"
)
_QUOTATION = r"(?:(?<=\n\n)|\A)(?:[ \t]*>[^\n]*(?:\n|\Z))+"


def _undo_escapes(source: Source) -> None:
    r"""Undo the backslashes that Markdown needs: `\\(`, `\\[` for `\(`, `\[`, and `\_`, `\*` in formulas.

    Also remove the `>` at the beginning of the lines of a quotation.
    """
    if re.search(r"\\\\\(.*?\\\\\)|\\\\\[.*?\\\\\]", source.text, re.DOTALL) and "$$" not in source.text:
        source.replace(r"\\\\([()\[\]])", r"\\\1")
        source.replace(r"\\\\(?=[{}|,;!])", r"\\", within=_FORMULA)
        source.replace(r"\\\\\\\\", r"\\\\", within=_FORMULA)
    source.replace(r"\\([_*])", r"\1", within=_FORMULA)
    source.replace(r"(?m)^[ \t]*>[ \t]?", "", within=_QUOTATION)


_JSON_STRING = re.compile(r'"(?:[^"\\]|\\.)*"', re.DOTALL)
_JSON_CHARACTER = re.compile(r"\\u[dD][89abAB]..\\u[dD][c-fC-F]..|\\u[0-9a-fA-F]{4}|\\.|[^\\]", re.DOTALL)


def _keep_prose_of_notebook(source: Source) -> None:
    """Keep only the Markdown cells of a notebook, and find the place of each character in the file."""
    try:
        read = json.loads(source.written)
        cells = [(cell["cell_type"], cell["source"]) for cell in read["cells"]]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise Rejected(Complaint("notebook", f"`{source.path}` is not a notebook: {error}")) from error
    literals = iter(_JSON_STRING.finditer(source.written))
    pieces, places = [], array("L")
    for kind, lines in cells:
        for line in [lines] if isinstance(lines, str) else lines:
            wanted = str(line)
            literal = next((each for each in literals if _decoded(each[0]) == wanted), None)
            if literal is None:
                break
            if kind == "markdown":
                for text, start in _characters(literal):
                    pieces.append(text)
                    places.append(start)
        if kind == "markdown" and places:
            pieces.append("\n\n")
            places.extend([places[-1]] * 2)
    source.text, source.origins = "".join(pieces), places


def _decoded(literal: str) -> str | None:
    try:
        return str(json.loads(literal, strict=False))
    except ValueError:
        return None


def _characters(literal: re.Match[str]) -> list[tuple[str, int]]:
    found = []
    for each in _JSON_CHARACTER.finditer(literal[0], 1, len(literal[0]) - 1):
        text = each[0] if len(each[0]) == 1 else str(json.loads(f'"{each[0]}"'))
        found.append((text, literal.start() + each.start()))
    return found
