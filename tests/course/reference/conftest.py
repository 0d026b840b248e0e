"""The block derived once, and references that are compared with its steps."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from derive.course.problem import Problem, load_problem, run_solve
from derive.course.reference.comparison import Comparison, comparisons
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.step import Quantity
from tests.course.reference.stated import HEAD, Compared
from tests.courses import course_in


@pytest.fixture(scope="session")
def block(tmp_path_factory: pytest.TempPathFactory) -> tuple[Problem, dict[str, Quantity]]:
    problem = load_problem(course_in(tmp_path_factory.mktemp("block")), "hw9/block")
    return problem, with_ancestors(returned_quantities(run_solve(problem)))


@pytest.fixture
def compared(block: tuple[Problem, dict[str, Quantity]], tmp_path: Path) -> Compared:
    problem, known = block
    course_in(tmp_path)

    def compare(*entries: str, whole: str | None = None) -> tuple[Comparison, ...]:
        text = HEAD + "".join(f"    - {{{entry}}}\n" for entry in entries) if whole is None else whole
        (tmp_path / "problems" / "hw9" / "reference.yaml").write_text(text, encoding="utf-8")
        return comparisons(replace(problem, root=tmp_path), known)

    return compare
