"""Tests of arrows, arcs, rotation arrows and dimension lines."""

from __future__ import annotations

from math import atan2, degrees, dist, hypot, isclose, pi
from typing import Any

import pytest
from sympy import Rational, Symbol

from derive.algebra.expressions import column
from derive.figures import arc, arrow, axis_of_rotation, drawing, length_mark, outline, point_mark
from derive.figures.annotations import AngleMark, Axis, LengthMark, Turn, measured
from derive.figures.marks import Drawing, Surface
from derive.figures.pieces import Bullet, Stroke, Tag
from derive.figures.space import hull, is_within
from derive.figures.surfaces import Polyhedron
from derive.mechanics import Cuboid
from derive.render.drawing.camera import Numbers, best_stance, stance_from
from derive.render.drawing.hidden_lines import OnPaper
from tests.figures.scenery import NUMBERS, SLAB, M, a, area, heading, pieces_of, plane, strokes, theta, vectors_of_block
from tests.mechanics.block import omega

UP, RIGHT = column(0, 1, 0), column(1, 0, 0)


def seen(found: Drawing, *direction: float) -> float:
    numbers = Numbers(NUMBERS)
    places = [place for mark in found.marks if isinstance(mark, Surface) for place in mark.places(numbers)]
    middle = tuple((min(p[k] for p in places) + max(p[k] for p in places)) / 2 for k in range(3))
    stance = best_stance(found, numbers, max(dist(place, middle) for place in places))
    x, y = (sum(p * q for p, q in zip(direction, way, strict=True)) for way in (stance.right, stance.up))
    return degrees(atan2(y, x))


def test_the_vectors_of_the_block_are_drawn_along_their_true_directions() -> None:
    found = vectors_of_block()
    spin, momentum = strokes(pieces_of(found), "asked")
    assert isclose(heading(spin), seen(found, 1, 2, 3), abs_tol=1e-9)
    assert isclose(heading(momentum), seen(found, 13, 20, 15), abs_tol=1e-9)
    assert abs(heading(spin) - heading(momentum)) > 5


def test_a_vector_reverses_with_its_sign() -> None:
    found = vectors_of_block(rate=-omega)
    assert isclose(heading(strokes(pieces_of(found), "asked")[0]), seen(found, -1, -2, -3), abs_tol=1e-9)


def test_an_angle_in_a_plane_is_as_large_as_its_value() -> None:
    pieces = pieces_of(SLAB, theta=0.5)
    arc = strokes(pieces, "angle")[0]
    centre = next(p.spot for p in pieces if isinstance(p, Bullet))
    start, end = (atan2(y - centre[1], x - centre[0]) for x, y in (arc.spots[0], arc.spots[-1]))
    assert start == pytest.approx(pi / 2)
    assert start - end == pytest.approx(0.5)


def test_parallel_vectors_have_no_arc_between_them() -> None:
    assert strokes(pieces_of(vectors_of_block(sides=(a, a, a))), "angle") == []
    assert len(strokes(pieces_of(vectors_of_block()), "angle")) == 1


def test_a_vector_that_vanishes_is_not_drawn() -> None:
    found = drawing("one", outline(Cuboid((a, a, a), M), named=False), arrow(column(0, 0, 0)), arrow(column(0, 0, a)))
    assert len(strokes(pieces_of(found), "asked")) == 1


def test_a_length_of_zero_has_no_dimension_line() -> None:
    nothing = length_mark(RIGHT, RIGHT, a, UP)
    assert strokes(pieces_of(plane(point_mark(column(0, 0, 0)), point_mark(RIGHT), nothing)), "measure") == []
    assert len(strokes(pieces_of(SLAB), "measure")) == 1


@pytest.mark.parametrize(("along", "sense"), [((0, 0, 1), 1), ((0, 0, -1), -1)])
def test_a_turn_is_right_handed(along: tuple[int, ...], sense: int) -> None:
    """Seen from above, a right-handed rotation about z is counterclockwise."""
    square = Polyhedron(tuple(column(*p, 0) for p in ((0, 0), (4, 0), (4, 4), (0, 4))))
    found = plane(square, Turn(column(2, 2, 0), column(*along), Rational(1, 4)))
    assert area(strokes(pieces_of(found), "turn")[0]) * sense > 0


