"""Tests of the curves of a plot: numbers, ranges and extrema."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Expr, Integer, Rational, acos, cos, pi, sin, symbols

from derive.course.given import Measured
from derive.course.placement import Placement
from derive.errors import Place, Rejected
from derive.figures.extrema import MAXIMUM, Extremum
from derive.figures.marks import Across, Further, Plot
from derive.page.plots import IN_DEGREES, Axis, Curves, curve_letters, curves_of, panel_letters, told_value, with_unit

a, k = symbols("a k", positive=True)
theta = symbols("theta", real=True)
CAPTION: Any = SimpleNamespace(text="")
SCRIPT, DRAWN = Place("one.yaml", 2), Place("one.yaml", 9)


def curves(
    expr: Expr, *ends: Expr, of: str = "angle", amounts: Any = None, cases: Any = None, panels: str | None = None
) -> Curves:
    values = amounts or {}
    own = [Measured(letter, n, "", n) for letter, n in values.items()]
    problem: Any = SimpleNamespace(amounts=values, measured=own, place_of=lambda _: SCRIPT)
    plot = Plot("potential", theta, expr, theta, *(ends or (-pi / 2, pi / 2)), "energy", of)
    placement = None
    if cases is not None:
        measured = [tuple(Measured(s, Integer(n), "", Integer(n)) for s, n in case.items()) for case in cases]
        placement = Placement("potential", DRAWN, cases=tuple(measured), panels=panels)
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


def test_an_angle_is_told_in_degrees_unless_its_ends_are_numbers_of_radians() -> None:
    assert curves(theta).variable.unit == "°"
    assert curves(theta, Integer(0), acos(Rational(2, 3))).variable.unit == "°"
    assert curves(theta).variable.per_unit == pytest.approx(57.29578)
    assert curves(theta, Integer(-1), Integer(1)).variable == Axis("rad")
    assert curves(theta, -pi, pi, of="length").variable.unit == "m"


def test_panels_have_letters_where_there_are_several() -> None:
    assert panel_letters(curves(a * cos(theta), amounts={a: Integer(3)})) == [""]
    apart = curves(a * cos(theta), cases=[{a: 2}, {a: 3}], panels="apart")
    assert (panel_letters(apart), curve_letters(apart)) == (["i", "ii"], ["i", "ii"])
    together = curves(a * cos(theta), cases=[{a: 2}, {a: 3}])
    assert (panel_letters(together), curve_letters(together)) == ([""], ["", ""])


def test_an_extremum_is_told_with_its_value_and_unit() -> None:
    (curve,) = curves(a * cos(theta), amounts={a: Integer(3)}).curves
    assert [told_value(Axis("J"), each) for each in curve.extrema] == ["3.000 J"]
    assert (with_unit(-2.20549, "J"), with_unit(30.0, "\u00b0"), with_unit(0.5, "")) == (
        "\u22122.205 J",
        "30\u00b0",
        "0.5",
    )


def test_a_value_has_as_many_figures_in_a_plot_as_in_the_text() -> None:
    told = [told_value(Axis("J"), Extremum(0.0, value, "maximum")) for value in (2.45, 2.20549, -0.5, 0.0, 2450.0)]
    assert told == ["2.450 J", "2.205 J", "\u22120.5000 J", "0 J", "2450 J"]


def test_an_angle_is_told_in_degrees() -> None:
    assert told_value(IN_DEGREES, Extremum(0.0, float(pi) / 6, "maximum")) == "30.00°"


@pytest.mark.parametrize(
    ("cases", "together"),
    [
        ([{a: 3}], False),
        ([{a: 3}, {a: 2}], True),
        ([{a: 11}, {a: 2}], True),
        ([{a: 13}, {a: 2}], False),
        ([{a: 5}, {a: 4}, {a: 3}, {a: 2}], True),
        ([{a: 6}, {a: 5}, {a: 4}, {a: 3}, {a: 2}], False),
    ],
)
def test_up_to_four_curves_of_comparable_height_share_a_panel(cases: Any, together: bool) -> None:
    """The least height of a readable curve is a sixth of the height of all curves."""
    assert curves(a * cos(theta), cases=cases).is_together is together


def test_curves_with_different_ranges_have_panels_of_their_own() -> None:
    cases = [{a: 1}, {a: 2}]
    assert not curves(theta, -a, a, of="length", cases=cases).is_together
    assert curves(theta, -a, a, of="length", cases=cases, panels="together").is_together


def test_a_problem_chooses_the_panels() -> None:
    flat = [{a: 100}, {a: 1}]
    assert curves(a * cos(theta), cases=flat, panels="together").is_together
    assert not curves(a * cos(theta), cases=[{a: 1}, {a: 2}], panels="apart").is_together
    complaint = refusal(a * cos(theta), cases=[{a: n} for n in range(1, 6)], panels="together")
    assert complaint.message == "the panel of `potential` has room for at most 4 curves, but there are 5"


@pytest.mark.parametrize(("size", "together"), [(2, True), (7, False)])
def test_paths_of_comparable_size_share_a_panel(size: int, together: bool) -> None:
    path = Plot("path", theta, a * sin(theta), theta, -pi, pi, "length", "angle", across=Across(k, a * cos(theta), "m"))
    numbers = [(Measured(a, Integer(n), "m", Integer(n)),) for n in (1, size)]
    found = curves_of(FREE, path, Placement("path", DRAWN, cases=tuple(numbers)))
    assert found.is_together is together


FREE: Any = SimpleNamespace(amounts={}, measured=(), place_of=lambda _: SCRIPT)


def of_two(first: Expr, second: Expr, labels: Any = (k, k), cases: Any = ()) -> Curves:
    further = (Further(labels[1], second, "second"),)
    plot = Plot("two", labels[0], first, theta, -pi, pi, "length", "angle", ("first", "second", "end"), others=further)
    numbers = tuple(tuple(Measured(a, Integer(n), "m", Integer(n)) for n in case) for case in cases)
    return curves_of(FREE, plot, Placement("two", DRAWN, cases=numbers))


def test_each_of_several_answers_has_its_own_case() -> None:
    one, two = of_two(a * cos(theta), a * sin(theta), cases=[[1], [2]]).curves
    assert (one.expr, two.expr) == (cos(theta), 2 * sin(theta))
    assert [[each.number for each in curve.numbers] for curve in (one, two)] == [[1], [2]]


def test_a_number_belongs_to_a_curve_although_its_formula_does_not_contain_the_letter() -> None:
    """In the border case of damping, b is replaced by 2 sqrt(k m)."""
    one, two = of_two(a * cos(theta), 3 * sin(theta), cases=[[1], [2]]).curves
    assert [[each.number for each in curve.numbers] for curve in (one, two)] == [[1], [2]]


def test_several_answers_may_share_their_numbers_if_their_names_differ() -> None:
    found = of_two(a * cos(theta), a * sin(theta), (k, a), [[2]])
    assert [curve.label for curve in found.curves] == [k, a]
    assert found.labels_differ
    assert [number.symbol for number in found.shared] == [a]
    for cases, said in [
        ([[2]], "two curves of the plot `two` have the same name and the same numbers"),
        ([[2], [3], [4]], "the plot `two` has 2 curves but 3 cases"),
    ]:
        with pytest.raises(Rejected) as caught:
            of_two(a * cos(theta), a * sin(theta), cases=cases)
        assert caught.value.complaints[0].message == said


def test_the_steps_of_each_curve_are_known() -> None:
    further = (Further(k, a * sin(theta), "second"),)
    plot = Plot("two", k, theta, theta, -pi, pi, "length", "angle", ("first", "second", "end"), others=further)
    assert [each.keys for each in plot.each] == [("first", "end"), ("second",)]
    assert plot.letters == {theta, a}


def test_the_number_of_the_problem_names_a_curve_whose_case_does_not_state_it() -> None:
    one, two = curves(a * cos(theta), amounts={a: Integer(3)}, cases=[{}, {a: 5}]).curves
    assert [[(each.symbol, each.number) for each in curve.numbers] for curve in (one, two)] == [[(a, 3)], [(a, 5)]]


def divided(expr: Expr, *per: Expr, energies: tuple[Expr, ...] = (), cases: Any = ({a: 2, k: 3},)) -> Curves:
    """Return the curves of an energy against an angle, with axes that are divided by quantities."""
    problem: Any = SimpleNamespace(amounts={}, measured=[], place_of=lambda _: SCRIPT)
    plot = Plot("potential", theta, expr, theta, Integer(0), pi, "energy", "angle", energies=energies)
    plot = replace(plot, per=tuple((each, each) for each in per))
    measured = tuple(tuple(Measured(s, Integer(n), "", Integer(n)) for s, n in case.items()) for case in cases)
    return curves_of(problem, plot, Placement("potential", DRAWN, cases=measured, caption=CAPTION))


def test_an_axis_is_divided_by_a_quantity_and_numbers_that_no_longer_matter_are_not_told() -> None:
    found = divided(a * cos(theta) / k, Integer(1), a / k)
    assert (found.variable, found.up) == (IN_DEGREES, Axis("", 1.5, a / k))
    assert found.shared == () and found.is_energy
    found = divided(a * cos(theta) + k, Integer(1), a)
    assert [number.symbol for number in found.shared] == [a, k], "the curve depends on k/a"


def test_curves_whose_axes_would_have_different_divisors_are_rejected() -> None:
    with pytest.raises(Rejected, match="must be the same positive number for all curves"):
        divided(a * cos(theta), Integer(1), a, cases=({a: 2, k: 3}, {a: 4}))


def test_the_line_of_an_energy_is_where_the_curve_is_lower() -> None:
    (curve,) = divided(-a * cos(theta), energies=(Integer(0),)).curves
    ((energy, ((start, end),)),) = curve.heights
    assert (energy, start) == (0, 0) and end == pytest.approx(float(pi / 2))
