"""A page, or a set of them, as LaTeX: the templates of `templates/latex` filled with printed lines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from derive.dimensions import Dimension
from derive.document import Answer, Display, Document, Illustration, PartPage
from derive.parts import points_text
from derive.placement import STATEMENT
from derive.render.latex import MARKS, escaped, latex, unit_latex
from derive.render.layout import Layout
from derive.render.lines import Printed, printed_lines
from derive.render.notation import Notation
from derive.wording import DimensionMark, Math, Node, Phrases, Ref, Text, Unit

WIDTH = 60.0


def problem_latex(document: Document, words: Phrases, notation: Notation, folder: Path) -> str:
    """The fragment of one problem, without preamble; `@NUMBER@` stands for its number in the set."""
    return _environment(folder).get_template("problem.tex.j2").render(page=_Page(document, words, notation))


def whole_latex(folder: Path, head: Mapping[str, Any], fragments: Sequence[str]) -> str:
    """A complete document: preamble, cover block, problems."""
    return _environment(folder).get_template("document.tex.j2").render(head=head, fragments=fragments)


@cache
def _environment(folder: Path) -> Environment:
    environment = Environment(
        loader=FileSystemLoader(folder / "latex"),
        variable_start_string="<<",
        variable_end_string=">>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # TeX, not HTML: every text goes through `escaped`
    )
    environment.filters["text"] = escaped
    return environment


class _Page:
    """What the template may ask of a document, in TeX."""

    def __init__(self, document: Document, words: Phrases, notation: Notation):
        self.document, self.words, self.notation = document, words, notation

    @property
    def id(self) -> str:
        return self.document.id

    def title(self) -> str:
        return self.inline(self.document.title)

    def statement(self) -> str:
        return self.inline(self.document.statement)

    def points(self, points: Any) -> str:
        if points is None:
            return ""
        one, many = self.words.labels["points"]
        return escaped(f"{points_text(points)} {one if points == 1 else many}")

    def parts(self) -> Sequence[PartPage]:
        return self.document.parts

    def kind(self, block: Any) -> str:
        return type(block).__name__.lower()

    def inline(self, nodes: Sequence[Node]) -> str:
        return "".join(self._node(node) for node in nodes)

    def _node(self, node: Node) -> str:
        match node:
            case Text(text):
                return escaped(text)
            case Math(expr):
                inner = latex(self._inline_layout(expr), inline=True)
                return f"${inner}$"
            case DimensionMark(dimension):
                return f"${_dimension(dimension)}$"
            case Unit(text):
                return f"${unit_latex(text)}$"
            case Ref(key):
                return self._reference(self.document.numbers[key])
        return ""

    def _inline_layout(self, expr: Any) -> Layout:
        if isinstance(expr, tuple):
            return self.notation.list_of(expr)
        return self.notation.result(expr)

    def _reference(self, number: int) -> str:
        return rf"\hyperlink{{{_anchor(self.document.id, number)}}}{{({number})}}"

    def display(self, display: Display) -> str:
        """The rows of an align environment; the last row of each step is numbered."""
        steps = []
        for group, stop in zip(display.groups, display.stops, strict=True):
            *lines, last = printed_lines(group, self.notation, WIDTH)
            rows = [self._row(line, "") for line in lines] + [self._row(last, stop)]
            steps.append(" \\\\*\n".join(rows))  # a page ends between steps, not within one
        return " \\\\\n".join(steps)

    def _row(self, printed: Printed, stop: str) -> str:
        left = latex(printed.left) if printed.left else ""
        fitted = r"\fit{%s}" if printed.width > WIDTH else "%s"
        sides = " ".join(f"{MARKS[relation].strip()} {fitted % latex(side)}" for relation, side in printed.sides)
        body = f"{left} &{sides}{stop}"
        reason = rf"\why{{{self.inline(printed.reason)}}}" if printed.reason else ""
        if printed.number is None:
            return body + (rf" \tag*{{{reason}\blanknumber}}" if reason else r" \notag")
        anchor = rf"\anchor{{{_anchor(self.document.id, printed.number)}}}"
        return body + rf" \tag*{{{reason}\eqnumber{{{printed.number}}}}}{anchor}"

    def answer(self, answer: Answer) -> str:
        left = latex(self.notation.layout(answer.symbol))
        right = latex(self.notation.result(answer.value))
        if answer.rounded is None:
            return f"{left} {MARKS[answer.relation].strip()} {right}"
        return f"{left} = {right} {MARKS[answer.relation].strip()} {latex(self.notation.layout(answer.rounded))}"

    def in_statement(self) -> Sequence[Illustration]:
        return [drawing for drawing in self.document.illustrations if drawing.at == STATEMENT]

    def drawing(self, drawing: Illustration) -> str:
        """The file, what stands in its place where it is missing, and its caption."""
        number = "" if drawing.number is None else escaped(f"{self.words.labels['figure']} {drawing.number}.")
        return rf"{{{drawing.stem}.pdf}}{{{self.inline(drawing.alt)}}}{{{number}}}{{{self.inline(drawing.caption)}}}"

    def margin(self, display: Display) -> str:
        lines = [escaped(self.words.grades[display.grade])]
        if display.routes:
            lines.append(escaped(f"{self.words.labels['second_route']}: {display.routes[0]}"))
        return r"\\ ".join(lines)

    def closing(self) -> str:
        return rf"\textbf{{{escaped(self.words.labels['checked'])}}} {self.inline(self.document.closing)}"


def _anchor(problem_id: str, number: int) -> str:
    return f"{problem_id.replace('/', '.')}.{number}"


def _dimension(dimension: Dimension) -> str:
    letters = zip("MLT", (dimension.mass, dimension.length, dimension.time), strict=True)
    parts = [letter if n == 1 else f"{letter}^{{{n}}}" for letter, n in letters if n]
    return rf"\mathsf{{{chr(32).join(parts)}}}" if parts else "1"
