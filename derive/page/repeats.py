"""Each formula appears once on a page: a chain neither begins nor ends with a formula that is known for its symbol.

A result that is already on the page is referred to by its number.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

from sympy import MatrixBase

from derive.page.wording import Inline, Text, around_chain
from derive.steps.step import Level, Step

Lines = tuple[Any, ...]  # the lines of a chain, as a page has them
Formula = tuple[Any, str, Any]
AGAIN = "again"  # the outcome whose sentence names the equation


class Stated:
    """The results of the page so far, each with its step."""

    def __init__(self) -> None:
        self._found: dict[Formula, str] = {}

    def noted(self, key: str, lines: Lines) -> str | None:
        """Return the step that already has the result of these lines; otherwise note the result for this step."""
        before = self._found.setdefault(_result(lines), key) if lines else key
        return None if before == key else before

    def without_repeats(self, lines: Lines, letters: Collection[Any]) -> Lines:
        """Drop a first line that repeats the general formula of T, and a last line that repeats a known formula of I'.

        T = (general formula) = (with values) loses the first, I' = I = (known formula of I') the last.

        letters  the symbols of the page: a chain may end with one of them
        """
        if len(lines) > 1 and lines[1].left is None and _result(lines[:1]) in self._found:
            lines = (replace(lines[1], left=lines[0].left), *lines[2:])
        if len(lines) > 1 and lines[-2].right in letters and _result(lines) in self._found:
            lines = lines[:-1]
        return lines


def results(step: Step, lines: Lines) -> int:
    """Return how many lines at the end are the result: the last one, or the decimals with the exact value before them.

    Where numbers are substituted, the line before repeats the formula with units: the decimals alone are the result.
    """
    if isinstance(getattr(step, "symbol", None), MatrixBase):  # a list of names, with a line for each value
        return len(lines)
    decimals = next((i for i, line in enumerate(reversed(lines)) if not line.numeric), len(lines))
    return decimals if decimals and step.outcome == "measured" else min(decimals + 1, len(lines))


def told_by_number(step: Step, nodes: tuple[Inline, ...], level: Level) -> tuple[Inline, ...]:
    """Return a sentence for a repeated result: it names the earlier equation, so no line follows.

    Return nothing if the step has another outcome, or if the page has every line.
    """
    before, _ = around_chain(nodes)
    if step.outcome != AGAIN or level is Level.FULL or not before or not isinstance(before[-1], Text):
        return ()
    return (*before[:-1], Text(before[-1].text.rstrip(" ,") + "."))


def noted(lines: Lines, note: tuple[Inline, ...]) -> Lines:
    """Add a note next to the last line, unless that line has a reason."""
    return lines if lines[-1].reason or not note else (*lines[:-1], replace(lines[-1], reason=note))


def _result(lines: Lines) -> Formula:
    """Return the left side, relation and right side of the last line."""
    left = next((line.left for line in reversed(lines) if line.left is not None), None)
    return left, lines[-1].relation, lines[-1].right
