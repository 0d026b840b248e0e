"""A strategy names only laws that the page uses."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from tests.courses import ROOT
from tests.stock.described import course_with, edited

PENDULUM = (ROOT / "problems" / "library" / "pendulums" / "spring_pendulum.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("strategy", "said"),
    [
        ("Write Lagrange's equation for the one angle.", []),
        ("Use Hamilton's equations.", ["the strategy names Hamilton's equation, but no step on this page uses it"]),
        (
            "Use the parallel-axis theorem.",
            ["the strategy names parallel-axis theorem, but no step on this page uses it"],
        ),
    ],
)
def test_a_law_that_is_named_is_on_the_page(tmp_path: Path, strategy: str, said: list[str]) -> None:
    without = "\n".join(line for line in PENDULUM.splitlines() if not line.startswith("strategy:"))
    text = edited(without, ("\nparts:", f"\nstrategy: {strategy}\nparts:"))
    found = rendered(course_with(tmp_path, text), "trial/one", only={"text"}).warnings
    assert [each.message for each in found if each.code == "strategy"] == said
