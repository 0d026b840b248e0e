"""Every problem of the library is derived and printed by default, because other tests try only some of them."""

from __future__ import annotations

import pytest

from derive.course.problem_set import problem_set
from derive.errors import DeriveError
from tests.courses import ROOT, rendered_once

EVERY = problem_set(ROOT, "library").problems
THIRDS = 3  # fewer than the tests of which only a sample of the cases runs


@pytest.mark.parametrize("third", range(THIRDS))
def test_every_problem_of_the_library_has_a_page_and_agrees_with_its_reference(third: int) -> None:
    failed = {}
    for problem_id in EVERY[third::THIRDS]:
        try:
            page = rendered_once(ROOT, problem_id, only={"text"})
        except DeriveError as error:
            failed[problem_id] = [each.shown() for each in error.complaints]
        else:
            if not page.agreed:
                failed[problem_id] = [each.shown() for each in page.warnings]
    assert not failed, failed
