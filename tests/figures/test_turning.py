"""What turns, as a sketch draws it: rods on pivots, wires that are carried round, angles in the plane and in space."""

from __future__ import annotations

import pytest

from derive.figures.annotations import AxisOfRotation
from derive.figures.parts import BarMark, ConnectionMark, ParticleMark
from derive.figures.surroundings import AngleBetween, DistanceMark, FixedEnd, WayMark
from derive.figures.turning import downwards
from tests.figures.machines import SKETCHES, SYSTEMS, at, labels, of, omega


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


def test_a_support_that_is_shaken_shows_how_far_it_has_moved() -> None:
    assert [str(each) for each in labels(SKETCHES["driven"], DistanceMark)] == ["a*cos(omega*t)"]


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
