"""A plot as files: one panel for each curve, its axes named with quantity and unit, its extrema marked.

matplotlib draws the curve; numbers and names are set in the page's letters, and nothing is written over the curve.
"""

from __future__ import annotations

from math import ceil, floor, log10
from typing import Any

from matplotlib.figure import Figure

from derive.algebra.expressions import Amount
from derive.algebra.kinds import unit_of_kind
from derive.figures.extrema import MINIMUM, values_along
from derive.figures.marks import Plot
from derive.page.plots import DEGREES, Curve, Curves
from derive.page.wording import Phrases
from derive.render.drawing.canvas import INK, LETTERS, LINE, QUIET, Sheet, finished, our_settings
from derive.render.drawing.mathtext import runs
from derive.render.notation.latex import unit_latex
from derive.render.notation.notation import Notation

STEPS = 240
MOST = 6  # intervals between ticks
ROOM = 0.36  # above and below a curve, in terms of its height
PANEL, TALL = 6.0, 4.2  # centimetres
CM = 72 / 2.54


def plot_sheet(plot: Plot, curves: Curves, notation: Notation, words: Phrases, width: float | None, alt: str) -> Sheet:
    """The panels side by side; `width` is that of one of them."""
    panel, tall = (width or PANEL), (width or PANEL) * TALL / PANEL
    settings: Any = {
        "font.size": LETTERS - 1, "axes.linewidth": 0.5, "axes.edgecolor": QUIET, "xtick.color": QUIET,
        "ytick.color": QUIET, "xtick.major.width": 0.4, "ytick.major.width": 0.4, "xtick.direction": "in",
        "ytick.direction": "in", "xtick.labelcolor": LINE, "ytick.labelcolor": LINE,
    }  # fmt: skip
    with our_settings(**settings):
        wide, high = panel * len(curves.curves) * CM, tall * CM
        figure = Figure(figsize=(wide / 72, high / 72), facecolor="none", layout="constrained")
        panels = figure.subplots(1, len(curves.curves), squeeze=False)[0]
        for axes, curve in zip(panels, curves.curves, strict=True):
            _panel(axes, plot, curve, curves, notation, words)
        return finished(figure, alt, wide, high)


def _panel(axes: Any, plot: Plot, curve: Curve, curves: Curves, notation: Notation, words: Phrases) -> None:
    points = values_along(curve.expr, curve.variable, curve.lower, curve.upper, STEPS)
    axes.plot([x * curves.per_unit for x, _ in points], [y for _, y in points], color=INK, linewidth=1.1)
    axes.set_xlim(curve.lower * curves.per_unit, curve.upper * curves.per_unit)
    for extremum in curve.extrema:
        lowest = extremum.kind == MINIMUM
        axes.plot([extremum.at * curves.per_unit], [extremum.value], "o", color=INK, markersize=3.6,
                  markerfacecolor=INK if lowest else "white", markeredgewidth=0.8)  # fmt: skip
    _name_extrema(axes, curve, curves, words)
    axes.set_xlabel(_axis_name(plot.variable, curves.unit, notation))
    axes.set_ylabel(_axis_name(plot.label, unit_of_kind(plot.kind), notation))
    axes.spines[["top", "right"]].set_visible(False)
    low, high = min(y for _, y in points), max(y for _, y in points)
    room = ROOM * ((high - low) or abs(high) or 1.0)  # for the words under a minimum and over a maximum
    axes.set_ylim(low - room, high + room)
    _set_ticks(axes.xaxis, curve.lower * curves.per_unit, curve.upper * curves.per_unit, curves.unit == DEGREES)
    _set_ticks(axes.yaxis, low, high, False)
    if curve.numbers:
        axes.set_title(_numbers(curve, notation), fontsize=LETTERS - 1.5, color=QUIET, pad=5)


def _set_ticks(axis: Any, low: float, high: float, in_degrees: bool) -> None:
    """A few round numbers with the same number of decimals; degrees in steps of 5, 10, 15, 30, 45 or 90."""
    span = high - low or abs(high) or 1.0
    tens = 10.0 ** floor(log10(span))
    steps = (
        (5.0, 10.0, 15.0, 30.0, 45.0, 90.0)
        if in_degrees and span >= 20
        else [tens * k for k in (0.1, 0.2, 0.5, 1, 2, 5)]
    )
    step = next((step for step in steps if span / step <= MOST), steps[-1])
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    decimals = max(0, -floor(log10(step) + 1e-9))
    ticks = [step * k for k in range(first, last + 1)]
    axis.set_ticks(ticks, [f"${tick:.{decimals}f}$" for tick in ticks])


def _name_extrema(axes: Any, curve: Curve, curves: Curves, words: Phrases) -> None:
    """Its kind beside each extremum: under a minimum, over a maximum."""
    for extremum in curve.extrema:
        lowest = extremum.kind == MINIMUM
        axes.annotate(
            rf"$\mathrm{{{words.drawings[extremum.kind]}}}$", (extremum.at * curves.per_unit, extremum.value),
            xytext=(0, -6 if lowest else 5), textcoords="offset points", ha="center", va="top" if lowest else "bottom",
            fontsize=LETTERS - 2, color=LINE,
        )  # fmt: skip


def _axis_name(symbol: Any, unit: str, notation: Notation) -> str:
    """`U / J`: the number of units, as it stands on the axis."""
    name = _mathtext(notation.layout(symbol))
    over = rf"\,/\,{_mathtext_of_unit(unit)}" if unit else ""
    return f"${name}{over}$"


def _numbers(curve: Curve, notation: Notation) -> str:
    items = []
    for measured in curve.numbers:
        amount = Amount(measured.number, measured.unit, measured.factor)
        items.append(rf"{_mathtext(notation.layout(measured.symbol))} = {_mathtext(notation.layout(amount))}")
    return "$" + r",\;\; ".join(items) + "$"


def _mathtext(layout: Any) -> str:
    return "".join(run.text.strip("$") for run in runs(layout))


def _mathtext_of_unit(unit: str) -> str:
    return r"{}^{\circ}" if unit == DEGREES else unit_latex(unit)
