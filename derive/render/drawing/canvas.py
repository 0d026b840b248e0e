"""A picture as files: matplotlib writes them as a PDF for TeX and an SVG for other pages, always the same bytes.

Lengths are in points and the canvas is as large as what is on it, so that a drawing is included at its own size and its
letters are those of the page. Letters are paths: no font is needed where a drawing is shown.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from math import atan2, cos, hypot, sin
from typing import Any
from xml.sax.saxutils import escape

import matplotlib
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.textpath import TextPath
from matplotlib.transforms import Affine2D

from derive.figures.pieces import Bullet, Patch, Piece, Stroke, Tag
from derive.figures.space import Spot
from derive.render.drawing.labels import Placed, placed
from derive.render.drawing.mathtext import Span, runs
from derive.render.notation.notation import Notation

INK, QUIET, LINE, BLANK = "#1F3A5F", "#5B6370", "#22252A", "#FFFFFF"
MARGIN = 2.0
LETTERS = 10.0  # the size of labels, in points
BOLD = 0.45  # the outline that makes a letter bold


@dataclass(frozen=True)
class Pen:
    """A kind of line: its colour, width and dashes."""

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
    "construction": Pen(QUIET, 0.5, (7, 2, 1, 2)),
    "thin": Pen(QUIET, 0.4),
    "axis": Pen(QUIET, 0.55, head=4.5),
    "measure": Pen(QUIET, 0.5, head=4.0),
    "given": Pen(LINE, 1.0, head=6.0),
    "asked": Pen(INK, 1.3, head=7.0),
    "angle": Pen(INK, 0.7),
    "turn": Pen(INK, 0.8, head=5.0),
}
FILLS = {"blank": BLANK, "body": "#DFE5EC", "line": LINE, "ink": INK}
SETTINGS: Any = {
    "mathtext.fontset": "cm",
    "svg.hashsalt": "derive",
    "svg.fonttype": "path",
    "pdf.compression": 6,
    "axes.unicode_minus": False,
    "path.simplify": False,
}


@dataclass(frozen=True)
class Sheet:
    """A finished figure in both formats, and how large it is in points."""

    pdf: bytes
    svg: bytes
    width: float
    height: float


def sheet_of(pieces: Sequence[Piece], notation: Notation, alt: str) -> Sheet:
    """The pieces with their labels on a canvas of their size."""
    with our_settings():
        letters = _Letters(notation)
        labels = placed(pieces, letters.size)
        left, below, right, above = _bounds(pieces, labels)
        width, height = right - left, above - below
        figure = Figure(figsize=(width / 72, height / 72), facecolor="none")
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        axes.set_xlim(left, right)
        axes.set_ylim(below, above)
        for order, patch in enumerate(_patches(pieces, labels, letters)):
            patch.set_zorder(order)
            patch.set_clip_on(False)
            axes.add_patch(patch)
        return finished(figure, alt, width, height)


@contextmanager
def our_settings(**more: Any) -> Iterator[None]:
    """matplotlib as it comes, with our settings: those of whoever builds the page must not show on it."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        settings: Any = {**SETTINGS, **more}
        matplotlib.rcParams.update(settings)
        yield


def finished(figure: Figure, alt: str, width: float, height: float) -> Sheet:
    """Both files, without dates or names of programs; the SVG says in words what it shows."""
    pdf, svg = io.BytesIO(), io.BytesIO()
    nobody: Any = {"Creator": None}
    figure.savefig(pdf, format="pdf", metadata={**nobody, "CreationDate": None, "Producer": None})
    figure.savefig(svg, format="svg", metadata={**nobody, "Date": None, "Format": None, "Type": None})
    return Sheet(pdf.getvalue(), _with_words(svg.getvalue().decode(), alt).encode(), width, height)


def _with_words(svg: str, alt: str) -> str:
    at = svg.index(">", svg.index("<svg ")) + 1
    return f'{svg[: at - 1]} role="img">\n <title>{escape(alt)}</title>{svg[at:]}'


def _bounds(pieces: Sequence[Piece], labels: Sequence[Placed]) -> tuple[float, float, float, float]:
    spots = [spot for piece in pieces if not isinstance(piece, Tag) for spot in piece.spots]
    discs = [piece for piece in pieces if isinstance(piece, Bullet)]
    spots += [(disc.spot[0] + s * disc.size, disc.spot[1] + s * disc.size) for disc in discs for s in (-1, 1)]
    spots += [spot for label in labels for spot in (label.extent[:2], label.extent[2:])]
    left, right = (choice(spot[0] for spot in spots) for choice in (min, max))
    below, above = (choice(spot[1] for spot in spots) for choice in (min, max))
    return left - MARGIN, below - MARGIN, right + MARGIN, above + MARGIN


