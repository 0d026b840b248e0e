"""Tests of the surfaces that are drawn for rolling conditions, such as a cylinder inside or around a body."""

from __future__ import annotations

from typing import Any

from sympy import Matrix, cos, pi, sin, symbols, tan

from derive.algebra.expressions import scalar
from derive.figures import sketch
from derive.figures.annotations import Line, PointMark, Support, Turn
from derive.figures.contacts import UprightAngle
from derive.figures.parts import ConnectionMark
from derive.figures.pieces import Bullet
from derive.figures.placed_bodies import SilhouetteMark
from derive.figures.surfaces import Circle
from derive.figures.surroundings import AngleBetween, DistanceMark
from derive.mechanics import Cone, Disc, System, Y, Z, coordinate, no_slip, point, space, weight
from derive.steps.record import recorded
from tests.figures.scenery import SLAB, M, R, a, pieces_of, slab, theta

b = symbols("b", positive=True)


def test_the_centre_of_a_rolled_slab_is_where_rolling_takes_it() -> None:
    """x = (R + a/2) sin q - R q cos q, y = (R + a/2) cos q + R q sin q."""
    x, y = (R + a / 2) * sin(theta) - R * theta * cos(theta), (R + a / 2) * cos(theta) + R * theta * sin(theta)
    corners = next(mark.corners for mark in SLAB.marks if isinstance(mark, SilhouetteMark))
    mean = sum((Matrix(corner) for corner in corners), Matrix([0, 0])) / 4
    assert (mean - Matrix([x, y])).expand() == Matrix([0, 0])


def test_the_point_of_contact_is_on_the_cylinder_and_on_the_face_of_the_slab() -> None:
    line = next(mark for mark in SLAB.marks if isinstance(mark, ConnectionMark))
    contact = Matrix(line.end)
    assert (contact.dot(contact) - R**2).simplify() == 0
    assert (list(line.start), line.label) == ([0, 0], R)
    corners = next(mark.corners for mark in SLAB.marks if isinstance(mark, SilhouetteMark))
    face, beside = Matrix(corners[1]) - Matrix(corners[0]), Matrix(corners[0]) - contact
    assert (face[0] * beside[1] - face[1] * beside[0]).simplify() == 0
    assert any(isinstance(mark, PointMark) and Matrix(mark.at) == contact for mark in SLAB.marks)


def test_the_angle_of_the_contact_and_the_side_that_is_a_letter_are_named() -> None:
    assert [mark.label for mark in SLAB.marks if isinstance(mark, AngleBetween)] == [theta]
    assert [mark.label for mark in SLAB.marks if isinstance(mark, DistanceMark)] == [a]


def test_a_body_of_which_only_a_moment_is_known_is_drawn_as_the_shape_that_it_is_given() -> None:
    shape, given = (next(m for m in each.marks if isinstance(m, SilhouetteMark)) for each in (SLAB, slab(M * a**2)))
    assert given.corners == shape.corners
    assert given.measures == ()


def test_a_disc_that_rolls_inside_a_cylinder_hides_nothing_of_it() -> None:
    with recorded():
        phi, psi = coordinate("phi"), coordinate("psi")
        disc = Disc(a, M).placed(psi, point(b * sin(phi), -b * cos(phi)), across="z")
        rolling = no_slip(disc, at=point((a + b) * sin(phi), -(a + b) * cos(phi)))
        marks = sketch("inside", System(disc, rolling, weight(a))).marks
    circle = next(mark for mark in marks if isinstance(mark, Circle))
    assert (circle.radius, circle.filled) == (a + b, False)
    # The disc would cover a line to the contact. The line between the axes is drawn over the disc.
    assert not any(isinstance(mark, ConnectionMark) for mark in marks)
    assert [(list(mark.end), mark.label) for mark in marks if isinstance(mark, Line)] == [
        ([b * sin(phi.symbol), -b * cos(phi.symbol)], b)
    ]
    assert next(mark for mark in SLAB.marks if isinstance(mark, Circle)).filled


def test_a_slab_that_turned_the_other_way_lies_on_the_other_side() -> None:
    spots = {sign: [p.spot for p in pieces_of(SLAB, theta=sign * 0.5) if isinstance(p, Bullet)] for sign in (1, -1)}
    assert spots[1][1][0] > spots[1][0][0] + 5
    assert spots[-1][1][0] < spots[-1][0][0] - 5


def rolling_cone(*more: Any) -> Any:
    """Landau and Lifshitz, Mechanics, section 32, problem 7."""
    phi, psi = coordinate("phi"), coordinate("psi")
    alpha = scalar("alpha", positive=True)
    line = space.turned(Z, phi)
    cone = Cone(a * tan(alpha), a, M).held(line.turned(Y, pi / 2 - alpha).turned(Z, psi), "apex")
    return sketch("cone", System(cone, no_slip(cone, at=line.place(a, 0, 0)), *more))


def test_a_cone_that_rolls_on_a_plane_lies_there_and_turns_about_its_axis() -> None:
    with recorded():
        found = rolling_cone()
    assert found is not None
    assert [str(mark.label) for mark in found.marks if isinstance(mark, Turn)] == ["psi"]
    assert [str(mark.label) for mark in found.marks if type(mark) is AngleBetween] == ["phi"]
    assert [str(mark.label) for mark in found.marks if isinstance(mark, UprightAngle)] == ["alpha"]
    assert not any(isinstance(mark, Support) for mark in found.marks)
