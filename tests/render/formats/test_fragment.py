"""Tests of fragments, which are TeX for other documents."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from derive.render.formats.fragment import FORMAT
from tests.courses import ROOT
from tests.render.pages import NOTATION, WHOLE, WORDS


def test_it_is_a_page_without_preamble() -> None:
    problem = SimpleNamespace(root=ROOT)
    solution: Any = SimpleNamespace(document=WHOLE, words=WORDS, notation=NOTATION, problem=problem, width=None)
    text = FORMAT.render(solution)
    assert text.startswith("% Written by derive from hw9/one;")
    assert "\\documentclass" not in text
    assert "\\newcommand" not in text
    assert not FORMAT.built
    assert FORMAT.drawings == "pdf"
