"""From letters to places on paper: a number for each, and a stance from which one sees what is shown."""

from __future__ import annotations

from itertools import combinations
from math import isclose

import pytest
from sympy import Rational, sqrt

from derive.algebra.expressions import column
from derive.errors import Rejected
from derive.figures import arrow, drawing, outline
from derive.figures.space import dot, size_of, unit
from derive.mechanics import Cuboid
from derive.render.drawing.camera import Numbers, stance_from, stand_ins
from tests.figures.scenery import M, a, heading, pieces_of, strokes
from tests.mechanics.block import b, c


def test_letters_without_numbers_are_told_apart() -> None:
    stand_in = stand_ins([(a, "length"), (b, "length"), (M, "mass"), (c, "length")], {})
    assert [stand_in[letter] for letter in (a, b, c, M)] == [1.0, 1.5, 2.0, 1.0]


def test_a_letter_with_a_number_keeps_it_and_gives_the_others_their_size() -> None:
    stand_in = stand_ins([(a, "length"), (b, "length")], {a: Rational(1, 50)})
    assert stand_in[a] == 0.02
    assert 0.01 < stand_in[b] < 0.1


def test_a_value_that_is_not_real_is_refused() -> None:
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
