"""Count the zeros of a force numerically: their number must equal the number of equilibria that were found."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from sympy import Expr, Rational, Symbol, lambdify, pi

from derive.algebra.derivatives import derivative
from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import Relation, explicit
from derive.algebra.ranges import Range, range_of
from derive.algebra.samples import points
from derive.steps.step import Quantity, is_zero

STEPS, TRIALS = 1500, 3  # number of parts of a range; number of sets of numbers for the symbols
HALVINGS = 40  # greatest number of halvings of an interval in which the force changes its sign
SHRUNK = 1e-6  # at a zero, the halvings must reduce the force to less than this fraction of its first value
LITTLE = 1e-9


def is_countable(sought: Sequence[Symbol]) -> bool:
    """Whether the changes of sign can be counted: there is one coordinate, and its range, if it has one, does not
    include its ends."""
    known = range_of(sought[0])
    return len(sought) == 1 and (known is None or True not in known.closed)


def signs_counted(
    potential: Quantity, q: Symbol, states: Sequence[tuple[Expr, Relation | None]], found: Expr
) -> Verdict:
    """Check, for a few sets of numbers, that the force has as many zeros with a change of sign as there are equilibria.

    states   the value of each equilibrium with the condition under which the equilibrium exists
    found    the value of the equilibrium that is checked; it must be among the states
    """
    force = derivative(explicit(potential.value), q)
    letters = {s for s in force.free_symbols if s != q}
    once_round = potential.coordinates.get(q) == "angle" and is_zero(force.subs(q, q + 2 * pi) - force)
    drawn = points(letters, 4099)
    for _, point in zip(range(TRIALS), drawn, strict=False):
        values = [(value.xreplace(point).evalf(), _holds(exists, point)) for value, exists in states]
        expected = sorted(float(value) for value, is_there in values if is_there and _is_place(value, q))
        own = found.xreplace(point).evalf()
        curve = lambdify([q], force.xreplace(point), "math")
        scale = max([abs(x) for x in expected if x] or [1.0])
        known = range_of(q)
        grid = _grid(once_round, bool(q.is_positive), scale) if known is None else _grid_within(known)
        signs = [(x, s) for x in grid if (s := _sign(curve, x))]
        turns = [(x, y) for (x, one), (y, other) in pairwise(signs) if one != other]
        changes = sum(_vanishes_between(curve, x, y) for x, y in turns)
        where = tuple((str(s), str(x)) for s, x in point.items())
        if changes != len(expected):
            message = f"zeros of the force: {changes}; listed equilibria: {len(expected)}"
            return Verdict(Grade.REFUTED, message, where)
        if all(abs(own - value) > LITTLE * (1 + abs(value)) for value, _ in values):
            return Verdict(Grade.REFUTED, "the equilibrium is not among those that are listed", where)
        if any(not math.isfinite(x) for x in expected):
            return Verdict(Grade.REFUTED, "a value is not finite")
    return Verdict(Grade.SAMPLED, f"zeros counted for {TRIALS} sets of numbers")


def _holds(exists: Relation | None, point: Mapping[Symbol, Expr]) -> bool:
    return exists is None or bool((exists.residual.xreplace(dict(point)) > 0) == (exists.operator == ">"))


def _is_place(value: Expr, q: Symbol) -> bool:
    """Whether the value may be an equilibrium: it must be real and, for a positive coordinate q, positive."""
    return bool(value.is_real and (value > 0 or not q.is_positive))


def _grid(once_round: bool, positive: bool, scale: float) -> list[float]:
    """Return the values of the coordinate at which the force is evaluated."""
    if once_round:
        return [-math.pi - 0.01234 + 2 * math.pi * i / STEPS for i in range(STEPS + 1)]
    ends = [
        (i + 0.5) / STEPS * math.pi / (2 if positive else 1) - (0 if positive else math.pi / 2) for i in range(STEPS)
    ]
    return [scale * math.tan(u) for u in ends]


def _grid_within(known: Range) -> list[float]:
    return [float(known.at(Rational(2 * i + 1, 2 * STEPS))) for i in range(STEPS)]


def _vanishes_between(curve: Any, low: float, high: float) -> bool:
    """Whether the force vanishes where it changes its sign.

    A force can also change its sign without vanishing. It may diverge, as at the position of a charge, or jump, as
    where a spring has the length zero.
    """
    sign, before = _sign(curve, low), max(abs(curve(low)), abs(curve(high)))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        there = _sign(curve, middle)
        if not there:
            return True
        if middle in (low, high):
            break
        low, high = (middle, high) if there == sign else (low, middle)
    return bool(min(abs(curve(low)), abs(curve(high))) < SHRUNK * before)


def _sign(curve: Any, x: float) -> int:
    try:
        value = curve(x)
    except (ValueError, ZeroDivisionError, OverflowError):
        return 0
    return 0 if isinstance(value, complex) or value == 0 else 1 if value > 0 else -1
