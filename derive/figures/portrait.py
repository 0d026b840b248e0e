"""The curves of a phase portrait, on which a function H(q, p) is constant, with the direction of the motion.

Hamilton's equations give the direction: q increases where dH/dp is positive.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from mpmath import mp
from sympy import Expr, Symbol, diff, lambdify

from derive.errors import Complaint, Rejected

FAR = (1e5, 3e6, 7e7)  # distances that count as infinite, in units of the size of the horizontal axis
SAME = 1e-4  # values that differ by at most this fraction of the greatest absolute value count as equal
STEPS = 240  # number of steps of the grid in each direction
# Width of the margins at the left and the right, relative to the horizontal axis. An arrowhead is in a margin only if
# its whole curve is in the margins.
EDGE = 0.1


@dataclass(frozen=True)
class LevelLine:
    """A curve: its points in the order of the motion, the indices of the points with an arrowhead, whether the curve is
    thick, and the index of its value."""

    points: tuple[tuple[float, float], ...]
    heads: tuple[int, ...]
    is_thick: bool
    of: int = 0


@dataclass(frozen=True)
class Portrait:
    """A phase portrait: the range of its vertical axis, its values, its curves, and its centres, which are points of
    stable equilibrium."""

    low: float
    high: float
    values: tuple[tuple[float, bool], ...]
    lines: tuple[LevelLine, ...] = field(repr=False)
    centres: tuple[tuple[float, float], ...] = ()


def portrait_of(
    expr: Expr,
    plane: tuple[Symbol, Symbol],
    box: tuple[float, float, float, float],
    values: tuple[tuple[float, bool], ...],
) -> Portrait:
    """Return the curves on which the expression has these values.

    plane    the coordinate and the momentum
    box      the ends of the ranges of the coordinate and the momentum: left, right, below, above
    values   the values, each with `True` if its curves are thick, and `False` otherwise. The curves of the value that
             the function has at infinity separate bound motions from free ones; they are always thick
    """  # fmt: skip
    across, up = np.linspace(*box[:2], STEPS + 1), np.linspace(*box[2:], STEPS + 1)
    grid = np.meshgrid(across, up)
    heights = _on(expr, plane, *grid)
    rate = diff(expr, plane[1]), -diff(expr, plane[0])
    inner = box[0] + EDGE * (box[1] - box[0]), box[1] - EDGE * (box[1] - box[0])
    found: list[LevelLine] = []
    size = max(abs(value) for value, _ in values)
    values = tuple(
        (value, is_thick or _is_at_infinity(value, expr, plane, box[1] - box[0], size)) for value, is_thick in values
    )
    for i, (value, is_thick) in enumerate(values):
        own = [
            line
            for points in _contours(across, up, heights, value)
            for line in _along(points, rate, plane, inner, is_thick, i)
        ]
        if not own:
            ends = f"{np.min(heights):.4g} to {np.max(heights):.4g}"
            message = f"the phase portrait has no curve with the value {value:.4g}"
            raise Rejected(Complaint("drawing", message, help=f"the values in these ranges are from {ends}"))
        found += own
    return Portrait(*box[2:], values, tuple(found), tuple(_centres(expr, plane, grid, heights)))


def _is_at_infinity(value: float, expr: Expr, plane: tuple[Symbol, Symbol], wide: float, size: float) -> bool:
    """Whether the function tends to this value as the coordinate becomes infinite and the momentum vanishes.

    wide   the size of the horizontal axis
    size   the greatest absolute value of all levels
    """
    with np.errstate(all="ignore"):
        far = lambdify(plane, expr, "numpy")(wide * np.array(FAR), np.zeros(len(FAR))) + np.zeros(len(FAR))
    return bool(np.isrealobj(far) and np.all(np.abs(far - value) <= SAME * size))


def _centres(
    expr: Expr, plane: tuple[Symbol, Symbol], grid: Sequence[Any], heights: Any
) -> Iterator[tuple[float, float]]:
    inner, last = heights[1:-1, 1:-1], STEPS - 1
    around = [heights[1 + i : 1 + i + last, 1 + k : 1 + k + last] for i in (-1, 0, 1) for k in (-1, 0, 1) if i or k]
    is_extreme = np.all([inner < each for each in around], axis=0) | np.all([inner > each for each in around], axis=0)
    slope = [lambdify(plane, diff(expr, letter), "mpmath") for letter in plane]
    for row, column in np.argwhere(is_extreme) + 1:
        start = float(grid[0][row, column]), float(grid[1][row, column])
        x, y = mp.findroot(lambda x, y: [each(x, y) for each in slope], start)
        yield float(mp.chop(x)), float(mp.chop(y))


def _on(expr: Expr, plane: tuple[Symbol, Symbol], across: Any, up: Any) -> Any:
    with np.errstate(all="ignore"):
        found = lambdify(plane, expr, "numpy")(across, up) + 0.0 * across
    if not (np.isrealobj(found) and np.all(np.isfinite(found))):
        message = f"{expr} is not real and finite at every point of the plot"
        raise Rejected(Complaint("drawing", message))
    return found


def _contours(across: Any, up: Any, heights: Any, value: float) -> Sequence[Any]:
    from contourpy import contour_generator

    lines: Sequence[Any] = contour_generator(across, up, heights).lines(value)
    return lines


def lines_of(
    expr: Expr, plane: tuple[Symbol, Symbol], box: tuple[float, float, float, float]
) -> tuple[tuple[tuple[float, float], ...], ...]:
    """Return the lines in a box on which an expression vanishes; `box` is left, below, right, above."""
    across, up = np.linspace(box[0], box[2], STEPS + 1), np.linspace(box[1], box[3], STEPS + 1)
    heights = _on(expr, plane, *np.meshgrid(across, up))
    return tuple(tuple((float(x), float(y)) for x, y in line) for line in _contours(across, up, heights, 0.0))


def _along(
    points: Any,
    rate: tuple[Expr, Expr],
    plane: tuple[Symbol, Symbol],
    inner: tuple[float, float],
    is_thick: bool,
    of: int,
) -> Iterator[LevelLine]:
    """Yield the line in the order of the motion, with the places of its arrowheads."""
    flow = _on(rate[0], plane, *points.T), _on(rate[1], plane, *points.T)
    size = np.ptp(points, axis=0)
    if len(points) < 3 or not np.any(size):
        return
    at = _head(points[:, 0], flow[0], inner)
    along = points[at + 1] - points[at - 1]
    scale = np.where(size > 0, size, 1.0) ** 2
    is_forward = along[0] * flow[0][at] / scale[0] + along[1] * flow[1][at] / scale[1] >= 0
    heads = [at]
    if not np.array_equal(points[0], points[-1]):
        back = _head(points[:, 0], np.where(flow[0] * flow[0][at] < 0, flow[0], 0.0), inner)
        heads += [back] if flow[0][back] * flow[0][at] < 0 else []
    if not is_forward:
        points, heads = points[::-1], [len(points) - 1 - each for each in heads]
    yield LevelLine(tuple((float(x), float(y)) for x, y in points), tuple(heads), is_thick, of)


def _head(across: Any, rate: Any, inner: tuple[float, float]) -> int:
    """Return the index of the arrowhead: the point outside the margins at which the coordinate changes fastest, or the
    middle of the line if no point is outside the margins."""
    away = (across > inner[0]) & (across < inner[1])
    if not np.any(away):
        return len(across) // 2
    forward = np.where(away, rate, 0.0)
    at = np.argmax(forward) if np.max(forward) > -0.99 * np.min(forward) else np.argmin(forward)
    return min(max(int(at), 1), len(across) - 2)
