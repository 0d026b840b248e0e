"""A plot as files: a panel for each curve, or one for all curves, with a quantity and a unit at each axis.

A path has dots at its start and at its end and an arrowhead in the direction of the motion. If both quantities of a
path have the same unit, both axes have the same scale.

Several curves in one panel have different line styles, and the name of each curve is next to it. If a name has no clear
place, all names are in a legend.

Numbers and names have the font of the page. A dashed line leads from an extremum to the horizontal axis.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, groupby, pairwise
from math import dist

from derive.figures.marks import Plot
from derive.figures.pieces import Bullet, Piece, Stroke
from derive.figures.space import Spot
from derive.page.plots import Curves, panel_letters
from derive.render.drawing.canvas import LINE, QUIET, shapes_of
from derive.render.drawing.curve_names import (
    beside_curves,
    corner_for,
    dots_of,
    is_clear,
    is_inside,
    is_within,
    on_curve,
    rows_of,
)
from derive.render.drawing.lettering import Lettered, Letters, letters_of
from derive.render.drawing.panels import Mark, Panel, Ticks, Turn, panel_of
from derive.render.drawing.sheets import Extent, Shape, Sheet, moved, sheet_of_shapes, turned
from derive.render.notation.notation import Notation

PANEL, TALL = 7.5, 5.0  # centimetres: the usual width and height of a panel
WIDEST = 16.5  # centimetres: the greatest width of all panels together, if no width is given
# centimetres: the greatest height of axes whose shape is fixed, as for a path, if the width of the panel is not given
TALLEST = 6.5
CM = 72 / 2.54
SMALL, SMALLER, SMALLEST = 1.0, 0.95, 0.9  # font scales: at the axes, above a panel, at curves and extrema
TICK = 3.5  # in points: the length of a tick, and the distance from a tick to its number
PAD = 4.0  # in points: from the name of an axis to its numbers, and from the name of an extremum to its dot
EDGE = 3.0  # in points: the margin around everything
HEAD = 0.35  # part of the length of a path before its arrowhead; not 0.5, because a path may then be back at its start
DOT = 2.2  # in points: the radius of a dot, for example at an extremum
AROUND = 46.0  # in points: the usual height of everything below and above the axes of a panel
LETTER = 10.0  # in points: a name of a vertical axis is turned if it is wider than this
ROW = 17.0  # in points: the height of a row of numbers above a panel, with the margin
SPACE = 7.0  # in points: the distance between two numbers above a panel
SAMPLE, BETWEEN = 22.0, 14.0  # in points: the line in a legend, and the distance between the entries of a legend
PENS_OF_CURVES = ("curve", "dashed_curve", "dotted_curve", "chained_curve")


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

    def spots(self, places: Sequence[Spot]) -> tuple[Spot, ...]:
        return tuple(map(self.spot, places))


@dataclass(frozen=True)
class Writing:
    """Places texts on paper as shapes."""

    known: Mapping[str, Lettered]

    def size(self, text: str, scale: float) -> tuple[float, float]:
        left, below, right, above = self.known[text][1]
        return scale * (right - left), scale * (above - below)

    def at(self, spot: Spot, text: str, scale: float, share: Spot, colour: str = LINE, upwards: bool = False) -> Shape:
        """Place a text at a point. Of the width and the height of the text, `share` gives the fractions to the left of
        the point and below it."""
        contour, extent = self.known[text]
        if upwards:
            contour, extent = turned(contour), (-extent[3], extent[0], -extent[1], extent[2])
        left, below = (
            at - scale * (low + part * (high - low))
            for at, part, low, high in zip(spot, share, extent[:2], extent[2:], strict=True)
        )
        return Shape(moved(contour, (left, below), scale), colour)

    def on(self, spot: Spot, text: str, scale: float, colour: str) -> Shape:
        """Place a text that begins at a point of its base line."""
        contour, extent = self.known[text]
        return Shape(moved(contour, (spot[0] - scale * extent[0], spot[1]), scale), colour)


def plot_sheet(
    plot: Plot,
    curves: Curves,
    notation: Notation,
    width: float | None,
    alt: str,
    letters: Letters = letters_of,
) -> Sheet:
    """Return the panels side by side; `width` is the width of one panel in centimetres, or None for the usual width."""
    wide = (width or min(PANEL, WIDEST / len(curves.panels))) * CM
    height = wide * TALL / PANEL - AROUND
    panels = [
        panel_of(plot, own, curves, notation, letter, height)
        for letter, own in zip(panel_letters(curves), curves.panels, strict=True)
    ]
    writing = Writing(letters({text for panel in panels for text in panel.texts()}))
    room = _room(panels, writing, wide)
    if width is None and (steepest := max((panel.shape for panel in panels if panel.shape), default=0.0)):
        wide = min(wide, room[0] + room[2] + TALLEST * CM / steepest)
        room = _room(panels, writing, wide)
    across, usual = wide - room[0] - room[2], wide * TALL / PANEL - room[1] - min(room[3], ROW)
    heights = [usual if panel.shape is None else across * panel.shape for panel in panels]
    shapes: list[Shape] = []
    tallest = max(heights) + room[1] + room[3]
    for i, (panel, height) in enumerate(zip(panels, heights, strict=True)):
        paper = i * wide + room[0], room[1], (i + 1) * wide - room[2], room[1] + height
        frame = Frame(paper, panel.values)
        names = _names(panel, frame, writing)
        shapes += _drawn(panel, frame, writing, names, (i * wide, (i + 1) * wide))
        middle, half = _middle_of_name(panel, frame, writing), _name_upwards(panel, writing)[1] / 2
        tallest = max(tallest, names.above + EDGE, middle + half + EDGE)
    return sheet_of_shapes(shapes, (0.0, 0.0, wide * len(panels), tallest), alt)


def _room(panels: Sequence[Panel], writing: Writing, width: float) -> Extent:
    """Return the distances from the edges of every panel of this width to its axes: left, below, right, above."""
    across = [writing.size(text, SMALL) for panel in panels for _, text in panel.across]
    up = [writing.size(text, SMALL) for panel in panels for _, text in panel.up]
    name_across = max(writing.size(panel.names[0], SMALL)[1] for panel in panels)
    name_up = max(_name_upwards(panel, writing)[0] + _pad(panel.names[1], writing) for panel in panels)
    numbers = [sum(high for _, _, high in _title(panel, writing, width)) for panel in panels]
    wide, high = max((w for w, _ in up), default=0.0), max((h for _, h in across), default=0.0)
    highest = max((h for _, h in up), default=0.0) / 2  # half the height of a number at the upper end of an axis
    return (
        EDGE + name_up + wide + TICK,
        EDGE + name_across + PAD + high + TICK,
        EDGE + max((w for w, _ in across), default=0.0) / 2,
        EDGE + max([*numbers, highest]),
    )


def _title(panel: Panel, writing: Writing, width: float) -> list[tuple[tuple[str, ...], float, float]]:
    """Return the rows of the text above a panel: the items, their scale and the height of the row."""
    room = width - 2 * EDGE
    sizes = [writing.size(text, SMALLER) for text in panel.numbers]
    high = max((high for _, high in sizes), default=0.0) + PAD
    found = []
    for row in rows_of([wide + SPACE for wide, _ in sizes], room + SPACE):
        wide = _width_of_row([sizes[i][0] for i in row])
        found.append((tuple(panel.numbers[i] for i in row), SMALLER * min(1.0, room / wide), high))
    return found


def _width_of_row(widths: Sequence[float]) -> float:
    return sum(widths) + SPACE * (len(widths) - 1)


def _drawn(panel: Panel, frame: Frame, writing: Writing, names: Names, ends: Spot) -> Iterator[Shape]:
    left, below, right, above = frame.paper
    yield from shapes_of(list(_pieces(panel, frame, names.gaps)))
    yield from shapes_of([piece for turn in panel.turns for piece in _dot(turn, frame, panel.has_open)])
    yield from names.turns
    yield from names.curves
    for place, _ in panel.points:
        yield from shapes_of([Bullet(frame.spot(place), DOT, "ink")])
    yield from names.points
    for x, text in _apart(panel.across, frame, writing):
        yield writing.at((frame.spot((x, 0.0))[0], below - TICK), text, SMALL, (0.5, 1.0))
    for y, text in panel.up:
        yield writing.at((left - TICK, frame.spot((0.0, y))[1]), text, SMALL, (1.0, 0.5))
    across, up = panel.names
    lowest = below - TICK - max((writing.size(text, SMALL)[1] for _, text in panel.across), default=0.0) - PAD
    numbers = max((writing.size(text, SMALL)[0] for _, text in panel.up), default=0.0)
    leftmost = left - TICK - numbers - _pad(up, writing)
    yield writing.at(((left + right) / 2, lowest), across, SMALL, (0.5, 1.0))
    yield writing.at(
        (leftmost, _middle_of_name(panel, frame, writing)), up, SMALL, (1.0, 0.5), upwards=_is_turned(up, writing)
    )
    base = above + PAD
    for texts, scale, high in reversed(_title(panel, writing, ends[1] - ends[0])):
        widths = [writing.size(text, scale)[0] for text in texts]
        half = EDGE + _width_of_row(widths) / 2
        x = max(ends[0] + half, min((left + right) / 2, ends[1] - half)) - half + EDGE
        for text, wide in zip(texts, widths, strict=True):
            yield writing.on((x, base), text, scale, QUIET)
            x += wide + SPACE
        base += high


def _middle_of_name(panel: Panel, frame: Frame, writing: Writing) -> float:
    """Return the height of the middle of the name of the vertical axis."""
    _, below, _, above = frame.paper
    return max((below + above) / 2, EDGE + _name_upwards(panel, writing)[1] / 2)


def _name_upwards(panel: Panel, writing: Writing) -> Spot:
    """Return the width and the height of the name of the vertical axis on paper."""
    wide, high = writing.size(panel.names[1], SMALL)
    return (high, wide) if _is_turned(panel.names[1], writing) else (wide, high)


def _pad(name: str, writing: Writing) -> float:
    """Return the distance from the name of a vertical axis to its numbers. A letter that is not turned is farther away,
    so that `n` and the number 2 are not read as a product."""
    return PAD if _is_turned(name, writing) else 3 * PAD


def _is_turned(name: str, writing: Writing) -> bool:
    """Whether the name of a vertical axis is turned on its side; a single letter is not."""
    return writing.size(name, SMALL)[0] > LETTER


def _apart(ticks: Ticks, frame: Frame, writing: Writing) -> Ticks:
    """Return the numbers of the horizontal axis, or only every second one if they would touch."""
    ends = [(frame.spot((x, 0.0))[0], writing.size(text, SMALL)[0] / 2) for x, text in ticks]
    touch = any(x + half + PAD > u - other for (x, half), (u, other) in pairwise(ends))
    nought = min(range(len(ticks)), key=lambda i: abs(ticks[i][0]), default=0)
    return ticks[nought % 2 :: 2] if touch else ticks


@dataclass(frozen=True)
class Names:
    """The names of the curves of a panel and of their extrema.

    curves   the names of several curves, as shapes
    turns    the names of extrema
    above    the height of the upper end of a legend above the panel; 0 without such a legend
    points   the values at zeros and at points at which two curves meet
    gaps     the gaps for names in the curves of a phase portrait: the index of the curve, and the box
    """

    curves: tuple[Shape, ...]
    turns: tuple[Shape, ...] = ()
    above: float = 0.0
    points: tuple[Shape, ...] = ()
    gaps: tuple[tuple[int, Extent], ...] = ()


def _names(panel: Panel, frame: Frame, writing: Writing) -> Names:
    """Return the names in a panel. The names of several curves are next to the curves or in a legend."""
    if panel.branches:
        return _names_of_branches(panel, frame, writing)
    if panel.lines:
        return _names_of_levels(panel, frame, writing)
    if not panel.has_several:
        turns = _names_of_turns(panel, frame, writing, ())
        points = _names_of_points(panel, frame, writing, [box for _, box in turns])
        return Names((), tuple(shape for shape, _ in turns), points=tuple(shape for shape, _ in points))
    known = list(_names_of_points(panel, frame, writing, ()))
    named = _names_of_curves(panel, frame, writing, [box for _, box in known])
    return replace(named, points=tuple(shape for shape, _ in known))


def _names_of_points(
    panel: Panel, frame: Frame, writing: Writing, taken: Sequence[Extent]
) -> Iterator[tuple[Shape, Extent]]:
    """Yield the label of each marked zero or meeting point, and its box. A label without a clear place is left out."""
    left, below, right, above = frame.paper
    inner = left + TICK, below + TICK, right, above
    dots = [dot for trace in panel.traces for dot in dots_of(frame.spots(trace.points))]
    dots += _dots_of_thin_lines(panel, frame)
    used = list(taken)
    for place, name in panel.points:
        if not name:
            continue
        wide, high = writing.size(name, SMALLEST)
        x, y = frame.spot(place)
        shifted = [(x + dx, y + dy) for dy in (0.0, -8.0, 8.0, -16.0, 16.0) for dx in (0.0, 6.0, -6.0, -14.0, 14.0)]
        tried = (box for spot in shifted for box in _around(spot, (wide, high)))
        box = next((box for box in tried if is_inside(box, inner) and is_clear(box, dots, used)), None)
        if box is not None:
            used.append(box)
            yield writing.at(box[:2], name, SMALLEST, (0.0, 0.0)), box


def _names_of_curves(panel: Panel, frame: Frame, writing: Writing, points: Sequence[Extent]) -> Names:
    """Return the names of several curves and of their extrema, which do not cover the labels of marked points."""
    lines = [dots_of(frame.spots(trace.points)) for trace in panel.traces]
    sizes = [writing.size(trace.name, SMALLEST) for trace in panel.traces]
    left, below, right, above = frame.paper
    inner = left + TICK + PAD, below + TICK + PAD, right, above
    others = [dot for line in panel.outlines for dot in dots_of(frame.spots(line))]
    others += _dots_of_thin_lines(panel, frame)
    turns = _names_of_turns(panel, frame, writing, points)
    boxes = beside_curves(lines, sizes, inner, [*(box for _, box in turns), *points], others)
    if boxes is None and (boxes := beside_curves(lines, sizes, inner, points, others)):
        turns = _names_of_turns(panel, frame, writing, [*boxes, *points])
    named = tuple(shape for shape, _ in turns)
    if boxes:
        every = zip(panel.traces, boxes, strict=True)
        shapes = [writing.at(box[:2], trace.name, SMALLEST, (0.0, 0.0)) for trace, box in every]
        return Names(tuple(shapes), named)
    size = _size_of_legend(sizes)
    dots = [dot for line in (*lines, others) for dot in line]
    box = corner_for(size, dots, [*(box for _, box in turns), *points], frame.paper)
    if box:
        legend = _legend(panel, writing, sizes, [[i] for i in _from_the_top(panel)], (box[0], box[3]))
        return Names(tuple(legend), named)
    rows = rows_of([SAMPLE + PAD + wide + BETWEEN for wide, _ in sizes], right - left)
    top = above + PAD + size[1] / len(sizes) * len(rows)
    return Names(tuple(_legend(panel, writing, sizes, rows, (left, top))), named, top)


def _from_the_top(panel: Panel) -> list[int]:
    """Return the indices of the curves, from the greatest to the least mean height."""
    heights = [sum(y for _, y in trace.points) / len(trace.points) for trace in panel.traces]
    return sorted(range(len(heights)), key=lambda i: -heights[i])


def _names_of_branches(panel: Panel, frame: Frame, writing: Writing) -> Names:
    """Return the names of the branches of a diagram and the values of the parameter at the bifurcations. A name without
    a clear place is left out."""
    lines = [[dot for part in parts for dot in dots_of(frame.spots(part.points))] for _, parts in panel.branches]
    below = frame.paper[1]
    guides = [frame.spots(_guide(change, frame)) for change in panel.changes]
    around = [dot for guide in guides for dot in dots_of(guide)]
    shapes: list[Shape] = []
    taken: list[Extent] = []
    for change, guide in zip(panel.changes, guides, strict=True):
        size = writing.size(change.name, SMALLEST)
        every = [dot for line in (*lines, around) for dot in line]
        tried = (*_around(guide[1], size), *_around((guide[0][0], below + TICK + size[1]), size))
        box = next((box for box in tried if is_inside(box, frame.paper) and is_clear(box, every, taken)), None)
        if box is not None:
            taken.append(box)
            shapes.append(writing.at(box[:2], change.name, SMALLEST, (0.0, 0.0)))
    left, _, right, above = frame.paper
    inner = left + TICK + PAD, below + TICK + PAD, right, above
    for i, (name, _) in enumerate(panel.branches):
        others = [dot for k, line in enumerate(lines) if k != i for dot in line]
        found = beside_curves([lines[i]], [writing.size(name, SMALLEST)], inner, taken, [*others, *around])
        if found is not None:
            taken.append(found[0])
            shapes.append(writing.at(found[0][:2], name, SMALLEST, (0.0, 0.0)))
    return Names(tuple(shapes))


def _names_of_levels(panel: Panel, frame: Frame, writing: Writing) -> Names:
    """Return the values on the curves of a phase portrait and the names of the points of stable equilibrium. A value
    without a clear place is left out."""
    turns = _names_of_turns(panel, frame, writing, ())
    taken = [box for _, box in turns]
    lines = [dots_of(frame.spots(line.points)) for line in panel.lines]
    left, below, right, above = frame.paper
    inner = left + TICK + PAD, below + TICK + PAD, right, above
    shapes: list[Shape] = []
    gaps: list[tuple[int, Extent]] = []
    for i, name in enumerate(panel.levels):
        own = [k for k, line in enumerate(panel.lines) if line.of == i]
        if own:
            longest = max(own, key=lambda k: len(lines[k]))
            others = [dot for k, line in enumerate(lines) if k != longest for dot in line]
            others += _dots_of_thin_lines(panel, frame)
            others += [frame.spots(panel.lines[longest].points)[at] for at in panel.lines[longest].heads]
            box = on_curve(lines[longest], writing.size(name, SMALLEST), inner, taken, others)
            if box is not None:
                taken.append(box)
                gaps.append((longest, box))
                shapes.append(writing.at(box[:2], name, SMALLEST, (0.0, 0.0)))
    return Names(tuple(shapes), tuple(shape for shape, _ in turns), gaps=tuple(gaps))


def _guide(change: Mark, frame: Frame) -> tuple[Spot, Spot]:
    highest = max(change.places, key=lambda place: place[1])
    return (highest[0], frame.values[1]), highest


def _around(spot: Spot, size: tuple[float, float]) -> Iterator[Extent]:
    (x, y), (wide, high) = spot, size
    gap = PAD + DOT
    for left, below in (
        (x + gap, y + gap),
        (x + gap, y - gap - high),
        (x - gap - wide, y + gap),
        (x - gap - wide, y - gap - high),
        (x - gap - wide, y - high / 2),
        (x + gap, y - high / 2),
    ):
        yield left, below, left + wide, below + high


def _size_of_legend(sizes: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Return the width and height of a legend with its entries below each other."""
    return SAMPLE + PAD + max(wide for wide, _ in sizes), len(sizes) * (PAD + max(high for _, high in sizes))


