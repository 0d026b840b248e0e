"""A formula as a chain of sides: their text, shape and place, and the branches of plus and minus."""

from __future__ import annotations

import pytest

from derive.course.latex.reading import MAX_SIDES
from derive.errors import Rejected
from tests.course.latex.formula import complaint, letter, read

a, b, h = (letter(name) for name in "abh")


def test_each_side_has_its_text_its_shape_and_its_place() -> None:
    number, vector = read(r"2 a = \{a, b, h\}").sides
    assert (number.text, number.shape, number.place.column) == ("2 a", (), 1)
    assert (vector.text, vector.shape, vector.place.column) == (r"\{a, b, h\}", (3, 1), 7)
    assert [expr for expr, _ in vector.branches[0]] == [a, b, h]


def test_a_row_that_begins_with_a_mark_goes_on_with_the_row_before() -> None:
    assert read(r"a \\ + b \\ = h \\ \cdot 2").marks == ("", "=")
    assert complaint(r"a \\ b").message


def test_both_branches_are_of_one_shape() -> None:
    assert complaint(r"a \text{ or } \{a,b,h\}").message == "the two branches have different shapes"
    plus, minus = read(r"a \pm b").sides[0].branches
    assert (plus[0][0], minus[0][0]) == (a + b, a - b)


def test_undeclared_letters_are_told_before_whatever_else_is_wrong() -> None:
    with pytest.raises(Rejected) as caught:
        read("q + p / 0")
    messages = [c.message for c in caught.value.complaints]
    assert messages[:2] == ["`q` is not declared", "`p` is not declared"]
    assert messages[2:] == ["division by zero"]


def test_an_undeclared_letter_is_told_once_for_each_place() -> None:
    with pytest.raises(Rejected) as caught:
        read("q = q")
    assert [c.place and c.place.column for c in caught.value.complaints] == [1, 5]


def test_a_chain_has_an_end() -> None:
    assert len(read("=".join(["a"] * MAX_SIDES)).sides) == MAX_SIDES
    assert complaint("=".join(["a"] * (MAX_SIDES + 1))).code == "too-large"
