"""Each answer is told in words."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from derive.steps.record import recorded
from derive.stock import body, rotation
from derive.stock.answering.meanings import FORCE, MEANINGS, meaning_of
from derive.stock.keys.bodies import DescribedBody
from derive.stock.system import SystemAnswers
from tests.stock.described import PENDULUM, loaded


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("frequency", "the frequencies of small oscillations"),
        ("motion_theta", "the equation of motion of theta"),
        ("theta_dot_after", "the rate of theta just after the impact"),
        ("angular_momentum_z", "the z component of the angular momentum"),
        ("angular_momentum_size", "the magnitude of the angular momentum"),
        ("wobble_period_x", "the period of a small disturbance of the rotation about the x axis"),
        ("N", FORCE),
    ],
)
def test_an_answer_in_words(name: str, words: str) -> None:
    assert meaning_of(name) == words


def test_every_answer_that_is_offered_has_words(tmp_path: Path) -> None:
    described: Any = loaded(tmp_path, PENDULUM).described
    one: Any = body.Asked(DescribedBody("", (), True))
    with recorded():
        names = [*SystemAnswers(described).asks(), *body.BodyAnswers(one).asks()]
    names += rotation.RotationAnswers(rotation.DescribedRotation()).asks()
    assert [name for name in names if meaning_of(name) == FORCE] == []


def test_words_are_short_and_said_once() -> None:
    assert len({*MEANINGS.values()}) == len(MEANINGS)
    assert max(map(len, MEANINGS.values())) < 85
