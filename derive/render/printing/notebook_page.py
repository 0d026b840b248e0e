"""The notebook of a page: its words and lines as Markdown, and code for drawings and answers.

It uses version 4.5 of the notebook format (nbformat), in which every cell has an id.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from derive.page.tree import Illustration, PartPage
from derive.render.formats import Solution
from derive.render.printing.markdown_page import MarkdownPage

_OPENING = """\
# This notebook needs derive and the course: run it in the folder that contains {path}, or below.
from derive.notebook import open_problem

problem = open_problem({id})"""


def notebook(solution: Solution) -> str:
    """Return the JSON text of the notebook."""
    data = {
        "cells": [_named(cell, i) for i, cell in enumerate(_cells(solution), 1)],
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(data, indent=1, ensure_ascii=False) + "\n"


def _cells(solution: Solution) -> Iterator[dict[str, Any]]:
    page = MarkdownPage(solution.document, solution.words, solution.notation)
    problem = solution.problem
    answers = {
        shown.label: [step.key for step in solution.derivation.answering(part.answers)]
        for shown, part in zip(solution.document.parts, problem.parts, strict=True)
    }
    title, *rest = page.head()
    yield from _gathered(page, [title])
    yield _code(_OPENING.format(path=problem.path, id=json.dumps(problem.id)))
    yield from _gathered(page, rest)
    for part in page.sections():
        yield from _gathered(page, page.section(part))
        yield from (_code(f"problem.answer({json.dumps(key)})") for key in _of(part, answers))
    yield from _gathered(page, page.end())


def _of(part: PartPage, answers: dict[str, list[str]]) -> list[str]:
    return answers.get(part.label, []) if part.label else []


def _gathered(page: MarkdownPage, pieces: Iterable[str | Illustration]) -> Iterator[dict[str, Any]]:
    """Put the text between two drawings in one cell; each drawing has a code cell."""
    said: list[str] = []
    for piece in pieces:
        if isinstance(piece, str):
            said.append(piece)
            continue
        if said:
            yield _markdown(said)
        yield _code(f"problem.drawing({json.dumps(piece.key)})")
        caption = page.caption(piece)
        said = [caption] if caption else []
    if said:
        yield _markdown(said)


def _markdown(said: list[str]) -> dict[str, Any]:
    return {"cell_type": "markdown", "metadata": {}, "source": _lines("\n\n".join(said))}


def _code(source: str) -> dict[str, Any]:
    return {
        "cell_type": "code",
        "execution_count": None,
        "metadata": {},
        "outputs": [],
        "source": _lines(source),
    }


def _lines(text: str) -> list[str]:
    return text.splitlines(keepends=True)


def _named(cell: dict[str, Any], number: int) -> dict[str, Any]:
    return {"id": f"cell-{number}", **cell}
