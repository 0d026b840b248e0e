"""Tests of numerical vectors: right-handed axes, circles, and vectors without a direction."""

from __future__ import annotations

from math import pi

import pytest

from derive.figures.space import (
    NOUGHT,
    STEPS,
    Stance,
    Vector,
    across,
    angle_of,
    cross,
    direction,
    dot,
    mean,
    plus,
    rim,
    size_of,
    unit,
)

WAYS: list[Vector] = [(0.0, 0.0, 2.0), (0.0, 0.0, -1.0), (3.0, 0.0, 0.0), (1.0, -2.0, 3.0), (0.1, 0.1, 5.0)]


@pytest.mark.parametrize("way", WAYS)
def test_two_directions_across_a_third_are_right_handed_with_it(way: Vector) -> None:
    u, v = across(way)
    assert cross(u, v) == pytest.approx(unit(way))
    assert [size_of(u), size_of(v), dot(u, v)] == pytest.approx([1, 1, 0])


@pytest.mark.parametrize("way", WAYS)
def test_a_circle_is_closed_and_goes_round_its_direction(way: Vector) -> None:
    centre = (1.0, 2.0, 3.0)
    places = rim(centre, 0.5, way)
    arms = [plus(place, centre, -1.0) for place in places]
    assert len(places) == STEPS + 1
    assert places[0] == pytest.approx(places[-1])
    assert all(size_of(arm) == pytest.approx(0.5) and dot(arm, way) == pytest.approx(0, abs=1e-12) for arm in arms)
    assert dot(cross(arms[0], arms[1]), way) > 0
    assert mean(places[:-1]) == pytest.approx(centre)


def test_what_vanishes_has_no_direction_and_is_no_error() -> None:
    assert unit(NOUGHT) == NOUGHT
    assert direction((1.0, 1.0), (1.0, 1.0)) == (0.0, 1.0)


def test_an_angle_is_a_number_even_where_rounding_exceeds_a_cosine_of_one() -> None:
    way = (1.0, 9.0, 3.0)
    assert dot(unit(way), unit(way)) > 1
    assert angle_of(way, way) == pytest.approx(0, abs=1e-7)
    assert angle_of(way, plus(NOUGHT, way, -7.0)) == pytest.approx(pi)
    assert angle_of((1.0, 0.0, 0.0), (1.0, 1.0, 0.0)) == pytest.approx(pi / 4)


def test_what_differs_only_towards_the_eye_is_one_spot_on_paper() -> None:
    right, up = across((1.0, 2.0, 2.0))
    stance = Stance(right, up, unit((1.0, 2.0, 2.0)))
    place = (0.3, -0.7, 1.1)
    assert stance.spot(plus(place, stance.eye, 5.0)) == pytest.approx(stance.spot(place))
    assert stance.spot(plus(plus(NOUGHT, right, 2.0), up, -3.0)) == pytest.approx((2, -3))
