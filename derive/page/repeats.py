"""A formula stands once: a chain neither begins nor ends with what its symbol is known to be, and a result that
stands on the page already is referred to by its number.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

from sympy import MatrixBase

from derive.page.wording import Inline, Text, around_chain
from derive.steps.step import Level, Step

Lines = tuple[Any, ...]  # of a chain, as a page has them
Formula = tuple[Any, str, Any]
AGAIN = "again"  # the outcome whose sentence names the equation


class Stated:
    """The results of the page so far, each with the step that has it."""

    def __init__(self) -> None:
        self._found: dict[Formula, str] = {}

    def noted(self, key: str, lines: Lines) -> str | None:
        """The step that has the result of these lines already; else it is noted as that of this step."""
        before = self._found.setdefault(_result(lines), key) if lines else key
        return None if before == key else before

    def without_repeats(self, lines: Lines, letters: Collection[Any]) -> Lines:
        """T = (what T is in general) = (with values in it) loses the first; I' = I = (what I' is known to be) the last.

        letters  the symbols of the page: a chain may end with one of them
        """
        if len(lines) > 1 and lines[1].left is None and _result(lines[:1]) in self._found:
            lines = (replace(lines[1], left=lines[0].left), *lines[2:])
        if len(lines) > 1 and lines[-2].right in letters and _result(lines) in self._found:
            lines = lines[:-1]
        return lines


def results(step: Step, lines: Lines) -> int:
    """How many lines at the end are the result: the last one, or its decimals and before them what they are of.

    Where numbers are put in, what they are of is the same formula with units: the decimals alone are the result.
    """
    if isinstance(getattr(step, "symbol", None), MatrixBase):  # a list of names, each value of which has a line
        return len(lines)
    decimals = next((i for i, line in enumerate(reversed(lines)) if not line.numeric), len(lines))
    return decimals if decimals and step.outcome == "measured" else min(decimals + 1, len(lines))


def told_by_number(step: Step, nodes: tuple[Inline, ...], level: Level) -> tuple[Inline, ...]:
    """The sentence of what is found once more: it names the equation that has it, so that no line need follow.

    Nothing where the step is another, or the page has every line.
    """
    before, _ = around_chain(nodes)
    if step.outcome != AGAIN or level is Level.FULL or not before or not isinstance(before[-1], Text):
        return ()
    return (*before[:-1], Text(before[-1].text.rstrip(" ,") + "."))


def noted(lines: Lines, note: tuple[Inline, ...]) -> Lines:
    """With a note beside the last line, unless it has a reason there."""
    return lines if lines[-1].reason or not note else (*lines[:-1], replace(lines[-1], reason=note))


def _result(lines: Lines) -> Formula:
    """Left side, relation and right side of the last line."""
    left = next((line.left for line in reversed(lines) if line.left is not None), None)
    return left, lines[-1].relation, lines[-1].right
