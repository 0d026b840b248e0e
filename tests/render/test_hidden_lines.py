"""Tests of the hidden lines of convex surfaces."""

from __future__ import annotations

from math import cos, sin, sqrt

import pytest

from derive.algebra.expressions import column
from derive.figures import drawing, outline
from derive.figures.pieces import Patch, Piece, Stroke, Tag
from derive.figures.space import Vector
from derive.figures.surfaces import Revolved
from derive.mechanics import Cuboid
from derive.render.drawing.camera import FLAT, Numbers, stance_from
from derive.render.drawing.hidden_lines import OnPaper, hull
from tests.figures.scenery import CONE, M, R, a, h, pieces_of, strokes

PAPER = OnPaper(Numbers({}), stance_from(25, 18), middle=(0.0, 0.0, 0.5))
FROM_ABOVE = OnPaper(Numbers({}), FLAT)
TETRAHEDRON: list[Vector] = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
FACES = [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)]


def pens(pieces: list[Piece]) -> list[str]:
    return sorted(piece.pen for piece in pieces if isinstance(piece, Stroke))


def test_the_three_edges_that_meet_behind_a_tetrahedron_are_hidden() -> None:
    pieces = PAPER.polyhedron(TETRAHEDRON, FACES, ())
    hidden = [piece for piece in pieces if isinstance(piece, Stroke) and piece.pen == "hidden"]
    assert pens(pieces) == ["edge"] * 3 + ["hidden"] * 3
    assert all(PAPER.spot((0.0, 0.0, 0.0)) in stroke.spots for stroke in hidden)


def test_a_face_may_be_told_from_either_side_and_an_edge_from_either_end() -> None:
    named = PAPER.polyhedron(TETRAHEDRON, FACES, (("l", ((1, 2), (2, 3))),))
    turned = PAPER.polyhedron(TETRAHEDRON, [face[::-1] for face in FACES], (("l", ((2, 1), (3, 2))),))
    assert named == turned


def test_a_name_stands_beside_the_lowest_outer_edge_of_its_length() -> None:
    pieces = PAPER.polyhedron(TETRAHEDRON, FACES, (("l", ((0, 1), (1, 2), (2, 3), (1, 3))),))
    (tag,) = [piece for piece in pieces if isinstance(piece, Tag)]
    (x, y), (u, v) = (PAPER.spot(TETRAHEDRON[i]) for i in (1, 2))
    assert tag.spot == pytest.approx(((x + u) / 2, (y + v) / 2))
    assert tag.towards[1] < 0


def test_a_frustum_shows_its_upper_rim_and_the_near_part_of_its_lower_one() -> None:
    pieces = PAPER.revolved([(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)], [1.0, 0.5])
    rims = [piece for piece in pieces if isinstance(piece, Stroke) and len(piece.spots) > 2]
    sides = [piece for piece in pieces if isinstance(piece, Stroke) and len(piece.spots) == 2]
    assert len(sides) == 2
    assert [stroke.pen for stroke in rims if len(stroke.spots) == 97] == ["edge"]
    assert {stroke.pen for stroke in rims if len(stroke.spots) < 97} == {"edge", "hidden"}


def test_the_sides_of_what_is_round_end_on_its_outline() -> None:
    pieces = PAPER.revolved([(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)], [1.0, 0.5])
    (patch,) = [piece for piece in pieces if isinstance(piece, Patch)]
    for side in (piece for piece in pieces if isinstance(piece, Stroke) and len(piece.spots) == 2):
        for x, y in side.spots:
            assert min((x - u) ** 2 + (y - v) ** 2 for u, v in patch.spots) < 0.04**2


@pytest.mark.parametrize(("turned", "hidden"), [(1, ["hidden"]), (-1, [])])
def test_the_rim_of_half_a_ball_is_dashed_where_the_ball_hides_it(turned: int, hidden: list[str]) -> None:
    heights = [k / 24 for k in range(25)]
    centres = [(0.0, 0.0, turned * height) for height in heights]
    pieces = PAPER.revolved(centres, [sqrt(1 - height**2) for height in heights])
    assert {pen for pen in pens(pieces) if pen == "hidden"} == set(hidden)


def test_along_its_axis_a_cone_is_a_circle_and_has_no_sides() -> None:
    pieces = FROM_ABOVE.revolved([(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)], [1.0, 0.0])
    (stroke,) = [piece for piece in pieces if isinstance(piece, Stroke)]
    assert all(x * x + y * y == pytest.approx(1) for x, y in stroke.spots)


@pytest.mark.parametrize("sides", [(a, 2 * a, 3 * a), (3 * a, a, a), (a, a, a)])
def test_three_edges_of_a_block_are_hidden_and_meet_in_the_corner_farthest_from_the_eye(sides: tuple) -> None:
    found = drawing("one", outline(Cuboid(sides, M), named=False))
    hidden = strokes(pieces_of(found), "hidden")
    assert len(hidden) == 3
    ends = [{(round(x, 6), round(y, 6)) for x, y in stroke.spots} for stroke in hidden]
    assert len(set.intersection(*ends)) == 1


def test_the_sides_of_a_cone_touch_its_rim_and_leave_it_on_one_side() -> None:
    pieces = pieces_of(drawing("cone", outline(CONE, named=False)))
    straight = [stroke for stroke in strokes(pieces, "edge") if len(stroke.spots) == 2]
    rim = [spot for stroke in strokes(pieces, "edge") if len(stroke.spots) > 2 for spot in stroke.spots]
    assert len(straight) == 2
    for side in straight:
        (x, y), (u, v) = side.spots
        sides = [(u - x) * (q - y) - (v - y) * (p - x) for p, q in rim]
        reach = max(map(abs, sides))
        assert min(sides) > -0.01 * reach or max(sides) < 0.01 * reach


@pytest.mark.parametrize(("about", "hidden"), [("apex", 0), ("base", 1)])
def test_the_far_half_of_a_rim_is_hidden_only_behind_the_cone(about: str, hidden: int) -> None:
    pieces = pieces_of(drawing("cone", outline(CONE, about, named=False)))
    assert sum(len(stroke.spots) > 2 for stroke in strokes(pieces, "hidden")) in (hidden, 2 * hidden)


def test_a_cone_seen_from_its_apex_has_no_sides() -> None:
    flat = drawing("one", Revolved(((0, R), (h, 0)), column(0, 0, 0), column(0, 0, 1)), view="plane")
    assert [stroke for stroke in strokes(pieces_of(flat), "edge") if len(stroke.spots) == 2] == []


def test_a_hull_holds_every_spot() -> None:
    spots = [(cos(7 * i), sin(5 * i) + 0.1 * i) for i in range(40)]
    outline_of_all = hull(spots)
    for (x, y), (u, v) in zip(outline_of_all, (*outline_of_all[1:], outline_of_all[0]), strict=True):
        assert all((u - x) * (q - y) - (v - y) * (p - x) > -1e-9 for p, q in spots)
