"""YAML with places: every node has its place in the file, and several errors of a file are reported together.

YAML is read as data: no anchors, no tags, no merge keys, one document. The pure Python parser is used by default,
because its messages name the unexpected character; a caller that reads many files can choose libyaml, which is faster.
"""

from __future__ import annotations

import os
import re
import stat
from bisect import bisect_right
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import islice
from pathlib import Path
from typing import Any, TypeAlias

import yaml

from derive.errors import Complaint, Faults, Place, Rejected

LARGEST_FILE = 256 * 1024
DEEPEST_YAML = 20
LONG_LINE = 160
_LEFT_OUT = "... "
NOTHING = ("~", "null", "Null", "NULL")  # the words that editors read as null

# characters that are not allowed, such as marks that reorder text on the screen
_ODD = re.compile(
    "[^\t\n\r\x20-\x7e\xa0-\u2027\u202f-\u2065\u206a-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]"
)
_LINE_END = re.compile(r"\r\n|\r|\n")
_RANGE = re.compile(r"(\w+:[ ]+)([^][(){},:'\"\n]* in [\[(][^,\n]{1,40},[^])}\n]{1,40}[])])")
_SPACE = re.compile(r"\s*")
_JOINED_LINES = re.compile(r"(?:\s|\\[\r\n])*")
# characters that look like a space or are invisible, as in text that was copied from a web page
_BLANK = "[\u00a0\u2000-\u200d\u202f\u205f\u2060\u3000\ufeff]"
_BLANK_IN_KEY = re.compile(_BLANK)
_BLANK_IN_LINE = re.compile(rf"(?:^ *|[-:,{{\[] *)({_BLANK})", re.MULTILINE)
_TAB_INDENT = re.compile(r"^[ ]*\t[ \t]*(?=\S)", re.MULTILINE)


@dataclass(frozen=True)
class Source:
    """The text of one file, and methods that turn an index into a place."""

    path: str
    text: str = field(repr=False)

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(m.end() for m in _LINE_END.finditer(self.text))]

    @cached_property
    def _ends(self) -> list[int]:
        return [*(m.start() for m in _LINE_END.finditer(self.text)), len(self.text)]

    def line(self, number: int) -> str:
        """Return the line with that number, counted from 1, without its line end."""
        return self.text[self._starts[number - 1] : self._ends[number - 1]]

    def place(self, index: int, width: int = 1) -> Place:
        """Return the place of `width` characters from `index`; a long line is shortened."""
        number = bisect_right(self._starts, index)
        start = self._starts[number - 1]
        length = len(self.line(number))
        column = min(index - start, length)  # the \n of \r\n is beyond the end of the line
        width = max(1, min(width, length - column))
        if length <= LONG_LINE:
            return Place(self.path, number, column + 1, self._shown(start, length), width)
        width = min(width, 40)
        first = max(0, column + width - LONG_LINE)
        before = _LEFT_OUT if first else ""
        after = " ..." if first + LONG_LINE < length else ""
        text = before + self._shown(start + first, min(LONG_LINE, length - first)) + after
        return Place(self.path, number, column + 1, text, width, first - len(before))

    def _shown(self, start: int, length: int) -> str:
        return _ODD.sub("\ufffd", self.text[start : start + length])

    def at(self, line: int, column: int = 1, width: int = 1) -> Place:
        """Return the place of a line and column as Python and YAML tools count them, from 1."""
        line = min(max(1, line), len(self._starts))
        return self.place(min(self._starts[line - 1] + max(0, column - 1), len(self.text)), width)


class Word(str):
    """A text from a file, with its place."""

    place: Place

    @classmethod
    def at(cls, text: str, place: Place) -> Word:
        word = cls(text)
        word.place = place
        return word


