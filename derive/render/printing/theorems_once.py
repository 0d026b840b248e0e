"""Theorems on a page of several problems: the first problem that uses a theorem states it, and later problems refer to
the first problem.

The problems of a page are printed separately, so each problem contains both the statement and the reference, between
marks. Afterwards one of these two texts and all marks are removed.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import partial
from html import escape

from derive.render.rendered import Html

FIRST, LATER, END, TOLD_IN = "<!--theorem {}-->", "<!--or again-->", "<!--end of theorem-->", "<!--told in {}-->"
MARKED = re.compile(
    FIRST.format("(?P<name>[^>]*)") + "(?P<told>.*?)" + LATER + "(?P<again>.*?)" + END + "(?P<rest> *</p>)?", re.DOTALL
)


def theorem(name: str, told: str, again: str) -> str:
    """Return both texts of a theorem between marks: its statement, and the reference to an earlier problem."""
    return f"{FIRST.format(escape(name))}{told}{LATER}{again}{END}"


def told_in(problem: str) -> str:
    """Return the mark that is later replaced by a link to the problem that states a theorem. The text of the link has
    the word `problem`, such as "Problem", and the number of this problem."""
    return TOLD_IN.format(escape(problem))


def told_once(problems: Iterable[tuple[str, str, str]]) -> list[Html]:
    """Return the problems of a page, with each theorem stated only in the first problem that uses it."""
    first: dict[str, tuple[str, str]] = {}

    def chosen(match: re.Match[str], name: str, number: str) -> str:
        place, known = first.setdefault(match["name"], (name, number))
        ends = match["rest"] or ""
        if place == name:
            return match["told"] + (ends or "</p>\n<p>")
        link = rf'<a href="#{place}">\1 {known}</a>'
        return re.sub(TOLD_IN.format("([^>]*?)"), link, match["again"]) + (ends or " ")

    return [Html(MARKED.sub(partial(chosen, name=name, number=number), body)) for name, number, body in problems]
