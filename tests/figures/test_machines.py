"""A leaning top and a rolled slab: places, directions and names, before they are drawn."""

from __future__ import annotations

from sympy import Matrix, cos, sin

from derive.figures import drawing, slab_on_cylinder
from derive.figures.annotations import Arrow, PointMark
from derive.figures.pieces import Bullet
from derive.figures.surfaces import Polyhedron, Revolved, ThinRod
from derive.mechanics import Coordinate, rolled_centre
from tests.figures.scenery import SLAB, M, R, a, leaning, pieces_of, theta


def test_the_rod_of_a_top_leans_by_the_tilt_and_has_its_length() -> None:
    rods = [mark for mark in leaning() if isinstance(mark, ThinRod)]
    end = Matrix(rods[-1].end)
    assert end[2] == 2 * a * cos(theta)
    assert (end.dot(end) - 4 * a**2).simplify() == 0
    assert (end[0] ** 2 + end[1] ** 2 - (2 * a * sin(theta)) ** 2).simplify() == 0


def test_the_weight_of_a_top_acts_in_the_middle_of_its_disc_and_downwards() -> None:
    weight = next(mark for mark in leaning(weight=M) if isinstance(mark, Arrow))
    assert Matrix(weight.start)[2] == a * cos(theta)
    assert list(weight.value) == [0, 0, -1]


def test_the_centre_of_a_rolled_slab_is_where_rolling_takes_it() -> None:
    """x = (R + a/2) sin q - R q cos q, y = (R + a/2) cos q + R q sin q; the corners are about that centre."""
    marks = slab_on_cylinder(R, a, theta)
    x, y = (R + a / 2) * sin(theta) - R * theta * cos(theta), (R + a / 2) * cos(theta) + R * theta * sin(theta)
    corners = next(mark.corners for mark in marks if isinstance(mark, Polyhedron))
    mean = sum((Matrix(corner) for corner in corners), Matrix([0, 0, 0])) / 4
    assert (mean - Matrix([x, y, 0])).expand() == Matrix([0, 0, 0])


def test_the_derived_centre_of_a_slab_is_drawn_where_it_was_derived() -> None:
    x, y = rolled_centre(R, a / 2, Coordinate(theta, "angle"))
    marks = slab_on_cylinder(R, a, theta, (x, y), M)
    centre = next(mark for mark in marks if isinstance(mark, PointMark) and str(mark.label) == "C")
    assert list(centre.at) == [x.value, y.value, 0]
    assert centre.keys == ("x", "y")
    assert drawing("slab", marks, view="plane").keys == ("x", "y")
    assert drawing("slab", slab_on_cylinder(R, a, theta), view="plane").keys == ()


def test_the_point_of_contact_is_on_the_cylinder_and_on_the_face_of_the_slab() -> None:
    marks = slab_on_cylinder(R, a, theta, rolled_centre(R, a / 2, Coordinate(theta, "angle")))
    contact = Matrix(next(mark.at for mark in marks if isinstance(mark, PointMark) and str(mark.label) == "P"))
    assert (contact.dot(contact) - R**2).simplify() == 0
    corners = next(mark.corners for mark in marks if isinstance(mark, Polyhedron))
    face = Matrix(corners[1]) - Matrix(corners[0])
    assert (Matrix(corners[0]) - contact).cross(face).applyfunc(lambda e: e.simplify()) == Matrix([0, 0, 0])


def test_a_rod_in_pieces_is_told_once_and_a_disc_without_its_thickness() -> None:
    rods = [mark for mark in leaning() if isinstance(mark, ThinRod)]
    assert [rod.name for rod in rods] == ["a thin rod", ""]
    assert rods[0].measures == (("length", 2 * a),)
    assert list(rods[0].end) == list(rods[1].start)
    assert [mark.measures for mark in leaning() if isinstance(mark, Revolved)] == [(("radius", a / 2),)]


def test_a_slab_that_turned_the_other_way_lies_on_the_other_side() -> None:
    contact = {sign: [p.spot for p in pieces_of(SLAB, theta=sign * 0.5) if isinstance(p, Bullet)] for sign in (1, -1)}
    middle, right, left = contact[1][0], contact[1][1], contact[-1][1]
    assert right[0] > middle[0] + 10
    assert left[0] < contact[-1][0][0] - 10
