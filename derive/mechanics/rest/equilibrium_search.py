"""Search for missing equilibria numerically, with Newton's method from many starting points.

A starting point is random, or a known equilibrium with one coordinate reflected or displaced. A new equilibrium counts
if quadratic convergence confirms it to many digits; a point where the forces only become small, or are stationary, is
not confirmed.

Source: Press, Teukolsky, Vetterling, Flannery, *Numerical Recipes*, 3rd edition, section 9.6.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import islice
from random import Random
from typing import Any, TypeAlias

from mpmath import mp
from sympy import Expr, Symbol, diff, lambdify

from derive.algebra.ranges import Range, range_of
from derive.algebra.samples import points

# greatest numbers: sets of values for the symbols, random starts, starts in total, steps of one search
TRIALS, DRAWN, STARTS, TURNS = 2, 24, 90, 25
CLOSE, DIGITS = 1e-6, 50
FAULTS = (ValueError, ZeroDivisionError, OverflowError, TypeError)

Forces: TypeAlias = tuple[Expr, ...]
States: TypeAlias = tuple[tuple[tuple[Symbol, Expr], ...], ...]
Motion: TypeAlias = Callable[..., Sequence[float]]


def none_is_missing(forces: Forces, sought: tuple[Symbol, ...], angles: tuple[Symbol, ...], states: States) -> bool:
    """Whether all equilibria that the search finds are among the known states.

    forces   dU/dq for each coordinate
    angles   coordinates whose period is a full turn
    states   the coordinates of each equilibrium with their values; a coordinate that is not listed may have any value
    """
    letters = sorted({s for force in forces for s in force.free_symbols}, key=str)
    return _searched(forces, sought, angles, states, tuple((s, range_of(s)) for s in letters))


@lru_cache(maxsize=16)  # each equilibrium of a system needs the same search
def _searched(
    forces: Forces,
    sought: tuple[Symbol, ...],
    angles: tuple[Symbol, ...],
    states: States,
    ranges: tuple[tuple[Symbol, Range | None], ...],
) -> bool:
    letters = [s for s, _ in ranges if s not in sought]
    both = [*forces, *(diff(force, q) for force in forces for q in sought)]
    rough = lambdify([*sought, *letters], both, "math", cse=True, dummify=True)
    exact = lambdify([*sought, *letters], both, "mpmath", cse=True, dummify=True)
    turning = [q in angles for q in sought]
    turned = [q in angles and range_of(q) is None for q in sought]
    for point in islice(points(set(letters), 4099), TRIALS):
        there = [at for state in states if (at := _place(state, sought, point)) is not None]
        numbers = [point[s] for s in letters]
        motion = _with(rough, [float(x) for x in numbers])
        sure = _with(
            exact, [mp.mpf(int(x.p)) / int(x.q) if x.is_Rational else mp.mpf(str(x.evalf(DIGITS))) for x in numbers]
        )
        for start in _starts(sought, turning, there):
            reached = _followed(motion, start)
            if reached is None:
                continue
            found = [math.remainder(x, 2 * math.pi) if turns else x for x, turns in zip(reached, turned, strict=True)]
            if not _is_inside(found, sought):
                continue
            if not any(_is_at(found, place, turning) for place in there) and _is_rest(sure, found):
                return False
    return True


def _with(function: Motion, numbers: Sequence[Any]) -> Motion:
    return lambda *at: function(*at, *numbers)


def _place(state: Any, sought: Sequence[Symbol], point: Any) -> list[float | None] | None:
    """Return the numerical values of an equilibrium; None if the equilibrium does not exist for these numbers."""
    values = dict(state)
    found: list[float | None] = []
    for q in sought:
        value = values[q].xreplace(dict(point)).evalf() if q in values else None
        if value is not None and not (value.is_real and value.is_finite):
            return None
        found.append(None if value is None else float(value))
    return found


def _starts(
    sought: Sequence[Symbol], turning: Sequence[bool], there: Sequence[list[float | None]]
) -> Iterator[list[float]]:
    """Yield random starts in the ranges, then each known equilibrium with one coordinate reflected or displaced."""
    source = Random(len(sought))
    size = max([abs(x) for place in there for x, turns in zip(place, turning, strict=True) if x and not turns] or [1.0])

    def drawn(i: int) -> float:
        known, part = range_of(sought[i]), source.uniform(0.02, 0.98)
        if known is not None:
            return float(known.at(part))
        if turning[i]:
            return math.pi * (2 * part - 1)
        return size * math.tan(math.pi / 2 * (part if sought[i].is_positive else 2 * part - 1) * 0.9)

    yield from ([drawn(i) for i in range(len(sought))] for _ in range(DRAWN))
    beside = (
        [*full[:i], other, *full[i + 1 :]]
        for place in there
        for full in [[drawn(k) if x is None else x for k, x in enumerate(place)]]
        for i, x in enumerate(full)
        for other in ((math.pi - x, math.pi + x, -x) if turning[i] else (-x, x + size, x - size))
    )
    shaken = ([x + source.uniform(-0.05, 0.05) for x in start] for start in beside)
    yield from islice(shaken, STARTS - DRAWN)


def _followed(motion: Motion, start: Sequence[float]) -> list[float] | None:
    at = list(start)
    for _ in range(TURNS):
        step = _step(motion, at)
        if step is None or not all(isinstance(x, float) and math.isfinite(x) for x in step):
            return None
        length, size = math.hypot(*step), 1 + math.hypot(*at)
        at = [x - s * min(1.0, size / length if length else 1.0) for x, s in zip(at, step, strict=True)]
        if length < 1e-9 * size:
            return at
    return None


def _solved(matrix: list[list[Any]], right: list[Any]) -> list[Any] | None:
    """Solve A x = b by elimination, with the largest entry of each column as pivot; return None if A is singular."""
    count = len(right)
    rows = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    for k in range(count):
        best = max(range(k, count), key=lambda i: abs(rows[i][k]))
        if not abs(rows[best][k]) > 0:
            return None
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(count):
            if i != k:
                share = rows[i][k] / rows[k][k]
                rows[i] = [x - share * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [rows[k][count] / rows[k][k] for k in range(count)]


def _is_inside(at: Sequence[float], sought: Sequence[Symbol]) -> bool:
    for x, q in zip(at, sought, strict=True):
        known = range_of(q)
        if known is not None and not float(known.least) + CLOSE < x < float(known.greatest) - CLOSE:
            return False
        if known is None and q.is_positive and x < CLOSE:
            return False
    return True


def _is_at(at: Sequence[float], place: Sequence[float | None], turning: Sequence[bool]) -> bool:
    for x, y, turns in zip(at, place, turning, strict=True):
        if y is None:
            continue
        apart = abs(math.remainder(x - y, 2 * math.pi)) if turns else abs(x - y)
        if apart > CLOSE * (1 + abs(y)):
            return False
    return True


def _is_rest(motion: Motion, start: Sequence[float]) -> bool:
    """Whether four more steps of Newton's method converge to many digits."""
    with mp.workdps(DIGITS):
        at, far = [mp.mpf(x) for x in start], [mp.inf]
        for _ in range(4):
            step = _step(motion, at)
            if step is None:
                return False
            at = [x - s for x, s in zip(at, step, strict=True)]
            far = [abs(s) / (1 + abs(x)) for x, s in zip(at, step, strict=True)]
        return bool(max(far) < mp.mpf(10) ** (15 - DIGITS))


def _step(motion: Motion, at: Sequence[Any]) -> list[Any] | None:
    count = len(at)
    try:
        found = motion(*at)
        rows = [list(found[count * (i + 1) : count * (i + 2)]) for i in range(count)]
        return _solved(rows, list(found[:count]))
    except FAULTS:
        return None
