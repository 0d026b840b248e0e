"""The curves of a plot: the range, and the numbers and extrema of each curve.

A case states only the numbers that differ from the first case. If neither a case nor the first case has a number for a
symbol of the curve, the problem must have a number for this symbol.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import dist
from typing import TYPE_CHECKING, Any, TypeAlias

from sympy import Expr, Symbol, nan, oo, pi, zoo

from derive.algebra.expressions import explicit
from derive.course.given import Measured
from derive.course.placement import Placement, case_label
from derive.course.problem import Problem
from derive.course.stock import told_at
from derive.course.yaml_tree import Word
from derive.errors import Complaint, Place, Rejected
from derive.figures.extrema import NOISE, Extremum, extrema, values_along
from derive.figures.marks import Plot, letters_in

if TYPE_CHECKING:
    from derive.figures.portrait import Portrait

Path: TypeAlias = tuple[tuple[float, float], ...]

DEGREE, DEGREES = pi / 180, "°"

PATH_STEPS = 720  # number of steps of a path, which may go round many times
MOST_MARKED = 6  # a curve with more extrema has no marks


@dataclass(frozen=True)
class Curve:
    """One curve: a quantity in its SI unit as a function of one symbol, and the numbers that are substituted.

    across   the quantity on the horizontal axis of a path; a path has no extrema
    path     points of a path in the order of the motion
    portrait the curves of a phase portrait
    """

    expr: Expr
    variable: Symbol
    lower: float
    upper: float
    numbers: tuple[Measured, ...]
    extrema: tuple[Extremum, ...]
    across: Expr | None = None
    path: Path = field(default=(), repr=False)
    portrait: Portrait | None = None

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
    """Return every curve of the plot with its extrema; raise `Rejected` if a curve cannot be drawn, for example because
    a symbol has no number."""
    written = _ends(plot, placement)
    letters = letters_in((*plot.shown, *written, *plot.values))
    given = placement.cases if placement and placement.cases else ((),)
    # A number for a symbol that does not occur in the curve would be shown although it has no effect.
    cases = [tuple(number for number in case if number.symbol in letters) for case in given]
    changed = {number.symbol for case in cases[1:] for number in case}
    shared = tuple(number for number in cases[0] if number.symbol not in changed) if len(cases) > 1 else ()
    own = [tuple(number for number in case if number not in shared) for case in cases]
    numbers = [_numbers(problem, plot, placement, (*cases[0], *case), letters) for case in cases]
    ends = [_range(problem, plot, placement, plot.variable, written[:2], each) for each in numbers]
    found = tuple(_curve(problem, plot, placement, *each) for each in zip(numbers, own, ends, strict=True))
    in_degrees = plot.of == "angle" and all((end / DEGREE).is_Rational for both in ends for end in both)
    unit = (DEGREES, float(1 / DEGREE)) if in_degrees else (_unit(plot.of), 1.0)
    return Curves(found, *unit, shared)


def _unit(kind: str) -> str:
    from derive.algebra.kinds import unit_of_kind

    return unit_of_kind(kind)


def _ends(plot: Plot, placement: Placement | None) -> list[Expr]:
    """Return the ends of the range; the engine has read the range of a plot that the problem requests."""
    if placement and placement.range and not placement.plot:
        return placement.range.of_kind(plot.of)
    return list(plot.ends)


def _numbers(
    problem: Problem, plot: Plot, placement: Placement | None, known: tuple[Measured, ...], letters: set[Symbol]
) -> dict[Any, Expr]:
    """Return the number of each symbol; a symbol that varies has none. Every other symbol in `letters` needs a
    number."""
    numbers: dict[Any, Expr] = {letter: explicit(amount) for letter, amount in problem.amounts.items()}
    numbers |= {measured.symbol: measured.si for measured in known}
    missing = sorted(s.name for s in letters - {*numbers, *plot.varies})
    if missing:
        listed = ", ".join(f"`{name}`" for name in missing)
        help_line = "write the number under the `values` of the problem, or under the `cases` of the drawing"
        raise Rejected(
            Complaint(
                "drawing", f"the plot `{plot.key}` needs a number for {listed}", _place(problem, placement),
                help=help_line,
            )
        )  # fmt: skip
    return {letter: number for letter, number in numbers.items() if letter not in plot.varies}


def _place(problem: Problem, placement: Placement | None) -> Place:
    return placement.place if placement else problem.place_of("solve")


def _range(
    problem: Problem,
    plot: Plot,
    placement: Placement | None,
    variable: Symbol,
    ends: Sequence[Expr],
    numbers: Mapping[Any, Expr],
) -> tuple[Expr, Expr]:
    """Return the ends of the range of a variable for these numbers."""
    lower, upper = (end.xreplace(numbers) for end in ends)
    if lower.is_number and upper.is_number and lower.is_real and upper.is_real and lower < upper:
        return lower, upper
    message = f"the range of `{plot.key}` must go from a smaller number to a larger number"
    has_letters = any(end.free_symbols for end in ends)
    help_line = f"for these numbers, it goes from {_short(lower)} to {_short(upper)}" if has_letters else None
    raise Rejected(Complaint("range", message, _place_of_range(problem, plot, placement, variable), help=help_line))


def _place_of_range(problem: Problem, plot: Plot, placement: Placement | None, variable: Symbol) -> Place:
    if placement is None:
        return _place(problem, placement)
    written = placement.over.get(Word(variable.name)) if plot.levels else placement.range
    return written.place if written else placement.place


def _short(end: Expr) -> str:
    return f"{float(end):.4g}" if end.is_real else str(end.evalf(4))


def _curve(
    problem: Problem,
    plot: Plot,
    placement: Placement | None,
    numbers: Mapping[Any, Expr],
    own: tuple[Measured, ...],
    ends: tuple[Expr, Expr],
) -> Curve:
    *across, expr = (each.xreplace(numbers) for each in plot.shown)
    if any(each.has(nan, zoo, oo) for each in (*across, expr)):
        message = f"the plot `{plot.key}` has no curve for these numbers, because a denominator vanishes"
        place = _place(problem, placement)
        raise Rejected(Complaint("drawing", message, place, help="change a number: avoid a resonance, for example"))
    lower, upper = (float(end) for end in ends)
    with told_at(_place(problem, placement)):
        if plot.levels is not None:
            low, high = _range(problem, plot, placement, plot.levels.up, plot.ends[2:], numbers)
            values = tuple((float(value.xreplace(numbers)), thick) for value, thick in plot.levels.values)
            plane = (plot.variable, plot.levels.up), (lower, upper, float(low), float(high))
            from derive.figures.portrait import portrait_of  # imports NumPy

            return Curve(expr, plot.variable, lower, upper, own, (), portrait=portrait_of(expr, *plane, values))
        if across:
            path = _path((across[0], expr), plot.variable, lower, upper)
            return Curve(expr, plot.variable, lower, upper, own, (), across[0], path)
        return Curve(expr, plot.variable, lower, upper, own, extrema(expr, plot.variable, lower, upper))


def _path(shown: tuple[Expr, Expr], variable: Symbol, lower: float, upper: float) -> Path:
    """Return points of a path; a value that is zero within the precision of floating point becomes zero."""
    values = [[value for _, value in values_along(expr, variable, lower, upper, PATH_STEPS)] for expr in shown]
    size = [max(map(abs, each)) for each in values]
    across, up = ([x if abs(x) > NOISE * most else 0.0 for x in each] for each, most in zip(values, size, strict=True))
    return tuple(zip(across, up, strict=True))


def is_closed(path: Path) -> bool:
    """Whether a path ends where it starts, within a thousandth of its size."""
    size = max(max(part) - min(part) for part in zip(*path, strict=True))
    return bool(dist(path[0], path[-1]) < size / 1000)


def panel_letters(curves: Curves) -> list[str]:
    """Return the letter of each panel, or empty letters if there is only one panel."""
    several = len(curves.curves) > 1
    return [case_label(i) if several else "" for i, _ in enumerate(curves.curves)]


def told_value(plot: Plot, extremum: Extremum) -> str:
    """Return the value at an extremum with its unit, to four figures, for the plot, its description and its caption."""
    shown = f"{extremum.value:#.4g}".rstrip(".") if extremum.value else "0"
    return _signed(f"{shown} {plot.unit_up}")


def with_unit(value: float, unit: str) -> str:
    """Return a number to four figures with its unit; a degree sign has no space before it."""
    gap = "" if unit == "\u00b0" else " "
    return _signed(f"{value:.4g}{gap}{unit}")


def _signed(told: str) -> str:
    return told.replace("-", "\u2212").strip()
