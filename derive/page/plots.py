"""The curves of a plot: the range, and the numbers and extrema of each curve.

A case states only the numbers that differ from the first case. If no case has a number for a symbol of the curves, the
problem must have a number for this symbol.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sympy import Expr, Symbol, nan, oo, pi, zoo

from derive.algebra.expressions import explicit
from derive.course.given import Measured
from derive.course.placement import Placement, case_label
from derive.course.problem import Problem
from derive.errors import Complaint, Rejected
from derive.figures.extrema import Extremum, extrema
from derive.figures.marks import Plot

DEGREE, DEGREES = pi / 180, "°"


MOST_MARKED = 6  # a curve with more extrema has no marks


@dataclass(frozen=True)
class Curve:
    """One curve: a quantity in its SI unit as a function of one symbol, and the numbers that are substituted."""

    expr: Expr
    variable: Symbol
    lower: float
    upper: float
    numbers: tuple[Measured, ...]
    extrema: tuple[Extremum, ...]

    @property
    def marked(self) -> tuple[Extremum, ...]:
        """Return the extrema to mark: none if there are many, as for an oscillation, because the marks would hide the
        curve."""
        return self.extrema if len(self.extrema) <= MOST_MARKED else ()


@dataclass(frozen=True)
class Curves:
    """The curves of a plot, the numbers that all curves share, and the unit of the horizontal axis.

    `unit` is the name of the unit of the horizontal axis; one SI unit equals `per_unit` of these units.
    """

    curves: tuple[Curve, ...]
    unit: str
    per_unit: float
    shared: tuple[Measured, ...] = ()


def curves_of(problem: Problem, plot: Plot, placement: Placement | None) -> Curves:
    """Return every curve of the plot with its extrema; raise `Rejected` if symbols lack a number."""
    lower, upper = _range(problem, plot, placement)
    given = placement.cases if placement and placement.cases else ((),)
    # A number for a symbol that does not occur in the curve would be shown although it has no effect.
    cases = [tuple(number for number in case if number.symbol in plot.expr.free_symbols) for case in given]
    changed = {number.symbol for case in cases[1:] for number in case}
    shared = tuple(number for number in cases[0] if number.symbol not in changed) if len(cases) > 1 else ()
    own = [tuple(number for number in case if number not in shared) for case in cases]
    found = tuple(
        _curve(problem, plot, placement, (*cases[0], *case), told, lower, upper)
        for case, told in zip(cases, own, strict=True)
    )
    in_degrees = plot.of == "angle" and all((end / DEGREE).is_Rational for end in (lower, upper))
    unit = (DEGREES, float(1 / DEGREE)) if in_degrees else (_unit(plot.of), 1.0)
    return Curves(found, *unit, shared)


def _unit(kind: str) -> str:
    from derive.algebra.kinds import unit_of_kind

    return unit_of_kind(kind)


def _range(problem: Problem, plot: Plot, placement: Placement | None) -> tuple[Expr, Expr]:
    ends = [plot.lower, plot.upper]
    place = placement.place if placement else problem.place_of("solve")
    if placement and placement.range:
        ends, place = placement.range.of_kind(plot.of), placement.range.place
    lower, upper = ends
    if not (lower.is_number and upper.is_number and lower < upper):
        raise Rejected(
            Complaint("range", f"the range of `{plot.key}` must go from a smaller number to a larger number", place)
        )
    return lower, upper


def _curve(
    problem: Problem,
    plot: Plot,
    placement: Placement | None,
    known: tuple[Measured, ...],
    own: tuple[Measured, ...],
    lower: Expr,
    upper: Expr,
) -> Curve:
    numbers: dict[Any, Expr] = {letter: explicit(amount) for letter, amount in problem.amounts.items()}
    numbers |= {measured.symbol: measured.si for measured in known}
    missing = sorted(s.name for s in plot.expr.free_symbols - set(numbers) - {plot.variable})
    if missing:
        listed = ", ".join(f"`{name}`" for name in missing)
        place = placement.place if placement else problem.place_of("solve")
        help_line = "write the number under the `values` of the problem, or under the `cases` of the drawing"
        raise Rejected(
            Complaint("drawing", f"the plot `{plot.key}` needs a number for {listed}", place, help=help_line)
        )
    expr = plot.expr.xreplace({letter: value for letter, value in numbers.items() if letter != plot.variable})
    if expr.has(nan, zoo, oo):
        message = f"the plot `{plot.key}` has no curve for these numbers, because a denominator vanishes"
        place = placement.place if placement else problem.place_of("solve")
        raise Rejected(Complaint("drawing", message, place, help="change a number, for example at a resonance"))
    ends = float(lower), float(upper)
    return Curve(expr, plot.variable, *ends, own, extrema(expr, plot.variable, *ends))


def panel_letters(curves: Curves) -> list[str]:
    """Return the letter of each panel, or empty letters if there is only one panel."""
    several = len(curves.curves) > 1
    return [case_label(i) if several else "" for i, _ in enumerate(curves.curves)]


def told_value(plot: Plot, extremum: Extremum) -> str:
    """Return the value at an extremum with its unit, to four figures, for the plot, its description and its caption."""
    shown = f"{extremum.value:#.4g}".rstrip(".") if extremum.value else "0"
    return _signed(f"{shown} {_unit(plot.kind)}")


def with_unit(value: float, unit: str) -> str:
    """Return a number to four figures with its unit; a degree sign has no space before it."""
    gap = "" if unit == "\u00b0" else " "
    return _signed(f"{value:.4g}{gap}{unit}")


def _signed(told: str) -> str:
    return told.replace("-", "\u2212").strip()
