"""What must be true for each word that chooses a sentence about roots, conditions and numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from sympy import Expr, Integer, Rational, Symbol, prime

from derive.algebra.expressions import explicit
from derive.algebra.ranges import rational_in_range
from derive.mechanics.outcomes.signs import always_sign, sign_is, turned
from derive.steps.known_numbers import sign_known, with_numbers
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _some_points(letters: Iterable[Symbol]) -> Iterable[dict[Symbol, Expr]]:
    """Numbers for the letters, from one scale to another and of both signs; in the range of one that has some."""
    ordered = sorted(letters, key=str)
    for shift in range(12):
        drawn = (Rational(prime(5 + (7 * i + 3 * shift) % 23), 2 + (i + shift) % 5) for i in range(len(ordered)))
        yield turned({s: rational_in_range(s, number) for s, number in zip(ordered, drawn, strict=True)}, shift)


def _two_roots(facts: Judged) -> Iterable[tuple[Expr, Expr, Expr]]:
    """This root, the other and the factor b, in numbers for which the roots are real: those that are given, and some
    for each letter that has none."""
    quadratic = facts.inputs["quadratic"]
    other = -quadratic.b / quadratic.a - facts.result
    this, other, b, discriminant = map(with_numbers, (facts.result, other, quadratic.b, quadratic.discriminant))
    letters = set().union(*(each.free_symbols for each in (this, other, b, discriminant)))
    for point in _some_points(letters) if letters else ({},):
        if discriminant.xreplace(point).evalf(30) > 0 or not letters:
            yield tuple(each.xreplace(point).evalf(30) for each in (this, other, b))


def _roots_fit(test: Callable[[Expr, Expr, Expr], Any]) -> Predicate:
    def is_so(facts: Judged) -> bool:
        seen = list(_two_roots(facts))
        return bool(seen) and all(bool(test(*numbers)) for numbers in seen)

    return is_so


_SMALLER = _roots_fit(lambda this, other, b: abs(this) < abs(other) and this * other > 0)


_LARGER = _roots_fit(lambda this, other, b: abs(this) > abs(other) and this * other > 0)


def _whether(real: bool, predicate: Predicate) -> Predicate:
    """The roots are known to be real, or that is not known."""
    return lambda facts: (sign_known(facts.inputs["quadratic"].discriminant) == 1) == real and predicate(facts)


def _roots(discriminant: int | None, product: int | None = 1) -> Predicate:
    """By the sign of the discriminant, and of the product of the roots where it is positive."""

    def is_so(facts: Judged) -> bool:
        q = facts.inputs["quadratic"]
        if is_zero(q.a) or sign_known((q.b / q.a) ** 2 - 4 * q.c / q.a) != discriminant:
            return False
        opposite = sign_known(q.c / q.a) == -1
        return discriminant != 1 or opposite == (product == -1)

    return is_so


def _linear(facts: Judged) -> bool:
    return is_zero(facts.inputs["quadratic"].a)


def _solved(squared: bool) -> Predicate:
    """A letter stands alone on the left, or its square; it is not on the right."""

    def is_so(facts: Judged) -> bool:
        left, right = facts.result.sides
        alone = left.base if squared and left.is_Pow else left
        return isinstance(alone, Symbol) and left.is_Pow == squared and not right.has(alone)

    return is_so


def _of_known_sign(sign: int) -> Predicate:
    return always_sign(sign, lambda facts: facts.inputs["quantity"])


def _numbers_fulfil(wanted: bool) -> Predicate:
    """The condition with the numbers put in, decided in 30 digits."""
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
        return bool(truths[facts.inputs["condition"].mark](value)) == wanted

    return is_so


def _of_numbers(wanted: str) -> Predicate:
    return lambda facts: (wanted == "measured") == bool(facts.inputs["letters"]) and "integral" not in facts.inputs


def _bends(sign: int) -> Predicate:
    return lambda facts: sign * facts.inputs.get("curvature", Integer(0)).evalf(30) > 0


_TABLE: dict[str, dict[str, Predicate]] = {
    "answers.one_of_two": {
        "smaller": _whether(True, _SMALLER),
        "larger": _whether(True, _LARGER),
        "smaller_where_real": _whether(False, _roots_fit(lambda this, other, b: abs(this) < abs(other))),
        "larger_where_real": _whether(False, _roots_fit(lambda this, other, b: abs(this) > abs(other))),
        "nearer": _roots_fit(lambda this, other, b: this * other < 0 and abs(this) < abs(other)),
        "farther": _roots_fit(lambda this, other, b: this * other < 0 and abs(this) > abs(other)),
        "coinciding": lambda facts: sign_known(facts.inputs["quadratic"].discriminant) == 0,
        "none": lambda facts: sign_known(facts.inputs["quadratic"].discriminant) == -1,
    },
    "answers.roots_together": {
        "two": _roots(1),
        "opposite": _roots(1, product=-1),
        "none": _roots(-1),
        "double": _roots(0),
        "conditional": _roots(None),
        "linear": _linear,
    },
    "answers.discriminant": {
        "positive": sign_is(1),
        "negative": sign_is(-1),
        "vanishing": sign_is(0),
        "conditional": sign_is(None),
        "linear": _linear,
    },
    "numeric.value": {
        "exact": _of_numbers("exact"),
        "measured": _of_numbers("measured"),
        "integrated": lambda facts: "integral" in facts.inputs and bool(facts.result.is_positive),
        "minimum": _bends(1),
        "maximum": _bends(-1),
    },
    "numeric.comparison": {"fulfilled": _numbers_fulfil(True), "not_fulfilled": _numbers_fulfil(False)},
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
