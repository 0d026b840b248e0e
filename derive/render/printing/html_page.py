"""A page as HTML: the templates of `templates/html` filled with formulas in MathML and drawings in SVG.

A page needs no script, no installed font and no network. An equation is a row of sides. In a narrow window the sides
are below one another, and a side that is still too wide can be scrolled.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from derive.algebra.amounts import Amount
from derive.course.parts import points_text
from derive.course.placement import STATEMENT
from derive.page.chain_lines import ChainLine
from derive.page.numbering import Number
from derive.page.rubric import Credit
from derive.page.template import Templates
from derive.page.theorems import standalone
from derive.page.tree import Block, Display, Document, Folded, Illustration, PartPage
from derive.page.wording import (
    EQUALS,
    DimensionMark,
    DisplayedMath,
    FigureRef,
    FramedMath,
    Inline,
    Math,
    NewParagraph,
    Phrases,
    ProblemRef,
    Ref,
    Text,
    ToldIn,
    ToldOnce,
    UnitMark,
    Verdict,
)
from derive.render.notation.latex import TEX_OPERATORS, dimension_latex, latex, unit_latex
from derive.render.notation.layout import Layout, width
from derive.render.notation.mathml import in_pieces, mathml, of_latex
from derive.render.notation.notation import Notation
from derive.render.printing.amsmath import display_latex
from derive.render.printing.figure_numbers import OF_PROBLEM, figure_number
from derive.render.printing.lines import PAGE_WIDTH, Printed, answers_together, before_answers, printed_lines
from derive.render.printing.templates import filled_html
from derive.render.printing.text_page import inline_text
from derive.render.printing.theorems_once import theorem, told_in
from derive.render.rendered import Files, Html

LISTED = 3  # a separate page with at least this many parts has a table of contents
# Characters of a formula that fit into a narrow window, in text and in a table. A line may end between the pieces of a
# wider formula; a piece that is still too wide can be scrolled, also by keyboard.
WIDE, IN_TABLE = 24.0, 14.0
DISPLAYED = '<span class="displayed">'
PUNCTUATION = re.compile(r"[.,;:!?)]+(?= |$)")


@dataclass(frozen=True)
class HtmlFragments:
    """One problem as HTML for several pages, which add the problem's number and title."""

    title: Html
    solution: Html
    card: Html


NO_HTML = HtmlFragments(*[Html("")] * 3)


def problem_html(
    document: Document, words: Phrases, notation: Notation, templates: Templates, drawings: Files
) -> HtmlFragments:
    page = HtmlPage(document, words, notation, drawings)
    among_others = HtmlQuestions(document, words, notation, drawings, top=2)
    return HtmlFragments(
        page.title(),
        filled_html(templates, "problem.html.j2", {"page": page}),
        filled_html(templates, "card.html.j2", {"page": among_others}),
    )


