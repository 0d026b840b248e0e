"""Letters that lie between two numbers, 0 < alpha < pi/2, and the signs that are settled by it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from math import prod
from typing import Any

from sympy import Abs, Add, Expr, Integer, Mul, Pow, Symbol, cos, floor, pi, sin, tan


@dataclass(frozen=True)
class Range:
    """The letter is greater than one number and less than the other; an end that is `closed` it may have."""

    least: Expr
    greatest: Expr
    closed: tuple[bool, bool] = (False, False)


_KNOWN: ContextVar[Mapping[Symbol, Range]] = ContextVar("ranges", default={})  # noqa: B039  which nobody changes


@contextmanager
def within(ranges: Mapping[Symbol, Range]) -> Iterator[None]:
    """What is done inside knows these letters to lie in their ranges."""
    token = _KNOWN.set({**_KNOWN.get(), **ranges})
    try:
        yield
    finally:
        _KNOWN.reset(token)


def range_of(letter: Any) -> Range | None:
    return _KNOWN.get().get(letter)


def settled(value: Any) -> Any:
    """The value without absolute values of what has one sign in the ranges of its letters."""
    known = _KNOWN.get()
    if not known or not hasattr(value, "atoms") or not value.free_symbols & known.keys():
        return value
    sizes = {size: sign * size.args[0] for size in value.atoms(Abs) if (sign := sign_within(size.args[0]))}
    return value.xreplace(sizes) if sizes else value


def sign_within(expr: Expr) -> int | None:
    """1 or -1 where the sign is the same for all values in the ranges of the letters; None where that is not known."""
    signs = [_sign_of_factor(factor) for factor in Mul.make_args(expr)]
    return None if None in signs else prod(sign for sign in signs if sign)


def strict_sign_within(expr: Expr) -> int | None:
    """The same where no letter may have an end of its range, at which the value may vanish."""
    if any(True in known.closed for letter in expr.free_symbols if (known := range_of(letter)) is not None):
        return None
    return sign_within(expr)


def _sign_of_factor(factor: Expr) -> int | None:
    if factor.is_positive or factor.is_negative:
        return 1 if factor.is_positive else -1
    if isinstance(factor, Pow) and factor.exp.is_Integer:
        sign = sign_within(factor.base)
        return sign**2 if sign and factor.exp % 2 == 0 else sign
    if isinstance(factor, sin | cos | tan):
        return _sign_of_function(factor)
    ends = _ends(factor)
    if ends is None:
        return None
    return 1 if ends[0].is_nonnegative else -1 if ends[1].is_nonpositive else None


def _sign_of_function(function: Expr) -> int | None:
    """By the quarter of the circle, or the half, in which its angle stays."""
    ends = _ends(function.args[0])
    if ends is None:
        return None
    width = pi / 2 if isinstance(function, tan) else pi
    shift = pi / 2 if isinstance(function, cos) else Integer(0)
    first = floor((ends[0] + shift) / width)
    if (ends[1] + shift - (first + 1) * width).is_positive is not False:
        return None
    return -1 if first % 2 else 1


def _ends(expr: Expr) -> tuple[Expr, Expr] | None:
    """Between which numbers an expression of the first degree in its letters lies."""
    least: Expr = Integer(0)
    greatest: Expr = Integer(0)
    for term in Add.make_args(expr):
        number, letter = term.as_coeff_Mul()
        if letter == 1 or letter.is_number:
            ends = (term, term)
        elif (known := range_of(letter)) is not None:
            ends = (number * known.least, number * known.greatest)
            ends = ends if number.is_positive else ends[::-1]
        else:
            return None
        least, greatest = least + ends[0], greatest + ends[1]
    return least, greatest
