"""A plot as files: one panel for each curve, with quantity and unit at each axis and with marked extrema.

A path has dots at its start and at its end and an arrowhead in the direction of the motion. If both quantities of a
path have the same unit, both axes have the same scale.

Numbers and names have the font of the page. The name of a maximum is above the curve, and that of a minimum below it.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, combinations, pairwise
from math import ceil, dist, floor, log10
from typing import Any, TypeAlias

from derive.algebra.expressions import Amount
from derive.figures.extrema import MINIMUM, values_along
from derive.figures.marks import Plot
from derive.figures.pieces import Bullet, Piece, Stroke
from derive.figures.portrait import LevelLine, Portrait
from derive.figures.space import Spot
from derive.page.plots import DEGREES, Curve, Curves, panel_letters, told_value
from derive.page.wording import Phrases
from derive.render.drawing.canvas import LINE, QUIET, shapes_of
from derive.render.drawing.lettering import Lettered, Letters, letters_of
from derive.render.drawing.mathtext import runs
from derive.render.drawing.sheets import Extent, Shape, Sheet, moved, sheet_of_shapes, turned
from derive.render.notation.latex import unit_latex
from derive.render.notation.notation import Notation

STEPS = 240
MOST_ACROSS, MOST_UP = 6, 4  # greatest numbers of intervals between the ticks of the two axes
ROOM = 0.42  # margin above and below a curve, in units of its height
PANEL, TALL = 6.0, 4.2  # centimetres
MARGIN = 0.08  # margin around a path, in units of its width and height
PORTRAIT = 0.85  # height divided by width of a phase portrait
FLATTEST, STEEPEST = 0.25, 1.4  # height divided by width of a path whose axes have the same scale
CM = 72 / 2.54
USUAL = (-2, 4)  # the powers of ten of numbers that an axis shows without a power of ten
SMALL, SMALLER, SMALLEST = 0.9, 0.85, 0.8  # font scales: at the axes, above a panel, at extrema
TICK = 3.5  # in points: the length of a tick, and the distance from a tick to its number
PAD = 4.0  # in points: the distance of the name of an axis from its numbers, and of a name from its dot
EDGE = 3.0  # in points: the margin around everything
HEAD = 0.4  # position of the arrowhead of a path; after half of its length, a path may be back at its start
DOT = 2.2  # in points: the radius of the dot at an extremum

Ticks: TypeAlias = tuple[tuple[float, str], ...]


@dataclass(frozen=True)
class Panel:
    """The contents of one panel, before the panel has a size.

    points           the curve, in the units of the axes
    across, up       the ticks of both axes, with their numbers
    names            the names of both axes
    values           the ranges of the axes: left, below, right, above
    turns            the extrema: the point, whether it is a minimum, and its names, with and without the kind
    numbers          the numbers that were substituted
    is_path          whether the curve is a path, which has dots at its ends and an arrowhead
    lines            the curves of a phase portrait
    shape            height divided by width, if it is not that of the paper
    """

    points: tuple[Spot, ...]
    across: Ticks
    up: Ticks
    names: tuple[str, str]
    values: Extent
    turns: tuple[tuple[Spot, bool, tuple[str, str]], ...]
    numbers: str
    is_path: bool = False
    shape: float | None = None
    lines: tuple[LevelLine, ...] = ()

    def texts(self) -> Iterator[str]:
        yield from (text for _, text in (*self.across, *self.up))
        yield from (name for _, _, names in self.turns for name in names)
        yield from (*self.names, *([self.numbers] if self.numbers else []))


@dataclass(frozen=True)
class Frame:
    """The position of a panel's axes on paper, and the ranges of the axes: left, below, right, above."""

    paper: Extent
    values: Extent

    def spot(self, place: Spot) -> Spot:
        """Return the point on paper for a point of the curve."""
        x, y = (
            start + (at - low) / (high - low) * (end - start)
            for at, start, end, low, high in zip(
                place, self.paper[:2], self.paper[2:], self.values[:2], self.values[2:], strict=True
            )
        )
        return x, y