@dataclass(frozen=True)
class Scalar:
    """Text, and how it was written: `style` is empty for plain text, otherwise `'`, `"`, `>` or `|`."""

    text: str
    style: str
    start: int
    end: int
    source: Source = field(repr=False)

    @property
    def quoted(self) -> bool:
        return self.style in ("'", '"')

    @property
    def empty(self) -> bool:
        return not self.text.strip()

    @property
    def left_empty(self) -> bool:
        """Whether nothing, or an unquoted `null` or `~`, follows the `:` or `-`; `""` is text."""
        return self.style == "" and self.empty

    @property
    def raw(self) -> str:
        """The text as the file has it, with quotes and escapes."""
        return self.source.text[self.start : self.end]

    @property
    def place(self) -> Place:
        return self.source.place(self.start, self.end - self.start)

    @property
    def word(self) -> Word:
        return Word.at(self.text, self.place)

    def piece(self, offset: int, length: int) -> Scalar:
        """Return a part of the text, with its own place."""
        if not self.text:
            return self
        spans = self._spans[offset : offset + length]
        start = self._spans[offset][0] if offset < len(self._spans) else self._spans[-1][1]
        part = Scalar(self.text[offset : offset + length], "", start, spans[-1][1] if spans else start, self.source)
        part.__dict__["_spans"] = spans  # each character keeps its place in the file, also in folded text
        return part

    def place_within(self, offset: int, width: int = 1) -> Place:
        """Return the place of `text[offset:offset + width]` in the file."""
        if not self.text:
            return self.source.place(self.start)
        if offset >= len(self.text):
            return self.source.place(self._spans[-1][1])
        last = min(offset + max(1, width), len(self.text)) - 1
        start = self._spans[offset][0]
        return self.source.place(start, self._spans[last][1] - start)

    @cached_property
    def _spans(self) -> list[tuple[int, int]]:
        """The start and end, in the source, of each character of the text."""
        raw, at = self.source.text, self.start
        if self.style not in (">", "|") and raw.startswith(self.text, at + self.quoted):
            return [(i, i + 1) for i in range(at + self.quoted, at + self.quoted + len(self.text))]
        if self.style in (">", "|"):
            at = min(i for i in (raw.find(end, at) for end in "\r\n") if i >= 0) + 1
        elif self.style:
            at += 1
        spans = []
        for char in self.text:
            if not char.isspace():
                at = _next_visible(raw, at, self.style)
            start, at = at, at + _raw_width(raw, at, self.style, char)
            spans.append((min(start, self.end), min(at, self.end)))
        return spans


def _next_visible(raw: str, at: int, style: str) -> int:
    gap = _JOINED_LINES if style == '"' else _SPACE
    found = gap.match(raw, at)
    return found.end() if found else at


def _raw_width(raw: str, at: int, style: str, char: str) -> int:
    """Return how many characters of the file represent this character of text."""
    here = raw[at : at + 2]
    if style == '"' and here.startswith("\\"):
        return 2 + {"x": 2, "u": 4, "U": 8}.get(here[1:], 0)
    if style == "'" and here == "''":
        return 2
    return 0 if char.isspace() and not here[:1].isspace() else 1


class Formula(Word):
    """An expression in a file, kept as text until its letters are known."""

    scalar: Scalar

    @classmethod
    def of(cls, scalar: Scalar) -> Formula:
        formula = cls(scalar.text.strip())
        formula.place, formula.scalar = scalar.place, scalar
        return formula


@dataclass(frozen=True)
class Sequence:
    items: tuple[Tree, ...]
    place: Place


@dataclass(frozen=True)
class Mapping:
    pairs: tuple[tuple[Scalar, Tree], ...]
    place: Place

    @cached_property
    def _by_name(self) -> dict[str, Tree]:
        return {key.text: value for key, value in self.pairs}

    def get(self, key: str) -> Tree | None:
        return self._by_name.get(key)

    def at(self, path: str) -> Tree | None:
        """Return the value at a path such as `body.inner`; None if there is no value at this path."""
        node: Tree | None = self
        for key in path.split("."):
            node = node.get(key) if isinstance(node, Mapping) else None
        return node

    @property
    def places(self) -> dict[str, Place]:
        """The place of each key, including nested keys such as `show.spin`."""
        found = {key.text: key.place for key, _ in self.pairs}
        inner = ((key.text, value.places) for key, value in self.pairs if isinstance(value, Mapping))
        return found | {f"{key}.{name}": place for key, places in inner for name, place in places.items()}


Tree: TypeAlias = Scalar | Sequence | Mapping


def as_text(node: Tree | None) -> str:
    """Return the contents of a node as text, without places."""
    if isinstance(node, Mapping):
        return "{" + ", ".join(f"{name.text!r}: {as_text(value)}" for name, value in node.pairs) + "}"
    if isinstance(node, Sequence):
        return "[" + ", ".join(map(as_text, node.items)) + "]"
    return repr(node.text) if node else ""


def shape_of(node: Tree) -> str:
    """Return the shape of a node in words for a message."""
    if isinstance(node, Scalar):
        return "empty" if node.empty else f"`{abridged(node.text)}`"
    return "a list" if isinstance(node, Sequence) else "a mapping"


