"""Diagrams of the forces on bodies: their common scale, axles of pulleys, and surfaces under particles."""

from __future__ import annotations

from dataclasses import replace
from math import dist, pi, tan
from pathlib import Path

import pytest
from sympy import Rational

from derive.errors import DeriveError
from derive.figures.annotations import FORCE, ForceArrow, PositiveDirection, PositiveRotation
from derive.figures.forces import ALONG, LONGER, VISIBLE
from derive.figures.parts import WHEEL, BarMark, WheelMark
from derive.figures.pieces import Patch, Stroke
from derive.figures.surroundings import SurfacePiece
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from derive.render.drawing.picture import picture
from tests.courses import library_drawings
from tests.figures.test_connected import drawings, library, of_class
from tests.stock.described import edited


def test_the_forces_on_all_bodies_have_one_scale(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("movable_pulley"))
    _, pull = of_class(drawn["forces_weight"], ForceArrow)
    _, left, right = of_class(drawn["forces_pulley"], ForceArrow)
    assert pull.size == left.size == right.size


def test_both_pieces_of_a_string_pull_a_small_pulley_at_its_rim(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("movable_pulley"))["forces_pulley"]
    weight, *pulls = of_class(drawn, ForceArrow)
    assert [str(pull.label) for pull in pulls] == ["T", "T"] and {pull.aside for pull in pulls} == {WHEEL, -WHEEL}
    assert weight.aside == 0 and len(of_class(drawn, WheelMark)) == 1


def test_the_strings_of_a_massless_pulley_balance_in_its_diagram(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("atwood_double"))
    *lower, upper = sorted(of_class(drawn["forces_movable"], ForceArrow), key=lambda arrow: arrow.value[1])
    assert [str(each.label) for each in (*lower, upper)] == ["S_2", "S_2", "S_1"]
    assert upper.size == pytest.approx(sum(each.size for each in lower), abs=0.04)
    assert [list(each.value) for each in (*lower, upper)] == [[0, -1], [0, -1], [0, 1]]
    assert {"forces_first", "forces_second", "forces_third"} <= drawn.keys() and "forces_fixed" not in drawn


def test_the_pieces_of_a_rope_are_drawn_alone(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("rope_over_edge"))
    weight, normal, pull = of_class(drawn["forces_rope_1"], ForceArrow)
    assert weight.size == normal.size and str(normal.label) == "N" and list(pull.value) == [1, 0]
    weight, pull = of_class(drawn["forces_rope_2"], ForceArrow)
    assert str(weight.label) == "M*g*x/l" and list(pull.value) == [0, 1] and pull.size < weight.size


def test_a_tension_has_one_symbol(tmp_path: Path) -> None:
    twice = edited(library("atwood"), ("tension: S}", "tension: S, drawn_tension: T}"))
    with pytest.raises(DeriveError, match="has no effect"):
        drawings(tmp_path, twice)


def test_a_block_has_no_diagram_if_the_force_of_its_guide_is_unknown(tmp_path: Path) -> None:
    """The coordinates keep the block on a wedge, and the load beside the wedge; no contact is described."""
    text = """\
title: A movable wedge
solve: system
symbols: {m: mass, M: mass, h: length, g: acceleration, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {X: length, s: length}
  particles:
    wedge: {mass: M, at: [X, 0]}
    block: {mass: m, at: [X + s*cos(alpha), -s*sin(alpha)]}
    load: {mass: m, at: [X, s - h]}
  gravity: g
  strings: {from: block, to: load, over: [wedge], drawn_tension: S}
statement: A block and a load.
parts:
  - ask: Find the equations of motion.
    answer: equations_of_motion
"""
    assert [*drawings(tmp_path, text)] == ["system"]


def test_an_axle_balances_the_strings_and_the_weight_of_a_pulley() -> None:
    weight, *strings, axle = of_class(library_drawings("atwood_disc")["forces_pulley"], ForceArrow)
    assert list(axle.value) == [0, 1] and axle.label == weight.label + strings[0].label + strings[1].label
    assert len(strings) == 2 and axle.size == pytest.approx(weight.size + strings[0].size + strings[1].size, abs=0.1)


def test_small_forces_are_drawn_longer_with_all_others() -> None:
    weight, normal = of_class(library_drawings("parabolic_hill")["forces_particle"], ForceArrow)
    assert 1 < weight.size <= 2 and normal.size < weight.size


def test_the_friction_on_a_cylinder_is_as_long_as_the_shortest_visible_arrow() -> None:
    *_, friction = of_class(library_drawings("rough_cylinder")["forces_cylinder"], ForceArrow)
    assert str(friction.label) == "F" and friction.size >= VISIBLE


def test_a_plank_on_a_floor_is_drawn_level(tmp_path: Path) -> None:
    text = """\
title: A plank
solve: system
symbols: {M: mass, l: length, g: acceleration}
given:
  coordinates: {y: length, theta: angle}
  bodies: {plank: {shape: rod, length: l, mass: M, centre: [0, y], along: [cos(theta), sin(theta)]}}
  surfaces: {floor: {through: [0, 0], along: [1, 0]}}
  contacts: [{of: plank.end, on: floor, normal: A}, {of: plank.far_end, on: floor, normal: B}]
  gravity: g
statement: A plank.
parts: [{ask: Find the forces., answer: equilibria}]
"""
    drawn = drawings(tmp_path, text)["forces_plank"]
    assert {str(q): value for q, value in drawn.values}["theta"] == 0
    _, one, other = of_class(drawn, ForceArrow)
    assert one.size == other.size


