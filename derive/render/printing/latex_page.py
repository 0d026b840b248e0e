"""Fills the templates of `templates/latex` with printed lines: a page or a set of pages as LaTeX."""

from __future__ import annotations

import math
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, pairwise
from typing import Any

from derive.course.names import EvidenceShown
from derive.course.parts import points_text
from derive.course.placement import STATEMENT
from derive.page.clauses import continues_sentence
from derive.page.folding import groups_in, sentences
from derive.page.numbering import Number
from derive.page.rubric import Credit
from derive.page.template import Templates
from derive.page.tree import Block, Display, Document, Illustration, Paragraph, PartPage
from derive.page.wording import (
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
from derive.render.notation.latex import TEX_OPERATORS, dimension_latex, escaped, latex, unit_latex
from derive.render.notation.layout import Array, last_of
from derive.render.notation.notation import Notation
from derive.render.printing.amsmath import equation_latex
from derive.render.printing.figure_numbers import equation_number
from derive.render.printing.hyphenation import divided_words
from derive.render.printing.lines import Printed, answers_together, before_answers, framed_together, printed_lines
from derive.render.printing.report_page import ReportPage
from derive.render.printing.templates import filled_template
from derive.render.printing.text_page import inline_text, second_ways
from derive.render.rendered import Tex

# Approximate heights on the page in points, and characters in a line of text and of a note.
LINE_HEIGHT, ROW_HEIGHT, AROUND, NOTE_LINE = 13.6, 19.0, 14.0, 8.5
CHARACTERS, NOTE_CHARACTERS = 92, 14
_ADJACENT_DISPLAYS = re.compile(r"(,?)\\\] *(\w{0,4}) *\\\[")  # two formulas with at most a short word between them
END_OF_DISPLAY = r"\]"
END_LETTERS = 11  # characters at the end of a paragraph that stay on one line
LETTERS_OF_A_REFERENCE = 4  # assumed number of characters of a reference, such as (3)
FEW_ROWS = 4  # a display of at most this many steps is not divided between pages if each step is one low row


@dataclass(frozen=True)
class Fragments:
    """One problem as LaTeX without preamble for several documents, which add the problem's number and title."""

    title: Tex
    solution: Tex
    sheet: Tex
    report: Tex
    source: Tex


Blocks = tuple[Block, ...]


@dataclass(frozen=True)
class Passage:
    """Drawings with the sentences and displays before and after them; text can be set next to a single drawing."""

    before: tuple[Blocks, ...] = ()
    drawings: tuple[Illustration, ...] = ()
    after: tuple[Blocks, ...] = ()


NO_WORDS = r"\hyphenation{}"  # marks the place for the hyphenated words of a document that is not in English
NOT_TYPESET = Fragments(*[Tex("")] * 5)


def problem_latex(document: Document, words: Phrases, notation: Notation, templates: Templates) -> Fragments:
    page, questions = LatexPage(document, words, notation), _Questions(document, words, notation)
    reported = ReportPage(document, words, notation)

    def fragment(template: str, what: LatexPage | ReportPage) -> Tex:
        return filled_template(templates, template, {"page": what})

    return Fragments(
        page.title(),
        fragment("problem.tex.j2", page),
        fragment("questions.tex.j2", questions),
        fragment("reported.tex.j2", reported),
        fragment("source.tex.j2", reported) if reported.errata or reported.remarks else Tex(""),
    )


def whole_latex(templates: Templates, template: str, facts: Mapping[str, Any]) -> Tex:
    """Return a complete LaTeX document, with the hyphenation of its words if it is not in English."""
    tex = filled_template(templates, template, facts)
    if NO_WORDS not in tex:
        return tex
    return Tex(tex.replace(NO_WORDS, rf"\hyphenation{{{divided_words(tex, facts['labels']['language']['html'])}}}", 1))


class LatexPage:
    """The data of a document for the template, in TeX."""

    def __init__(
        self,
        document: Document,
        words: Phrases,
        notation: Notation,
        rubric: Mapping[str, Sequence[Credit]] | None = None,
    ):
        self.document, self.words, self.notation, self.rubric = document, words, notation, rubric or {}
        self._placed: set[Number] = set()

    @property
    def id(self) -> Tex:
        return Tex(self.document.id)

    def title(self) -> Tex:
        return self.inline(self.document.title)

    def statement(self) -> Tex:
        return self.inline(self.document.statement)

    def worth(self, part: PartPage) -> Tex:
        return Tex(escaped(self.words.worth(self.document.points_of(part), part.extra)))

    def credits(self, part: PartPage) -> Sequence[Credit]:
        """Return the points of the steps of a part; empty in documents that do not show points."""
        return self.rubric.get(part.label, ())

    def worth_of(self, credit: Credit) -> str:
        return self.words.number(points_text(credit.points))

    def result_of(self, credit: Credit) -> Tex:
        """Return the results of a step in one row."""
        return Tex(r",\quad ".join(equation_latex(line, self.notation) for line in credit.results))

    def task_of(self, credit: Credit) -> Tex:
        return Tex(escaped(credit.task))

    def number_of(self, credit: Credit) -> Tex:
        return Tex(equation_number(credit.equations.number))

    def sentences(self, blocks: Blocks) -> Sequence[Blocks]:
        return sentences(blocks)

    def parts(self) -> Sequence[PartPage]:
        return self.document.parts_shown

    def sections(self) -> Sequence[PartPage]:
        """Return the parts, followed by the limiting cases."""
        return (*self.document.parts_shown, *([self.document.limits] if self.document.limits else []))

    def is_last(self, block: Block) -> bool:
        """Return whether the block is directly before the closing sentences about the checks, with no note between."""
        last = self.sections()[-1].blocks[-1:] if self.document.closing else ()
        return any(block is each for each in last) and not self.document.note

    def has_answer(self, blocks: Blocks) -> bool:
        """Return whether a sentence shows an answer in a frame."""
        return any(group.framed for group in groups_in(blocks))

    def is_before_answer(self, block: Block) -> bool:
        """Return whether the sentence after this block, if any, shows an answer in a frame."""
        told = [
            sentences([each for each in part.blocks if not isinstance(each, Illustration)]) for part in self.sections()
        ]
        pairs = (pair for sentences_of_part in told for pair in pairwise(sentences_of_part))
        return any(first[-1] is block and self.has_answer(second) for first, second in pairs)

    def is_in_first_row(self, block: Paragraph, display: Display) -> bool:
        """Return whether words, if they are short, may be in the first row of the display after them.

        The words must continue the sentence of the display before them, or precede the law of an answer. The words must
        not contain a displayed formula, and the document must not have notes in the margin.
        """
        first, *others = printed_lines(display.groups[0], self.notation)
        is_law = not first.framed and first.left is not None and any(line.framed for line in others)
        has_display = any(isinstance(node, DisplayedMath) for node in block.nodes)
        return (continues_sentence(block.nodes) or is_law) and not has_display and not self.has_margin()

    def kind(self, block: Any) -> str:
        return type(block).__name__.lower()

    def inline(self, nodes: Sequence[Inline]) -> Tex:
        found: list[str] = []
        for node in self._ended_together(nodes):
            printed = self._node(node)
            if found and found[-1].endswith(END_OF_DISPLAY) and printed[:1] in (*".,;:",):
                found[-1] = found[-1].removesuffix(END_OF_DISPLAY) + printed[0] + END_OF_DISPLAY
                printed = printed[1:]
            found.append(printed)
        return Tex(_ADJACENT_DISPLAYS.sub(r"\1\\quad\\text{\2}\\quad ", "".join(found)))

    def _ended_together(self, nodes: Sequence[Inline]) -> Iterator[Inline]:
        """Yield the nodes. In a paragraph longer than a third of a line, no-break spaces join the last words. So the
        last line is not a single short word."""
        for _, paragraph in groupby(nodes, lambda node: isinstance(node, NewParagraph)):
            together = [(node, self._letters(node)) for node in paragraph]
            after = sum(letters for _, letters in together)
            is_long = after > CHARACTERS / 3
            for node, letters in together:
                after -= letters
                if is_long and type(node) is Text:
                    words = node.text.rstrip() if after == 0 else node.text
                    kept = max(0, len(words) + after - END_LETTERS)
                    bound = words[kept:].replace(" ", "\u00a0")
                    node = replace(node, text=f"{words[:kept]}{bound}{node.text[len(words) :]}")
                yield node

    def _letters(self, node: Inline) -> int:
        if isinstance(node, Text):
            return len(node.text)
        return len(self._text([node])) if isinstance(node, Math) else LETTERS_OF_A_REFERENCE

    def _text(self, nodes: Sequence[Inline]) -> str:
        return inline_text(nodes, self.notation, self.document.numbers)

    def _node(self, node: Inline) -> str:
        match node:
            case FigureRef(number=number, is_alone=True):
                return rf"\figureno{{{number}}}"
            case FigureRef(number=number):
                return rf"\mbox{{{self._figure_name(number, '~')}}}"
            case Verdict(text):
                return rf"\verdict{{{escaped(text)}}}"
            case Text(text):
                return escaped(text).replace(" = ", "~=~")
            case DisplayedMath(expr):
                return rf"\[{latex(self.notation.result(expr))}{END_OF_DISPLAY}"
            case Math(expr):
                inner = f"${latex(self.notation.result(expr), inline=True)}$"
                return rf"\verdict{{{inner}}}" if isinstance(node, FramedMath) else inner
            case DimensionMark(dimension):
                return f"${dimension_latex(dimension)}$"
            case UnitMark(text):
                return f"${unit_latex(text)}$"
            case Ref(key):
                return self._reference(key)
            case ProblemRef(of, text):
                return rf"\problemlink{{{dotted(of)}}}{{{escaped(text)}}}"
            case ToldOnce(name, nodes, again):
                return rf"\theorem{{{name}}}{{{self.inline(nodes)}\par}}{{{self.inline(again)}\ }}"
            case NewParagraph():
                return r"\par "
            case ToldIn(problem):
                return rf"\toldproblem{{{escaped(problem)}}}"
        raise TypeError(f"nothing prints {type(node).__name__}")

    def _reference(self, key: str) -> str:
        number = self.document.numbers[key]
        return rf"\hyperlink{{{_anchor(self.document.id, number)}}}{{{equation_number(number)}}}"

    def anchor(self) -> Tex:
        return Tex(dotted(self.document.id))

    def plain(self, nodes: Sequence[Inline], columns: int) -> str:
        """Return plain text for bookmarks, which cannot contain TeX."""
        return textwrap.shorten(self._text(nodes), columns, placeholder="\u2026")

    def passages(self, part: PartPage) -> Sequence[Passage]:
        return passages_of(part.blocks)

    def display(self, display: Display) -> Tex:
        """Return the rows of a display. A page may end between two steps, but not within a few equations of one row
        each, such as Euler's equations."""
        printed = [printed_lines(group, self.notation) for group in display.groups]
        between = r"\samestep" if all(map(_is_low, printed)) and len(printed) <= FEW_ROWS else r"\nextstep"
        steps: list[str] = []
        for steps_together in answers_together(printed):
            lines = [printed[i] for i in steps_together]
            is_list = len(lines) > 1
            steps.append(self._list(lines) if is_list else self._step(lines[0], display.stops[steps_together[0]]))
        return Tex(f"\n{between}\n".join(steps))

    def _list(self, steps: Sequence[Sequence[Printed]]) -> str:
        """Return answers in one frame, without punctuation, after the lines from which they follow. Each answer has a
        row with its number and, if it has one, its reason."""
        before = [self._row([line], "") for line in before_answers(steps)]
        rows = [
            rf"\listrow{{{latex(line.left) if line.left else ''}}}{{{_sides(line)}}}{{{self._reason(line)}}}"
            rf"{{{self._number_of(line)}}}"
            for *_, line in steps
        ]
        listed = "\n\\nextlistrow\n".join(rows)
        return "\n\\samestep\n".join([*before, f"\\framedlist{{\n{listed}\n}}{{}}"])

    def _step(self, printed: Sequence[Printed], stop: str) -> str:
        rows = framed_together(printed)
        set_rows = [self._row(lines, stop if lines is rows[-1] else "") for lines in rows]
        breaks = [r"\inlongstep" if 1 < i < len(rows) - 1 else r"\samestep" for i in range(1, len(rows))]
        return "\n".join([set_rows[0], *(f"{at}\n{row}" for at, row in zip(breaks, set_rows[1:], strict=True))])

    def _row(self, lines: Sequence[Printed], stop: str) -> str:
        """Return a row: left side, right sides, punctuation, reason and number. A framed row has no punctuation after
        it, even at the end of a sentence."""
        first, last = lines[0], lines[-1]
        stop = "" if last.framed else stop
        left = latex(first.left) if first.left else ""
        if first.framed:
            command, body = "framedrow", f"{left} {_sides(first)}" if len(lines) == 1 else _stacked(left, lines)
        elif first.sides[0][0] == "start":
            command, left, body = "brokenrow", _sides(first), ""
        else:
            command, body = "row", _sides(first)
        return rf"\{command}{{{left}}}{{{body}}}{{{stop}}}{{{self._reason(last)}}}{{{self._number_of(last)}}}"

    def _reason(self, line: Printed) -> str:
        return rf"\why{{{self.inline(line.reason)}}}" if line.reason else ""

    def _number_of(self, line: Printed) -> str:
        is_new = line.number is not None and line.number not in self._placed
        return self._numbered(line.number) if line.number is not None and is_new else ""

    def _numbered(self, number: Number) -> str:
        """Return the number of an equation, which a page shows once."""
        self._placed.add(number)
        return rf"\anchor{{{_anchor(self.document.id, number)}}}{equation_number(number)}"

    def in_statement(self) -> Sequence[Illustration]:
        return [drawing for drawing in self.document.illustrations if drawing.at == STATEMENT]

    def file(self, drawing: Illustration) -> str:
        return f"{drawing.stem}.pdf"

    def drawing(self, drawing: Illustration) -> Tex:
        """Return the file of a drawing, the text that replaces a missing file, the figure number and the caption."""
        number = "" if drawing.number is None else f"{self._figure_name(drawing.number, ' ')}."
        alt, caption = self.inline(drawing.alt), self.inline(drawing.caption)
        return Tex(rf"{{{self.file(drawing)}}}{{{alt}}}{{{number}}}{{{caption}}}")

    def _figure_name(self, number: int, space: str) -> str:
        """Return the name of a figure; TeX increases its number by the number of figures of earlier
        problems."""
        return rf"{escaped(self.words.labels['figure'])}{space}\figureno{{{number}}}"

    def margin(self, display: Display, before: Sequence[Inline] = ()) -> Tex:
        """Return the note next to a display and its words: the grade, and the first route or check that has room, if
        any."""
        lines = [escaped(self.words.grades[display.grade])]
        said = second_ways(display, self.words)
        fitting = [route for route in said if _note_height(route) <= self._height(display, before)]
        if fitting:
            lines.append(escaped(fitting[0]))
        return Tex(r"\\ ".join(lines))

    def _height(self, display: Display, before: Sequence[Inline]) -> float:
        """Return the approximate height of a display with the words before it, in points."""
        text = len(self._text(before))
        rows = sum(len(printed_lines(group, self.notation)) for group in display.groups)
        return LINE_HEIGHT * math.ceil(text / CHARACTERS) + ROW_HEIGHT * rows + AROUND

    def has_margin(self) -> bool:
        """Return whether displays have notes next to them."""
        return self.document.evidence is EvidenceShown.MARGIN

    def closing(self) -> Tex:
        return Tex(rf"\textbf{{{escaped(self.words.labels['checked'])}}} {self.inline(self.document.closing)}")


class _Questions(LatexPage):
    """The questions without solutions; a reference to an equation names the part that shows the equation."""

    def _reference(self, key: str) -> str:
        return escaped(f"{self.words.labels['part']} ({self.document.shown_in.get(key, '')})")


def passages_of(blocks: Sequence[Block]) -> list[Passage]:
    """Split a part into passages; half of the sentences between two drawings belong to each drawing."""
    passages = [Passage()]
    for sentence in sentences(blocks):
        first, last = sentence[0], passages[-1]
        if not isinstance(first, Illustration) and last.drawings:
            passages[-1] = replace(last, after=(*last.after, sentence))
        elif not isinstance(first, Illustration):
            passages[-1] = replace(last, before=(*last.before, sentence))
        elif last.after:
            half = len(last.after) // 2
            passages[-1:] = [replace(last, after=last.after[:half]), Passage(last.after[half:], (first,))]
        else:
            passages[-1] = replace(last, drawings=(*last.drawings, first))
    return passages


def _is_low(lines: Sequence[Printed]) -> bool:
    return len(lines) == 1 and not any(isinstance(last_of(side), Array) for _, side in lines[0].sides)


def _sides(line: Printed) -> str:
    return " ".join(f"{TEX_OPERATORS[relation].strip()} {latex(side)}" for relation, side in line.sides)


def _stacked(left: str, lines: Sequence[Printed]) -> str:
    rows = [f"&{_sides(line).strip()}" for line in lines]
    return rf"\begin{{aligned}}{left} " + r" \\ ".join(rows) + r"\end{aligned}"


def dotted(problem_id: str) -> str:
    """Return the name of a problem's anchor in a document."""
    return problem_id.replace("/", ".")


def _note_height(route: str) -> float:
    return NOTE_LINE * (1 + len(textwrap.wrap(route, NOTE_CHARACTERS)))


def _anchor(problem_id: str, number: Number) -> str:
    return f"{dotted(problem_id)}.{number}"
