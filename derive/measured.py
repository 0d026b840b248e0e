"""The numbers behind the letters of a problem, for the few verbs that must know what the case is.

A derivation stays symbolic; but whether a top spins fast enough is a question about numbers. While a script runs, the
numbers that its problem gives are known here, and `sign_known` takes them where the letters alone do not decide.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar

from sympy import Expr, Symbol

from derive.exact import vanishes
from derive.expressions import bound, explicit

DIGITS = 30

_numbers: ContextVar[Mapping[Symbol, Expr] | None] = ContextVar("numbers", default=None)


@contextmanager
def numbers_known(numbers: Mapping[Symbol, Expr]) -> Iterator[None]:
    """Within, letters have these numbers."""
    token = _numbers.set(numbers)
    try:
        yield
    finally:
        _numbers.reset(token)


def with_numbers(expr: Expr) -> Expr:
    """The expression with the numbers behind its letters, as far as there are any."""
    return explicit(bound(explicit(expr), _numbers.get() or {}))


def sign_known(expr: Expr) -> int | None:
    """The sign of an expression, by its letters or else by their numbers: 1, -1, 0; None where neither decides it."""
    expr = explicit(expr)
    if vanishes(expr):
        return 0
    if expr.is_positive:
        return 1
    if expr.is_negative:
        return -1
    value = with_numbers(expr)
    if value.free_symbols:
        return None
    if vanishes(value):
        return 0
    approximate = value.evalf(DIGITS)
    return 1 if approximate > 0 else -1
