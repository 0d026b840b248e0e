"""Outcomes: a word must be one that its rule has, and be true; names in a sentence must be those of the result."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from sympy import Symbol

from derive.steps import outcomes
from derive.steps.rule import (
    Judged,
    handed_on_by,
    holds,
    known_outcomes,
    named_by,
    outcomes_of,
    told_by,
    told_rightly,
    wrongly_handed_on,
    wrongly_named,
)
from derive.steps.step import Fact
from derive.steps.subject import Mixed, Subject


class Size(Fact):
    def __init__(self, value: int):
        self.value = value


@pytest.fixture(autouse=True)
def rule() -> Iterator[None]:
    outcomes_of("test.sign", {"positive": lambda f: f.result > 0, "zero": lambda f: f.result == 0})
    yield
    outcomes._PREDICATES.pop("test.sign")
    outcomes._TOLD.pop("test.sign", None)
    outcomes._NAMED.pop("test.sign", None)
    outcomes._HANDED_ON.pop(Size, None)


def test_a_word_holds_where_its_predicate_does() -> None:
    assert holds("test.sign", "positive", Judged(1))
    assert not holds("test.sign", "positive", Judged(0))
    assert holds("test.sign", "zero", Judged(0))


def test_a_word_that_the_rule_does_not_have_never_holds() -> None:
    assert not holds("test.sign", "negative", Judged(-1))
    assert not holds("test.sign", "generic", Judged(-1))
    assert known_outcomes()["test.sign"] == ("positive", "zero")


def test_a_rule_of_which_nothing_is_said_has_no_word_of_its_own() -> None:
    assert holds("test.unheard_of", "generic", Judged(1))
    assert holds("test.unheard_of", "zero", Judged(0))
    assert not holds("test.unheard_of", "conserved", Judged(0))


def test_what_a_sentence_tells_besides_is_judged_by_its_own_predicate() -> None:
    assert told_rightly("test.sign", "zero", Judged(0))
    told_by("test.sign", lambda facts, outcome: facts.inputs["times"] == 2 and outcome == "zero")
    assert told_rightly("test.sign", "zero", Judged(0, {"times": 2}))
    assert not told_rightly("test.sign", "zero", Judged(0, {"times": 3}))
    assert not told_rightly("test.sign", "positive", Judged(0, {"times": 2}))


class Apex:
    name = "apex"


@pytest.mark.parametrize(
    ("subject", "words", "rightly"),
    [
        (Subject(point=Apex()), {"about": "apex"}, True),
        (Subject(point=Apex()), {"about": "base"}, False),
        (Subject(point=Apex()), {"point": "base"}, False),
        (Subject(point=Apex()), {}, True),
        (Subject(point=Mixed.SEVERAL), {"about": "base"}, True),
        (Subject(), {"about": "base", "axis": "z"}, True),
        (Subject(axis="x"), {"axis": "x", "axis_letter": "x"}, True),
        (Subject(axis="x"), {"axis": "x", "axis_letter": "y"}, False),
        (Subject(axis=Mixed.SEVERAL), {"axis": "y"}, True),
    ],
)
def test_the_point_and_the_axis_that_are_named_are_those_of_the_result(
    subject: Subject, words: dict[str, str], rightly: bool
) -> None:
    assert bool(told_rightly("test.unheard_of", "generic", Judged(1, subject=subject, words=words))) is rightly


def test_what_a_sentence_names_needs_a_predicate_that_holds_of_it() -> None:
    assert wrongly_named("test.sign", Judged(1), {}) is None
    assert wrongly_named("test.sign", Judged(1), {"letter": "x"}) == "letter"  # which nothing judges
    named_by("test.sign", {"letter": lambda facts, value: value == "x", "value": lambda facts, value: value > 0})
    assert wrongly_named("test.sign", Judged(1), {"letter": "x", "value_1": 1, "value_2": 2}) is None
    assert wrongly_named("test.sign", Judged(1), {"letter": "y"}) == "letter"
    assert wrongly_named("test.sign", Judged(1), {"value_1": 1, "value_2": -2}) == "value_2"


def test_a_fact_that_a_step_returns_is_compared_with_its_value() -> None:
    assert wrongly_handed_on(Judged(1), [Size(2)]) is None  # as nothing says what a size is
    handed_on_by(Size, lambda facts, fact: fact.value == facts.result)
    assert wrongly_handed_on(Judged(1), [Size(1)]) is None
    wrong = Size(2)
    assert wrongly_handed_on(Judged(1), [Size(1), wrong]) is wrong


@pytest.mark.parametrize(("letter", "rightly"), [("I_z", True), ("I_x", False), ("I", True), ("I_max", True)])
def test_the_index_of_a_letter_is_the_axis_that_the_sentence_names(letter: str, rightly: bool) -> None:
    facts = Judged(1, symbol=Symbol(letter), subject=Subject(axis="z"), words={"axis": "z"})
    assert bool(told_rightly("test.sign", "positive", facts)) is rightly
    part = Judged(1, symbol=Symbol(letter), subject=Subject(axis="y"), words={"axis": "y", "whole": "z"})
    assert bool(told_rightly("test.sign", "positive", part)) is rightly
