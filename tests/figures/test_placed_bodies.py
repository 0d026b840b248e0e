"""Tests of the outlines of bodies at their places, with their rotations, sizes and supports."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, sin
from typing import Any

import pytest
from sympy import ImmutableDenseMatrix, Integer, Symbol, sqrt
from sympy import cos as cosine
from sympy import sin as sine

from derive.figures import drawing, sketch
from derive.figures.annotations import LargePoint
from derive.figures.marks import Mark
from derive.figures.parts import ConnectionMark, WheelMark
from derive.figures.placed_bodies import SilhouetteMark, ThickBar, placed_marks, placed_outline
from derive.figures.surfaces import Cavity, Circle, Hole, Polyhedron, Revolved
from derive.figures.surroundings import AngleBetween, FixedEnd
from derive.mechanics import (
    Annulus,
    Ball,
    Composite,
    Cuboid,
    Cylinder,
    Disc,
    HalfCylinder,
    Particle,
    Rod,
    System,
    coordinate,
    minus,
    point,
    weight,
)
from derive.mechanics.bodies.regions import Point
from derive.mechanics.kinematics.places import Location
from derive.render.drawing.camera import Numbers
from derive.render.drawing.picture import picture
from derive.steps.record import recorded
from tests.figures.machines import M, R, a, hung, l, letter, m
from tests.figures.scenery import strokes

theta = Symbol("theta", real=True)


@dataclass(frozen=True)
class Placed:
    body: Any
    point: Point
    at: Location
    turned: Any = 0
    across: int | None = None
    rim: Any = None

    def seen_in_space(self, arm: ImmutableDenseMatrix) -> Location:
        if self.across is None:
            return Location(tuple(arm))
        j, k = (self.across + 1) % 3, (self.across + 2) % 3
        c, s = cosine(self.turned), sine(self.turned)
        return Location((arm[j] * c - arm[k] * s, arm[j] * s + arm[k] * c))

    @property
    def is_plane(self) -> bool:
        return self.across is not None

    @property
    def centre(self) -> Location:
        return self.at + self.seen_in_space(self.body.middle.position - self.point.position)


def of_middle(body: Any, at: Location, turned: Any = 0, across: int | None = None) -> Placed:
    return Placed(body, body.middle, at, turned, across)


def numbers(column: Any, **values: float) -> tuple[float, ...]:
    return Numbers({a: 1.0, R: 1.0, l: 1.0, **{letter(name): v for name, v in values.items()}}).vector(column)


def test_a_block_in_a_plane_is_turned_by_its_angle() -> None:
    placed = of_middle(Cuboid((a, 2 * a, 3 * a), M), point(l, 0), theta, across=2)
    (mark,) = placed_outline(placed)
    assert isinstance(mark, SilhouetteMark)
    spots = {tuple(round(x, 9) for x in numbers(corner, theta=0.5)[:2]) for corner in mark.corners}
    expected = {
        (round(1 + x * cos(0.5) - y * sin(0.5), 9), round(x * sin(0.5) + y * cos(0.5), 9))
        for x in (-0.5, 0.5)
        for y in (-1.0, 1.0)
    }
    assert spots == expected


def test_a_disc_in_a_plane_is_a_wheel_with_a_pointer() -> None:
    (mark,) = placed_outline(of_middle(Disc(R, M), point(l, R), theta, across=2))
    assert isinstance(mark, WheelMark)
    assert mark.radius == R
    assert list(mark.pointer) == [cosine(theta), sine(theta)]
    told = mark.in_words()
    assert (told[0], told[1]["measures"]) == ("body", (("radius", R),))


@pytest.mark.parametrize("across", [0, 1])
def test_a_rod_in_a_plane_is_a_thick_line_of_its_length(across: int) -> None:
    (mark,) = placed_outline(of_middle(Rod(2 * l, M), point(0, 0), theta, across))
    assert isinstance(mark, ThickBar)
    (x, y, _), (u, v, _) = (numbers(end, theta=0.7) for end in (mark.start, mark.end))
    assert hypot(u - x, v - y) == pytest.approx(2)


def test_bodies_in_space_are_surfaces_at_their_places() -> None:
    (block,) = placed_outline(of_middle(Cuboid((a, a, a), M), point(0, 0, l)))
    (disc,) = placed_outline(of_middle(Disc(R, M), point(0, 0, l)))
    assert isinstance(block, Polyhedron)
    assert isinstance(disc, Revolved)
    assert {numbers(corner)[2] for corner in block.corners} == {0.5, 1.5}
    assert list(disc.through) == [0, 0, l]


def test_a_body_of_which_only_its_moments_are_known_has_no_outline() -> None:
    @dataclass(frozen=True)
    class Unshaped:
        mass: Any

    assert placed_outline(Placed(Unshaped(M), Point("point", ImmutableDenseMatrix([0, 0, 0])), point(0, 0))) == []


def test_a_physical_pendulum_hangs_on_a_pivot_at_its_angle() -> None:
    with recorded():
        angle = coordinate("theta")
        system = System(Particle(m, hung(l, angle)))
        rod = Rod(2 * l, M)
        end = Point("end", rod.middle.position + ImmutableDenseMatrix([0, 0, l]))
        marks = list(placed_marks(system, Placed(rod, end, point(0, 0), angle.symbol, 0)))
        found = drawing("one", *marks)
    kinds: list[type[Mark]] = [type(mark) for mark in marks]
    assert kinds == [ThickBar, LargePoint, FixedEnd, AngleBetween]
    turned = marks[-1]
    assert isinstance(turned, AngleBetween)
    assert turned.label == angle.symbol
    assert list(turned.a) == [0, -1]
    pieces = picture(found, Numbers({l: 1.0, angle.symbol: 0.5}), 5.0, 4.2)
    assert len(strokes(pieces, "angle")) == 1


def test_a_bar_that_is_not_held_has_its_angle_at_its_end() -> None:
    with recorded():
        angle = coordinate("theta")
        middle = point(l / 2 * cosine(angle), l / 2 * sine(angle))
        system = System(Particle(m, middle))
        marks = list(placed_marks(system, of_middle(Rod(l, M), middle, angle.symbol, across=1)))
    (mark,) = (mark for mark in marks if isinstance(mark, AngleBetween))
    assert mark.label == angle.symbol


def test_a_hole_in_a_disc_is_drawn_and_the_pointer_leads_to_the_centre_of_mass() -> None:
    holed = Composite(Disc(R, M), minus(Disc(R / 3, M / 9).named("hole").at(0, R / 2, 0)))
    with recorded():
        angle = coordinate("theta")
        placed = holed.held(angle, (0, 0, 0), point(0, 0), across="z")
        disc, hole = placed_outline(placed)
        (turned,) = (mark for mark in placed_marks(System(placed), placed) if isinstance(mark, AngleBetween))
    assert isinstance(disc, WheelMark) and isinstance(hole, Hole) and isinstance(hole.of, WheelMark)
    assert numbers(hole.of.centre, theta=0.0)[:2] == pytest.approx((0, 0.5))
    x, y, _ = numbers(disc.pointer, theta=0.0)
    assert x == pytest.approx(0) and y < 0
    assert hypot(*numbers(turned.b, theta=0.3)) == pytest.approx(1)  # the arc is visible although the centre is near


def test_in_space_a_cavity_is_dashed_and_what_has_a_bore_is_not_drawn() -> None:
    cavity, bore = minus(Ball(R / 2, M / 8).named("hole")), minus(Cylinder(R / 4, R / 2, M / 9).named("hole"))
    found = placed_outline(of_middle(Composite(Ball(R, M), cavity), point(0, 0, 0)))
    assert [type(mark) for mark in found] == [Revolved, Cavity]
    assert placed_outline(of_middle(Composite(Ball(R, M), bore), point(0, 0, 0))) == []


def test_a_ring_in_a_plane_is_a_disc_with_a_hole() -> None:
    rim, hole = placed_outline(of_middle(Annulus(R / 2, R, M), point(0, 0), theta, across=2))
    assert isinstance(rim, WheelMark) and isinstance(hole, Hole) and isinstance(hole.of, WheelMark)
    assert (rim.radius, hole.of.radius) == (R, R / 2)
    assert placed_outline(of_middle(Annulus(R / 2, R, M), point(0, 0), theta, across=0)) == []


@pytest.mark.parametrize(("across", "shown"), [("y", Circle), ("x", ConnectionMark)])
def test_a_rod_whose_middle_goes_round_is_drawn_there(across: str, shown: type[Mark]) -> None:
    with recorded():
        angle = coordinate("theta")
        size = sqrt(R**2 - l**2 / 4)
        middle = point(size * sine(angle), -size * cosine(angle))
        found = sketch("rod", System(Rod(l, M).placed(angle, middle, across=across), weight(letter("g"))))
    assert found is not None
    assert any(isinstance(mark, shown) for mark in found.marks)
    assert any(isinstance(mark, Circle) for mark in found.marks) == (shown is Circle)


def test_a_half_cylinder_seen_along_its_axis_is_half_a_disc() -> None:
    (mark,) = placed_outline(HalfCylinder(R, l, M).held(Integer(0), "circle_centre", point(0, 0), across="z"))
    assert isinstance(mark, SilhouetteMark)
    corners = [numbers(corner)[:2] for corner in mark.corners]
    assert all(y >= -1e-9 and hypot(x, y) <= 1 + 1e-9 for x, y in corners)
    assert max(y for _, y in corners) == pytest.approx(1)
