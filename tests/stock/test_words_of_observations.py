"""The author's words for an observation, which has no lines."""

from __future__ import annotations

from pathlib import Path

from derive.building.solution import rendered
from tests.stock.described import course_with

ROD = """title: A rod
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle}
  bodies: {rod: {shape: rod, length: l, mass: m, from: [0, 0], along: [sin(theta), -cos(theta)]}}
  gravity: g
statement: A rod.
wording:
  frequency_as_pendulum: The rod swings as a shorter pendulum.
parts:
  - {ask: Find the frequency., answer: frequency}
"""


def test_the_words_of_the_author_replace_the_sentence_of_an_observation(tmp_path: Path) -> None:
    text = " ".join(rendered(course_with(tmp_path, ROD), "trial/one", only={"text"}).texts["text"].split())
    assert "The rod swings as a shorter pendulum." in text
    assert "A simple pendulum of length" not in text