def abridged(text: str, limit: int = 40) -> str:
    flat = " ".join(text.split())
    return flat if len(flat) <= limit else flat[: limit - 3] + "..."


def read_source(path: Path, shown_as: str, *, limit: int = LARGEST_FILE) -> Source:
    """Return the text of a file of the author; reject a file that is missing, unreadable, too large or not UTF-8."""
    whole = Place(shown_as, 1)
    try:
        # Do not wait for a pipe or a device.
        with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise Rejected(Complaint("unreadable", f"`{shown_as}` is not a file", help="put a file in its place"))
            raw = file.read(limit + 1)
    except FileNotFoundError:
        raise Rejected(Complaint("missing-file", f"the file `{shown_as}` does not exist")) from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise Rejected(Complaint("unreadable", f"`{shown_as}` cannot be read: {reason}")) from None
    if len(raw) > limit:
        raise Rejected(Complaint("too-large", f"the file is larger than {limit // 1024} KB", whole))
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = raw[: error.start].decode("utf-8-sig", "replace")
        place = Source(shown_as, before).place(len(before))
        raise Rejected(
            Complaint("encoding", "the file is not UTF-8", replace(place, text=""), help="save it as UTF-8")
        ) from None
    return Source(shown_as, text)


def read_yaml(path: Path, shown_as: str, quickly: bool = False) -> Tree:
    """Return the tree of a YAML file; `shown_as` is its path in messages."""
    source, quick = read_source(path, shown_as), getattr(yaml, "CSafeLoader", None)
    if quickly and quick and not _ODD.search(source.text):
        with suppress(Rejected):  # errors of libyaml are not reworded, so the Python parser reads the file again
            return _Reader(source, Faults(), quick).tree()
    return yaml_tree(source)


@lru_cache(maxsize=64)  # each problem of a set reads the same reference
def yaml_tree(source: Source) -> Tree:
    """Return the tree of a YAML text, or raise one `Rejected` with the errors in its syntax."""
    faults = Faults()
    for odd in islice(_ODD.finditer(source.text), 5):
        faults.error("control-character", f"the character U+{ord(odd[0]):04X} is not text", source.place(odd.start()))
    tabs = list(_TAB_INDENT.finditer(source.text))
    if tabs:
        # A file has one error for all its tabs, because an editor that writes tabs writes them on every line.
        place = source.place(tabs[0].start() + tabs[0][0].index("\t"))
        notes = (f"{len(tabs)} lines are indented by tabs",) if tabs[1:] else ()
        faults.error("tab", "a tab indents this line", place, notes=notes, help="indent with spaces")
    faults.stop()
    return _Reader(source, faults).tree()


