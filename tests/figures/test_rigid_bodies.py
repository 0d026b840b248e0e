"""Tests of bodies with given principal moments: the drawn ellipsoid, and vectors in their true directions."""

from __future__ import annotations

import pytest
from sympy import Expr, Rational, simplify, symbols

from derive.figures import drawing, principal_outline
from derive.figures.annotations import Arrow, Axis, PointMark
from derive.figures.pieces import Patch
from derive.figures.rigid_bodies import THICK
from derive.figures.surfaces import EllipsoidMark
from derive.mechanics import RigidBody, angular_momentum, changing_angular_velocity
from derive.steps.record import recorded
from tests.figures.machines import at, labels, of
from tests.figures.scenery import pieces_of, strokes

A, B, C = symbols("A B C", positive=True)


def test_it_is_thick_across_the_axis_about_which_its_moment_is_small() -> None:
    found = drawing("body", principal_outline((A, A, C)))
    (body,) = of(found, EllipsoidMark)
    a, b, c = body.semi_axes
    assert simplify(a - b) == 0
    whole: Expr = 2 * A + C
    # For an ellipsoid, I_x - I_z is proportional to c^2 - a^2, with the same factor for all pairs of axes.
    assert simplify((c**2 - a**2) / (A - C)) == 2
    assert simplify(a**2 - (C + THICK * whole)) == 0
    assert {str(each) for each in labels(found, Axis)} == {"x", "y", "z"}
    assert [at(mark.at) for mark in of(found, PointMark)] == [[0, 0, 0]]


def test_omega_and_the_angular_momentum_point_where_they_do() -> None:
    with recorded():
        omega = changing_angular_velocity("centre_of_mass")
        L = angular_momentum(RigidBody(moments=(A, B, C)).tensor, omega)
        found = drawing("body", principal_outline((A, B, C), omega, L))
    one, other = of(found, Arrow)
    ratios = [y / x for x, y in zip(one.value, other.value, strict=True)]
    assert ratios == [A, B, C]
    assert found.keys == ()  # a direction that contains only symbols does not show an answer


@pytest.mark.parametrize("moments", [(1, 1, 2), (1, 1, 0), (2, 3, 4)], ids=["flat", "a line", "any"])
def test_every_body_has_an_outline(moments: tuple[int, int, int]) -> None:
    pieces = pieces_of(drawing("body", principal_outline([Rational(m) for m in moments])))
    (patch,) = [piece for piece in pieces if isinstance(piece, Patch)]
    assert len(strokes(pieces, "edge")) == 1
    inside = [spot for piece in strokes(pieces, "thin") for spot in piece.spots]
    for k in (0, 1):
        low, high = min(s[k] for s in patch.spots), max(s[k] for s in patch.spots)
        assert all(low - 0.1 <= spot[k] <= high + 0.1 for spot in inside)
