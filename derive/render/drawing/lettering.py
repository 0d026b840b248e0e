"""Formulas as contours: matplotlib's mathtext sets them in the font of the page.

Importing matplotlib takes longer than drawing, so only this module imports it, and only when it draws formulas.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping
from typing import TypeAlias

from derive.figures.space import Spot
from derive.render.drawing.sheets import Contour, Extent, extent_of

LETTERS = 10.0  # the font size of labels, in points

PAPER, SCREEN = "cm", "stix"  # Computer Modern, the font of a PDF, and STIX, the font of formulas in a browser

LINES = {1: "M", 2: "L", 4: "C"}  # matplotlib's code of a segment -> letter of a `Contour`

Lettered: TypeAlias = tuple[Contour, Extent]  # a contour and its extent
Letters: TypeAlias = Callable[[Collection[str]], Mapping[str, Lettered]]


def letters_of(texts: Collection[str], font: str = PAPER) -> dict[str, Lettered]:
    """Return the contour and the extent of each mathtext, by its text; each text begins at the origin."""
    # One thread suffices because no matrices are multiplied, and a process with threads should not fork.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    import matplotlib

    # The user's matplotlib settings must not affect the page.
    with matplotlib.rc_context(matplotlib.rcParamsDefault.find_all(r"^(font|text|mathtext)\.")):
        return {text: _lettered(text, font) for text in sorted(texts)}


def _lettered(text: str, font: str) -> Lettered:
    from matplotlib.font_manager import FontProperties
    from matplotlib.path import Path
    from matplotlib.textpath import text_to_path

    places, codes = text_to_path.get_text_path(FontProperties(math_fontfamily=font), text, ismath=True)
    scale = LETTERS / text_to_path.FONT_SCALE
    spots = [(round(scale * float(x), 4), round(scale * float(y), 4)) for x, y in places]
    contour: list[tuple[str, tuple[Spot, ...]]] = []
    reached: list[Spot] = []
    at = 0
    while at < len(spots):
        stretch = tuple(spots[at : at + Path.NUM_VERTICES_FOR_CODE[codes[at]]])
        match codes[at]:
            case Path.CLOSEPOLY:
                contour.append(("Z", ()))
            case Path.CURVE3:
                reached += [*_farthest(spots[at - 1], *stretch), stretch[-1]]
                contour.append(("C", _as_cubic(spots[at - 1], *stretch)))
            case code:
                reached += stretch
                contour.append((LINES[code], stretch))
        at += len(stretch)
    return contour, extent_of(reached)


def _as_cubic(start: Spot, handle: Spot, end: Spot) -> tuple[Spot, ...]:
    """Return a quadratic Bézier curve as a cubic one, because PDF has only cubic curves."""
    near, far = ((p[0] + 2 * (handle[0] - p[0]) / 3, p[1] + 2 * (handle[1] - p[1]) / 3) for p in (start, end))
    return near, far, end


def _farthest(start: Spot, handle: Spot, end: Spot) -> list[Spot]:
    """Return the points between the ends of a quadratic curve where x or y has an extremum."""
    found = []
    for a, b, c in zip(start, handle, end, strict=True):
        bend = a - 2 * b + c
        if bend and 0 < (t := (a - b) / bend) < 1:
            x, y = (
                (1 - t) ** 2 * p + 2 * t * (1 - t) * q + t**2 * r for p, q, r in zip(start, handle, end, strict=True)
            )
            found.append((x, y))
    return found
