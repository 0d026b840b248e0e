"""Tests of recorded drawings: their values, names and keys, and the errors for invalid vectors and names."""

from __future__ import annotations

import pytest

from derive.algebra.expressions import column
from derive.errors import Rejected
from derive.figures import arc, arrow, drawing, outline, plot, point_mark
from derive.figures.annotations import AngleMark, Arrow
from derive.mechanics import Cuboid
from derive.steps.record import recorded
from tests.figures.scenery import M, a, theta, vectors_of_block
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
    assert point_mark(block.centre).keys == ("centre_of_mass",)
    assert point_mark(block.middle).keys == ()


def test_drawings_are_recorded_in_their_order() -> None:
    with recorded() as run:
        drawing("b", point_mark(column(0, 0, 0)))
        drawing("a", point_mark(column(0, 0, 0)))
    assert [found.key for found in run.drawings] == ["b", "a"]


def test_a_name_stands_for_one_drawing() -> None:
    with recorded():
        drawing("one", point_mark(column(0, 0, 0)))
        with pytest.raises(Rejected, match="both called `one`"):
            drawing("one", point_mark(column(1, 0, 0)))


@pytest.mark.parametrize("name", ["", "A b", "../up", "x" * 40])
def test_a_name_that_could_not_be_a_file_is_refused(name: str) -> None:
    with pytest.raises(Rejected, match="cannot name a drawing"):
        drawing(name, point_mark(column(0, 0, 0)))


def test_what_is_no_vector_is_refused() -> None:
    with pytest.raises(Rejected, match="needs a vector or a place here, but `kinetic_energy` is not one"):
        arrow(known_block()["kinetic_energy"])
    with pytest.raises(Rejected, match="but the value is of type int"):
        point_mark(3)
    with pytest.raises(Rejected, match="no view"):
        drawing("one", point_mark(column(0, 0, 0)), view="side")
    with pytest.raises(Rejected, match="outline of a Symbol"):
        outline(a)


def test_a_plot_needs_a_quantity_that_depends_on_its_letter() -> None:
    with pytest.raises(Rejected, match="needs a scalar that depends on theta, but"):
        plot("energy", known_block()["magnitude"], theta, (0, 1))


def test_an_angle_may_be_named_by_the_quantity_that_it_is() -> None:
    known = known_block()
    found = arc(known["spin"], known["angular_momentum"], known["angle_between"])
    assert isinstance(found, AngleMark)
    assert found.label == known["angle_between"].symbol
    assert set(found.keys) == {"spin", "angular_momentum", "angle_between"}
