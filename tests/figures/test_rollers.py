"""Circles that roll on straight lines, found in the formulas of places alone."""

from __future__ import annotations

from typing import Any

from sympy import Expr, cos, pi, sin, symbols

from derive.algebra.expressions import scalar
from derive.figures import sketch
from derive.figures.annotations import LengthMark, Line
from derive.figures.parts import WheelMark
from derive.figures.rollers import Roller, roller_of, roller_with
from derive.figures.surroundings import FloorMark, GroundMark, WayMark
from derive.mechanics import Disc, Particle, RigidBody, System, coordinate, point, rolling_constraint, weight
from derive.steps.record import recorded
from tests.figures.machines import of

M, m, I, R, a, g, alpha = symbols("M m I R a g alpha", positive=True)
W = weight(g)


def places(roller: Roller | None) -> list[Expr]:
    assert roller is not None
    return [*roller.hub.components, *roller.foot.components, roller.radius]


def loaded(sense: int = 1) -> System:
    phi = coordinate("phi")
    body = RigidBody(M, I).placed(-sense * phi, point(R * phi - a * sin(phi), R - a * cos(phi)))
    return System(body, W)


def on_a_slope(*more: Any) -> System:
    s, phi = coordinate("s", "length"), coordinate("phi")
    c, n = cos(alpha), sin(alpha)
    body = RigidBody(M, I).placed(-phi, point(s * c + R * n, -s * n + R * c))
    return System(body, W, *rolling_constraint(body, point(s * c, -s * n), "F"), *more)


def test_a_loaded_cylinder_touches_the_table_under_its_axis() -> None:
    """Landau and Lifshitz, Mechanics, section 32, problem 5: its axis goes R phi as it turns by phi."""
    with recorded():
        system, phi = loaded(), scalar("phi")
        found = roller_of(system, system.bodies[0])
        assert places(found) == [R * phi, R, R * phi, 0, R]


def test_what_goes_round_against_the_turning_of_its_body_is_no_point_of_it() -> None:
    with recorded():
        system = loaded(-1)
        assert roller_of(system, system.bodies[0]) is None


def test_what_turns_the_other_way_rolls_under_a_ceiling() -> None:
    with recorded():
        phi = coordinate("phi")
        system = System(RigidBody(M, I).placed(phi, point(R * phi, R)))
        assert places(roller_of(system, system.bodies[0]))[2:] == [R * scalar("phi"), 2 * R, R]


def test_a_condition_of_rolling_says_how_large_a_round_body_is() -> None:
    with recorded():
        system, s = on_a_slope(), scalar("s")
        assert places(roller_of(system, system.bodies[0]))[2:] == [s * cos(alpha), -s * sin(alpha), R]


def test_what_turns_as_it_likes_rolls_on_nothing() -> None:
    with recorded():
        x, phi = coordinate("x", "length"), coordinate("phi")
        system = System(RigidBody(M, I).placed(-phi, point(x, R)), W)
        assert roller_of(system, system.bodies[0]) is None
        assert sketch("system", system) is None


def test_a_cycloid_is_the_curve_of_a_point_on_a_circle_that_rolls_below_a_line() -> None:
    """Landau and Lifshitz, Mechanics, section 11: the line is 2 a above the lowest point."""
    with recorded():
        phi = coordinate("phi")
        bead = Particle(m, point(a * (phi + sin(phi)), a * (1 - cos(phi))))
        found = roller_with(System(bead, W), bead)
        assert found is not None and found[1].length == a
        q = scalar("phi")
        assert places(found[0]) == [a * q, a, a * q, 2 * a, a]
        drawn = sketch("system", System(bead, W))
        assert drawn is not None and [mark.pen for mark in of(drawn, WayMark)] == ["wire", "trace", "trace"]


def test_a_bead_on_a_wave_is_carried_by_no_circle() -> None:
    with recorded():
        x = coordinate("x", "length")
        bead = Particle(m, point(x, a * cos(2 * pi * x / R)))
        assert roller_with(System(bead, W), bead) is None


def test_how_far_a_round_body_has_come_is_told_beside_its_slope() -> None:
    with recorded():
        found = sketch("system", on_a_slope())
        assert found is not None
        assert [(mark.label, mark.name) for mark in of(found, WheelMark)] == [(R, "round_body")]
        assert [str(mark.label) for mark in of(found, LengthMark)] == ["s"]
        assert len(of(found, GroundMark)) == 1


def test_a_yo_yo_has_its_depth_beside_it() -> None:
    with recorded():
        y, phi = coordinate("y", "length"), coordinate("phi")
        disc = Disc(R, M).placed(-phi, point(R, -y), across="z")
        found = sketch("system", System(disc, W, *rolling_constraint(disc, point(0, -y), "S")))
        assert found is not None
        assert [str(mark.label) for mark in of(found, LengthMark)] == ["y"]


def test_the_centre_of_mass_of_a_loaded_cylinder_is_seen_in_it() -> None:
    with recorded():
        found = sketch("system", loaded())
        assert found is not None
        assert [mark.label for mark in of(found, Line)] == [a]
        assert len(of(found, FloorMark)) == 1
        assert dict(found.values)[a] == 3 * R / 5