@dataclass(frozen=True)
class Writing:
    """Places texts on paper as shapes."""

    known: Mapping[str, Lettered]

    def size(self, text: str, scale: float) -> tuple[float, float]:
        left, below, right, above = self.known[text][1]
        return scale * (right - left), scale * (above - below)

    def at(self, spot: Spot, text: str, scale: float, share: Spot, colour: str = LINE, upwards: bool = False) -> Shape:
        """Place a text so that the fractions `share` of its width and height are to the left of a point and below
        it."""
        contour, extent = self.known[text]
        if upwards:
            contour, extent = turned(contour), (-extent[3], extent[0], -extent[1], extent[2])
        left, below = (
            at - scale * (low + part * (high - low))
            for at, part, low, high in zip(spot, share, extent[:2], extent[2:], strict=True)
        )
        return Shape(moved(contour, (left, below), scale), colour)


def plot_sheet(
    plot: Plot,
    curves: Curves,
    notation: Notation,
    words: Phrases,
    width: float | None,
    alt: str,
    letters: Letters = letters_of,
) -> Sheet:
    """Return the panels side by side; `width` is the width of one panel."""
    wide = (width or PANEL) * CM
    panels = [
        panel_of(plot, curve, curves, notation, words, letter)
        for letter, curve in zip(panel_letters(curves), curves.curves, strict=True)
    ]
    writing = Writing(letters({text for panel in panels for text in panel.texts()}))
    room = _room(panels, writing)
    widest = max((writing.size(panel.numbers, 1.0)[0] for panel in panels if panel.numbers), default=1.0)
    size = min(SMALLER, (wide - 2 * EDGE) / widest)  # the numbers above all panels have the same size
    across, usual = wide - room[0] - room[2], wide * TALL / PANEL - room[1] - room[3]
    heights = [usual if panel.shape is None else across * panel.shape for panel in panels]
    tall = max(heights) + room[1] + room[3]
    shapes: list[Shape] = []
    for i, (panel, height) in enumerate(zip(panels, heights, strict=True)):
        paper = i * wide + room[0], room[1], (i + 1) * wide - room[2], room[1] + height
        shapes += _drawn(panel, Frame(paper, panel.values), writing, (i * wide, (i + 1) * wide), size)
    return sheet_of_shapes(shapes, (0.0, 0.0, wide * len(panels), tall), alt)


# --- contents of a panel ---------------------------------------------------------------------------------------------


def panel_of(plot: Plot, curve: Curve, curves: Curves, notation: Notation, words: Phrases, letter: str = "") -> Panel:
    """Return the panel of one curve; the axes leave room for the words below a minimum and above a maximum."""
    if curve.path:
        return path_panel(plot, curve, notation, letter)
    if curve.portrait:
        return portrait_panel(plot, curve, curve.portrait, curves, notation, letter)
    points = values_along(curve.expr, curve.variable, curve.lower, curve.upper, STEPS)
    low, high = min(y for _, y in points), max(y for _, y in points)
    room = ROOM * ((high - low) or abs(high) or 1.0)
    start, end = curve.lower * curves.per_unit, curve.upper * curves.per_unit
    wide, tall = (0 if curves.unit == DEGREES else _power(start, end)), _power(low, high)
    return Panel(
        points=tuple((x * curves.per_unit, y) for x, y in points),
        values=(start, low - room, end, high + room),
        across=_scaled_ticks(wide, start, end, MOST_ACROSS, curves.unit == DEGREES),
        up=_scaled_ticks(tall, low, high, MOST_UP, room=room),
        names=(
            _axis_name(plot.variable, curves.unit, notation, wide),
            _axis_name(plot.label, plot.unit_up, notation, tall),
        ),
        turns=tuple(
            (
                (each.at * curves.per_unit, each.value),
                each.kind == MINIMUM,
                _names_of(words.drawings[each.kind], _mathtext_of_value(told_value(plot, each))),
            )
            for each in curve.marked
        ),
        numbers=_title(letter, _numbers(curve, notation) if curve.numbers else ""),
    )


