"""Plots: a panel for each curve, round ticks, axes named with their units, extrema named beside the curve."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from matplotlib.figure import Figure
from sympy import Expr, Integer, Symbol, cos, pi, symbols

from derive.figures.marks import Plot
from derive.page.plots import Curves, curves_of
from derive.page.wording import phrases
from derive.render.drawing import canvas, plotting
from derive.render.drawing.canvas import Sheet
from derive.render.drawing.plotting import plot_sheet
from derive.render.notation.notation import Notation
from tests.courses import ROOT

theta = Symbol("theta", real=True)
V = Symbol("V")
a = symbols("a", positive=True)
WORDS = phrases(ROOT / "templates")


def plot_of(expr: Expr, lower: Expr = -pi / 2, upper: Expr = pi / 2, of: str = "angle") -> Plot:
    return Plot("potential", V, expr, theta, lower, upper, "energy", of)


def curves(plot: Plot, *cases: int) -> Curves:
    """One curve, or one for each number of `a`."""
    problem: Any = SimpleNamespace(amounts={}, place_of=lambda _: None)
    numbers = [(SimpleNamespace(symbol=a, si=Integer(n), number=Integer(n), unit="m", factor=1),) for n in cases]
    placement: Any = SimpleNamespace(cases=numbers, range=None, place=None)
    return curves_of(problem, plot, placement)


def sheet(plot: Plot, *cases: int, width: float | None = None, alt: str = "") -> Sheet:
    return plot_sheet(plot, curves(plot, *cases), Notation(), WORDS, width, alt)


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """The figures, before they are files."""
    figures: list[Figure] = []

    def noted(figure: Figure, *of_it: Any) -> Sheet:
        figures.append(figure)
        return canvas.finished(figure, *of_it)

    monkeypatch.setattr(plotting, "finished", noted)
    return figures


def test_every_curve_has_a_panel_of_the_same_width(drawn: list[Figure]) -> None:
    one, two = sheet(plot_of(a * cos(theta)), 1), sheet(plot_of(a * cos(theta)), 1, 2)
    assert (two.width, two.height) == pytest.approx((2 * one.width, one.height))
    assert [len(figure.axes) for figure in drawn] == [1, 2]
    assert sheet(plot_of(a * cos(theta)), 1, width=3.0).height == pytest.approx(one.height / 2)


def test_ticks_are_a_few_round_numbers_within_the_range(drawn: list[Figure]) -> None:
    sheet(plot_of(cos(theta)))
    sheet(plot_of(theta**2, Integer(0), Integer(1) / 250, of="length"))
    (angle,), (length,) = (figure.axes for figure in drawn)
    assert list(angle.get_xticks()) == [-90, -60, -30, 0, 30, 60, 90]
    assert [label.get_text() for label in length.get_xticklabels()] == [
        "$0.000$", "$0.001$", "$0.002$", "$0.003$", "$0.004$"
    ]  # fmt: skip


def test_axes_are_named_with_their_units(drawn: list[Figure]) -> None:
    sheet(plot_of(cos(theta)))
    ((axes,),) = (figure.axes for figure in drawn)
    assert (axes.get_xlabel(), axes.get_ylabel()) == (r"$\theta\,/\,{}^{\circ}$", r"$V\,/\,\mathrm{J}$")


def test_each_extremum_is_named_clear_of_the_curve(drawn: list[Figure]) -> None:
    sheet(plot_of(cos(2 * theta), -3 * pi / 4, 3 * pi / 4))
    ((axes,),) = (figure.axes for figure in drawn)
    named = [(text.get_text(), text.xy[1], text.get_va()) for text in axes.texts]
    assert [(va, pytest.approx(y)) for _, y, va in named] == [("top", -1), ("bottom", 1), ("top", -1)]
    assert len({text for text, *_ in named}) == 2
    assert axes.get_ylim()[0] < -1.3 and axes.get_ylim()[1] > 1.3, "there is room for the words"


def test_a_plot_is_the_same_bytes_each_time_and_says_what_it_shows() -> None:
    one, other = (sheet(plot_of(cos(theta)), alt="a < b") for _ in range(2))
    assert (one.pdf, one.svg) == (other.pdf, other.svg)
    assert b"<title>a &lt; b</title>" in one.svg


def test_a_curve_that_is_level_has_an_axis_all_the_same(drawn: list[Figure]) -> None:
    sheet(plot_of(theta - theta + 5 * cos(0) + 0 * theta))
    ((axes,),) = (figure.axes for figure in drawn)
    assert axes.get_ylim()[0] < 5 < axes.get_ylim()[1]
