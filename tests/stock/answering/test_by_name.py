"""What is made of answers, of bodies and of rotations."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Rational, sqrt, symbols

from derive.algebra.equality import equal
from derive.course.yaml_tree import Word
from derive.errors import Place, Rejected
from derive.mechanics import let
from derive.steps.step import Quantity
from derive.stock.answering.by_name import ByName
from tests.stock.bodies import BLOCK, CONE
from tests.stock.described import edited, messages, solved

M, g = symbols("M g", positive=True)


def test_results_of_a_rotation(tmp_path: Path) -> None:
    """By hand: of edges a, 2a, 3a the moments are as 13, 10, 5, the rates as sqrt(3 8/50) to sqrt(3 8/(13 10))."""
    made = ("  along: diagonal\n", "  results: {ratio: {value: wobble_x/wobble_z}}\n")
    found = solved(tmp_path, edited(BLOCK, made, ("answer: torque", "answer: ratio")))
    assert equal(found["ratio"].value, sqrt(Rational(12, 25) / Rational(4, 13)))


def test_results_of_a_body(tmp_path: Path) -> None:
    """By hand: (3/10) M R^2 about the axis."""
    made = ("  about: apex\n", "  about: apex\n  results: {part: {value: moment_of_inertia_z/(M*R**2)}}\n")
    found = solved(tmp_path, edited(CONE, made, ("answer: inertia_tensor", "answer: part")))
    assert equal(found["part"].value, Rational(3, 10))


def test_what_is_made_of_itself_or_of_nothing_is_refused(tmp_path: Path) -> None:
    made = (
        "  about: apex\n",
        "  about: apex\n  results: {one: {value: 2*two}, two: {value: one/2}, three: {value: 2*four}}\n",
    )
    text = edited(CONE, made, ("answer: inertia_tensor", "answer: [one, three]"))
    assert messages(tmp_path, text) == ["7: `one` is computed from itself", "7: a body has no answer called `four`"]


def word(name: str, line: int) -> Word:
    return Word.at(name, Place("p.yaml", line))


def mass() -> Quantity:
    return let("mass", lambda: M, kind="mass")


def test_each_answer_is_under_its_name() -> None:
    (found,) = ByName({"mass": mass, "speed": lambda: 1 / 0}, "a body").answers([word("mass", 1)]).values()
    assert isinstance(found, tuple) and [quantity.key for quantity in found] == ["mass"]


def test_all_names_that_are_no_answers_are_told() -> None:
    with pytest.raises(Rejected) as refused:
        ByName({"mass": mass}, "a body").answers([word("mas", 1), word("w", 2)])
    assert [(c.message, c.help, c.place and c.place.line) for c in refused.value.complaints] == [
        ("a body has no answer called `mas`", "did you mean `mass`?", 1),
        ("a body has no answer called `w`", "you may ask for mass", 2),
    ]
