"""The pieces of a page as plain HTML with formulas in TeX, for learning platforms.

These platforms keep only simple tags. They show formulas between `\\(` and `\\)`, and displays between `\\[` and
`\\]`, with MathJax, which reads TeX.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from html import escape

from sympy import Symbol

from derive.course.placement import STATEMENT
from derive.page.chain_lines import Equations
from derive.page.cross_references import found_before
from derive.page.introduced_symbols import references_in
from derive.page.tree import Block, Display, Folded, Illustration, PartPage
from derive.page.wording import (
    DimensionMark,
    Inline,
    Math,
    NewParagraph,
    ProblemRef,
    Ref,
    Text,
    UnitMark,
    filled,
    joined,
)
from derive.render.notation.latex import dimension_latex, latex, unit_latex
from derive.render.printing.amsmath import aligned, display_rows
from derive.render.printing.lines import TEXT_WIDTH
from derive.render.printing.markdown_page import MarkdownPage
from derive.render.printing.text_page import inline_text
from derive.steps.step import Step

IMAGE = "@@FILE@@/"  # stands for the address of a file, which the platform inserts


class TexInHtml(MarkdownPage):
    """A document as HTML; a drawing is an image whose file the platform stores."""

    def statement(self) -> str:
        """Return the statement with its drawings."""
        drawings = (self.drawing(each) for each in self.document.illustrations if each.at == STATEMENT)
        return "\n".join([self.paragraph(self.document.statement), *drawings])

    def question(self, part: PartPage) -> str:
        """Return the question of a part."""
        return self.paragraph(part.ask)

    def solution(self, part: PartPage) -> str:
        """Return the solution of a part."""
        return self._joined(self._blocks(part.blocks))

    def cited(self, part: PartPage, steps: Iterable[Step]) -> str:
        """Return the equations of other parts that the solution of a part cites, with the names of their steps. A
        platform shows the solution of each part separately."""
        numbers = self.document.numbers
        missing = {numbers[key] for key in references_in(part.blocks)} - {
            each.number for each in _equations(part.blocks)
        }
        shown = [
            Display((replace(each, framed=0),))
            for other in self.document.parts
            for each in _equations(other.blocks)
            if each.number in missing
        ]
        keys = {each.groups[0].key for each in shown}
        told = found_before((step for step in steps if step.key in keys), self.document.shown_in, self.words)
        return "\n".join([*map(self.paragraph, told), *map(self._display, shown)])

    def typing(self, letters: Iterable[Symbol]) -> str:
        """Return a sentence that says how to type the letters whose names have more than one character; an empty text
        if no name is so long."""
        long = sorted((letter for letter in letters if len(letter.name) > 1), key=lambda letter: letter.name)
        words = self.words.labels
        told = [filled(words["typed_letter"], {"name": Text(each.name), "letter": Math(each)}) for each in long]
        return self.paragraph(filled(words["typed"], {"letters": joined(told, words["and"])})) if told else ""

    def remarks(self) -> str:
        """Return the strategy and the note, if the problem has them."""
        texts = ((self.words.labels[name], getattr(self.document, name)) for name in ("strategy", "note"))
        return "\n".join(f"<p><b>{escape(label)}</b></p>\n{self.paragraph(text)}" for label, text in texts if text)

    def _joined(self, pieces: Iterable[str | Illustration]) -> str:
        return "\n".join(piece if isinstance(piece, str) else self.drawing(piece) for piece in pieces)

    def drawing(self, drawing: Illustration) -> str:
        alt = escape(inline_text(drawing.alt, self.notation, self.document.numbers))
        image = f'<p><img src="{IMAGE}{drawing.stem}.svg" alt="{alt}"></p>'
        return "\n".join(filter(None, [image, self.caption(drawing)]))

    def caption(self, drawing: Illustration) -> str:
        if drawing.number is None:
            return ""
        label = escape(f"{self.words.labels['figure']} {drawing.number}.")
        return f"<p><b>{label}</b> {self.inline(drawing.caption)}</p>"

    def paragraph(self, nodes: Sequence[Inline]) -> str:
        return f"<p>{self.inline(nodes).strip()}</p>"

    def _node(self, node: Inline) -> str:
        match node:
            case NewParagraph():
                return "</p>\n<p>"
            case Text(text):
                return escape(text, quote=False)
            case Math(expr):
                return formula_html(latex(self.notation.result(expr), inline=True))
            case DimensionMark(dimension):
                return formula_html(dimension_latex(dimension))
            case UnitMark(text):
                return formula_html(unit_latex(text))
            case Ref(key):
                return f"({self.document.numbers[key]})"
            case ProblemRef(_, text):
                return escape(text, quote=False)
        raise TypeError(f"nothing prints {type(node).__name__}")

    def _display(self, display: Display) -> str:
        rows = display_rows(display, self.notation, TEXT_WIDTH, self._ending)
        return rf"<p>\[{_for_mathjax(aligned(rows))}\]</p>"


def _equations(blocks: Iterable[Block]) -> Iterator[Equations]:
    """Yield the numbered equations of these blocks."""
    for block in blocks:
        if isinstance(block, Display):
            yield from block.groups
        elif isinstance(block, Folded):
            yield from _equations(block.blocks)


def formula_html(tex: str) -> str:
    """Return a formula in TeX for a line of HTML."""
    return rf"\({_for_mathjax(tex)}\)"


def _for_mathjax(tex: str) -> str:
    """Return a formula with commands of MathJax only, and without characters that HTML reads as tags."""
    return escape(" ".join(tex.replace(r"\bm", r"\boldsymbol").split()), quote=False)
