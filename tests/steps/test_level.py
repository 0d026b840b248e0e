"""Levels of detail, from the least to the most."""

from __future__ import annotations

import pytest

from derive.steps.level import Level


@pytest.mark.parametrize(("wanted", "shown"), [("brief", 1), ("standard", 2), ("full", 3)])
def test_a_level_shows_its_own_forms_and_those_of_lower_ones(wanted: str, shown: int) -> None:
    assert [level for level in Level if Level(wanted).shows(level)] == list(Level)[:shown]