def test_a_negative_rate_turns_the_other_way() -> None:
    """The viewer is above the plane of x and y, so a rotation about z has the same sense on paper."""
    box = outline(Cuboid((a, a, a), M), named=False)
    areas = []
    for rate in (omega, -omega):
        found = drawing("one", box, axis_of_rotation(column(0, 0, 1), rate=rate))
        areas.append(area(strokes(pieces_of(found), "turn")[0]))
    assert areas[0] > 0 > areas[1]


def test_a_mark_without_a_name_has_no_label() -> None:
    found = plane(point_mark(column(0, 0, 0)), point_mark(RIGHT, Symbol("A")))
    assert [piece.label for piece in pieces_of(found) if isinstance(piece, Tag)] == [Symbol("A")]


def test_an_angle_needs_two_directions() -> None:
    flat = arc(UP, column(0, 0, 0), theta)
    assert isinstance(flat, AngleMark)
    assert strokes(pieces_of(plane(point_mark(RIGHT), point_mark(UP), flat)), "angle") == []
    assert NUMBERS[a] == 1


def test_no_head_of_an_arrow_seems_to_be_at_a_corner() -> None:
    found = vectors_of_block()
    pieces = pieces_of(found)
    tip = strokes(pieces, "asked")[0].spots[-1]
    corners = [spot for stroke in strokes(pieces, "edge") for spot in stroke.spots]
    size = max(hypot(x - u, y - v) for x, y in corners for u, v in corners)
    assert min(hypot(tip[0] - x, tip[1] - y) for x, y in corners) > 0.05 * size


@pytest.mark.parametrize("axis", [(a, 2 * a, 3 * a), (0, 1, 0), (0, 0, 1), (0, 1, 1)])
def test_the_arrow_round_an_axis_is_seen_beside_the_body(axis: Any) -> None:
    block = Cuboid((a, 2 * a, 3 * a), M)
    pieces = pieces_of(drawing("axes", outline(block), axis_of_rotation(column(*axis), block.middle, rate=omega)))
    ((ring,), edges) = strokes(pieces, "turn"), strokes(pieces, "edge")
    outer = hull([spot for stroke in edges for spot in stroke.spots])
    assert not any(is_within(spot, outer) for spot in ring.spots)


def test_a_dimension_line_without_room_for_its_heads_has_arrows_outside() -> None:
    long = measured(((0.0, 0.0), (0.0, 30.0)), a, (1.0, 0.0))
    short = measured(((0.0, 0.0), (0.0, 3.0)), a, (1.0, 0.0))
    assert [piece.head and piece.tail for piece in long if isinstance(piece, Stroke)] == [True]
    arrows = [piece for piece in short if isinstance(piece, Stroke) and piece.head]
    assert [arrow.spots[1][1] for arrow in arrows] == [0.0, 3.0]
    assert arrows[0].spots[0][1] < 0 and arrows[1].spots[0][1] > 3
    (label,) = (piece for piece in short if isinstance(piece, Tag))
    assert label.spot == arrows[1].spots[0]


@pytest.mark.parametrize(("eye", "is_dot"), [((-90, 90), True), ((-90, -90), False)])
def test_an_axis_along_the_line_of_sight_is_a_circle(eye: tuple[float, float], is_dot: bool) -> None:
    """A circle with a dot means that the axis is towards the viewer; with a cross, it is away from the viewer."""
    axis = Axis(column(0, 0, 0), column(0, 0, 1), label=a)
    pieces = axis.pieces(OnPaper(Numbers({}), stance_from(*eye), 50.0))
    bullets = [piece for piece in pieces if isinstance(piece, Bullet)]
    assert (len(bullets), len([piece for piece in pieces if isinstance(piece, Stroke)])) == (
        (3, 0) if is_dot else (2, 2)
    )


def test_a_dimension_line_in_space_has_its_extension_lines_at_right_angles() -> None:
    mark = LengthMark(column(0, 0, 0), column(1, 0, 0), column(1, 1, 0), label=a)
    line, *_ = (p for p in mark.pieces(OnPaper(Numbers({}), stance_from(30, 30), 60.0)) if isinstance(p, Stroke))
    (x, y), (u, v) = line.spots
    (p, q), (r, s) = OnPaper(Numbers({}), stance_from(30, 30), 60.0).spots((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert (u - x) * (r - p) + (v - y) * (s - q) == pytest.approx(0, abs=1e-9)
