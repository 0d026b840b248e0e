"""A flat body rolled on a cylinder: where its centre is, and that it does not slip."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, cos, pi, sin, symbols

from derive.algebra.equality import Grade, equal
from derive.mechanics import coordinate, rate_of, rolled_centre
from tests.mechanics.motion import THETA

R, h = symbols("R h", positive=True)
q, q_dot = THETA.symbol, THETA.rate


def centre(height: Any = h, radius: Any = R) -> tuple[Any, Any]:
    x, y = rolled_centre(radius, height, THETA)
    return x.value, y.value


def test_balanced_it_lies_on_top() -> None:
    assert [place.subs(q, 0) for place in centre()] == [0, R + h]


def test_the_centre_is_an_arc_behind_the_contact_and_a_height_above_the_surface() -> None:
    x, y = centre()
    out, along = (sin(q), cos(q)), (cos(q), -sin(q))
    assert equal(x * out[0] + y * out[1], R + h)
    assert equal(x * along[0] + y * along[1], -R * q)


def test_a_body_without_thickness_follows_the_involute_of_the_circle() -> None:
    x, y = centre(Integer(0))
    assert equal(x**2 + y**2, R**2 * (1 + q**2))


def test_rolling_to_either_side_is_the_same() -> None:
    x, y = centre()
    assert equal(x.subs(q, -q), -x)
    assert equal(y.subs(q, -q), y)


def test_the_speed_of_the_centre_is_the_rate_times_its_distance_from_the_contact() -> None:
    x, y = rolled_centre(R, h, THETA)
    speed_squared = rate_of(x).value ** 2 + rate_of(y).value ** 2
    assert equal(speed_squared, (h**2 + R**2 * q**2) * q_dot**2)


def test_a_quarter_turn_lays_the_centre_below_the_contact_by_its_arc() -> None:
    x, y = (place.subs(q, pi / 2) for place in centre())
    assert (x, y) == (R + h, pi * R / 2)


def test_a_centre_below_the_face_is_allowed() -> None:
    x, y = rolled_centre(R, -h, THETA)
    assert [place.value.subs(q, 0) for place in (x, y)] == [0, R - h]


def test_it_holds_for_every_angle_and_both_routes_prove_it() -> None:
    x, y = rolled_centre(R, h, THETA)
    for place in (x, y):
        assert {e.grade for e in place.step.evidence} == {Grade.PROVED}
        assert {"no_slip", "balanced"} <= {e.claim for e in place.step.evidence}
    assert (x.step.outcome, y.step.outcome) == ("across", "up")


@pytest.mark.parametrize("letters", [("x", "y"), ("u", "z")])
def test_its_components_have_the_letters_that_they_are_given(letters: tuple[str, str]) -> None:
    phi = coordinate("phi")
    found = rolled_centre(R, h, phi, symbols=letters)
    assert tuple(place.key for place in found) == letters
    assert all(place.coordinates == {phi.symbol: "angle"} for place in found)
