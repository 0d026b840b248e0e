"""The start of several coordinates, as a description says it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mechanics.test_superposition import TWO
from tests.stock.described import messages


@pytest.mark.parametrize(
    ("values", "said"),
    [("", "`solution` needs `start` or `values`"), (", values: {C_1: Q}", "`C_1` is none")],
)
def test_a_start_that_tells_nothing_is_refused(values: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, TWO.replace(", values: {q: Q}", values))
    assert any(said in each for each in found), found
