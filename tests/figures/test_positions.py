"""Tests of the positions and directions that scripts give to drawings, and of the steps that they use."""

from __future__ import annotations

import pytest

from derive.algebra.expressions import column, scalar
from derive.errors import Rejected
from derive.figures.positions import column_of, name_of, towards, vector_of, vectors_of
from derive.mechanics import Coordinate, point
from tests.figures.machines import l, letter
from tests.mechanics.block import known_block


def test_a_place_of_a_system_keeps_its_two_or_three_components() -> None:
    assert list(vector_of(point(l, 0))[0]) == [l, 0]
    assert list(vector_of(point(l, 0, 1))[0]) == [l, 0, 1]
    assert column_of(point(l, 0)).shape == (2, 1)


def test_a_derived_place_brings_its_key_and_one_that_is_given_none() -> None:
    known = known_block()
    assert vector_of(known["torque"])[1] == ("torque",)
    assert vectors_of(column(0, 0, 1), known["torque"])[1] == ("torque",)
    assert vectors_of(point(0, 1), point(1, 0))[1] == ()


def test_places_in_a_plane_and_in_space_do_not_mix() -> None:
    with pytest.raises(Rejected, match="two components, and some have three"):
        vectors_of(point(0, 1), point(0, 0, 1))


def test_what_is_no_place_is_refused() -> None:
    with pytest.raises(Rejected, match="needs a vector or a place here, but the value is of type int"):
        vector_of(3)


def test_a_label_is_a_word_a_letter_or_a_coordinate() -> None:
    theta = Coordinate(letter("theta"), "angle")
    assert name_of(None, theta) == theta.symbol
    assert name_of(None, "A") == scalar("A")
    assert name_of(known_block()["torque"], None) == known_block()["torque"].symbol


def test_sides_are_those_of_the_paper() -> None:
    assert list(towards("down", 2)) == [0, -1]
    assert list(towards("up", 3)) == [0, 0, 1]
    with pytest.raises(Rejected, match='no side "dwon"') as refused:
        towards("dwon", 2)
    assert refused.value.complaints[0].help == "did you mean `down`?"
