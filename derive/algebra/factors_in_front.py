"""Write a sum of fractions as one fraction, with common factors in front of each sum; products of sums are not
multiplied out.

A product is stored as its number and its powers, (1/24, {u: 2, 13 u + 10 v: 1}), so that a common denominator and
common factors are found by comparing powers.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from math import gcd, lcm
from typing import NamedTuple

from sympy import Add, Expr, Function, Integer, Mul, Pow, Rational, S
from sympy.core.exprtools import decompose_power

__all__ = ["Product", "as_product", "fraction_of", "in_front", "product_of", "times", "written"]

Powers = dict[Expr, int]
Terms = dict[frozenset[tuple[Expr, int]], Rational]


class Product(NamedTuple):
    """A number times powers with positive or negative exponents."""

    number: Rational
    powers: Powers


def in_front(value: Expr) -> Expr:
    """Take common factors of the terms to the front: 13/24 a u + 10/24 a v becomes a (13 u + 10 v)/24."""
    return written(product_of(value))


def written(product: Product) -> Expr:
    """The product as one fraction."""
    top, below = fraction_of(product)
    return Mul(top, Pow(below, -1))


def fraction_of(product: Product) -> tuple[Expr, Expr]:
    """The numerator and the denominator; at most half of the terms of a sum in the denominator have a minus sign."""
    number, powers = product
    above, below = [], []
    for base, power in powers.items():
        if power > 0:
            above.append(_power(base, power))
        else:
            if base.is_Add and 2 * sum(term.could_extract_minus_sign() for term in base.args) > len(base.args):
                base, number = -base, -number if power % 2 else number
            below.append(_power(base, -power))
    return _with_number(Integer(number.p), above), _with_number(Integer(number.q), below)


def as_product(product: Product) -> Expr:
    """The product with its number in front of a sum, (u + v)/2 and not u/2 + v/2, and with only one power of each
    symbol."""
    exponents: dict[Expr, Expr] = {}
    for factor, power in product.powers.items():
        base, exponent = factor.as_base_exp()
        exponents[base] = exponents.get(base, S.Zero) + exponent * power
    return _with_number(product.number, [Pow(*each) for each in exponents.items()])


def _with_number(number: Rational, factors: list[Expr]) -> Expr:
    found = Mul(*factors)
    if not found.is_Add or number == 1:
        return Mul(number, found)
    if number < 0 and any(term.could_extract_minus_sign() for term in found.args):
        number, found = -number, -found
    return found if number == 1 else Mul(number, found, evaluate=False)


def _power(base: Expr, power: int) -> Expr:
    return base if power == 1 else Pow(base, Integer(power))


@lru_cache(maxsize=4096)
def product_of(value: Expr) -> Product:
    """Split the value into its number and its powers, including the common factors of its sums."""
    if value.is_Rational:
        return Product(value, {})
    if value.is_Add:
        return _sum([product_of(term) for term in value.args])
    if value.is_Mul:
        return times(product_of(factor) for factor in value.args)
    if isinstance(value, Pow) and value.exp.is_Integer:
        n = int(value.exp)
        number, powers = product_of(value.base)
        if number == 0 and n < 0:
            return Product(S.One, {value: 1})
        return Product(number**n, {base: power * n for base, power in powers.items()})
    if isinstance(value, Pow):
        above, below = Pow(in_front(value.base), value.exp).as_numer_denom()
        parts = [(part, sign) for side, sign in ((above, 1), (below, -1)) for part in Mul.make_args(side)]
        return times(_root(part, sign) for part, sign in parts)
    return _function(value) if isinstance(value, Function) else Product(S.One, {value: 1})


def _function(value: Function) -> Product:
    args = [in_front(arg) if isinstance(arg, Expr) and not _is_of_letters(arg) else arg for arg in value.args]
    found = value if args == list(value.args) else value.func(*args)
    return _root(found, 1) if isinstance(found, Function) else product_of(found)


def _is_of_letters(angle: Expr) -> bool:
    return all(term.as_coeff_Mul()[1].is_Atom for term in Add.make_args(angle))


def _root(value: Expr, sign: int) -> Product:
    """The value as a product, or 1/value if `sign` is -1: x^(3/2) is the third power of the root of x."""
    if value.is_Rational:
        return Product(value**sign, {})
    base, power = decompose_power(value)
    return Product(S.One, {base: sign * power})


def times(products: Iterable[Product]) -> Product:
    number: Rational = S.One
    powers: Powers = {}
    for each in products:
        number *= each.number
        for base, power in each.powers.items():
            powers[base] = powers.get(base, 0) + power
    return Product(number, {base: power for base, power in powers.items() if power})


def _sum(products: list[Product]) -> Product:
    front, terms = _apart(products)
    while any(_is_one_sum(powers) for powers in terms):  # 2 (a + b) next to other terms is split into its terms
        inner = [(Product(number, {}), each) for powers, number in terms.items() for each in _terms_of(powers)]
        more, terms = _apart([times(pair) for pair in inner])
        front = times((front, more))
    if len(terms) < 2:
        return front if terms else Product(S.Zero, {})
    total = Add(*(Mul(number, *(_power(*each) for each in powers)) for powers, number in terms.items()))
    return times((front, Product(S.One, {total: 1})))


def _terms_of(powers: frozenset[tuple[Expr, int]]) -> list[Product]:
    return (
        [product_of(term) for sum_of, _ in powers for term in sum_of.args]
        if _is_one_sum(powers)
        else [Product(S.One, dict(powers))]
    )


def _is_one_sum(powers: frozenset[tuple[Expr, int]]) -> bool:
    return len(powers) == 1 and all(power == 1 and base.is_Add for base, power in powers)


def _apart(products: list[Product]) -> tuple[Product, Terms]:
    terms: Terms = {}
    for number, powers in products:
        key = frozenset(powers.items())
        terms[key] = terms.get(key, S.Zero) + number
    terms = {powers: number for powers, number in terms.items() if number}
    if not terms:
        return Product(S.Zero, {}), {}
    each = [dict(powers) for powers in terms]
    bases = {base for powers in each for base in powers}
    shared = {base: min(powers.get(base, 0) for powers in each) for base in bases}
    numbers = list(terms.values())
    content = Rational(gcd(*(n.p for n in numbers)), lcm(*(n.q for n in numbers)))
    if all(n < 0 for n in numbers):
        content = -content
    rest: Terms = {}
    for powers, number in zip(each, numbers, strict=True):
        left = {base: powers.get(base, 0) - shared[base] for base in bases}
        rest[frozenset((base, n) for base, n in left.items() if n)] = number / content
    return Product(content, {base: n for base, n in shared.items() if n}), rest
