"""Tests of tops: the line of nodes, the axes that follow it, and the dimensions of the parts."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Matrix, simplify, symbols

from derive.algebra.expressions import TIME
from derive.figures import sketch
from derive.figures.annotations import Axis, LengthMark, Line, PointMark, Turn, Weight
from derive.figures.marks import Drawing
from derive.figures.surroundings import UprightAngle
from derive.figures.tops import following_axes, follows_nodes, stance_values
from derive.mechanics import (
    Composite,
    Cuboid,
    Disc,
    RigidBody,
    Rod,
    System,
    X,
    Y,
    Z,
    coordinate,
    space,
    symbolic_body,
    weight,
)
from derive.steps.record import recorded
from tests.figures.machines import at, labels, of
from tests.figures.scenery import heading, leaning, pieces_of, strokes, theta

a, M, g, A, B, C, l = symbols("a M g A B C l", positive=True)


def top_of(body: Any, second: Any = X) -> tuple[Drawing, System]:
    with recorded():
        phi, tilt, psi = coordinate("phi"), coordinate("theta"), coordinate("psi")
        system = System(body.held(space.turned(Z, phi).turned(second, tilt).turned(Z, psi), at="pivot"), weight(g))
        return sketch("top", system), system


def rigid(*moments: Any) -> RigidBody:
    return RigidBody(M, moments, centre=(0, 0, l))


def test_the_axes_follow_the_line_of_nodes_and_not_the_spin() -> None:
    found = leaning()
    assert sorted(labels(found, Axis), key=str) == ["Z", "x", "y", "z"]
    x, y, z = (next(Matrix(m.end - m.start) for m in of(found, Axis) if str(m.label) == name) for name in "xyz")
    assert x[2] == 0
    assert all(simplify(one.dot(other)) == 0 for one, other in ((x, y), (y, z), (z, x)))
    assert simplify(x.cross(y).dot(z)).subs({theta: 0.7, a: 1.0}) > 0
    assert "psi" not in {str(letter) for axis in (x, y, z) for letter in axis.free_symbols}


def test_the_vertical_is_dashed_where_the_disc_is_in_front_of_it() -> None:
    pieces = pieces_of(leaning(), theta=0.3)
    upright = [
        (min(y for _, y in stroke.spots), pen, stroke.head)
        for pen in ("axis", "hidden")
        for stroke in strokes(pieces, pen)
        if abs(heading(stroke) - 90) < 0.5
    ]
    assert [(pen, head) for _, pen, head in sorted(upright)] == [("axis", False), ("hidden", False), ("axis", True)]


def test_the_turns_go_round_the_vertical_and_round_the_axis() -> None:
    found = leaning()
    first, last = of(found, Turn)
    assert (str(first.label), str(last.label)) == ("phi", "psi")
    assert at(first.along)[:2] == [0, 0]
    axis = next(mark for mark in of(found, Axis) if str(mark.label) == "z")
    assert all(simplify(entry) == 0 for entry in Matrix(last.along).cross(Matrix(axis.end - axis.start)))
    assert labels(found, UprightAngle) == ["theta"]


def test_what_the_parts_measure_is_told_beside_the_axis() -> None:
    found = leaning(weights=True)  # a disc of radius a/2 in the middle of a rod of length 2a
    assert labels(found, LengthMark) == ["a", "2*a"]
    (radius,) = [mark for mark in of(found, Line) if mark.label is not None]
    way = Matrix(radius.end - radius.start)
    assert (radius.label, simplify(way.dot(way))) == (a / 2, a**2 / 4)
    (pull,) = of(found, Weight)
    assert [str(mark.label) for mark in of(found, PointMark) if mark.label is not None] == ["C"]
    assert at(pull.start) == at(next(mark.at for mark in of(found, PointMark) if mark.label is not None))


@pytest.mark.parametrize(("moments", "follows"), [((A, A, C), True), ((A, B, C), False)])
def test_only_of_a_symmetric_body_the_line_of_nodes_is_a_principal_axis(moments: Any, follows: bool) -> None:
    found, system = top_of(rigid(*moments))
    assert follows_nodes(system.bodies[0]) is follows
    assert {str(each) for each in labels(found, Axis)} == ({"x", "y", "z", "Z"} if follows else {"Z"})
    assert labels(found, PointMark) == ["M"]  # the size of the body is unknown


def test_a_block_beside_the_axis_makes_no_symmetric_top() -> None:
    whole = Composite(Cuboid((a, a, a), M).at(0, 0, a), Rod(2 * a, M).at(0, 0, a), points={"pivot": (0, 0, 0)})
    placed = whole.held(space.turned(Z, theta).turned(X, theta).turned(Z, TIME), at="pivot")
    assert not follows_nodes(placed)


def test_what_is_inclined_the_other_way_has_no_line_of_nodes_in_front() -> None:
    _, nodes = top_of(rigid(A, A, C))
    _, other = top_of(rigid(A, A, C), Y)
    (one,), (two,) = stance_values(nodes).values(), stance_values(other).values()
    assert one != two
    assert following_axes(nodes.bodies[0])[0][2] == 0


@pytest.mark.parametrize("tilt", [0.1, 0.8, 1.3])
@pytest.mark.parametrize("radius", [a / 4, 2 * a])
def test_what_turns_clears_the_ground_under_the_pivot(tilt: float, radius: Any) -> None:
    whole = Composite(Disc(radius, M).at(0, 0, a), Rod(2 * a, M).at(0, 0, a), points={"pivot": (0, 0, 0)})
    with recorded():
        body = symbolic_body(whole)
        phi, psi = coordinate("phi"), coordinate("psi")
        found = sketch(
            "top", System(body.held(space.turned(Z, phi).turned(X, theta).turned(Z, psi), at="pivot"), weight(g))
        )
    pieces = pieces_of(found, theta=tilt, phi=-0.17)
    ground = min(y for piece in strokes(pieces, "edge") for _, y in piece.spots)
    level = [piece for piece in strokes(pieces, "edge") if {y for _, y in piece.spots} == {ground}]
    bodies = [y for piece in pieces if type(piece).__name__ == "Patch" for _, y in piece.spots]
    assert len(level) == 1
    assert min(bodies) > ground