# --- letters ---------------------------------------------------------------------------------------------------------


class _Letters:
    """Labels as paths, in the notation of the page."""

    def __init__(self, notation: Notation):
        self._notation = notation
        self._known: dict[Any, tuple[list[tuple[Path, bool]], float, float]] = {}

    def size(self, label: Any) -> tuple[float, float]:
        _, width, height = self._of(label)
        return width, height

    def patches(self, label: Placed) -> list[PathPatch]:
        move = Affine2D().translate(*label.corner)
        return [
            PathPatch(path.transformed(move), facecolor=LINE, edgecolor=LINE, linewidth=BOLD if bold else 0)
            for path, bold in self._of(label.label)[0]
        ]

    def _of(self, label: Any) -> tuple[list[tuple[Path, bool]], float, float]:
        """The runs side by side, moved so that their box begins at the origin."""
        if label not in self._known:
            paths: list[tuple[Path, bool]] = []
            x = 0.0
            for run in _runs(label, self._notation):
                path, advance = _path(run)
                paths.append((path.transformed(Affine2D().translate(x, 0)), run.bold))
                x += advance + (BOLD if run.bold else 0)
            extents = [path.get_extents() for path, _ in paths]
            left, right = min(e.x0 for e in extents), max(e.x1 for e in extents)
            below, above = min(e.y0 for e in extents), max(e.y1 for e in extents)
            move = Affine2D().translate(-left, -below)
            self._known[label] = ([(p.transformed(move), bold) for p, bold in paths], right - left, above - below)
        return self._known[label]


def _runs(label: Any, notation: Notation) -> tuple[Span, ...]:
    """A label is a name or an expression, or a word that is printed as it is."""
    return (Span(rf"$\mathrm{{{label}}}$"),) if isinstance(label, str) else runs(notation.result(label))


@cache
def _path(run: Span) -> tuple[Path, float]:
    path = TextPath((0, 0), run.text, size=LETTERS, prop=FontProperties())
    return path, path.get_extents().x1


# --- lines -----------------------------------------------------------------------------------------------------------


def _patches(pieces: Sequence[Piece], labels: Sequence[Placed], letters: _Letters) -> list[PathPatch]:
    found: list[PathPatch] = []
    for piece in pieces:
        match piece:
            case Patch():
                path = Path([*piece.spots, piece.spots[0]], closed=True)
                found.append(PathPatch(path, facecolor=FILLS[piece.fill], linewidth=0))
            case Stroke():
                found += _stroke(piece)
            case Bullet():
                circle = Path.unit_circle().transformed(Affine2D().scale(piece.size).translate(*piece.spot))
                found.append(PathPatch(circle, facecolor=FILLS[piece.fill], linewidth=0))
    return found + [patch for label in labels for patch in letters.patches(label)]


def _stroke(stroke: Stroke) -> list[PathPatch]:
    """The line, shortened under its heads, and the heads."""
    pen = PENS[stroke.pen]
    spots = list(stroke.spots)
    heads = []
    if stroke.head:
        spots, head = _headed(spots, pen)
        heads.append(head)
    if stroke.tail:
        spots, head = _headed(spots[::-1], pen)
        heads.append(head)
    dashes = (0, tuple(pen.dashes)) if pen.dashes else "solid"
    line = PathPatch(
        Path(spots), fill=False, edgecolor=pen.colour, linewidth=pen.width, linestyle=dashes, capstyle="butt",
        joinstyle="round",
    )  # fmt: skip
    return [line, *(PathPatch(head, facecolor=pen.colour, linewidth=0) for head in heads)]


def _headed(spots: list[Spot], pen: Pen) -> tuple[list[Spot], Path]:
    """A pointed head at the last spot, along the chord over its length, and the line up to its base."""
    tip = spots[-1]
    kept = [spot for spot in spots[:-1] if hypot(tip[0] - spot[0], tip[1] - spot[1]) > 0.8 * pen.head] or spots[:1]
    angle = atan2(tip[1] - kept[-1][1], tip[0] - kept[-1][0])
    back = [(-pen.head, 0.32 * pen.head), (-0.8 * pen.head, 0.0), (-pen.head, -0.32 * pen.head)]
    corners = [(tip[0] + x * cos(angle) - y * sin(angle), tip[1] + x * sin(angle) + y * cos(angle)) for x, y in back]
    return [*kept, corners[1]], Path([tip, *corners, tip], closed=True)
