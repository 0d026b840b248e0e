"""Tests of drawings as sheets: the same bytes each time, the pens of lines, and the letters of the page."""

from __future__ import annotations

from collections.abc import Collection

import matplotlib
import pytest
from sympy import Symbol

from derive.figures.pieces import Bullet, Patch, Stroke, Tag
from derive.render.drawing import canvas
from derive.render.drawing.canvas import FILLS, PENS, shapes_of, sheet_of
from derive.render.drawing.lettering import Lettered, letters_of
from derive.render.drawing.sheets import Shape, Sheet, sheet_of_shapes
from derive.render.notation.notation import Notation
from tests.figures.scenery import SCENES, SLAB, pieces_of


@pytest.mark.parametrize("scene", SCENES)
def test_a_sheet_is_the_same_bytes_each_time_and_has_no_date(scene: str) -> None:
    one, other = (sheet_of(pieces_of(SCENES[scene]()), Notation(), "what it shows") for _ in range(2))
    assert (one.pdf, one.svg) == (other.pdf, other.svg)
    assert b"Date" not in one.pdf + one.svg
    assert b"<title>what it shows</title>" in one.svg


def test_the_settings_of_whoever_draws_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = sheet_of(pieces_of(SLAB), Notation(), "")
    monkeypatch.setitem(matplotlib.rcParams, "mathtext.fontset", "stix")
    monkeypatch.setitem(matplotlib.rcParams, "mathtext.default", "bf")
    assert sheet_of(pieces_of(SLAB), Notation(), "") == usual


def test_what_a_drawing_says_is_set_in_letters_once() -> None:
    asked: list[Collection[str]] = []

    def letters(texts: Collection[str]) -> dict[str, Lettered]:
        asked.append(sorted(texts))
        return letters_of(texts)

    tags = [Tag(Symbol("a"), (x, 0.0), (1.0, 0.0)) for x in (0.0, 40.0)] + [Tag("up", (80.0, 0.0), (1.0, 0.0))]
    sheet_of(tags, Notation(), "", letters)
    assert asked == [["$\\mathrm{up}$", "$a$"]]


@pytest.fixture
def shapes(monkeypatch: pytest.MonkeyPatch) -> list[Shape]:
    found: list[Shape] = []

    def noted(on_it: list[Shape], *size: object) -> Sheet:
        found.extend(on_it)
        return sheet_of_shapes(on_it, *size)  # type: ignore[arg-type]

    monkeypatch.setattr(canvas, "sheet_of_shapes", noted)
    return found


def test_a_sheet_is_as_large_as_what_is_on_it_and_a_margin() -> None:
    sheet = sheet_of([Stroke(((0.0, 0.0), (30.0, 10.0)), "edge"), Bullet((-20.0, 0.0), 5.0)], Notation(), "")
    assert (sheet.width, sheet.height) == (30 + 25 + 4, 10 + 5 + 4)


def test_a_letter_stands_in_its_box_and_a_vectors_letter_is_bold(shapes: list[Shape]) -> None:
    sheet_of([Tag(Symbol("a"), (100.0, 0.0), (1.0, 0.0), gap=3.0)], Notation(), "")
    (letter,) = shapes
    assert min(x for _, spots in letter.contour for x, _ in spots) == pytest.approx(103, abs=0.3)
    assert letter.fill and not letter.line


def test_a_line_ends_under_its_head_and_dashes_are_in_terms_of_its_width() -> None:
    line, head = shapes_of([Stroke(((0.0, 0.0), (50.0, 0.0)), "asked", head=True)])
    pen = PENS["asked"]
    assert line.contour[-1] == ("L", ((50 - 0.8 * pen.head, 0.0),))
    assert (line.line, line.width, line.fill) == (pen.colour, pen.width, "")
    assert (head.contour[0], head.fill, head.line) == (("M", ((50.0, 0.0),)), pen.colour, "")
    (dashed,) = shapes_of([Stroke(((0.0, 0.0), (50.0, 0.0)), "hidden")])
    assert dashed.dashes == tuple(PENS["hidden"].width * part for part in PENS["hidden"].dashes)


def test_a_line_with_two_heads_has_one_at_each_end() -> None:
    _, *heads = shapes_of([Stroke(((0.0, 0.0), (50.0, 0.0)), "measure", head=True, tail=True)])
    assert sorted(head.contour[0][1][0] for head in heads) == [(0.0, 0.0), (50.0, 0.0)]


def test_a_surface_is_closed_and_filled() -> None:
    (surface,) = shapes_of([Patch(((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)), "body")])
    assert [letter for letter, _ in surface.contour] == ["M", "L", "L", "Z"]
    assert (surface.fill, surface.line) == (FILLS["body"], "")
