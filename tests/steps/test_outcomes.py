"""Outcomes: a word must be one that its rule has, and be true; names in a sentence must be those of the result."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from derive.steps import outcomes
from derive.steps.outcomes import Judged, holds, known_outcomes, outcomes_of, told_by, told_rightly
from derive.steps.subject import Mixed, Subject


@pytest.fixture(autouse=True)
def rule() -> Iterator[None]:
    outcomes_of("test.sign", {"positive": lambda f: f.result > 0, "zero": lambda f: f.result == 0})
    yield
    outcomes._PREDICATES.pop("test.sign")
    outcomes._TOLD.pop("test.sign", None)


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
