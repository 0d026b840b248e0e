"""The manual on references keeps its word: its example agrees, and what it calls refused is refused."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from derive.course.problem import load_problem, run_solve
from derive.course.reference.comparison import comparisons
from derive.steps.derivation import returned_quantities, with_ancestors
from tests.course.latex.formula import complaint, read
from tests.courses import ROOT, course_in

MANUAL = (ROOT / "docs" / "references.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (`.*`) \| (.*) \|$", MANUAL.partition("two ways")[2], re.MULTILINE)
REFUSED = [text for row in ROWS for text in re.findall(r"`([^`]+)`", row[0])]
INSTEAD = [text for row in ROWS for text in re.findall(r"`([^`/]+)`", row[1])]


def test_the_example_of_the_manual_agrees_but_for_its_erratum(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    example = re.findall(r"```yaml\n(.*?)```", MANUAL, re.DOTALL)[0]
    (root / "problems" / "hw9" / "reference.yaml").write_text(example, encoding="utf-8")
    problem = load_problem(root, "hw9/block")
    found = comparisons(problem, with_ancestors(returned_quantities(run_solve(problem))))
    assert [entry.outcome for entry in found] == ["agrees"] * 4 + ["agrees to 4 figures", "erratum"]


@pytest.mark.parametrize("text", REFUSED)
def test_what_the_manual_says_is_refused_is_refused(text: str) -> None:
    assert complaint(text).code == "ambiguous"


@pytest.mark.parametrize("text", INSTEAD)
def test_what_the_manual_says_instead_is_read(text: str) -> None:
    renamed = text.replace("a_2", "a").replace("_{12}", "_0").replace("{23}", "{2}").replace(r"\arcsin a", r"\arcsin n")
    assert read(renamed).sides


def test_the_manual_has_its_examples() -> None:
    assert len(REFUSED) >= 10 <= len(INSTEAD)
