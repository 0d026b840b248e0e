"""Tests of ground, fixed ends, angles and lengths: the hatched side, the radius of an arc, and free space."""

from __future__ import annotations

from math import atan2, degrees, hypot, pi

import pytest
from sympy import ImmutableDenseMatrix, Integer, Rational, sin

from derive.figures import angle_mark, block, drawing, fixed_end, gravity_mark, length_mark, particle, pivot, rod, way
from derive.figures.annotations import ASIDE, Arrow
from derive.figures.elements import cart, ceiling, floor, wall
from derive.figures.marks import Mark
from derive.figures.pieces import Piece
from derive.figures.surroundings import ARC, FloorMark
from derive.mechanics import Coordinate, point
from tests.figures.machines import ORIGIN, R, a, hung, l, letter, m, seen
from tests.figures.scenery import strokes

AT, ALONG = ImmutableDenseMatrix([0, 0]), ImmutableDenseMatrix([1, 0])
RIGHT, DOWN = point(2, 0), point(0, -2)


def shown(*marks: Mark) -> list[Piece]:
    return seen(drawing("machine", *marks))


def side(pieces: list[Piece]) -> tuple[float, float]:
    hatches = strokes(pieces, "hatch")
    return tuple(sum(h.spots[1][k] - h.spots[0][k] for h in hatches) / len(hatches) for k in (0, 1))  # type: ignore


@pytest.mark.parametrize("order", [(ORIGIN, RIGHT), (RIGHT, ORIGIN)])
def test_ground_is_hatched_below_and_a_ceiling_above_in_either_order(order: tuple[object, object]) -> None:
    assert side(shown(floor(*order)))[1] < -1
    assert side(shown(ceiling(*order)))[1] > 1


def test_a_wall_is_hatched_on_the_side_that_is_said() -> None:
    assert side(shown(wall(ORIGIN, DOWN)))[0] < -1
    assert side(shown(wall(ORIGIN, DOWN, solid="right")))[0] > 1


@pytest.mark.parametrize(
    "on_it", [block(point(1, 0)), block(point(1, 0), height=Rational(1, 2)), block(point(1, 0), stands=True)]
)
def test_a_floor_is_drawn_under_what_stands_on_it(on_it: Mark) -> None:
    pieces = shown(on_it, floor(ORIGIN, RIGHT, under=on_it))
    ground = strokes(pieces, "ground")[0]
    assert ground.spots[0][1] == pytest.approx(min(y for _, y in strokes(pieces, "edge")[0].spots))


def test_a_floor_is_drawn_under_the_wheels_of_a_cart_with_a_height() -> None:
    on_it = cart(point(1, 0), height=Rational(1, 2))
    pieces = shown(on_it, floor(ORIGIN, RIGHT, under=on_it))
    lowest = min(y for stroke in strokes(pieces, "edge") for _, y in stroke.spots)
    assert strokes(pieces, "ground")[0].spots[0][1] == pytest.approx(lowest)


def test_the_ground_under_several_places_is_wide_enough_for_them_all() -> None:
    marks = [particle(point(x, 0)) for x in (0, 3)]
    pieces = shown(*marks, FloorMark(tuple(mark.at for mark in marks), 5.0, (10.0, 0.0)))  # type: ignore[attr-defined]
    (x, y), (u, v) = strokes(pieces, "ground")[0].spots
    spots = sorted(piece.spot for piece in pieces if type(piece).__name__ == "Bullet")  # type: ignore[union-attr]
    assert (x, u) == pytest.approx((spots[0][0] - 10, spots[1][0]))
    assert y == v == pytest.approx(spots[0][1] - 5)


def test_a_fixed_end_is_a_wall_behind_the_spring_and_a_pivot_hangs_from_above() -> None:
    assert side(shown(fixed_end(ORIGIN, RIGHT)))[0] < -1
    assert side(shown(pivot(ORIGIN)))[1] > 1
    assert side(shown(pivot(ORIGIN, away="up")))[1] < -1


