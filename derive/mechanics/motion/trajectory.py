"""Numerical integration of a motion, to compare the change of a quantity with the integral of its rate.
One motion with a limited number of figures proves nothing, but the integration shares no code with the algebra that it
checks. The integration is by Gragg's rule, extrapolated to zero step length.
Source: Press, Teukolsky, Vetterling, Flannery, *Numerical Recipes*, 3rd edition, section 17.3.
"""

from __future__ import annotations

import cmath
import random
from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from sympy import Expr, Rational, Symbol, lambdify

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import RATES, TIME, rate, scalar

FIGURES = 10  # the change and the integral of the rate must agree to this number of figures; a float has 15
STEPS = (4, 16, 64, 256)  # numbers of steps from t = 0 to t = 1, tried in turn until the change and the integral agree
PARTS = range(2, 18, 2)  # numbers of parts into which a step is divided, for the extrapolation to zero length

State: TypeAlias = list[complex]  # complex, because a square root may be imaginary for random numbers
Flow: TypeAlias = Callable[..., Sequence[complex]]


def followed(value: Expr, its_rate: Expr, motion: Mapping[Symbol, Expr]) -> Verdict:
    """Check numerically that Q(1) - Q(0) is the integral of dQ/dt from t = 0 to t = 1 along one motion.

    value, its_rate   Q and the claimed dQ/dt
    motion            a mapping from each highest rate to its value by the equations of motion
    """
    state = _state(motion)
    onwards = [motion.get(rate(s), rate(s)) for s in state]
    free = {s for e in (value, its_rate, *onwards) for s in e.free_symbols if isinstance(s, Symbol)} - {TIME}
    letters = sorted(free - set(state), key=str)
    source = random.Random(20_777)
    numbers = {s: _number(s, source) for s in (*letters, *state)}
    fixed = {s: numbers[s] for s in letters}
    functions = [vars(cmath), "math"]
    flow = lambdify([TIME, *state], [e.xreplace(fixed) for e in (*onwards, its_rate)], functions)
    quantity = lambdify([TIME, *state], value.xreplace(fixed), functions)
    start = [complex(numbers[s]) for s in state]
    before, gained, expected = quantity(0, *start), 0j, 0j
    for steps in STEPS:
        try:
            *end, expected = _end(lambda t, y: flow(t, *y[:-1]), [*start, 0j], steps)
            gained = quantity(1, *end) - before
        except (OverflowError, ZeroDivisionError):  # a step left the domain of the motion
            continue
        if abs(gained - expected) <= (abs(before) + abs(expected)) * 10**-FIGURES:
            return Verdict(Grade.APPROXIMATION, f"one motion, to {FIGURES} figures")
    where = tuple((str(s), str(number)) for s, number in numbers.items())
    return Verdict(Grade.REFUTED, f"{_shown(gained)} against {_shown(expected)}", where)


def _shown(number: complex) -> str:
    return f"{number.real:.6g}" if not number.imag else f"{number:.6g}"


def _end(flow: Flow, start: State, steps: int) -> State:
    y, length = start, 1 / steps
    for n in range(steps):
        row: list[State] = []
        for k, parts in enumerate(PARTS):
            further = [_by_midpoints(flow, y, n * length, length / parts, parts)]
            for j, beside in enumerate(row):  # the error contains only even powers of the step length
                weight = 1 / ((parts / PARTS[k - 1 - j]) ** 2 - 1)
                further.append([a + (a - b) * weight for a, b in zip(further[-1], beside, strict=True)])
            row = further
        y = row[-1]
    return y


def _by_midpoints(flow: Flow, y: State, t: float, h: float, parts: int) -> State:
    """Return the state after one step by Gragg's rule: an Euler step, then midpoint steps of length 2h."""
    last, now = y, [a + h * v for a, v in zip(y, flow(t, y), strict=True)]
    for k in range(1, parts):
        slopes = flow(t + k * h, now)
        last, now = now, [a + 2 * h * v for a, v in zip(last, slopes, strict=True)]
    slopes = flow(t + parts * h, now)
    return [(a + b + h * v) / 2 for a, b, v in zip(last, now, slopes, strict=True)]


def _state(motion: Mapping[Symbol, Expr]) -> list[Symbol]:
    """Return all coordinates and rates below the highest rates; their values at one instant determine the motion."""
    found: list[Symbol] = []
    for highest in motion:
        order = next(n for n in (3, 2, 1) if highest.name.endswith(RATES[n]))
        coordinate = scalar(highest.name.removesuffix(RATES[order]))
        found += [rate(coordinate, n) if n else coordinate for n in range(order)]
    return found


def _number(letter: Symbol, source: random.Random) -> Rational:
    size = Rational(source.randint(11, 97), source.randint(41, 61))
    return size if letter.is_positive or source.random() < 0.5 else -size
