"""The numerical values of a problem's symbols, for the few verbs that need them to decide between cases.

A derivation stays symbolic, but whether a top spins fast enough is a question about numbers. While a script runs, the
ranges of its symbols and the numbers that its problem gives are known here. The function `sign_known` uses them if the
symbols alone do not decide.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import prod
from typing import Any

from sympy import Abs, Add, Expr, Integer, Mul, Pow, factor_list, lcm
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import TIME, Relation, bound, explicit, rate
from derive.algebra.lowest_terms import factored
from derive.algebra.normal_form import vanishes
from derive.algebra.ranges import strict_sign_within, take_as_positive, taken_as_positive
from derive.algebra.tidy import tidied
from derive.steps.record import assume, current_run, named_coordinates, question
from derive.steps.rule import Doubt

DIGITS, SHORT = 30, 20
DECIDES = "give ranges or numbers of the letters that decide whether"  # an unknown relation follows


@question
def with_numbers(expr: Expr) -> Expr:
    """Substitute the numbers that the problem gives for symbols of the expression."""
    run = current_run.get()
    return explicit(bound(explicit(expr), run.numbers if run else {}))


def have_numbers(*values: Any) -> bool:
    """Whether the problem gives a number for each symbol of these vectors."""
    return not any(with_numbers(entry).free_symbols for value in values for entry in value)


def sign_known(expr: Expr) -> int | None:
    """Return the sign of an expression, by its symbols, their ranges or their numbers: 1, -1 or 0; None if unknown."""
    factors = [_sign_of_factor(factor) for factor in Mul.make_args(tidied(expr))]
    if 0 in factors:
        return 0
    return None if None in factors else prod(sign for sign in factors if sign)


def undecided(value: Any) -> Doubt:
    """Return the reason for a doubt: the unknown order of two terms in the value, l < r_0; else contrary numbers."""
    parts = value.sides if isinstance(value, Relation) else list(value) if hasattr(value, "shape") else [value]
    exprs = [explicit(part) for part in parts if isinstance(part, Expr)]
    sizes = [size.args[0] for expr in exprs for size in expr.atoms(Abs)]
    factors = [f.as_base_exp()[0] for expr in exprs for part in expr.as_numer_denom() for f in Mul.make_args(part)]
    moving = {s for q in named_coordinates() for s in (q, rate(q), rate(q, 2))} | {TIME}
    for each in [*sizes, *factors]:
        is_constant = isinstance(each, Add) and moving.isdisjoint(each.free_symbols)
        if is_constant and each.count_ops() <= SHORT and sign_known(each) is None:
            away = [-term for term in each.args if term.could_extract_minus_sign()]
            sides = Add(*away), Add(*(term for term in each.args if -term not in away))
            relation = " < ".join(sorted(map(str, sides), key=lambda side: (len(side), side)))
            return Doubt(f"whether {relation} is not known", f"{DECIDES} {relation}")
    return Doubt("numerically the result does not always agree with the sentence")


def _sign_of_factor(factor: Expr) -> int | None:
    if vanishes(factor):
        return 0
    if factor.is_positive:
        return 1
    if factor.is_negative:
        return -1
    if isinstance(factor, Pow) and not factor.exp.is_Integer and factor.exp.is_real:
        return 1 if sign_known(factor.base) == 1 else None
    ranged = strict_sign_within(factor)
    if ranged is not None:
        return ranged
    value = with_numbers(factor)
    if value.free_symbols or not value.is_real:
        return None
    if vanishes(value):
        return 0
    approximate = value.evalf(DIGITS)
    return 1 if approximate > 0 else -1


def may_vanish(*values: Expr) -> Relation | None:
    """Return the condition for dividing by these values: their factors of unknown sign must not vanish."""
    factors = [f.as_base_exp()[0] for value in values for f in Mul.make_args(factored(tidied(value)))]
    unsure = [f for f in dict.fromkeys(factors) if sign_known(f) is None and not f.is_nonzero]
    return Relation(Mul(*unsure), "!=", Integer(0)) if unsure else None


def told_of_divisors(values: Iterable[Expr]) -> dict[str, tuple[Relation, Relation]]:
    """Return the condition that a sentence states on the denominators: the factors that might vanish must not."""
    below: Expr = Integer(1)
    for value in values:
        below = lcm(below, tidied(value).as_numer_denom()[1])
    excluded = may_vanish(below) if below.free_symbols else None
    return {} if excluded is None else {"excluded": (excluded, Relation(excluded.right, "!=", excluded.left))}


def taken_positive(value: Expr) -> int | None:
    """Return the sign of a value; if it is unknown, assume that the value is positive, and let the page state this."""
    sign = 1 if tidied(value) in taken_as_positive() else sign_known(value)
    if sign is not None:
        return sign
    open_factors = [factor for factor in _factors(tidied(value)) if sign_known(factor) != 1]
    for each in open_factors if len(open_factors) == 1 else [Mul(*open_factors)]:
        away = Add(*(-term for term in Add.make_args(each) if term.could_extract_minus_sign()))
        take_as_positive(each)
        assume(Relation(each + away, ">", away))
    take_as_positive(tidied(value))
    return 1


def _factors(value: Expr) -> list[Expr]:
    """Return the factors without numbers and even powers; their product has the sign of the value."""
    try:
        number, found = factor_list(value)
    except PolynomialError:
        return list(Mul.make_args(value))
    factors = [base for base, power in found if power % 2]
    if number.is_negative and factors:
        factors[0] = -factors[0]
    return factors or [Integer(1)]
