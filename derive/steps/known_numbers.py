"""The numbers behind the letters of a problem, for the few verbs that must know what the case is.

A derivation stays symbolic; but whether a top spins fast enough is a question about numbers. While a script runs, the
ranges of its letters and the numbers that its problem gives are known here, and `sign_known` takes them where the
letters alone do not decide.
"""

from __future__ import annotations

from math import prod
from typing import Any

from sympy import Abs, Add, Expr, Mul, Pow

from derive.algebra.expressions import TIME, Relation, bound, explicit, rate
from derive.algebra.normal_form import vanishes
from derive.algebra.ranges import strict_sign_within
from derive.algebra.tidy import tidied
from derive.steps.outcomes import Doubt
from derive.steps.record import current_run, named_coordinates, question

DIGITS, SHORT = 30, 20
DECIDES = "ranges or numbers of the letters decide whether"  # before a relation that is not known


@question
def with_numbers(expr: Expr) -> Expr:
    """The expression with the numbers behind its letters, as far as there are any."""
    run = current_run.get()
    return explicit(bound(explicit(expr), run.numbers if run else {}))


def sign_known(expr: Expr) -> int | None:
    """The sign of an expression, by its letters, their ranges or their numbers: 1, -1, 0; None if none decides."""
    factors = [_sign_of_factor(factor) for factor in Mul.make_args(tidied(expr))]
    if 0 in factors:
        return 0
    return None if None in factors else prod(sign for sign in factors if sign)


def undecided(value: Any) -> Doubt:
    """Which order of two things that stand in a value is not known, l < r_0; else that numbers speak against it."""
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
    return Doubt("with numbers for the letters the result is not always what the sentence says of it")


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
