"""Tests of letters of angles, cones, broken supports, origins and points on rods."""

from __future__ import annotations

from math import cos, dist, hypot, pi, sin

import pytest
from sympy import Symbol

from derive.algebra.expressions import column
from derive.figures.annotations import Cone, LargePoint, PositiveRotation, Support, letter_of_angle
from derive.figures.marks import Mark
from derive.figures.pieces import Bullet, Paper, Patch, Stroke
from derive.figures.space import Spot, Vector
from derive.figures.surroundings import OriginMark
from derive.render.drawing.camera import FLAT, Numbers, stance_from
from derive.render.drawing.canvas import PENS
from derive.render.drawing.hidden_lines import OnPaper
from derive.render.drawing.labels import placed

SIZE = 6.0, 8.0  # width and height of a label, in points


def paper(scale: float = 1.0, fixed: tuple[Vector, ...] = (), azimuth: float | None = None) -> Paper:
    stance = FLAT if azimuth is None else stance_from(azimuth, 20)
    return OnPaper(Numbers({}), stance, scale, 1.0, (0.0, 0.0, 0.0), fixed)


def lines(mark: Mark, on: Paper) -> list[Stroke]:
    return [piece for piece in mark.pieces(on) if isinstance(piece, Stroke)]


def arc(size: float, radius: float = 25.0) -> tuple[Spot, ...]:
    turns = [pi / 2 - size * i / 48 for i in range(49)]
    return tuple((radius * cos(t), radius * sin(t)) for t in turns)


def sides(size: float) -> list[Stroke]:
    return [Stroke(((0.0, 0.0), (60.0 * cos(t), 60.0 * sin(t))), "edge") for t in (pi / 2, pi / 2 - size)]


@pytest.mark.parametrize(("size", "is_inside"), [(1.2, True), (0.3, False)])
def test_the_letter_of_an_angle_is_next_to_its_arc(size: float, is_inside: bool) -> None:
    letter = letter_of_angle(Symbol("theta"), (0.0, 0.0), arc(size))
    (found,) = placed([*sides(size), Stroke(arc(size), "angle"), letter], lambda _: SIZE)
    middle = found.corner[0] + SIZE[0] / 2, found.corner[1] + SIZE[1] / 2
    assert (hypot(*middle) < 25.0) is is_inside
    assert hypot(*middle) < 25.0 + 15.0


def test_the_letter_of_an_outer_angle_leaves_a_line_inside_it() -> None:
    rod = Stroke(((0.0, 0.0), (60.0 * cos(1.1), 60.0 * sin(1.1))), "rod")
    letter = letter_of_angle(Symbol("theta_0"), (0.0, 0.0), arc(1.0))
    (found,) = placed([*sides(1.0), rod, Stroke(arc(1.0), "angle"), letter], lambda _: SIZE)
    left, below, right, above = found.extent
    on_rod = [(r * cos(1.1), r * sin(1.1)) for r in range(60)]
    assert not any(left < x < right and below < y < above for x, y in on_rod)


def test_the_cone_of_a_vector_goes_through_its_tip_and_is_round_its_axis() -> None:
    cone = Cone(column(0, 0, 0), column(0, 1, 2), 1.0, axis=column(0, 0, 1))
    on = paper(azimuth=30)
    circle, opposite = lines(cone, on)
    tip = on.spot(cone.tip(on.numbers, on.reach))
    assert min(dist(tip, spot) for spot in circle.spots) < 0.05
    x, y, z = cone.tip(on.numbers, on.reach)
    assert dist(opposite.spots[1], on.spot((-x, -y, z))) < 1e-9


@pytest.mark.parametrize(("far", "is_broken"), [(10.0, False), (60.0, True)])
def test_a_support_that_a_body_could_strike_is_broken(far: float, is_broken: bool) -> None:
    pieces = Support(column(0, 0, 0)).pieces(paper(fixed=((0.0, far, 0.0),)))
    assert any(isinstance(piece, Patch) for piece in pieces) is is_broken


def test_an_origin_is_on_the_line_and_a_point_of_a_rod_is_a_dot_on_the_uncut_rod() -> None:
    (mark,) = lines(OriginMark(column(2, 0, 0), 5.0), paper())
    (x, low), (u, high) = mark.spots
    assert (x, u, low + high) == (2.0, 2.0, -10.0)
    (dot,) = (piece for piece in LargePoint(column(0, 0, 0)).pieces(paper()) if isinstance(piece, Bullet))
    assert dot.fill == "line" and 2 * dot.size > PENS["rod"].width


@pytest.mark.parametrize("counterclockwise", [True, False])
def test_the_sense_of_a_rotation_is_the_same_on_both_sides(counterclockwise: bool) -> None:
    for to_the_right in (True, False):
        (arrow,) = lines(PositiveRotation(column(0, 0, 0), 1.0, counterclockwise, to_the_right), paper(scale=20.0))
        (x, y), (u, v) = arrow.spots[0], arrow.spots[-1]
        assert (x * v - y * u > 0) is counterclockwise
        assert (x > 0) is to_the_right
