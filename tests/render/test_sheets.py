"""Tests of shapes as files: the PDF and the SVG show the same shapes and have the same bytes each time."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as tree

import pytest
from pypdf import PdfReader

from derive.render.drawing.sheets import Contour, Shape, circle, contour_through, moved, sheet_of_shapes, turned

INK = "#1F3A5F"
SQUARE = contour_through([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], closed=True)
SHAPES = [
    Shape(SQUARE, "#FFFFFF"),
    Shape(contour_through([(-1.0, -2.0), (3.0, 5.0)]), "", INK, 0.5, (1.5, 1.0)),
    Shape(circle((1.0, 1.0), 0.5), INK, INK, 0.45),
]
SHEET = sheet_of_shapes(SHAPES, (-1.0, -2.0, 3.0, 5.0), "a < b & c")


def test_a_pdf_is_one_page_of_its_size_with_these_operators() -> None:
    (page,) = PdfReader(io.BytesIO(SHEET.pdf), strict=True).pages
    assert [float(x) for x in page.mediabox] == [0, 0, 4, 7] == [0, 0, SHEET.width, SHEET.height]
    content = page.get_contents()
    assert content is not None
    lines = content.get_data().decode().split("\n")
    assert lines[:3] == ["1 j", "1 0 0 1 1 2 cm", "1 1 1 rg"]
    assert lines[3:9] == ["0 0 m", "2 0 l", "2 2 l", "0 2 l", "h", "f"]
    assert lines[9:13] == ["0.122 0.227 0.373 RG 0.5 w [1.5 1] 0 d", "-1 -2 m", "3 5 l", "S"]
    assert lines[13:15] == ["0.122 0.227 0.373 rg", "0.122 0.227 0.373 RG 0.45 w [] 0 d"]
    assert lines[-1] == "B"


def test_a_pdf_says_where_each_of_its_objects_begins() -> None:
    table = re.findall(rb"(\d{10}) 00000 n", SHEET.pdf)
    assert [SHEET.pdf[int(at) :][:7] for at in table] == [b"%d 0 obj" % n for n in range(1, len(table) + 1)]
    start = re.search(rb"startxref\n(\d+)\n%%EOF", SHEET.pdf)
    assert start and SHEET.pdf[int(start[1]) :].startswith(b"xref")


def test_an_svg_has_the_same_shapes_and_says_what_it_shows() -> None:
    svg = tree.fromstring(SHEET.svg)
    name = "{http://www.w3.org/2000/svg}"
    assert (svg.get("width"), svg.get("viewBox"), svg.get("role")) == ("4pt", "0 0 4 7", "img")
    assert svg.findtext(f"{name}title") == "a < b & c"
    group = svg.find(f"{name}g")
    assert group is not None
    assert group.get("transform") == "matrix(1 0 0 -1 1 5)", "heights are counted downwards from the upper corner"
    square, line, dot = group
    assert (square.get("d"), square.get("fill"), square.get("stroke")) == ("M0 0L2 0L2 2L0 2Z", "#FFFFFF", None)
    assert (line.get("fill"), line.get("stroke"), line.get("stroke-dasharray")) == ("none", INK, "1.5 1")
    assert (dot.get("fill"), dot.get("stroke-width")) == (INK, "0.45")


def test_a_circle_is_round() -> None:
    """The middle of each quarter is as far from the centre as its ends, within a thousandth."""
    (_, (start,)), *quarters, (last, _) = circle((3.0, -1.0), 10.0)
    assert (start, last) == ((13.0, -1.0), "Z")
    before = start
    for _, (a, b, end) in quarters:
        x, y = (before[k] / 8 + 3 * a[k] / 8 + 3 * b[k] / 8 + end[k] / 8 for k in (0, 1))
        assert (x - 3) ** 2 + (y + 1) ** 2 == pytest.approx(100, rel=1e-3)
        before = end
    assert before == pytest.approx(start)


def test_a_contour_is_moved_and_turned_as_a_whole() -> None:
    contour: Contour = [("M", ((1.0, 0.0),)), ("L", ((2.0, 1.0),)), ("Z", ())]
    assert moved(contour, (10.0, 0.0), 3.0) == [("M", [(13.0, 0.0)]), ("L", [(16.0, 3.0)]), ("Z", [])]
    assert turned(contour) == [("M", [(-0.0, 1.0)]), ("L", [(-1.0, 2.0)]), ("Z", [])]