def test_the_surface_is_drawn_under_a_particle_with_a_normal_force() -> None:
    drawn = library_drawings("block_on_incline")["forces_block"]
    (surface,) = of_class(drawn, SurfacePiece)
    pieces = surface.pieces(OnPaper(Numbers({}), FLAT))
    (x, y), (u, v) = pieces[0].spots
    assert (v - y) / (u - x) == pytest.approx(-tan(pi / 5)) and len(pieces) > 3
    assert surface.in_words() == ("surface", {})
    rail = replace(surface, is_two_sided=True)
    assert len(rail.pieces(OnPaper(Numbers({}), FLAT))) == 1


def test_the_force_diagram_of_a_particle_has_lengths_in_points() -> None:
    drawing = library_drawings("parabolic_hill")["forces_particle"]
    weight, _ = of_class(drawing, ForceArrow)
    strokes = [piece for piece in picture(drawing, Numbers({}), 5.0, 4.2) if getattr(piece, "pen", "") == "given"]
    assert max(dist(*stroke.spots) for stroke in strokes) == pytest.approx(float(weight.size) * FORCE, abs=0.1)


def test_a_pulley_with_a_horizontal_string_has_no_diagram_because_its_axle_force_is_not_vertical(
    tmp_path: Path,
) -> None:
    """Without the horizontal component of the axle force, the diagram would be false."""
    text = library("atwood_disc").split("limits:")[0]
    start, end = text.index("wording:"), text.index("parts:")
    plain = text[:start] + text[end:].replace("answer: [light_x, light]", "answer: accelerations").split("drawings:")[0]
    assert "forces_pulley" in drawings(tmp_path / "vertical", plain)
    assert "forces_pulley" not in drawings(tmp_path / "horizontal", edited(plain, ("at: [R, -y]", "at: [y, R]")))


def test_the_forces_on_a_round_body_are_longer_than_its_radius_and_its_surface_is_drawn() -> None:
    """The tip of the weight is outside the disc, and no arrow is so short that its head covers it."""
    drawing = library_drawings("disc_incline")["forces_disc"]
    pieces = picture(drawing, Numbers({}), 5.0, 4.2)
    disc = next(piece.spots for piece in pieces if isinstance(piece, Patch))
    radius = (max(x for x, _ in disc) - min(x for x, _ in disc)) / 2
    lengths = [dist(*piece.spots) for piece in pieces if isinstance(piece, Stroke) and piece.pen == "given"]
    assert 2 * radius < max(lengths) <= LONGER * FORCE + 0.1
    assert min(lengths) > 20
    (surface,) = of_class(drawing, SurfacePiece)
    assert len([piece for piece in pieces if isinstance(piece, Stroke) and piece.pen == "hatch"]) > 5
    assert surface.below == 0


def test_all_forces_on_a_ball_on_a_floor_act_on_one_line_through_the_contact() -> None:
    """A shifted normal force would seem to have a torque about the centre, and a shifted friction about the contact."""
    drawing = library_drawings("sliding_to_rolling")["forces_ball"]
    pieces = picture(drawing, Numbers({}), 5.0, 4.2)
    weight, normal, friction = (p.spots for p in pieces if isinstance(p, Stroke) and p.pen == "given")
    (ground,) = (piece.spots for piece in pieces if isinstance(piece, Stroke) and piece.pen == "ground")
    assert friction[0][1] - ground[0][1] == pytest.approx(ALONG) and friction[1][1] == pytest.approx(friction[0][1])
    assert normal[0][0] == pytest.approx(weight[0][0]) == pytest.approx(friction[0][0])
    tip = normal[1][1]
    assert tip == pytest.approx(ground[0][1]) and normal[0][1] < tip < weight[1][1] < weight[0][1]
    assert 1 < ALONG < 5  # both the surface and the friction along it are visible


def test_a_hook_holds_the_axle_of_a_pulley_that_hangs_on_a_string(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("atwood_double"))["system"]
    hanger, hook = of_class(drawn, BarMark)
    wheels = of_class(drawn, WheelMark)
    assert [hanger.start, hook.start] == [wheel.centre for wheel in wheels]
    assert list(hook.end - hook.start) == [0, Rational(9, 5) * wheels[1].radius]


def test_a_diagram_shows_in_which_direction_a_coordinate_and_an_angle_grow() -> None:
    drawn = library_drawings("atwood_disc")
    (down,) = of_class(drawn["forces_left"], PositiveDirection)
    assert (list(down.along), str(down.label)) == ([0, -1], "x")
    (turn,) = of_class(drawn["forces_pulley"], PositiveRotation)
    assert turn.counterclockwise and str(turn.label) == "phi"
    (turn,) = of_class(library_drawings("sliding_to_rolling")["forces_ball"], PositiveRotation)
    assert not turn.counterclockwise
    (stroke, _) = turn.pieces(OnPaper(Numbers({}), FLAT))
    assert isinstance(stroke, Stroke) and stroke.spots[0][0] < stroke.spots[-1][0], "to the right above the centre"


def test_a_figure_leaves_out_the_marks_that_the_problem_names() -> None:
    drawn = library_drawings("cylinder_inside")
    labels = {key: {str(mark.label) for mark in drawn[key].marks} for key in ("system", "rolling")}
    assert "psi" in labels["system"] and "psi" not in labels["rolling"]
