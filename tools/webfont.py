"""The letters of formulas on web pages: of STIX Two Math those that a page can have, for `templates/html/math.woff`.

Run it with the font as its argument where `fonttools` is installed; the font comes with the package
`ziamath`, among others. Its licence, the SIL Open Font License, stays in what is made of it.
"""

from __future__ import annotations

import sys
from pathlib import Path

FONT = Path(__file__).parent.parent / "templates" / "html" / "math.woff"

LATIN, GREEK = range(0x20, 0x7F), [*range(0x391, 0x3AA), *range(0x3B1, 0x3CA), 0x3D1, 0x3D5, 0x3D6, 0x3F1, 0x3F5]
BOLD, ITALIC, BOLD_ITALIC = range(0x1D400, 0x1D41A), range(0x1D434, 0x1D468), range(0x1D468, 0x1D49C)
GREEK_ITALIC, GREEK_BOLD_ITALIC = (range(at, at + 58) for at in (0x1D6E2, 0x1D71C))
SCRIPT = [*range(0x1D49C, 0x1D4B6), *map(ord, "ℬℰℱℋℐℒℳℛ")]
SANS = [*range(0x1D5A0, 0x1D5BA), *range(0x1D7CE, 0x1D7D8)]  # of dimensions, and bold digits
SIGNS = map(ord, "\xa0¨¯°±·×÷˙̇̈ℎℏ−√∂∞∫∑∘∙⋅′″‴∣∥‖→←∓≈≠≤≥≪≫∝⟨⟩…⋯⎛⎜⎝⎞⎟⎠⎡⎢⎣⎤⎥⎦⎧⎨⎩⎫⎬⎭⎪\u2061\u2062\u2063")
CHARACTERS = sorted({*LATIN, *GREEK, *BOLD, *ITALIC, *BOLD_ITALIC, *GREEK_ITALIC, *GREEK_BOLD_ITALIC,
                     *SCRIPT, *SANS, *SIGNS})  # fmt: skip


def subset(whole: str, made: Path) -> None:
    """The glyphs of these characters and what they grow into, with all that is said of mathematics."""
    from fontTools import subset as of_font

    options = of_font.Options()
    options.flavor, options.hinting, options.layout_features = "woff", False, ["math", "dtls"]
    options.name_IDs = [0, 1, 2, 13, 14]  # whose it is and its licence, which stay with it
    font = of_font.load_font(whole, options)
    cut = of_font.Subsetter(options)
    cut.populate(unicodes=CHARACTERS)
    cut.subset(font)
    of_font.save_font(font, str(made), options)


if __name__ == "__main__":
    subset(sys.argv[1], FONT)
