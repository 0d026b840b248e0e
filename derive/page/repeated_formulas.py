"""Repeated formulas: the first or last line of a chain is dropped if the page has already shown the formula.

If a result is already on the page, the page can refer to the number of the equation with this result.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

from sympy import MatrixBase

from derive.page.wording import Inline, Text, around_chain
from derive.steps.step import Level, Step

Lines = tuple[Any, ...]  # the lines of a chain on the page
Formula = tuple[Any, str, Any]
AGAIN = ("again", "combined")  # outcomes whose sentence refers to the earlier equation


class Stated:
    """The results that the page has shown so far, each with the key of the step that showed it first."""

    def __init__(self) -> None:
        self._found: dict[Formula, str] = {}

    def noted(self, key: str, lines: Lines) -> str | None:
        """Return the key of the earlier step with this result. If there is none, record the result under `key` and
        return None."""
        before = self._found.setdefault(_result(lines), key) if lines else key
        return None if before == key else before

    def without_repeats(self, lines: Lines, letters: Collection[Any]) -> Lines:
        """Drop the first or the last line of a chain if the page has already shown the formula of this line.

        T = (general formula) = (with values) loses its first line; I' = I = (known formula of I') loses its last line.

        letters  the symbols of the page
        """
        if len(lines) > 1 and lines[1].left is None and _result(lines[:1]) in self._found:
            lines = (replace(lines[1], left=lines[0].left), *lines[2:])
        if len(lines) > 1 and lines[-2].right in letters and _result(lines) in self._found:
            lines = lines[:-1]
        return lines


def results(step: Step, lines: Lines) -> int:
    """Return how many of the last lines show the result. For a list of results, these are all lines. For a value
    with measured numbers, these are the lines with decimals, if there are any. For any other value, these are the last
    exact line and the lines with decimals after it."""
    if isinstance(getattr(step, "symbol", None), MatrixBase):  # a list of results, with a line for each value
        return len(lines)
    decimals = next((i for i, line in enumerate(reversed(lines)) if not line.numeric), len(lines))
    return decimals if decimals and step.outcome == "measured" else min(decimals + 1, len(lines))


def told_by_number(step: Step, nodes: tuple[Inline, ...], level: Level) -> tuple[Inline, ...]:
    """Return the sentence that refers to the earlier equation of a repeated result and needs no lines; () if there is
    none."""
    before, _ = around_chain(nodes)
    if step.outcome not in AGAIN or level is Level.FULL or not before:
        return ()
    *start, last = before
    return (*start, Text(last.text.rstrip(" ,") + ".")) if isinstance(last, Text) else (*before, Text("."))


def noted(lines: Lines, note: tuple[Inline, ...]) -> Lines:
    """Add a note next to the last line, unless that line already has a reason."""
    return lines if lines[-1].reason or not note else (*lines[:-1], replace(lines[-1], reason=note))


def _result(lines: Lines) -> Formula:
    left = next((line.left for line in reversed(lines) if line.left is not None), None)
    return left, lines[-1].relation, lines[-1].right
