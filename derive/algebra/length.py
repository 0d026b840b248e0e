"""The written length of an expression: the number of its operation signs, fraction bars, powers and functions, counted
as by SymPy's `count_ops`.

Lengths of parts are cached, because several forms of one value have most parts in common.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

from sympy import E, Expr, Integer, Mul, Pow

__all__ = ["length", "shortest"]


def shortest(forms: Iterable[Expr]) -> Expr:
    """Return the shortest form; among equally short forms, the first in the order of their texts."""
    lengths = {form: length(form) for form in forms}
    least = min(lengths.values())
    return min((form for form, long in lengths.items() if long == least), key=_Text)


class _Text:
    def __init__(self, value: Expr) -> None:
        self.value = value

    def __lt__(self, other: _Text) -> bool:
        return str(self.value) < str(other.value)


@lru_cache(maxsize=16384)
def length(value: Expr) -> int:
    if value.is_Rational:
        return int(value.p < 0) + int(value.q != 1)
    if value.is_Add:
        negative = [_is_negative(term) for term in value.args]
        terms = (length(-term if turned else term) for term, turned in zip(value.args, negative, strict=True))
        return sum(terms) + len(negative) - 1 + all(negative)
    if value.is_Mul:
        return 1 + length(-value) if _is_negative(value) else _of_fraction(value)
    if isinstance(value, Pow) and value.exp == -1:
        return 1 + length(value.base)
    if isinstance(value, Pow) and value.base is E:
        return 1 + length(value.exp)
    counts = value.is_Pow or value is E or value.args and not value.is_Atom
    return int(bool(counts)) + sum(length(part) for part in value.args)


def _is_negative(term: Expr) -> bool:
    number = term.args[0] if term.is_Mul else term
    return bool(number.is_Number and number.is_negative)


def _of_fraction(value: Expr) -> int:
    above: list[Expr] = []
    below: list[Expr] = []
    for factor in value.args:
        if factor.is_Rational:
            above += [Integer(factor.p)] if factor.p != 1 else []
            below += [Integer(factor.q)] if factor.q != 1 else []
        elif factor.is_Pow and _is_negative(factor.exp):
            below.append(Pow(factor.base, -factor.exp))
        else:
            above.append(factor)
    return _of_product(above) + 1 + _of_product(below) if below else _of_factors(above)


def _of_product(factors: list[Expr]) -> int:
    """The length of a numerator or denominator. SymPy multiplies a number into a sum if the product has no other
    factors."""
    is_put_in = len(factors) == 2 and factors[0].is_Rational and factors[1].is_Add
    return length(Mul(*factors)) if is_put_in else _of_factors(factors)


def _of_factors(factors: list[Expr]) -> int:
    return max(len(factors) - 1, 0) + sum(map(length, factors))
