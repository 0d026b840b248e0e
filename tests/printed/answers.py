"""The answers of a page as each format has them: what it frames, without what only lays it out."""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterator
from html import unescape

from derive.render.notation.mathml import of_latex
from derive.render.printing.text_page import FRAMED

_LAYOUT = re.compile(
    r"\\(?:begin|end)\{aligned\}|\\(?:left|right|Bigl|Bigr|qquad|quad|thinspace|negthinspace|thickspace)(?![a-z])"
    r"|\\approx|\\[,! ]|\\\\(?:\[\w+\])?|[&=\s]"
)
_SAME = {r"\boldsymbol": r"\bm", r"\cr": r"\\", r"\lt ": "<", r"\gt ": ">", r"\lbrace ": r"\{", r"\rbrace ": r"\}"}
_BESIDE = "⎡⎢⎣⎧⎨⎩⎛⎜⎝"


def braced(tex: str, command: str) -> Iterator[tuple[str, int]]:
    for found in re.finditer(re.escape(command) + r"\{", tex):
        depth, end = 1, found.end()
        while depth:
            depth += {"{": 1, "}": -1}.get(tex[end], 0) if tex[end - 1] != "\\" or tex[end - 2] == "\\" else 0
            end += 1
        yield tex[found.end() : end - 1], end


def boxed(tex: str) -> list[str]:
    return [inside for inside, _ in braced(tex, r"\boxed")]


def framed(tex: str) -> list[str]:
    rows = [(end, next(braced(tex[end:], ""))[0]) for _, end in braced(tex, r"\framedrow")]
    rows += [(end, f"{left} {next(braced(tex[end:], ''))[0]}") for left, end in braced(tex, r"\listrow")]
    return [inside for _, inside in sorted(rows)]


def of_html(page: str) -> list[str]:
    return [
        inside for tex in re.findall(r'data-tex="([^"]*)"', without_folded(page)) for inside in boxed(unescape(tex))
    ]


def shown_in_html(page: str) -> str:
    page, found = without_folded(page), ""
    for start in re.finditer('<span class="answer">', page):
        depth, end = 1, start.end()
        for tag in re.finditer(r"<(/?)span\b", page[start.end() :]):
            depth += -1 if tag[1] else 1
            if not depth:
                end = start.end() + tag.start()
                break
        found += characters(re.sub(r"<[^>]*>", "", page[start.end() : end]))
    return found


def without_folded(page: str) -> str:
    return re.sub(r"<details>.*?</details>", "", page, flags=re.DOTALL)


def of_notebook(text: str) -> list[str]:
    return [
        inside
        for cell in json.loads(text)["cells"]
        if cell["cell_type"] == "markdown"
        for inside in boxed("".join(cell["source"]))
    ]


def bare(formulas: list[str]) -> str:
    """Formulas one after the other, without signs of equality, spaces, breaks, and punctuation at the end."""
    tex = " ".join(formula.rstrip(" ,.") for formula in formulas)
    for written, same in _SAME.items():
        tex = tex.replace(written, same)
    return _LAYOUT.sub("", tex)


def characters(text: str) -> str:
    return "".join(c for c in unicodedata.normalize("NFKD", unescape(text)) if c.isalnum())


def characters_of_tex(tex: str) -> str:
    return characters(re.sub(r"<[^>]*>", "", of_latex(tex)))


def framed_in_text(page: str) -> tuple[str, str]:
    lines = page.splitlines()
    at = [i for i, line in enumerate(lines) if line.startswith(FRAMED)]
    beside = {i + step for i in at for step in (-2, -1, 0, 1, 2) if set(lines[i]) & set(_BESIDE) or not step}
    return characters("".join(lines[i] for i in at)), characters("".join(lines[i] for i in sorted(beside)))
