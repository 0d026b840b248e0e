"""What moves on lines, as a sketch draws it: blocks, floors up to walls, wedges and strings, and what letters are."""

from __future__ import annotations

import pytest
from sympy import Rational, cos, sin

from derive.figures import sketch
from derive.figures.parts import (
    BLOCK,
    BarMark,
    BlockMark,
    CartMark,
    CornerRopeMark,
    RopeMark,
    SpringMark,
    WedgeMark,
    WheelMark,
)  # fmt: skip
from derive.figures.pieces import Stroke
from derive.figures.surroundings import AngleBetween, DistanceMark, FixedEnd, FloorMark
from derive.mechanics import Disc, Particle, System, constraint, coordinate, point
from derive.steps.record import recorded
from tests.figures.machines import SKETCHES, R, W, a, alpha, at, h, l, labels, letter, m, of, seen
from tests.figures.scenery import strokes


def test_coupled_oscillators_are_blocks_between_walls_on_one_floor() -> None:
    found = SKETCHES["coupled"]
    assert len(of(found, BlockMark)) == 2
    assert len(of(found, SpringMark)) == 3
    assert len(of(found, FixedEnd)) == 2
    assert labels(found, DistanceMark) == ["x", "y"]
    floors = of(found, FloorMark)
    assert floors
    assert all(floor.margins == (0.0, 0.0) for floor in floors)


def test_displacements_are_small_and_blocks_do_not_meet() -> None:
    found = SKETCHES["coupled"]
    assert {str(q): value for q, value in found.values} == {"x": a / 4, "y": a / 5}
    left, right = (stroke for stroke in strokes(seen(found, 7.0), "edge"))
    assert max(x for x, _ in left.spots) < min(x for x, _ in right.spots)


def test_a_displacement_is_measured_from_where_the_coordinate_is_zero() -> None:
    first = of(SKETCHES["coupled"], DistanceMark)[0]
    assert at(first.start) == [a, 0]


def test_the_string_of_an_atwood_machine_goes_over_a_wheel_of_its_own_radius() -> None:
    found = SKETCHES["atwood"]
    (rope,), (wheel,) = of(found, RopeMark), of(found, WheelMark)
    assert (wheel.radius, at(wheel.centre)) == (R, [0, 0])
    assert list(rope.radii) == [0, R, 0]
    assert dict(found.values)[R] == l / 5
    assert len(of(found, BarMark)) == 1
    string = strokes(seen(found), "string")[0]
    assert string.spots[0][0] == pytest.approx(string.spots[1][0])  # it hangs straight down


def test_two_on_one_vertical_line_are_drawn_beside_each_other() -> None:
    left, right = of(SKETCHES["one_line"], BlockMark)
    assert at(right.at)[0] - at(left.at)[0] == 2 * at(right.at)[0] != 0


def test_a_string_over_the_edge_of_a_table_is_measured_where_it_hangs() -> None:
    found = SKETCHES["table"]
    (measure,) = of(found, DistanceMark)
    assert (at(measure.start), str(measure.label)) == ([0, 0], "x")
    assert len(of(found, CornerRopeMark)) == 1
    floor = strokes(seen(found), "ground")[0]
    string = strokes(seen(found), "string")[0]
    assert floor.spots[1][0] < max(x for x, _ in string.spots) - 10  # the table ends before the pulley


def test_a_string_over_a_roof_has_both_blocks_on_one_wedge() -> None:
    found = SKETCHES["roof"]
    wedges = of(found, WedgeMark)
    assert len({tuple(map(tuple, wedge.corners)) for wedge in wedges}) <= 2
    top, *feet = wedges[0].corners
    assert at(top) == [0, 0]
    assert (at(feet[0])[1] - at(feet[1])[1]).simplify() == 0
    (rope,) = of(found, CornerRopeMark)
    assert rope.lifts == (BLOCK[1] / 2, BLOCK[1] / 2)
    assert labels(found, AngleBetween) == ["alpha", "beta"]


def test_the_wedge_carries_its_mass_and_reaches_the_height_of_what_carries_it() -> None:
    found = SKETCHES["wedge"]
    (wedge,) = of(found, WedgeMark)
    assert str(wedge.label) == "M"
    top, low, foot = wedge.corners
    x = next(q for q, _ in found.coordinates if q.name == "x")
    assert at(top) == [x, h]
    assert at(low)[1].simplify() == 0
    assert (at(low)[0] - x - h * cos(alpha) / sin(alpha)).simplify() == 0
    assert at(foot)[0] == x
    assert [str(mark.label) for mark in of(found, BlockMark)] == ["m"]
    assert labels(found, DistanceMark) == ["s", "x"]


def test_an_incline_goes_down_past_its_block() -> None:
    (wedge,) = of(SKETCHES["incline"], WedgeMark)
    s = letter("s")
    top, low, _ = wedge.corners
    assert at(top) == [0, 0]
    assert [e.subs({q: s for q in e.free_symbols if q.name == "s"}) for e in at(low)] == [
        Rational(8, 5) * s * cos(alpha),
        -Rational(8, 5) * s * sin(alpha),
    ]


def test_what_a_pendulum_hangs_on_is_a_cart_on_a_floor() -> None:
    found = SKETCHES["cart"]
    assert labels(found, CartMark) == ["M"]
    assert of(found, BlockMark) == []
    wheels = min(y for stroke in strokes(seen(found), "edge") for _, y in stroke.spots)
    assert strokes(seen(found), "ground")[0].spots[0][1] == pytest.approx(wheels)
    assert all(isinstance(piece, Stroke) for piece in strokes(seen(found), "bar"))


def test_what_hangs_on_a_spring_has_no_floor() -> None:
    found = SKETCHES["hanging"]
    assert of(found, FloorMark) == []
    assert labels(found, DistanceMark) == ["y"]


def test_a_depth_beside_a_heavy_pulley_is_measured_outside_of_it() -> None:
    with recorded():
        x, y, phi = coordinate("x", "length"), coordinate("y", "length"), coordinate("phi")
        pulley = Disc(R, m).held(phi, "centre", across="z")
        hanging = Particle(m, point(-R, -x.symbol)), Particle(2 * m, point(R, -y.symbol))
        over = constraint(R * phi.symbol - x.symbol, 0, "S_1"), constraint(-R * phi.symbol - y.symbol, 0, "S_2")
        found = sketch("pulley", System(pulley, *hanging, *over, W))
    assert [mark.aside[0] for mark in of(found, DistanceMark)] == [-1, 1]
