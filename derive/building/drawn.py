"""The drawings of a page as files, drawn anew only when what they show has changed.

Beside the kept steps each drawing is kept under a digest of everything that decides its bytes: its description, the
numbers and the size, its words, derive's modules and matplotlib.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sympy import Symbol

from derive import FOLDER
from derive.algebra.expressions import explicit
from derive.building import sealed
from derive.building.manifest import digest, package_version
from derive.course.placement import Placement
from derive.course.problem import Problem
from derive.errors import Rejected
from derive.figures.encoding import drawings_to_data
from derive.figures.marks import Plot, Recorded
from derive.page.depiction import placement_of
from derive.page.document import Document, Illustration
from derive.page.plots import Curves, curves_of
from derive.page.wording import Phrases
from derive.render.drawing.camera import Numbers, stand_ins
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.render.rendered import Files

if TYPE_CHECKING:
    from derive.render.drawing.canvas import Sheet

WIDTH, HEIGHT = 5.0, 4.2  # centimetres, without labels


def drawing_files(
    problem: Problem,
    drawings: Sequence[Recorded],
    document: Document,
    words: Phrases,
    notation: Notation,
    kept: Path | None,
) -> Files:
    """A PDF and an SVG of each drawing on the page, by file name."""
    by_key = {drawing.key: drawing for drawing in drawings}
    return tuple(
        (f"{shown.stem}.{suffix}", content)
        for shown in document.illustrations
        for suffix, content in _sheet(problem, by_key[shown.key], shown, words, notation, kept).items()
    )


def _sheet(
    problem: Problem, drawing: Recorded, shown: Illustration, words: Phrases, notation: Notation, kept: Path | None
) -> dict[str, bytes]:
    placement = placement_of(problem, drawing.key)
    values = numbers_of(problem, placement)
    curves = curves_of(problem, drawing, placement) if isinstance(drawing, Plot) else None
    width = placement.width if placement else None
    alt = inline_text(shown.alt, notation)
    key = _key(drawing, repr((sorted(values.items(), key=str), curves, width, alt, words.drawings)))
    file = kept.with_name(f"{kept.name.partition('.')[0]}.{drawing.key}.drawing.json") if kept else None
    sheet = _recalled(file, key) if file else None
    if sheet is None:
        try:
            drawn = _plot(drawing, curves, notation, words, width, alt) if curves else None
            drawn = drawn or _scene(drawing, values, notation, width, alt)
        except Rejected as error:  # a mark knows no file
            place = placement.place if placement else problem.place_of("solve")
            raise Rejected(replace(c, place=c.place or place) for c in error.complaints) from None
        sheet = {"pdf": drawn.pdf, "svg": drawn.svg}
        if file:
            _keep(file, key, sheet)
    return sheet


def _scene(drawing: Any, values: Mapping[Symbol, float], notation: Notation, width: float | None, alt: str) -> Sheet:
    from derive.render.drawing.canvas import sheet_of
    from derive.render.drawing.picture import picture

    pieces = picture(drawing, Numbers(values), width or WIDTH, (width or WIDTH) * HEIGHT / WIDTH)
    return sheet_of(pieces, notation, alt)


def _plot(plot: Any, curves: Curves, notation: Notation, words: Phrases, width: float | None, alt: str) -> Sheet:
    from derive.render.drawing.plotting import plot_sheet

    return plot_sheet(plot, curves, notation, words, width, alt)


def numbers_of(problem: Problem, placement: Placement | None) -> dict[Symbol, float]:
    """What each letter is while it is drawn: as the problem says of this drawing, its own number, or a stand-in."""
    said = dict(placement.values) if placement else {}
    fixed = {letter: expr for letter, expr in said.items() if not expr.free_symbols}
    own = {letter: explicit(amount) for letter, amount in problem.amounts.items() if letter not in said}
    letters = [(declared.symbol, declared.kind) for declared in problem.symbols.values()]
    found = stand_ins(letters, {**own, **fixed})
    for letter, expr in said.items():
        found[letter] = Numbers(found).of(expr)
    return found


# --- kept between builds ---------------------------------------------------------------------------------------------


def _key(drawing: Recorded, facts: str) -> str:
    modules = [p.read_bytes() for p in sorted(FOLDER.rglob("*.py"))]
    description = json.dumps(drawings_to_data([drawing]))
    return digest(*modules, f"{package_version('matplotlib')}", description, facts)


def _recalled(file: Path, key: str) -> dict[str, bytes] | None:
    """What was kept under this key; nothing if it was kept under another, was altered, or cannot be read."""
    kept = sealed.recalled(file, key)
    if not isinstance(kept, dict) or set(kept) != {"pdf", "svg"}:
        return None
    try:
        return {suffix: base64.b64decode(text) for suffix, text in kept.items()}
    except (ValueError, TypeError):
        return None


def _keep(file: Path, key: str, sheet: Mapping[str, bytes]) -> None:
    sealed.keep(file, key, {suffix: base64.b64encode(content).decode() for suffix, content in sheet.items()})
