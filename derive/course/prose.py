"""Prose as an instructor writes it: plain text in which `<<name>>` stands for a symbol or a derived result.

`<<eq torque>>` is the equation number of the step `torque`, `<<problem top>>` the number of another problem of the set.
Text is data. Prose has no mathematics, TeX or template commands of its own; it is escaped when it is printed.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from derive.course.schema import LEFT_EMPTY, TEXT, Reader, wrong_type
from derive.course.yaml_tree import Scalar, Tree, abridged, shape_of
from derive.errors import Complaint, Faults, Place

EQUATION, PROBLEM, FIGURE = "eq", "problem", "figure"

_MENTION = re.compile(
    r"<<\s*(?:(?P<of>eq|figure)\s+)?(?P<name>[A-Za-z][A-Za-z0-9_]*)\s*>>"
    r"|<<\s*problem\s+(?P<problem>[A-Za-z0-9][\w-]*)\s*>>"
    r"|(?P<odd><<[^<>\n]{0,40}>{0,2}|<%|<#)",
    re.ASCII,
)
# A price does not match: the dollars of a formula have no blank just inside them, and no digit follows.
_LATEX = re.compile(
    r"\$(?=\S)(?P<letter>[A-Za-z](?:_\w+)?)?[^$]*(?<=\S)\$(?!\d)|\\[A-Za-z]+|\\[(\[]"
    r"|\w(?P<power>\^)[\w{(+-]+|\b(?P<below>[A-Za-z]_)[\w{]+",
    re.ASCII,
)
_HOW = "write one name, as `<<mass>>`, `<<eq torque>>`, `<<figure axes>>` or `<<problem top>>`"


@dataclass(frozen=True)
class Mention:
    """A `<<name>>` and its place; `of` is the word before the name, if any: `eq`, `problem` or `figure`."""

    name: str
    place: Place
    of: str = ""


@dataclass(frozen=True)
class Prose:
    """Text with mentions; `pieces` is the whole text in order, so that no other code needs to parse it.

    `place_within(index, width)` returns the place in the file of the `width` characters that begin at `index` in the
    text.
    """

    text: str
    place: Place
    place_within: Callable[[int, int], Place] = field(repr=False, compare=False)

    @cached_property
    def pieces(self) -> tuple[str | Mention, ...]:
        pieces: list[str | Mention] = []
        end = 0
        for match in _MENTION.finditer(self.text):
            pieces.append(self.text[end : match.start()])
            place = self.place_within(match.start(), len(match[0]))
            of = PROBLEM if match["problem"] else match["of"] or ""
            pieces.append(Mention(match["name"] or match["problem"] or "", place, of))
            end = match.end()
        pieces.append(self.text[end:])
        return tuple(piece for piece in pieces if piece)

    @property
    def mentions(self) -> tuple[Mention, ...]:
        return tuple(piece for piece in self.pieces if isinstance(piece, Mention))

    def place_of(self, name: str) -> Place:
        """Return the place where the text first mentions a name; if there is no mention, the place of the text."""
        return next((mention.place for mention in self.mentions if mention.name == name), self.place)


def read_prose(node: Tree, what: str, faults: Faults) -> Prose | None:
    """Return the prose of a node, or nothing after an error."""
    if not isinstance(node, Scalar):
        faults.error("wrong-type", f"`{what}` must be text, but it is {shape_of(node)}", node.place)
        return None
    for match in _MENTION.finditer(node.text):
        if odd := match["odd"]:
            place = node.place_within(match.start(), len(odd))
            faults.error("mention", f"`{abridged(odd)}` is not a mention", place, help=_HOW)
    comment = re.match(r"[ \t]+#", node.source.text[node.end :])
    if comment and node.style == "":
        place = node.source.place(node.end + comment.end() - 1)
        help_line = "put the whole text in quotes"
        faults.error("comment-in-text", "`#` begins a comment, so the text ends before it", place, help=help_line)
    return Prose(node.text, node.place, node.place_within)


def _some_prose(node: Tree, what: str, faults: Faults) -> Prose | None:
    if isinstance(node, Scalar) and node.empty:
        wrong_type(faults, f"`{what}`", "text", node)
    return read_prose(node, what, faults)


def latex_in(prose: Prose) -> Complaint | None:
    """Return a warning about the first LaTeX in a text, because LaTeX in prose is printed unchanged; None without
    LaTeX."""
    found = [*_LATEX.finditer(_MENTION.sub(lambda mention: "x" * len(mention[0]), prose.text))]
    if not found:
        return None
    first = found[0]
    notes = (f"{len(found) - 1} more in this text",) * bool(found[1:])
    return Complaint(
        "latex-in-prose",
        f"LaTeX is not read in prose: `{abridged(first[0])}` is printed unchanged",
        prose.place_within(first.start(), len(first[0])),
        notes,
        "write `²` for a square" if first["power"] else f"write `<<{_letter(first)}>>` for a letter",
        severity="warning",
    )


def _letter(latex: re.Match[str]) -> str:
    """Return the letter that the LaTeX stands for, if the letter is clear; otherwise return `R` as an example."""
    inner = latex[0].strip("$").strip()
    whole = latex["below"] or latex["letter"]
    return inner if whole and re.fullmatch(r"\w+", inner) else "R"


PROSE = Reader(TEXT.schema, _some_prose)
PROSE_OR_NOTHING = Reader({"type": [*TEXT.schema["type"], LEFT_EMPTY]}, read_prose)
