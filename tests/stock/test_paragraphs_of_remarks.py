"""Empty lines in `note:` begin new paragraphs, in folded and in literal text and in every format."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from tests.stock.described import PENDULUM, course_with

FOLDED = "note: >\n  The first\n  remark.\n\n  The second remark.\n"
LITERAL = FOLDED.replace(">", "|")


@pytest.mark.parametrize("note", [FOLDED, LITERAL])
def test_an_empty_line_begins_a_paragraph(note: str, tmp_path: Path) -> None:
    found = rendered(course_with(tmp_path, PENDULUM + note), "trial/one", only={"text", "markdown", "latex", "html"})
    assert "Remarks. The first remark.\n\nThe second remark." in found.texts["text"]
    assert "The first remark.\n\nThe second remark." in found.texts["markdown"]
    assert r"The first remark.\par The second remark." in " ".join(found.latex.split())
    assert '<p class="strategy">The second remark.</p>' in " ".join(found.html.split())
