"""The curves of a plot: of numbers alone, over a range that runs from left to right, with their extrema."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Expr, Integer, cos, pi, symbols

from derive.course.placement import Placement
from derive.errors import Place, Rejected
from derive.figures.extrema import MAXIMUM, Extremum
from derive.figures.marks import Plot
from derive.page.plots import Curves, curves_of, panel_letters, told_value, with_unit

a, k = symbols("a k", positive=True)
theta = symbols("theta", real=True)
SCRIPT, DRAWN = Place("one.yaml", 2), Place("one.yaml", 9)


def curves(expr: Expr, *ends: Expr, of: str = "angle", amounts: Any = None, cases: Any = None) -> Curves:
    problem: Any = SimpleNamespace(amounts=amounts or {}, place_of=lambda _: SCRIPT)
    plot = Plot("potential", theta, expr, theta, *(ends or (-pi / 2, pi / 2)), "energy", of)
    placement = None
    if cases is not None:
        measured = [tuple(SimpleNamespace(symbol=s, si=Integer(n)) for s, n in case.items()) for case in cases]
        placement = Placement("potential", DRAWN, cases=tuple(measured))  # type: ignore[arg-type]
    return curves_of(problem, plot, placement)


def refusal(*arguments: Any, **more: Any) -> Any:
    with pytest.raises(Rejected) as caught:
        curves(*arguments, **more)
    return caught.value.complaints[0]


def test_the_problems_own_numbers_are_put_in() -> None:
    (curve,) = curves(a * cos(theta), amounts={a: Integer(3)}).curves
    assert curve.expr == 3 * cos(theta)
    assert [(turn.at, turn.kind) for turn in curve.extrema] == [(0.0, MAXIMUM)]


def test_a_case_says_only_what_differs_from_the_first() -> None:
    first, second = curves(a * cos(k * theta), cases=[{a: 2, k: 1}, {k: 3}]).curves
    assert (first.expr, second.expr) == (2 * cos(theta), 2 * cos(3 * theta))
    assert [number.symbol for number in second.numbers] == [k], "what is told of a curve"


def test_a_number_that_all_cases_share_is_told_of_all_and_of_none() -> None:
    found = curves(a * cos(k * theta), cases=[{a: 2, k: 1}, {k: 3}])
    assert [number.symbol for number in found.shared] == [a]
    assert [[number.symbol for number in curve.numbers] for curve in found.curves] == [[k], [k]]
    assert curves(a * cos(k * theta), cases=[{a: 2, k: 1}]).shared == ()


def test_a_number_of_a_case_goes_before_the_problems_own_and_one_of_no_letter_here_is_left_out() -> None:
    (curve,) = curves(a * theta, amounts={a: Integer(3)}, cases=[{a: 5, k: 7}]).curves
    assert curve.expr == 5 * theta
    assert [number.symbol for number in curve.numbers] == [a]


def test_every_letter_without_a_number_is_named() -> None:
    complaint = refusal(a * cos(k * theta))
    assert complaint.message == "the plot `potential` needs a number for `a`, `k`"
    assert complaint.place == SCRIPT
    assert refusal(a * theta, cases=[{k: 1}]).place == DRAWN


def test_the_ends_of_a_range_may_have_letters() -> None:
    first, second = curves(theta, -a, 2 * a, of="length", cases=[{a: 1}, {a: 2}]).curves
    assert (first.lower, first.upper, second.lower, second.upper) == (-1, 2, -2, 4)
    assert refusal(theta, -a, 2 * a).message == "the plot `potential` needs a number for `a`"
    assert refusal(theta, -a, -2 * a, cases=[{a: 1}]).help == "for these numbers, it goes from -1 to -2"


@pytest.mark.parametrize("ends", [(pi, -pi), (pi, pi)])
def test_a_range_goes_from_a_smaller_number_to_a_larger(ends: tuple[Expr, Expr]) -> None:
    complaint = refusal(theta, *ends)
    assert complaint.message == "the range of `potential` must go from a smaller number to a larger number"


def test_an_angle_is_told_in_degrees_if_its_ends_are() -> None:
    assert curves(theta).unit == "°"
    assert curves(theta).per_unit == pytest.approx(57.29578)
    assert (curves(theta, Integer(-1), Integer(1)).unit, curves(theta, Integer(-1), Integer(1)).per_unit) == (
        "rad",
        1.0,
    )
    assert curves(theta, -pi, pi, of="length").unit == "m"


def test_panels_have_letters_where_there_are_several() -> None:
    assert panel_letters(curves(a * cos(theta), amounts={a: Integer(3)})) == [""]
    assert panel_letters(curves(a * cos(theta), cases=[{a: 2}, {a: 3}])) == ["i", "ii"]


def test_an_extremum_is_told_with_its_value_and_unit() -> None:
    (curve,) = curves(a * cos(theta), amounts={a: Integer(3)}).curves
    plot = Plot("potential", theta, a * cos(theta), theta, -pi / 2, pi / 2, "energy", "angle")
    assert [told_value(plot, each) for each in curve.extrema] == ["3.000 J"]
    assert (with_unit(-2.20549, "J"), with_unit(30.0, "\u00b0"), with_unit(0.5, "")) == (
        "\u22122.205 J",
        "30\u00b0",
        "0.5",
    )


def test_a_value_has_as_many_figures_in_a_plot_as_in_the_text() -> None:
    plot = Plot("potential", theta, a * cos(theta), theta, -pi / 2, pi / 2, "energy", "angle")
    told = [told_value(plot, Extremum(0.0, value, "maximum")) for value in (2.45, 2.20549, -0.5, 0.0, 2450.0)]
    assert told == ["2.450 J", "2.205 J", "\u22120.5000 J", "0 J", "2450 J"]
