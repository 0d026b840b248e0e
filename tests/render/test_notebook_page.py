"""The cells of a notebook are in the order of the page."""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import Any

from derive.render.printing.notebook_page import notebook
from tests.render.pages import NOTATION, WHOLE, WORDS

KINETIC = SimpleNamespace(key="energy")
SOLUTION: Any = SimpleNamespace(
    document=WHOLE,
    words=WORDS,
    notation=NOTATION,
    problem=SimpleNamespace(id="hw9/one", path="problems/hw9/one.yaml", parts=[SimpleNamespace(answers=["energy"])]),
    derivation=SimpleNamespace(answering=lambda answers: [KINETIC] if answers == ["energy"] else []),
)


def test_a_page_is_told_drawn_and_derived_in_its_order() -> None:
    cells = json.loads(notebook(SOLUTION))["cells"]
    lasts = [(cell["cell_type"], cell["source"][-1]) for cell in cells if cell["cell_type"] == "code"]
    assert [last for _, last in lasts] == [
        'problem = open_problem("hw9/one")',
        'problem.drawing("axes")',
        'problem.drawing("vectors")',
        'problem.answer("energy")',
    ]
    texts = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]
    assert texts[0].startswith("# A block")
    assert texts[1].startswith("See ")
    assert any(text.startswith("**Figure 1.** Both") for text in texts)
    assert "## Limiting cases" in "".join(texts)


def test_cells_are_named_by_their_place() -> None:
    cells = json.loads(notebook(SOLUTION))["cells"]
    assert [cell["id"] for cell in cells] == [f"cell-{i}" for i in range(1, len(cells) + 1)]
