"""The formulas of a Markdown page contain no characters that Markdown could interpret."""

from __future__ import annotations

import re

import pytest

from derive.page.tree import Paragraph
from derive.page.wording import Text
from derive.render.printing.markdown_page import MarkdownPage, formula_markdown, text_markdown
from tests.courses import ROOT, rendered_once
from tests.render.pages import AXES, NOTATION, VECTORS, WHOLE, WORDS, page

PAGE = MarkdownPage(WHOLE, WORDS, NOTATION)


def whole() -> str:
    return "\n\n".join(piece if isinstance(piece, str) else PAGE.drawing(piece) for piece in PAGE.pieces())


def test_parts_are_headings_below_the_title() -> None:
    headings = [line for line in whole().splitlines() if line.startswith("#")]
    assert headings == [
        r"# A block \& its $T$ (3 points)",
        "## (a) Find $T$ as in (2) (2.5 points)",
        "## Limiting cases",
    ]


def test_lines_have_their_reason_and_their_number() -> None:
    assert r"\quad\text{[from (1)]}" in whole()
    assert re.findall(r"\\qquad\\text\{\((\d+)\)\}", whole()) == ["1", "2"]


def test_a_drawing_is_a_link_to_the_file_beside_the_page() -> None:
    assert PAGE.drawing(AXES) == "![Some axes 50% of a](one-axes.svg)"
    assert PAGE.drawing(VECTORS) == "![Two vectors](one-vectors.svg)\n\n**Figure 1.** Both \\& true."


def test_another_problem_is_the_page_beside_it() -> None:
    assert "See [Problem 2](two.md) first." in whole()


@pytest.mark.parametrize(
    ("text", "shown"),
    [("a_b *c* [d](e) `f` $5 <g>", r"a\_b \*c\* \[d\](e) \`f\` \$5 \<g\>"), ("50 % & more", r"50 % \& more")],
)
def test_text_is_shown_as_it_is(text: str, shown: str) -> None:
    assert text_markdown(text) == shown


@pytest.mark.parametrize(
    ("text", "shown"), [("1. Find it", r"1\. Find it"), ("- a", r"\- a"), ("1.5 kg", "1.5\u00a0kg"), ("# a", r"\# a")]
)
def test_a_sentence_begins_no_list(text: str, shown: str) -> None:
    assert MarkdownPage(page(Paragraph(())), WORDS, NOTATION).paragraph((Text(text),)) == shown


@pytest.mark.parametrize(
    ("tex", "written"),
    [
        (r"a\,b", r"a\thinspace b"),
        (r"\bm{\omega}_{x}<b", r"\boldsymbol{\omega}_ {x}\lt b"),
        (r"I_{xx}", "I_{xx}"),
        (r"1 \\[3pt] 2", r"1 \cr 2"),
        (r"\left[a\right](b)", r"\left[a\right] (b)"),
    ],
)
def test_a_formula_is_written_in_words(tex: str, written: str) -> None:
    assert formula_markdown(tex) == written


@pytest.mark.parametrize("name", ["block", "cone", "euler", "slab", "top"])
def test_no_formula_of_a_page_means_anything_in_markdown(name: str) -> None:
    text = rendered_once(ROOT, f"hw9/{name}", only={"markdown"}).texts["markdown"]
    formulas = re.findall(r"\$\$\n(.*?)\n\$\$", text, re.DOTALL)
    formulas += re.findall(r"(?<![\\$])\$([^$\n]+)\$", re.sub(r"\$\$\n.*?\n\$\$", "", text, flags=re.DOTALL))
    assert len(formulas) > 40
    for formula in formulas:
        assert not re.search(r"\\[^A-Za-z]|[<>`*]|\]\(|(?<!\w)_(?! )|  ", formula), formula
