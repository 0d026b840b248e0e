"""A fraction multiplied out above and below its line, with what both have in common cancelled."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache, reduce

from sympy import ZZ, Expr, Rational, S, lex
from sympy.core.exprtools import decompose_power
from sympy.polys.polyerrors import HeuristicGCDFailed
from sympy.polys.rings import PolyElement, PolyRing

from derive.algebra.coefficients import ONES, PHASE, Expanded
from derive.algebra.factors_in_front import Product, product_of, times, written
from derive.algebra.sparse_polynomials import ONE, WIDTH, Form, Outside, Terms

__all__ = ["Outside", "in_lowest_terms"]


def in_lowest_terms(value: Expr) -> Expr:
    """The fraction with the common factors of its terms in front; raises `Outside` for what is too large."""
    return written(_lowest(product_of(value)))


def _lowest(product: Product) -> Product:
    """Where no sign stands before the fraction unless it must: above the line a sum takes it, and else one below."""
    ring = _Kept.ring = _Fractions() if _Kept.ring.is_full else _Kept.ring
    sums = {base: power for base, power in product.powers.items() if base.is_Add}
    above, below = (ring.multiplied_out({b: n * side for b, n in sums.items() if n * side > 0}) for side in (1, -1))
    if not above.terms:
        return Product(S.Zero, {})
    top, bottom = _without_common(above.terms, below.terms) if len(below.terms) > 1 else (above.terms, below.terms)
    number = product.number * Rational(below.below, above.below)
    if number < 0 if len(top) == 1 < len(bottom) else _is_negative(ring.expression(bottom, 1)):
        number, bottom = -number, _negative(bottom)
    if number < 0:
        number, top = -number, _negative(top)
    letters = {base: power for base, power in product.powers.items() if not base.is_Add}
    return times((Product(number, letters), ring.product_in_front(top), ring.product_in_front(bottom, -1)))


def _is_negative(below: Expr) -> bool:
    return bool(below.is_negative if below.is_number else below.could_extract_minus_sign())


def _negative(terms: Terms) -> Terms:
    return {monomial: -coefficient for monomial, coefficient in terms.items()}


class _Fractions(Expanded):
    """What is no sum, no product and no whole power is a letter."""

    def function(self, expr: Expr) -> Form:
        base, power = decompose_power(expr)  # exp(2 x) is the square of exp(x)
        return self.power(self.letter(base), power) if power > 0 else self.letter(expr)

    def multiplied_out(self, sums: Mapping[Expr, int]) -> Form:
        forms = [self.power(self.form(base), power) for base, power in sums.items()]
        return reduce(self.product, sorted(forms, key=lambda form: len(form.terms)), ONE)


def _without_common(top: Terms, bottom: Terms) -> tuple[Terms, Terms]:
    places = _places([*top, *bottom])
    ring = _polynomials(len(places))
    try:
        _, *left = _polynomial(ring, top, places).cofactors(_polynomial(ring, bottom, places))
    except HeuristicGCDFailed as failure:
        raise Outside from failure
    above, below = (_terms(each, places) for each in left)
    return above, below


def _places(monomials: Iterable[int]) -> list[int]:
    every = reduce(int.__or__, monomials)
    return [place for place in range(PHASE, every.bit_length(), WIDTH) if (every >> place) & ONES]


@lru_cache(maxsize=64)
def _polynomials(letters: int) -> PolyRing:
    return PolyRing([f"x{n}" for n in range(letters)], ZZ, lex)


def _polynomial(ring: PolyRing, terms: Terms, places: list[int]) -> PolyElement:
    return ring.from_dict({tuple((m >> place) & ONES for place in places): ZZ(c) for m, c in terms.items()})


def _terms(polynomial: PolyElement, places: list[int]) -> Terms:
    return {
        sum(power << place for power, place in zip(powers, places, strict=True)): int(c)
        for powers, c in polynomial.items()
    }


class _Kept:
    """The ring that goes from one fraction to the next."""

    ring = _Fractions()
