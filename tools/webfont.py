"""Write `templates/html/math.woff`: the glyphs of STIX Two Math that formulas on web pages need.

The argument is the path of the font file; the package `ziamath`, for example, contains this file.
`fonttools` must be installed. The subset keeps the licence of the font, the SIL Open Font License.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

FONT = Path(__file__).parent.parent / "templates" / "html" / "math.woff"

# In thousandths of the font size: the width of root signs (794 to 1212 in the font), the gap between a tall root sign
# and its contents, and the length by which a root sign overlaps the stroke above its contents.
ROOT_WIDTH, ROOT_SPACE, CORNER = 900, 110, 35
LATIN, GREEK = range(0x20, 0x7F), [*range(0x391, 0x3AA), *range(0x3B1, 0x3CA), 0x3D1, 0x3D5, 0x3D6, 0x3F1, 0x3F5]
BOLD, ITALIC, BOLD_ITALIC = range(0x1D400, 0x1D41A), range(0x1D434, 0x1D468), range(0x1D468, 0x1D49C)
GREEK_ITALIC, GREEK_BOLD_ITALIC = (range(at, at + 58) for at in (0x1D6E2, 0x1D71C))
SCRIPT = [*range(0x1D49C, 0x1D4B6), *map(ord, "ℬℰℱℋℐℒℳℛ")]
SANS = [*range(0x1D5A0, 0x1D5BA), *range(0x1D7CE, 0x1D7D8)]  # sans-serif letters for dimensions, and bold digits
SIGNS = map(ord, "\xa0¨¯°±·×÷˙̇̈ℎℏ−√∂∞∫∑∘∙⋅′″‴∣∥‖→←∓≈≠≤≥≪≫∝⟨⟩…⋯⎛⎜⎝⎞⎟⎠⎡⎢⎣⎤⎥⎦⎧⎨⎩⎫⎬⎭⎪\u2061\u2062\u2063")
CHARACTERS = sorted({*LATIN, *GREEK, *BOLD, *ITALIC, *BOLD_ITALIC, *GREEK_ITALIC, *GREEK_BOLD_ITALIC,
                     *SCRIPT, *SANS, *SIGNS})  # fmt: skip


def subset(whole: str, made: Path) -> None:
    """Write the glyphs of `CHARACTERS`, their larger variants, and the tables for mathematics."""
    from fontTools import subset as of_font

    options = of_font.Options()
    options.flavor, options.hinting, options.layout_features = "woff", False, ["math", "dtls"]
    options.name_IDs = [0, 1, 2, 13, 14]  # the copyright and the licence stay in the font
    font = of_font.load_font(whole, options)
    cut = of_font.Subsetter(options)
    cut.populate(unicodes=CHARACTERS)
    cut.subset(font)
    narrow_roots(font)
    of_font.save_font(font, str(made), options)


def narrow_roots(font: Any) -> None:
    """Give all root signs about the same width, because Chromium reserves the greatest width for every root."""
    variants = font["MATH"].table.MathVariants
    root = variants.VertGlyphConstruction[variants.VertGlyphCoverage.glyphs.index(font.getBestCmap()[ord("√")])]
    for variant in root.MathGlyphVariantRecord[1:]:
        width, _ = font["hmtx"][variant.VariantGlyph]
        _moved(font, variant.VariantGlyph, lambda x, width=width: x * ROOT_WIDTH / width)
    parts = [part.glyph for part in root.GlyphAssembly.PartRecords]
    stem = font["glyf"][parts[1]]  # the glyph that repeats between the hook and the corner
    left, right = stem.xMin, stem.xMax
    for glyph in parts:
        _moved(font, glyph, lambda x: _beside_stem(x, left, right))


def _beside_stem(x: float, left: int, right: int) -> float:
    """Return the new x of a point, for a narrower hook, a stem of the same thickness, and a cut corner."""
    at = ROOT_WIDTH - ROOT_SPACE - (right - left)
    return x * at / left if x < left else min(at + x - left, ROOT_WIDTH + CORNER)


def _moved(font: Any, glyph: str, along: Callable[[float], float]) -> None:
    """Replace each coordinate x of a glyph by `along(x)`, and give the glyph the width `ROOT_WIDTH`."""
    outline, table = font["glyf"][glyph], font["glyf"]
    for i, (x, y) in enumerate(outline.coordinates):
        outline.coordinates[i] = (round(along(x)), y)
    outline.recalcBounds(table)
    font["hmtx"][glyph] = (ROOT_WIDTH, outline.xMin)


if __name__ == "__main__":
    subset(sys.argv[1], FONT)
