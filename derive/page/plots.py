"""The curves of a plot: the range, and the numbers and extrema of each curve.

A case states the numbers that differ from the first case. All other numbers come from the first case or the problem.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from math import dist
from typing import TYPE_CHECKING, Any, TypeAlias

from sympy import Expr, Symbol, nan, oo, pi, zoo

from derive.algebra.expressions import TIME, explicit
from derive.course.given import Measured
from derive.course.placement import Placement, case_label
from derive.course.problem import Problem
from derive.course.problem_file import APART, TOGETHER
from derive.course.stock import told_at
from derive.course.yaml_tree import Word
from derive.errors import Complaint, Place, Rejected, rejected
from derive.figures.extrema import MAXIMUM, NOISE, Extremum, extrema, meetings, values_along, zeros
from derive.figures.marks import Outline, Plot, letters_in

if TYPE_CHECKING:
    from derive.figures.branches import Bifurcations
    from derive.figures.portrait import Portrait

Path: TypeAlias = tuple[tuple[float, float], ...]

DEGREE, DEGREES, RADIANS = pi / 180, "°", "rad"
JOULE, POTENTIAL = "J", "U"  # the unit and the first letter of a potential energy

STEPS = 240  # least number of steps of a curve
STEPS_OF_TURN, MOST_STEPS = 40, 6000  # number of steps for each extremum, and greatest number of steps of a curve
MOST_POINTS = 2  # a panel with more zeros, or with more meeting points of curves, has no marks for them
PATH_STEPS = 720  # number of steps of a path, which may go round many times
# A curve with more extrema has no marks at its extrema. The second number is for curves against time.
MOST_MARKED, MOST_IN_TIME = 6, 3
# Numbers with a smaller relative difference count as equal. The distance of an extremum from a named place is compared
# with this fraction of the range.
NEAR = 1e-6
MOST_TOGETHER = 4  # greatest number of curves in one panel; they differ in the style of their lines
KEPT = 1 / 3  # length of the constant part after the range of a curve, divided by the length of this range
# To test whether a curve depends on the number of a symbol, this number is multiplied by CHANGED. The values of the
# curve before and after are compared at the fractions SHARES of the range.
CHANGED, SHARES = 1.31, (0.23, 0.59, 0.87)
FLATTEST = 1 / 6  # least size of a readable curve, divided by the size of all curves in the panel


@dataclass(frozen=True)
class Curve:
    """One curve: a quantity in its SI unit as a function of one symbol, and the numbers that are substituted.

    label     the name of the quantity
    across    the quantity on the horizontal axis of a path; a path has no extrema
    path      points of a path in the order of the motion
    portrait  the curves of a phase portrait
    outlines  surfaces in the plane of a path
    diagram   the branches of a bifurcation diagram
    places    the values of the variable for which the solution has a symbol, with these symbols
    then      the value that the curve keeps after its range
    heights   energies at which a line is drawn, each with the ranges in which the curve is below this line
    """

    expr: Expr
    variable: Symbol
    lower: float
    upper: float
    numbers: tuple[Measured, ...]
    extrema: tuple[Extremum, ...]
    label: Any = None
    across: Expr | None = None
    path: Path = field(default=(), repr=False)
    portrait: Portrait | None = None
    outlines: tuple[Outline, ...] = ()
    diagram: Bifurcations | None = None
    places: tuple[tuple[Any, float], ...] = ()
    then: float | None = None
    heights: tuple[tuple[float, Path], ...] = ()

    @cached_property
    def spots(self) -> Path:
        """Return points of the curve, in SI units."""
        steps = min(max(STEPS, STEPS_OF_TURN * len(self.extrema)), MOST_STEPS)
        if self.path:
            return self.path
        kept = () if self.then is None else ((self.end, self.then),)
        return (*values_along(self.expr, self.variable, self.lower, self.upper, steps), *kept)

    @property
    def end(self) -> float:
        """Return the end of the horizontal axis; after the range, there is room for a value that the curve keeps."""
        return self.upper if self.then is None else self.upper + KEPT * (self.upper - self.lower)

    @property
    def marked(self) -> tuple[Extremum, ...]:
        """Return the extrema to mark: none if there are many, because the marks would hide the curve."""
        most = MOST_IN_TIME if self.variable == TIME else MOST_MARKED
        return self.extrema if len(self.extrema) <= most else ()


@dataclass(frozen=True)
class Axis:
    """The unit of an axis; one SI unit equals `per_unit` of these units.

    If the values on an axis are divided by a quantity, `per` is the name of this quantity, and the unit is empty.
    """

    unit: str
    per_unit: float = 1.0
    per: Any = None

    @property
    def in_degrees(self) -> bool:
        return self.unit == DEGREES


IN_DEGREES = Axis(DEGREES, float(1 / DEGREE))


@dataclass(frozen=True)
class Curves:
    """The curves of a plot, the numbers that all curves share, and the units of the axes.

    variable      the unit of the symbol that varies: on the horizontal axis, or along a path
    up            the unit of the vertical axis
    across        the unit of the horizontal axis
    is_together   whether all curves are in one panel
    ends_up       the ends of the vertical axis in SI units, if the problem states them
    is_lettered   whether the caption refers to the curves of one panel as (i), (ii)
    levels        the unit of the levels of a phase portrait
    is_energy     whether the vertical axis shows an energy
    """

    curves: tuple[Curve, ...]
    variable: Axis
    up: Axis
    across: Axis
    shared: tuple[Measured, ...] = ()
    is_together: bool = False
    is_lettered: bool = False
    ends_up: tuple[float, float] | None = None
    levels: Axis = field(default_factory=lambda: Axis(JOULE))
    is_energy: bool = False

    @property
    def has_unstable(self) -> bool:
        """Whether a curve is a potential energy with a marked maximum, an unstable equilibrium."""
        potential = [each for each in self.curves if str(each.label).startswith(POTENTIAL)]
        return self.is_energy and any(turn.kind == MAXIMUM for each in potential for turn in each.marked)

    def points(self, own: Sequence[Curve]) -> tuple[tuple[float, float, bool], ...]:
        """Return the marked points of a panel that are not extrema: the coordinates of each in SI units, and whether it
        is a zero.

        They are meeting points of two curves, or zeros. The zero of an energy is arbitrary, so it is not marked.
        """
        one, *others = own
        if self.labels_differ and len(own) > 2:
            return ()
        found = []
        if others and self.labels_differ:
            places = meetings(one.expr, others[0].expr, one.variable, one.lower, one.upper)
            found = [(at, float(one.expr.subs(one.variable, at)), False) for at in places]
        if not found and not self.is_energy:
            every = [(each, at) for each in own for at in zeros(each.expr, each.variable, each.lower, each.upper)]
            found = [(at, 0.0, True) for _, at in every]
        return tuple(found) if len(found) <= MOST_POINTS else ()

    @property
    def panels(self) -> tuple[tuple[Curve, ...], ...]:
        """Return the curves of each panel."""
        return (self.curves,) if self.is_together else tuple((curve,) for curve in self.curves)

    @property
    def labels_differ(self) -> bool:
        """Whether the curves show quantities with different names."""
        return len({curve.label for curve in self.curves}) > 1


def curves_of(problem: Problem, plot: Plot, placement: Placement | None) -> Curves:
    """Return every curve of the plot with its extrema; raise `Rejected` if a curve cannot be drawn, for example because
    a symbol has no number."""
    written = _ends(plot, placement)
    letters = plot.letters_of_curves | letters_in(written)
    pairs = plots_with_cases(plot, placement)
    # A number for a symbol that does not occur in any curve would be shown although it has no effect.
    cases = [tuple(number for number in case if number.symbol in letters) for _, case in pairs]
    changed = dict.fromkeys(number.symbol for case in cases[1:] for number in case if number not in cases[0])
    # The caption states the numbers that all curves share. The numbers of a single curve without a caption are above
    # the panel.
    is_told = len(cases) > 1 or bool(placement and placement.caption)
    numbers = [_numbers(problem, plot, placement, (*cases[0], *case), letters) for case in cases]
    used = {letter for letter in numbers[0] if not plot.per or _matters(letter, pairs, numbers, written)}
    first = tuple(number for number in cases[0] if number.symbol in used or number.symbol in changed)
    shared = tuple(number for number in first if number.symbol not in changed) if is_told else ()
    own = [_own(problem, cases[0], case, changed) if is_told else first for case in cases]
    ends = [_range(problem, plot, placement, plot.variable, written[:2], each) for each in numbers]
    found = tuple(
        _curve(problem, each, placement, known, shown, both)
        for (each, _), known, shown, both in zip(pairs, numbers, own, ends, strict=True)
    )
    variable = IN_DEGREES if plot.of == "angle" and not _in_radians(ends) else Axis(_unit(plot.of))
    if plot.others and len({(curve.label, curve.numbers) for curve in found}) < len(found):
        message = f"two curves of the plot `{plot.key}` have the same name and the same numbers"
        help_line = "give the answers different symbols, or write a case for each curve"
        raise Rejected(Complaint("drawing", message, _place(problem, placement), help=help_line))
    across = _axis(plot.across.unit) if plot.across else variable
    together = _are_together(problem, plot, placement, found)
    said = placement.caption.text if placement and placement.caption else ""
    is_lettered = together and f"({case_label(1)})" in said
    ends_up = _ends_up(problem, plot, placement)
    usual = [across, _axis(plot.unit_up), Axis(JOULE)]
    axes = [_divided(*each, problem, plot, placement, numbers) for each in zip(usual, plot.per, strict=False)]
    across, up, levels = [*axes, *usual[len(axes) :]]
    variable = variable if plot.across else across
    is_energy = plot.unit_up == JOULE
    return Curves(found, variable, up, across, shared, together, is_lettered, ends_up, levels, is_energy)


def _divided(
    usual: Axis,
    per: tuple[Any, Expr],
    problem: Problem,
    plot: Plot,
    placement: Placement | None,
    numbers: Sequence[Mapping[Any, Expr]],
) -> Axis:
    """Return the axis of values divided by a quantity, which must have the same positive value for all curves."""
    name, expr = per
    if name == 1:
        return usual
    sizes = [float(expr.xreplace(each)) for each in numbers]
    if max(sizes) - min(sizes) > NEAR * abs(sizes[0]) or sizes[0] <= 0:
        message = f"`{name}`, the divisor of an axis of `{plot.key}`, must be the same positive number for all curves"
        raise Rejected(Complaint("drawing", message, _place(problem, placement), help="divide by a different quantity"))
    return Axis("", 1 / sizes[0], name)


def _matters(
    letter: Any,
    pairs: Sequence[tuple[Plot, Any]],
    numbers: Sequence[Mapping[Any, Expr]],
    ends: Sequence[Expr],
) -> bool:
    """Whether the curves, divided by the divisors of the axes, depend on the numerical value of a letter."""
    for (plot, _), known in zip(pairs, numbers, strict=True):
        other = {**known, letter: known[letter] * CHANGED}
        for share in SHARES:
            values = [_divided_values(plot, each, known, ends, share) for each in (known, other)]
            if any(abs(one - two) > NEAR * (abs(one) + abs(two)) for one, two in zip(*values, strict=True)):
                return True
    return False


def _divided_values(
    plot: Plot, numbers: Mapping[Any, Expr], first: Mapping[Any, Expr], ends: Sequence[Expr], share: float
) -> list[complex]:
    """Return the values of a plot at one place, divided by the divisors of the axes."""
    divisors = [[expr.xreplace(each) for _, expr in plot.per] for each in (numbers, first)]
    lower, upper = (end.xreplace(numbers if plot.across else first) for end in ends[:2])
    at = lower + share * (upper - lower)
    moved = {plot.variable: at if plot.across else at * divisors[0][0] / divisors[1][0]}
    if plot.levels is not None:
        low, high = (end.xreplace(first) for end in ends[2:])
        moved[plot.levels.up] = (low + share * (high - low)) * divisors[0][1] / divisors[1][1]
    over = divisors[0][-len(plot.shown) :]
    values = [each.xreplace(numbers).xreplace(moved) / by for each, by in zip(plot.shown, over, strict=True)]
    return [complex(value.evalf()) for value in values]


def _in_radians(ends: Iterable[tuple[Expr, Expr]]) -> bool:
    return any(end.is_Rational and end != 0 for both in ends for end in both)


def plots_with_cases(plot: Plot, placement: Placement | None) -> list[tuple[Plot, tuple[Measured, ...]]]:
    """Return the plot of each curve with the numbers of its case."""
    plots, cases = plot.each, placement.cases if placement and placement.cases else ((),)
    if len(plots) == 1:
        return [(plots[0], case) for case in cases]
    if len(cases) not in (1, len(plots)):
        message = f"the plot `{plot.key}` has {len(plots)} curves but {len(cases)} cases"
        place = placement.place if placement else None
        raise Rejected(Complaint("drawing", message, place, help="write one case for each curve, or one for all"))
    return list(zip(plots, cases if len(cases) > 1 else cases * len(plots), strict=True))


def _own(
    problem: Problem, first: tuple[Measured, ...], case: tuple[Measured, ...], changed: Iterable[Symbol]
) -> tuple[Measured, ...]:
    """Return, for each symbol whose number differs between the cases, the number that this case uses."""
    known = {number.symbol: number for number in (*first, *case)}
    missing = [symbol for symbol in changed if symbol not in known]
    known |= {number.symbol: number for number in (problem.measured if missing else ()) if number.symbol in missing}
    return tuple(known[symbol] for symbol in changed if symbol in known)


def _are_together(problem: Problem, plot: Plot, placement: Placement | None, curves: Sequence[Curve]) -> bool:
    """Return whether the curves are in one panel. If the problem does not state this, a few curves of several
    quantities are in one panel. A few curves of one quantity are in one panel if they have comparable sizes and, except
    for paths, the same range."""
    stated = placement.panels if placement else None
    if len(curves) < 2 or plot.levels is not None or plot.diagram is not None or stated == APART:
        return False
    if stated == TOGETHER and len(curves) > MOST_TOGETHER:
        message = f"the panel of `{plot.key}` has room for at most {MOST_TOGETHER} curves, but there are {len(curves)}"
        raise Rejected(Complaint("drawing", message, _place(problem, placement), help="leave `panels` out"))
    if stated == TOGETHER or len(curves) > MOST_TOGETHER or plot.others:
        return len(curves) <= MOST_TOGETHER
    has_one_range = bool(curves[0].path) or len({(curve.lower, curve.upper) for curve in curves}) == 1
    with told_at(_place(problem, placement)):
        return has_one_range and _are_of_comparable_size(curves)


def _are_of_comparable_size(curves: Sequence[Curve]) -> bool:
    """Return whether every curve stays readable if all curves share one panel."""
    spans = [[(min(values), max(values)) for values in zip(*curve.spots, strict=True)] for curve in curves]
    whole = [max(high for _, high in each) - min(low for low, _ in each) for each in zip(*spans, strict=True)]
    parts = [[high - low for low, high in each] for each in spans]
    measured = (0, 1) if curves[0].path else (1,)
    return all(any(part[k] >= FLATTEST * whole[k] for k in measured) for part in parts)


def _unit(kind: str) -> str:
    from derive.algebra.kinds import unit_of_kind

    return unit_of_kind(kind)


def _axis(unit: str) -> Axis:
    return IN_DEGREES if unit == RADIANS else Axis(unit)


def _ends(plot: Plot, placement: Placement | None) -> list[Expr]:
    """Return the ends of the range that the problem states, or else the ends that the plot has."""
    if placement and placement.range and not placement.is_of_engine:
        return placement.range.of_kind(plot.of)
    return list(plot.ends)


def _ends_up(problem: Problem, plot: Plot, placement: Placement | None) -> tuple[float, float] | None:
    """Return the ends of the vertical axis if the problem states them; otherwise None."""
    if placement is None or placement.up is None:
        return None
    with told_at(placement.up.place):
        low, high = _range(problem, plot, placement, plot.variable, placement.up.of_kind(plot.kind), {})
    return float(low), float(high)


def _numbers(
    problem: Problem, plot: Plot, placement: Placement | None, known: tuple[Measured, ...], letters: set[Symbol]
) -> dict[Any, Expr]:
    """Return the given numbers of symbols that do not vary; raise `Rejected` if a symbol in the plot has no number."""
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
    over = placement.over.get(Word(variable.name)) if plot.levels or plot.diagram else None
    written = over or placement.range
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
    if plot.diagram is not None:
        return _diagram(problem, plot, placement, numbers, own, ends)
    *across, expr = (each.xreplace(numbers) for each in plot.shown)
    if any(each.has(nan, zoo, oo) for each in (*across, expr)):
        message = f"the plot `{plot.key}` has no curve for these numbers, because a denominator vanishes"
        place = _place(problem, placement)
        raise Rejected(Complaint("drawing", message, place, help="change a number: avoid a resonance, for example"))
    lower, upper = (float(end) for end in ends)
    known = [(name, value.xreplace(numbers)) for name, value in plot.places]
    places = tuple((name, float(value)) for name, value in known if value.is_number and value.is_real)
    with told_at(_place(problem, placement)):
        if plot.levels is not None:
            low, high = _range(problem, plot, placement, plot.levels.up, plot.ends[2:], numbers)
            values = tuple((float(value.xreplace(numbers)), thick) for value, thick in plot.levels.values)
            plane = (plot.variable, plot.levels.up), (lower, upper, float(low), float(high))
            from derive.figures.portrait import portrait_of  # imports NumPy

            portrait = portrait_of(expr, *plane, values)
            return Curve(expr, plot.variable, lower, upper, own, (), plot.label, portrait=portrait, places=places)
        if across:
            path = _path((across[0], expr), plot.variable, lower, upper)
            outlines = tuple(_with_numbers(each, numbers) for each in plot.outlines)
            return Curve(expr, plot.variable, lower, upper, own, (), plot.label, across[0], path, outlines=outlines)
        found = with_names(extrema(expr, plot.variable, lower, upper), places, NEAR * (upper - lower))
        then = None if plot.then is None else float(plot.then.xreplace(numbers))
        if then is not None and abs(float(expr.subs(plot.variable, upper)) - then) > NEAR * (abs(then) or 1.0):
            rejected("wrong-argument", f"a curve of `{plot.key}` does not end at the value of `then`", None)
        energies = [expr_of.xreplace(numbers) for expr_of in plot.energies]
        heights = tuple((float(energy), _below(expr, energy, plot.variable, lower, upper)) for energy in energies)
        return Curve(
            expr, plot.variable, lower, upper, own, found, plot.label, places=places, then=then, heights=heights
        )


def _below(expr: Expr, energy: Expr, variable: Symbol, lower: float, upper: float) -> Path:
    """Return the ranges of the variable in which a potential energy is less than a given energy."""
    crossed = [lower, *zeros(expr - energy, variable, lower, upper), upper]
    lowest = [float((expr - energy).subs(variable, (one + other) / 2)) < 0 for one, other in pairwise(crossed)]
    return tuple(both for both, is_below in zip(pairwise(crossed), lowest, strict=True) if is_below)


def with_names(found: Sequence[Extremum], places: Sequence[tuple[Any, float]], near: float) -> tuple[Extremum, ...]:
    """Return the extrema, each with the name of the first place within the distance `near` of it, if there is one."""
    names = [next((name for name, at in places if abs(at - each.at) <= near), None) for each in found]
    return tuple(replace(each, name=name) for each, name in zip(found, names, strict=True))


def _diagram(
    problem: Problem,
    plot: Plot,
    placement: Placement | None,
    numbers: Mapping[Any, Expr],
    own: tuple[Measured, ...],
    ends: tuple[Expr, Expr],
) -> Curve:
    """Return the branches of a bifurcation diagram as a curve without extrema."""
    assert plot.diagram is not None
    from derive.figures.branches import bifurcations_of  # imports mpmath

    lower, upper = (float(end) for end in ends)
    axis = None
    if plot.diagram.ends:
        low, high = _range(problem, plot, placement, plot.diagram.coordinate, plot.diagram.ends, numbers)
        axis = float(low), float(high)
    with told_at(_place(problem, placement)):
        found = bifurcations_of(plot.diagram, plot.variable, (lower, upper), numbers, axis, plot.kind == "angle")
    return Curve(plot.expr, plot.variable, lower, upper, own, (), plot.label, diagram=found)


def _with_numbers(outline: Outline, numbers: Mapping[Any, Expr]) -> Outline:
    corners = tuple(float(each.xreplace(numbers)) for each in outline.corners)
    return replace(outline, expr=outline.expr.xreplace(numbers), corners=corners)


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
    """Return the label of each panel, or an empty label if there is only one panel."""
    several = len(curves.panels) > 1
    return [case_label(i) if several else "" for i, _ in enumerate(curves.panels)]


def curve_letters(curves: Curves) -> list[str]:
    """Return the label of each curve in the caption."""
    if curves.is_lettered:
        return [case_label(i) for i, _ in enumerate(curves.curves)]
    letters = zip(panel_letters(curves), curves.panels, strict=True)
    return [letter for letter, panel in letters for _ in panel]


def told_value(up: Axis, extremum: Extremum) -> str:
    """Return the value at an extremum with its unit, to four figures, for the plot and for its description in words."""
    value = extremum.value * up.per_unit
    shown = f"{value:#.4g}".rstrip(".") if value else "0"
    return _signed(f"{shown}{_gap(up.unit)}{up.unit}")


def with_unit(value: float, unit: str) -> str:
    """Return a number to at most four figures with its unit; a degree sign has no space before it."""
    return _signed(f"{value:.4g}{_gap(unit)}{unit}")


def to_three_figures(value: float, unit: str) -> str:
    """Return a number to at most three figures with its unit."""
    return _signed(f"{value:.3g}{_gap(unit)}{unit}")


def _gap(unit: str) -> str:
    return "" if unit == DEGREES else " "


def _signed(told: str) -> str:
    return told.replace("-", "\u2212").strip()