class HtmlPage:
    """The data of a document for the template, in HTML."""

    def __init__(
        self,
        document: Document,
        words: Phrases,
        notation: Notation,
        drawings: Files = (),
        rubric: Mapping[str, Sequence[Credit]] | None = None,
        top: int = 1,
    ):
        """Prepare a page with a title at heading level `top`; a page with level 1 is a separate document."""
        self.standalone = top == 1
        self.document = standalone(document) if self.standalone else document
        self.words, self.notation, self.rubric = words, notation, rubric or {}
        self._within = "" if self.standalone else f"{document.id.rpartition('/')[2]}-"
        self._shown = {number for part in self.sections() for number in _numbers_of(part.blocks)}
        self.begin, self.end = Html(f"<h{top + 1}>"), Html(f"</h{top + 1}>")
        self._placed: set[Number] = set()
        self.drawings = {name: content for name, content in drawings if name.endswith(".svg")}

    def title(self) -> Html:
        return self.inline(self.document.title)

    def worth(self, part: PartPage) -> str:
        return self.words.worth(self.document.points_of(part), part.extra)

    def credits(self, part: PartPage) -> Sequence[Credit]:
        return self.rubric.get(part.label, ())

    def worth_of(self, credit: Credit) -> str:
        return self.words.number(points_text(credit.points))

    def result_of(self, credit: Credit) -> Html:
        """Return the results of a step."""
        return Html(", ".join(self._sides_of(line) for line in credit.results))

    def _sides_of(self, line: ChainLine) -> str:
        sides = [("start", self.notation.side(line.left))] if line.left is not None else []
        sides.append((line.relation, self.notation.result(line.right)))
        shown = (in_pieces(side, inline=True, sign=TEX_OPERATORS[relation]) for relation, side in sides)
        return "<wbr> ".join(_scrolling_pieces(pieces, room=IN_TABLE) for pieces in shown)

    def task_of(self, credit: Credit) -> Html:
        return Html(escape(credit.task))

    def number_of(self, credit: Credit) -> Html:
        return self._number(credit.equations.number)

    def sections(self) -> Sequence[PartPage]:
        """Return the parts, followed by the limiting cases."""
        return (*self.document.parts_shown, *([self.document.limits] if self.document.limits else []))

    def kind(self, block: Block) -> str:
        return type(block).__name__.lower()

    def closing(self) -> Html:
        return Html(f"<strong>{escape(self.words.labels['checked'])}</strong> {self.inline(self.document.closing)}")

    def inline(self, nodes: Sequence[Inline]) -> Html:
        """Return words and formulas. No line ends before the punctuation after a formula, or within `M = 1.5 kg`."""
        found: list[str] = []
        for before, node in zip((None, *nodes), nodes, strict=False):
            printed = self._node(node)
            stop = PUNCTUATION.match(printed) if found and type(node) is Text else None
            if stop and found[-1].startswith(DISPLAYED):
                found[-1], printed = f"{found[-1].removesuffix(CLOSED)}{stop[0]}{CLOSED}", printed[stop.end() :]
            elif stop and found[-1].endswith(("</math>", CLOSED)):
                found[-1], printed = _ended(found[-1], stop[0]), printed[stop.end() :]
            found.append(printed)
            if before == EQUALS and isinstance(node, Math) and isinstance(node.expr, Amount):
                found[-3:] = [_together("".join(found[-3:]))]
        return Html("".join(found))

    def plain(self, nodes: Sequence[Inline]) -> str:
        return inline_text(nodes, self.notation, self.document.numbers)

    def _node(self, node: Inline) -> str:
        match node:
            case FigureRef(number=figure, is_alone=True):
                return self._figure_number(figure)
            case FigureRef(number=figure):
                return self._figure(figure, "&nbsp;")
            case Verdict(text):
                return f'<span class="verdict">{escape(text)}</span>'
            case node if node == EQUALS:
                return "&nbsp;=&nbsp;"
            case Text(text):
                return escape(text)
            case FramedMath(expr):
                return f'<span class="verdict">{mathml(self.notation.result(expr), inline=True)}</span>'
            case DisplayedMath(expr):
                return f"{DISPLAYED}{mathml(self.notation.result(expr))}{CLOSED}"
            case Math(expr):
                layout = self.notation.result(expr)
                if width(layout) <= WIDE:
                    return mathml(layout, inline=True)
                return _scrolling_pieces(in_pieces(layout, inline=True), self.plain([node]))
            case DimensionMark(dimension):
                return of_latex(dimension_latex(dimension), inline=True)
            case UnitMark(text):
                return of_latex(unit_latex(text), inline=True)
            case Ref(key):
                number = self.document.numbers[key]
                shown = self._number(number)
                return f'<a href="#{self._anchor(number)}">{shown}</a>' if number in self._shown else shown
            case ProblemRef(of, text):
                name = escape(of.rpartition("/")[2])
                return f'<a href="{f"{name}.html" if self.standalone else f"#{name}"}">{escape(text)}</a>'
            case ToldOnce(name, nodes, again):
                return theorem(name, self.inline(nodes), self.inline(again))
            case NewParagraph():
                return '</p>\n<p class="strategy">'
            case ToldIn(problem):
                return told_in(problem)
        raise TypeError(f"nothing prints {type(node).__name__}")

    def _number(self, number: Number) -> Html:
        return Html(f"({'' if self.standalone else OF_PROBLEM}{number})")

    def _anchor(self, number: Number) -> str:
        return f"{self._within}eq-{number}"

    def place(self, part: PartPage) -> str:
        """Return the anchor of a part or of the limiting cases."""
        return f"{self._within}part-{part.label}" if part.label else f"{self._within}limits"

    def contents(self) -> Sequence[PartPage]:
        """Return the entries of the table of contents, which only a long separate page has."""
        return self.sections() if self.standalone and len(self.document.parts_shown) >= LISTED else ()

    def listed(self, part: PartPage) -> Html:
        """Return the question of a part for use as the text of a link, without the links in the question."""
        return Html(re.sub(r"</?(?:a|span)\b[^>]*>", "", self.inline(part.ask)))

    # --- equations ---------------------------------------------------------------------------------------------------

    def steps(self, display: Display) -> Sequence[Html]:
        """Return the rows of a display, with one entry per step. Steps whose answers share a frame have one entry
        together."""
        printed = [printed_lines(group, self.notation, PAGE_WIDTH) for group in display.groups]
        found = []
        for together in answers_together(printed):
            stop, lines = display.stops[together[-1]], [printed[i] for i in together]
            if len(lines) == 1:
                rows = [self._row(line, stop if line is lines[0][-1] else "") for line in lines[0]]
            else:
                rows = [self._row(line, "") for line in before_answers(lines, PAGE_WIDTH)]
                answers = [answer for *_, answer in lines]
                rows += [self._row(each, "", each is not answers[0], each is not answers[-1]) for each in answers]
            found.append(Html("\n".join(rows)))
        return found

    def numbers(self, folded: Folded) -> Html:
        """Return the numbers of the folded equations."""
        groups = [group for block in folded.blocks if isinstance(block, Display) for group in block.groups]
        return Html(", ".join(map(self._number, dict.fromkeys(group.number for group in groups))))

    def tex(self, display: Display) -> str:
        """Return the display as LaTeX that the reader can copy."""
        return display_latex(display, self.notation)

    def _row(self, line: Printed, stop: str, follows: bool = False, leads: bool = False) -> str:
        """Return a row, with the number of the equation unless an earlier row shows it.

        follows, leads     whether the row shares its frame with the row above, and with the row below
        """
        left = "" if line.left is None else _side("start", line.left)
        cells = [
            f'<span class="left">{left}</span>',
            f'<span class="sides">{_sides(line, "" if line.framed else stop)}</span>',
        ]
        if line.framed:
            cells = ['<span class="answer">', *cells, "</span>"]
        is_new = line.number is not None and self._is_first(line.number)
        why = f'<span class="why">{self.inline(line.reason)}</span>' if line.reason else ""
        number = f'<span class="number">{self._number(line.number)}</span>' if line.number and is_new else ""
        beside = f'<span class="beside">{why}{number}</span>' if why or number else ""
        anchor = f' id="{self._anchor(line.number)}"' if line.number is not None and is_new else ""
        joined = "".join([" follows" * follows, " leads" * leads])
        return f'<div class="row{joined}"{anchor}>{"".join(cells)}{beside}</div>'

    def _is_first(self, number: Number) -> bool:
        """Return whether the number has not appeared before, and record that it appears."""
        known = number in self._placed
        self._placed.add(number)
        return not known

    # --- drawings ----------------------------------------------------------------------------------------------------

    def in_statement(self) -> Sequence[Illustration]:
        return [drawing for drawing in self.document.illustrations if drawing.at == STATEMENT]

    def drawing(self, drawing: Illustration) -> Html:
        """Return the SVG of a drawing, or a description in words if the drawing is missing."""
        shapes = self.drawings.get(f"{drawing.stem}.svg", b"").decode()
        return Html(shapes or escape(self.plain(drawing.alt)))

    def caption(self, drawing: Illustration) -> Html:
        if drawing.number is None:
            return Html("")
        return Html(f"<strong>{self.figure_name(drawing)}.</strong> {self.inline(drawing.caption)}")

    def figure_name(self, drawing: Illustration) -> Html:
        return Html("" if drawing.number is None else self._figure(drawing.number, " "))

    def _figure(self, number: int, space: str) -> str:
        """Return the name of a figure; on a page of several problems, the figures later get consecutive numbers."""
        return f"{escape(self.words.labels['figure'])}{space}{self._figure_number(number)}"

    def _figure_number(self, number: int) -> str:
        return str(number) if self.standalone else figure_number(number)


