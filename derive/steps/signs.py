"""Decide the sign of an expression.

Several methods are tried:

    exact zero         the normal form of the expression
    factors            for each factor, as written and expanded, the assumptions on its symbols
    ranges, relations  for each factor, the ranges of its symbols and the assumed relations between them
    squares, roots     even powers that do not vanish, sums that are positive by the AM-GM inequality, and roots
    numbers            the numbers that the problem gives for the symbols, only in `sign_known`

A derivation stays symbolic: the numbers only decide a sign, for example whether a top spins fast enough.
"""

from __future__ import annotations

from math import prod
from typing import Any

from sympy import Abs, Add, Dummy, Expr, Integer, Mul, Pow, Rational, expand, factor, factor_list, ilcm, nan, together
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import TIME, Relation, explicit, rate
from derive.algebra.normal_form import vanishes
from derive.algebra.order import Contradiction, in_order, known_order
from derive.algebra.ranges import sign_within, strict_sign_within, take_as_positive, taken_as_positive
from derive.algebra.relation import sides_without_minus
from derive.algebra.tidy import tidied
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assume, assumed, named_coordinates
from derive.steps.rule import Doubt
from derive.steps.step import is_zero

DIGITS, SHORT, HALF = 30, 20, Rational(1, 2)
# relation sign -> signs of (left - right) for which the relation holds
SIGNS_OF = {"=": (0,), "!=": (1, -1), ">": (1,), "<": (-1,), ">=": (0, 1), "<=": (0, -1)}
DECIDES = "give ranges or numbers for the letters, to decide whether"  # a help line: these words, then a relation


def sign_for_all(value: Expr) -> int | None:
    """Return the sign for all allowed values of the symbols, without the given numbers: 1, -1 or 0; None if unknown."""
    return _sign_of_product(value, by_numbers=False)


def sign_known(value: Expr) -> int | None:
    """Return the sign, 1, -1 or 0; None if unknown. If the assumptions on the symbols do not decide, the given numbers
    are used."""
    return _sign_of_product(tidied(value), by_numbers=True)


def sign_beside_root(value: Expr) -> int | None:
    """Return the sign of a ratio of sums P + Q sqrt(D); None if it is unknown.

    The square roots must be real. If P^2 is less than Q^2 D, the sum P + Q sqrt(D) has the sign of Q. If P^2 is
    greater, the sum has the sign of P.
    """
    own = sign_known(value)
    if own is not None:
        return own
    signs = [_sign_of_sum_with_root(part) for part in together(value).as_numer_denom()]
    return None if None in signs else prod(sign for sign in signs if sign is not None)


def _sign_of_sum_with_root(value: Expr) -> int | None:
    own = sign_known(value)
    roots = [each for each in value.atoms(Pow) if each.exp == HALF and not each.base.is_number]
    if own is not None or not roots:
        return own
    marks = {root: Dummy("s") for root in roots}
    terms = value.xreplace(marks).as_poly(*marks.values())
    powers = terms.as_dict() if terms is not None else {}
    p = powers.pop((0,) * len(roots), None)
    if p is None or len(powers) != 1:
        return None
    ((exponents, q),) = powers.items()
    square = Mul(*(root.base**n for root, n in zip(roots, exponents, strict=True)))
    greater = sign_known(factor(expand(p**2 - q**2 * square)))
    return sign_known(factor(p if greater == 1 else q)) if greater in (1, -1) and max(exponents) == 1 else None


def sign_where(value: Expr, exists: Relation | None) -> int | None:
    """Return the sign for all values of the symbols for which the condition holds; None if this sign is unknown."""
    own = sign_for_all(value)
    if own is not None or exists is None or exists.operator[0] not in "<>":
        return own
    difference = exists.residual if exists.operator[0] == ">" else -exists.residual
    try:
        order = known_order().with_relation(difference, not exists.operator.endswith("="), sign_within)
    except Contradiction:
        return None
    with in_order(order):
        return sign_for_all(value)


def truth_known(relation: Relation | None) -> bool | None:
    """Return whether the relation is true; None if this is unknown. A missing relation counts as true."""
    sign = sign_known(relation.residual) if relation is not None else 0
    return relation is None or (None if sign is None else sign in SIGNS_OF[relation.operator])


def _sign_of_product(value: Expr, by_numbers: bool) -> int | None:
    if is_zero(value):
        return 0
    signs = [_sign_of_factor(factor, by_numbers) for factor in Mul.make_args(value)]
    if 0 in signs:
        return 0
    return None if None in signs else prod(sign for sign in signs if sign)


def _sign_of_factor(factor: Expr, by_numbers: bool) -> int | None:
    base, power = factor.as_base_exp()
    forms = (factor, factor.expand()) if not power.is_Integer else (base**power, base.expand() ** power)
    if any(form.is_positive or form.is_negative for form in forms):
        return -1 if any(form.is_negative for form in forms) else 1
    if (ranged := strict_sign_within(factor)) is not None:
        return ranged
    if (powers := _difference_of_powers(factor)) is not None:
        return _sign_of_product(powers, by_numbers)
    if _is_square_that_lasts(base, power) or _is_positive_by_means(forms[-1]):
        return 1
    if not power.is_Integer and power.is_real and _sign_of_product(base, by_numbers) == 1:
        return 1
    return _sign_by_numbers(factor) if by_numbers else None


