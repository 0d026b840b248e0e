"""The figure of an author as the two files that every drawing has: a PDF for paper and an SVG for browsers.

Typst, an optional package, converts the file. In the SVG the figure is an embedded image, so that its styles and names
do not affect the page and the browser runs none of its scripts.
"""

from __future__ import annotations

import re
from functools import partial
from html import escape
from importlib import import_module
from pathlib import Path

from derive.building.cache import Cache, digest
from derive.building.scratch import Scratch
from derive.course.own_figure import OwnFigure
from derive.errors import Complaint, Misused, Rejected

WIDEST, HIGHEST = 15.0, 18.0  # centimetres
LARGEST = 3000.0  # points
POINTS_PER_CM = 72 / 2.54
INSTALL = "install the converter of figures: `pip install 'derive-mechanics[figures]'`"
_SIZE = re.compile(rb'<svg [^>]*?\bwidth="([\d.]+)pt" height="([\d.]+)pt"')


def own_files(figure: OwnFigure, alt: str, cache: Cache) -> tuple[bytes, bytes]:
    """Return the PDF and the SVG of a figure."""
    key = digest("figure", figure.kind, figure.content, str(figure.width), alt)
    svg, zero, pdf = (cache.get(key) or b"").partition(b"\0")
    if not zero:
        pdf, svg = _converted(figure, alt)
        cache.keep(key, svg + b"\0" + pdf)
    return pdf, svg


def _converted(figure: OwnFigure, alt: str) -> tuple[bytes, bytes]:
    with Scratch() as folder:
        (Path(folder) / f"figure.{figure.kind}").write_bytes(figure.content)
        page = partial(_page, figure, Path(folder))
        size = _SIZE.search(page("svg", None))
        width, height = (float(each) for each in size.groups()) if size else (0.0, 0.0)
        if not 0 < width <= LARGEST or not 0 < height <= LARGEST:
            measured = f"`{figure.path}` measures {width:.0f} by {height:.0f} points"
            message = f"{measured}; both numbers must be positive and at most {LARGEST:.0f}"
            raise Rejected(Complaint("figure", message, figure.place, help="change the size of the figure"))
        wide = figure.width or min(width / POINTS_PER_CM, WIDEST, HIGHEST * width / height)
        if wide * height / width > HIGHEST * 1.001:
            message = f"with this width the figure is {wide * height / width:.1f} cm high; at most {HIGHEST:g} cm fit"
            raise Rejected(Complaint("figure", message, figure.place, help="make `width` smaller, or leave it out"))
        head, end, rest = page("svg", wide).replace(b"<svg ", b'<svg role="img" ', 1).partition(b">")
        return page("pdf", wide), head + end + f"<title>{escape(alt)}</title>".encode() + rest


def _page(figure: OwnFigure, folder: Path, form: str, width: float | None) -> bytes:
    try:
        typst = import_module("typst")
    except ImportError:
        message = f"`{figure.path}` needs a converter"
        raise Misused(Complaint("figure", message, figure.place, help=INSTALL)) from None
    wide = f"{width:.4f}cm" if width else "auto"
    (folder / "page.typ").write_text(
        "#set page(width: auto, height: auto, margin: 0pt, fill: none)\n#set document(date: none)\n"
        f'#image("figure.{figure.kind}", width: {wide})\n',
        encoding="utf-8",
    )
    try:
        return bytes(typst.compile(folder / "page.typ", root=folder, format=form, timestamp=0))
    except Exception as error:
        message = f"`{figure.path}` cannot be read: {str(error).splitlines()[0][:200]}"
        help_line = f"save the figure again as {figure.kind.upper()}"
        raise Rejected(Complaint("figure", message, figure.place, help=help_line)) from None
