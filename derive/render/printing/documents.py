"""Documents that are made only on request, in TeX and HTML: the key, the hints and the rubric of a problem.

This module also makes the sheet in HTML.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

from derive.course.names import HINTS, KEY, RUBRIC, SHEET
from derive.page.rubric import Credit
from derive.page.template import Templates
from derive.page.tree import Document
from derive.page.wording import Phrases
from derive.render.notation.notation import Notation
from derive.render.printing.html_page import HtmlPage, HtmlQuestions
from derive.render.printing.latex_page import LatexPage
from derive.render.printing.templates import filled_html, filled_template
from derive.render.rendered import Files

Credits = Mapping[str, tuple[Credit, ...]]


def document_fragments(
    wanted: Collection[str],
    pages: Callable[[str], Document],
    rubric: Credits,
    words: Phrases,
    notation: Notation,
    templates: Templates,
    drawings: Files,
) -> dict[str, str]:
    """Return each document in TeX by its name and in HTML by `name.html`, but the sheet only in HTML.

    pages   a function that returns the page for a document
    """
    found: dict[str, str] = {}
    for kind in wanted:
        if kind == SHEET:
            questions = HtmlQuestions(pages(kind), words, notation, drawings, top=2)
            found[f"{kind}.html"] = filled_html(templates, "questions.html.j2", {"page": questions})
        if kind not in TEMPLATES:
            continue
        document, template = pages(kind), TEMPLATES[kind]
        credited = rubric if kind != HINTS else {}
        tex = LatexPage(document, words, notation, credited)
        html = HtmlPage(document, words, notation, drawings, credited, top=2)
        found[kind] = filled_template(templates, f"{template}.tex.j2", {"page": tex})
        found[f"{kind}.html"] = filled_html(templates, f"{template}.html.j2", {"page": html})
    return found


TEMPLATES = {KEY: "problem", HINTS: "problem", RUBRIC: "rubric"}
