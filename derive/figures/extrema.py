"""The extrema of a curve, from sign changes of its exact derivative.

The direction of the sign change distinguishes minimum and maximum. As a check, the curve is also evaluated on both
sides of the extremum. The values there must be greater than a minimum, and less than a maximum.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import isfinite, nan
from typing import Any

from sympy import Expr, Symbol, diff, lambdify

from derive.errors import Complaint, Rejected, Unverified

STEPS = 1009  # number of steps of the grid; it is odd, so the centre of the range is not a grid point
POLE = 1e4  # a value above POLE times the greatest value of the grid is a pole, not an extremum
MINIMUM, MAXIMUM = "minimum", "maximum"
# In `zeros` and `meetings`, a value below this fraction of the greatest value counts as zero, because an end of the
# range may be rounded to three figures.
NEAR_ZERO = 1e-3
NOISE = 1e-12  # an extremum below this fraction of the greatest value is a rounding error, and counts as zero


@dataclass(frozen=True)
class Extremum:
    """An extremum of a curve: the value of the variable, the value of the curve, and "minimum" or "maximum". `name` is
    the symbol that the solution has for this value of the variable, such as r_0."""

    at: float
    value: float
    kind: str
    name: Any = None


def values_along(expr: Expr, variable: Symbol, lower: float, upper: float, steps: int) -> list[tuple[float, float]]:
    """Return evenly spaced points of the curve; raise `Rejected` if one of the values is not real or not finite."""
    f = lambdify([variable], expr, "math")
    points = [lower + (upper - lower) * i / steps for i in range(steps + 1)]
    try:
        found = [(x, float(f(x))) for x in points]
    except (ValueError, ZeroDivisionError, OverflowError, TypeError):
        found = []
    if not found or not all(isfinite(y) for _, y in found):
        raise _not_real(expr)
    return found


def _not_real(expr: Expr) -> Rejected:
    return Rejected(Complaint("drawing", f"the curve of {expr} is not real and finite over its whole range"))


def extrema(expr: Expr, variable: Symbol, lower: float, upper: float) -> tuple[Extremum, ...]:
    """Return the extrema of an expression in one symbol inside the range; the slope may be infinite at some points."""
    f, derivative = (lambdify([variable], each, "math") for each in (expr, diff(expr, variable)))

    def slope(x: float) -> float:
        try:
            return float(derivative(x))
        except (ValueError, ZeroDivisionError, OverflowError, TypeError):
            return nan

    every = [lower + (upper - lower) * i / STEPS for i in range(STEPS + 1)]
    xs = [x for x in every if isfinite(slope(x))]
    if not xs:
        raise _not_real(expr)
    slopes = [slope(x) for x in xs]
    found = []
    for i in range(len(xs) - 1):
        if slopes[i] * slopes[i + 1] < 0:
            at = _narrowed(slope, xs[i], xs[i + 1])
            at = 0.0 if abs(at) < 1e-6 * (upper - lower) and slope(0.0) == 0 else at
            if _is_pole(f, at, xs):
                message = f"a curve of the plot is infinite or not real near {at:.4g}"
                raise Rejected(Complaint("drawing", message, help=f"choose a range that does not contain {at:.4g}"))
            kind = MINIMUM if slopes[i] < 0 else MAXIMUM
            _confirm(f, at, (upper - lower) / STEPS, kind)
            found.append(Extremum(at, float(f(at)), kind))
    size = max(abs(float(f(x))) for x in xs) if found else 0
    found = [each if abs(each.value) > NOISE * size else replace(each, value=0.0) for each in found]
    return tuple(found)


def zeros(expr: Expr, variable: Symbol, lower: float, upper: float) -> tuple[float, ...]:
    """Return the places inside the range at which an expression in one symbol changes its sign. A zero at the upper end
    of the range also counts, but one at the lower end does not."""
    points = values_along(expr, variable, lower, upper, STEPS)
    f = lambdify([variable], expr, "math")
    size = max(abs(y) for _, y in points)
    first, *inner, last = points
    # Points at which the value is almost zero are left out; the zero is found between their neighbours.
    inner = [(x, y) for x, y in inner if abs(y) > NEAR_ZERO * size]
    found = [_narrowed(f, a, b) for (a, y), (b, z) in pairwise([first, *inner]) if y * z < 0]
    (a, y), (b, z) = [first, *inner][-1], last
    if abs(z) <= NEAR_ZERO * size:
        return (*found, b)
    return (*found, _narrowed(f, a, b)) if y * z < 0 else tuple(found)


def meetings(one: Expr, other: Expr, variable: Symbol, lower: float, upper: float) -> tuple[float, ...]:
    """Return the places in the range at which two curves cross. A common point at an end of the range also counts,
    except a common start with the value zero."""
    found = zeros(one - other, variable, lower, upper)
    f, g = (lambdify([variable], each, "math") for each in (one, other))
    start, size = float(f(lower)), max(abs(float(each(upper))) for each in (f, g))
    starts = abs(start - float(g(lower))) <= NEAR_ZERO * size < abs(start)
    return (lower, *found) if starts else found


def _narrowed(slope: Callable[[float], Any], low: float, high: float) -> float:
    below = slope(low) < 0
    for _ in range(80):
        middle = (low + high) / 2
        if not isfinite(slope(middle)):
            return middle
        if (slope(middle) < 0) == below:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _is_pole(f: Callable[[float], Any], at: float, xs: Sequence[float]) -> bool:
    """Return whether the curve has no finite real value at this place, or a value far above all values of the grid."""
    try:
        value = abs(float(f(at)))
    except (ZeroDivisionError, ValueError, OverflowError, TypeError):  # infinite or not real
        return True
    return not isfinite(value) or value > POLE * max(abs(float(f(x))) for x in xs)


def _confirm(f: Callable[[float], Any], at: float, step: float, kind: str) -> None:
    rises = [f(at + side * step) - f(at) for side in (-1, 1)]
    if not all(rise > 0 if kind == MINIMUM else rise < 0 for rise in rises):
        raise Unverified(Complaint("unverified", f"at {at:g} the curve has no {kind}, but its slope changes sign"))
