"""Tests of drawn rotations: rods on pivots, rotating wires, and angles in the plane and in space."""

from __future__ import annotations

import pytest
from sympy import ImmutableDenseMatrix, cos, sin

from derive.algebra.expressions import TIME
from derive.figures.annotations import AxisOfRotation
from derive.figures.parts import BarMark, ConnectionMark, ParticleMark
from derive.figures.pieces import Stroke
from derive.figures.surroundings import AngleBetween, DistanceMark, FixedEnd, MovingEnd, WayMark
from derive.figures.turning import downwards, moving_end
from derive.mechanics import point
from derive.mechanics.kinematics.places import Location
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from derive.render.drawing.picture import picture
from tests.courses import library_drawings
from tests.figures.machines import SKETCHES, SYSTEMS, a, at, labels, of, omega


def test_a_double_pendulum_has_two_rods_two_angles_and_one_pivot() -> None:
    found = SKETCHES["double"]
    assert labels(found, BarMark) == ["l_1", "l_2"]
    assert labels(found, AngleBetween) == ["theta", "phi"]
    assert labels(found, ParticleMark) == ["m_1", "m_2"]
    assert [at(each.at) for each in of(found, FixedEnd)] == [[0, 0]]
    assert at(of(found, AngleBetween)[1].vertex) == list(SYSTEMS["double"].particles[0].at.components)


@pytest.mark.parametrize("name", ["pendulum", "double", "cart"])
def test_angles_are_counted_from_the_downward_vertical(name: str) -> None:
    assert all(at(mark.a) == [0, -1] for mark in of(SKETCHES[name], AngleBetween))
    assert at(downwards(3)) == [0, 0, -1]


@pytest.mark.parametrize(("joint", "height", "side"), [(True, -1, 1), (True, 1, -1), (False, -1, 1), (False, 1, 0)])
def test_no_rod_or_string_passes_through_the_hatches_of_its_support(joint: bool, height: int, side: int) -> None:
    """The hatches are on the side away from the bob. A string to a bob above its support ends at a bare peg."""
    held = ImmutableDenseMatrix([1, height])
    pieces = FixedEnd(0 * held, downwards(2), joint, held).pieces(OnPaper(Numbers({}), FLAT))
    hatches = [piece.spots for piece in pieces if isinstance(piece, Stroke) and piece.pen == "hatch"]
    assert bool(hatches) == bool(side) and all(side * end[1] > 0 for _, end in hatches)


def test_the_supports_of_upright_pendulums_are_below_them() -> None:
    for drawing in library_drawings("upright_pendulums").values():
        pieces = picture(drawing, Numbers({}), 5.0, 4.2)
        grounds = [piece.spots[0][1] for piece in pieces if isinstance(piece, Stroke) and piece.pen == "ground"]
        ends = [
            spot[1] for piece in pieces if isinstance(piece, Stroke) and piece.pen == "hatch" for spot in piece.spots
        ]
        assert len(grounds) == 2 and max(ends) <= max(grounds) + 1e-6


def test_a_support_that_moves_on_a_circle_has_no_ground_but_the_radius_of_the_circle() -> None:
    found = SKETCHES["crank"]
    assert [at(each.away) for each in of(found, FixedEnd)] == [[0, 0]]
    assert labels(found, ConnectionMark) == ["a"]


def test_a_support_that_is_shaken_shows_how_far_it_has_moved() -> None:
    assert [str(each) for each in labels(SKETCHES["driven"], DistanceMark)] == ["a*cos(omega*t)"]


def test_a_support_that_is_shaken_is_a_slider_with_a_double_arrow() -> None:
    """A fixed hinge on hatched ground would be wrong."""
    found = SKETCHES["driven"]
    (end,) = of(found, MovingEnd)
    assert not of(found, FixedEnd) and end.joint and end.is_to_and_fro and end.in_words()[0] == "moving_end"
    pieces = end.pieces(OnPaper(Numbers({}), FLAT))
    (arrow,) = (piece for piece in pieces if isinstance(piece, Stroke) and piece.head and piece.tail)
    (rail,) = (piece for piece in pieces if isinstance(piece, Stroke) and piece.pen == "ground")
    assert arrow.spots[0][1] == arrow.spots[1][1] > rail.spots[0][1] == rail.spots[1][1]


@pytest.mark.parametrize(("place", "along", "both"), [
    (point(0, a * TIME**2 / 2), [0, 1], False), (point(0, -a * TIME), [0, -1], False),
    (point(0, a * cos(omega * TIME)), [0, 1], True), (point(a * TIME, 2 * a * TIME), [1, 2], False),
])  # fmt: skip
def test_a_support_that_moves_in_one_sense_has_one_arrowhead(place: Location, along: list[int], both: bool) -> None:
    (end, *more) = moving_end(SYSTEMS["driven"], place, True)
    assert (at(end.along), end.is_to_and_fro, len(more)) == (along, both, 0 if 0 not in along else 1)


def test_a_support_on_a_circle_or_at_rest_has_no_slider() -> None:
    there = point(a * cos(omega * TIME), a * sin(omega * TIME))
    assert [*moving_end(SYSTEMS["driven"], there, True), *moving_end(SYSTEMS["driven"], point(a, 0), True)] == []


def test_the_driven_end_of_a_spring_is_a_plate() -> None:
    system = SYSTEMS["driven"]
    (plate, _) = moving_end(system, point(a * cos(omega * TIME), 0), False)
    (line,) = (p for p in plate.pieces(OnPaper(Numbers({}), FLAT)) if isinstance(p, Stroke) and p.pen == "bar")
    assert line.spots[0][0] == line.spots[1][0]


def test_a_spring_that_swings_has_its_length_beside_it() -> None:
    found = SKETCHES["elastic"]
    assert (labels(found, DistanceMark), of(found, BarMark), of(found, ConnectionMark)) == (["r"], [], [])


def test_a_bead_on_a_hoop_that_is_carried_round_is_on_a_wire_with_its_axis() -> None:
    found = SKETCHES["hoop"]
    (wire,) = of(found, WayMark)
    assert (wire.pen, str(wire.letter)) == ("wire", "theta")
    assert [axis.rate for axis in of(found, AxisOfRotation)] == [omega]


def test_a_bead_on_a_turning_rod_is_on_a_wire_at_its_angle() -> None:
    found = SKETCHES["turning_rod"]
    assert [(mark.pen, str(mark.letter)) for mark in of(found, WayMark)] == [("wire", "r")]
    assert labels(found, AngleBetween) == ["omega*t"]


def test_a_pendulum_in_space_has_the_angle_of_its_shadow() -> None:
    found = SKETCHES["spherical"]
    assert labels(found, AngleBetween) == ["theta", "phi"]
    shadow = of(found, AngleBetween)[1]
    assert (at(shadow.a), at(shadow.b)[2]) == ([1, 0, 0], 0)
