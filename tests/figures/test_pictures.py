"""What is drawn: true directions and proportions, hidden edges, the sense of turns, and labels on nothing."""

from __future__ import annotations

from itertools import combinations
from math import atan2, cos, degrees, hypot, isclose, pi, sin

import pytest
from sympy import Rational, Symbol, sqrt

from derive.algebra.expressions import column
from derive.figures import arc, arrow, axis_of_rotation, drawing, length, outline, point, slab_on_cylinder
from derive.figures.annotations import AngleMark, Turn
from derive.figures.marks import Drawing
from derive.figures.pieces import Bullet, Patch, Tag
from derive.figures.space import dot, size_of, unit
from derive.figures.surfaces import Polyhedron, Revolved
from derive.mechanics import Coordinate, Cuboid, rolled_centre
from derive.render.drawing.camera import Numbers, best_stance, stance_from, stand_ins
from derive.render.drawing.canvas import sheet_of
from derive.render.drawing.hidden_lines import hull
from derive.render.drawing.labels import placed
from derive.render.drawing.picture import POINTS_PER_CM
from derive.render.notation.notation import Notation
from tests.figures.scenery import (
    CONE,
    NUMBERS,
    M,
    R,
    a,
    area,
    h,
    heading,
    leaning,
    pieces_of,
    plane,
    strokes,
    theta,
    vectors_of_block,
)
from tests.mechanics.block import b, c, omega

UP, RIGHT = column(0, 1, 0), column(1, 0, 0)
ROLLED = rolled_centre(R, a / 2, Coordinate(theta, "angle"))
SLAB = drawing("slab", slab_on_cylinder(R, a, theta, ROLLED, M), view="plane")
SCENES = [
    vectors_of_block(),
    vectors_of_block(axis=(1, 1, 0)),
    drawing("axes", outline(Cuboid((a, 2 * a, 3 * a), M)), axis_of_rotation(column(1, 2, 3), rate=omega)),
    drawing("cone", outline(CONE)),
    drawing("cone_above", outline(CONE, "base"), point(column(0, 0, h / 4), Symbol("C"))),
    drawing("top", leaning(precession=Symbol("phi_dot"), spin=Symbol("S"), weight=M)),
    SLAB,
]


def seen(found: Drawing, *direction: float) -> float:
    """The heading on paper of a direction in space, worked out apart from the strokes."""
    stance = best_stance(found, Numbers({}))
    x, y = (sum(p * q for p, q in zip(direction, way, strict=True)) for way in (stance.right, stance.up))
    return degrees(atan2(y, x))


# --- directions and proportions --------------------------------------------------------------------------------------


def test_the_vectors_of_the_block_are_drawn_along_their_true_directions() -> None:
    found = vectors_of_block()
    spin, momentum = strokes(pieces_of(found), "asked")
    assert isclose(heading(spin), seen(found, 1, 2, 3), abs_tol=1e-9)
    assert isclose(heading(momentum), seen(found, 13, 20, 15), abs_tol=1e-9)
    assert abs(heading(spin) - heading(momentum)) > 5


def test_a_vector_reverses_with_its_sign() -> None:
    found = vectors_of_block(rate=-omega)
    assert isclose(heading(strokes(pieces_of(found), "asked")[0]), seen(found, -1, -2, -3), abs_tol=1e-9)


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
@pytest.mark.parametrize("found", SCENES, ids=lambda found: found.key)
def test_the_lines_fill_the_room_and_do_not_leave_it(found: Drawing, room: tuple[float, float]) -> None:
    pieces = pieces_of(found, *room)
    spots = [s for p in pieces for s in ((p.spot,) if isinstance(p, Bullet | Tag) else p.spots)]
    filled = [
        (max(s[k] for s in spots) - min(s[k] for s in spots)) / (room[k] * POINTS_PER_CM) for k in (0, 1)
    ]  # fmt: skip
    assert max(filled) == pytest.approx(1, abs=0.02)


def test_an_angle_in_a_plane_is_as_large_as_its_value() -> None:
    pieces = pieces_of(SLAB, theta=0.5)
    arc = strokes(pieces, "angle")[0]
    centre = next(p.spot for p in pieces if isinstance(p, Bullet))
    start, end = (atan2(y - centre[1], x - centre[0]) for x, y in (arc.spots[0], arc.spots[-1]))
    assert start == pytest.approx(pi / 2)
    assert start - end == pytest.approx(0.5)


def test_a_slab_that_turned_the_other_way_lies_on_the_other_side() -> None:
    contact = {sign: [p.spot for p in pieces_of(SLAB, theta=sign * 0.5) if isinstance(p, Bullet)] for sign in (1, -1)}
    middle, right, left = contact[1][0], contact[1][1], contact[-1][1]
    assert right[0] > middle[0] + 10
    assert left[0] < contact[-1][0][0] - 10


def test_parallel_vectors_have_no_arc_between_them() -> None:
    assert strokes(pieces_of(vectors_of_block(sides=(a, a, a))), "angle") == []
    assert len(strokes(pieces_of(vectors_of_block()), "angle")) == 1


def test_a_vector_that_vanishes_is_not_drawn() -> None:
    found = drawing("one", outline(Cuboid((a, a, a), M), named=False), arrow(column(0, 0, 0)), arrow(column(0, 0, a)))
    assert len(strokes(pieces_of(found), "asked")) == 1


def test_a_length_of_zero_has_no_dimension_line() -> None:
    nothing = length(RIGHT, RIGHT, a, UP)
    assert strokes(pieces_of(plane(point(column(0, 0, 0)), point(RIGHT), nothing)), "measure") == []
    assert len(strokes(pieces_of(SLAB), "measure")) == 2


