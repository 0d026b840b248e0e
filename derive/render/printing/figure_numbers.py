"""Numbers on a page of several problems. The figures of the whole page have consecutive numbers, and the number of an
equation begins with the number of its problem.

The problems of a page are printed separately, and each numbers its own figures from 1. These numbers are marked. Later
each number is increased by the number of figures of the earlier problems.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from derive.page.numbering import Number
from derive.render.rendered import Html

OF_PROBLEM = "<!--number of the problem-->"  # precedes the number of an equation; it is replaced later
_MARKED = re.compile(r"<!--figure-->(\d+)<!--end of figure-->")


def equation_number(number: Number) -> str:
    """Return the number of an equation in parentheses; in a document of several problems TeX adds the number of the
    problem: (5.3)."""
    return rf"\eqnumber{{{number}}}"


def figure_number(number: int) -> str:
    """Return the number of a figure, enclosed in two HTML comments."""
    return f"<!--figure-->{number}<!--end of figure-->"


def equations_numbered(problems: Iterable[tuple[str, str]]) -> list[str]:
    """Return the problems of a page with the final numbers of their equations. If the page has several problems,
    equation 3 of problem 5 is (5.3)."""
    listed = list(problems)
    return [body.replace(OF_PROBLEM, f"{number}." if len(listed) > 1 else "") for number, body in listed]


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