def _legend(
    panel: Panel,
    writing: Writing,
    sizes: Sequence[tuple[float, float]],
    rows: Sequence[Sequence[int]],
    corner: Spot,
) -> Iterator[Shape]:
    """Yield the lines and the names of a legend with this upper left corner."""
    high = _size_of_legend(sizes)[1] / len(sizes)
    for k, row in enumerate(rows):
        x, y = corner[0], corner[1] - high * (k + 0.5)
        for i in row:
            yield from shapes_of([Stroke(((x, y), (x + SAMPLE, y)), PENS_OF_CURVES[i % len(PENS_OF_CURVES)])])
            yield writing.at((x + SAMPLE + PAD, y), panel.traces[i].name, SMALLEST, (0.0, 0.5))
            x += SAMPLE + PAD + sizes[i][0] + BETWEEN


def _dot(turn: Turn, frame: Frame, has_open: bool) -> Iterator[Piece]:
    place, is_lowest, _ = turn
    yield Bullet(frame.spot(place), DOT, "ink")
    if has_open and not is_lowest:
        yield Bullet(frame.spot(place), 0.64 * DOT, "blank")


def _names_of_turns(
    panel: Panel, frame: Frame, writing: Writing, taken: Sequence[Extent]
) -> list[tuple[Shape, Extent]]:
    """Return the names of the extrema with their boxes. If not all names of a curve have room, the short
    names are used. If not all short names have room, the names of this curve are left out.

    taken   boxes of other names
    """
    left, below, right, above = frame.paper
    inner = left + TICK + PAD, below + TICK + PAD, right, above + PAD
    curves = (*(trace.points for trace in panel.traces), *(line.points for line in panel.lines))
    dots = [dot for points in curves for dot in dots_of(frame.spots(points))]
    dots += _dots_of_thin_lines(panel, frame)
    found: list[tuple[Shape, Extent]] = []
    for turns in (*(trace.turns for trace in panel.traces), *((rest,) for rest in panel.rests)):
        for form in (0, -1):
            own: list[tuple[Shape, Extent]] = []
            named = [(place, is_lowest, names[form]) for place, is_lowest, names in turns if names]
            for place, is_lowest, name in named:
                used = [*taken, *(box for _, box in (*found, *own))]
                tried = _beside_turn(frame.spot(place), is_lowest, writing.size(name, SMALLEST), frame.paper)
                box = next((box for box in tried if is_inside(box, inner) and is_clear(box, dots, used)), None)
                own += [(writing.at(box[:2], name, SMALLEST, (0.0, 0.0)), box)] if box else []
            if len(own) == len(named):
                found += own
                break
    return found


