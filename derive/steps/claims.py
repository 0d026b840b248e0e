"""Predicates that rules of several topics use to judge an outcome."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, ParamSpec

from sympy import (
    Expr,
    Integer,
    Mul,
    factor,
    factor_terms,
)

from derive.algebra.expressions import explicit
from derive.algebra.ranges import strict_sign_within
from derive.algebra.samples import letters_of
from derive.algebra.tidy import tidied
from derive.steps.known_numbers import with_numbers
from derive.steps.rule import Doubt, Judged, Naming, Predicate
from derive.steps.signs import sign_known
from derive.steps.step import is_zero
from derive.steps.trial_numbers import just_where, sign_at, sign_found, signs_of

Asked = ParamSpec("Asked")


def numbers_fulfil(wanted: bool) -> Predicate:
    """Judge whether a condition between numbers is true or, if `wanted` is False, whether it is false."""
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
    """Use a predicate of the whole sentence to judge an object that the sentence names."""
    return lambda facts, _: predicate(facts, "")


def parallel(one: Mapping[Any, Expr], other: Mapping[Any, Expr]) -> bool:
    """Whether the first row of values is a multiple of the second row, which must not be zero."""
    first = next((k for k, value in other.items() if not is_zero(value)), None)
    return first is not None and all(is_zero(one[k] * other[first] - one[first] * other[k]) for k in other)


MARK_OF = {  # name of a comparison -> the relation sign between its two sides
    "equal_to": "=",
    "different_from": "!=",
    "greater_than": ">",
    "less_than": "<",
    "at_least": ">=",
    "at_most": "<=",
}


def both(*predicates: Callable[Asked, bool | Doubt]) -> Callable[Asked, bool]:
    """Return a predicate that is true if all these predicates are true."""
    return lambda *judged, **more: all(predicate(*judged, **more) for predicate in predicates)


def negated(predicate: Predicate) -> Predicate:
    return lambda facts: not predicate(facts)


def vanishing(role: str) -> Predicate:
    """Judge whether the input with this role is zero."""
    return lambda facts: is_zero(facts.inputs[role])


def vanishes(facts: Judged) -> bool:
    return is_zero(facts.result)


def lasts(facts: Judged) -> bool:
    return not is_zero(facts.result)


def never_vanishes(v: Any) -> bool:
    """Whether a component of a vector is known to be nonzero, so that the vector never vanishes."""
    return any(bool(tidied(entry).is_nonzero) for entry in v)


def same_equation(value: Expr, other: Expr) -> bool:
    """Whether two expressions are known to have the same zeros, because they are equal or their ratio never
    vanishes."""
    return is_zero(value - other) or not is_zero(other) and not may_be_zero(tidied(value / other))


def sign_is(wanted: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    return lambda facts: has_sign(of(facts), wanted)


def has_sign(value: Expr, wanted: int | None) -> bool:
    """Whether the sign of a value is known and equals `wanted`; if `wanted` is None, whether the sign is unknown.

    Trial numbers must confirm the sign, but they are not enough: (a - b)^2 vanishes where a = b, but perhaps
    at no trial point.
    """
    return sign_known(value) == wanted and (wanted is None or sign_found(value) == wanted)


def is_negative(value: Expr) -> bool:
    """Whether the value is known to be negative, or is negative at all trial numbers."""
    return -1 in (sign_known(value), sign_found(value))


def may_be_zero(value: Expr) -> bool:
    sign = sign_known(value)
    return sign in (None, 0) or sign_found(value) != sign


def always_sign(wanted: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    """Judge the sign by the assumptions on the symbols and by their ranges, without the given numbers."""

    def is_so(facts: Judged) -> bool:
        value = tidied(of(facts))
        sign = 0 if is_zero(value) else 1 if value.is_positive else -1 if value.is_negative else _sign_in_ranges(value)
        return sign == wanted

    return is_so


def _sign_in_ranges(value: Expr) -> int | None:
    """Return the sign that follows from the ranges of the symbols, if trial numbers confirm this sign; otherwise
    None."""
    sign = strict_sign_within(value)
    return sign if sign is not None and signs_of(value) == {sign} else None


def sign_where_it_exists(wanted: int, of: Callable[[Judged], Expr] = lambda facts: facts.result) -> Predicate:
    """Judge the sign at all trial numbers for which the equilibrium exists; given numbers are substituted."""

    def is_so(facts: Judged) -> bool:
        conditions = [with_numbers(facts.inputs["exists"])] if "exists" in facts.inputs else []
        return not is_zero(of(facts)) and signs_of(with_numbers(of(facts)), *conditions) == {wanted}

    return is_so


def letters_in(value: Any) -> set[Any]:
    return set(explicit(value).free_symbols)


def is_a_root_just_where_told(facts: Judged) -> bool:
    """Whether the root is real, and positive if this is required, at exactly those trial numbers for which the stated
    condition holds."""
    value = with_numbers(facts.result)
    told, given = ([with_numbers(facts.inputs[r])] if r in facts.inputs else [] for r in ("condition", "existing"))
    allowed = {1, 0, -1} if facts.inputs["positive"] == 0 else {1}
    return just_where(told, lambda point: sign_at(value, point) in allowed, letters_of(value), *given)


def says_what_it_divides_by(facts: Judged, outcome: str) -> bool:
    """Whether the sentence excludes the zeros of the denominator, if there may be any. Only the sentence of the first
    of several solutions needs to do so."""
    below = factor_terms(explicit(facts.result)).as_numer_denom()[1]
    unsure = [f for f in Mul.make_args(factor(below)) if may_be_zero(f) and not f.as_base_exp()[0].is_nonzero]
    return not unsure or outcome == "following" or "excluded" in facts.inputs


def given_as_the_condition_has_it(facts: Judged, outcome: str) -> bool:
    """Judge what a sentence says about a symbol with a given number. The sentence must state this number to within 5
    percent. It must also be right about whether the number satisfies the condition."""
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
    """Return True unless the result, such as a period, a frequency or an amplitude, is known to be negative, or is
    negative for all trial numbers."""
    return not is_negative(facts.result)


def nowhere_negative(facts: Judged, outcome: str) -> bool:
    """Judge as `not_negative` does. The value must also be real at a trial point, and negative at none."""
    return not_negative(facts, outcome) and nowhere_negative_where_real(facts)


def nowhere_negative_where_real(facts: Judged) -> bool:
    found = signs_of(explicit(facts.result)) - {None}
    return bool(found) and -1 not in found


def value_integrated(facts: Judged) -> bool:
    return bool("integral" in facts.inputs and bool(facts.result.is_positive))
