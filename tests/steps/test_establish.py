"""The one door: what it lets through, and what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from sympy import Expr, Integer, MatrixSymbol, Rational, cos, sin, symbols

from derive.algebra.equality import Compared, Grade
from derive.algebra.expressions import Dot, Truncated, column, component_names, scalar, vector
from derive.algebra.rounding import Rounded
from derive.errors import Unverified
from derive.mechanics import let
from derive.steps.establish import Lines, establish
from derive.steps.rule import Rule
from derive.steps.step import Form, Level, Quantity, compared_with
from tests.rules import made_up

a, b, x = symbols("a b x", positive=True)
DEFINITION = Rule("test.sum_of_squares")


def sum_of_squares(**changes: Any) -> Quantity:
    """s = (a + b)^2 - 2ab, whose second route is a^2 + b^2."""
    arguments: dict[str, Any] = {
        "law": lambda p, q: (p + q) ** 2 - 2 * p * q,
        "inputs": {"p": a, "q": b},
        "routes": {"squares": compared_with(lambda: a**2 + b**2)},
        **changes,
    }
    routes = arguments["routes"] or {}
    rule = arguments.pop("rule", made_up("test.sum_of_squares", "squares", *routes))
    return establish(rule, scalar("s"), arguments.pop("law"), arguments.pop("inputs"), **arguments)


def refusal_of(make: Callable[[], Any]) -> Any:
    with pytest.raises(Unverified) as refusal:
        make()
    return refusal.value.complaints[0]


def test_a_right_law_gives_a_quantity_that_knows_its_step() -> None:
    s = sum_of_squares()
    assert s.value == a**2 + b**2
    assert (s.key, s.step.rule, s.symbol) == ("sum_of_squares", "test.sum_of_squares", scalar("s"))
    assert [form.because for form in s.step.chain] == ["law", "result"]
    assert s.step.result == s.value


def test_a_wrong_law_is_refused_with_both_values_and_a_point() -> None:
    complaint = refusal_of(lambda: sum_of_squares(law=lambda p, q: (p + q) ** 2))
    assert complaint.code == "unverified"
    assert complaint.message == "`sum_of_squares`: its check `squares` disagrees"
    assert complaint.notes[0].startswith("by the law")
    assert "a = " in complaint.notes[-1] and "b = " in complaint.notes[-1]


def test_a_wrong_second_route_is_refused() -> None:
    complaint = refusal_of(lambda: sum_of_squares(routes={"wrong": compared_with(lambda: a**2 - b**2)}))
    assert complaint.message == "`sum_of_squares`: its check `wrong` disagrees"


def test_every_second_route_must_agree() -> None:
    routes = {
        "right": compared_with(lambda: a**2 + b**2),
        "wrong": compared_with(lambda: a**2 + b**2 + Rational(1, 10**20)),
    }
    assert "`wrong`" in refusal_of(lambda: sum_of_squares(routes=routes)).message


@pytest.mark.parametrize("place", ["before", "between", "after"])
def test_a_line_that_does_not_follow_is_refused_wherever_it_stands(place: str) -> None:
    complaint = refusal_of(lambda: sum_of_squares(lines=Lines(**{place: [Form(a**2 + 2 * b**2, "slip", Level.FULL)]})))
    assert "does not follow from line" in complaint.message


def test_a_line_that_follows_is_kept_with_its_evidence() -> None:
    s = sum_of_squares(lines=Lines(between=[Form(a**2 + 2 * a * b + b**2 - 2 * a * b, "expanded", Level.FULL)]))
    assert len([e for e in s.step.evidence if e.compared is Compared.LINES]) == len(s.step.chain) - 1
    assert {e.grade for e in s.step.evidence} == {Grade.PROVED}


@pytest.mark.parametrize(
    ("polynomial", "order", "message"),
    [
        (1 - x**2 / 2, 2, None),
        (1 - x**2 / 2, 3, None),
        (1 - x**2 / 2 + x**4 / 24, 4, None),
        (1 - x**2 / 3, 2, "the series is wrong at order 2 in x"),
        (1 - x**2 / 2, 4, "the series is wrong at order 4 in x"),
        (1 - x**2 / 2 + x**4 / 7, 2, "the series has terms beyond order 2 in x"),
        (1 - x**2 / 2 + x**4 / 24, 2, "the series has terms beyond order 2 in x"),
        (cos(x), 2, "the series has terms beyond order 2 in x"),
    ],
)
def test_a_series_has_the_derivatives_of_the_whole_and_no_term_beyond(
    polynomial: Expr, order: int, message: str | None
) -> None:
    def made() -> Quantity:
        series = Form(Truncated(polynomial, x, Integer(0), Integer(order)), "series")
        return establish(made_up("test.s"), scalar("s"), lambda: cos(x), {}, lines=Lines(after=[series]))

    if message:
        assert message in refusal_of(made).message
    else:
        assert made().step.evidence[0].grade is Grade.APPROXIMATION


def test_a_step_without_a_second_route_is_refused_unless_it_is_a_definition() -> None:
    assert refusal_of(lambda: sum_of_squares(routes={})).code == "no-second-route"
    assert refusal_of(lambda: sum_of_squares(routes=None)).code == "no-second-route"
    assert sum_of_squares(routes=None, rule=DEFINITION).step.evidence[-1].grade is Grade.DEFINITION


def test_a_definition_still_has_lines_that_must_follow() -> None:
    wrong = [Form(a**2, "slip")]
    assert (
        "line 2" in refusal_of(lambda: sum_of_squares(routes=None, rule=DEFINITION, lines=Lines(between=wrong))).message
    )


def test_the_law_is_read_with_names_and_with_values() -> None:
    p = sum_of_squares(key="first")
    twice = establish(
        made_up("test.twice", "sum"),
        scalar("t"),
        lambda s: 2 * s,
        {"s": p},
        routes={"sum": compared_with(lambda: p.value + p.value)},
    )
    assert [form.expr for form in twice.step.chain][:2] == [2 * scalar("s"), 2 * (a**2 + b**2)]
    assert twice.parents == (p,)
    assert twice.step.inputs == ("first",)
    assert twice.step.roles == (("s", scalar("s")),)


def test_a_vector_brings_the_names_of_its_components_along() -> None:
    v = establish(made_up("test.v"), vector("v"), lambda: column(a, b, 0), {})
    v_x, v_y, _ = component_names("v")
    product = establish(
        made_up("test.product", "plain"),
        scalar("p"),
        lambda _: v_x * v_y,
        {"v": v},
        routes={"plain": compared_with(lambda: a * b)},
    )
    assert product.value == a * b


def test_the_outcome_is_chosen_by_the_result_and_judged_by_its_predicate() -> None:
    sums = {"sum": lambda facts: facts.result.is_Add, "single": lambda facts: not facts.result.is_Add}
    rule = made_up("test.sum_of_squares", "squares", outcomes=sums)
    assert sum_of_squares(rule=rule, outcome=lambda s: "sum" if s.is_Add else "single").step.outcome == "sum"
    assert "could not be confirmed" in refusal_of(lambda: sum_of_squares(rule=rule, outcome="single")).message
    assert "could not be confirmed" in refusal_of(lambda: sum_of_squares(rule=rule, outcome="unheard_of")).message


def test_a_claim_that_the_rule_does_not_have_is_refused() -> None:
    rule = made_up("test.sum_of_squares", "other")
    assert "does not list the claim `squares`" in refusal_of(lambda: sum_of_squares(rule=rule)).message


def test_an_outcome_that_no_predicate_judges_is_refused() -> None:
    assert "could not be confirmed" in refusal_of(lambda: sum_of_squares(outcome="said")).message


def test_a_form_just_like_the_one_before_is_shown_once_at_the_lower_level() -> None:
    s = sum_of_squares(law=lambda p, q: p**2 + q**2, lines=Lines(between=[Form(a**2 + b**2, "again", Level.FULL)]))
    assert [(form.because, form.level) for form in s.step.chain] == [("law", Level.BRIEF)]


@pytest.mark.parametrize(("value", "fits"), [("0.33333", True), ("0.33334", False), ("0.3333", False)])
def test_a_rounded_line_may_be_off_by_half_a_unit_and_no_more(value: str, fits: bool) -> None:
    rounded = Form(Rounded(Rational(value), Integer(5)), "rounded")

    def third() -> Quantity:
        return establish(
            made_up("test.third", "put_back"),
            scalar("t"),
            lambda: Rational(1, 3),
            {},
            routes={"put_back": lambda t: (3 * t, Integer(1))},
            lines=Lines(after=[rounded]),
        )

    if fits:
        assert third().step.evidence[0].grade is Grade.APPROXIMATION
        assert third().value == Rational(1, 3)
    else:
        assert "is not 1/3 rounded" in refusal_of(third).message


def test_trigonometry_in_a_line_is_decided_exactly() -> None:
    step = establish(
        made_up("test.one", "half_angles"),
        scalar("one"),
        lambda: sin(x) ** 2 + cos(x) ** 2,
        {},
        lines=Lines(between=[Form(1 - cos(x) ** 2 + cos(x) ** 2, "pythagoras")]),
        routes={"half_angles": lambda one: (one, 2 * sin(x / 2) ** 2 + cos(x))},
    ).step
    assert {e.grade for e in step.evidence} == {Grade.PROVED}


def test_a_name_that_stands_for_itself_is_let_be() -> None:
    open_components = column(*symbols("w_x w_y w_z", real=True))
    w = establish(made_up("test.w"), vector("w"), lambda: open_components, {})
    size = establish(
        made_up("test.size", "sum"),
        scalar("n"),
        lambda v: Dot(v, v),
        {"w": w},
        routes={"sum": lambda n: (n, sum(c**2 for c in w.value))},
    )
    assert size.value == sum(c**2 for c in open_components)
    assert isinstance(size.step.roles[0][1], MatrixSymbol)


@pytest.mark.parametrize(("outcome", "zero"), [("zero", False), ("generic", True)])
def test_an_outcome_that_belies_the_result_is_refused(outcome: str, zero: bool) -> None:
    complaint = refusal_of(
        lambda: establish(
            made_up("test.difference", "again"),
            scalar("d"),
            lambda p, q: p - q,
            {"p": a, "q": a if zero else b},
            routes={"again": compared_with(lambda: -(a if zero else b) + a)},
            outcome=lambda _: outcome,
        )
    )
    assert complaint.code == "unverified"
    assert ("the result is zero" if zero else "not known to be zero") in complaint.message


def test_a_step_knows_the_line_at_which_a_verb_of_the_package_hands_over_its_law() -> None:
    assert sum_of_squares().step.law_at == ""  # this file is none of the package
    assert let("s", lambda: a + b).step.law_at.startswith("derive/mechanics/answers/values.py:")