class _Reader:
    """Builds nodes from the parser's events; `DEEPEST_YAML` bounds the recursion."""

    def __init__(self, source: Source, faults: Faults, loader: Any = yaml.SafeLoader):
        self.source = source
        self.faults = faults
        self.odd_lines: set[int] = set()
        self.events: Iterator[Any] = iter(yaml.parse(source.text, Loader=loader))

    def tree(self) -> Tree:
        root: Tree | None = None
        try:
            for event in self.events:
                if isinstance(event, yaml.DocumentStartEvent) and root is not None:
                    self.refuse("documents", "a second document begins here", event, 3, "keep one document in a file")
                    break
                if isinstance(event, yaml.NodeEvent):
                    root = _nothing_is_empty(self.node(event, 1))
        except yaml.MarkedYAMLError as error:
            complaint = _syntax_complaint(error, self.source)
            # A rejected alias or tag may leave the rest of its line unreadable.
            if complaint.place is None or complaint.place.line not in self.odd_lines:
                self.faults.add(complaint)
        if root is None or (isinstance(root, Scalar) and root.left_empty):
            if not self.faults:
                self.faults.error("empty", "the file is empty", self.source.place(0))
            self.faults.stop()
        self.faults.stop()
        assert root is not None
        return root

    def refuse(self, code: str, message: str, event: Any, width: int, help: str | None = None) -> None:
        place = self.source.place(event.start_mark.index, width)
        self.odd_lines.add(place.line)
        self.faults.error(code, message, place, help=help)

    def node(self, event: Any, depth: int) -> Tree:
        start, end = event.start_mark.index, event.end_mark.index
        if depth > DEEPEST_YAML:
            self.refuse("too-deep", f"this is nested more than {DEEPEST_YAML} levels deep", event, 1)
            self.faults.stop()
        self.refuse_cleverness(event)
        if isinstance(event, yaml.SequenceStartEvent):
            items = []
            while not isinstance(event := next(self.events), yaml.SequenceEndEvent):
                items.append(_nothing_is_empty(self.node(event, depth + 1)))
            return Sequence(tuple(items), self.source.place(start))
        if isinstance(event, yaml.MappingStartEvent):
            return self.mapping(event, depth)
        if isinstance(event, yaml.AliasEvent):
            return Scalar(f"*{event.anchor}", "", start, end, self.source)
        if odd := _ODD.search(event.value):
            # In double quotes a character can be written as its code.
            help_line = "put LaTeX in single quotes, or write `\\\\` for a backslash" if event.style == '"' else None
            message = f"the character U+{ord(odd[0]):04X} is not text"
            self.refuse("control-character", message, event, end - start, help_line)
        return Scalar(event.value, event.style or "", start, end, self.source)

    def mapping(self, opening: Any, depth: int) -> Mapping:
        pairs: dict[str, tuple[Scalar, Tree]] = {}
        last: tuple[Scalar, Tree] | None = None
        while not isinstance(event := next(self.events), yaml.MappingEndEvent):
            key = self.node(event, depth + 1)
            value = _nothing_is_empty(self.node(next(self.events), depth + 1))
            last, before = (key, value) if isinstance(key, Scalar) else None, last
            if not isinstance(key, Scalar):
                self.refuse("key", "a key must be a word", event, 1)
            elif opening.flow_style and before and (cut := _cut_off(before[1], key, value)):
                self.faults.add(_needs_quotes(f"{before[0].text}: ", cut))
            elif opening.flow_style and before and (cut := _cut_at_comma(before[1], key, value)):
                last = before[0], cut  # more pieces of the same value may follow
                pairs[before[0].text] = last
            elif not key.quoted and (blank := _BLANK_IN_KEY.search(key.text)):
                self.faults.add(_not_a_space(key.source, key.start + blank.start()))
            elif opening.flow_style and _lacks_space(key, value):
                colon = key.source.place(key.start + key.text.index(":"))
                self.faults.error("yaml", "a key needs `: ` after it", colon, help="put a space after the `:`")
            elif key.text == "<<" and not key.quoted:
                self.refuse("merge-key", "merge keys are not used here", event, 2, "write the keys out")
            elif key.text in pairs:
                first = pairs[key.text][0].place
                note = f"it was first given on line {first.line}"
                self.faults.error("duplicate-key", f"`{abridged(key.text)}` is given twice", key.place, notes=(note,))
            else:
                pairs[key.text] = key, value
        return Mapping(tuple(pairs.values()), self.source.place(opening.start_mark.index))

    def refuse_cleverness(self, event: Any) -> None:
        """Reject aliases, anchors and tags, because authors often write them by mistake."""
        if isinstance(event, yaml.AliasEvent):
            help_line = "quote an expression that begins with `*`"
            self.refuse("alias", f"`*{event.anchor}` is a YAML alias", event, len(str(event.anchor)) + 1, help_line)
            return
        if event.anchor is not None:
            help_line = "write the value where it is needed, or quote text that begins with `&`"
            self.refuse("anchor", f"`&{event.anchor}` is a YAML anchor", event, len(event.anchor) + 1, help_line)
        if event.tag is not None:
            self.refuse("tag", "tags are not used here", event, 1, "quote text that begins with `!`")


def _nothing_is_empty(node: Tree) -> Tree:
    """Return an empty scalar in place of an unquoted `null` or `~`."""
    return replace(node, text="") if isinstance(node, Scalar) and not node.style and node.text in NOTHING else node


def _lacks_space(key: Scalar, value: Tree) -> bool:
    """Return whether a space is missing after a colon within braces, as in `{x:length}`."""
    is_alone = isinstance(value, Scalar) and value.left_empty
    return is_alone and not key.quoted and re.match(r"\w+:\w", key.text) is not None


def _cut_off(before: Tree, key: Scalar, value: Tree) -> Scalar | None:
    """Return the whole value if a comma inside a bracket has split it; otherwise None."""
    if not (isinstance(before, Scalar) and before.style == key.style == "" and isinstance(value, Scalar)):
        return None
    source, start = key.source, before.start
    closed = before.text.count("(") > before.text.count(")") and ")" in key.text and value.left_empty
    return Scalar(source.text[start : key.end], "", start, key.end, source) if closed else None


