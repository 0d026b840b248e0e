"""A motion followed in numbers: equations of motion integrated, and a quantity compared with its rate along the way.

This proves nothing, for it is one motion, to some figures; but it shares nothing with the algebra that it checks. The
integration is mpmath's, by Taylor series.
"""

from __future__ import annotations

import random
from collections.abc import Mapping

from sympy import Expr, Rational, Symbol, lambdify

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import RATES, TIME, rate, scalar

FIGURES = 10  # to which the two must agree, of the 15 that are carried


def followed(value: Expr, its_rate: Expr, motion: Mapping[Symbol, Expr]) -> Verdict:
    """Whether Q(1) - Q(0) is the integral of dQ/dt from 0 to 1 along one motion.

    value, its_rate   Q and what is claimed of dQ/dt
    motion            highest rate -> what the equations of motion make of it
    """
    from mpmath import mp, mpf, odefun

    state = _state(motion)
    onwards = [motion.get(rate(s), rate(s)) for s in state]
    free = {s for e in (value, its_rate, *onwards) for s in e.free_symbols if isinstance(s, Symbol)} - {TIME}
    letters = sorted(free - set(state), key=str)
    source = random.Random(20_777)
    numbers = {s: _number(s, source) for s in (*letters, *state)}
    fixed = {s: numbers[s] for s in letters}
    with mp.workdps(15):
        flow = lambdify([TIME, *state], [e.xreplace(fixed) for e in (*onwards, its_rate)], "mpmath")
        quantity = lambdify([TIME, *state], value.xreplace(fixed), "mpmath")
        start = [mpf(int(numbers[s].p)) / int(numbers[s].q) for s in state]
        end = odefun(lambda t, y: flow(t, *y[:-1]), 0, [*start, mpf(0)])(1)
        gained, expected = quantity(1, *end[:-1]) - quantity(0, *start), end[-1]
        size = abs(quantity(0, *start)) + abs(expected)
        agrees = abs(gained - expected) <= size * mpf(10) ** -FIGURES
    where = tuple((str(s), str(number)) for s, number in numbers.items())
    if not agrees:
        return Verdict(Grade.REFUTED, f"{mp.nstr(gained, 6)} against {mp.nstr(expected, 6)}", where)
    return Verdict(Grade.APPROXIMATION, f"one motion, to {FIGURES} figures")


def _state(motion: Mapping[Symbol, Expr]) -> list[Symbol]:
    """The coordinates and rates below the highest ones: their values at one time fix the motion."""
    found: list[Symbol] = []
    for highest in motion:
        order = next(n for n in (3, 2, 1) if highest.name.endswith(RATES[n]))
        coordinate = scalar(highest.name.removesuffix(RATES[order]))
        found += [rate(coordinate, n) if n else coordinate for n in range(order)]
    return found


def _number(letter: Symbol, source: random.Random) -> Rational:
    size = Rational(source.randint(11, 97), source.randint(41, 61))
    return size if letter.is_positive or source.random() < 0.5 else -size
