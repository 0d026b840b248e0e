"""The data of one problem in TeX for the template of a report: its rows of steps, and quotations of the source."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Expr, MatrixBase

from derive.algebra.equality import Grade
from derive.course.reference.errata import Erratum
from derive.course.reference.quotes import Remark
from derive.page.checks import Row
from derive.page.tree import Document
from derive.page.wording import Phrases
from derive.render.notation.latex import escaped, latex
from derive.render.notation.notation import Notation
from derive.render.printing.figure_numbers import equation_number
from derive.render.rendered import Tex

LONG = 60  # a formula with more characters of TeX may be wider than a line; it is then reduced to the width of the line


class ReportPage:
    """One problem of a report."""

    def __init__(self, document: Document, words: Phrases, notation: Notation):
        self.document, self.words, self.notation = document, words, notation

    @property
    def rows(self) -> Sequence[Row]:
        return self.document.checks.rows

    @property
    def errata(self) -> Sequence[Erratum]:
        return self.document.checks.errata

    @property
    def remarks(self) -> Sequence[Remark]:
        return self.document.checks.remarks

    @property
    def source(self) -> str:
        """Return the name of the source document that was compared."""
        return self.document.checks.source

    def steps(self, row: Row) -> Tex:
        """Return the steps of a row, each named by its symbol, its equation number or both.

        A step that has neither is described by its inputs.
        """
        named = [name for key in row.steps if (name := self._step(key))]
        if len(named) < len(row.steps):
            named += self._made_from(row)
        return Tex(", ".join(dict.fromkeys(named)))

    def _made_from(self, row: Row) -> list[str]:
        numbers = sorted(self.document.numbers[key] for key in row.made_from if key in self.document.numbers)
        symbols = [name for key in row.made_from if (name := self._step(key))]
        found = [equation_number(number) for number in dict.fromkeys(numbers)] or symbols
        return [f"{escaped(self.words.labels['report_page']['made_from'])} {', '.join(found)}"] if found else []

    def _step(self, key: str) -> str:
        symbol, number = self.document.symbols.get(key), self.document.numbers.get(key)
        numbered = equation_number(number) if number is not None else ""
        if symbol is None:
            return numbered
        formula = rf"\fitto{{\linewidth}}{{{latex(self.notation.layout(symbol), inline=True)}}}"
        return rf"{formula}~{numbered}" if numbered else formula

    def what(self, row: Row) -> str:
        """Return a short description of the steps that a row of the table lists."""
        return self.words.rule(row.rule)

    def grade(self, row: Row) -> Tex:
        """Return the word for the grade, in bold type unless the grade is "proved"."""
        word = escaped(self.words.grades[row.grade])
        return Tex(word if row.grade is Grade.PROVED else rf"\textbf{{{word}}}")

    def printed(self, erratum: Erratum) -> Tex:
        return self.quoted(erratum.quote) if erratum.quote else self._in_our_letters(erratum, erratum.printed)

    def right(self, erratum: Erratum) -> Tex:
        return self.quoted(erratum.instead) if erratum.instead else self._in_our_letters(erratum, erratum.right)

    def quoted(self, text: str) -> Tex:
        """Return prose whose formulas between dollar signs are written again with known commands only."""
        if "$" not in text:
            return Tex(escaped(text))
        from derive.course.latex.quoting import quoted  # imported late, because few documents need it

        pieces = quoted(text)
        return Tex("".join(self._formula(p.text, len(pieces)) if p.is_formula else escaped(p.text) for p in pieces))

    def _formula(self, tex: str, pieces: int) -> str:
        if pieces > 1 and len(tex) <= LONG:
            return f"${tex}$"
        return rf"\fitto{{\linewidth}}{{{tex}}}"

    def _in_our_letters(self, erratum: Erratum, value: Any) -> Tex:
        """Return the value in the notation of the page, as `L = (...)`, for a source that is not quoted literally."""
        if isinstance(value, MatrixBase) and value.shape[1] == 1:
            value = tuple(value)
        right = latex(self.notation.result(value), inline=True)
        symbol = self.document.symbols.get(erratum.answer)
        if isinstance(value, Expr) and erratum.answer in self.document.symbols and symbol is None:
            return Tex(f"${right} = 0$")  # the residual of an equation vanishes
        return Tex(
            f"${right}$" if symbol is None else f"${latex(self.notation.layout(symbol), inline=True)} = {right}$"
        )