def _beside_turn(spot: Spot, is_lowest: bool, size: tuple[float, float], paper: Extent) -> Iterator[Extent]:
    (x, y), (wide, high) = spot, size
    above, below = y + PAD + DOT, y - PAD - DOT - high
    middle = max(paper[0] + TICK + PAD, min(x - wide / 2, paper[2] - wide))
    beside = (x + PAD, x - PAD - wide)
    at_axis = paper[1] + TICK + PAD
    if not is_lowest:
        yield middle, above, middle + wide, above + high
    for bottom in (below, at_axis):
        for left in beside:
            yield left, bottom, left + wide, bottom + high
    if is_lowest:
        yield middle, above, middle + wide, above + high


def _dots_of_thin_lines(panel: Panel, frame: Frame) -> list[Spot]:
    """Return points of the line at zero, of the lines at energies, and of the lines from the extrema to the horizontal
    axis."""
    lines = [frame.spots(line) for line in (*(_line_to_axis(turn, frame) for turn in panel.turns), *panel.heights)]
    if panel.is_signed:
        zero = frame.spot((0.0, 0.0))[1]
        lines.append(((frame.paper[0], zero), (frame.paper[2], zero)))
    if panel.is_signed_across:
        zero = frame.spot((0.0, 0.0))[0]
        lines.append(((zero, frame.paper[1]), (zero, frame.paper[3])))
    return [dot for line in lines for dot in dots_of(line)]