def _cut_at_comma(before: Tree, key: Scalar, value: Tree) -> Scalar | None:
    """Return the whole value if a decimal comma inside braces has split it, as in `{l: 1,2 m}`; otherwise None."""
    if not (isinstance(before, Scalar) and before.style == key.style == "" and isinstance(value, Scalar)):
        return None
    source, start = key.source, before.start
    is_cut = value.left_empty and before.text[-1:].isdigit() and key.text[:1].isdigit() and key.start == before.end + 1
    return Scalar(source.text[start : key.end], "", start, key.end, source) if is_cut else None


def decimal_comma(text: str, place: Place) -> Complaint:
    point = re.sub(r"(?<=\d),(?=\d)", ".", text.strip())
    help_line = f"write `{point}`: a number in a file needs a decimal point, even if pages print a comma"
    return Complaint("decimal-comma", f"`{text.strip()}` has a comma in it", place, help=help_line)


def _not_a_space(source: Source, index: int) -> Complaint:
    message = f"the character U+{ord(source.text[index]):04X} is not a space in YAML"
    return Complaint("yaml", message, source.place(index), help="replace it with a space, or delete it")


def _needs_quotes(name: str, value: Scalar) -> Complaint:
    message, whole = "within braces a value with a comma or a bracket needs quotes", " ".join(value.text.split())
    return Complaint("yaml", message, value.place, help=f"write `{name}'{whole}'`")


def _syntax_complaint(error: yaml.MarkedYAMLError, source: Source) -> Complaint:
    """Return the parser's error in plain words."""
    context, problem = str(error.context or ""), str(error.problem or "this is not YAML")
    mark = error.problem_mark or error.context_mark
    index = min(mark.index, len(source.text)) if mark else 0
    opening = error.context_mark.index if error.context_mark else index

    def syntax(message: str, help: str | None = None, at: int = index, *notes: str) -> Complaint:
        return Complaint("yaml", message, source.place(at), notes, help)

    found = source.text[index : index + 1]
    if found == "\t":
        return Complaint("tab", "a tab is not a space in YAML", source.place(index), help="replace it with a space")
    above = source.text.rfind("\n", 0, max(0, source.text.rfind("\n", 0, opening)))
    if blank := _BLANK_IN_LINE.search(source.text[: index + 1], above + 1):
        return _not_a_space(source, blank.start(1))
    if "cannot start any token" in problem:
        return syntax(f"a value cannot begin with `{found}`", "put the value in quotes")
    if "mapping values are not allowed" in problem:
        return syntax("this `:` is not expected", "check the indentation, or put text that contains `: ` in quotes")
    if "quoted scalar" in context and "end of stream" in problem:
        return syntax("this quotation mark is never closed", None, opening)
    if "unknown escape" in problem:
        return syntax(f"`\\{found}` has no meaning in double quotes", "use single quotes", max(0, index - 1))
    if "flow" in context and found == "?":
        return syntax("a `?` ends the text within brackets", "put the text in quotes")
    cut = next((m for m in _RANGE.finditer(source.text) if m.start(2) <= index < m.end()), None)
    if "flow" in context and cut:
        return _needs_quotes(cut[1], Scalar(cut[2], "", cut.start(2), cut.end(), source))
    if "flow" in context and ("expected ','" in problem or "stream end" in problem):
        opening = max(source.text.rfind(bracket, 0, opening + 1) for bracket in "[{")
        bracket, closing = ("[", "]") if source.text[opening] == "[" else ("{", "}")
        note = f"line {source.place(index).line} should have `,` or `{closing}`"
        return syntax(f"this `{bracket}` is not closed", None, opening, note)
    if "alias" in context:
        return syntax("a YAML alias begins here", "quote an expression that begins with `*`", opening)
    if "anchor" in context:
        return syntax("a YAML anchor begins here", "quote text that begins with `&`", opening)
    here = source.place(index)
    if "expected <block end>" in problem and here.text[: here.column - 1].strip():
        return syntax("this does not belong to the value before it", "put the whole value in quotes")
    if "expected <block end>" in problem:
        return syntax("this does not line up with the lines above", "begin keys of the same level in the same column")
    if "could not find expected ':'" in problem:
        return syntax("a key needs `: ` after it", None, opening)
    if "node content" in problem:
        return syntax(f"a value is missing before `{found}`" if found.strip() else "a value is missing")
    return syntax(re.sub(r"<(.*?)>", r"\1", problem).lower())
