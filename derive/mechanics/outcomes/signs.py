"""What is asked of any value: whether it vanishes, lasts, or has a sign whatever its letters are."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import islice
from typing import Any

from sympy import Expr, Integer, Rational, Symbol, prime

from derive.algebra.node import explicit
from derive.algebra.ranges import fulfilling, range_of, strict_sign_within
from derive.algebra.relation import Relation
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.steps.known_numbers import sign_known, with_numbers
from derive.steps.outcomes import Judged, Predicate
from derive.steps.record import assumed
from derive.steps.step import is_zero

TRIED, MANY = 12, 60  # numbers of the ranges; points of which some do as is assumed
MARK_OF = {  # what a comparison is called
    "equal_to": "=",
    "different_from": "!=",
    "greater_than": ">",
    "less_than": "<",
    "at_least": ">=",
    "at_most": "<=",
}


def is_so(condition: Relation, point: Any) -> bool:
    """Whether a condition is true for these numbers."""
    apart = value_at(explicit(condition.residual), point)
    if condition.mark in {"=", "!="}:
        return bool(apart == 0) == (condition.mark == "=")
    ahead = apart if condition.mark[0] == ">" else -apart
    return bool(ahead > 0 or ahead == 0 and condition.mark.endswith("="))


def points_as_assumed(letters: set[Any], seed: int) -> Iterator[Any]:
    """Points at which everything holds that the page assumes of these letters."""
    conditions = [with_numbers(each) for each in assumed() if letters_of(each.residual) <= letters]
    for point in islice(points(letters, seed), MANY):
        try:
            if all(is_so(each, point) for each in conditions):
                yield point
        except (Undefined, NoNumber):
            continue


def vanishes(facts: Judged) -> bool:
    return is_zero(facts.result)


def lasts(facts: Judged) -> bool:
    return not is_zero(facts.result)


def may_be_negative(letter: Any) -> bool:
    """Whether nothing is said against it: neither what the letter is nor a range."""
    return not letter.is_nonnegative and range_of(letter) is None


def turned(numbers: Mapping[Any, Expr], shift: int) -> dict[Any, Expr]:
    """The same numbers, some of the letters that may be negative being so: in turn all four ways of two neighbours."""
    signs = (-1 if may_be_negative(s) and shift >> i % 2 & 1 else 1 for i, s in enumerate(numbers))
    return fulfilling({s: sign * number for (s, number), sign in zip(numbers.items(), signs, strict=True)})


def never_vanishes(v: Any) -> bool:
    """Whether some component is a product of factors none of which can vanish."""
    return any(bool(tidied(entry).is_nonzero) for entry in v)


def same_equation(value: Expr, other: Expr) -> bool:
    """Whether one vanishes where the other does: they differ by a factor whose sign is known."""
    return is_zero(value) if is_zero(other) else sign_known(tidied(value / other)) in (1, -1)


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


def sign_where_it_exists(wanted: int, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    """The sign for the numbers that are given, or any in place of the letters that let the state of rest exist."""

    def is_so(facts: Judged) -> bool:
        return not is_zero(of(facts)) and _signs_where(of(facts), facts.inputs.get("exists")) == {wanted}

    return is_so


def _signs_where(value: Expr, exists: Relation | None) -> set[int]:
    value = with_numbers(value)
    condition = with_numbers(exists.residual) * (1 if exists.mark == ">" else -1) if exists is not None else Integer(1)
    letters = sorted(value.free_symbols | condition.free_symbols, key=str)
    found = set()
    for shift in range(24):
        numbers = turned({s: _number(s, i, shift) for i, s in enumerate(letters)}, shift)
        if condition.xreplace(numbers).evalf(30) > 0:
            found.add(1 if value.xreplace(numbers).evalf(30) > 0 else -1)
    return found


def _number(letter: Symbol, n: int, shift: int) -> Expr:
    """One large where another is small; within the range of the letter where it has one."""
    if (known := range_of(letter)) is not None:
        return known.at(Rational(1 + (3 * n + 5 * shift) % 7, 8))
    return Rational(prime(2 + (11 * n + 5 * shift + n * shift) % 29), 7 + n)
