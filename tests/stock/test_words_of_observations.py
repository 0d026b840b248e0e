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


SADDLE = """title: A ball on a rotating saddle
solve: system
symbols: {m: mass, g: acceleration, Omega: angular speed, R: length}
given:
  coordinates: COORDINATES
  axes: {saddle: [{z: Omega*t}]}
  particles: {ball: {mass: m, at: {in: saddle, by: PLACE}}}
  gravity: g
statement: A ball.
parts:
  - {ask: Find where it can rest., answer: equilibria}
"""


def test_every_position_is_an_equilibrium_only_if_no_other_coordinate_is_restricted(tmp_path: Path) -> None:
    """On a rotating parabola with Omega^2 = g/R every x is an equilibrium, but on a saddle y must still vanish."""
    for coordinates, place, is_so in (
        ("{x: length}", "[x, 0, x**2/(2*R)]", True),
        ("{x: length, y: length}", "[x, y, (x**2 - y**2)/(2*R)]", False),
    ):
        given = SADDLE.replace("COORDINATES", coordinates).replace("PLACE", place)
        text = " ".join(rendered(course_with(tmp_path, given), "trial/one", only={"text"}).texts["text"].split())
        assert ("every position is an equilibrium position" in text) is is_so
