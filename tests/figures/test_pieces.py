"""Tests of the pieces of a drawing and of the projection onto its paper."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest

from derive.figures.pieces import Bullet, EdgeNames, Paper, Patch, Piece, Stroke, Tag
from derive.figures.space import Stance, Vector
from derive.render.drawing.camera import Numbers

FROM_THE_FRONT = Stance((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))


class Glass(Paper):
    def polyhedron(self, corners: Sequence[Vector], faces: Sequence[Sequence[int]], lengths: EdgeNames) -> list[Piece]:
        return [Stroke(self.spots(*(corners[i] for i in face)), "edge") for face in faces]

    def revolved(self, centres: Sequence[Vector], radii: Sequence[float]) -> list[Piece]:
        return []


@pytest.mark.parametrize(
    "piece", [Stroke(((1.0, 2.0),), "edge"), Patch(((1.0, 2.0),)), Bullet((1.0, 2.0)), Tag("a", (1.0, 2.0), (0.0, 1.0))]
)
def test_every_piece_says_in_the_same_way_where_it_is(piece: Piece) -> None:
    assert piece.spots == ((1.0, 2.0),)


def test_a_spot_is_in_points_and_grows_with_the_scale() -> None:
    paper = Glass(Numbers({}), FROM_THE_FRONT, scale=10.0)
    assert paper.spot((7.0, 1.0, 2.0)) == (10.0, 20.0)
    assert replace(paper, scale=20.0).spots((0.0, 1.0, 2.0), (0.0, 0.0, 0.0)) == ((20.0, 40.0), (0.0, 0.0))


def test_paper_without_outlines_of_surfaces_is_none() -> None:
    with pytest.raises(TypeError, match="polyhedron"):
        Paper(Numbers({}), FROM_THE_FRONT)  # type: ignore[abstract]
