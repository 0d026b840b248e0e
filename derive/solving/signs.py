"""The sign of a product from the signs of its factors, and a difference of known sign in terms of its size."""

from __future__ import annotations

from sympy import Abs, Add, Expr, Integer, Mul, nan

from derive.algebra.expressions import Relation
from derive.algebra.ranges import strict_sign_within
from derive.steps.record import assumed
from derive.steps.step import is_zero

SIGNS_OF = {"=": (0,), "!=": (1, -1), ">": (1,), "<": (-1,), ">=": (0, 1), "<=": (0, -1)}  # mark -> signs


def of_the_size(value: Expr, mark: str) -> Expr:
    """The difference expected if the mark is right: the size of the value with the sign that the mark requires."""
    return {"=": Integer(0), ">": Abs(value), "<": -Abs(value)}.get(mark, nan)


def sign_by_factors(value: Expr) -> int | None:
    """The sign of a product from the signs of its factors, which are multiplied out if that shows the sign."""
    if is_zero(value):
        return 0
    found = 1
    for factor in Mul.make_args(value):
        base, power = factor.as_base_exp()
        forms = (factor, factor.expand()) if not power.is_Integer else (base**power, base.expand() ** power)
        if not any(form.is_positive or form.is_negative for form in forms):
            ranged = strict_sign_within(factor)
            if ranged is not None:
                found *= ranged
                continue
            if _is_square_that_lasts(base, power):
                continue
            by_means = _sign_by_means(forms[-1])
            if by_means is None:
                return None
            found *= by_means
            continue
        found *= -1 if any(form.is_negative for form in forms) else 1
    return found


def _is_square_that_lasts(base: Expr, power: Expr) -> bool:
    """Whether it is an even power of a real symbol in a denominator, or of one that is assumed not to vanish."""
    lasts = power.is_negative or Relation(base, "!=", Integer(0)) in assumed()
    return bool(base.is_Symbol and base.is_real and power.is_even and lasts)


def _sign_by_means(total: Expr) -> int | None:
    """1 if each negative term is at most twice the geometric mean of two positive terms: a^2 - 2 a b + b^2 + c.

    Each positive term is used at most once, and at least one must be left over.
    """
    terms = Add.make_args(total)
    above = [term for term in terms if term.is_positive]
    below = [term for term in terms if term.is_negative]
    if len(above) + len(below) < len(terms) or not 0 < len(below) < len(terms) / 2:
        return None
    for term in below:
        pairs = ((a, b) for i, a in enumerate(above) for b in above[i + 1 :])
        pair = next((pair for pair in pairs if (4 * Mul(*pair) / term**2 - 1).is_nonnegative), None)
        if pair is None:
            return None
        above = [each for each in above if each not in pair]
    return 1 if above else None
