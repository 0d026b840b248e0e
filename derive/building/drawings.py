"""The drawings of a page as files; a stored drawing is used as long as nothing on which it depends has changed."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from sympy import Float, Symbol

from derive.algebra.expressions import Relation, explicit
from derive.building.cache import Cache, digest, engine_digest
from derive.building.own_figures import own_files
from derive.course.placement import STATEMENT, Placement
from derive.course.problem import Problem
from derive.errors import Rejected
from derive.figures.encoding import drawings_to_data
from derive.figures.marks import Drawing, Plot, Recorded
from derive.page.depiction import placement_of
from derive.page.plots import Curves, curves_of
from derive.page.tree import Document, Illustration
from derive.page.wording import Phrases
from derive.render.drawing.camera import Numbers, stand_ins, with_coordinates
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.render.rendered import Files
from derive.steps.signs import SIGNS_OF

if TYPE_CHECKING:
    from derive.render.drawing.lettering import Lettered
    from derive.render.drawing.sheets import Sheet

SUFFIXES = ("pdf", "svg")
POINTS_PER_CM = 72 / 2.54
WIDTH, HEIGHT = 5.0, 4.2  # centimetres, without labels
BESIDE_STATEMENT = 0.74  # the height of a drawing next to the statement, divided by the usual height
WIDE, LOW = 7.0, 0.4  # a drawing gets the width WIDE if, at the width WIDTH, its height is at most LOW times its width
# A drawing without a given width is made larger if its labels are crowded. Labels are crowded if the greatest cost of
# the position of a label is more than CROWDED. They are also crowded if there are at least MANY of them, and more than
# DENSE per square centimetre. The larger drawing is kept unless its greatest cost is more than that of the smaller
# drawing plus SLIGHT.
CROWDED, MANY, DENSE, SLIGHT = 5.5, 7, 0.45, 3.0
EXACT = 1e-9  # a number with a smaller absolute value counts as zero
# the widths for the drawing of a normal mode of at most FEW masses; the second is for low drawings
OF_MODES, FEW = (3.6, 4.7), 4


def drawing_files(
    problem: Problem,
    drawings: Sequence[Recorded],
    document: Document,
    words: Phrases,
    notation: Notation,
    cache: Cache,
) -> Files:
    """Return a PDF and an SVG of each drawing on the page and of the figure of the author, by file name."""
    by_key = {drawing.key: drawing for drawing in drawings}

    def both(shown: Illustration) -> tuple[bytes, bytes]:
        if problem.figure and shown.key == problem.figure.key:
            return own_files(problem.figure, inline_text(shown.alt, notation), cache)
        return _files(problem, by_key[shown.key], shown, words, notation, cache)

    return tuple(
        (f"{shown.stem}.{suffix}", content)
        for shown in document.illustrations
        for suffix, content in zip(SUFFIXES, both(shown), strict=True)
    )


def _files(
    problem: Problem, drawing: Recorded, shown: Illustration, words: Phrases, notation: Notation, cache: Cache
) -> tuple[bytes, bytes]:
    """Return the stored PDF and SVG, or draw them now."""
    placement = placement_of(problem, drawing.key)
    width = placement.width if placement else None
    if isinstance(drawing, Drawing) and placement is not None and placement.view is not None:
        drawing = replace(drawing, seen_from=placement.view)
    alt = inline_text(shown.alt, notation)
    data = json.dumps(drawings_to_data([drawing]))
    known: Any
    told: Any
    if isinstance(drawing, Plot):
        known = curves_of(problem, drawing, placement)
        told = known, words.drawings
    else:
        known = numbers_of(problem, placement, drawing)
        told = sorted(_within(data, known))
    shape = HEIGHT / WIDTH * (BESIDE_STATEMENT if shown.at == STATEMENT and width is None else 1.0)
    language = sorted(notation.language.items())
    seen = data, told, _within(data, notation.known_dimensions), width, shape, alt, language
    key = digest("drawing", engine_digest("matplotlib"), repr(seen))
    svg, zero, pdf = (cache.get(key) or b"").partition(b"\0")
    if not zero:
        try:
            on_paper, on_screen = _drawn(drawing, known, notation, words, (width, shape), alt, cache)
        except Rejected as error:  # the error of a mark does not name a place in the file
            place = placement.place if placement else problem.place_of("solve")
            raise Rejected(replace(c, place=c.place or place) for c in error.complaints) from None
        pdf, svg = on_paper.pdf, on_screen.svg
        cache.keep(key, svg + b"\0" + pdf)
    return pdf, svg


def _within(data: str, known: Mapping[Any, Any]) -> list[tuple[str, Any]]:
    """Return the entries of `known` for the symbols in a drawing; other symbols must not change its digest."""
    return [
        (str(letter), of_it) for letter, of_it in known.items() if f'["Symbol", {json.dumps(str(letter))}, ' in data
    ]


def _drawn(
    what: Any,
    seen: Mapping[Symbol, float] | Curves,
    notation: Notation,
    words: Phrases,
    size: tuple[float | None, float],
    alt: str,
    cache: Cache,
) -> tuple[Sheet, Sheet]:
    """Return the drawing twice: for a PDF, and for a browser. The fonts differ.

    size   the width (None if it is not given), and the height divided by the width
    """
    width, shape = size
    from derive.render.drawing.lettering import PAPER, SCREEN

    on_paper, on_screen = (partial(_letters, cache, font) for font in (PAPER, SCREEN))
    if isinstance(seen, Curves):
        from derive.render.drawing.plotting import plot_sheet

        plotted = partial(plot_sheet, what, seen, notation, width, alt)
        return plotted(on_paper), plotted(on_screen)
    from derive.render.drawing.canvas import sheet_of
    from derive.render.drawing.picture import picture

    sizes = (width,) if width else (WIDTH, WIDE)
    if width and what.body_size is not None:  # the width that the author gives determines the size of the body
        what = replace(what, body_size=None)
    if what.mode is not None and not width and len(what.mode.moves) <= FEW:
        sizes = OF_MODES
    made = []
    for wide in sizes:
        pieces = picture(what, Numbers(seen), wide, (width or WIDTH) * shape)
        made.append((sheet_of(pieces, notation, alt, on_paper), pieces))
        if made[-1][0].height > LOW * made[-1][0].width:
            break
    sheet, pieces = made[-1]
    if not width and len(made) == 1 and what.mode is None and _is_crowded(sheet):
        pieces = picture(what, Numbers(seen), WIDE, WIDE * shape)
        larger = sheet_of(pieces, notation, alt, on_paper)
        sheet, pieces = (larger, pieces) if larger.crowding <= sheet.crowding + SLIGHT else made[0]
    return sheet, sheet_of(pieces, notation, alt, on_screen)


def _is_crowded(sheet: Sheet) -> bool:
    area = sheet.width * sheet.height / POINTS_PER_CM**2
    return sheet.crowding > CROWDED or sheet.labels >= MANY and sheet.labels / area > DENSE


def _letters(cache: Cache, font: str, texts: Collection[str]) -> Mapping[str, Lettered]:
    keys = {text: digest("letters", engine_digest("matplotlib"), font, text) for text in texts}
    known = {text: kept for text, key in keys.items() if (kept := cache.get_data(key)) is not None}
    if new := keys.keys() - known:
        from derive.render.drawing.lettering import letters_of

        known |= letters_of(new, font)
        for text in new:
            cache.keep_data(keys[text], known[text])
    return known


def _as_assumed(problem: Problem, found: dict[Symbol, float], given: Collection[Symbol]) -> dict[Symbol, float]:
    """Return the numbers. If they violate an assumed relation, change numbers of symbols that have no given value, so
    that the relations hold."""
    relations = [each.relation for each in problem.assumed]
    if all(_holds(each, found) for each in relations):
        return found

    def fits(letter: Any, number: Any) -> bool:
        known = problem.ranges.get(letter)
        return bool(known.holds(number) if known else number.is_positive or not letter.is_positive)

    numbers = {letter: Float(number) for letter, number in found.items()}
    changed = {letter: float(number) for letter, number in problem.order.at(numbers, fits).items()}
    return changed | {letter: number for letter, number in found.items() if letter in given}


def _holds(relation: Relation, numbers: Mapping[Symbol, float]) -> bool:
    value = explicit(relation.residual).subs(numbers).evalf()
    if not value.is_Float and not value.is_zero:
        return True  # the relation contains a coordinate
    return (0 if abs(value) < EXACT else 1 if value > 0 else -1) in SIGNS_OF[relation.operator]


def numbers_of(problem: Problem, placement: Placement | None, drawing: Recorded | None = None) -> dict[Symbol, float]:
    """Return a number for each symbol of a problem and of a drawing. This is the number that the drawing specifies,
    else the given value, else a number that is chosen here."""
    said = dict(placement.values) if placement else {}
    if isinstance(drawing, Drawing) and drawing.mode is not None:
        sketch = placement_of(problem, drawing.mode.like)
        coordinates = dict(drawing.coordinates)
        said = {s: e for s, e in (sketch.values if sketch else ()) if s not in coordinates} | said
    fixed = {letter: expr for letter, expr in said.items() if not expr.free_symbols}
    own = {letter: explicit(amount) for letter, amount in problem.amounts.items() if letter not in said}
    letters = [(declared.symbol, declared.kind) for declared in problem.symbols.values()]
    found = _as_assumed(problem, stand_ins(letters, {**own, **fixed}), {*own, *fixed})
    if isinstance(drawing, Drawing):
        free = {letter for letter, _ in (*drawing.coordinates, *drawing.values)} - {*own, *fixed}
        sizes = [found[letter] for letter, kind in letters if kind == "length" and letter not in free]
        known = {letter: number for letter, number in found.items() if letter not in free}
        found = with_coordinates(drawing, known, sum(sizes) / len(sizes) if sizes else 1.0)
    for letter, expr in said.items():
        found[letter] = Numbers(found).of(expr)
    return found
