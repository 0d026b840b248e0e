"""The lines of a step: which are kept, what their names stand for, and what follows from what."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Float, ImmutableMatrix, Integer, Symbol, sin, symbols

from derive.algebra.equality import Compared, Grade, Verdict, equal
from derive.algebra.expansion import Expansion
from derive.algebra.expressions import Relation, Truncated, column, component_names, scalar, vector
from derive.algebra.rounding import rounded_form
from derive.errors import Unverified
from derive.steps.chain import (
    bindings_of,
    check_last_line,
    left_side_evidence,
    line_evidence,
    names_in,
    refused,
    route_evidence,
    short,
    without_repeats,
)
from derive.steps.establish import establish
from derive.steps.step import Form, Level, Quantity
from tests.rules import made_up

a, b, x = symbols("a b x", positive=True)
s = scalar("s")


def made(key: str, symbol: Any, value: Any) -> Quantity:
    return establish(made_up(f"test.{key}"), symbol, lambda: value, {})


def evidence_of(*exprs: Any, because: str = "result", motion: Any = None) -> Any:
    chain = [Form(expr, "law") for expr in exprs[:-1]] + [Form(exprs[-1], because)]
    return line_evidence("key", chain, len(chain) - 1, {s: a + b}, motion or {})


def test_a_repeated_line_is_left_out_and_shown_as_early_as_either() -> None:
    forms = [Form(a + b, "law", Level.FULL), Form(a + b, "put_in", Level.BRIEF), Form(2 * a, "result")]
    kept = without_repeats(forms, None)
    assert [(form.expr, form.because, form.level) for form in kept[:1]] == [(a + b, "law", Level.BRIEF)]
    assert [form.expr for form in kept] == [a + b, 2 * a]


def test_a_line_of_the_symbol_alone_is_left_out_unless_there_is_no_other() -> None:
    assert [form.expr for form in without_repeats([Form(s, "law"), Form(a, "result")], s)] == [a]
    assert [form.expr for form in without_repeats([Form(s, "law"), Form(s, "result")], s)] == [s]


def test_a_rounded_number_that_looks_like_the_exact_one_is_still_told() -> None:
    assert len(without_repeats([Form(a, "result"), Form(a, "rounded")], s)) == 2


def test_a_name_stands_for_its_value_and_a_vector_for_its_components_too() -> None:
    v = made("v", vector("v"), column(a, b, 0))
    v_x, v_y, v_z = component_names("v")
    assert bindings_of([v, made("s", s, a)]) == {vector("v"): v.value, v_x: a, v_y: b, v_z: 0, s: a}


def test_a_name_that_stands_for_itself_is_no_binding() -> None:
    names = component_names("w")
    w = made("w", vector("w"), column(*names))
    assert set(bindings_of([w])) == {vector("w")}


def test_only_the_names_that_occur_are_kept() -> None:
    assert names_in([s + x, None], {s: a, b: x}) == ((s, a),)


def test_a_line_follows_by_the_values_of_its_names() -> None:
    found = evidence_of(2 * s, 2 * a + 2 * b)
    assert (found.claim, found.compared, found.grade) == ("line 2 equals line 1", Compared.LINES, Grade.PROVED)
    with pytest.raises(Unverified, match=r"line 2 \(result\) does not follow from line 1"):
        evidence_of(2 * s, 2 * a)


def test_a_line_by_the_motion_holds_for_motions_alone() -> None:
    q_dot = Symbol("q_dot", real=True)
    assert "by the equations of motion" in evidence_of(q_dot, a, because="motion", motion={q_dot: a}).claim
    with pytest.raises(Unverified):
        evidence_of(q_dot, a, motion={q_dot: a})


@pytest.mark.parametrize(("series", "wrong"), [(x, None), (x + x**5, "terms beyond"), (2 * x, "wrong at order 1")])
def test_a_series_is_checked_order_by_order(series: Any, wrong: str | None) -> None:
    def follow() -> Any:
        return evidence_of(sin(x), Truncated(series, x, 0, 2))

    if wrong:
        with pytest.raises(Unverified, match=wrong):
            follow()
    else:
        assert follow().grade is Grade.APPROXIMATION


def test_a_number_is_compared_with_what_was_rounded_and_not_with_the_number_before() -> None:
    third = [Form(a / a / 3, "law"), *(Form(rounded_form(a / a / 3, n), "rounded") for n in (2, 4))]
    assert line_evidence("key", third, 2, {}, {}).detail == "within half a unit of the last place"


@pytest.mark.parametrize("left", [None, s, vector("s"), ImmutableMatrix([a, b])])
def test_a_left_side_that_is_a_name_needs_no_evidence(left: Any) -> None:
    assert left_side_evidence("key", left, Form(a, "law"), {}) == []


def test_a_left_side_that_is_an_expression_equals_the_first_line() -> None:
    assert left_side_evidence("key", 2 * s, Form(2 * a + 2 * b, "law"), {s: a + b})[0].grade is Grade.PROVED
    assert left_side_evidence("key", 2 * s, Form(Relation(a, "=", b), "law"), {}) == []
    with pytest.raises(Unverified, match="its left side 2\\*s does not equal its first line"):
        left_side_evidence("key", 2 * s, Form(a, "law"), {s: a + b})


def test_what_is_handed_on_is_the_last_line_before_numbers() -> None:
    chain = [Form(s, "law"), Form(Float("0.3"), "rounded")]
    check_last_line("key", chain, a + b, {s: a + b}, {})
    with pytest.raises(Unverified, match="its result does not equal its last line"):
        check_last_line("key", chain, a, {s: a + b}, {})


def test_a_route_gives_two_values_or_has_compared_them() -> None:
    assert route_evidence("key", "again", (a + a, 2 * a)).compared is Compared.ROUTE
    assert route_evidence("key", "again", equal(a, a)).grade is Grade.PROVED
    for wrong in ((a, b), Verdict(Grade.REFUTED)):
        with pytest.raises(Unverified, match="its second route `again` disagrees"):
            route_evidence("key", "again", wrong)


def test_a_refusal_tells_both_values_cut_to_a_readable_length() -> None:
    (complaint,) = refused("key", "no", sum(symbols("y:200")), a, equal(a, b)).complaints
    assert complaint.notes[0].startswith("by the law     y0 + ")
    assert complaint.notes[0].endswith(" ...")
    assert len(complaint.notes[0]) < 330
    assert complaint.notes[1] == "otherwise      a"
    assert short(a) == "a"


@pytest.mark.parametrize(
    ("last", "because", "said"),
    [
        (b, "result", "only approximately equal"),
        (b + a * x, "limit", "contains the letter that goes to its limit"),
        (b + 2 * a * x, "series", "does not follow"),
    ],
)
def test_a_sign_behind_an_expansion_says_no_more_than_is_so(last: Any, because: str, said: str) -> None:
    """(b + a x)/(1 + x^2) is b + a x to first order, and not equal to it."""
    order = 0 if because == "result" else 1
    with pytest.raises(Unverified, match=said):
        evidence_of(Expansion((b + a * x) / (1 + x**2), x, Integer(0), Integer(order)), last, because=because)


def test_what_is_left_of_an_expansion_is_about_equal_or_equal_to_the_whole() -> None:
    cut = Expansion((b + a * x) / (1 + x**2), x, Integer(0), Integer(1))
    assert evidence_of(cut, b + a * x, because="series")
    assert evidence_of(Expansion(b / (1 + x), x, Integer(0), Integer(0)), b, because="limit")
    assert evidence_of(Expansion(b + a * x, x, Integer(0), Integer(1)), b + a * x, because="result")
