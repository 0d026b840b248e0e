"""A document of Microsoft Word with native equations: HTML with formulas in TeX, converted by Pandoc.

Pandoc and a converter of drawings are optional packages: `pip install 'derive-mechanics[docx]'`.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Sequence
from html import escape
from importlib import import_module
from pathlib import Path
from shutil import which
from typing import Any

from derive.building.scratch import Scratch
from derive.errors import BuildFailed, Complaint, Misused
from derive.exporting.questions import Part, Question, with_files

LONGEST = 120  # time limit of Pandoc, in seconds
DPI, SHARPNESS = 96, 3  # pixels per inch in a browser; pixels of a picture per pixel of a browser
READS = "html+tex_math_single_backslash-raw_html"
INSTALL = "install Pandoc and the converter of drawings: `pip install 'derive-mechanics[docx]'`"


def word_document(title: str, questions: Sequence[Question], solutions: bool = True) -> bytes:
    """Return a set as a .docx file; without `solutions`, the file contains only the statements and questions."""
    pandoc = _pandoc()
    pieces, pictures = [f"<h1>{escape(title)}</h1>"], dict[str, bytes]()
    for question in questions:
        html = _html(question, solutions)
        shown, used = with_files(html, _picture, question.files)
        for name in used:
            shown = shown.replace(
                f'src="{_picture(name)}"', f'src="{_picture(name)}" width="{_width(question.files[name])}"'
            )
        pieces.append(shown)
        pictures |= {_picture(name): _png(question.files[name]) for name in used}
    with Scratch() as name:
        folder = Path(name)
        (folder / "set.html").write_text("\n".join(pieces), encoding="utf-8")
        for file, content in pictures.items():
            (folder / file).write_bytes(content)
        command = [pandoc, "--from", READS, "--to", "docx", "set.html", "--output", "set.docx"]
        try:
            ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=LONGEST, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            failed, help_line = ("cannot be run", INSTALL) if isinstance(error, OSError) else ("was stopped", None)
            raise BuildFailed(Complaint("pandoc", f"Pandoc {failed}: {error}", help=help_line)) from None
        if ran.returncode or ran.stderr.strip():  # Pandoc warns if it cannot convert a formula or a picture
            raise BuildFailed(Complaint("pandoc", f"Pandoc cannot convert the questions: {ran.stderr.strip()[:500]}"))
        return (folder / "set.docx").read_bytes()


def _picture(drawing: str) -> str:
    return drawing.removesuffix(".svg") + ".png"


def _width(drawing: bytes) -> str:
    """Return the width that a drawing states, such as `157.257pt`; by default `240pt`."""
    found = re.search(rb'<svg [^>]*\bwidth="([\d.]+pt)"', drawing)
    return found[1].decode() if found else "240pt"


def _html(question: Question, solutions: bool) -> str:
    parts = (_part(part, solutions) for part in question.parts)
    heading = f"<h2>{question.number} {escape(question.title)}</h2>"
    return "\n".join([heading, question.statement, *parts, question.remarks if solutions else ""])


def _part(part: Part, solutions: bool) -> str:
    label = f"<h3>({part.label})</h3>\n" if part.label else ""
    return f"{label}{part.question}\n{part.solution if solutions else ''}"


def check_installed() -> None:
    """Raise an error if Pandoc or the converter of drawings is missing, so that nothing is derived in vain."""
    _converter()
    if which(_pandoc()) is None:
        raise Misused(Complaint("pandoc", "Pandoc is not installed", help=INSTALL))


def _pandoc() -> str:
    """Return the path of Pandoc from its package; if the package or its Pandoc is missing, return the name `pandoc`."""
    try:
        return str(import_module("pypandoc").get_pandoc_path())
    except (ImportError, OSError):
        return "pandoc"


def _converter() -> Any:
    try:
        return import_module("resvg_py")
    except ImportError:
        raise Misused(Complaint("pandoc", "no converter of drawings is installed", help=INSTALL)) from None


def _png(drawing: bytes) -> bytes:
    return bytes(_converter().svg_to_bytes(svg_string=drawing.decode(), zoom=SHARPNESS, dpi=DPI))