def path_panel(plot: Plot, curve: Curve, notation: Notation, letter: str = "") -> Panel:
    """Return the panel of a path."""
    assert plot.across is not None
    (left, right), (low, high) = (_with_margin(min(part), max(part)) for part in zip(*curve.path, strict=True))
    shape = None
    if plot.across.unit == plot.unit_up:
        wide, tall = right - left, high - low
        shape = max(FLATTEST, min(tall / wide, STEEPEST))
        left, right = _widened(left, right, max(wide, tall / shape))
        low, high = _widened(low, high, max(tall, wide * shape))
    return Panel(
        points=curve.path,
        values=(left, low, right, high),
        across=_ticks(left, right, MOST_ACROSS),
        up=_ticks(low, high, MOST_UP if shape is None or shape > 2 * FLATTEST else MOST_UP - 1),
        names=(
            _axis_name(plot.across.label, plot.across.unit, notation),
            _axis_name(plot.label, plot.unit_up, notation),
        ),
        turns=(),
        numbers=_title(letter, _numbers(curve, notation) if curve.numbers else ""),
        is_path=True,
        shape=shape,
    )


def portrait_panel(
    plot: Plot, curve: Curve, portrait: Portrait, curves: Curves, notation: Notation, letter: str
) -> Panel:
    """Return the panel of a phase portrait, whose axes end with the ranges."""
    start, end = curve.lower * curves.per_unit, curve.upper * curves.per_unit
    return Panel(
        points=(),
        values=(start, portrait.low, end, portrait.high),
        across=_ticks(start, end, MOST_ACROSS, curves.unit == DEGREES),
        up=_ticks(portrait.low, portrait.high, MOST_UP),
        names=(
            _axis_name(plot.variable, curves.unit, notation),
            _axis_name(plot.label, plot.unit_up, notation),
        ),
        turns=(),
        numbers=_title(letter, _numbers(curve, notation) if curve.numbers else ""),
        shape=PORTRAIT,
        lines=tuple(
            replace(line, points=tuple((x * curves.per_unit, y) for x, y in line.points)) for line in portrait.lines
        ),
    )


def _with_margin(low: float, high: float) -> tuple[float, float]:
    room = MARGIN * ((high - low) or abs(high) or 1.0)
    return low - room, high + room


def _widened(low: float, high: float, size: float) -> tuple[float, float]:
    """Return a range of this size with the same middle."""
    middle = (low + high) / 2
    return middle - size / 2, middle + size / 2


def _names_of(kind: str, value: str) -> tuple[str, str]:
    """Return the names of an extremum, with and without its kind."""
    return rf"$\mathrm{{{kind}}}\;\;{value}$", f"${value}$"


def _power(low: float, high: float) -> int:
    """Return the power of ten by which the numbers of an axis are divided; 0 for numbers of a usual size."""
    greatest = max(abs(low), abs(high))
    power = floor(log10(greatest)) if greatest > 0 else 0
    return 0 if USUAL[0] <= power <= USUAL[1] else power


def _scaled_ticks(power: int, low: float, high: float, most: int, in_degrees: bool = False, room: float = 0.0) -> Ticks:
    """Return the ticks with numbers that are divided by a power of ten."""
    if not power:
        return _ticks(low, high, most, in_degrees, room)
    unit = 10.0**power
    return tuple((at * unit, text) for at, text in _ticks(low / unit, high / unit, most, in_degrees, room / unit))


def _title(letter: str, numbers: str) -> str:
    """Return the text above a panel: the letter of the panel, if there are several, and the numbers."""
    if not letter:
        return numbers
    return f"$({{\\mathrm{{{letter}}}}})\\;\\;{numbers.strip('$')}$"


