"""Tests of the drawn parts of machines: their ends, their sizes, and the parts that they hide."""

from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, isclose, sin

import pytest

from derive.figures import block, cart, drawing, particle, rod, rope, spring_mark, wedge, wheel
from derive.figures.marks import Drawing, Mark
from derive.figures.parts import BEND, BLOCK, BOB, COIL, TUBE, WHEEL, CornerRopeMark, HeavyRopeMark
from derive.figures.pieces import Bullet, Patch, Stroke, Tag
from derive.figures.positions import column_of
from derive.figures.surroundings import FixedEnd
from derive.mechanics import point
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from tests.figures.machines import l, m, seen
from tests.figures.scenery import strokes

RIGHT = point(1, 0)


def shown(*marks: Mark) -> Drawing:
    return drawing("machine", *marks)


def ends(stroke: Stroke) -> tuple[float, float]:
    (x, y), (u, v) = stroke.spots[0], stroke.spots[-1]
    return u - x, v - y


def test_a_spring_begins_and_ends_where_it_is_fixed_and_swings_to_both_sides() -> None:
    pieces = seen(shown(rod(point(0, 0), point(0, 1)), spring_mark(point(0, 0), point(2, 0))))
    spring, bar = strokes(pieces, "spring")[0], strokes(pieces, "bar")[0]
    assert ends(spring)[0] == pytest.approx(2 * ends(bar)[1])
    ys = [y - spring.spots[0][1] for _, y in spring.spots]
    assert (max(ys), min(ys)) == pytest.approx((COIL, -COIL))


def test_a_spring_of_no_length_and_the_wall_behind_it_are_not_seen() -> None:
    here = point(0, 0)
    pieces = seen(shown(rod(here, RIGHT), spring_mark(here, here, m), FixedEnd(column_of(here), column_of(here))))
    assert {piece.pen for piece in pieces if isinstance(piece, Stroke)} == {"bar"}
    assert not [piece for piece in pieces if isinstance(piece, Tag)]


@pytest.mark.parametrize("far", [1, 3])
def test_a_longer_spring_of_a_drawing_has_more_turns(far: int) -> None:
    pieces = seen(shown(spring_mark(point(0, 0), point(far, 0)), spring_mark(point(0, 1), point(1, 1))))
    one, other = strokes(pieces, "spring")
    assert (len(one.spots) > len(other.spots)) == (far > 1)


def test_a_particle_hides_the_rod_that_ends_in_it_whatever_the_order() -> None:
    for marks in ((rod(point(0, 0), RIGHT), particle(RIGHT, m)), (particle(RIGHT, m), rod(point(0, 0), RIGHT))):
        pieces = [piece for piece in seen(shown(*marks)) if not isinstance(piece, Tag)]
        assert isinstance(pieces[-1], Bullet)
        assert pieces[-1].size == BOB


def test_a_block_has_its_lengths_or_the_usual_size() -> None:
    pieces = seen(shown(rod(point(0, 0), point(4, 0)), block(point(1, 0), width=2, height=1), block(point(3, 0))))
    scale = ends(strokes(pieces, "bar")[0])[0] / 4
    (x, y), _, (u, v), _ = next(piece for piece in pieces if isinstance(piece, Patch)).spots
    assert (u - x, v - y) == pytest.approx((2 * scale, scale))
    (x, y), _, (u, v), _ = [piece for piece in pieces if isinstance(piece, Patch)][1].spots
    assert (u - x, v - y) == pytest.approx(BLOCK)


def test_a_block_stands_on_a_slope_with_its_base() -> None:
    slope = point(1, 1)
    pieces = seen(shown(rod(point(0, 0), slope), block(slope, along=slope, width=1, height=1, stands=True)))
    bar, patch = strokes(pieces, "bar")[0], next(piece for piece in pieces if isinstance(piece, Patch))
    x, y = bar.spots[1]
    low, right = patch.spots[:2]
    assert ((low[0] + right[0]) / 2, (low[1] + right[1]) / 2) == pytest.approx((x, y))
    upper = patch.spots[3]
    assert upper[1] > low[1]
    assert upper[0] < low[0]


def test_a_short_name_stands_on_a_block_and_a_long_one_above() -> None:
    short = next(piece for piece in seen(shown(block(RIGHT, m))) if isinstance(piece, Tag))
    long = next(piece for piece in seen(shown(block(RIGHT, 2 * m * l))) if isinstance(piece, Tag))
    assert (short.on, long.on) == (True, False)


def test_the_wheels_of_a_cart_are_below_it() -> None:
    pieces = seen(shown(cart(RIGHT, m)))
    body, *wheels = [piece for piece in pieces if isinstance(piece, Patch)]
    assert len(wheels) == 2
    assert max(y for wheel in wheels for _, y in wheel.spots) == pytest.approx(min(y for _, y in body.spots))


def test_a_wheel_is_as_large_as_its_radius_and_its_pointer_ends_on_the_rim() -> None:
    pieces = seen(shown(rod(point(0, 0), point(3, 0)), wheel(RIGHT, 1, pointer=point(0, -1))))
    scale = ends(strokes(pieces, "bar")[0])[0] / 3
    pointer = next(stroke for stroke in strokes(pieces, "edge") if len(stroke.spots) == 2)
    assert ends(pointer) == pytest.approx((0, -scale))


