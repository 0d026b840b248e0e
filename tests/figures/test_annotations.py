"""Arrows, arcs, turns and dimension lines: true directions, the sense of a turn, nothing where there is nothing."""

from __future__ import annotations

from math import atan2, degrees, isclose, pi

import pytest
from sympy import Rational, Symbol

from derive.algebra.expressions import column
from derive.figures import arc, arrow, axis_of_rotation, drawing, length_mark, outline, point_mark
from derive.figures.annotations import AngleMark, Turn
from derive.figures.marks import Drawing
from derive.figures.pieces import Bullet, Tag
from derive.figures.surfaces import Polyhedron
from derive.mechanics import Cuboid
from derive.render.drawing.camera import Numbers, best_stance
from tests.figures.scenery import NUMBERS, SLAB, M, a, area, heading, pieces_of, plane, strokes, theta, vectors_of_block
from tests.mechanics.block import omega

UP, RIGHT = column(0, 1, 0), column(1, 0, 0)


def seen(found: Drawing, *direction: float) -> float:
    """The heading on paper of a direction in space, worked out apart from the strokes."""
    stance = best_stance(found, Numbers({}))
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
    """Seen from above, from where z points, a right-handed turn about z goes round anticlockwise."""
    square = Polyhedron(tuple(column(*p, 0) for p in ((0, 0), (4, 0), (4, 4), (0, 4))))
    found = plane(square, Turn(column(2, 2, 0), column(*along), Rational(1, 4)))
    assert area(strokes(pieces_of(found), "turn")[0]) * sense > 0


def test_a_negative_rate_turns_the_other_way() -> None:
    """The eye is above the plane of x and y, so that a turn about z keeps its sense on paper."""
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
