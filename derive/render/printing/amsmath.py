"""A display as LaTeX that every reader of mathematics knows: amsmath in one piece, without commands of our own."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from derive.page.chain_lines import ChainLine
from derive.page.tree import Display
from derive.render.notation.latex import TEX_OPERATORS, latex
from derive.render.notation.notation import Notation
from derive.render.printing.lines import LINE_WIDTH, Printed, printed_lines


def display_latex(display: Display, notation: Notation, numbered: bool = False) -> str:
    """The rows below each other, their relations aligned; what answers a question is boxed."""
    return aligned(display_rows(display, notation, ending=_number if numbered else None))


def display_rows(
    display: Display, notation: Notation, limit: float = LINE_WIDTH, ending: Callable[[Printed], str] | None = None
) -> list[str]:
    """Each row with its punctuation, and behind that what its `ending` is; `&` stands where rows are aligned."""
    return [
        _row(line, (stop if line is printed[-1] else "") + (ending(line) if ending else ""))
        for group, stop in zip(display.groups, display.stops, strict=True)
        for printed in [printed_lines(group, notation, limit)]
        for line in printed
    ]


def equation_latex(line: ChainLine, notation: Notation) -> str:
    """One equation within a line of text."""
    left = latex(notation.side(line.left), inline=True) if line.left is not None else ""
    return f"{left} {TEX_OPERATORS[line.relation]} {latex(notation.result(line.right), inline=True)}".strip()


def aligned(rows: Sequence[str]) -> str:
    """Rows in one piece; one alone is aligned with nothing."""
    if len(rows) == 1:
        return rows[0].replace("&", "", 1)
    return "\\begin{aligned}\n" + " \\\\\n".join(rows) + "\n\\end{aligned}"


def _number(line: Printed) -> str:
    return "" if line.number is None else rf"\qquad({line.number})"


def _row(line: Printed, end: str) -> str:
    left = latex(line.left) if line.left else ""
    sides = [(TEX_OPERATORS[relation].strip(), latex(side)) for relation, side in line.sides]
    if line.frames_all:
        return rf"&\boxed{{{_spaced(left, *(part for side in sides for part in side))}}}{end}"
    at = len(sides) - line.framed
    plain = [part for side in sides[:at] for part in side]
    if line.framed:
        (sign, first), *others = sides[at:]
        plain += [sign, rf"\boxed{{{_spaced(first, *(part for side in others for part in side))}}}"]
    return f"{left} &{_spaced(*plain)}{end}".lstrip()


def _spaced(*parts: str) -> str:
    return " ".join(part for part in parts if part)
