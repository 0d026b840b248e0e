"""A page as HTML: the templates of `templates/html` filled with formulas in MathML and drawings in SVG.

Nothing needs a script, a font of the machine or the network. An equation is a row of sides, which go on below one
another where the window is narrow; what is still too wide scrolls within its own line.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from derive.course.parts import points_text
from derive.course.placement import STATEMENT
from derive.page.numbering import Number
from derive.page.rubric import Credit
from derive.page.theorems import alone
from derive.page.tree import Block, Display, Document, Folded, Illustration, PartPage
from derive.page.wording import DimensionMark, Inline, Math, Phrases, ProblemRef, Ref, Text, UnitMark
from derive.render.notation.latex import TEX_OPERATORS, dimension_latex, latex, unit_latex
from derive.render.notation.layout import Layout, width
from derive.render.notation.mathml import mathml, of_latex
from derive.render.notation.notation import Notation
from derive.render.printing.amsmath import display_latex, equation_latex
from derive.render.printing.lines import Printed, printed_lines
from derive.render.printing.templates import filled_html
from derive.render.printing.text_page import closing_title, inline_text
from derive.render.rendered import Files, Html

WIDE = 24.0  # characters that a narrow window has room for; what is wider scrolls, and can be reached by the keyboard


@dataclass(frozen=True)
class HtmlFragments:
    """One problem for the pages that it stands on; these give it its number and its title."""

    title: Html
    solution: Html


NO_HTML = HtmlFragments(Html(""), Html(""))


def problem_html(
    document: Document, words: Phrases, notation: Notation, folder: Path, drawings: Files
) -> HtmlFragments:
    page = HtmlPage(document, words, notation, drawings)
    return HtmlFragments(page.title(), filled_html(folder, "problem.html.j2", {"page": page}))


class HtmlPage:
    """What the template may ask of a document, in HTML."""

    def __init__(
        self,
        document: Document,
        words: Phrases,
        notation: Notation,
        drawings: Files = (),
        rubric: Mapping[str, Sequence[Credit]] | None = None,
        top: int = 1,
    ):
        """`top` is the level of the heading that it stands below."""
        self.document, self.words, self.notation, self.rubric = alone(document), words, notation, rubric or {}
        self.alone = top == 1
        self.begin, self.end = Html(f"<h{top + 1}>"), Html(f"</h{top + 1}>")
        self._placed: set[Number] = set()
        self.drawings = {name: content for name, content in drawings if name.endswith(".svg")}

    def title(self) -> Html:
        return self.inline(self.document.title)

    def worth(self, part: PartPage) -> str:
        return self.words.worth(part.points, part.extra)

    def credits(self, part: PartPage) -> Sequence[Credit]:
        return self.rubric.get(part.label, ())

    def worth_of(self, credit: Credit) -> str:
        return points_text(credit.points)

    def result_of(self, credit: Credit) -> Html:
        formula = equation_latex(credit.result, self.notation)
        return of_latex(formula, inline=True)

    def number_of(self, credit: Credit) -> str:
        return f"({credit.equations.number})"

    def sections(self) -> Sequence[PartPage]:
        """The parts, and behind them the limiting cases."""
        return (*self.document.parts_shown, *([self.document.limits] if self.document.limits else []))

    def kind(self, block: Block) -> str:
        return type(block).__name__.lower()

    def closing(self) -> Html:
        title = closing_title(self.document, self.words)
        return Html(f"<strong>{escape(title)}</strong> {self.inline(self.document.closing)}")

    def inline(self, nodes: Sequence[Inline]) -> Html:
        return Html("".join(self._node(node) for node in nodes))

    def plain(self, nodes: Sequence[Inline]) -> str:
        return inline_text(nodes, self.notation, self.document.numbers)

    def _node(self, node: Inline) -> str:
        match node:
            case Text(text):
                return escape(text)
            case Math(expr):
                layout = self.notation.result(expr)
                formula = mathml(layout, inline=True)
                return _scrolling(formula, self.plain([node])) if width(layout) > WIDE else formula
            case DimensionMark(dimension):
                return of_latex(dimension_latex(dimension), inline=True)
            case UnitMark(text):
                return of_latex(unit_latex(text), inline=True)
            case Ref(key):
                number = self.document.numbers[key]
                return f'<a href="#{_anchor(number)}">({number})</a>'
            case ProblemRef(of, text):
                return f'<a href="{escape(of.rpartition("/")[2])}.html">{escape(text)}</a>'
        return ""

    # --- equations ---------------------------------------------------------------------------------------------------

    def steps(self, display: Display) -> Sequence[Html]:
        """The rows of each step of a display."""
        return [
            Html("\n".join(self._row(line, "" if line is not printed[-1] else stop) for line in printed))
            for group, stop in zip(display.groups, display.stops, strict=True)
            for printed in [printed_lines(group, self.notation)]
        ]

    def numbers(self, folded: Folded) -> str:
        """Of the equations that are folded."""
        groups = [group for block in folded.blocks if isinstance(block, Display) for group in block.groups]
        return ", ".join(f"({number})" for number in dict.fromkeys(group.number for group in groups))

    def tex(self, display: Display) -> str:
        """The same as LaTeX, to be copied."""
        return display_latex(display, self.notation)

    def _row(self, line: Printed, stop: str) -> str:
        left = "" if line.left is None else _scrolling_if_wide(line.left, mathml(line.left))
        cells = [f'<span class="left">{left}</span>', f'<span class="sides">{_sides(line, stop)}</span>']
        if line.frames_all:
            cells = ['<span class="answer">', *cells, "</span>"]
        why = f'<span class="why">{self.inline(line.reason)}</span>' if line.reason else ""
        number = "" if line.number is None else f'<span class="number">({line.number})</span>'
        anchor = "" if line.number is None or not self._is_first(line.number) else f' id="{_anchor(line.number)}"'
        return f'<div class="row"{anchor}>{"".join(cells)}{why}{number}</div>'

    def _is_first(self, number: Number) -> bool:
        """Lines that are folded below an equation have its number again, but not its place."""
        known = number in self._placed
        self._placed.add(number)
        return not known

    # --- drawings ----------------------------------------------------------------------------------------------------

    def in_statement(self) -> Sequence[Illustration]:
        return [drawing for drawing in self.document.illustrations if drawing.at == STATEMENT]

    def drawing(self, drawing: Illustration) -> Html:
        """The shapes themselves, or what they show in words where they are not drawn."""
        shapes = self.drawings.get(f"{drawing.stem}.svg", b"").decode()
        return Html(shapes or escape(self.plain(drawing.alt)))

    def caption(self, drawing: Illustration) -> Html:
        if drawing.number is None:
            return Html("")
        label = f"{self.words.labels['figure']} {drawing.number}."
        return Html(f"<strong>{escape(label)}</strong> {self.inline(drawing.caption)}")


def _sides(line: Printed, stop: str) -> str:
    """Relations and right sides, each of which may begin a line of its own; those that are the result have a frame."""
    at = len(line.sides) - (0 if line.frames_all else line.framed)
    shown = [_side(relation, side) for relation, side in line.sides[:at]]
    if at < len(line.sides):
        (relation, first), *others = line.sides[at:]
        framed = "".join([_scrolling_if_wide(first, mathml(first)), *(_side(*other) for other in others)])
        sign = TEX_OPERATORS[relation].strip()
        shown += [of_latex(sign) if sign else "", f'<span class="answer">{framed}</span>']
    return "".join(shown) + (f'<span class="stop">{escape(stop)}</span>' if stop else "")


def _side(relation: str, side: Layout) -> str:
    return _scrolling_if_wide(side, of_latex(f"{TEX_OPERATORS[relation]} {latex(side)}"))


def _scrolling_if_wide(layout: Layout, formula: Html) -> str:
    return _scrolling(formula, "") if width(layout) > WIDE else f'<span class="side">{formula}</span>'


def _scrolling(formula: str, said: str) -> str:
    """Reached by the keyboard, so that who has no mouse can scroll it."""
    label = f' role="group" aria-label="{escape(said)}"' if said else ""
    return f'<span class="wide" tabindex="0"{label}>{formula}</span>'


def _anchor(number: Any) -> str:
    return f"eq-{number}"
