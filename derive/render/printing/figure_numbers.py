"""Figures on a page of several problems: they have consecutive numbers on the whole page.

The problems of a page are printed separately, and each numbers its own figures from 1. These numbers are marked. Later
each number is increased by the number of figures of the earlier problems.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from derive.render.rendered import Html

_MARKED = re.compile(r"<!--figure-->(\d+)<!--end of figure-->")


def figure_number(number: int) -> str:
    """Return the number of a figure between marks."""
    return f"<!--figure-->{number}<!--end of figure-->"


def numbered_in_a_row(problems: Iterable[str]) -> list[Html]:
    """Return the problems of a page with the final numbers of their figures."""
    found: list[Html] = []
    before = 0

    def in_a_row(number: re.Match[str]) -> str:
        return str(before + int(number[1]))

    for body in problems:
        found.append(Html(_MARKED.sub(in_a_row, body)))
        before += max(map(int, _MARKED.findall(body)), default=0)
    return found
