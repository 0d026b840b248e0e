"""A page, or a set of them, as LaTeX: the templates of `templates/latex` filled with printed lines."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sympy import Expr, MatrixBase

from derive.algebra.dimensions import Dimension
from derive.course.names import EvidenceShown
from derive.course.placement import STATEMENT
from derive.course.reference.errata import Erratum
from derive.page.checks import Ways
from derive.page.document import Answer, Display, Document, Illustration, PartPage
from derive.page.wording import DimensionMark, Inline, Math, Phrases, ProblemRef, Ref, Text, UnitMark, filled
from derive.render.notation.latex import TEX_OPERATORS, escaped, latex, unit_latex
from derive.render.notation.notation import Notation
from derive.render.printing.lines import LINE_WIDTH, Printed, answer_lines, printed_lines
from derive.render.printing.templates import filled_template
from derive.render.printing.text_page import closing_title, inline_text
from derive.render.rendered import Tex

# About how much room things take on the page, in points, and how many characters a line of text and of a note hold.
LINE_HEIGHT, ROW_HEIGHT, AROUND, NOTE_LINE = 13.6, 19.0, 14.0, 8.5
CHARACTERS, NOTE_CHARACTERS = 92, 14


@dataclass(frozen=True)
class Fragments:
    """One problem without preamble, for the documents that it stands in; these give it its number and its title."""

    title: Tex
    solution: Tex
    sheet: Tex
    report: Tex


NOT_TYPESET = Fragments(*[Tex("")] * 4)


def problem_latex(document: Document, words: Phrases, notation: Notation, folder: Path) -> Fragments:
    page, questions = _Page(document, words, notation), _Questions(document, words, notation)

    def fragment(template: str, what: _Page) -> Tex:
        return filled_template(folder, template, {"page": what})

    return Fragments(
        page.title(),
        fragment("problem.tex.j2", page),
        fragment("questions.tex.j2", questions),
        fragment("reported.tex.j2", page),
    )


def whole_latex(folder: Path, template: str, facts: Mapping[str, Any]) -> Tex:
    """A complete document."""
    return filled_template(folder, template, facts)


class _Page:
    """What the template may ask of a document, in TeX."""

    def __init__(self, document: Document, words: Phrases, notation: Notation):
        self.document, self.words, self.notation = document, words, notation

    @property
    def id(self) -> Tex:
        return Tex(self.document.id)

    def title(self) -> Tex:
        return self.inline(self.document.title)

    def statement(self) -> Tex:
        return self.inline(self.document.statement)

    def worth(self, part: PartPage) -> Tex:
        return Tex(escaped(self.words.worth(part.points, part.extra)))

    def parts(self) -> Sequence[PartPage]:
        return self.document.parts

    def kind(self, block: Any) -> str:
        return type(block).__name__.lower()

    def inline(self, nodes: Sequence[Inline]) -> Tex:
        return Tex("".join(self._node(node) for node in nodes))

    def _node(self, node: Inline) -> str:
        match node:
            case Text(text):
                return escaped(text)
            case Math(expr):
                inner = latex(self.notation.result(expr), inline=True)
                return f"${inner}$"
            case DimensionMark(dimension):
                return f"${_dimension(dimension)}$"
            case UnitMark(text):
                return f"${unit_latex(text)}$"
            case Ref(key):
                return self._reference(key)
            case ProblemRef(of, text):
                return rf"\problemlink{{{dotted(of)}}}{{{escaped(text)}}}"
        return ""

    def _reference(self, key: str) -> str:
        number = self.document.numbers[key]
        return rf"\hyperlink{{{_anchor(self.document.id, number)}}}{{({number})}}"

    def anchor(self) -> Tex:
        return Tex(dotted(self.document.id))

    def plain(self, nodes: Sequence[Inline], columns: int) -> str:
        """For bookmarks, which are no TeX."""
        return textwrap.shorten(inline_text(nodes, self.notation, self.document.numbers), columns, placeholder="\u2026")

    def display(self, display: Display) -> Tex:
        """The rows of an align environment; the last row of each step is numbered."""
        steps = []
        for group, stop in zip(display.groups, display.stops, strict=True):
            *lines, last = printed_lines(group, self.notation)
            rows = [self._row(line, "") for line in lines] + [self._row(last, stop)]
            steps.append(" \\\\*\n".join(rows))  # a page ends between steps, not within one
        return Tex(" \\\\\n".join(steps))

    def _row(self, printed: Printed, stop: str) -> str:
        body = self._formula(printed, r"\fit{%s}" if printed.width > LINE_WIDTH else "%s") + stop
        reason = rf"\why{{{self.inline(printed.reason)}}}" if printed.reason else ""
        if printed.number is None:
            return body + (rf" \tag*{{{reason}\blanknumber}}" if reason else r" \notag")
        anchor = rf"\anchor{{{_anchor(self.document.id, printed.number)}}}"
        return body + rf" \tag*{{{reason}\eqnumber{{{printed.number}}}}}{anchor}"

    def _formula(self, printed: Printed, fitted: str = "%s", mark: str = "&") -> str:
        """The line; `mark` is where lines below each other are aligned."""
        left = fitted % latex(printed.left) if printed.left else ""
        sides = " ".join(
            f"{TEX_OPERATORS[relation].strip()} {fitted % latex(side)}" for relation, side in printed.sides
        )
        return f"{left} {mark}{sides}"

    def answer(self, answer: Answer) -> Tex:
        lines = answer_lines(answer, self.notation)
        note = rf" \quad\text{{{self.inline(answer.note)}}}" if answer.note else ""
        if len(lines) == 1:
            return Tex(self._formula(lines[0], mark="") + note)
        rows = " \\\\\n".join(self._formula(line) for line in lines)
        return Tex(rf"\begin{{aligned}}{rows}\end{{aligned}}{note}")

    def in_statement(self) -> Sequence[Illustration]:
        return [drawing for drawing in self.document.illustrations if drawing.at == STATEMENT]

    def drawing(self, drawing: Illustration) -> Tex:
        """The file, what stands in its place where it is missing, and its caption."""
        number = "" if drawing.number is None else escaped(f"{self.words.labels['figure']} {drawing.number}.")
        alt, caption = self.inline(drawing.alt), self.inline(drawing.caption)
        return Tex(rf"{{{drawing.stem}.pdf}}{{{alt}}}{{{number}}}{{{caption}}}")

    def margin(self, display: Display, before: Sequence[Inline] = ()) -> Tex:
        """The note beside a display and the words before it: as much of it as ends before the next note begins."""
        lines = [escaped(self.words.grades[display.grade])]
        said = [f"{self.words.labels['second_route']}: {route}" for route in display.routes]
        fitting = [route for route in said if _note_height(route) <= self._height(display, before)]
        if fitting:
            lines.append(escaped(fitting[0]))
        return Tex(r"\\ ".join(lines))

    def _height(self, display: Display, before: Sequence[Inline]) -> float:
        """About how high a display with the words before it is, in points."""
        text = len(inline_text(before, self.notation, self.document.numbers))
        rows = sum(len(printed_lines(group, self.notation)) for group in display.groups)
        return LINE_HEIGHT * math.ceil(text / CHARACTERS) + ROW_HEIGHT * rows + AROUND

    def ways(self) -> Sequence[Ways]:
        return self.document.checks.ways

    def named(self, key: str) -> Tex:
        """A step by its symbol, or by the number of its equation."""
        symbol = self.document.symbols.get(key)
        if symbol is not None:
            return Tex(self._node(Math(symbol)))
        return Tex(self._reference(key) if key in self.document.numbers else escaped(key))

    def more(self, count: int) -> Tex:
        return self.inline(filled(self.words.labels["checked_page"]["more"], {"count": count}))

    def errata(self) -> Sequence[Erratum]:
        return self.document.checks.errata

    def equation_of(self, erratum: Erratum, value: Any) -> Tex:
        """`L = (...)` as the document has it, or as it should be."""
        if isinstance(value, MatrixBase) and value.shape[1] == 1:
            value = tuple(value)
        right = latex(self.notation.result(value), inline=True)
        symbol = self.document.symbols.get(erratum.answer)
        if isinstance(value, Expr) and erratum.answer in self.document.symbols and symbol is None:
            return Tex(f"{right} = 0")  # an equation is stated by what vanishes in it
        return Tex(right if symbol is None else f"{latex(self.notation.layout(symbol), inline=True)} = {right}")

    def has_margin(self) -> bool:
        """Whether notes stand beside displays."""
        return self.document.evidence is EvidenceShown.MARGIN

    def closing(self) -> Tex:
        title = closing_title(self.document, self.words)
        return Tex(rf"\textbf{{{escaped(title)}}} {self.inline(self.document.closing)}")


class _Questions(_Page):
    """The same without what is derived: an equation is referred to by the part that asks for it."""

    def _reference(self, key: str) -> str:
        return escaped(f"{self.words.labels['part']} ({self.document.shown_in.get(key, '')})")


def dotted(problem_id: str) -> str:
    """The name of a problem's place in a document."""
    return problem_id.replace("/", ".")


def _note_height(route: str) -> float:
    return NOTE_LINE * (1 + len(textwrap.wrap(route, NOTE_CHARACTERS)))


def _anchor(problem_id: str, number: int) -> str:
    return f"{dotted(problem_id)}.{number}"


def _dimension(dimension: Dimension) -> str:
    parts = [letter if n == 1 else f"{letter}^{{{n}}}" for letter, n in dimension.powers.items() if n]
    return rf"\mathsf{{{chr(32).join(parts)}}}" if parts else "1"
