"""The pieces of a drawing as shapes on a sheet: lines with their pens and arrowheads, and labels."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import atan2, cos, hypot, sin
from typing import Any

from derive.figures.pieces import Bullet, Patch, Piece, Stroke, Tag
from derive.figures.space import Spot
from derive.render.drawing.labels import Placed, placed
from derive.render.drawing.lettering import Lettered, Letters, letters_of
from derive.render.drawing.mathtext import Span, runs
from derive.render.drawing.sheets import (
    Contour,
    Extent,
    Shape,
    Sheet,
    circle,
    contour_through,
    extent_of,
    moved,
    sheet_of_shapes,
)
from derive.render.notation.notation import Notation

INK, QUIET, LINE, BLANK = "#1F3A5F", "#5B6370", "#22252A", "#FFFFFF"
MARGIN = 2.0
BOLD = 0.45  # the width of the outline that makes a letter bold


@dataclass(frozen=True)
class Pen:
    """A kind of line: its colour, its width, its dashes and gaps in units of the width, and the length of its
    arrowheads."""

    colour: str
    width: float
    dashes: tuple[float, ...] = ()
    head: float = 5.0


PENS = {
    "edge": Pen(LINE, 0.7),
    "rod": Pen(LINE, 2.4),
    "bar": Pen(LINE, 1.3),
    "string": Pen(LINE, 0.6),
    "spring": Pen(LINE, 0.75),
    "ground": Pen(LINE, 0.9),
    "hatch": Pen(QUIET, 0.45),
    "trace": Pen(QUIET, 0.55, (4, 2.5)),
    "wire": Pen(QUIET, 0.9),
    "hidden": Pen(QUIET, 0.5, (3, 2)),
    "construction": Pen(QUIET, 0.65, (7, 2, 1, 2)),
    "thin": Pen(QUIET, 0.4),
    "axis": Pen(QUIET, 0.55, head=4.5),
    "measure": Pen(QUIET, 0.5, head=4.0),
    "given": Pen(LINE, 1.0, head=6.0),
    "asked": Pen(INK, 1.3, head=7.0),
    "angle": Pen(INK, 0.7),
    "turn": Pen(INK, 0.8, head=5.0),
    "curve": Pen(INK, 1.1, head=7.0),
    "dashed_curve": Pen(INK, 1.1, (5, 2.5), head=7.0),
    "dotted_curve": Pen(INK, 1.3, (1.2, 1.6), head=7.0),
    "chained_curve": Pen(INK, 1.1, (7, 2, 1.2, 2), head=7.0),
    "level": Pen(INK, 0.8, head=6.0),
    "separatrix": Pen(INK, 1.6, head=8.0),
    "frame": Pen(QUIET, 0.5),
    "tick": Pen(QUIET, 0.4),
}
FILLS = {"blank": BLANK, "body": "#DFE5EC", "solid": "#EFF2F6", "line": LINE, "ink": INK}


def sheet_of(pieces: Sequence[Piece], notation: Notation, alt: str, letters: Letters = letters_of) -> Sheet:
    """Return a sheet that fits the pieces with their labels."""
    labels = _labels(pieces, notation, letters)
    stand = placed(pieces, lambda label: labels[label].size, _width)
    shapes = shapes_of(pieces) + [shape for each in stand for shape in labels[each.label].shapes_at(each.corner)]
    spots = [spot for piece in pieces if not isinstance(piece, Tag) for spot in _reached(piece)]
    spots += [spot for each in stand for spot in (each.extent[:2], each.extent[2:])]
    crowding = max((each.cost for each in stand), default=0.0)
    return replace(sheet_of_shapes(shapes, with_margin(extent_of(spots)), alt), crowding=crowding, labels=len(stand))


def labels_of(pieces: Sequence[Piece], notation: Notation, letters: Letters = letters_of) -> list[Placed]:
    """Return the positions of the labels of a drawing on its sheet."""
    labels = _labels(pieces, notation, letters)
    return placed(pieces, lambda label: labels[label].size, _width)


def _width(stroke: Stroke) -> float:
    return PENS[stroke.pen].width


def _labels(pieces: Sequence[Piece], notation: Notation, letters: Letters) -> dict[Any, _Label]:
    names = {piece.label: _runs(piece.label, notation) for piece in pieces if isinstance(piece, Tag)}
    known = letters({run.text for each in names.values() for run in each})
    return {label: _label([(known[run.text], run.bold) for run in each]) for label, each in names.items()}


def with_margin(extent: Extent) -> Extent:
    left, below, right, above = extent
    return left - MARGIN, below - MARGIN, right + MARGIN, above + MARGIN


def _reached(piece: Piece) -> Iterable[Spot]:
    """Return points with the same bounding box as the piece."""
    if not isinstance(piece, Bullet):
        return piece.spots
    (x, y), size = piece.spot, piece.size
    return (x - size, y - size), (x + size, y + size)


# --- labels ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Label:
    contours: tuple[tuple[Contour, Spot, bool], ...]
    size: tuple[float, float]

    def shapes_at(self, corner: Spot) -> list[Shape]:
        return [
            Shape(moved(contour, (corner[0] + x, corner[1] + y)), LINE, *((LINE, BOLD) if bold else ()))
            for contour, (x, y), bold in self.contours
        ]


def _label(parts: Sequence[tuple[Lettered, bool]]) -> _Label:
    """Place the runs of a label side by side."""
    beside: list[tuple[Contour, float, bool]] = []
    corners: list[Spot] = []
    x = 0.0
    for (contour, (left, below, right, above)), bold in parts:
        beside.append((contour, x, bold))
        corners += [(x + left, below), (x + right, above)]
        x += right + (BOLD if bold else 0)
    left, below, right, above = extent_of(corners)
    size = right - left, above - below
    return _Label(tuple((each, (x - left, -below), bold) for each, x, bold in beside), size)


def _runs(label: Any, notation: Notation) -> tuple[Span, ...]:
    if isinstance(label, tuple):
        parts = (span.text.strip("$") for each in label for span in _runs(each, notation))
        return (Span(f"${''.join(parts)}$"),)
    if isinstance(label, str):
        spaced = label.replace(" ", "\\;")  # mathtext ignores plain spaces
        return (Span(rf"$\mathrm{{{spaced}}}$"),)
    return runs(notation.result(label), inline=True)


# --- lines -----------------------------------------------------------------------------------------------------------


def shapes_of(pieces: Sequence[Piece]) -> list[Shape]:
    found: list[Shape] = []
    for piece in pieces:
        match piece:
            case Patch():
                found.append(Shape(contour_through(piece.spots, closed=True), FILLS[piece.fill]))
            case Stroke():
                found += _stroke(piece)
            case Bullet():
                found.append(Shape(circle(piece.spot, piece.size), FILLS[piece.fill]))
    return found


def _stroke(stroke: Stroke) -> list[Shape]:
    """Return a line, shortened where its arrowheads are, and the arrowheads."""
    pen = PENS[stroke.pen]
    spots = list(stroke.spots)
    heads = []
    if stroke.head:
        spots, head = _headed(spots, pen)
        heads.append(head)
    if stroke.tail:
        spots, head = _headed(spots[::-1], pen)
        heads.append(head)
    line = Shape(contour_through(spots), "", pen.colour, pen.width, tuple(pen.width * part for part in pen.dashes))
    return [line, *(Shape(head, pen.colour) for head in heads)]


def _headed(spots: list[Spot], pen: Pen) -> tuple[list[Spot], Contour]:
    tip = spots[-1]
    kept = [spot for spot in spots[:-1] if hypot(tip[0] - spot[0], tip[1] - spot[1]) > 0.8 * pen.head] or spots[:1]
    angle = atan2(tip[1] - kept[-1][1], tip[0] - kept[-1][0])
    back = [(-pen.head, 0.32 * pen.head), (-0.8 * pen.head, 0.0), (-pen.head, -0.32 * pen.head)]
    corners = [(tip[0] + x * cos(angle) - y * sin(angle), tip[1] + x * sin(angle) + y * cos(angle)) for x, y in back]
    return [*kept, corners[1]], contour_through([tip, *corners], closed=True)
