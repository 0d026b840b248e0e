"""Which described bodies are drawn."""

from __future__ import annotations

from pathlib import Path

from derive.building.solution import rendered
from tests.stock.bodies import CONE, CONE_IS
from tests.stock.described import course_with, edited


def test_a_body_with_an_outline_is_drawn_and_another_is_not(tmp_path: Path) -> None:
    assert "[figure:" in rendered(course_with(tmp_path, CONE), "trial/one").texts["text"]
    text = edited(CONE, (CONE_IS, "{shape: half_disc, radius: R, mass: M}"), ("  about: apex\n", ""))
    assert "[figure:" not in rendered(course_with(tmp_path, text), "trial/one").texts["text"]
