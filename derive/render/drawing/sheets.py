"""Shapes on paper as files, a PDF for TeX and an SVG for other pages; the same shapes always give the same bytes.

Lengths are in points, and the sheet is as large as its contents. So a page includes a drawing at its natural size, and
the letters of drawing and page match. Letters are shapes like everything else: no font is needed to show a drawing.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from html import escape
from typing import TypeAlias
from zlib import compress

from derive.figures.space import Spot

Contour: TypeAlias = Sequence[tuple[str, Sequence[Spot]]]  # M, L, C and Z with their points, as in SVG
Extent: TypeAlias = tuple[float, float, float, float]  # left, below, right, above

OPERATORS = {"M": "m", "L": "l", "C": "c", "Z": "h"}
ROUND = 0.5522847  # length of the Bézier handles of a quarter circle, in units of its radius


@dataclass(frozen=True)
class Shape:
    """A contour that is filled with a colour, or drawn as a line, or both (bold letters)."""

    contour: Contour
    fill: str = ""
    line: str = ""
    width: float = 0.0
    dashes: tuple[float, ...] = ()


@dataclass(frozen=True)
class Sheet:
    """A finished figure as PDF and as SVG, and its size in points.

    crowding   the greatest cost of the position of a label: see `derive.render.drawing.labels`
    labels     the number of labels
    """

    pdf: bytes
    svg: bytes
    width: float
    height: float
    crowding: float = 0.0
    labels: int = 0


def contour_through(spots: Sequence[Spot], closed: bool = False) -> Contour:
    """Return the contour of straight lines from point to point."""
    lines = [("M" if i == 0 else "L", (spot,)) for i, spot in enumerate(spots)]
    return [*lines, ("Z", ())] if closed else lines


def circle(middle: Spot, radius: float) -> Contour:
    """Return a circle as four Bézier curves."""
    x, y = middle
    ways = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 0.0)]
    spots = [(x + radius * u, y + radius * v) for u, v in ways]
    handles = [(radius * ROUND * u, radius * ROUND * v) for u, v in ways]
    found: list[tuple[str, Sequence[Spot]]] = [("M", spots[:1])]
    for (a, b), (c, d), (p, q), (r, s) in zip(spots, spots[1:], handles, handles[1:], strict=False):
        found.append(("C", ((a + r, b + s), (c + p, d + q), (c, d))))
    return [*found, ("Z", ())]


def moved(contour: Contour, to: Spot, scale: float = 1.0) -> Contour:
    x, y = to
    return [(letter, [(x + scale * u, y + scale * v) for u, v in spots]) for letter, spots in contour]


def turned(contour: Contour) -> Contour:
    """Rotate a contour by 90 degrees counterclockwise."""
    return [(letter, [(-v, u) for u, v in spots]) for letter, spots in contour]


def extent_of(spots: Collection[Spot]) -> Extent:
    """Return the leftmost, lowest, rightmost and highest coordinates of the points."""
    xs, ys = ([spot[k] for spot in spots] for k in (0, 1))
    return min(xs), min(ys), max(xs), max(ys)


def sheet_of_shapes(shapes: Sequence[Shape], extent: Extent, alt: str) -> Sheet:
    """Return the PDF and the SVG; the SVG contains the alternative text."""
    left, below, right, above = extent
    written = [(shape, [(at, *(map(_pair, spots))) for at, spots in shape.contour]) for shape in shapes]
    pdf = "\n".join(["1 j", f"1 0 0 1 {_number(-left)} {_number(-below)} cm", *(_painted(*each) for each in written)])
    svg = "\n".join(_path(*each) for each in written)
    size = _number(right - left), _number(above - below)
    return Sheet(_pdf(pdf, *size), _svg(svg, *size, (left, above), alt), right - left, above - below)


Written: TypeAlias = list[tuple[str, ...]]  # for each segment of a contour, its letter and its coordinates as text


def _number(x: float) -> str:
    return f"{x:.3f}".rstrip("0").rstrip(".")


def _pair(spot: Spot) -> str:
    return f"{_number(spot[0])} {_number(spot[1])}"


# --- SVG -------------------------------------------------------------------------------------------------------------


def _path(shape: Shape, written: Written) -> str:
    along = "".join(letter + " ".join(spots) for letter, *spots in written)
    line = f' stroke="{shape.line}" stroke-width="{_number(shape.width)}"' if shape.line else ""
    dashes = f' stroke-dasharray="{" ".join(map(_number, shape.dashes))}"' if shape.dashes else ""
    return f'<path d="{along}" fill="{shape.fill or "none"}"{line}{dashes}/>'


def _svg(paths: str, width: str, height: str, corner: Spot, alt: str) -> bytes:
    """Return the SVG; its origin is the upper left corner, and y increases downwards."""
    x, y = (_number(at) for at in (-corner[0], corner[1]))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}pt" height="{height}pt" '
        f'viewBox="0 0 {width} {height}" role="img">\n<title>{escape(alt, quote=False)}</title>\n'
        f'<g transform="matrix(1 0 0 -1 {x} {y})" stroke-linejoin="round">\n{paths}\n</g>\n</svg>\n'
    ).encode()


# --- PDF -------------------------------------------------------------------------------------------------------------


def _painted(shape: Shape, written: Written) -> str:
    pens = [f"{_rgb(shape.fill)} rg"] if shape.fill else []
    if shape.line:
        pens.append(f"{_rgb(shape.line)} RG {_number(shape.width)} w [{' '.join(map(_number, shape.dashes))}] 0 d")
    along = [" ".join([*spots, OPERATORS[letter]]) for letter, *spots in written]
    return "\n".join([*pens, *along, "B" if shape.fill and shape.line else "f" if shape.fill else "S"])


def _rgb(colour: str) -> str:
    return " ".join(_number(int(colour[i : i + 2], 16) / 255) for i in (1, 3, 5))


def _pdf(content: str, width: str, height: str) -> bytes:
    stream = compress(content.encode())
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        f"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width} {height}] /Resources << >> /Contents 4 0 R >>".encode(),
        b"<< /Length %d /Filter /FlateDecode >>\nstream\n%s\nendstream" % (len(stream), stream),
    ]
    file, starts = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n", []
    for number, each in enumerate(objects, 1):
        starts.append(len(file))
        file += b"%d 0 obj\n%s\nendobj\n" % (number, each)
    table = b"".join(b"%010d 00000 n \n" % start for start in starts)
    size, start = len(objects) + 1, len(file)
    file += b"xref\n0 %d\n0000000000 65535 f \n%s" % (size, table)
    return file + b"trailer\n<< /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (size, start)
