"""Tests of drawings on paper: their proportions, their size, and the order of the pieces."""

from __future__ import annotations

from math import atan2, degrees, hypot, isclose

import pytest

from derive.algebra.expressions import column
from derive.figures import drawing, outline
from derive.figures.pieces import Bullet, Patch, Tag
from derive.figures.surfaces import Revolved
from derive.mechanics import Cuboid
from derive.render.drawing.camera import stance_from
from derive.render.drawing.picture import POINTS_PER_CM
from tests.figures.scenery import SCENES, M, R, a, heading, pieces_of, strokes


def test_the_edges_of_a_block_are_in_the_proportion_of_its_sides() -> None:
    pieces = pieces_of(drawing("one", outline(Cuboid((a, 2 * a, 3 * a), M), named=False)))
    stance = stance_from(25, 18)
    edges = [*strokes(pieces, "edge"), *strokes(pieces, "hidden")]
    per_unit = {}
    for axis, side in ((0, 1), (1, 2), (2, 3)):
        across, up = stance.right[axis], stance.up[axis]
        turned = degrees(atan2(up, across))
        own = [edge for edge in edges if isclose((heading(edge) - turned + 90) % 180, 90, abs_tol=1e-6)]
        assert len(own) == 4
        for edge in own:
            (x, y), (u, v) = edge.spots
            per_unit[edge] = hypot(u - x, v - y) / (side * hypot(across, up))
    assert max(per_unit.values()) - min(per_unit.values()) < 1e-9 * max(per_unit.values())


@pytest.mark.parametrize("room", [(5.0, 5.0), (3.0, 8.0), (8.0, 3.0)])
@pytest.mark.parametrize("scene", SCENES)
def test_the_lines_fill_the_room_and_do_not_leave_it(scene: str, room: tuple[float, float]) -> None:
    pieces = pieces_of(SCENES[scene](), *room)
    spots = [s for p in pieces for s in ((p.spot,) if isinstance(p, Bullet | Tag) else p.spots)]
    filled = [
        (max(s[k] for s in spots) - min(s[k] for s in spots)) / (room[k] * POINTS_PER_CM) for k in (0, 1)
    ]  # fmt: skip
    assert max(filled) == pytest.approx(1, abs=0.06)  # arcs are added after the scale is chosen


def test_a_body_in_front_is_drawn_after_the_one_behind() -> None:
    near, far = (Revolved(((0, R), (1, R)), column(x, 0, 0), column(0, 0, 1)) for x in (5, -5))
    for order in ((near, far), (far, near)):
        patches = [piece for piece in pieces_of(drawing("one", *order)) if isinstance(piece, Patch)]
        assert max(y for _, y in patches[0].spots) > max(y for _, y in patches[1].spots)
