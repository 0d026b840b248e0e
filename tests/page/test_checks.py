"""Tests of the grades of steps, and of the counts of routes and checks."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, ClassVar

import pytest
from sympy import Integer, symbols

from derive.algebra.equality import LEAST_SURE_FIRST, Compared, Evidence, Grade
from derive.algebra.expressions import scalar
from derive.course.names import EvidenceShown
from derive.course.reference.errata import Erratum
from derive.page.checks import Checks, checks_of
from derive.page.template import templates_of
from derive.page.wording import Phrases, Text, phrases
from derive.steps.establish import establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Step, compared_with
from tests.courses import ROOT

a, b = symbols("a b", positive=True)


@pytest.fixture(scope="module")
def words() -> Phrases:
    return phrases(templates_of(ROOT))


def step(key: str, *claims: str) -> Step:
    """Return a step with (a + b)^2, by a rule whose second routes have words."""
    routes = dict.fromkeys(claims, compared_with(lambda: a**2 + 2 * a * b + b**2))
    rule = Rule("test.square", evidence={each: CHECK if each == "sum" else ROUTE for each in claims})
    made = establish(rule, scalar("s"), lambda: (a + b) ** 2, {}, key=key, routes=routes)
    return made.step


def told(outcome: str, erratum: Any = None, remark: Any = None) -> Any:
    return SimpleNamespace(outcome=outcome, erratum=erratum, remark=remark, facts={"document": "old.md"})


class OwnWords:
    labels: ClassVar = {"motion": "followed"}

    def route(self, step: Step, claim: str) -> str:
        return f"by {claim}"


def counted(*steps: Step, compared: Any = ()) -> Checks:
    return checks_of(steps, OwnWords(), compared)  # type: ignore[arg-type]


def test_steps_lines_and_routes_are_counted_apart() -> None:
    counts = counted(step("one", "particles", "sum"), step("two", "work"), step("named")).counts()
    assert (counts["steps_proved"], counts["steps_definition"], counts["steps_sampled"]) == (2, 1, 0)
    assert (counts["routes"], counts["routes_proved"], counts["checks"]) == (2, 2, 1)
    assert counts["lines"] == sum(len(s.chain) - 1 for s in (step("one", "sum"), step("two", "sum"), step("x", "sum")))


def test_neighbours_of_one_rule_that_were_checked_alike_are_one_row() -> None:
    rows = counted(step("one", "work"), step("two", "work"), step("three", "work", "sum"), step("four", "work")).rows
    assert [(row.steps, row.routes, row.checks) for row in rows] == [
        (("one", "two"), ("by work",), ()),
        (("three",), ("by work",), ("by sum",)),
        (("four",), ("by work",), ()),
    ]
    assert rows[0].lines == 2 * rows[2].lines


def witnessed(made: Step) -> Step:
    motion = Evidence("motion", Compared.WITNESS, Grade.SAMPLED, "12 states")
    return replace(made, evidence=(*made.evidence, motion))


def test_a_motion_that_was_followed_is_among_the_second_ways_of_a_row_and_counted_apart() -> None:
    checks = counted(witnessed(step("one", "work")), step("two", "work"), step("three", "work", "sum"))
    assert [(row.steps, row.routes, row.checks) for row in checks.rows] == [
        (("one",), ("by work", "followed"), ()),
        (("two",), ("by work",), ()),
        (("three",), ("by work",), ("by sum",)),
    ]
    counts = checks.counts()
    assert (counts["witnesses"], counts["routes"], counts["checks"], counts["claims_sampled"]) == (1, 3, 1, 0)


def test_the_closing_note_says_how_often_the_motion_was_followed(words: Phrases) -> None:
    def said(*steps: Step) -> str:
        nodes = counted(*steps).closing(words, EvidenceShown.END)
        return "".join(node.text for node in nodes if isinstance(node, Text))

    assert "numerically for 1 step. Counted" in " ".join(said(witnessed(step("one", "work"))).split())
    assert "numerically" not in said(step("one", "work"))


def test_statements_are_counted_by_how_they_compare() -> None:
    erratum = Erratum("energy", None, "a slip", Integer(1), Integer(2))
    checks = counted(compared=[told("agrees"), told("agrees to 4 figures"), told("agrees"), told("erratum", erratum)])
    assert (checks.agree, checks.agree_to_figures, checks.errata) == (2, 1, (erratum,))
    assert checks.compared == 4


def test_an_erratum_that_is_only_quoted_is_one_but_was_not_compared() -> None:
    slip = Erratum("", None, "garbled", None, None, 7, "$x$", "$y$")
    checks = counted(compared=[told("agrees"), told("erratum", slip)])
    assert (checks.compared, checks.refuted, checks.counts()["errata"]) == (1, 0, 1)


def test_remarks_are_counted_apart_from_what_was_compared() -> None:
    remark = object()
    checks = counted(compared=[told("remark", remark=remark), told("agrees")])
    assert (checks.remarks, checks.compared, checks.counts()["remarks"]) == ((remark,), 1, 1)
    assert checks.source == "old.md"


def test_nothing_at_all_counts_nothing() -> None:
    assert set(counted().counts().values()) == {0}


def test_every_grade_that_a_step_may_have_is_a_column(words: Phrases) -> None:
    counts = counted().counts()
    assert {f"steps_{grade.value}" for grade in LEAST_SURE_FIRST[1:]} <= set(counts)
    (_, columns), *_ = words.labels["report_page"]["columns"].items()
    assert len(columns) == len(LEAST_SURE_FIRST[1:])


def test_the_closing_note_says_how_many_lines_there_are(words: Phrases) -> None:
    checks = counted(step("one", "sum"))
    said = "".join(node.text for node in checks.closing(words, EvidenceShown.END) if isinstance(node, Text))
    assert str(checks.counts()["lines"]) in said


def test_a_page_for_students_has_no_closing_note(words: Phrases) -> None:
    assert counted(step("one", "sum")).closing(words, EvidenceShown.NONE) == ()
