"""A Markdown page names derive as its author, and its drawings are in the same folder."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from derive.render.formats import WRITTEN
from derive.render.formats.markdown import FORMAT
from tests.render.pages import NOTATION, WHOLE, WORDS


def test_its_first_line_says_who_wrote_it_and_from_what() -> None:
    problem = SimpleNamespace(path="problems/hw9/one.yaml")
    solution: Any = SimpleNamespace(document=WHOLE, words=WORDS, notation=NOTATION, problem=problem)
    written, _, page = FORMAT.render(solution).partition("\n")
    assert written.startswith(f"<!-- {WRITTEN} from problems/hw9/one.yaml")
    assert page.startswith("\n# A block \\& its $T$ (3 points)\n")


def test_it_is_made_where_it_is_asked_for() -> None:
    assert not FORMAT.built
    assert FORMAT.drawings == "svg"
