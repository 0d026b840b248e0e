"""Tests of the numbers for symbols and of the views of drawings."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import isclose
from typing import Any

import pytest
from sympy import Matrix, Rational, cos, sin, sqrt

from derive.algebra.expressions import TIME, column
from derive.errors import Rejected
from derive.figures import arrow, drawing, outline, particle
from derive.figures.sketches import BROADSIDE
from derive.figures.space import Vector, dot, size_of, unit
from derive.figures.surfaces import Polyhedron, ThinRod
from derive.mechanics import Cuboid, coordinate, point
from derive.render.drawing.camera import OPEN, USUAL, Numbers, best_stance, stance_from, stand_ins, with_coordinates
from derive.steps.record import recorded
from tests.figures.scenery import M, a, heading, pieces_of, strokes
from tests.mechanics.block import b, c


def test_letters_without_numbers_are_told_apart() -> None:
    stand_in = stand_ins([(a, "length"), (b, "length"), (M, "mass"), (c, "length")], {})
    assert [stand_in[letter] for letter in (a, b, c, M)] == [1.0, 1.5, 2.0, 1.0]


def test_a_letter_with_a_number_keeps_it_and_gives_the_others_their_size() -> None:
    stand_in = stand_ins([(a, "length"), (b, "length")], {a: Rational(1, 50)})
    assert stand_in[a] == 0.02
    assert 0.01 < stand_in[b] < 0.1


def test_a_value_that_is_not_real_is_refused() -> None:
    with pytest.raises(Rejected, match="not a real number"):
        Numbers({a: 1.0}).of(sqrt(-a))


def test_the_usual_stance_is_a_rotation() -> None:
    stance = stance_from(33, 21)
    for one, other in combinations((stance.right, stance.up, stance.eye), 2):
        assert isclose(dot(one, other), 0, abs_tol=1e-12)
    assert all(isclose(size_of(way), 1) for way in (stance.right, stance.up, stance.eye))
    assert unit((0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


def test_a_view_is_chosen_in_which_the_angle_is_open() -> None:
    usual = stance_from(25, 18)
    one = column(*(Rational(x) for x in usual.right))
    other = column(*(Rational(x + y) for x, y in zip(usual.right, usual.eye, strict=True)))
    box = outline(Cuboid((a, a, a), M), named=False)
    first, second = strokes(pieces_of(drawing("one", box, arrow(one), arrow(other))), "asked")
    assert abs(heading(first) - heading(second)) > 20


def test_a_coordinate_that_is_a_length_is_drawn_in_terms_of_the_lengths_that_are_given() -> None:
    with recorded():
        x, y = coordinate("x", "length"), coordinate("y", "length")
        found = drawing("one", particle(point(x, y)), values={y: a / 4})
    numbers = with_coordinates(found, {a: 2.0}, 2.0)
    assert {letter.name: value for letter, value in numbers.items()} == {"a": 2.0, "x": 1.6, "y": 0.5}
    own = with_coordinates(found, {a: 2.0, y.symbol: 9.0}, 2.0)
    assert own[y.symbol] == 9.0


def test_a_place_in_a_plane_has_no_depth_and_a_curve_runs_through_its_places() -> None:
    numbers = Numbers({a: 3.0})
    assert numbers.vector(Matrix([a, 1])) == (3.0, 1.0, 0.0)
    curve = numbers.along(Matrix([b, a * b]), b, (0, a), 3)
    assert curve == [(0.0, 0.0, 0.0), (1.0, 3.0, 0.0), (2.0, 6.0, 0.0), (3.0, 9.0, 0.0)]


def test_the_time_has_a_number_while_it_is_drawn() -> None:
    assert 0 < Numbers({}).of(TIME) < 1


def test_a_plane_that_is_carried_round_is_seen_from_its_front() -> None:
    """A rotating hoop is drawn as a circle and a level arm is drawn level, even if another view shows larger angles."""
    slanting = [arrow(column(1, 2, 1), size=1), arrow(column(1, -2, 3), size=1)]
    omega = sqrt(2)
    assert best_stance(drawing("one", slanting), Numbers({})) != USUAL
    assert best_stance(drawing("two", slanting, values={TIME: BROADSIDE / omega}), Numbers({})) == USUAL
    level = (float(cos(BROADSIDE)), float(sin(BROADSIDE)), 0.0)
    across, upwards = USUAL.spot(level)
    assert isclose(across, 1.0, abs_tol=1e-9)
    assert isclose(upwards, 0.0, abs_tol=1e-9)


def test_the_author_chooses_the_view() -> None:
    slanting = drawing("one", [arrow(column(1, 2, 1), size=1), arrow(column(1, -2, 3), size=1)])
    assert best_stance(replace(slanting, seen_from=(60.0, 40.0)), Numbers({})) == stance_from(60, 40)


@pytest.mark.parametrize(
    ("corners", "normal"),
    [
        (((0, 0, 0), (1, 0, 0), (0, 1, 0)), (0.0, 0.0, 1.0)),
        (((0, 0, 0), (1, 0, 0), (0, 0, 1)), (0.0, 1.0, 0.0)),
        (((0, 0, 0), (0, 1, 0), (0, 0, 1)), (1.0, 0.0, 0.0)),
    ],
)
def test_a_flat_body_is_not_seen_edge_on(corners: Any, normal: Vector) -> None:
    plate = Polyhedron(tuple(column(*corner) for corner in corners))
    stance = best_stance(drawing("one", plate), Numbers({}))
    assert abs(dot(stance.eye, normal)) > OPEN
    assert (stance == USUAL) is (normal[0] == 1.0)


def test_a_body_that_is_not_flat_and_a_rod_have_the_usual_view() -> None:
    box = outline(Cuboid((a, a, a), M), named=False)
    rod = ThinRod(column(0, 0, 0), column(1, 0, 0))
    assert best_stance(drawing("one", box), Numbers({})) == best_stance(drawing("two", rod), Numbers({})) == USUAL
