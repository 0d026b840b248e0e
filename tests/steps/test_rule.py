"""A rule: an outcome must be one that it has, and be true; names in a sentence must be those of the result."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace

import pytest
from sympy import Symbol

from derive.steps import rule as rules
from derive.steps.level import Level, Manner
from derive.steps.rule import CHECK, Judged, Quote, Rule, Shown, Theorem, handed_on_by, wrongly_handed_on
from derive.steps.step import Fact
from derive.steps.subject import Mixed, Subject

SIGN = Rule(
    "test.sign",
    outcomes={"positive": lambda f: f.result > 0, "zero": lambda f: f.result == 0},
    evidence={"again": CHECK},
    named={"letter": lambda facts, value: value == "x", "value": lambda facts, value: value > 0},
)
PLAIN = Rule("test.plain")


class Size(Fact):
    def __init__(self, value: int):
        self.value = value


@pytest.fixture(autouse=True)
def no_predicate_is_left() -> Iterator[None]:
    yield
    rules._HANDED_ON.pop(Size, None)


def test_an_outcome_is_right_where_its_predicate_holds() -> None:
    assert SIGN.verdict("positive", Judged(1))
    assert not SIGN.verdict("positive", Judged(0))
    assert SIGN.verdict("zero", Judged(0))


def test_an_outcome_that_the_rule_does_not_have_is_never_right() -> None:
    assert not SIGN.verdict("negative", Judged(-1))
    assert not SIGN.verdict("generic", Judged(-1))


def test_a_rule_without_more_has_one_outcome_and_is_a_definition() -> None:
    assert PLAIN.verdict("generic", Judged(1))
    assert not PLAIN.verdict("conserved", Judged(0))
    assert PLAIN.is_definition and not SIGN.is_definition
    assert PLAIN.key == "plain"


def test_each_statement_of_a_sentence_is_judged() -> None:
    twice = Rule("test.twice", statements=[lambda f, _: f.inputs["times"] == 2, lambda f, _: f.inputs["sign"] > 0])
    assert twice.verdict("generic", Judged(0, {"times": 2, "sign": 1}))
    assert not twice.verdict("generic", Judged(0, {"times": 3, "sign": 1}))
    assert not twice.verdict("generic", Judged(0, {"times": 2, "sign": -1}))


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
    assert bool(PLAIN.verdict("generic", Judged(1, subject=subject, words=words))) is rightly


def test_what_a_sentence_names_needs_a_predicate_that_holds_of_it() -> None:
    assert SIGN.wrongly_named(Judged(1), {}) is None
    assert PLAIN.wrongly_named(Judged(1), {"letter": "x"}) == "letter"  # which nothing judges
    assert SIGN.wrongly_named(Judged(1), {"letter": "x", "value_1": 1, "value_2": 2}) is None
    assert SIGN.wrongly_named(Judged(1), {"letter": "y"}) == "letter"
    assert SIGN.wrongly_named(Judged(1), {"value_1": 1, "value_2": -2}) == "value_2"


def test_a_fact_that_a_step_returns_is_compared_with_its_value() -> None:
    assert wrongly_handed_on(Judged(1), [Size(2)]) is None  # as nothing says what a size is
    handed_on_by(Size, lambda facts, fact: fact.value == facts.result)
    assert wrongly_handed_on(Judged(1), [Size(1)]) is None
    wrong = Size(2)
    assert wrongly_handed_on(Judged(1), [Size(1), wrong]) is wrong


@pytest.mark.parametrize(("letter", "rightly"), [("I_z", True), ("I_x", False), ("I", True), ("I_max", True)])
def test_the_index_of_a_letter_is_the_axis_that_the_sentence_names(letter: str, rightly: bool) -> None:
    facts = Judged(1, symbol=Symbol(letter), subject=Subject(axis="z"), words={"axis": "z"})
    assert bool(PLAIN.verdict("generic", facts)) is rightly
    part = Judged(1, symbol=Symbol(letter), subject=Subject(axis="y"), words={"axis": "y", "whole": "z"})
    assert bool(PLAIN.verdict("generic", part)) is rightly


def test_a_theorem_is_used_in_its_outcomes_and_between_what_it_is_about() -> None:
    quote = Quote(Theorem("multipliers", "lambda f", "a book"), frozenset({"kept"}), between=frozenset({"rates"}))
    assert quote.fits("kept", "rates")
    assert not quote.fits("free", "rates") and not quote.fits("kept", "coordinates")


def test_an_outcome_may_be_shown_in_another_way_than_the_rule() -> None:
    shown = Shown(brief=Manner.LEFT_OUT, outcomes={"linear": (Manner.OWN, Manner.TOLD)})
    plain, linear = (shown.of(SimpleNamespace(outcome=outcome)) for outcome in ("generic", "linear"))
    assert [plain.manner(level) for level in (Level.BRIEF, Level.STANDARD)] == [Manner.LEFT_OUT, Manner.OWN]
    assert [linear.manner(level) for level in (Level.BRIEF, Level.STANDARD)] == [Manner.OWN, Manner.TOLD]
    assert plain.told_along and not linear.told_along


def test_a_predicate_of_the_step_may_decide_that_it_is_taken_in() -> None:
    shown = Shown(taken_in_if=lambda step: step.outcome == "plain")
    assert shown.of(SimpleNamespace(outcome="plain")).manner(Level.STANDARD) is Manner.TAKEN_IN
    assert shown.of(SimpleNamespace(outcome="generic")).manner(Level.STANDARD) is Manner.OWN


def test_a_result_alone_is_shown_up_to_a_level() -> None:
    of_brief = Shown(result_again=Level.BRIEF).of(SimpleNamespace(outcome="generic"))
    assert [of_brief.shows_result_alone(level) for level in Level] == [True, False, False]
