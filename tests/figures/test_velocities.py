"""Tests of drawn velocities, impulses and points of impact."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from sympy import Integer, Matrix, cos, pi, sin, symbols

from derive.algebra.expressions import scalar
from derive.figures import sketch
from derive.figures.annotations import Arrow, Axis, LengthMark
from derive.figures.ghosts import Ghost, HollowParticle
from derive.figures.marks import Drawing
from derive.figures.modes import DisplacementArrow
from derive.figures.parts import BlockMark, ConnectionMark, ParticleMark
from derive.figures.pieces import Stroke
from derive.figures.surroundings import AngleBetween, DistanceMark, FloorMark
from derive.figures.velocities import Moment
from derive.mechanics import Ball, Particle, Rod, System, coordinate, point, weight
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from derive.steps.record import recorded
from tests.courses import library_drawings
from tests.figures.machines import labels, of, seen
from tests.figures.test_connected import drawings, library
from tests.stock.described import complaints, edited

M, m, R, l, b, v, g, h, J, alpha = symbols("M m R l b v g h J alpha", positive=True)
a, phi = symbols("a", positive=True), symbols("phi", real=True)
ZERO = Integer(0)


def thrown(x_rate: Any, y_rate: Any) -> Drawing | None:
    with recorded():
        x, y = coordinate("x", "length"), coordinate("y", "length")
        system = System(Particle(m, point(x, y)), weight(g))
        start = {x.symbol: ZERO, y.symbol: ZERO}
        return sketch("system", system, start=Moment(start, {x.symbol: x_rate, y.symbol: y_rate}))


def test_a_projectile_starts_with_its_speed_at_its_angle() -> None:
    """Taylor, Classical Mechanics, section 2.3. The components are v_0 cos(alpha) and v_0 sin(alpha)."""
    found = thrown(v * cos(alpha), v * sin(alpha))
    assert found is not None
    (arrow,) = of(found, Arrow)
    assert (arrow.label, list(arrow.start)) == (v, [0, 0])
    assert labels(found, AngleBetween) == ["alpha"]


def test_what_is_thrown_straight_up_has_no_angle() -> None:
    found = thrown(ZERO, v)
    assert found is not None
    assert labels(found, Arrow) == ["v"] and not of(found, AngleBetween)


def test_what_is_let_go_has_no_arrow() -> None:
    found = thrown(ZERO, ZERO)
    assert found is not None and not of(found, Arrow)


def shot() -> Drawing | None:
    with recorded():
        x, theta = coordinate("x", "length"), coordinate("theta")
        rod = Rod(l, M).held(theta + pi, "end", point(0, 0))
        hole = point(b * sin(theta), -b * cos(theta))
        system = System(Particle(m, point(x, -b)), rod)
        at = {x.symbol: ZERO, theta.symbol: ZERO}
        return sketch("system", system, impact=Moment(at, {x.symbol: v}, (), (system.particles[0].at, hole)))


def test_a_bullet_comes_flying_from_before_the_rod_that_hangs() -> None:
    """Kleppner and Kolenkow, An Introduction to Mechanics, section 6.8."""
    found = shot()
    assert found is not None
    assert labels(found, Arrow) == ["v"] and labels(found, LengthMark) == ["b"] and labels(found, ParticleMark) == ["m"]
    assert not of(found, FloorMark) and not of(found, BlockMark)
    assert not of(found, DistanceMark)
    values = dict(found.values)
    assert values[scalar("x")] == -b and values[scalar("theta")] == 0 and values[b] == 3 * l / 4


def struck(components: tuple[Any, Any]) -> Drawing | None:
    with recorded():
        x, phi = coordinate("x", "length"), coordinate("phi")
        system = System(Ball(R, M).placed(-phi, point(x, R)))
        at = point(x + (h - R) * sin(phi), R + (h - R) * cos(phi))
        impact = Moment({phi.symbol: ZERO}, {}, ((point(*components), at),))
        return sketch("system", system, impact=impact)


def test_a_given_impulse_ends_where_it_acts() -> None:
    found = struck((J, ZERO))
    assert found is not None
    (arrow,) = of(found, Arrow)
    assert arrow.pushes and arrow.label == J and Matrix(arrow.value) == Matrix([J, 0])
    (line,) = [piece for piece in seen(found) if isinstance(piece, Stroke) and piece.pen == "given"]
    assert line.spots[0][0] < line.spots[-1][0] and line.head
    assert labels(found, LengthMark) == ["h"]


def test_an_impulse_to_the_left_comes_from_the_right() -> None:
    found = struck((-J, ZERO))
    assert found is not None
    (line,) = [piece for piece in seen(found) if isinstance(piece, Stroke) and piece.pen == "given"]
    assert line.spots[0][0] > line.spots[-1][0]


def test_the_coordinates_that_are_zero_at_an_impact_are_shown_by_dashed_bodies(tmp_path: Path) -> None:
    found = shot()
    assert found is not None
    (angle,) = of(found, AngleBetween)
    (rod,) = of(found, ConnectionMark)
    assert angle.label == scalar("theta") and not angle.b.free_symbols & {scalar("theta")}
    assert Matrix(rod.end)[0].subs(l, 1) > 0.1  # on the right, in the positive sense of the angle
    ball = drawings(tmp_path / "ball", library("cue_ball"))["system"]
    assert len(of(ball, Ghost)) == 1 and {"h", "x"} <= set(map(str, labels(ball, LengthMark)))
    rods = drawings(tmp_path / "rods", library("struck_pair"))["system"]
    assert set(map(str, labels(rods, AngleBetween))) == {"theta", "phi"}
    assert list(map(str, labels(rods, LengthMark))) == ["y"]


def test_the_state_just_after_an_impact_is_drawn_on_request(tmp_path: Path) -> None:
    """The left rod rotates clockwise, and the right rod rotates counterclockwise. The total momentum is J."""
    text = library("struck_pair")
    after = drawings(tmp_path / "drawn", text)["after"]
    left, right = of(after, DisplacementArrow)
    assert [Matrix(arrow.value)[1] for arrow in (left, right)] == [-J / 4 / m, 5 * J / 4 / m]
    assert len(of(after, ConnectionMark)) == 2
    assert "after" not in drawings(tmp_path / "not", re.sub(r"  after:\n(    .*\n)+", "", text))
    wrong = library("simple_pendulum").replace("drawings:\n", "drawings:\n  after: {at: a}\n", 1)
    assert any("needs an impact" in each.message for each in complaints(tmp_path / "wrong", wrong))


def test_two_particles_on_a_line_have_an_axis_with_the_common_name_of_their_coordinates(tmp_path: Path) -> None:
    assert list(map(str, labels(drawings(tmp_path, library("two_balls"))["system"], Axis))) == ["x"]


def test_no_impact_is_drawn_without_what_acts() -> None:
    assert struck((ZERO, ZERO)) is None


@pytest.mark.parametrize(
    ("name", "outline", "start"),
    [
        pytest.param("slack_pendulum", HollowParticle, ["0", "-l"], marks=pytest.mark.long),
        pytest.param("pushed_off_sphere", HollowParticle, ["0", "R"], marks=pytest.mark.long),
        ("sliding_to_rolling", Ghost, ["0", "a"]),
    ],
)
def test_the_start_of_a_guided_motion_has_its_velocity_and_a_hollow_outline(
    name: str, outline: type[Any], start: list[str]
) -> None:
    """The rest of the drawing shows a later state, so the particle or the ball at the start is hollow or dashed."""
    found = library_drawings(name)["system"]
    (arrow,) = of(found, Arrow)
    assert str(arrow.label) == "v_0" and arrow.value[1] == 0 and list(map(str, arrow.start)) == start
    assert len(of(found, outline)) == 1


def test_a_block_on_a_floor_has_no_second_outline() -> None:
    found = library_drawings("block_on_plank")["system"]
    assert not of(found, HollowParticle) and not of(found, Ghost)


def test_the_distance_of_a_blow_from_a_hinge_is_drawn() -> None:
    assert "b" in labels(library_drawings("struck_rods")["system"], LengthMark)


def test_the_distance_of_two_supports_is_drawn_on_the_side_away_from_the_masses() -> None:
    found = library_drawings("upright_pendulums")["system"]
    line = next(mark for mark in of(found, LengthMark) if str(mark.label) == "d")
    assert list(line.aside) == [0, -1]


def test_an_angle_that_rolling_relates_to_another_is_drawn_with_its_positive_sense(tmp_path: Path) -> None:
    found = drawings(tmp_path, edited(library("cylinder_inside"), ("    without: [psi]\n    marks", "    marks")))[
        "system"
    ]
    angle = next(mark for mark in of(found, AngleBetween) if str(mark.label) == "psi")
    assert angle.growing is not None and list(angle.a) == [1, 0]
    pieces = angle.pieces(OnPaper(Numbers({phi: 0.6, a: 1.0, b: 0.7}), FLAT))
    arc = next(piece for piece in pieces if isinstance(piece, Stroke) and piece.pen == "angle")
    assert arc.tail and not arc.head  # the cylinder has turned clockwise, but psi is positive counterclockwise


@pytest.mark.long
def test_the_coordinates_of_a_flight_have_axes() -> None:
    for name in ("slack_pendulum", "off_a_sphere"):
        found = library_drawings(name)["system"]
        assert [str(mark.label) for mark in of(found, Axis)] == ["x", "y"]
    assert not of(library_drawings("pushed_off_sphere")["system"], Axis)
