"""What a script records of a drawing: values, names and keys, as data that goes to JSON and back."""

from __future__ import annotations

import json

import pytest
from sympy import Matrix, cos, sin

from derive.algebra.expressions import column
from derive.errors import Rejected
from derive.figures import arc, arrow, drawing, outline, plot, point, slab_on_cylinder
from derive.figures.annotations import AngleMark, Arrow, LengthMark, PointMark
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.surfaces import Circle, Polyhedron, Revolved, ThinRod
from derive.mechanics import Ball, Coordinate, Cuboid, Cylinder, Hoop, Plate, rolled_centre
from derive.steps.record import recorded
from tests.figures.scenery import CONE, M, R, a, h, leaning, theta, vectors_of_block
from tests.mechanics.block import known_block


def test_an_arrow_holds_the_derived_vector_itself() -> None:
    known = known_block()
    found = arrow(known["angular_momentum"])
    assert isinstance(found, Arrow)
    assert found.value == known["angular_momentum"].value
    assert found.label == known["angular_momentum"].symbol
    assert found.keys == ("angular_momentum",)


def test_a_drawing_rests_on_what_is_derived_and_not_on_what_is_given() -> None:
    known = known_block()
    found = drawing("one", outline(Cuboid((a, a, a), M)), arrow(known["axis_vector"]), arrow(known["spin"]))
    assert found.keys == ("spin",)
    assert "angle_between" in vectors_of_block().keys


def test_a_derived_place_brings_its_key_along() -> None:
    block = Cuboid((a, 2 * a, 3 * a), M)
    assert point(block.centre).keys == ("centre_of_mass",)
    assert point(block.middle).keys == ()


def test_an_outline_has_the_sides_of_the_body() -> None:
    sides = (a, 2 * a, h)
    box = next(mark for mark in outline(Cuboid(sides, M)) if isinstance(mark, Polyhedron))
    assert tuple(box.corners[-1] - box.corners[0]) == sides
    assert [length for length, _ in box.lengths] == list(sides)


def test_drawings_go_to_json_and_back_unchanged() -> None:
    scenes = [
        vectors_of_block(),
        drawing("cone", outline(CONE), point(column(0, 0, h / 4), "C")),
        drawing("top", leaning(precession=theta, spin=theta, weight=M)),
        drawing("slab", slab_on_cylinder(R, a, theta), view="plane"),
        plot("torque", known_block()["magnitude"], a, (1, 2), of="length"),
    ]
    assert list(drawings_from_data(json.loads(json.dumps(drawings_to_data(scenes))))) == scenes


def test_drawings_are_recorded_in_their_order() -> None:
    with recorded() as run:
        drawing("b", point(column(0, 0, 0)))
        drawing("a", point(column(0, 0, 0)))
    assert [found.key for found in run.drawings] == ["b", "a"]


def test_a_name_stands_for_one_drawing() -> None:
    with recorded():
        drawing("one", point(column(0, 0, 0)))
        with pytest.raises(Rejected, match="both called `one`"):
            drawing("one", point(column(1, 0, 0)))


@pytest.mark.parametrize("name", ["", "A b", "../up", "x" * 40])
def test_a_name_that_could_not_be_a_file_is_refused(name: str) -> None:
    with pytest.raises(Rejected, match="cannot name a drawing"):
        drawing(name, point(column(0, 0, 0)))


def test_what_is_no_vector_is_refused() -> None:
    with pytest.raises(Rejected, match="needs a vector or a place here, but `kinetic_energy` is none"):
        arrow(known_block()["kinetic_energy"])
    with pytest.raises(Rejected, match="but it is a int"):
        point(3)
    with pytest.raises(Rejected, match="no view"):
        drawing("one", point(column(0, 0, 0)), view="side")
    with pytest.raises(Rejected, match="no outline of a Symbol"):
        outline(a)


def test_a_plot_needs_a_quantity_that_depends_on_its_letter() -> None:
    with pytest.raises(Rejected, match="does not depend on theta"):
        plot("energy", known_block()["magnitude"], theta, (0, 1))


# --- bodies ---


@pytest.mark.parametrize(("about", "tip", "base"), [("apex", 0, h), ("base", h, 0), ("centre", -3 * h / 4, h / 4)])
def test_a_cone_is_seen_from_its_points(about: str, tip: object, base: object) -> None:
    (mark,) = [mark for mark in outline(CONE, about) if isinstance(mark, Revolved)]
    assert [(list(mark.through + z * mark.along), radius) for z, radius in mark.profile] == [
        ([0, 0, tip], 0),
        ([0, 0, base], R),
    ]
    assert [each.label for each in outline(CONE, about) if isinstance(each, LengthMark)] == [h]


@pytest.mark.parametrize(
    ("body", "kind"),
    [(Cylinder(R, h, M), Revolved), (Ball(R, M), Revolved), (Hoop(R, M), Circle), (Plate((R, h), M), Polyhedron)],
)
def test_every_body_has_an_outline(body: object, kind: type) -> None:
    assert sum(isinstance(mark, kind) for mark in outline(body)) == 1
    assert len(outline(body, named=False)) == 1


# --- scenes ----------------------------------------------------------------------------------------------------------


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


def test_an_angle_may_be_named_by_the_quantity_that_it_is() -> None:
    known = known_block()
    found = arc(known["spin"], known["angular_momentum"], known["angle_between"])
    assert isinstance(found, AngleMark)
    assert found.label == known["angle_between"].symbol
    assert set(found.keys) == {"spin", "angular_momentum", "angle_between"}


def test_a_rod_in_pieces_is_told_once_and_a_disc_without_its_thickness() -> None:
    rods = [mark for mark in leaning() if isinstance(mark, ThinRod)]
    assert [rod.name for rod in rods] == ["a thin rod", ""]
    assert rods[0].measures == (("length", 2 * a),)
    assert list(rods[0].end) == list(rods[1].start)
    assert [mark.measures for mark in leaning() if isinstance(mark, Revolved)] == [(("radius", a / 2),)]
