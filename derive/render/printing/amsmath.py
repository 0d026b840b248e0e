"""Prints a display as standard LaTeX without custom commands; several rows are in one `aligned` environment."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from derive.page.chain_lines import ChainLine
from derive.page.tree import Display
from derive.render.notation.latex import TEX_OPERATORS, latex
from derive.render.notation.layout import Layout
from derive.render.notation.notation import Notation
from derive.render.printing.lines import LINE_WIDTH, Printed, framed_together, printed_lines


@dataclass(frozen=True)
class Row:
    """The parts of a row before and after the alignment mark; each part may contain a matrix."""

    left: str
    right: str

    def __str__(self) -> str:
        return f"{self.left} &{self.right}".lstrip()


def display_latex(display: Display, notation: Notation, numbered: bool = False) -> str:
    """Return the rows one below another with aligned relations; answers are boxed."""
    return aligned(display_rows(display, notation, ending=_number if numbered else None))


def display_rows(
    display: Display, notation: Notation, limit: float = LINE_WIDTH, ending: Callable[[Printed], str] | None = None
) -> list[Row]:
    """Return the rows of a display. Each row ends with its `ending`, if given."""
    return [
        _row(lines, stop if lines is rows[-1] else "", ending(lines[-1]) if ending else "")
        for group, stop in zip(display.groups, display.stops, strict=True)
        for rows in [framed_together(printed_lines(group, notation, limit))]
        for lines in rows
    ]


def equation_latex(line: ChainLine, notation: Notation) -> str:
    """Return one equation for use within a line of text."""
    left = latex(notation.side(line.left), inline=True) if line.left is not None else ""
    return f"{left} {TEX_OPERATORS[line.relation]} {latex(notation.result(line.right), inline=True)}".strip()


def aligned(rows: Sequence[Row]) -> str:
    """Return several rows in one aligned block, or a single row without alignment."""
    if len(rows) == 1:
        return _spaced(rows[0].left, rows[0].right)
    return "\\begin{aligned}\n" + " \\\\\n".join(map(str, rows)) + "\n\\end{aligned}"


def _number(line: Printed) -> str:
    return "" if line.number is None else rf"\qquad({line.number})"


def _row(lines: Sequence[Printed], stop: str, ending: str) -> Row:
    first, *others = lines
    stop = "" if lines[-1].framed else stop  # a frame ends a sentence without punctuation
    left = latex(first.left) if first.left else ""
    if first.framed:
        rows = [Row(left, _sides(first.sides)), *_going_on(others)]
        return Row("", _boxed(aligned(rows)) + ending)
    return Row(left, f"{_sides(first.sides)}{stop}{ending}")


def _going_on(lines: Sequence[Printed]) -> list[Row]:
    return [Row("", _sides(line.sides)) for line in lines]


def _sides(sides: Sequence[tuple[str, Layout]]) -> str:
    return _spaced(*(part for relation, side in sides for part in (_sign(relation), latex(side))))


def _sign(relation: str) -> str:
    return TEX_OPERATORS[relation].strip()


def _boxed(formula: str) -> str:
    return rf"\boxed{{{formula}}}"


def _spaced(*parts: str) -> str:
    return " ".join(part for part in parts if part)
