"""A page as plain text for a terminal of 88 columns."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Mapping, Sequence

from derive.algebra.dimensions import exponents
from derive.course.names import EvidenceShown
from derive.course.placement import STATEMENT
from derive.page.no_break_spaces import NO_BREAK, unbroken
from derive.page.numbering import Number
from derive.page.theorems import standalone
from derive.page.tree import Block, Display, Document, Folded, Illustration, Paragraph, PartPage
from derive.page.wording import (
    DimensionMark,
    Inline,
    Math,
    NewParagraph,
    Phrases,
    ProblemRef,
    Ref,
    Text,
    ToldOnce,
    UnitMark,
)
from derive.render.notation.layout import Layout, Operator, row
from derive.render.notation.notation import Notation
from derive.render.notation.text import columns, in_one_line, plain, text_box, to_the_right
from derive.render.printing.lines import TEXT_WIDTH, Printed, printed_lines

PAGE_COLUMNS = 88
FRAMED = "  * "  # marks a line with an answer


def page_text(document: Document, words: Phrases, notation: Notation) -> str:
    """Return the whole page."""
    return _Page(standalone(document), words, notation).text()


_BLANKS = re.compile(r"(?:[^\S\xa0]|(?<!«)\xa0(?![;:?!%»]))+")  # a French punctuation mark keeps its no-break space


def inline_text(nodes: Sequence[Inline], notation: Notation, numbers: Mapping[str, Number] | None = None) -> str:
    """Return running text; `numbers` are the numbers of equations to which the text may refer."""
    return _BLANKS.sub(" ", "".join(_node(node, notation, numbers or {}) for node in nodes)).strip()


def _node(node: Inline, notation: Notation, numbers: Mapping[str, Number]) -> str:
    match node:
        case Text(text):
            return text
        case Math(expr):
            return in_one_line(notation.result(expr))
        case DimensionMark(dimension):
            return exponents(dimension)
        case UnitMark(text):
            return text
        case Ref(key):
            return f"({numbers[key]})"
        case ProblemRef(_, text):
            return text
        case ToldOnce(_, told, _):
            return inline_text(told, notation, numbers)
        case NewParagraph():
            return " "
    raise TypeError(f"nothing prints {type(node).__name__}")


def second_ways(display: Display, words: Phrases) -> list[str]:
    """Return the notes that follow the grade in the margin: the second routes, then the checks."""
    routes, check = words.labels["second_route"], words.labels["check"]
    return [*(f"{routes}: {said}" for said in display.routes), *(f"{check}: {said}" for said in display.checks)]


class _Page:
    def __init__(self, document: Document, words: Phrases, notation: Notation):
        self.document, self.words, self.notation = document, words, notation

    def text(self) -> str:
        title = self._with_worth(self._inline(self.document.title), self.words.worth(self.document.points))
        blocks = [title, "=" * PAGE_COLUMNS, self._wrapped(self.document.statement)]
        blocks += [line for i in self.document.illustrations if i.at == STATEMENT for line in ("", self._drawing(i))]
        blocks += self._headed("strategy", self.document.strategy)
        for part in self.document.parts_shown:
            blocks += ["", self._part(part)]
        blocks += ["", self._part(self.document.limits)] if self.document.limits else []
        blocks += self._headed("note", self.document.note)
        if self.document.closing:
            checked = Text(self.words.labels["checked"] + " ")
            blocks += ["", "-" * PAGE_COLUMNS, self._wrapped((checked, *self.document.closing))]
        return "\n".join(blocks) + "\n"

    def _headed(self, label: str, prose: Sequence[Inline]) -> list[str]:
        if not prose:
            return []
        found: list[list[Inline]] = [[Text(self.words.labels[label] + " ")]]
        for node in prose:
            found.append([]) if isinstance(node, NewParagraph) else found[-1].append(node)
        return [line for nodes in found for line in ("", self._wrapped(nodes))]

    def _part(self, part: PartPage) -> str:
        label = f"({part.label}) " if part.label else ""
        heading = self._with_worth(
            f"{label}{self._inline(part.ask)}", self.words.worth(self.document.points_of(part), part.extra)
        )
        blocks = [heading, "-" * min(columns(heading), PAGE_COLUMNS)]
        return "\n".join([*blocks, *self._blocks(part.blocks)])

    def _blocks(self, blocks: Sequence[Block]) -> list[str]:
        """Return the lines of the blocks, with an empty line before each block."""
        found: list[str] = []
        for block in blocks:
            match block:
                case Paragraph(nodes):
                    found += ["", self._wrapped(nodes)]
                case Display():
                    found += ["", self._display(block)]
                case Illustration():
                    found += ["", self._drawing(block)]
                case Folded(inside, title):
                    found += ["", title, *self._blocks(inside)]
        return found

    def _drawing(self, illustration: Illustration) -> str:
        figure, described = self.words.labels["figure"], self.words.labels["described"]
        shown = self._wrapped((Text(f"[{described}: "), *illustration.alt, Text("]")))
        if illustration.number is None:
            return shown
        return shown + "\n" + self._wrapped((Text(f"{figure} {illustration.number}. "), *illustration.caption))

    def _with_worth(self, text: str, worth: str) -> str:
        if not worth:
            return _filled(text)
        worth = f"[{worth}]"
        if columns(text) + len(worth) + 2 > PAGE_COLUMNS:
            return _filled(text) + "\n" + worth.rjust(PAGE_COLUMNS)
        return text + " " * (PAGE_COLUMNS - columns(text) - len(worth)) + worth

    def _wrapped(self, nodes: Sequence[Inline]) -> str:
        return _filled(self._inline(nodes))

    def _inline(self, nodes: Sequence[Inline]) -> str:
        return inline_text(nodes, self.notation, self.document.numbers)

    def _display(self, display: Display) -> str:
        lines: list[str] = []
        for group in display.groups:
            printed = printed_lines(group, self.notation, TEXT_WIDTH)
            indent = max((columns(plain(line.left)) for line in printed if line.left is not None), default=0)
            for line in printed:
                lines += self._line(line, indent)
        if self.document.evidence is EvidenceShown.MARGIN:
            lines.append(to_the_right(self._evidence(display), PAGE_COLUMNS))
        return "\n".join(lines)

    def _evidence(self, display: Display) -> str:
        """Return the note on how a display was checked, which a typeset page has in its margin."""
        said = [self.words.grades[display.grade], *second_ways(display, self.words)[:1]]
        return textwrap.shorten(f"[{'; '.join(said)}]", PAGE_COLUMNS, placeholder="\u2026]")

    def _body(self, line: Printed, indent: int) -> tuple[list[str], int]:
        """Return the lines of text of a formula, and the index of the line that has its relation signs (=, <)."""
        items: list[Layout] = [item for relation, side in line.sides for item in (Operator(relation), side)]
        body = text_box(row(*items))
        left = plain(line.left) if line.left else ""
        before = [to_the_right(left if i == body.middle else "", indent) for i in range(len(body.lines))]
        return [a + text.rstrip() for a, text in zip(before, body.lines, strict=True)], body.middle

    def _line(self, line: Printed, indent: int) -> list[str]:
        body, middle = self._body(line, indent)
        lines = ["    " + text for text in body]
        if line.framed:
            lines[middle] = FRAMED + lines[middle][len(FRAMED) :]
        reason = f"[{self._inline(line.reason)}]" if line.reason else ""
        if reason and columns(lines[middle]) + columns(reason) + 10 <= PAGE_COLUMNS:
            lines[middle] += "  " + reason
        elif reason:
            lines.append(to_the_right(reason, PAGE_COLUMNS - 8))
        if line.number is not None:
            number = f"({line.number})"
            room = PAGE_COLUMNS - len(number) - columns(lines[middle])
            lines[middle] += (" " * room if room > 1 else "  ") + number
        return lines


def _filled(text: str) -> str:
    filled = textwrap.fill(unbroken(text), PAGE_COLUMNS, break_long_words=False, break_on_hyphens=False)
    return filled.replace(NO_BREAK, " ")