def _sides(line: Printed, stop: str) -> str:
    """Return the relations and right sides of a line as HTML. The browser may start a new row before each side."""
    shown: list[str] = []
    for relation, side in line.sides:
        if relation == "next":
            shown = [_ending(shown, ","), '<span class="next"></span>']
        shown.append(_side("start" if relation == "next" else relation, side))
    return _ending(shown, stop)


def _ending(sides: Sequence[str], stop: str) -> str:
    begin, formula = sides[-1].removesuffix(CLOSED).split(">", 1)
    return "".join([*sides[:-1], f"{begin}>{_ended(formula, _stop(stop)) if stop else formula}{CLOSED}"])


def _ended(formula: str, stop: str) -> str:
    """Add punctuation to a formula so that no line begins with the punctuation."""
    before, at, last = formula.rpartition("<wbr>")
    return f"{before}{at}{_together(last + stop)}"


def _stop(stop: str) -> str:
    return f'<span class="stop">{escape(stop)}</span>' if stop else ""


def _together(formula: str) -> str:
    return f'<span class="ended">{formula}{CLOSED}'


CLOSED = "</span>"


def _side(relation: str, side: Layout) -> str:
    """Return a side of an equation. In a wide side a line may end before each term."""
    if relation == "on":
        return f'<span class="side on">{_scrolling_pieces(in_pieces(side, goes_on=True))}</span>'
    sign = TEX_OPERATORS[relation]
    if width(side) <= WIDE:
        return f'<span class="side">{of_latex(f"{sign} {latex(side)}")}</span>'
    return f'<span class="side">{_scrolling_pieces(in_pieces(side, sign=sign))}</span>'


def _scrolling_pieces(pieces: Sequence[tuple[float, Html]], said: str = "", room: float = WIDE) -> str:
    """Join pieces so that a line may end between two of them. A piece that is too wide can be scrolled."""
    label = f' role="group" aria-label="{escape(said)}"' if said else ""
    return "<wbr>".join(
        f'<span class="wide" tabindex="0"{label}>{formula}</span>' if characters > room else formula
        for characters, formula in pieces
    )


def _numbers_of(blocks: Sequence[Block]) -> Iterator[Number]:
    for block in blocks:
        if isinstance(block, Folded):
            yield from _numbers_of(block.blocks)
        elif isinstance(block, Display):
            yield from (group.number for group in block.groups)


class HtmlQuestions(HtmlPage):
    """The questions without solutions; a reference to an equation names the part that shows the equation."""

    def _node(self, node: Inline) -> str:
        if isinstance(node, Ref):
            return escape(f"{self.words.labels['part']} ({self.document.shown_in.get(node.key, '')})")
        return super()._node(node)