def _line_to_axis(turn: Turn, frame: Frame) -> tuple[Spot, Spot]:
    return turn[0], (turn[0][0], frame.values[1])


def line_of(panel: Panel, frame: Frame, gaps: Sequence[tuple[int, Extent]] = ()) -> Iterator[Piece]:
    """Yield the curves of a panel with their arrowheads and dots, and the outlines of surfaces. A path has an
    arrowhead, and dots at its start and at its end."""
    for i, line in enumerate(panel.lines):
        spots, pen = frame.spots(line.points), "separatrix" if line.is_thick else "level"
        yield from (Stroke(part, pen) for part in _parts(spots, [box for k, box in gaps if k == i]))
        for at in line.heads:
            yield Stroke(spots[at - 1 : at + 1], pen, head=True)
    for outline in panel.outlines:
        yield Stroke(frame.spots(outline), "edge")
    for change in panel.changes:
        yield Stroke(frame.spots(_guide(change, frame)), "hidden")
    for _, parts in panel.branches:
        for part in parts:
            yield Stroke(frame.spots(part.points), "curve" if part.is_stable else "dashed_curve")
    for change in panel.changes:
        for place in change.places:
            yield Bullet(frame.spot(place), DOT, "ink")
    for i, trace in enumerate(panel.traces):
        spots, pen = frame.spots(trace.points), PENS_OF_CURVES[i % len(PENS_OF_CURVES)]
        yield from (Stroke(part, pen) for part in _between(spots, frame.paper[1], frame.paper[3]))
        if panel.is_path:
            at = _index_of(HEAD, spots)
            yield Stroke(spots[at - 1 : at + 1], pen, head=True)
            yield Bullet(spots[0], DOT, "ink")
            yield Bullet(spots[-1], DOT, "ink")