def _difference_of_powers(value: Expr) -> Expr | None:
    """For a difference a - b of positive terms with nth roots, such as l^(2/3) - c^(2/3), return a^n - b^n, which has
    the same sign. Return None for any other expression."""
    terms = Add.make_args(value)
    roots = [power for power in value.atoms(Pow) if power.exp.is_Rational and not power.exp.is_Integer]
    if len(terms) != 2 or not roots or any(power.base.is_Add for power in roots):
        return None
    signs = [1 if term.is_positive else -1 if term.is_negative else 0 for term in terms]
    if sorted(signs) != [-1, 1]:
        return None
    n = ilcm(1, *(power.exp.q for power in roots))
    return tidied(Add(*(sign * (sign * term) ** n for sign, term in zip(signs, terms, strict=True))))


def _is_square_that_lasts(base: Expr, power: Expr) -> bool:
    """Whether a factor is an even power of a real symbol, and either the power is negative or the symbol is assumed not
    to vanish."""
    lasts = power.is_negative or Relation(base, "!=", Integer(0)) in assumed()
    return bool(base.is_Symbol and base.is_real and power.is_even and lasts)


def _is_positive_by_means(total: Expr) -> bool:
    """Whether a sum is positive by the AM-GM inequality, as a^2 - 2 a b + b^2 + c is.

    The magnitude of each negative term must be at most twice the geometric mean of two positive terms. No two negative
    terms may use the same positive term, and at least one positive term must be left over.
    """
    terms = Add.make_args(total)
    above = [term for term in terms if term.is_positive]
    below = [term for term in terms if term.is_negative]
    if len(above) + len(below) < len(terms) or not 0 < len(below) < len(terms) / 2:
        return False
    for term in below:
        pairs = ((a, b) for i, a in enumerate(above) for b in above[i + 1 :])
        pair = next((pair for pair in pairs if (4 * Mul(*pair) / term**2 - 1).is_nonnegative), None)
        if pair is None:
            return False
        above = [each for each in above if each not in pair]
    return bool(above)


def _sign_by_numbers(expr: Expr) -> int | None:
    """Return the sign of an expression at the given numbers; None if a symbol has no number, or if the value is not
    real."""
    value = with_numbers(expr)
    if value.free_symbols or not value.is_real:
        return None
    if vanishes(value):
        return 0
    return 1 if value.evalf(DIGITS) > 0 else -1


def taken_positive(value: Expr) -> int | None:
    """Return the sign of a value. If it is unknown, assume that the value is positive or, for a number times
    squares, that no square is zero."""
    sign = 1 if tidied(value) in taken_as_positive() else sign_known(value)
    if sign is not None:
        return sign
    number, factors = _factors(tidied(value))
    odd = [base for base, power in factors if power % 2]
    if not odd:
        for base, _ in factors:
            assume(Relation(base, "!=", Integer(0)))
        return -1 if number.is_negative else 1
    if number.is_negative:
        odd[0] = -odd[0]
    open_factors = [factor for factor in odd if sign_known(factor) != 1]
    for each in open_factors if len(open_factors) == 1 else [Mul(*open_factors)]:
        more, less = sides_without_minus(each)
        take_as_positive(each)
        assume(Relation(more, ">", less))
    take_as_positive(tidied(value))
    return 1


def _factors(value: Expr) -> tuple[Expr, list[tuple[Expr, int]]]:
    """Return the number in front, and each other factor with its power."""
    try:
        number, found = factor_list(value)
    except PolynomialError:
        return Integer(1), [(factor, 1) for factor in Mul.make_args(value)]
    return number, found


def undecided(value: Any) -> Doubt:
    """Return the reason why a sentence is not confirmed, such as an unknown order l < r_0 of two terms in the value."""
    parts = value.sides if isinstance(value, Relation) else list(value) if hasattr(value, "shape") else [value]
    exprs = [explicit(part) for part in parts if isinstance(part, Expr)]
    sizes = [size.args[0] for expr in exprs for size in expr.atoms(Abs)]
    factors = [f.as_base_exp()[0] for expr in exprs for part in expr.as_numer_denom() for f in Mul.make_args(part)]
    moving = {s for q in named_coordinates() for s in (q, rate(q), rate(q, 2))} | {TIME}
    for each in [*sizes, *factors]:
        is_constant = isinstance(each, Add) and moving.isdisjoint(each.free_symbols)
        if is_constant and each.count_ops() <= SHORT and sign_known(each) is None:
            relation = " < ".join(sorted(map(str, sides_without_minus(each)), key=lambda side: (len(side), side)))
            return Doubt(f"it is not known whether {relation}", f"{DECIDES} {relation}")
    return Doubt("the result is not known to agree with the sentence")


# --- numbers ---


def holds(number: Expr | int, mark: str) -> bool:
    """Whether the relation of a number to zero is true; `mark` is the relation sign, such as > in `number > 0`."""
    return (0 if number == 0 else 1 if number > 0 else -1) in SIGNS_OF[mark]


def of_the_size(value: Expr, mark: str) -> Expr:
    """Return a difference with the sign that its relation to zero requires: the absolute value for >, minus the
    absolute value for <, zero for =. If the relation is true, this is the difference itself."""
    return {"=": Integer(0), ">": Abs(value), "<": -Abs(value)}.get(mark, nan)