# --- strings ---


def around(spots: list[tuple[float, float]], middle: tuple[float, float]) -> list[float]:
    return [hypot(x - middle[0], y - middle[1]) for x, y in spots]


def test_a_string_goes_over_a_wheel_and_leaves_it_where_its_tangents_touch() -> None:
    pulley = wheel(point(0, 0), 1)
    pieces = seen(shown(rope(point(-1, -3), pulley, point(1, -2)), pulley))
    spots = list(strokes(pieces, "string")[0].spots)
    hub = next(piece for piece in pieces if isinstance(piece, Bullet)).spot
    radius = around(spots[1:-1], hub)
    assert max(radius) - min(radius) < 1e-6
    assert max(y for _, y in spots) == pytest.approx(hub[1] + radius[0], rel=1e-2)
    assert spots[1][0] == pytest.approx(spots[0][0])  # both parts hang down


def test_a_string_goes_under_a_wheel_that_hangs_in_it() -> None:
    movable = wheel(point(0, -3), 1)
    pieces = seen(shown(rope(point(-1, 0), movable, point(1, 0)), movable))
    hub = next(piece for piece in pieces if isinstance(piece, Bullet)).spot
    spots = strokes(pieces, "string")[0].spots
    assert min(y for _, y in spots) < hub[1]
    assert sum(hypot(u - x, v - y) for (x, y), (u, v) in pairwise(spots)) > 0


def test_a_string_that_crosses_between_two_wheels_touches_both() -> None:
    one, other = wheel(point(0, 0), 1), wheel(point(4, -1), 1)
    pieces = seen(shown(rope(point(-1, -4), one, other, point(5, 3)), one, other))
    spots = strokes(pieces, "string")[0].spots
    hubs = [piece.spot for piece in pieces if isinstance(piece, Bullet)]
    scale = hypot(hubs[1][0] - hubs[0][0], hubs[1][1] - hubs[0][1]) / hypot(4, 1)
    for hub in hubs:
        assert min(around(list(spots), hub)) == pytest.approx(scale, rel=1e-6)


@pytest.mark.parametrize("lifts", [(0.0, 0.0), (BLOCK[1] / 2, 0.0), (WHEEL, WHEEL)])
def test_a_pulley_in_a_corner_touches_both_parts_of_its_string(lifts: tuple[float, float]) -> None:
    """The pieces of the string are parallel to their lines, shifted by the given distances."""
    slope = point(-cos(0.6), -sin(0.6))
    marks = CornerRopeMark(column_of(4 * slope), column_of(point(0, 0)), column_of(point(0, -4)), lifts)
    pieces = seen(shown(marks))
    spots = strokes(pieces, "string")[0].spots
    hub = next(piece for piece in pieces if isinstance(piece, Bullet)).spot
    assert all(isclose(far, WHEEL, rel_tol=1e-6) for far in around(list(spots[1:-1]), hub))
    for (x, y), (u, v) in (spots[:2], spots[:-3:-1]):
        way, off = (u - x, v - y), (hub[0] - u, hub[1] - v)
        assert way[0] * off[0] + way[1] * off[1] == pytest.approx(0, abs=1e-6)
    (x, y), (u, v) = spots[:2]
    assert (v - y) / (u - x) == pytest.approx(sin(0.6) / cos(0.6))
    if lifts == (WHEEL, WHEEL):
        assert hub == pytest.approx((0, 0), abs=1e-6)  # the wheel of a shifted string is at the corner itself


def test_a_wedge_is_told_and_named_away_from_its_sharp_corner() -> None:
    pieces = seen(shown(wedge(point(0, 0), point(4, 0), point(0, 3), label=m)))
    tag = next(piece for piece in pieces if isinstance(piece, Tag))
    corners = next(piece for piece in pieces if isinstance(piece, Patch)).spots
    assert tag.on
    middle = [sum(c[k] for c in corners) / 3 for k in (0, 1)]
    far = [max(c[0] for c in corners), min(c[1] for c in corners)]
    assert tag.spot == pytest.approx(tuple(m + (m - f) / 5 for m, f in zip(middle, far, strict=True)))


def test_a_tube_guides_a_rope_round_a_bend() -> None:
    places = [column_of(point(*each)) for each in ((-1, 0), (0, 0), (0, -1))]
    rope_piece, inner, outer = HeavyRopeMark(tuple(places), (0, 0, 0)).pieces(OnPaper(Numbers({}), FLAT, 60.0))[:3]
    assert isinstance(rope_piece, Stroke) and isinstance(inner, Stroke) and isinstance(outer, Stroke)
    corner = min(hypot(x, y) for x, y in rope_piece.spots)
    assert corner == pytest.approx(BEND * (2**0.5 - 1), abs=0.05)
    assert outer.spots[0][1] == pytest.approx(TUBE) and outer.spots[-1][0] == pytest.approx(TUBE)
    assert inner.spots[0][1] == pytest.approx(-TUBE) and inner.spots[-1][0] == pytest.approx(-TUBE)
