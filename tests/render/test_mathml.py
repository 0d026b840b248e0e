"""The output of `latex` can be converted to MathML, and every letter of a page has a glyph."""

from __future__ import annotations

import html
import re
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont
from sympy import ImmutableMatrix, Integer, Symbol, sqrt

from derive.algebra import expressions as ex
from derive.render.notation.mathml import in_pieces, mathml, of_latex
from derive.render.notation.notation import Notation
from tests.courses import ROOT, course_in, rendered_once

FONT = ROOT / "templates" / "html" / "math.woff"
a, b, theta = Symbol("a", positive=True), Symbol("b", positive=True), ex.scalar("theta")


@pytest.mark.parametrize(
    ("expr", "marks"),
    [
        (sqrt(a / b), ["<msqrt>", "<mfrac>"]),
        (a**2, ["<msup><mi>a</mi><mn>2</mn></msup>"]),
        (ex.rate(theta), ["<mover", "θ"]),
        (ex.vector("omega"), ["𝝎"]),
        (ImmutableMatrix([a, b]), ["<mtable", "<mtr>"]),
        (Integer(3), ["<mn>3</mn>"]),
    ],
    ids=["root", "power", "rate", "vector", "column", "number"],
)
def test_a_formula_has_the_marks_of_what_it_is(expr: object, marks: list[str]) -> None:
    shown = mathml(Notation().layout(expr))
    assert all(mark in shown for mark in marks)


def test_a_formula_in_a_line_of_text_is_small_and_one_of_its_own_is_not() -> None:
    layout = Notation().layout(a / (a + b))
    assert mathml(layout).startswith('<math displaystyle="true">')
    assert mathml(layout, inline=True).startswith("<math>")


def test_fractions_below_one_another_are_rows_of_a_table_and_no_words_of_tex() -> None:
    shown = mathml(Notation().layout(ImmutableMatrix([a / b, b / a, 0])))
    assert shown.count("<mtr>") == 3 and "<mi>p</mi><mi>t</mi>" not in shown


def test_a_sum_is_in_pieces_each_with_its_sign_between_it_and_the_one_before() -> None:
    whole = Notation().layout(a - b + sqrt(a))
    (_, first), *others = in_pieces(whole, sign="=")
    assert first.count("<mo") == 1 and "=" in first and len(others) == 2
    assert all(formula.count('<mo form="infix">') == 1 for _, formula in others)
    assert [formula for _, formula in in_pieces(whole, goes_on=True)][1:] == [formula for _, formula in others]


def test_every_name_of_a_character_is_resolved() -> None:
    assert "&" not in of_latex(r"\sin \theta < 1").replace("&lt;", "")


@pytest.mark.parametrize("problem", ["euler", "block", "top", "cone", "slab"])
def test_the_font_of_a_page_has_all_characters_of_its_formulas(tmp_path: Path, problem: str) -> None:
    page = rendered_once(course_in(tmp_path, problem=problem), f"hw9/{problem}", only=("html",)).html
    formulas = re.findall(r"<math.*?</math>", page, re.DOTALL)
    text = html.unescape(re.sub(r"<[^>]*>", "", "".join(formulas)))
    with TTFont(FONT) as font:
        known = set(font.getBestCmap())
    assert formulas and {character for character in set(text) - set("\n") if ord(character) not in known} == set()


def test_no_sign_of_a_root_is_much_wider_than_another() -> None:
    with TTFont(FONT) as font:
        variants = font["MATH"].table.MathVariants
        root = variants.VertGlyphConstruction[variants.VertGlyphCoverage.glyphs.index("radical")]
        glyphs = [variant.VariantGlyph for variant in root.MathGlyphVariantRecord]
        widths = [
            font["hmtx"][glyph][0] for glyph in (*glyphs, *(part.glyph for part in root.GlyphAssembly.PartRecords))
        ]
    assert max(widths) - min(widths) < 150


def test_the_font_has_italic_letters_and_what_brackets_grow_from() -> None:
    with TTFont(FONT) as font:
        known, growing = set(font.getBestCmap()), font["MATH"].table.MathVariants.VertGlyphCoverage.glyphs
    assert {0x1D44E, 0x1D703, 0x1D714, 0x210E} <= known
    assert {"parenleft", "radical"} <= set(growing)
