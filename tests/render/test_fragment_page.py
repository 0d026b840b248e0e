"""A page for another document lists the packages that it needs."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from pypdf import PdfReader

from derive.building.tex import chosen_engine, typeset
from derive.page.chain_lines import ChainLine, Equations
from derive.page.template import templates_of
from derive.page.tree import Paragraph
from derive.page.wording import DisplayedMath, FigureRef, Text
from derive.render.printing.fragment_page import fragment
from tests.courses import ROOT, rendered_once
from tests.render.pages import AXES, NOTATION, VECTORS, WHOLE, WORDS, M, T, a, display, page

TEMPLATES = templates_of(ROOT)
ALONG = WORDS, NOTATION, TEMPLATES
TEXT = fragment(WHOLE, *ALONG)


def needed(text: str) -> list[str]:
    return re.findall(r"^%   (\\usepackage.*)$", text, re.MULTILINE)


def test_it_lists_the_packages_and_the_drawings_that_it_needs() -> None:
    assert needed(TEXT) == [r"\usepackage{amsmath}", r"\usepackage{graphicx}"]
    assert re.findall(r"^%   (\S+\.pdf)$", TEXT, re.MULTILINE) == ["one-axes.pdf"]
    plain = fragment(page(Paragraph((Text("A «word»"),)), illustrations=()), WORDS, NOTATION, TEMPLATES)
    assert needed(plain) == [r"\usepackage[T1]{fontenc}", r"\usepackage{amsmath}"]


def test_equations_and_figures_have_labels_and_the_numbers_of_the_document() -> None:
    labels = ["hw9/one:mass", "hw9/one:energy", "hw9/one:figure:vectors"]
    whole = fragment(
        replace(WHOLE, illustrations=(AXES, VECTORS), note=(FigureRef("Figure\u00a01", "vectors", 1),)), *ALONG
    )
    assert re.findall(r"\\label\{(.*?)\}", whole) == labels
    assert re.findall(r"^%   (hw9/one:\S+)$", whole, re.MULTILINE) == labels
    assert r"\textbf{Figure~\thefigure.} Both {\&} true." in whole
    assert r"Figure~\ref{hw9/one:figure:vectors}" in whole
    assert not re.search(r"Figure.?\d", whole)
    assert r"\eqref{hw9/one:mass}" in TEXT
    assert "\\tag" not in TEXT


@pytest.mark.parametrize("name", ["block", "cone", "euler", "slab", "top"])
def test_a_plain_article_with_these_packages_typesets_it(tmp_path: Path, name: str) -> None:
    found = rendered_once(ROOT, f"hw9/{name}", draws=True, only={"fragment"})
    text = found.texts["fragment"]
    packages = [r"\usepackage{lmodern}", *needed(text)]
    mine = r"\begin{figure}\caption{Mine.}\end{figure}"
    document = ["\\documentclass{article}", *packages, "\\begin{document}", mine, text, "\\end{document}"]
    target, log = tmp_path / "mine.pdf", tmp_path / "log"
    typeset("\n".join(document), target, chosen_engine(None), included=found.files, log=log)
    said = " ".join(page.extract_text() for page in PdfReader(target).pages)
    assert said.count("Figure 1") == 1 and "??" not in said


def test_lines_are_shorter_for_a_narrow_text() -> None:
    chain = (ChainLine(T, "equals", sum(M * a**n for n in range(1, 9))),)
    long = page(replace(display("mass"), groups=(Equations("mass", chain, 1, 0),)), illustrations=())
    rows = [fragment(long, *ALONG, width).count(" \\\\\n") for width in (None, 12.1, 5.0)]
    assert rows[0] == rows[1] < rows[2]


def test_a_reason_without_room_has_a_row_of_its_own() -> None:
    chain = (ChainLine(T, "equals", M * a**2, reason=(Text("as a product of both"),)),)
    short = page(replace(display("mass"), groups=(Equations("mass", chain, 1, 0),)), illustrations=())
    wide, narrow = (fragment(short, *ALONG, width) for width in (None, 5.0))
    reason = r"\quad\text{\footnotesize[as a product of both]}"
    assert rf"{reason}\label{{" in wide
    assert re.search(r"\\label\{\S+\} \\\\\n&" + re.escape(reason) + r"\\notag", narrow)


def test_a_formula_of_the_author_is_reduced_if_it_is_wider_than_the_text() -> None:
    shown = page(Paragraph((DisplayedMath(sum(M * a**n for n in range(1, 9))),)), illustrations=())
    wide, narrow = (fragment(shown, *ALONG, width) for width in (None, 5.0))
    assert r"\resizebox" not in wide and needed(wide) == [r"\usepackage{amsmath}"]
    assert r"\resizebox{.95\linewidth}" in narrow and r"\usepackage{graphicx}" in needed(narrow)
