"""Squares in readable form: a^2 - b^2 in place of (a + b)(a - b), and I + M (R - a)^2 in place of I + M R^2 - 2 M R a +
M a^2."""

from __future__ import annotations

from itertools import combinations

from sympy import Add, Expr, Mul, Pow, factor

MOST_TERMS = 8  # a longer sum is not searched for squares


def differences_of_squares(product: Expr) -> Expr:
    """Replace two factors u + v and u - v of a product by u^2 - v^2, if u and v are symbols, with or without a minus
    sign."""
    factors = list(Mul.make_args(product))
    for one, other in combinations(factors, 2):
        if not (_is_pair_of_letters(one) and _is_pair_of_letters(other)):
            continue
        u, v = (one + other) / 2, (one - other) / 2
        if _is_letter(u) and _is_letter(v):
            rest = [f for f in factors if f not in (one, other)]
            return differences_of_squares(Mul(*rest, Add(u**2, -(v**2))))
    return product


def _is_pair_of_letters(value: Expr) -> bool:
    return value.is_Add and len(value.args) == 2 and all(map(_is_letter, value.args))


def _is_letter(value: Expr) -> bool:
    return bool(value.is_Symbol or (-value).is_Symbol)


def with_squares(value: Expr) -> Expr:
    """Write three terms of a sum as a symbol times a square where possible: M R^2 - 2 M R a + M a^2 as M (R - a)^2."""
    terms = Add.make_args(value)
    if not 3 <= len(terms) <= MOST_TERMS:
        return value
    for letter in sorted(value.free_symbols, key=str):
        sharing = [term for term in terms if not (term / letter).has(letter)]
        inside = factor(Add(*(term / letter for term in sharing))) if len(sharing) == 3 else letter
        if any(_is_square_of_sum(f) for f in Mul.make_args(inside)):
            squares = Mul(*(_first_letter_first(f) for f in Mul.make_args(inside)))
            return Add(Mul(letter, squares), *(term for term in terms if term not in sharing))
    return value


def _first_letter_first(value: Expr) -> Expr:
    """Write a squared sum with its first symbol positive: (R - a)^2, not (a - R)^2."""
    if not _is_square_of_sum(value):
        return value
    first = min(value.base.args, key=lambda term: str(term.as_coeff_Mul()[1]))
    return Pow(-value.base if first.could_extract_minus_sign() else value.base, 2)


def _is_square_of_sum(value: Expr) -> bool:
    return isinstance(value, Pow) and value.exp == 2 and value.base.is_Add