def _ticks(low: float, high: float, most: int, in_degrees: bool = False, room: float = 0.0) -> Ticks:
    """Return round numbers with the same number of decimals; degrees in steps of 5, 10, 15, 30, 45, 90, 180 or 360.

    They have at most `most` intervals between the ends of the range. If there is room, the numbers continue beyond both
    ends of the range, so that each end lies between two numbers.
    """
    span = high - low or abs(high) or 1.0
    tens = 10.0 ** floor(log10(span))
    steps = (
        (5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0)
        if in_degrees and span >= 20
        else [tens * k for k in (0.1, 0.2, 0.5, 1, 2, 5)]
    )
    step = next((step for step in steps if span / step <= most), steps[-1])
    first = max(floor(low / step + 1e-9), ceil((low - room) / step - 1e-9))
    last = min(ceil(high / step - 1e-9), floor((high + room) / step + 1e-9))
    decimals = max(0, -floor(log10(step) + 1e-9))
    return tuple((step * k, f"${step * k:.{decimals}f}$") for k in range(first, last + 1))


def _axis_name(symbol: Any, unit: str, notation: Notation, power: int = 0) -> str:
    """Return the name of an axis, a quantity divided by its unit, and by a power of ten if there is one: `U / J`,
    `U / (10^33 J)`."""
    name = _mathtext(notation.layout(symbol))
    parts = [*([f"10^{{{power}}}"] if power else []), *([_mathtext_of_unit(unit)] if unit else [])]
    divisor = rf"({parts[0]}\,{parts[1]})" if len(parts) > 1 else "".join(parts)
    over = rf"\,/\,{divisor}" if divisor else ""
    return f"${name}{over}$"


def _numbers(curve: Curve, notation: Notation) -> str:
    items = []
    for measured in curve.numbers:
        amount = Amount(measured.number, measured.unit, measured.factor)
        items.append(rf"{_mathtext(notation.layout(measured.symbol))} = {_mathtext(notation.layout(amount))}")
    return "$" + r",\;\; ".join(items) + "$"


def _mathtext(layout: Any) -> str:
    return "".join(run.text.strip("$") for run in runs(layout))


def _mathtext_of_value(told: str) -> str:
    """Return a value such as `2.205 J` as mathtext: the number, a space, and the unit upright."""
    number, _, unit = told.replace("\u2212", "{-}").partition(" ")  # in braces, so that no space follows the sign
    return rf"{number}\,{unit_latex(unit)}" if unit else number


def _mathtext_of_unit(unit: str) -> str:
    return r"{}^{\circ}" if unit == DEGREES else unit_latex(unit)


# --- positions on paper ----------------------------------------------------------------------------------------------


def _room(panels: Sequence[Panel], writing: Writing) -> Extent:
    """Return the distances from the edges of every panel to its axes: left, below, right, above."""
    across = [writing.size(text, SMALL) for panel in panels for _, text in panel.across]
    up = [writing.size(text, SMALL) for panel in panels for _, text in panel.up]
    names = [[writing.size(panel.names[k], SMALL)[1] for panel in panels] for k in (0, 1)]
    numbers = [writing.size(panel.numbers, SMALLER)[1] + PAD for panel in panels if panel.numbers]
    wide, high = max((w for w, _ in up), default=0.0), max((h for _, h in across), default=0.0)
    return (
        EDGE + max(names[1]) + PAD + wide + TICK,
        EDGE + max(names[0]) + PAD + high + TICK,
        EDGE + max((w for w, _ in across), default=0.0) / 2,
        EDGE + max(numbers, default=0.0),
    )


def _drawn(panel: Panel, frame: Frame, writing: Writing, ends: Spot, size: float) -> Iterator[Shape]:
    """Yield all shapes of a panel with left and right edges `ends`; `size` scales the numbers above the panel."""
    left, below, right, above = frame.paper
    yield from shapes_of(list(_pieces(panel, frame)))
    for x, text in panel.across:
        yield writing.at((frame.spot((x, 0.0))[0], below - TICK), text, SMALL, (0.5, 1.0))
    for y, text in panel.up:
        yield writing.at((left - TICK, frame.spot((0.0, y))[1]), text, SMALL, (1.0, 0.5))
    across, up = panel.names
    lowest = below - TICK - max((writing.size(text, SMALL)[1] for _, text in panel.across), default=0.0) - PAD
    leftmost = left - TICK - max((writing.size(text, SMALL)[0] for _, text in panel.up), default=0.0) - PAD
    yield writing.at(((left + right) / 2, lowest), across, SMALL, (0.5, 1.0))
    yield writing.at((leftmost, (below + above) / 2), up, SMALL, (1.0, 0.5), upwards=True)
    for middle, y, name, is_lowest in _names_with_room(panel, frame, writing):
        yield writing.at((middle, y), name, SMALLEST, (0.5, float(is_lowest)))
    if panel.numbers:
        half = EDGE + writing.size(panel.numbers, size)[0] / 2
        middle = max(ends[0] + half, min((left + right) / 2, ends[1] - half))
        yield writing.at((middle, above + PAD), panel.numbers, size, (0.5, 0.0), QUIET)


