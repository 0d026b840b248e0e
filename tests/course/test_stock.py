"""Scripts of the engine: which there are, and how what they are given is read."""

from __future__ import annotations

import pickle

import pytest
from sympy import Symbol, pi

from derive.course.expression import Declared
from derive.course.stock import InLetters, each, in_keys, stock_names, stock_script, told_at
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Complaint, Place, Rejected, Spelled, rejected

l = Declared("l", Symbol("l", positive=True), "length")
HERE = Place("a.yaml", 3)


def node(text: str) -> Scalar:
    return Scalar(text, "", 0, len(text), Source("a.yaml", text))


def test_each_script_of_the_engine_says_what_may_be_given() -> None:
    assert "system" in stock_names()
    for name in stock_names():
        assert stock_script(name).keys


def test_a_component_may_have_either_sign_and_zero_any_dimension() -> None:
    letters = InLetters({"l": l})
    assert letters.of_kind(node("-2*l"), "x", "length") == -2 * l.symbol
    assert letters.of_kind(node("0"), "x", "length") == 0
    with pytest.raises(Rejected, match="`x` must be positive"):
        letters.value(node("-2*l"), "x", "length")


def test_the_faults_of_all_are_told() -> None:
    def wrong(text: str) -> None:
        rejected("wrong", text, HERE)

    with pytest.raises(Rejected) as refused:
        each([lambda: wrong("one"), lambda: None, lambda: wrong("two")])
    assert [c.message for c in refused.value.complaints] == ["one", "two"]


def test_a_complaint_of_a_verb_stands_where_it_was_asked_for() -> None:
    with pytest.raises(Rejected) as refused, told_at(HERE):
        raise Rejected(Complaint("wrong", "no"))
    assert refused.value.complaints[0].place == HERE


def test_a_number_goes_behind_a_letter() -> None:
    letters = InLetters({"l": l})
    first, second, again = (letters.value(node(text), "a", "length") for text in ("2 m", "3 m", "200 cm"))
    assert first == again != second
    assert [(str(m.symbol), m.si) for m in letters.numbers.measured] == [(str(first), 2), (str(second), 3)]
    assert set(letters.chosen) == {str(first), str(second)}
    assert letters.of_kind(node("30 deg"), "a", "angle") == pi / 6


def test_a_help_for_scripts_is_said_in_the_keys_of_a_file() -> None:
    both = Spelled("give the equation of motion as `motion=...`", "add `results: motion_theta`, its equation of motion")
    assert in_keys(both) == "add `results: motion_theta`, its equation of motion"
    assert pickle.loads(pickle.dumps(both)).in_file == both.in_file
    assert in_keys("the lower limit stands first") == "the lower limit stands first"


def test_the_sign_of_a_number_stays_outside_its_letter_and_a_size_has_none() -> None:
    letters = InLetters({"l": l})
    component = letters.of_kind(node("-3 m"), "x", "length")
    assert component.is_negative
    assert [m.si for m in letters.numbers.measured] == [3]
    for text, or_zero in (("-3 m", False), ("-3 m", True), ("0", False)):
        with pytest.raises(Rejected, match="must not be negative" if or_zero else "must be positive"):
            letters.value(node(text), "length", "length", or_zero=or_zero)
    assert letters.value(node("0"), "length", "length", or_zero=True) == 0
