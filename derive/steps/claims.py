"""Predicates of outcomes for the rules of every topic: whether the result vanishes, whether it has a sign."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from itertools import islice
from typing import Any

from sympy import (
    Expr,
    Integer,
    Mul,
    Rational,
    Symbol,
    factor,
    factor_terms,
    prime,
)

from derive.algebra.expressions import Relation, explicit
from derive.algebra.ranges import fulfilling, range_of, strict_sign_within
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assumed
from derive.steps.rule import Judged, Naming, Predicate
from derive.steps.signs import sign_known
from derive.steps.step import is_zero


def numbers_fulfil(wanted: bool) -> Predicate:
    """Decide the condition numerically, with the numbers substituted, in 30 digits."""
    truths = {
        "=": lambda d: d == 0,
        "<": lambda d: d < 0,
        ">": lambda d: d > 0,
        "<=": lambda d: d <= 0,
        ">=": lambda d: d >= 0,
    }

    def is_so(facts: Judged) -> bool:
        residual = explicit(facts.result.left) - explicit(facts.result.right)
        value = Integer(0) if is_zero(residual) else residual.evalf(30)
        return bool(truths[facts.inputs["condition"].operator](value)) == wanted

    return is_so


def of_numbers(wanted: str) -> Predicate:
    return lambda facts: (wanted == "measured") == bool(facts.inputs["letters"]) and "integral" not in facts.inputs


def bends(sign: int) -> Predicate:
    return lambda facts: sign * facts.inputs.get("curvature", Integer(0)).evalf(30) > 0


def value_of_role(facts: Judged, role: str) -> Any:
    return explicit(facts.inputs[role])


def as_told(predicate: Callable[[Judged, str], bool]) -> Naming:
    """Judge a named role by the predicate of the whole sentence."""
    return lambda facts, _: predicate(facts, "")


def parallel(one: Mapping[Any, Expr], other: Mapping[Any, Expr]) -> bool:
    """Whether two rows of numbers are proportional, and the second is not zero."""
    first = next((k for k, value in other.items() if not is_zero(value)), None)
    return first is not None and all(is_zero(one[k] * other[first] - one[first] * other[k]) for k in other)


TRIED, MANY = 12, 60  # points within the ranges; points among which some fulfil the assumptions


MARK_OF = {  # name of a comparison -> its sign
    "equal_to": "=",
    "different_from": "!=",
    "greater_than": ">",
    "less_than": "<",
    "at_least": ">=",
    "at_most": "<=",
}


def holds_at(condition: Relation, point: Any) -> bool:
    """Whether a condition is true for these numbers."""
    apart = value_at(explicit(condition.residual), point)
    if condition.operator in {"=", "!="}:
        return bool(apart == 0) == (condition.operator == "=")
    ahead = apart if condition.operator[0] == ">" else -apart
    return bool(ahead > 0 or ahead == 0 and condition.operator.endswith("="))


def points_as_assumed(letters: set[Any], seed: int) -> Iterator[Any]:
    """Yield points that fulfil every assumption of the page about these letters."""
    conditions = [with_numbers(each) for each in assumed() if letters_of(each.residual) <= letters]
    for point in islice(points(letters, seed), MANY):
        try:
            if all(holds_at(each, point) for each in conditions):
                yield point
        except (Undefined, NoNumber):
            continue


def vanishes(facts: Judged) -> bool:
    return is_zero(facts.result)


def lasts(facts: Judged) -> bool:
    return not is_zero(facts.result)


def may_be_negative(letter: Any) -> bool:
    """Whether the letter may be negative: it is not declared nonnegative, and it has no range."""
    return not letter.is_nonnegative and range_of(letter) is None


def turned(numbers: Mapping[Any, Expr], shift: int) -> dict[Any, Expr]:
    """Return the same numbers, some with a minus sign where the letter may be negative; over the shifts, two
    neighbours take all four combinations of signs."""
    signs = (-1 if may_be_negative(s) and shift >> i % 2 & 1 else 1 for i, s in enumerate(numbers))
    return fulfilling({s: sign * number for (s, number), sign in zip(numbers.items(), signs, strict=True)})


def never_vanishes(v: Any) -> bool:
    """Whether some component is a product of factors that cannot vanish."""
    return any(bool(tidied(entry).is_nonzero) for entry in v)


def same_equation(value: Expr, other: Expr) -> bool:
    """Whether the two vanish at the same places: they differ by a factor whose sign is known."""
    return is_zero(value) if is_zero(other) else sign_known(tidied(value / other)) in (1, -1)


def sign_is(wanted: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    return lambda facts: sign_known(of(facts)) == wanted


def always_sign(wanted: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    """Judge the sign by the letters and their ranges only, whatever numbers they have."""

    def is_so(facts: Judged) -> bool:
        value = tidied(of(facts))
        sign = 0 if is_zero(value) else 1 if value.is_positive else -1 if value.is_negative else _sign_in_ranges(value)
        return sign == wanted

    return is_so


def _sign_in_ranges(value: Expr) -> int | None:
    """Return the sign that follows from the ranges of the letters, if it is confirmed at numbers within them."""
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
    """Judge the sign at the given numbers, or at any numbers for which the equilibrium exists."""

    def is_so(facts: Judged) -> bool:
        return not is_zero(of(facts)) and _signs_where(of(facts), facts.inputs.get("exists")) == {wanted}

    return is_so


def _signs_where(value: Expr, exists: Relation | None) -> set[int]:
    value = with_numbers(value)
    condition = (
        with_numbers(exists.residual) * (1 if exists.operator == ">" else -1) if exists is not None else Integer(1)
    )
    letters = sorted(value.free_symbols | condition.free_symbols, key=str)
    found = set()
    for shift in range(24):
        numbers = turned({s: _number(s, i, shift) for i, s in enumerate(letters)}, shift)
        if condition.xreplace(numbers).evalf(30) > 0:
            found.add(1 if value.xreplace(numbers).evalf(30) > 0 else -1)
    return found


def _number(letter: Symbol, n: int, shift: int) -> Expr:
    """Return the number of a letter: large where that of another is small, and within its range if it has one."""
    if (known := range_of(letter)) is not None:
        return known.at(Rational(1 + (3 * n + 5 * shift) % 7, 8))
    return Rational(prime(2 + (11 * n + 5 * shift + n * shift) % 29), 7 + n)


POINTS = 24


def letters_in(value: Any) -> set[Any]:
    return set(explicit(value).free_symbols)


def is_a_root_just_where_told(facts: Judged) -> bool:
    """Whether the root is numerically real, and positive where required, exactly where the condition holds.
    Letters with a given number keep it: the number may decide what the condition leaves open.
    """
    told, given, value = facts.inputs.get("condition"), facts.inputs.get("existing"), explicit(facts.result)
    conditions = [explicit(each.residual) for each in (told, given) if each is not None]
    letters = letters_of(value).union(*map(letters_of, conditions))
    known = {letter: number for letter in letters if not (number := with_numbers(letter)).free_symbols}
    for drawn in islice(points(letters, seed_of(value)), POINTS):
        try:
            point = {**drawn, **known}
            number = value_at(value, point)
            if given is not None and not holds_at(given, point):
                continue
            is_root = bool(number.is_real) and (facts.inputs["positive"] == 0 or number > 0)
            if is_root != (told is None or holds_at(told, point)):
                return False
        except (Undefined, NoNumber):
            continue
    return True


def says_what_it_divides_by(facts: Judged, outcome: str) -> bool:
    """Whether the sentence excludes every factor of the denominator that might vanish; the first of several solutions
    does it for all."""
    below = factor_terms(explicit(facts.result)).as_numer_denom()[1]
    unsure = [f for f in Mul.make_args(factor(below)) if sign_known(f) is None and not f.as_base_exp()[0].is_nonzero]
    return not unsure or outcome == "following" or "excluded" in facts.inputs


def given_as_the_condition_has_it(facts: Judged, outcome: str) -> bool:
    """Whether the stated number is that of the letter, and fulfils the condition as the sentence says; in decimals."""
    condition = facts.inputs.get("condition")
    if condition is None:
        return "seen" not in facts.words
    told = facts.inputs["given"]
    apart = float(explicit(condition.left) - explicit(facts.result.right))
    is_so = {">": apart > 0, ">=": apart >= 0, "<": apart < 0, "<=": apart <= 0}[condition.operator]
    near = abs(float(explicit(told.right)) / float(explicit(condition.left)) - 1) < 0.05
    named = (told.left, told.operator) == (facts.result.left, "=")
    return near and named and is_so == (facts.words["seen"] == "fulfilled")


def not_negative(facts: Judged, outcome: str) -> bool:
    """Whether a period, a frequency or an amplitude is not negative; where its sign depends on the letters, the page
    states the condition."""
    return sign_known(facts.result) != -1


def nowhere_negative(facts: Judged, outcome: str) -> bool:
    """Whether a period or a radius is not negative for any numbers; its sign must not depend on the letters."""
    return not_negative(facts, outcome) and all(number >= 0 for number in real_numbers(facts))


def real_numbers(facts: Judged) -> Iterator[Expr]:
    value = explicit(facts.result)
    for point in islice(points(letters_of(value), seed_of(value)), POINTS):
        with suppress(Undefined, NoNumber):
            number = value_at(value, point)
            if number.is_real:
                yield number


def value_integrated(facts: Judged) -> bool:
    return bool("integral" in facts.inputs and bool(facts.result.is_positive))
