"""Every problem of the library is derived and printed, because other tests try only some of them."""

from __future__ import annotations

import pytest

from derive.course.problem_set import problem_set
from tests.courses import ROOT, rendered_once


@pytest.mark.every_case
@pytest.mark.parametrize("problem_id", problem_set(ROOT, "library").problems)
def test_every_problem_of_the_library_has_a_page_and_agrees_with_its_reference(problem_id: str) -> None:
    page = rendered_once(ROOT, problem_id, only={"text"})
    assert page.agreed, [each.shown() for each in page.warnings]
