"""A page as Markdown with formulas between dollar signs, for GitHub, wikis and learning platforms.

Programs that show Markdown change formulas before they print them: some treat `\\,` as a comma, `_` after a brace
as the start of emphasis, `<b` as a tag. So formulas use TeX commands that have no meaning in Markdown.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from derive.course.placement import STATEMENT
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
    UnitMark,
    Verdict,
)
from derive.render.notation.latex import dimension_latex, latex, unit_latex
from derive.render.notation.notation import Notation
from derive.render.printing.amsmath import aligned, display_rows
from derive.render.printing.lines import TEXT_WIDTH, Printed
from derive.render.printing.text_page import inline_text

_SPECIAL = re.compile(r"([\\`*_{}\[\]<>$|~#&])")
_AS_A_LIST = re.compile(r"^(\d+)([.)])(?=\s)|^([-+=])")  # text that would begin a list or underline a heading
_IN_WORDS = {
    r"\,": r"\thinspace ",
    r"\!": r"\negthinspace ",
    r"\{": r"\lbrace ",
    r"\}": r"\rbrace ",
    r"\ ": r"\thickspace ",
    r"\%": r"\text{percent}",
    "<": r"\lt ",
    ">": r"\gt ",
}
_BREAK = re.compile(r"\\\\(?:\[[^\]]*\])?")  # the end of a row, with or without extra space
_SIGNS = re.compile(r"\\[,!{} %]|[<>]")


class MarkdownPage:
    """A document as a sequence of pieces, each a text or a drawing."""

    def __init__(self, document: Document, words: Phrases, notation: Notation):
        self.document, self.words, self.notation = document, words, notation

    def head(self) -> Iterator[str | Illustration]:
        """Yield the title, the statement with its drawings, and the strategy."""
        yield self._heading("#", self.inline(self.document.title), self.words.worth(self.document.points))
        yield self.paragraph(self.document.statement)
        yield from (drawing for drawing in self.document.illustrations if drawing.at == STATEMENT)
        if self.document.strategy:
            yield f"**{text_markdown(self.words.labels['strategy'])}** {self.inline(self.document.strategy)}"

    def section(self, part: PartPage) -> Iterator[str | Illustration]:
        """Yield the pieces of a part or of the limiting cases."""
        label = f"({part.label}) " if part.label else ""
        yield self._heading(
            "##", label + self.inline(part.ask), self.words.worth(self.document.points_of(part), part.extra)
        )
        yield from self._blocks(part.blocks)

    def end(self) -> Iterator[str | Illustration]:
        """Yield the note and the sentences about the checks."""
        if self.document.note:
            yield f"**{text_markdown(self.words.labels['note'])}** {self.inline(self.document.note)}"
        if self.document.closing:
            yield f"---\n\n**{text_markdown(self.words.labels['checked'])}** {self.inline(self.document.closing)}"

    def sections(self) -> Sequence[PartPage]:
        return (*self.document.parts_shown, *([self.document.limits] if self.document.limits else []))

    def pieces(self) -> Iterator[str | Illustration]:
        """Yield all pieces of the page."""
        yield from self.head()
        for part in self.sections():
            yield from self.section(part)
        yield from self.end()

    def drawing(self, drawing: Illustration) -> str:
        """Return a link to the drawing in the same folder; if the file is missing, readers see the alternative text."""
        alt = text_markdown(inline_text(drawing.alt, self.notation, self.document.numbers))
        return "\n\n".join(filter(None, [f"![{alt}]({drawing.stem}.svg)", self.caption(drawing)]))

    def caption(self, drawing: Illustration) -> str:
        if drawing.number is None:
            return ""
        label = f"{self.words.labels['figure']} {drawing.number}."
        return f"**{text_markdown(label)}** {self.inline(drawing.caption)}"

    def paragraph(self, nodes: Sequence[Inline]) -> str:
        return _AS_A_LIST.sub(lambda m: rf"{m[1]}\{m[2]}" if m[1] else rf"\{m[3]}", self.inline(nodes).strip())

    def inline(self, nodes: Sequence[Inline]) -> str:
        return "".join(self._node(node) for node in nodes)

    def _node(self, node: Inline) -> str:
        match node:
            case NewParagraph():
                return "\n\n"
            case Verdict(text):
                return f"**{text_markdown(text)}**"
            case Text(text):
                return text_markdown(text)
            case Math(expr):
                return f"${formula_markdown(latex(self.notation.result(expr), inline=True))}$"
            case DimensionMark(dimension):
                return f"${formula_markdown(dimension_latex(dimension))}$"
            case UnitMark(text):
                return f"${formula_markdown(unit_latex(text))}$"
            case Ref(key):
                return f"({self.document.numbers[key]})"
            case ProblemRef(of, text):
                return f"[{text_markdown(text)}]({of.rpartition('/')[2]}.md)"
        raise TypeError(f"nothing prints {type(node).__name__}")

    def _heading(self, level: str, text: str, worth: str) -> str:
        return f"{level} {text} ({text_markdown(worth)})" if worth else f"{level} {text}"

    def _blocks(self, blocks: Sequence[Block]) -> Iterator[str | Illustration]:
        for block in blocks:
            match block:
                case Paragraph(nodes):
                    yield self.paragraph(nodes)
                case Display():
                    yield self._display(block)
                case Illustration():
                    yield block
                case Folded(blocks=folded):
                    yield from self._blocks(folded)

    def _display(self, display: Display) -> str:
        rows = display_rows(display, self.notation, TEXT_WIDTH, self._ending)
        return f"$$\n{formula_markdown(aligned(rows))}\n$$"

    def _ending(self, line: Printed) -> str:
        number = "" if line.number is None else rf"\qquad\text{{({line.number})}}"
        reason = (Text("["), *line.reason, Text("]")) if line.reason else ()
        return (rf"\quad{self.told_in_formula(reason)}" if reason else "") + number

    def told_in_formula(self, nodes: Sequence[Inline]) -> str:
        """Return words, which may contain formulas, for use within a formula."""
        return "".join(self._in_formula(node) for node in nodes).replace(r"}\text{", "")

    def _in_formula(self, node: Inline) -> str:
        match node:
            case Math(expr):
                return latex(self.notation.result(expr), inline=True)
            case Text(text):
                return rf"\text{{{_in_text(text)}}}"
        return rf"\text{{{_in_text(inline_text([node], self.notation, self.document.numbers))}}}"


def text_markdown(text: str) -> str:
    """Return plain text that Markdown shows unchanged."""
    return _SPECIAL.sub(r"\\\1", text)


def formula_markdown(tex: str) -> str:
    """Return a formula without characters that have a meaning in Markdown."""
    tex = _SIGNS.sub(lambda sign: _IN_WORDS[sign[0]], _BREAK.sub(r"\\cr ", tex))
    tex = re.sub(r"\\bm(?=\W)", r"\\boldsymbol", tex)
    # In Markdown, a `_` within a word or before a space does not begin emphasis.
    tex = re.sub(r"(?<!\w)_", "_ ", tex).replace("](", "] (")
    return re.sub(r" +\n", "\n", re.sub(r" {2,}", " ", tex)).strip()


def _in_text(text: str) -> str:
    """Return text for use in the braces of `\\text`; special characters become spaces."""
    return re.sub(r"[\\{}$#%&_^~]", " ", text)
