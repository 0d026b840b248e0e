"""Tests of the places, directions and names of the marks of a top."""

from __future__ import annotations

from sympy import Matrix, cos, sin

from derive.figures.annotations import Arrow, Turn
from derive.figures.surfaces import Revolved, ThinRod
from tests.figures.scenery import a, leaning, theta


def test_the_rod_of_a_top_leans_by_the_tilt_and_has_its_length() -> None:
    rods = [mark for mark in leaning().marks if isinstance(mark, ThinRod)]
    end = Matrix(rods[-1].end)
    assert end[2] == 2 * a * cos(theta)
    assert (end.dot(end) - 4 * a**2).simplify() == 0
    assert (end[0] ** 2 + end[1] ** 2 - (2 * a * sin(theta)) ** 2).simplify() == 0


def test_the_weight_of_a_top_acts_in_the_middle_of_its_disc_and_downwards() -> None:
    weight = next(mark for mark in leaning(weights=True).marks if isinstance(mark, Arrow))
    assert Matrix(weight.start)[2] == a * cos(theta)
    assert list(weight.value) == [0, 0, -1]
    assert weight.keys == ()  # a symbol does not show an answer


def test_a_body_that_turns_about_the_vertical_and_about_itself_has_an_arrow_round_each() -> None:
    turns = [mark for mark in leaning().marks if isinstance(mark, Turn)]
    assert [str(turn.label) for turn in turns] == ["phi", "psi"]
    assert list(turns[0].along)[:2] == [0, 0] and Matrix(turns[1].along)[2] == 2 * a * cos(theta)


def test_a_rod_in_pieces_is_told_once_and_a_disc_without_its_thickness() -> None:
    rods = [mark for mark in leaning().marks if isinstance(mark, ThinRod)]
    assert [rod.name for rod in rods] == ["rod", ""]
    assert rods[0].measures == (("length", 2 * a),)
    assert list(rods[0].end) == list(rods[1].start)
    assert [mark.measures for mark in leaning().marks if isinstance(mark, Revolved)] == [(("radius", a / 2),)]
