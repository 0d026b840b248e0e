"""Strings over pulleys of negligible radius."""

from __future__ import annotations

from math import hypot
from typing import Any

import pytest
from sympy import ImmutableDenseMatrix, Rational

from derive.figures.marks import Drawing
from derive.figures.pieces import Bullet, Stroke
from derive.figures.pulleys import PulleyRopeMark, SmallPulleyMark, TiedEndMark
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from tests.courses import library_drawings
from tests.figures.test_connected import of_class

PAPER = OnPaper(Numbers({}), FLAT, 60.0)


def string(*places: tuple[int, int], tied: tuple[bool, bool] = (False, False)) -> PulleyRopeMark:
    inner = range(1, len(places) - 1)
    radii = (0, *(Rational(1, 10) for _ in inner), 0)
    return PulleyRopeMark(tuple(map(_column, places)), radii, corners=tuple(inner), tied=tied)


def _column(place: tuple[int, int]) -> Any:
    return ImmutableDenseMatrix(list(place))


def movable() -> Drawing:
    return library_drawings("movable_pulley")["system"]


def test_the_pieces_of_a_string_keep_their_directions() -> None:
    """The pulley is inside the corner, so the string on both sides is on the lines between the places."""
    rope = string((0, -3), (0, 0), (2, 0), (2, -4))
    spots = rope.pieces(PAPER)[0].spots
    assert spots[0][0] == 0.0 and spots[1][0] == pytest.approx(0.0)
    assert spots[-1][0] == 120.0 and spots[-2][0] == pytest.approx(120.0)
    assert rope.hub(PAPER, 1) == pytest.approx((6.0, -6.0)) and rope.hub(PAPER, 2) == pytest.approx((114.0, -6.0))
    assert max(y for _, y in spots) == pytest.approx(0.0)


def test_a_string_that_returns_has_two_parallel_pieces() -> None:
    rope = string((0, -3), (0, 0), (2, 0), (2, -4), (2, 0), tied=(False, True))
    spots = rope.pieces(PAPER)[0].spots
    assert rope.hub(PAPER, 3) == pytest.approx((120.0, -240.0))
    assert spots[-1] == pytest.approx((126.0, 0.0)) and spots[-2][0] == pytest.approx(126.0)
    down = [spot for spot in spots if spot[0] == pytest.approx(114.0)]
    assert max(y for _, y in down) == pytest.approx(-6.0) and min(y for _, y in down) == pytest.approx(-240.0)


def test_the_ceiling_of_a_pulley_has_the_height_of_a_fixed_end_above_it() -> None:
    hangers = [str(mark.hanger) for mark in of_class(movable(), SmallPulleyMark) if mark.hanger is not None]
    assert hangers == ["h", "h"]


def test_an_end_at_a_body_keeps_its_place() -> None:
    spots = string((0, -3), (0, 0), (0, -2)).pieces(PAPER)[0].spots
    assert (spots[0], spots[-1]) == ((0.0, -180.0), (0.0, -120.0))
    assert max(x for x, _ in spots) == pytest.approx(6.0, abs=0.1) == -min(x for x, _ in spots)


def test_a_straight_string_runs_over_its_pulley() -> None:
    rope = string((-1, 0), (0, 0), (1, 0))
    assert rope.hub(PAPER, 1) == pytest.approx((0.0, -6.0))
    assert all(y == pytest.approx(0.0) for _, y in rope.pieces(PAPER)[0].spots)


def test_a_movable_pulley_hangs_between_the_ceiling_and_a_fixed_pulley() -> None:
    drawn = movable()
    (rope,), (anchor,) = of_class(drawn, PulleyRopeMark), of_class(drawn, TiedEndMark)
    first, second, moving = of_class(drawn, SmallPulleyMark)
    assert first.hanger == second.hanger is not None and moving.hanger is None and str(moving.label) == "m_2"
    assert rope.in_words() == ("pulley_rope", {"label": None}) and moving.in_words() == (
        "wheel",
        {"label": moving.label},
    )
    assert anchor.in_words()[0] == "fixed_end"
    paper = OnPaper(Numbers(dict.fromkeys(drawn.letters, 2.0)), FLAT, 60.0)
    end = rope.pieces(paper)[0].spots[-1]
    wall = anchor.pieces(paper)[0]
    assert isinstance(wall, Stroke) and wall.spots[0][1] == wall.spots[1][1] == pytest.approx(end[1])
    hub = next(piece.spot for piece in second.pieces(paper) if isinstance(piece, Bullet))
    assert hypot(hub[0] - end[0], hub[1] - end[1]) > 2 * paper.scale * paper.numbers.of(rope.radii[2])
