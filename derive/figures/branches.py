"""The branches of a bifurcation diagram: where each equilibrium exists, where it is stable, and where this changes.

The conditions of the solution decide where an equilibrium exists and where it is stable. A second route then uses the
potential energy alone, for a few values of the parameter between two changes. The slope of this energy must vanish at
the branches and nowhere else. The energy must have minima at the stable branches and nowhere else.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from math import ceil, cos, isfinite, pi
from typing import Any, TypeAlias

from mpmath import mp
from sympy import Expr, Rational, Symbol, diff, lambdify
from sympy import pi as exact_pi

from derive.algebra.relation import Relation
from derive.errors import Complaint, Rejected, Unverified
from derive.figures.marks import Branch, Diagram

STEPS = 160  # number of straight lines that draw a branch between two changes
GRID = 2000  # number of intervals of the parameter's range, and of the coordinate's range in the second route
HALVINGS = 80
TRIED = (0.11, 0.37, 0.68, 0.93)  # the second route is used at these fractions of an interval of the parameter
# z counts as real if |Im z| <= REAL (1 + |Re z|). If |y| is at most REAL times its maximum on a branch, y becomes zero.
REAL = 1e-6
CLOSE = 1e-5  # greatest difference of equal values, relative to their range; for angles, in radians
# The energy at an equilibrium is compared with the energies at the distance 10^-NEAR times the searched range on both
# sides, with DIGITS digits.
NEAR, DIGITS = 5, 40
SHRUNK = 1e-6  # at a zero, the slope is smaller than this fraction of the slope beside the zero; at a pole it is larger
# The second route also counts zeros below and above the vertical axis. Their distances from the lower and the upper end
# of the axis are at most these fractions of its length. If the problem does not state the ends of the axis, each
# fraction is increased by 1.
WIDENED = 0.0731, 0.0917
EDGE = 1e-5  # zeros closer to an end of the coordinate's range than this fraction of the vertical axis are not counted
FULL_TURN = 2 * exact_pi
OFFSET = 0.01234  # a grid of a full turn begins this fraction of a turn above -pi, because the slope may vanish at -pi

Spots: TypeAlias = tuple[tuple[float, float], ...]
State: TypeAlias = bool | None  # whether an equilibrium is stable; None if it does not exist
Function: TypeAlias = Callable[[float], float]


@dataclass(frozen=True)
class BranchLine:
    """A part of a branch on which the stability does not change; `of` is the index of the equilibrium."""

    of: int
    is_stable: bool
    points: Spots


@dataclass(frozen=True)
class Change:
    """A value of the parameter at which equilibria begin, end or change their stability, and the values of the
    coordinate there."""

    at: float
    places: tuple[float, ...]


@dataclass(frozen=True)
class Bifurcations:
    """The range of the vertical axis, the lines of all branches, and the changes."""

    low: float
    high: float
    lines: tuple[BranchLine, ...] = field(repr=False)
    changes: tuple[Change, ...]


def bifurcations_of(
    diagram: Diagram,
    parameter: Symbol,
    ends: tuple[float, float],
    numbers: Mapping[Any, Expr],
    axis: tuple[float, float] | None = None,
    is_angle: bool = False,
) -> Bifurcations:
    """Return the lines and the changes of a diagram for these numbers.

    Errors: `Rejected` if the diagram would show no equilibrium, no change, or an equilibrium far beyond the others;
    `Unverified` if the potential energy contradicts the branches.

    axis       the ends of the vertical axis; by default the axis has room for all equilibria
    is_angle   whether two values of the coordinate that differ by a full turn mean the same position
    """
    states = [_state(branch, parameter, numbers) for branch in diagram.branches]
    places = [_real(branch.place.xreplace(dict(numbers)), parameter) for branch in diagram.branches]
    borders = sorted({x for b in diagram.branches for c in b.conditions for x in _borders(c, parameter, ends, numbers)})
    cuts = [ends[0], *_apart(borders, ends[1] - ends[0]), ends[1]]
    spans = [(one, other, tuple(state((one + other) / 2) for state in states)) for one, other in pairwise(cuts)]
    whole = [line for i, place in enumerate(places) for line in _lines(i, place, spans)]
    low, high = axis or _extent(diagram, whole)
    lines = tuple(part for line in whole for part in _clipped(line, low, high))
    if not lines:
        raise Rejected(Complaint("drawing", "no equilibrium is within the axes of the diagram"))
    changes = tuple(
        change for left, right in pairwise(spans) if (change := _change(left, right, places, (low, high))) is not None
    )
    if not changes:
        span = f"for values of the parameter from {ends[0]:.4g} to {ends[1]:.4g}"
        message = f"within the axes of the diagram, no equilibrium begins, ends or changes its stability {span}"
        raise Rejected(
            Complaint("drawing", message, help="a diagram must show such a change: choose a different `range`")
        )
    _confirm(diagram, parameter, spans, places, numbers, _searched(diagram, low, high, axis is None), is_angle)
    return Bifurcations(low, high, lines, changes)


# --- conditions ------------------------------------------------------------------------------------------------------


def _state(branch: Branch, parameter: Symbol, numbers: Mapping[Any, Expr]) -> Callable[[float], State]:
    exists, stable = (_truth(each, parameter, numbers) for each in (branch.exists, branch.stable))
    return lambda x: stable(x) if exists(x) else None


def _truth(condition: Any, parameter: Symbol, numbers: Mapping[Any, Expr]) -> Callable[[float], bool]:
    if condition is None or isinstance(condition, bool):
        return lambda _: condition is not False
    residual = _real(condition.residual.xreplace(dict(numbers)), parameter)
    sign = 1 if condition.operator.startswith(">") else -1
    return lambda x: sign * residual(x) > 0


def _real(expr: Expr, parameter: Symbol) -> Function:
    """Return a function that evaluates the expression. Its value is NaN where the expression is not real."""
    of = lambdify([parameter], expr, "numpy")

    def value(x: float) -> float:
        import numpy as np

        with np.errstate(all="ignore"):
            found = complex(of(np.complex128(x)))
        return found.real if abs(found.imag) <= REAL * (1 + abs(found.real)) else float("nan")

    return value


def _borders(
    condition: Relation, parameter: Symbol, ends: tuple[float, float], numbers: Mapping[Any, Expr]
) -> Iterator[float]:
    residual = _real(condition.residual.xreplace(dict(numbers)), parameter)
    grid = [ends[0] + (ends[1] - ends[0]) * i / GRID for i in range(GRID + 1)]
    signed = [(x, value > 0) for x in grid if isfinite(value := residual(x)) and value]
    for (low, sign), (high, other) in pairwise(signed):
        if sign != other:
            yield _halved(partial(_has_sign, residual, sign), low, high)


def _has_sign(value: Function, is_positive: bool, x: float) -> bool:
    return (value(x) > 0) == is_positive


def _halved(is_left: Callable[[float], bool], low: float, high: float) -> float:
    """Return the number between `low` and `high` at which a statement ceases to be true."""
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if is_left(middle) else (low, middle)
    return (low + high) / 2


def _apart(borders: Sequence[float], width: float) -> list[float]:
    found: list[float] = []
    for x in borders:
        if not found or x - found[-1] > CLOSE * width:
            found.append(x)
    return found


# --- lines -----------------------------------------------------------------------------------------------------------


def _lines(i: int, place: Function, spans: Sequence[tuple[float, float, tuple[State, ...]]]) -> Iterator[BranchLine]:
    begun: tuple[float, bool] | None = None
    for k, (start, end, states) in enumerate(spans):
        state = states[i]
        begun = begun if begun is not None else (start, state) if state is not None else None
        if begun is not None and (k + 1 == len(spans) or spans[k + 1][2][i] != begun[1]):
            first, is_stable = begun
            xs = [first + (end - first) * (1 - cos(pi * n / STEPS)) / 2 for n in range(STEPS + 1)]
            spots = [(x, y) for x in xs if isfinite(y := place(x))]
            size = max((abs(y) for _, y in spots), default=0.0)
            points = tuple((x, y if abs(y) > REAL * size else 0.0) for x, y in spots)
            if len(points) > 1:
                yield BranchLine(i, is_stable, points)
            begun = None


def _extent(diagram: Diagram, lines: Sequence[BranchLine]) -> tuple[float, float]:
    """Return the ends of an axis with room for all lines."""
    values = [y for line in lines for _, y in line.points]
    if not values:
        raise Rejected(Complaint("drawing", "no equilibrium exists within the range of the diagram"))
    low, high = min(values), max(values)
    usual = sorted(map(abs, values))[len(values) // 2]
    if max(abs(low), abs(high)) > 100 * max(usual, 1e-300) and usual > 0:
        name = diagram.coordinate.name
        message = f"an equilibrium reaches {name} = {max(low, high, key=abs):.4g}, far beyond most other values"
        help_line = f"state a range for the vertical axis: `over: {{{name}: [..., ...]}}`"
        raise Rejected(Complaint("drawing", message, help=help_line))
    return (low, high) if high > low else (low - (abs(low) or 1.0), high + (abs(high) or 1.0))


def _clipped(line: BranchLine, low: float, high: float) -> Iterator[BranchLine]:
    part: list[tuple[float, float]] = []
    for k, (x, y) in enumerate(line.points):
        is_inside = low <= y <= high
        if k and is_inside != (low <= line.points[k - 1][1] <= high):
            part.append(_crossing(line.points[k - 1], (x, y), low, high))
        if is_inside:
            part.append((x, y))
        if part and (not is_inside or k + 1 == len(line.points)):
            if abs(part[-1][0] - part[0][0]) > CLOSE * abs(line.points[-1][0] - line.points[0][0]):
                yield BranchLine(line.of, line.is_stable, tuple(part))
            part = []


def _crossing(one: tuple[float, float], other: tuple[float, float], low: float, high: float) -> tuple[float, float]:
    edge = high if max(one[1], other[1]) > high else low
    share = (edge - one[1]) / (other[1] - one[1])
    return one[0] + share * (other[0] - one[0]), edge


def _change(
    left: tuple[float, float, tuple[State, ...]],
    right: tuple[float, float, tuple[State, ...]],
    places: Sequence[Function],
    axis: tuple[float, float],
) -> Change | None:
    at, room = left[1], CLOSE * (axis[1] - axis[0])
    changed = [place(at) for place, one, other in zip(places, left[2], right[2], strict=True) if one != other]
    found: list[float] = []
    for y in sorted(y for y in changed if isfinite(y)):
        if axis[0] - room <= y <= axis[1] + room and not any(abs(y - each) < 1e3 * room for each in found):
            found.append(y)
    return Change(at, tuple(found)) if found else None


# --- the second route ------------------------------------------------------------------------------------------------


def _searched(diagram: Diagram, low: float, high: float, is_whole: bool) -> tuple[float, float]:
    """Return the values of the coordinate between which the second route counts zeros."""
    size = high - low
    below, above = (part + is_whole for part in WIDENED)
    least, greatest = (float(end) if end is not None else None for end in diagram.within)
    least = 0.0 if least is None and diagram.coordinate.is_positive else least
    low, high = low - below * size, high + above * size
    inner = EDGE * size
    return (
        low if least is None else max(low, least + inner),
        high if greatest is None else min(high, greatest - inner),
    )


def _confirm(
    diagram: Diagram,
    parameter: Symbol,
    spans: Sequence[tuple[float, float, tuple[State, ...]]],
    places: Sequence[Function],
    numbers: Mapping[Any, Expr],
    searched: tuple[float, float],
    is_angle: bool,
) -> None:
    """Compare the branches with the stationary points of the potential energy, for a few values of the parameter
    between those at which the branches change.

    Symbols without a given number get trial numbers, because the branches do not depend on these symbols.
    """
    q = diagram.coordinate
    energy = diagram.energy.xreplace(dict(numbers))
    others = sorted(energy.free_symbols - {q, parameter}, key=str)
    energy = energy.xreplace({letter: Rational(13 + 4 * i, 11 + 3 * i) for i, letter in enumerate(others)})
    force = diff(energy, q)
    is_periodic = is_angle and diagram.within == (None, None) and bool((force.subs(q, q + FULL_TURN) - force).equals(0))
    slope = lambdify([parameter, q], force, "numpy")
    height = lambdify([parameter, q], energy, "mpmath")
    for start, end, states in spans:
        for x in (start + part * (end - start) for part in TRIED):
            grid = _grid(searched, is_periodic)
            known = [(place(x), state) for place, state in zip(places, states, strict=True) if state is not None]
            known = _within(known, grid, is_periodic)
            zeros = sorted(_zeros(partial(slope, x), grid))
            size = CLOSE * (grid[-1] - grid[0])
            agree = len(zeros) == len(known) and all(
                abs(zero - y) < size for zero, (y, _) in zip(zeros, sorted(known), strict=True)
            )
            if not agree:
                said = f"{len(known)} equilibria, but the slope of the potential energy has {len(zeros)} zeros"
                said = (
                    said if len(zeros) != len(known) else "an equilibrium where the potential energy is not stationary"
                )
                raise _wrong(f"for the value {x:.4g} of the parameter, the diagram has {said}")
            for y, is_stable in known:
                if _is_minimum(height, x, y, searched[1] - searched[0]) != is_stable:
                    word, has = ("stable", "no minimum") if is_stable else ("unstable", "a minimum")
                    at = f"{q.name} = {y:.4g} for the value {x:.4g} of the parameter"
                    raise _wrong(
                        f"the diagram shows a {word} equilibrium at {at}, but the potential energy has {has} there"
                    )


def _wrong(message: str) -> Unverified:
    return Unverified(Complaint("unverified", message))


def _grid(searched: tuple[float, float], is_periodic: bool) -> list[float]:
    start, size = searched[0], searched[1] - searched[0]
    if is_periodic:
        start, size = -pi + OFFSET * 2 * pi, 2 * pi
    return [start + size * i / GRID for i in range(GRID + 1)]


def _within(known: Sequence[tuple[float, bool]], grid: Sequence[float], is_periodic: bool) -> list[tuple[float, bool]]:
    """Return the equilibria within the grid; an angle is moved into the grid by full turns."""
    if not is_periodic:
        return [(y, state) for y, state in known if grid[0] < y < grid[-1]]
    found: list[tuple[float, bool]] = []
    for y, state in known:
        turned = y + 2 * pi * ceil((grid[0] - y) / (2 * pi))
        if not any(abs(turned - other) < CLOSE for other, _ in found):
            found.append((turned, state))
    return found


def _zeros(slope: Callable[[Any], Any], grid: Sequence[float]) -> Iterator[float]:
    import numpy as np

    with np.errstate(all="ignore"):
        values = np.real_if_close(slope(np.array(grid)) + 0.0 * np.array(grid))
        signed = [(x, float(v)) for x, v in zip(grid, values, strict=True) if np.isreal(v) and np.isfinite(v) and v]
        for (low, one), (high, other) in pairwise(signed):
            if one * other < 0:
                at = _halved(partial(_has_sign, slope, one > 0), low, high)
                beside = max(abs(one), abs(other))
                if abs(float(slope(at))) < SHRUNK * beside:
                    yield at


def _is_minimum(height: Callable[[Any, Any], Any], x: float, y: float, size: float) -> bool:
    """Whether the energy is greater on both sides of a place."""
    with mp.workdps(DIGITS):
        step = mp.mpf(size) * mp.mpf(10) ** -NEAR
        here = height(mp.mpf(x), mp.mpf(y))
        return bool(all(mp.re(height(mp.mpf(x), mp.mpf(y) + side * step) - here) > 0 for side in (-1, 1)))
