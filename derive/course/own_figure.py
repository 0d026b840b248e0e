"""A figure that the author supplies: the key `figure:` of a problem names a PDF, SVG or PNG file of the course.

Another program made the file, so its place, size and format are checked. The private data of drawing programs are
removed from an SVG. An SVG is rejected if it has a script, a reference to another file, or an element that a plain
drawing does not need.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from derive.course.names import NAME
from derive.course.placement import Placement, width_of
from derive.course.problem_file import FigureKeys
from derive.course.prose import Prose
from derive.course.yaml_tree import Word
from derive.errors import Faults, Place

LARGEST = 2_000_000  # bytes
MOST_PIXELS = 16_000_000
KINDS = ("pdf", "svg", "png")
_BEGINS = {"pdf": b"%PDF-", "png": b"\x89PNG\r\n\x1a\n"}
_SVG = "http://www.w3.org/2000/svg"
_EMPTY = f'<svg xmlns="{_SVG}" width="1" height="1"/>'.encode()
_XLINK = "http://www.w3.org/1999/xlink"
_SHAPES = {
    "svg", "g", "defs", "symbol", "use", "path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text",
    "tspan", "textPath", "title", "desc", "style", "linearGradient", "radialGradient", "stop", "pattern", "clipPath",
    "mask", "marker", "image", "switch", "view", "filter",
}  # fmt: skip
_DROPPED = {"metadata"}
_DOCTYPE = re.compile(r"<!DOCTYPE[^\[>]*>")
_INSIDE = re.compile(r"#|data:image/(png|jpeg|gif);", re.IGNORECASE)
_URL = re.compile(r"url\(\s*['\"]?\s*(?!#)", re.IGNORECASE)


@dataclass(frozen=True)
class OwnFigure:
    """A checked figure.

    path      the file, relative to the folder of the course
    content   the file itself; for an SVG, without the private data of drawing programs
    """

    path: str
    kind: str
    content: bytes = field(repr=False)
    alt: Prose
    caption: Prose | None
    width: float | None  # centimetres
    place: Place = field(repr=False, compare=False)

    @property
    def key(self) -> str:
        """The name by which prose mentions the figure."""
        return Path(self.path).stem


def read_figure(
    root: Path, problem: str, written: FigureKeys | None, drawings: tuple[Placement, ...], faults: Faults
) -> OwnFigure | None:
    """Return the figure of a problem; None without the key `figure:`, or if its `file` or `alt` is missing or
    wrong. The path in `written` is relative to the folder of the file `problem`.

    If the file is rejected, an empty figure is returned, so that prose may still mention it.
    """
    if written is None or written.file is None or written.alt is None:  # a missing key is already reported
        return None
    place = written.file.place
    if not NAME.fullmatch(Path(written.file).stem):
        help_line = "use letters, digits, `-` and `_`"
        faults.error("figure", f"`{Path(written.file).name}` cannot be the name of a figure", place, help=help_line)
    if any(drawing.key == Path(written.file).stem for drawing in drawings):
        message = f"the figure `{written.file}` has the name of one of `drawings:`"
        faults.error("figure", message, place, help="rename the file")
    kind, content = _checked(root, problem, written.file, faults) or ("svg", _EMPTY)
    path = (Path(problem).parent / written.file).as_posix()
    return OwnFigure(path, kind, content, written.alt, written.caption, width_of(written.width, faults), place)


def _checked(root: Path, problem: str, name: Word, faults: Faults) -> tuple[str, bytes] | None:
    """Return the kind and the content of the file; None after an error."""
    kind = name.rpartition(".")[2].lower()
    if kind not in KINDS:
        help_line = "save the figure as PDF, SVG or PNG"
        faults.error("figure", f"`{name}` is not a PDF, SVG or PNG file", name.place, help=help_line)
        return None
    content, wrong = _content(root, problem, name, faults), ""
    if content is None:
        return None
    help_line = f"save the figure again as {kind.upper()}"
    if kind == "svg":
        (content, wrong), help_line = shapes_of(content), "save it again as plain SVG, without links"
    elif not content.startswith(_BEGINS[kind]):
        wrong = f"is not a {kind.upper()} file"
    elif kind == "png" and _pixels(content) > MOST_PIXELS:
        wrong = f"has more than {MOST_PIXELS // 10**6} million pixels"
        help_line = "save it again with fewer pixels"
    if wrong:
        faults.error("figure", f"`{name}` {wrong}", name.place, help=help_line)
        return None
    return kind, content


def _content(root: Path, problem: str, name: Word, faults: Faults) -> bytes | None:
    folder = (root / problem).parent
    shown = (Path(problem).parent / name).as_posix()
    try:
        file = (folder / name).resolve()
        if not file.is_relative_to(root.resolve()):
            help_line = "copy it into the folder of the problem"
            faults.error("figure", f"`{name}` is outside of the course", name.place, help=help_line)
        elif not file.is_file():
            help_line = "the path is relative to the folder of the problem"
            faults.error("figure", f"there is no file `{shown}`", name.place, help=help_line)
        elif file.stat().st_size > LARGEST:
            message = f"`{name}` is larger than {LARGEST // 10**6} MB"
            faults.error("figure", message, name.place, help="each page for a browser contains it: make it smaller")
        else:
            return file.read_bytes()
    except (OSError, ValueError, RuntimeError) as error:  # such as a name with a zero byte, or a loop of links
        faults.error("figure", f"`{name}` cannot be read: {error}", name.place)
    return None


def _pixels(png: bytes) -> int:
    """Return the number of pixels that the header of a PNG file states."""
    return int.from_bytes(png[16:20], "big") * int.from_bytes(png[20:24], "big")


def shapes_of(content: bytes) -> tuple[bytes, str]:
    """Return an SVG without the private data of drawing programs, and the reason why it is rejected. If it is accepted,
    the reason is empty; otherwise the SVG is empty."""
    try:
        text = _DOCTYPE.sub("", content.decode("utf-8-sig"))
        if "<!DOCTYPE" in text or "<!ENTITY" in text:
            return b"", "defines entities"
        tree = ElementTree.fromstring(text)
    except (UnicodeDecodeError, ElementTree.ParseError, ValueError) as error:
        return b"", f"is not an SVG file: {error}"
    if tree.tag != f"{{{_SVG}}}svg":
        return b"", "is not an SVG file"
    wrong = _unwanted(tree)
    if wrong:
        return b"", wrong
    ElementTree.register_namespace("", _SVG)
    ElementTree.register_namespace("xlink", _XLINK)
    return ElementTree.tostring(tree, encoding="utf-8"), ""


def _unwanted(tree: ElementTree.Element) -> str:
    """Remove the private data of drawing programs from an SVG. Stop at the first content that is not allowed, and
    return an error message about it; return "" if everything else is allowed."""
    for element in tree.iter():
        for child in list(element):
            space, _, name = child.tag[1:].rpartition("}")
            if space != _SVG and not space.endswith("/xhtml") or name in _DROPPED:
                element.remove(child)
            elif space != _SVG or name not in _SHAPES and not re.fullmatch("fe[A-Z][A-Za-z]+", name):
                return f"has an element `{name}`"
        for key, value in list(element.attrib.items()):
            space, _, name = key[1:].rpartition("}") if key.startswith("{") else ("", "", key)
            if name == "href" and space in ("", _XLINK):
                if not _INSIDE.match(value.strip()):
                    return f"refers to `{value[:60]}`"
            elif space:
                del element.attrib[key]
            elif name.lower().startswith("on"):
                return f"has a script, `{name}`"
            elif _refers(value):
                return f"may refer to another file in `{name}`"
        if element.tag == f"{{{_SVG}}}style" and _refers(element.text or ""):
            return "may refer to another file in a style"
    return ""


def _refers(style: str) -> bool:
    """Return whether a style may load a file. A backslash counts too, because an escape could hide the reference to a
    file."""
    return bool(_URL.search(style)) or "@import" in style.lower() or "\\" in style
