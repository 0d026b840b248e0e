"""Drawings as files: the same bytes each time, with the words of the page and nothing of who draws."""

from __future__ import annotations

import matplotlib
import pytest

from derive.figures.marks import Drawing
from derive.render.drawing.canvas import sheet_of
from derive.render.notation.notation import Notation
from tests.figures.scenery import SCENES, SLAB, pieces_of


@pytest.mark.parametrize("found", SCENES, ids=lambda found: found.key)
def test_a_sheet_is_the_same_bytes_each_time_and_has_no_date(found: Drawing) -> None:
    one, other = (sheet_of(pieces_of(found), Notation(), "what it shows") for _ in range(2))
    assert (one.pdf, one.svg) == (other.pdf, other.svg)
    assert b"CreationDate" not in one.pdf
    assert b"<dc:date>" not in one.svg
    assert b"<title>what it shows</title>" in one.svg


def test_words_in_an_svg_are_escaped() -> None:
    assert b"<title>a &lt; b &amp; c</title>" in sheet_of(pieces_of(SLAB), Notation(), "a < b & c").svg


def test_the_settings_of_whoever_draws_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = sheet_of(pieces_of(SLAB), Notation(), "")
    monkeypatch.setitem(matplotlib.rcParams, "mathtext.fontset", "stix")
    monkeypatch.setitem(matplotlib.rcParams, "lines.linewidth", 9)
    assert sheet_of(pieces_of(SLAB), Notation(), "") == usual
