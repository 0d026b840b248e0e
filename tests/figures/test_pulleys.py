"""The double machine of Atwood: a pulley that hangs on the string over another one."""

from __future__ import annotations

from typing import Any

from derive.figures import sketch
from derive.figures.parts import BlockMark, RopeMark, WheelMark
from derive.figures.pulleys import HangingPulley
from derive.figures.surroundings import DistanceMark, FixedEnd
from derive.mechanics import Particle, System, coordinate, point
from derive.steps.record import recorded
from tests.figures.machines import W, a, h, l, labels, m, m1, m2, of


def machine(sign: int = 1) -> System:
    """Goldstein, Classical Mechanics, section 1.6, twice: the depths of two masses are x and y."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    level = sign * x - l
    places: list[Any] = [point(-a, -x), point(a / 2, level - y), point(3 * a / 2, level + y - h)]
    return System(*(Particle(mass, at) for mass, at in zip((m, m1, m2), places, strict=True)), W)


def test_one_pulley_is_fixed_and_the_other_hangs_on_its_string() -> None:
    with recorded():
        found = sketch("system", machine())
    assert found is not None
    assert labels(found, BlockMark) == ["m", "m_1", "m_2"] and labels(found, DistanceMark) == ["x", "y"]
    assert [mark.radius for mark in of(found, WheelMark)] == [a, a / 2]
    assert len(of(found, RopeMark)) == 2 and len(of(found, FixedEnd)) == 1
    upper, lower = of(found, RopeMark)
    assert upper.along[-1] == lower.along[1]


def test_a_pulley_that_goes_down_with_what_should_lift_it_hangs_on_no_string() -> None:
    with recorded():
        assert not HangingPulley(machine(-1)).hung