def _names_with_room(panel: Panel, frame: Frame, writing: Writing) -> list[tuple[float, float, str, bool]]:
    """Return the name of each extremum with its position in the panel: x of its middle, and y of its edge next to the
    dot. Also return whether the extremum is a minimum.

    If a name would cover another, all names are without the words. If this does not help, there are no names; the
    caption has the values of all extrema.
    """
    for k in (0, 1):
        found = [_beside_dot(*turn[:2], turn[2][k], frame, writing) for turn in panel.turns]
        if not any(_overlap(one, other) for (_, one), (_, other) in combinations(found, 2)):
            return [each for each, _ in found]
    return []


def _beside_dot(
    place: Spot, is_lowest: bool, name: str, frame: Frame, writing: Writing
) -> tuple[tuple[float, float, str, bool], Extent]:
    """Return the name of an extremum with its position, clear of the ticks of the axis on the left, and its box."""
    left, _, right, _ = frame.paper
    x, y = frame.spot(place)
    wide, high = writing.size(name, SMALLEST)
    middle = max(left + TICK + PAD + wide / 2, min(x, right - PAD - wide / 2))
    edge = y - PAD - DOT if is_lowest else y + PAD + DOT
    box = middle - wide / 2, edge - high * is_lowest, middle + wide / 2, edge + high * (not is_lowest)
    return (middle, edge, name, is_lowest), box


def _overlap(one: Extent, other: Extent) -> bool:
    return all(one[k] < other[k + 2] + PAD and other[k] < one[k + 2] + PAD for k in (0, 1))


def line_of(panel: Panel, frame: Frame) -> Iterator[Piece]:
    """Yield the curve; a path has an arrowhead, and dots at its start and at its end."""
    for line in panel.lines:
        spots, pen = tuple(map(frame.spot, line.points)), "separatrix" if line.is_thick else "level"
        yield Stroke(spots, pen)
        yield Stroke(spots[line.head - 1 : line.head + 1], pen, head=True)
    if not panel.points:
        return
    spots = tuple(map(frame.spot, panel.points))
    yield Stroke(spots, "curve")
    if panel.is_path:
        at = _index_of(HEAD, spots)
        yield Stroke(spots[at - 1 : at + 1], "curve", head=True)
        yield Bullet(spots[0], DOT, "ink")
        yield Bullet(spots[-1], DOT, "ink")


def _index_of(part: float, spots: Sequence[Spot]) -> int:
    """Return the index, at least 1, of the point after this part of the length of a line."""
    lengths = [*accumulate((dist(one, other) for one, other in pairwise(spots)), initial=0.0)]
    return max(1, bisect_left(lengths, lengths[-1] * part))


def _pieces(panel: Panel, frame: Frame) -> Iterator[Piece]:
    left, below, right, above = frame.paper
    yield from line_of(panel, frame)
    yield Stroke(((left, above), (left, below), (right, below)), "frame")
    for x, _ in panel.across:
        at = frame.spot((x, 0.0))[0]
        yield Stroke(((at, below), (at, below + TICK)), "tick")
    for y, _ in panel.up:
        at = frame.spot((0.0, y))[1]
        yield Stroke(((left, at), (left + TICK, at)), "tick")
    for place, is_lowest, _ in panel.turns:
        yield Bullet(frame.spot(place), DOT, "ink")
        if not is_lowest:
            yield Bullet(frame.spot(place), 0.64 * DOT, "blank")
