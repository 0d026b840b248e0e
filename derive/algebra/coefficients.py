"""The coefficients of an expression that is a polynomial in some of its symbols.

A ring of sparse polynomials, and not SymPy's `expand`, multiplies the expression out. Sines and cosines count as
symbols: cos(a - b) is one symbol, and its relation to cos a is not used.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from math import gcd
from typing import NamedTuple

from sympy import Add, Expr, Integer, Mul, Pow, Rational, S, Symbol, cos, sin
from sympy.core.add import _addsort
from sympy.core.mul import _mulsort

from derive.algebra.factors_in_front import Product
from derive.algebra.sparse_polynomials import WIDTH, Form, Outside, Ring, Terms

__all__ = ["Coefficient", "Expanded", "Outside", "coefficients", "is_linear_in_some_letter", "is_multiplied_out"]

ONES = (1 << WIDTH) - 1
PHASE = 2  # number of bits of a monomial before the bits of the first symbol


class Coefficient(NamedTuple):
    """The coefficient of one product of powers of the symbols.

    `whole()` returns the coefficient, and `terms` is the number of its terms. Some coefficients are a product of two
    factors: the first has no sines or cosines, and the second, `angles`, has nothing else. In this case, if `other` is
    a different form of `angles`, `written(number, other)` returns `number` times the first factor times `other`, with
    common factors in front. For any other coefficient, `written` is None.
    """

    whole: Callable[[], Expr]
    terms: int
    written: Callable[[Rational, Expr], Factored] | None = None
    angles: Expr = S.One


class Factored(NamedTuple):
    """A sum with the common factors of its terms in front. `is_prime` is true if the sum is known not to be a product
    of other sums."""

    value: Expr
    is_prime: bool


def coefficients(value: Expr, letters: Sequence[Symbol]) -> list[tuple[tuple[int, ...], Coefficient]]:
    """For each product of powers of these symbols in the value: the tuple of the powers, and the coefficient. The
    tuples are in descending order.

    Raises `Outside` if the value is not a polynomial of the ring `Expanded`, or is too large.
    """
    ring = _Kept.ring = Expanded() if _Kept.ring.is_full else _Kept.ring
    form = ring.form(value)
    places = [ring.place(letter) for letter in letters]
    mask = sum(ONES << place for place in places)
    gathered: dict[int, Terms] = {}
    for monomial, coefficient in form.terms.items():
        gathered.setdefault(monomial & mask, {})[monomial & ~mask] = coefficient
    found = [
        (tuple((powers >> place) & ONES for place in places), ring.coefficient(terms, form.below))
        for powers, terms in gathered.items()
    ]
    return sorted(found, key=lambda entry: entry[0], reverse=True)


def is_multiplied_out(value: Expr) -> bool:
    """Whether each term of the value is a product of rational numbers and of positive integer powers of symbols,
    sines of symbols and cosines of symbols."""
    return all(_is_power(factor) for term in Add.make_args(value) for factor in Mul.make_args(term))


def _is_power(factor: Expr) -> bool:
    base, power = factor.as_base_exp()
    known = base.is_Symbol or isinstance(base, sin | cos) and base.args[0].is_Symbol
    return bool(known and power.is_Integer and power.is_positive or factor.is_Rational)


class Expanded(Ring):
    """The ring of multiplied-out polynomials in symbols, sines and cosines, without division."""

    def __init__(self) -> None:
        super().__init__()
        self._names: dict[int, Expr] = {}
        self._angles = 0  # the bits of all sines and cosines
        self._built: dict[tuple[frozenset[tuple[int, int]], int], Expr] = {}

    def place(self, letter: object) -> int:
        place = super().place(letter)
        if place not in self._names:
            assert isinstance(letter, Expr)
            self._names[place] = letter
            self._angles |= ONES << place if isinstance(letter, sin | cos) else 0
        return place

    def name(self, place: int) -> Expr:
        return self._names[place]

    def function(self, expr: Expr) -> Form:
        if not isinstance(expr, sin | cos):
            raise Outside
        angle = expr.args[0]
        if not all(part.is_Symbol or part.is_Rational for term in Add.make_args(angle) for part in Mul.make_args(term)):
            raise Outside
        return self.letter(expr)

    def coefficient(self, terms: Terms, below: int) -> Coefficient:
        product = self._as_product(terms)
        if product is None:
            return Coefficient(lambda: self.expression(terms, below), len(terms))
        rest, turning = product
        return Coefficient(
            lambda: self.expression(terms, below),
            len(terms),
            lambda number, turning: self.factored(rest, number / below, turning),
            self.expression(turning, 1),
        )

    def _as_product(self, terms: Terms) -> tuple[Terms, Terms] | None:
        by_rest: dict[int, Terms] = {}
        for monomial, coefficient in terms.items():
            angles = monomial & self._angles
            by_rest.setdefault(monomial - angles, {})[angles] = coefficient
        first = next(iter(by_rest.values()))
        lead = min(first)
        content = gcd(*first.values()) * (1 if first[lead] > 0 else -1)
        turning = {angles: coefficient // content for angles, coefficient in first.items()}
        rest: Terms = {}
        for monomial, part in by_rest.items():
            times = part.get(lead, 0) // turning[lead]
            if part != {angles: times * coefficient for angles, coefficient in turning.items()}:
                return None
            rest[monomial] = times
        return rest, turning

    def factored(self, terms: Terms, number: Rational, other: Expr = S.One) -> Factored:
        """The sum of `terms`, multiplied by `number` and `other`, with the common factors of the terms in front."""
        if number < 0:
            terms, number = {monomial: -coefficient for monomial, coefficient in terms.items()}, -number
        lowest, content, rest = _in_front(terms)
        whole, below = (number * content).as_numer_denom()
        inner = self.expression(rest, 1) * Mul(*self._powers(lowest), other)
        if whole != 1:
            inner = Mul(whole, inner, evaluate=False) if inner.is_Add else whole * inner
        found = Mul(inner, Pow(below, -1))
        is_prime = len(terms) == 1 or (below == 1 or found.is_Mul) and is_linear_in_some_letter(rest)
        return Factored(found, is_prime)

    def product_in_front(self, terms: Terms, power: int = 1) -> Product:
        lowest, content, rest = _in_front(terms)
        powers = {letter: power * n for letter, n in self._letters(lowest)}
        if len(rest) > 1:
            powers[self.expression(rest, 1)] = power
        return Product(Rational(content) ** power, powers)

    def expression(self, terms: Terms, below: int) -> Expr:
        key = (frozenset(terms.items()), below)
        found = self._built.get(key)
        if found is None:
            found = self._built[key] = _sum([self._term(Rational(c, below), monomial) for monomial, c in terms.items()])
        return found

    def _term(self, coefficient: Rational, monomial: int) -> Expr:
        factors = [letter ** Integer(power) for letter, power in self._letters(monomial)]
        if not all(factor.is_Symbol or factor.is_Pow and factor.base.is_Symbol for factor in factors):
            return Mul(coefficient, *factors)
        _mulsort(factors)
        return Mul._from_args(factors if coefficient is S.One else [coefficient, *factors], is_commutative=True)

    def _powers(self, monomial: int) -> Iterator[Expr]:
        return (letter ** Integer(power) for letter, power in self._letters(monomial))

    def _letters(self, monomial: int) -> Iterator[tuple[Expr, int]]:
        """Yield each symbol of a monomial with its power."""
        monomial >>= PHASE
        place = PHASE
        while monomial:
            lowest = (monomial & -monomial).bit_length() - 1
            skipped = lowest - lowest % WIDTH
            monomial >>= skipped
            place += skipped
            yield self._names[place], monomial & ONES
            monomial >>= WIDTH
            place += WIDTH


def _sum(terms: list[Expr]) -> Expr:
    """Return the sum of terms that are all different; `Add` would search for like terms."""
    if any(not (term.is_Mul or term.is_Atom or term.is_Pow) for term in terms) or not terms:
        return Add(*terms)
    numbers = [term for term in terms if term.is_Number]
    others = [term for term in terms if not term.is_Number]
    _addsort(others)
    return Add._from_args([*numbers, *others], is_commutative=True)


def _in_front(terms: Terms) -> tuple[int, int, Terms]:
    lowest = reduce(_common, terms)
    content = gcd(*terms.values()) * (-1 if all(coefficient < 0 for coefficient in terms.values()) else 1)
    return lowest, content, {monomial - lowest: coefficient // content for monomial, coefficient in terms.items()}


def _common(one: int, other: int) -> int:
    shared, place = 0, PHASE
    while one >> place and other >> place:
        shared += min((one >> place) & ONES, (other >> place) & ONES) << place
        place += WIDTH
    return shared


def is_linear_in_some_letter(terms: Terms) -> bool:
    """Whether some symbol occurs in exactly one term, and its power in this term is 1."""
    place, every = PHASE, reduce(int.__or__, terms)
    while every >> place:
        powers = [power for monomial in terms if (power := (monomial >> place) & ONES)]
        if powers == [1]:
            return True
        place += WIDTH
    return False


class _Kept:
    ring = Expanded()