def _between(spots: Sequence[Spot], low: float, high: float) -> Iterator[tuple[Spot, ...]]:
    """Yield the parts of a line between two heights."""
    cut: list[Spot] = [spots[0]]
    for (x, y), (u, v) in pairwise(spots):
        crossed = sorted((at for at in (low, high) if min(y, v) < at < max(y, v)), reverse=v < y)
        cut += [(x + (u - x) * (at - y) / (v - y), at) for at in crossed]
        cut.append((u, v))
    for is_drawn, part in groupby(cut, key=lambda spot: low <= spot[1] <= high):
        points = tuple(part)
        if is_drawn and len(points) > 1:
            yield points


def _parts(spots: Sequence[Spot], gaps: Sequence[Extent]) -> Iterator[tuple[Spot, ...]]:
    """Yield the parts of a line outside of these boxes."""
    for is_covered, part in groupby(spots, key=lambda spot: any(is_within(spot, box) for box in gaps)):
        points = tuple(part)
        if not is_covered and len(points) > 1:
            yield points


def _index_of(part: float, spots: Sequence[Spot]) -> int:
    """Return the index, at least 1, of the first point at or beyond the fraction `part` of the length of a line."""
    lengths = [*accumulate((dist(one, other) for one, other in pairwise(spots)), initial=0.0)]
    return max(1, bisect_left(lengths, lengths[-1] * part))


def _pieces(panel: Panel, frame: Frame, gaps: Sequence[tuple[int, Extent]]) -> Iterator[Piece]:
    left, below, right, above = frame.paper
    if panel.is_signed:
        zero = frame.spot((0.0, 0.0))[1]
        yield Stroke(((left, zero), (right, zero)), "thin")
    if panel.is_signed_across:
        zero = frame.spot((0.0, 0.0))[0]
        yield Stroke(((zero, below), (zero, above)), "thin")
    for turn in panel.turns:
        yield Stroke(frame.spots(_line_to_axis(turn, frame)), "hidden")
    for line in panel.heights:
        yield Stroke(frame.spots(line), "level")
    yield from line_of(panel, frame, gaps)
    yield Stroke(((left, above), (left, below), (right, below)), "frame")
    for x, _ in panel.across:
        at = frame.spot((x, 0.0))[0]
        yield Stroke(((at, below), (at, below + TICK)), "tick")
    for y, _ in panel.up:
        at = frame.spot((0.0, y))[1]
        yield Stroke(((left, at), (left + TICK, at)), "tick")
