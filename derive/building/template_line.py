"""The line of a course's own template that printed a line of TeX, for the message of a TeX error."""

from __future__ import annotations

import re
from pathlib import Path

from derive.building.files import shown_path
from derive.errors import Place

_TAG = re.compile(r"<<.*?>>|<%.*?%>|<#.*?#>")


def own_templates(root: Path) -> tuple[Path, ...]:
    """Return the LaTeX templates of a course."""
    return tuple(sorted((root / "templates" / "latex").glob("*.j2")))


def line_of_template(templates: tuple[Path, ...], printed: str, word: str) -> Place | None:
    """Return the line of a template that printed a line of TeX; of several such lines, the line with the longest text
    outside of tags. None if no line of a template can have printed it.

    word   the part of the printed line that the message marks; it is also marked in the template's line, if it occurs
           there
    """
    found = [
        (len(own), -number, Place(shown_path(file), number, column + 1, line[:150], width))
        for file in templates
        for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), 1)
        if (own := _TAG.sub("", line).strip()) and re.fullmatch(_pattern(line), printed.strip())
        for column, width in [_mark(line, word)]
    ]
    return max(found, key=lambda each: each[:2])[2] if found else None


def _pattern(line: str) -> str:
    texts, tags = _TAG.split(line.strip()), _TAG.findall(line)
    wild = [".*" if tag.startswith("<<") else "" for tag in tags]
    return "".join(re.escape(text) + any_text for text, any_text in zip(texts, [*wild, ""], strict=True))


def _mark(line: str, word: str) -> tuple[int, int]:
    at = line.find(word) if word else -1
    if at >= 0:
        return at, len(word)
    text = line[:150].strip()
    return len(line) - len(line.lstrip()), len(text)
