"""A page as plain text for a terminal."""

from __future__ import annotations

from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.render.printing.text_page import page_text

    return page_text(solution.document, solution.words, solution.notation)


FORMAT = Format("text", "txt", _rendered)
