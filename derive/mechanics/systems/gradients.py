"""Whether a force can keep a constraint: its gradient does not vanish where the constraint holds.

It is decided in numbers. From drawn places one goes to the constraint by Newton's method, and looks at the gradient
there: that of (x - y)^2 vanishes on the constraint itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from random import Random
from typing import Any

from mpmath import mp
from sympy import Expr, Rational, Symbol, lambdify

from derive.algebra.expressions import TIME, rate
from derive.algebra.ranges import rational_in_range
from derive.errors import Complaint, Rejected
from derive.mechanics.systems.constraint import Constraint

DIGITS = 40
TRIES, TURNS = 6, 60
SMALL = 8  # digits by which a gradient is smaller on the constraint than elsewhere


def check_gradient(constraint: Constraint) -> None:
    """Refuse a constraint whose gradient vanishes wherever the constraint holds."""
    verdicts = list(_verdicts(constraint))
    if verdicts and all(verdicts):
        message = f"the gradient of {constraint.residual} vanishes wherever it is zero, so no force can keep it at zero"
        help_line = "without a square it can be kept: `x - y` in place of `(x - y)**2`"
        raise Rejected(Complaint("constrained", message, help=help_line))


def _verdicts(constraint: Constraint) -> Iterator[bool]:
    """For each place on the constraint that was found, whether the gradient vanishes there."""
    moving = sorted(constraint.coordinates, key=str)
    slopes, rates = [constraint.along(q) for q in moving], {rate(q) for q in moving}
    held = constraint.residual if not constraint.in_rates else Rational(0)
    letters = {s for each in (held, *slopes) for s in each.free_symbols} - set(moving) - rates
    others = sorted(letters, key=str)
    gradient = lambdify([*moving, *others], slopes, "mpmath", dummify=True)
    value = lambdify([*moving, *others], held, "mpmath", dummify=True)
    source = Random(len(moving))
    with mp.workdps(DIGITS):
        for _ in range(TRIES):
            start, known = ([_drawn(s, source) for s in those] for those in (moving, others))
            try:
                at = _reached(lambda *q, k=known: value(*q, *k), lambda *q, k=known: gradient(*q, *k), start)
                if at is not None:
                    there, elsewhere = (_size(gradient(*place, *known)) for place in (at, start))
                    yield bool(there <= elsewhere * mp.mpf(10) ** -SMALL)
            except (ZeroDivisionError, ValueError, TypeError):
                continue


def _drawn(letter: Symbol, source: Random) -> Any:
    sign = 1 if letter.is_nonnegative or letter == TIME else source.choice((1, -1))
    value: Expr = rational_in_range(letter, Rational(source.randint(20, 90), 47)) * sign
    return mp.mpf(int(value.p)) / int(value.q)


def _reached(value: Callable[..., Any], gradient: Callable[..., Any], start: Sequence[Any]) -> list[Any] | None:
    """The place on the constraint that is reached straight across it; nothing where there is none close by."""
    at = list(start)
    for _ in range(TURNS):
        left, slopes = value(*at), gradient(*at)
        if abs(left) < mp.mpf(10) ** -(DIGITS - 8):
            return at
        square = _size(slopes) ** 2
        at = [x - left * slope / square for x, slope in zip(at, slopes, strict=True)]
    return at if abs(value(*at)) < mp.mpf(10) ** -(2 * SMALL) else None


def _size(vector: Sequence[Any]) -> Any:
    return mp.sqrt(sum(x**2 for x in vector))