# --- the sense of a turn ---------------------------------------------------------------------------------------------


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


# --- what is hidden --------------------------------------------------------------------------------------------------


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


def test_a_body_in_front_is_drawn_after_the_one_behind() -> None:
    """Towards the eye is along x here, whatever the order in the script."""
    near, far = (Revolved(((0, R), (1, R)), column(x, 0, 0), column(0, 0, 1)) for x in (5, -5))
    for order in ((near, far), (far, near)):
        patches = [piece for piece in pieces_of(drawing("one", *order)) if isinstance(piece, Patch)]
        assert max(y for _, y in patches[0].spots) > max(y for _, y in patches[1].spots)


def test_a_cone_seen_from_its_apex_has_no_sides() -> None:
    flat = drawing("one", Revolved(((0, R), (h, 0)), column(0, 0, 0), column(0, 0, 1)), view="plane")
    assert [stroke for stroke in strokes(pieces_of(flat), "edge") if len(stroke.spots) == 2] == []


def test_a_hull_holds_every_spot() -> None:
    spots = [(cos(7 * i), sin(5 * i) + 0.1 * i) for i in range(40)]
    outline_of_all = hull(spots)
    for (x, y), (u, v) in zip(outline_of_all, (*outline_of_all[1:], outline_of_all[0]), strict=True):
        assert all((u - x) * (q - y) - (v - y) * (p - x) > -1e-9 for p, q in spots)


# --- labels ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("found", SCENES, ids=lambda found: found.key)
def test_no_label_stands_on_another_and_every_label_is_near_what_it_names(found: Drawing) -> None:
    pieces = pieces_of(found)
    labels = placed(pieces, lambda label: (6.0 * len(str(label)), 8.0))
    for one, other in combinations((label.extent for label in labels), 2):
        assert one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
    for tag, label in zip((p for p in pieces if isinstance(p, Tag)), labels, strict=True):
        left, below, right, above = label.extent
        x, y = tag.spot
        away = hypot(max(left - x, 0, x - right), max(below - y, 0, y - above))
        assert away < 25


def test_a_mark_without_a_name_has_no_label() -> None:
    found = plane(point(column(0, 0, 0)), point(RIGHT, Symbol("A")))
    assert [piece.label for piece in pieces_of(found) if isinstance(piece, Tag)] == [Symbol("A")]


# --- numbers ---------------------------------------------------------------------------------------------------------


def test_letters_without_numbers_are_told_apart() -> None:
    stand_in = stand_ins([(a, "length"), (b, "length"), (M, "mass"), (c, "length")], {})
    assert [stand_in[letter] for letter in (a, b, c, M)] == [1.0, 1.5, 2.0, 1.0]


def test_a_letter_with_a_number_keeps_it_and_gives_the_others_their_size() -> None:
    stand_in = stand_ins([(a, "length"), (b, "length")], {a: Rational(1, 50)})
    assert stand_in[a] == 0.02
    assert 0.01 < stand_in[b] < 0.1


def test_a_value_that_is_not_real_is_refused() -> None:
    from derive.errors import Rejected

    with pytest.raises(Rejected, match="not a real number"):
        Numbers({a: 1.0}).of(sqrt(-a))


def test_the_usual_stance_is_a_rotation() -> None:
    stance = stance_from(33, 21)
    for one, other in combinations((stance.right, stance.up, stance.eye), 2):
        assert isclose(dot(one, other), 0, abs_tol=1e-12)
    assert all(isclose(size_of(way), 1) for way in (stance.right, stance.up, stance.eye))
    assert unit((0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


def test_a_view_is_chosen_in_which_the_angle_is_open() -> None:
    """Two vectors that look like one from the usual stance are seen from another."""
    usual = stance_from(25, 18)
    one = column(*(Rational(x) for x in usual.right))
    other = column(*(Rational(x + y) for x, y in zip(usual.right, usual.eye, strict=True)))
    box = outline(Cuboid((a, a, a), M), named=False)
    first, second = strokes(pieces_of(drawing("one", box, arrow(one), arrow(other))), "asked")
    assert abs(heading(first) - heading(second)) > 20


# --- files -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("found", SCENES, ids=lambda found: found.key)
def test_a_sheet_is_the_same_bytes_each_time_and_has_no_date(found: Drawing) -> None:
    one, other = (sheet_of(pieces_of(found), Notation(), "what it shows") for _ in range(2))
    assert (one.pdf, one.svg) == (other.pdf, other.svg)
    assert b"CreationDate" not in one.pdf
    assert b"<dc:date>" not in one.svg
    assert b"<title>what it shows</title>" in one.svg


def test_words_in_an_svg_are_escaped() -> None:
    assert b"<title>a &lt; b &amp; c</title>" in sheet_of(pieces_of(SLAB), Notation(), "a < b & c").svg


def test_the_settings_of_whoever_draws_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    import matplotlib

    usual = sheet_of(pieces_of(SLAB), Notation(), "")
    monkeypatch.setitem(matplotlib.rcParams, "mathtext.fontset", "stix")
    monkeypatch.setitem(matplotlib.rcParams, "lines.linewidth", 9)
    assert sheet_of(pieces_of(SLAB), Notation(), "") == usual


def test_an_angle_needs_two_directions() -> None:
    flat = arc(UP, column(0, 0, 0), theta)
    assert isinstance(flat, AngleMark)
    assert strokes(pieces_of(plane(point(RIGHT), point(UP), flat)), "angle") == []
    assert NUMBERS[a] == 1
