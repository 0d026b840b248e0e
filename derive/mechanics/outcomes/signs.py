"""What is asked of any value: whether it vanishes, lasts, or has a sign whatever its letters are."""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice
from typing import Any

from sympy import Expr

from derive.algebra.ranges import strict_sign_within
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.steps.known_numbers import sign_known
from derive.steps.outcomes import Judged, Predicate
from derive.steps.step import is_zero

TRIED = 12  # numbers of the ranges
MARK_OF = {  # what a comparison is called
    "equal_to": "=",
    "different_from": "!=",
    "greater_than": ">",
    "less_than": "<",
    "at_least": ">=",
    "at_most": "<=",
}


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
    """The sign by the letters and their ranges alone, whatever numbers they have."""

    def is_so(facts: Judged) -> bool:
        value = tidied(of(facts))
        sign = 0 if is_zero(value) else 1 if value.is_positive else -1 if value.is_negative else _sign_in_ranges(value)
        return sign == wanted

    return is_so


def _sign_in_ranges(value: Expr) -> int | None:
    """The sign that the ranges of its letters settle, if numbers of these ranges bear it out."""
    sign = strict_sign_within(value)
    letters = letters_of(value)
    if sign is None:
        return None
    try:
        found = [value_at(value, point) for point in islice(points(letters, seed_of(value)), TRIED)]
    except (Undefined, NoNumber):
        return None
    return sign if all(sign * number > 0 for number in found) else None
