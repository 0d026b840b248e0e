"""The contents of the panels of a plot, before a panel has a size: curves, ticks, and the names of axes and curves."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from math import ceil, floor, log10
from typing import Any, TypeAlias

from sympy import fraction

from derive.algebra.expressions import Amount, scalar
from derive.course.given import Measured
from derive.figures.branches import Bifurcations
from derive.figures.extrema import MINIMUM, Extremum
from derive.figures.marks import Outline, Plot
from derive.figures.portrait import LevelLine, Portrait
from derive.figures.space import Spot
from derive.page.plots import DEGREES, NEAR, Axis, Curve, Curves, curve_letters, to_three_figures, with_names, with_unit
from derive.render.drawing.mathtext import runs
from derive.render.drawing.sheets import Extent
from derive.render.notation.breaking import terms_of
from derive.render.notation.latex import unit_latex
from derive.render.notation.layout import Evaluated, Fenced, Layout, Name, Operator, Row, row
from derive.render.notation.notation import Notation

_DECIMAL_POINT = re.compile(r"(?<=[0-9])\.(?=[0-9])")
MOST_ACROSS, MOST_UP = 6, 4  # usual greatest number of intervals between ticks, on each axis
NAME = 17.0  # in points: the space for the name of an extremum above or below a curve
MOST_NAME = 0.25  # greatest part of the height of a panel for the names at one side
HEIGHT = 88.0  # in points: the usual height of a panel between its axes
BARELY = 0.02  # no line is drawn at zero if zero is closer to an end of the range than this part of the range
MARGIN = 0.08  # margin around a curve or a path on sides without names, in units of its size
PORTRAIT = 0.85  # height divided by width of a phase portrait
# Part of the vertical axis of a diagram, at its lower end, without numbers, because the numbers of the horizontal axis
# are close to it.
LOWEST = 0.03
DIAGRAM = 0.6  # height divided by width of a bifurcation diagram
FLATTEST, STEEPEST = 0.25, 1.4  # limits of height divided by width, for a path whose axes have the same scale
# The axis of a positive curve begins at zero if the least value is below this part of the curve's height.
NEAR_ZERO = 0.25
FEWEST = 3  # least number of ticks; smaller steps are tried to reach it
AT_TICK = 1e-5  # a tick marks a place within this fraction of the distance between the outermost ticks
USUAL = (-2, 4)  # numbers at an axis have no factor 10^n if the power of ten of the greatest number is in this range

_ROOT = re.compile(r"\\sqrt\{(?:[^{}]|\{[^{}]*\})*\}")
_NAMED = re.compile(r"(?P<stem>[A-Za-z]+)_(?P<subscript>.+?)(?P<rate>_d+ot)?")  # such as x_1 or phi_1_dot

Ticks: TypeAlias = tuple[tuple[float, str], ...]
Turn: TypeAlias = tuple[Spot, bool, tuple[str, ...]]


@dataclass(frozen=True)
class Trace:
    """One curve of a panel.

    points   the curve, in the units of the axes
    turns    the extrema, each with its point, whether it is a minimum, and the forms of the name of its place on the
             horizontal axis, the shortest form last. There is no name if the place has no symbol and a tick already
             shows it
    name     the name of the curve; empty if the panel has no other curve
    """

    points: tuple[Spot, ...]
    turns: tuple[Turn, ...] = ()
    name: str = ""


@dataclass(frozen=True)
class Part:
    """A part of a branch of a bifurcation diagram: its points, and whether the equilibrium is stable on this part."""

    points: tuple[Spot, ...]
    is_stable: bool


@dataclass(frozen=True)
class Mark:
    """A bifurcation: its places, and the value of the parameter."""

    places: tuple[Spot, ...]
    name: str


@dataclass(frozen=True)
class Panel:
    """The contents of one panel, before the panel has a size.

    traces           the curves
    across, up       the ticks of both axes, with their numbers
    names            the names of both axes
    values           the ranges of the axes: left, below, right, above
    numbers          the texts above the panel: its letter, the symbol of the quantity, and the numbers that were
                     substituted
    is_path          whether the curves are paths, which have dots at their ends and an arrowhead
    lines            the curves of a phase portrait
    levels           the values on these curves
    rests            the points of stable equilibrium in a phase portrait
    outlines         the lines of surfaces in the plane of a path
    branches         the branches of a bifurcation diagram, each with its name and its parts
    changes          the bifurcations
    shape            height divided by width; None for the usual shape
    points           zeros of a curve, or points at which two curves meet, with their names; and the ends of the lines
                     in `heights` on the curve, without names
    heights          horizontal lines at energies, each given by its two ends
    is_signed        whether the vertical axis extends well to both sides of zero, so that a thin line shows zero
    is_signed_across whether the horizontal axis of a path does so, too
    has_open         whether the dots of maxima are open, because they are unstable equilibria
    """

    traces: tuple[Trace, ...]
    across: Ticks
    up: Ticks
    names: tuple[str, str]
    values: Extent
    numbers: tuple[str, ...] = ()
    is_path: bool = False
    shape: float | None = None
    lines: tuple[LevelLine, ...] = ()
    levels: tuple[str, ...] = ()
    rests: tuple[Turn, ...] = ()
    outlines: tuple[tuple[Spot, ...], ...] = ()
    branches: tuple[tuple[str, tuple[Part, ...]], ...] = ()
    changes: tuple[Mark, ...] = ()
    points: tuple[tuple[Spot, str], ...] = ()
    heights: tuple[tuple[Spot, Spot], ...] = ()
    is_signed: bool = False
    is_signed_across: bool = False
    has_open: bool = False

    @property
    def has_several(self) -> bool:
        return len(self.traces) > 1

    @property
    def turns(self) -> tuple[Turn, ...]:
        """Return the extrema of all curves, and the points of stable equilibrium."""
        return (*(turn for trace in self.traces for turn in trace.turns), *self.rests)

    def texts(self) -> Iterator[str]:
        yield from (text for _, text in (*self.across, *self.up))
        yield from (name for _, _, names in self.turns for name in names)
        yield from (name for name, _ in self.branches)
        yield from self.levels
        yield from (change.name for change in self.changes)
        yield from (name for _, name in self.points if name)
        yield from (text for text in (*self.names, *self.numbers, *(trace.name for trace in self.traces)) if text)


def panel_of(
    plot: Plot,
    own: Sequence[Curve],
    curves: Curves,
    notation: Notation,
    letter: str = "",
    height: float = HEIGHT,
) -> Panel:
    """Return the panel of these curves; `height` is the usual height of a panel between its axes, in points."""
    made = _panel(plot, own, curves, notation, letter, height)
    return made if notation.sign == "." else _with_commas(made)


def _with_commas(value: Any) -> Any:
    """Return a panel, or a part of one, with a decimal comma in each text."""
    if isinstance(value, str):
        return _DECIMAL_POINT.sub("{,}", value)
    if isinstance(value, tuple):
        return tuple(map(_with_commas, value))
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{each.name: _with_commas(getattr(value, each.name)) for each in fields(value)})
    return value


def _panel(plot: Plot, own: Sequence[Curve], curves: Curves, notation: Notation, letter: str, height: float) -> Panel:
    if own[0].path:
        return path_panel(plot, own, curves, notation, letter)
    if own[0].portrait:
        return portrait_panel(plot, own[0], own[0].portrait, curves, notation, letter)
    if own[0].diagram:
        return diagram_panel(plot, own[0], own[0].diagram, curves, notation, letter)
    return curve_panel(plot, own, curves, notation, letter, height)


def curve_panel(
    plot: Plot,
    own: Sequence[Curve],
    curves: Curves,
    notation: Notation,
    letter: str,
    height: float,
) -> Panel:
    """Return the panel of curves; the axes leave room for the names below a minimum and above a maximum."""
    ends = [each * curves.variable.per_unit for curve in own for each in (curve.lower, curve.end)]
    start, end = min(ends), max(ends)
    power = _power(start, end, curves.variable)
    across = _scaled_ticks(power, start, end, MOST_ACROSS, curves.variable.in_degrees)
    traces = tuple(
        Trace(
            _scaled(curve.spots, curves.variable, curves.up),
            tuple(
                (
                    (each.at * curves.variable.per_unit, each.value * curves.up.per_unit),
                    each.kind == MINIMUM,
                    _name_of_place(each, curves.variable, across, notation),
                )
                for each in curve.marked
            ),
            _name(curve, curves, notation) if len(own) > 1 else "",
        )
        for curve in own
    )
    _, low, _, high = _box(traces)
    low = 0.0 if 0 < low < NEAR_ZERO * (high - low) else low
    if curves.ends_up:
        low, high = (each * curves.up.per_unit for each in curves.ends_up)
        traces = tuple(
            replace(each, turns=tuple(turn for turn in each.turns if low < turn[0][1] < high)) for each in traces
        )
    tall = (high - low) or abs(high) or 1.0
    lowest = {is_lowest for trace in traces for _, is_lowest, names in trace.turns if names}
    below, above = (tall * (_room(len(lowest), height) if kind in lowest else MARGIN) for kind in (True, False))
    below, above = (0.0, 0.0) if curves.ends_up else (below, above)
    power_up = _power(low, high, curves.up)
    across_by, up_by = curves.variable.per_unit, curves.up.per_unit
    return Panel(
        traces=traces,
        values=(start, low - below, end, high + above),
        across=across,
        up=_scaled_ticks(power_up, low, high, MOST_UP, curves.up.in_degrees, (below, above)),
        names=(
            _axis_name((plot.variable,), curves.variable, notation, power),
            _axis_name(_labels(own), curves.up, notation, power_up),
        ),
        numbers=_title(letter, own, curves, notation),
        points=tuple(
            _point(*each, curves, own, across, notation)
            for each in curves.points(own)
            if not _is_tick_at_end(each, across, curves)
        )
        + _turning_points(own, across_by, up_by),
        heights=tuple(
            ((start * across_by, energy * up_by), (end * across_by, energy * up_by))
            for curve in own
            for energy, ranges in curve.heights
            for start, end in ranges
        ),
        is_signed=_is_well_inside(0.0, low, high),
        has_open=curves.has_unstable,
    )


def _turning_points(own: Sequence[Curve], across_by: float, up_by: float) -> tuple[tuple[Spot, str], ...]:
    """Return the points at which the horizontal lines of energies meet the curve, without names."""
    return tuple(
        ((place * across_by, energy * up_by), "")
        for curve in own
        for energy, ranges in curve.heights
        for both in ranges
        for place in both
        if place not in (curve.lower, curve.upper)
    )


def _is_tick_at_end(point: tuple[float, float, bool], across: Ticks, curves: Curves) -> bool:
    """Whether a point is at the end of all curves, where a tick already shows its place."""
    x, last = point[0] * curves.variable.per_unit, max(curve.end for curve in curves.curves)
    return point[0] == last and _has_tick(x, across)


def _point(
    at: float, value: float, is_zero: bool, curves: Curves, own: Sequence[Curve], across: Ticks, notation: Notation
) -> tuple[Spot, str]:
    """Return a point of a panel with its name. The name is the symbol of its place on the horizontal axis. The value
    follows, unless the values on the axis are divided by a quantity. If the place has no symbol, the name of a meeting
    point has the values on both axes, and the name of a zero has one value. A zero at a tick then has no name."""
    x, y = at * curves.variable.per_unit, value * curves.up.per_unit
    for curve in own:
        (found,) = with_names([Extremum(at, value, MINIMUM)], curve.places, NEAR * (curve.upper - curve.lower))
        if found.name is not None:
            told_x = "" if curves.variable.per is not None else f" = {_with_unit(x, curves.variable.unit)}"
            return (x, y), f"${_mathtext(notation.layout(found.name))}{told_x}$"
    if is_zero and _has_tick(x, across):
        return (x, y), ""
    told = [to_three_figures(x, curves.variable.unit), *([] if is_zero else [to_three_figures(y, curves.up.unit)])]
    return (x, y), "$" + r",\;\;".join(map(_mathtext_of_value, told)) + "$"


def path_panel(plot: Plot, own: Sequence[Curve], curves: Curves, notation: Notation, letter: str = "") -> Panel:
    assert plot.across is not None
    traces = tuple(
        Trace(
            _scaled(curve.path, curves.across, curves.up),
            name=_name(curve, curves, notation) if len(own) > 1 else "",
        )
        for curve in own
    )
    surfaces = tuple(dict.fromkeys(outline for curve in own for outline in curve.outlines))
    corners = [tuple(zip(each.corners[::2], each.corners[1::2], strict=True)) for each in surfaces]
    left, low, right, high = _box([*traces, *map(Trace, filter(None, corners))])
    is_signed, is_signed_across = _is_well_inside(0.0, low, high), _is_well_inside(0.0, left, right)
    (left, right), (low, high) = _with_margin(left, right), _with_margin(low, high)
    shape = None
    powers = _power(left, right, curves.across), _power(low, high, curves.up)
    if curves.across == curves.up:
        wide, tall = right - left, high - low
        shape = max(FLATTEST, min(tall / wide, STEEPEST))
        left, right = _widened(left, right, max(wide, tall / shape))
        low, high = _widened(low, high, max(tall, wide * shape))
        powers = (max(powers, key=abs),) * 2
    most_across, most_up = float(MOST_ACROSS), float(MOST_UP if shape is None or shape > 2 * FLATTEST else MOST_UP - 1)
    if shape is not None:  # the numbers of both axes have the same step
        step = max((right - left) / most_across, (high - low) / most_up)
        most_across, most_up = (right - left) / step, (high - low) / step
    return Panel(
        traces=traces,
        values=(left, low, right, high),
        across=_scaled_ticks(powers[0], left, right, most_across, curves.across.in_degrees),
        up=_scaled_ticks(powers[1], low, high, most_up, curves.up.in_degrees),
        names=(
            _axis_name((plot.across.label,), curves.across, notation, powers[0]),
            _axis_name((plot.label,), curves.up, notation, powers[1]),
        ),
        numbers=_title(letter, own, curves, notation),
        is_path=True,
        shape=shape,
        outlines=_lines_of(surfaces, (left, low, right, high)),
        is_signed=is_signed,
        is_signed_across=is_signed_across,
    )


def _is_well_inside(at: float, low: float, high: float) -> bool:
    return low + BARELY * (high - low) < at < high - BARELY * (high - low)


def _lines_of(surfaces: Sequence[Outline], box: Extent) -> tuple[tuple[Spot, ...], ...]:
    if not surfaces:
        return ()
    from derive.figures.portrait import lines_of  # imports NumPy

    return tuple(line for each in surfaces for line in lines_of(each.expr, each.plane, box))


def portrait_panel(
    plot: Plot, curve: Curve, portrait: Portrait, curves: Curves, notation: Notation, letter: str
) -> Panel:
    """Return the panel of a phase portrait."""
    start, end = (x * curves.variable.per_unit for x in (curve.lower, curve.upper))
    low, high = portrait.low * curves.up.per_unit, portrait.high * curves.up.per_unit
    powers = _power(start, end, curves.variable), _power(low, high, curves.up)
    across = _scaled_ticks(powers[0], start, end, MOST_ACROSS, curves.variable.in_degrees)
    assert plot.levels is not None
    return Panel(
        traces=(),
        values=(start, low, end, high),
        across=across,
        up=_scaled_ticks(powers[1], low, high, MOST_UP),
        names=(
            _axis_name((plot.variable,), curves.variable, notation, powers[0]),
            _axis_name((plot.label,), curves.up, notation, powers[1]),
        ),
        numbers=_title(letter, [curve], curves, notation),
        shape=PORTRAIT,
        lines=tuple(replace(line, points=_scaled(line.points, curves.variable, curves.up)) for line in portrait.lines),
        levels=tuple(
            f"${_level(value, number, curves.levels, notation)}$"
            for (value, _), (number, _) in zip(plot.levels.values, portrait.values, strict=True)
        ),
        rests=tuple(_rest(centre, curve, curves, across, notation) for centre in portrait.centres),
    )


def _level(value: Any, number: float, axis: Axis, notation: Notation) -> str:
    if value.free_symbols and axis.per is None:
        return _mathtext(notation.layout(value))
    return _with_unit(number * axis.per_unit, axis.unit)


def _rest(centre: Spot, curve: Curve, curves: Curves, across: Ticks, notation: Notation) -> Turn:
    """Return a point of stable equilibrium, with the name of its place on the horizontal axis."""
    found = with_names([Extremum(*centre, MINIMUM)], curve.places, NEAR * (curve.upper - curve.lower))[0]
    (spot,) = _scaled([centre], curves.variable, curves.up)
    return spot, True, _name_of_place(found, curves.variable, across, notation)


def _with_unit(value: float, unit: str) -> str:
    return _mathtext_of_value(to_three_figures(value, unit))


def diagram_panel(
    plot: Plot, curve: Curve, found: Bifurcations, curves: Curves, notation: Notation, letter: str
) -> Panel:
    assert plot.diagram is not None
    across, up = curves.variable, curves.up
    start, end = (x * across.per_unit for x in (curve.lower, curve.upper))
    low, high = _with_margin(found.low * up.per_unit, found.high * up.per_unit)
    powers = _power(start, end, across), _power(low, high, up)
    ticks = _scaled_ticks(powers[1], low, high, MOST_UP + 2, up.in_degrees)
    parts: dict[int, list[Part]] = {}
    for line in found.lines:
        parts.setdefault(line.of, []).append(Part(_scaled(line.points, across, up), line.is_stable))
    names = (_mathtext(notation.layout(plot.diagram.branches[i].label)) for i in parts)
    parameter = _mathtext(notation.layout(plot.named_across), inline=True)
    return Panel(
        traces=(),
        values=(start, low, end, high),
        across=_scaled_ticks(powers[0], start, end, MOST_ACROSS, across.in_degrees),
        up=tuple(tick for tick in ticks if tick[0] > low + LOWEST * (high - low)),
        names=(
            _axis_name((plot.named_across,), across, notation, powers[0], inline=True),
            _axis_name((plot.label,), up, notation, powers[1]),
        ),
        numbers=_title(letter, [curve], curves, notation),
        branches=tuple((f"${name}$", tuple(own)) for name, own in zip(names, parts.values(), strict=True)),
        changes=tuple(
            Mark(
                _scaled([(each.at, place) for place in each.places], across, up),
                f"${parameter} = {_mathtext_of_value(with_unit(each.at * across.per_unit, across.unit))}$",
            )
            for each in found.changes
        ),
        shape=DIAGRAM,
    )


# --- ranges and ticks ------------------------------------------------------------------------------------------------


def _scaled(points: Sequence[Spot], across: Axis, up: Axis) -> tuple[Spot, ...]:
    return tuple((x * across.per_unit, y * up.per_unit) for x, y in points)


def _box(traces: Sequence[Trace]) -> Extent:
    xs, ys = ([spot[k] for trace in traces for spot in trace.points] for k in (0, 1))
    return min(xs), min(ys), max(xs), max(ys)


def _room(sides: int, height: float) -> float:
    """Return the margin above or below a curve for the names of its extrema, in units of the height of the curve. If
    there are names above and below, `sides` is 2."""
    part = min(NAME / height, MOST_NAME)
    return part / (1 - 2 * part) if sides == 2 else part * (1 + MARGIN) / (1 - part)


def _with_margin(low: float, high: float) -> tuple[float, float]:
    room = MARGIN * ((high - low) or abs(high) or 1.0)
    return low - room, high + room


def _widened(low: float, high: float, size: float) -> tuple[float, float]:
    middle = (low + high) / 2
    return middle - size / 2, middle + size / 2


def _power(low: float, high: float, axis: Axis) -> int:
    """Return the power of ten by which the numbers of an axis are divided; 0 for degrees and numbers of a usual
    size."""
    greatest = max(abs(low), abs(high))
    power = floor(log10(greatest)) if greatest > 0 else 0
    return 0 if axis.in_degrees or USUAL[0] <= power <= USUAL[1] else power


def _scaled_ticks(
    power: int, low: float, high: float, most: float, in_degrees: bool = False, room: tuple[float, float] = (0.0, 0.0)
) -> Ticks:
    unit = 10.0**power
    below, above = (each / unit for each in room)
    found = _ticks(low / unit, high / unit, most, in_degrees, (below, above))
    return tuple((at * unit, text) for at, text in found) if power else found


def _ticks(low: float, high: float, most: float, in_degrees: bool, room: tuple[float, float]) -> Ticks:
    """Return round numbers with the same number of decimals. In a range of at least 20 degrees, the step is 5, 10, 15,
    30, 45, 90, 180 or 360 degrees.

    If there is enough room beyond an end of the range, the outermost number may be beyond this end.
    """
    span = high - low or abs(high) or 1.0
    tens = 10.0 ** floor(log10(span))
    steps = (
        (5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0)
        if in_degrees and span >= 20
        else [tens * k for k in (0.1, 0.2, 0.5, 1, 2, 5)]
    )
    every = [step for step in steps if span / step <= most] or [steps[-1]]
    smaller = [step for step in steps if step < every[0]]
    for step in (every[0], *smaller[:-3:-1]):
        first = max(floor(low / step + 1e-9), ceil((low - room[0]) / step - 1e-9))
        last = min(ceil(high / step - 1e-9), floor((high + room[1]) / step + 1e-9))
        if last - first + 1 >= FEWEST:
            break
    decimals = max(0, -floor(log10(step) + 1e-9))
    return tuple((step * k, f"${step * k:.{decimals}f}$") for k in range(first, last + 1))


# --- names -----------------------------------------------------------------------------------------------------------


def _name_of_place(extremum: Extremum, axis: Axis, ticks: Ticks, notation: Notation) -> tuple[str, ...]:
    """Return the possible names of the place of an extremum, the longest first: `r_0 = 0.589 m` and `r_0`; without a
    symbol `54.6°`."""
    x = extremum.at * axis.per_unit
    is_unit = axis.per is not None and (extremum.name is not None or abs(x - 1) < AT_TICK)
    has_no_value = is_unit or _has_tick(x, ticks)
    value = [] if has_no_value else [_with_unit(x, axis.unit)]
    symbol = [_mathtext(notation.layout(extremum.name))] if extremum.name is not None else []
    forms = dict.fromkeys((" = ".join([*symbol, *value]), *symbol))
    return tuple(f"${form}$" for form in forms if form)


def _has_tick(x: float, ticks: Ticks) -> bool:
    places = [at for at, _ in ticks]
    return any(abs(x - at) <= AT_TICK * (max(places) - min(places)) for at in places)


def _title(letter: str, own: Sequence[Curve], curves: Curves, notation: Notation) -> tuple[str, ...]:
    """Return the texts above a panel of one curve: the letter of the panel, the symbol of the quantity, and the
    numbers."""
    if len(own) > 1:
        return ()
    items = _distinction(own[0], curves, notation)
    marked = [f"({{\\mathrm{{{letter}}}}})\\;\\;{items[0] if items else ''}", *items[1:]] if letter else items
    return tuple(f"${item}{',' if i < len(marked) else ''}$" for i, item in enumerate(marked, 1))


def _name(curve: Curve, curves: Curves, notation: Notation) -> str:
    letter = curve_letters(curves)[curves.curves.index(curve)] if curves.is_lettered else ""
    first = rf"({{\mathrm{{{letter}}}}})\;\;" if letter else ""
    return "$" + first + r",\;\; ".join(_distinction(curve, curves, notation)) + "$"


def _distinction(curve: Curve, curves: Curves, notation: Notation) -> list[str]:
    """Return what distinguishes a curve from the others, such as the symbol of its quantity."""
    quantity = [_mathtext(notation.layout(curve.label))] if curves.labels_differ else []
    return [*quantity, *_numbers(curve.numbers, notation)]


def _labels(own: Sequence[Curve]) -> tuple[Any, ...]:
    """Return the symbols for the name of the vertical axis. Symbols that differ only in their subscripts may be
    replaced by the symbol without a subscript."""
    labels = tuple(dict.fromkeys(curve.label for curve in own))
    named = [_NAMED.fullmatch(str(label)) for label in labels]
    stems = {f"{each['stem']}{each['rate'] or ''}" if each else "" for each in named}
    return (scalar(*stems),) if len(labels) > 2 and len(stems) == 1 and "" not in stems else labels


def _axis_name(symbols: Sequence[Any], axis: Axis, notation: Notation, power: int = 0, inline: bool = False) -> str:
    """Return the name of an axis, a quantity divided by its unit or by another quantity: `U / J`, `v / (m/s)`, `U /
    (10^33 J)`, `r / r_0`. The names of several quantities on one axis are in brackets before their common divisor:
    `(x, y) / m`."""
    layouts = [_with_arguments(notation.layout(symbol)) for symbol in symbols]
    if axis.per is not None and len(symbols) == 1 and fraction(axis.per)[0] == 1:
        return f"${_mathtext(notation.layout(symbols[0] / axis.per), inline=True)}$"
    name = r",\,".join(_mathtext(layout, inline) for layout in layouts)
    divided = "" if axis.per is None else _mathtext(notation.layout(axis.per), inline=True)
    unit = [divided] if divided else [_mathtext_of_unit(axis.unit)] if axis.unit else []
    parts = [*([f"10^{{{power}}}"] if power else []), *unit]
    is_product = (
        len(parts) > 1
        or any(sign in axis.unit for sign in " /")
        or bool(divided and axis.per.is_Mul and not _ROOT.fullmatch(divided))
    )
    divisor = r"\,".join(parts)
    divisor = f"({divisor})" if is_product else divisor
    over = rf"\,/\,{divisor}" if divisor else ""
    if over and (len(layouts) > 1 or any(len(terms_of(layout)) > 1 for layout in layouts)):
        name = f"({name})"
    return f"${name}{over}$"


def _with_arguments(layout: Layout) -> Layout:
    """Write a value at a point as U(0), because a subscript behind a bar would be too small in the name of an axis."""
    if isinstance(layout, Row):
        return row(*map(_with_arguments, layout.items))
    match layout:
        case Evaluated(Name() as inside, Row((_, Operator("equals"), value))):
            return row(inside, Fenced(value))
    return layout


def _numbers(numbers: Sequence[Measured], notation: Notation) -> list[str]:
    items = []
    for measured in numbers:
        amount = Amount(measured.number, measured.unit, measured.factor)
        items.append(rf"{_mathtext(notation.layout(measured.symbol))} = {_mathtext(notation.layout(amount))}")
    return items


def _mathtext(layout: Any, inline: bool = False) -> str:
    text = "".join(run.text.strip("$") for run in runs(layout, inline))
    return text.replace(r"\mathrm{{}^\circ}", _mathtext_of_unit(DEGREES))  # an upright degree sign would have a gap


def _mathtext_of_value(told: str) -> str:
    """Return a value such as `2.205 J` as mathtext: the number, a space, and the unit upright."""
    number, _, unit = told.replace("\u2212", "{-}").partition(" ")  # the braces prevent a space after the sign
    return rf"{number}\,{unit_latex(unit)}" if unit else number.replace(DEGREES, _mathtext_of_unit(DEGREES))


def _mathtext_of_unit(unit: str) -> str:
    return r"{}^{\circ}" if unit == DEGREES else unit_latex(unit)