@pytest.mark.parametrize("size", [0.1, 0.5, 1.2, 2.5])
def test_the_arc_of_an_angle_is_as_wide_as_it_is_and_within_its_ways(size: float) -> None:
    theta = Coordinate(letter("theta"), "angle")
    bob = hung(l, theta)
    found = drawing("machine", rod(ORIGIN, bob), angle_mark(ORIGIN, "down", bob, theta))
    pieces = seen(found, theta=size) if found.coordinates else seen_at(found, theta, size)
    arc, bar = strokes(pieces, "angle")[0], strokes(pieces, "bar")[0]
    x, y = bar.spots[0]
    start, end = (atan2(v - y, u - x) for u, v in (arc.spots[0], arc.spots[-1]))
    assert degrees(start) == pytest.approx(-90)
    assert (end - start) % (2 * pi) == pytest.approx(size)
    radius = hypot(arc.spots[0][0] - x, arc.spots[0][1] - y)
    assert radius < min(hypot(bar.spots[1][0] - x, bar.spots[1][1] - y), 2 * ARC[1])


def seen_at(found: object, theta: Coordinate, size: float) -> list[Piece]:
    from derive.render.drawing.camera import Numbers
    from derive.render.drawing.picture import picture

    return picture(found, Numbers({theta.symbol: size, l: 1.0}), 5.0, 4.2)  # type: ignore[arg-type]


def test_no_angle_has_neither_an_arc_nor_a_dashed_line_over_the_rod() -> None:
    pieces = shown(rod(ORIGIN, DOWN), angle_mark(ORIGIN, "down", DOWN, "theta"))
    assert strokes(pieces, "angle") == strokes(pieces, "trace") == []


def test_a_length_stands_away_from_the_middle_or_where_it_is_said() -> None:
    corners = particle(ORIGIN), particle(point(2, 2))
    for mark, sign in ((length_mark(ORIGIN, point(0, 2), l), -1), (length_mark(ORIGIN, point(0, 2), l, "right"), 1)):
        pieces = shown(*corners, mark)
        x = next(piece.spot[0] for piece in pieces if type(piece).__name__ == "Bullet")  # type: ignore[union-attr]
        line = strokes(pieces, "measure")[0]
        assert line.spots[0][0] - x == pytest.approx(sign * ASIDE)


def test_a_length_stands_clear_of_the_block_at_its_end() -> None:
    on_it = block(RIGHT)
    pieces = shown(on_it, length_mark(ORIGIN, RIGHT, l, "up", past=on_it))
    assert strokes(pieces, "measure")[0].spots[0][1] > max(y for _, y in strokes(pieces, "edge")[0].spots) + 3


def test_a_length_of_nothing_is_not_drawn() -> None:
    assert strokes(shown(particle(ORIGIN), particle(RIGHT), length_mark(RIGHT, RIGHT, l)), "measure") == []


def test_a_way_is_the_curve_of_the_place_and_a_straight_one_is_one_stroke() -> None:
    theta, x = letter("theta"), letter("x")
    ring = strokes(shown(rod(ORIGIN, RIGHT), way(point(R * sin(theta), 0), theta)), "trace")[0]
    assert len(ring.spots) > 60
    assert len(strokes(shown(way(point(x, 2 * x), x, (0, 1))), "trace")[0].spots) == 2
    assert len(strokes(shown(way(point(x, x**2), x, (0, 1), solid=True)), "wire")[0].spots) > 60


def test_gravity_points_down_beside_everything_else() -> None:
    pieces = shown(gravity_mark(), particle(ORIGIN, m), length_mark(ORIGIN, RIGHT, a), particle(RIGHT))
    arrow = strokes(pieces, "given")[0]
    others = [x for piece in pieces if piece is not arrow and type(piece).__name__ != "Tag" for x, _ in piece.spots]
    assert arrow.spots[0][0] == arrow.spots[1][0] > max(others) + 10
    assert arrow.spots[1][1] < arrow.spots[0][1]


@pytest.mark.parametrize("pushes", [False, True])
def test_an_arrow_is_shifted_to_its_left_side(pushes: bool) -> None:
    """Both arrows point to the right, so their left side is above."""
    straight, shifted = (Arrow(AT, ALONG, Integer(1), pushes=pushes, aside=aside) for aside in (0.0, 5.0))
    first, second = (
        strokes(shown(particle(ORIGIN), particle(RIGHT), arrow), "asked")[0] for arrow in (straight, shifted)
    )
    assert [v - y for (_, y), (_, v) in zip(first.spots, second.spots, strict=True)] == pytest.approx([5, 5])
