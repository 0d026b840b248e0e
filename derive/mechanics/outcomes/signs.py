"""What is asked of any value: whether it vanishes, lasts, or has a sign whatever its letters are."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Expr

from derive.algebra.tidy import tidied
from derive.steps.known_numbers import sign_known
from derive.steps.outcomes import Judged, Predicate
from derive.steps.step import is_zero


def vanishes(facts: Judged) -> bool:
    return is_zero(facts.result)


def lasts(facts: Judged) -> bool:
    return not is_zero(facts.result)


def never_vanishes(v: Any) -> bool:
    """Whether some component is a product of factors none of which can vanish."""
    return any(bool(tidied(entry).is_nonzero) for entry in v)


def sign_is(wanted: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    return lambda facts: sign_known(of(facts)) == wanted


def always_sign(wanted: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    """The sign by the letters alone, whatever numbers they have."""

    def is_so(facts: Judged) -> bool:
        value = tidied(of(facts))
        sign = 0 if is_zero(value) else 1 if value.is_positive else -1 if value.is_negative else None
        return sign == wanted

    return is_so
