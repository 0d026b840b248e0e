"""The curves of a phase portrait, on which a function H(q, p) is constant, with the direction of the motion.

Hamilton's equations give the direction: q increases where dH/dp is positive.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from sympy import Expr, Symbol, diff, lambdify

from derive.errors import Complaint, Rejected

STEPS = 240  # number of steps of the grid in each direction
EDGE = 0.1  # width of a margin, relative to the horizontal axis; only a curve within a margin has an arrowhead there


@dataclass(frozen=True)
class LevelLine:
    """A curve: its points in the order of the motion, the index of the point with the arrowhead, and whether the curve
    is thick."""

    points: tuple[tuple[float, float], ...]
    head: int
    is_thick: bool


@dataclass(frozen=True)
class Portrait:
    """A phase portrait: the range of its vertical axis; the values, each with `True` if its curves are thick and
    `False` otherwise; and the curves of all values."""

    low: float
    high: float
    values: tuple[tuple[float, bool], ...]
    lines: tuple[LevelLine, ...] = field(repr=False)


def portrait_of(
    expr: Expr,
    plane: tuple[Symbol, Symbol],
    box: tuple[float, float, float, float],
    values: tuple[tuple[float, bool], ...],
) -> Portrait:
    """Return the curves on which the expression has these values.

    plane    the coordinate and the momentum
    box      the ends of the ranges of the coordinate and the momentum: left, right, below, above
    values   the values, each with `True` if its curves are thick, and `False` otherwise
    """  # fmt: skip
    across, up = np.linspace(*box[:2], STEPS + 1), np.linspace(*box[2:], STEPS + 1)
    grid = np.meshgrid(across, up)
    heights = _on(expr, plane, *grid)
    rate = diff(expr, plane[1]), -diff(expr, plane[0])
    inner = box[0] + EDGE * (box[1] - box[0]), box[1] - EDGE * (box[1] - box[0])
    found: list[LevelLine] = []
    for value, is_thick in values:
        own = [
            line
            for points in _contours(across, up, heights, value)
            for line in _along(points, rate, plane, inner, is_thick)
        ]
        if not own:
            ends = f"{np.min(heights):.4g} to {np.max(heights):.4g}"
            message = f"no point of the phase portrait has the value {value:.4g}"
            raise Rejected(Complaint("drawing", message, help=f"in these ranges, the values go from {ends}"))
        found += own
    return Portrait(*box[2:], values, tuple(found))


def _on(expr: Expr, plane: tuple[Symbol, Symbol], across: Any, up: Any) -> Any:
    """Return the values of the expression at these points."""
    with np.errstate(all="ignore"):
        found = lambdify(plane, expr, "numpy")(across, up) + 0.0 * across
    if not (np.isrealobj(found) and np.all(np.isfinite(found))):
        message = f"the phase portrait of {expr} is not real and finite over its whole range"
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
    points: Any, rate: tuple[Expr, Expr], plane: tuple[Symbol, Symbol], inner: tuple[float, float], is_thick: bool
) -> Iterator[LevelLine]:
    """Yield the line in the order of the motion, with the place of its arrowhead. A line of fewer than three points, or
    of equal points, is left out."""
    flow = _on(rate[0], plane, *points.T), _on(rate[1], plane, *points.T)
    size = np.ptp(points, axis=0)
    if len(points) < 3 or not np.any(size):
        return
    at = _head(points[:, 0], flow[0], inner)
    along = points[at + 1] - points[at - 1]
    scale = np.where(size > 0, size, 1.0) ** 2
    is_forward = along[0] * flow[0][at] / scale[0] + along[1] * flow[1][at] / scale[1] >= 0
    ordered, head = (points, at) if is_forward else (points[::-1], len(points) - 1 - at)
    yield LevelLine(tuple((float(x), float(y)) for x, y in ordered), head, is_thick)


def _head(across: Any, rate: Any, inner: tuple[float, float]) -> int:
    """Return the index of the arrowhead: where the coordinate changes fastest, among the points that are not in a
    margin. If all points of the curve are in the margins, the arrowhead is in the middle of the curve."""
    away = (across > inner[0]) & (across < inner[1])
    if not np.any(away):
        return len(across) // 2
    forward = np.where(away, rate, 0.0)
    at = np.argmax(forward) if np.max(forward) > -0.99 * np.min(forward) else np.argmin(forward)
    return min(max(int(at), 1), len(across) - 2)
