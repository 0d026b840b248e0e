"""Second routes can refuse: if a result is changed a little, some route to it refuses the change."""

from __future__ import annotations

import pytest

from tests.mutation.runs import RUNS
from tests.perturbation import EXCEPTIONS, Established, established_in, sample

# Problems, one with numbers that add steps, and a body that no problem has.
SOLVED = ("block", "cone", "euler", "slab-numbers", "top-rates", "body-hoop")
SIZE, SEED = 120, 2026


@pytest.fixture(scope="module")
def found() -> list[Established]:
    return [established for name in SOLVED for established in established_in(RUNS[name])]


@pytest.mark.long
def test_no_changed_result_passes_its_second_routes(found: list[Established]) -> None:
    assert [str(each) for each in sample(found, SIZE, SEED) if each.survives] == []


def test_values_relations_and_numbers_are_all_tried(found: list[Established]) -> None:
    rules = {each.rule for each in found}
    assert {
        "numeric.value",
        "numeric.comparison",
        "bodies.density",
        "rotation.torque",
        "model.angular_velocity",
    } <= rules
    assert {"rotation.principal_axis"} <= rules & {rule for rule, _ in EXCEPTIONS}
