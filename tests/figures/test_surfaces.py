"""Tests of the surfaces of bodies: their outermost points, the lines that they hide, and their descriptions."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, radians, sin
from typing import Any

import pytest
from sympy import Rational, sqrt, symbols

from derive.algebra.expressions import column
from derive.figures import drawing
from derive.figures.pieces import Patch, Stroke
from derive.figures.surfaces import Cavity, Circle, EllipsoidMark, Polyhedron, Revolved, ThinRod, TorusMark
from derive.render.drawing.camera import Numbers
from tests.figures.scenery import pieces_of, plane

R, h = symbols("R h", positive=True)
NUMBERS = Numbers({R: 2.0, h: 3.0})
ORIGIN, Z = column(0, 0, 0), column(0, 0, 1)
SQUARE = (ORIGIN, column(R, 0, 0), column(R, R, 0), column(0, R, 0))


def test_a_round_surface_reaches_as_far_as_its_circles() -> None:
    places = Revolved(((0, R), (h, R / 2)), column(0, 0, 1), Z).places(NUMBERS)
    assert sorted({(round(z, 9), round(hypot(x, y), 9)) for x, y, z in places}) == [(1, 2), (4, 1)]


def test_a_curved_surface_reaches_about_as_far_by_a_few_of_its_circles() -> None:
    heights = [Rational(k, 24) for k in range(-24, 25)]
    places = Revolved(tuple((k * R, R * sqrt(1 - k**2)) for k in heights), ORIGIN, Z).places(NUMBERS)
    assert len(places) < 100
    assert max(hypot(x, y) for x, y, _ in places) == pytest.approx(2)
    assert {min(z for *_, z in places), max(z for *_, z in places)} == {-2, 2}


@pytest.mark.parametrize(("filled", "kinds"), [(True, [Patch, Stroke]), (False, [Stroke])], ids=["a disc", "a ring"])
def test_only_what_is_filled_hides_what_is_behind_it(filled: bool, kinds: list[type]) -> None:
    circle = Circle(ORIGIN, Z, R, filled)
    assert [type(piece) for piece in pieces_of(plane(circle))] == kinds
    places = [tuple(round(x, 9) for x in place) for place in circle.places(NUMBERS)]
    assert len(places) == len(set(places)) > 8


def test_a_plane_figure_is_closed_and_is_told_by_its_corners_unless_it_has_a_name() -> None:
    patch, edge = pieces_of(plane(Polyhedron(SQUARE)))
    assert isinstance(patch, Patch) and isinstance(edge, Stroke)
    assert edge.spots == patch.spots and edge.spots[0] == edge.spots[-1]
    assert len(set(edge.spots)) == 4
    assert Polyhedron(SQUARE).in_words() == ("polygon", {"corners": 4})
    named = Polyhedron(SQUARE, name="a plate", measures=(("side", R),)).in_words()
    assert named == ("body", {"name": "a plate", "measures": (("side", R),)})
    assert Polyhedron(SQUARE, faces=((0, 1, 2, 3),)).in_words() is None


def test_a_rod_is_one_line_and_a_piece_of_it_is_not_told_again() -> None:
    rod = ThinRod(ORIGIN, h * Z)
    assert rod.places(NUMBERS) == [(0.0, 0.0, 0.0), (0.0, 0.0, 3.0)]
    assert rod.in_words() is None


def test_what_is_cut_out_is_a_blank_area_with_a_dashed_outline() -> None:
    heights = [Rational(k, 24) for k in range(-24, 25)]
    ball = Revolved(
        tuple((k * R, R * sqrt(1 - k**2)) for k in heights), ORIGIN, Z, name="a ball", measures=(("radius", R),)
    )
    blank, line = pieces_of(plane(Cavity(ball)))
    assert isinstance(blank, Patch) and blank.fill == "blank"
    assert isinstance(line, Stroke) and line.pen == "hidden" and line.spots[0] == line.spots[-1]
    assert Cavity(ball).in_words() == ("cavity", {"name": "a ball", "measures": (("radius", R),)})
    assert Cavity(replace(ball, name="")).in_words() is None


@pytest.mark.parametrize(("section", "holes"), [(R / 5, 1), (R / 2, 0)], ids=["through", "at its far side"])
def test_one_looks_through_a_thin_ring_and_not_through_a_thick_one(section: Any, holes: int) -> None:
    pieces = pieces_of(drawing("ring", TorusMark(ORIGIN, R, section)))
    assert [piece.fill for piece in pieces if isinstance(piece, Patch)] == ["solid", *["blank"] * holes]
    outline = next(piece for piece in pieces if isinstance(piece, Patch)).spots
    wide, high = (max(s[k] for s in outline) - min(s[k] for s in outline) for k in (0, 1))
    size = float(section / R)
    # At an elevation of 18 degrees, the central circle of the torus is an ellipse. The outline is at the distance
    # `size` from this ellipse.
    assert high / wide == pytest.approx((sin(radians(18)) + size) / (1 + size), rel=0.01)


def test_an_ellipsoid_reaches_its_half_axes_and_no_further() -> None:
    egg = EllipsoidMark(ORIGIN, (R, 2 * R, h))
    places = egg.places(NUMBERS)
    assert [max(place[k] for place in places) for k in range(3)] == pytest.approx([2, 4, 3])
    x, y, z = zip(*places, strict=True)
    assert all((a / 2) ** 2 + (b / 4) ** 2 + (c / 3) ** 2 == pytest.approx(1) for a, b, c in zip(x, y, z, strict=True))
