"""Directions and turns of a description."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.stock.bodies import CONE
from tests.stock.described import edited, loaded, messages


def test_a_direction_is_a_name_or_components(tmp_path: Path) -> None:
    for written, components in (("x", None), ("[R, h, 0]", ["R", "h", "0"])):
        problem = loaded(tmp_path, edited(CONE, ("about: apex", f"direction: {written}")))
        axis = problem.described.bodies[0].direction  # type: ignore[union-attr]
        assert axis.is_name == (components is None)
        assert components is None or [str(c) for c in axis.components] == components


def test_turns_follow_each_other(tmp_path: Path) -> None:
    problem = loaded(tmp_path, edited(CONE, ("about: apex", "turned: {z: alpha, x: 90 deg}")))
    turns = problem.described.bodies[0].turns  # type: ignore[union-attr]
    assert [(axis, str(angle)) for axis, angle in turns] == [("z", "alpha"), ("x", "pi/2")]


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("direction: w", "6: `direction` must be a direction, but `w` is not one"),
        (
            "direction: [R, M, 0]",
            "6: the components of `direction` have different dimensions: one is a length, another a mass",
        ),
        ("direction: [1, 0]", "6: `direction` must be a direction or three components"),
        ("direction: [1, q, 0]", "6: `q` is not declared"),
        ("turned: {w: alpha}", "6: axes can rotate about x, y or z, not about `w`"),
        ("turned: {z: R}", "6: `the angle about z` must be an angle, but `R` is a length"),
    ],
)
def test_what_is_no_direction_is_told(written: str, said: str, tmp_path: Path) -> None:
    assert messages(tmp_path, edited(CONE, ("about: apex", written))) == [said]
