"""Problems with random numbers for all letters are printed, or refused with a message: a sample of
`tests.drawn_numbers`."""

from __future__ import annotations

import pytest

from tests.drawn_numbers import GOOD, INTERNAL, problems, tried, with_values


@pytest.mark.parametrize("name", ["library/earth", "library/power_law", "library/driven_oscillator", "library/wedge"])
def test_a_problem_with_drawn_numbers_ends_without_an_internal_error(name: str) -> None:
    for outcome in tried(name, 1, seed=7):
        assert outcome.sort != INTERNAL, outcome.told


@pytest.mark.parametrize("name", ["library/ball_with_hole", "hw9/cone"])
def test_sizes_of_any_order_are_taken(name: str) -> None:
    for outcome in tried(name, 1, seed=3):
        assert outcome.sort == GOOD, outcome.told


def test_every_set_is_tried() -> None:
    assert {name.partition("/")[0] for name in problems()} == {"hw9", "library"}
    assert len(problems()) > 80


def test_numbers_are_added_to_those_of_the_file() -> None:
    assert with_values("a: 1\nvalues:\n  m: 1 kg\n", {"k": "2 N/m"}) == "a: 1\nvalues:\n  k: 2 N/m\n  m: 1 kg\n"
    assert with_values("values: {m: 1 kg}\n", {"k": "2 N/m"}) == "values: {k: 2 N/m, m: 1 kg}\n"
    assert with_values("a: 1\n", {"k": "2 N/m"}) == "a: 1\nvalues:\n  k: 2 N/m\n"
