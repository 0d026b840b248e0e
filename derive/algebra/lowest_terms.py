"""Write a fraction with numerator and denominator multiplied out and their common factors cancelled.

The module also rewrites the fraction with squares of sines in place of squares of cosines, or the reverse.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache, reduce
from math import comb, gcd, lcm
from typing import NamedTuple

from sympy import ZZ, Expr, Rational, S, cos, lex, sin
from sympy.core.exprtools import decompose_power
from sympy.polys.galoistools import gf_degree, gf_gcd, gf_rem, gf_strip
from sympy.polys.polyerrors import HeuristicGCDFailed
from sympy.polys.rings import PolyElement, PolyRing

from derive.algebra.coefficients import ONES, PHASE, Expanded, is_linear_in_some_letter
from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.factors_in_front import Product, as_product, product_of, times, written
from derive.algebra.sparse_polynomials import ONE, WIDTH, Form, Outside, Terms

PRIME = 2**31 - 1  # polynomials are compared modulo this prime

__all__ = ["Outside", "factored", "in_lowest_terms", "is_squarefree", "shared_factor", "squares_turned"]


def in_lowest_terms(value: Expr) -> Expr:
    """The fraction in lowest terms, with common factors in front; raises `Outside` if the fraction is too large."""
    ring = _ring()
    return ring.written(ring.fraction(product_of(value)))


def squares_turned(value: Expr) -> list[Expr]:
    """Other forms of the fraction.

    In one form, 1 - cos^2 and 1 - sin^2 are written as squares. A fraction with both sines and cosines has two further
    forms, in which sin^2 is replaced by 1 - cos^2, or cos^2 by 1 - sin^2.
    """
    ring = _ring()
    plain = ring.fraction(product_of(value))
    turns: list[Callable[[Terms], Terms]] = [ring.in_pairs]
    if value.has(sin) and value.has(cos):
        turns += [ring.without(sin), ring.without(cos)]
    turned = (plain._replace(top=turn(plain.top), bottom=turn(plain.bottom)) for turn in turns)
    return [ring.written(each) for each in turned if each != plain]


def is_squarefree(value: Expr) -> bool:
    """Whether no square of a symbol or a sum divides a polynomial; raises `Outside` if the polynomial is too large."""
    terms = _ring().form(value).terms
    places = _places(terms)
    return bool(_polynomial(_polynomials(len(places)), terms, places).is_squarefree)


def factored(value: Expr) -> Expr:
    """One fraction with each sum factored over the rational numbers; functions and roots count as symbols. A sum that
    is too large is left unchanged."""
    product = _with_plus_first(_factors(value))
    odd = [base for base, power in product.powers.items() if power % 2 and base.is_Add]
    mixed = [base for base in odd if any(term.could_extract_minus_sign() for term in base.args)]
    if product.number < 0 and mixed:
        turned = min(mixed, key=str)
        product = times((product, _turned(turned, product.powers[turned])))
    return as_product(product)


def shared_factor(values: Sequence[Expr]) -> Product:
    """The greatest common factor of all nonzero values, such as a/6 for a/2 and a b/3. Its numerical factor is
    positive."""
    parts = [part for value in values if (part := _with_plus_first(_factors(value))).number]
    if not parts:
        return Product(S.One, {})
    bases = {base: None for part in parts for base in part.powers}
    powers = {base: min(part.powers.get(base, 0) for part in parts) for base in bases}
    numbers = [part.number for part in parts]
    number = Rational(gcd(*(n.p for n in numbers)), lcm(*(n.q for n in numbers)))
    return Product(number, {base: power for base, power in powers.items() if power})


def _factors(value: Expr) -> Product:
    ring = _ring()
    number, powers = product_of(value)
    return times((Product(number, {}), *(ring.factors(base, power) for base, power in powers.items())))


def _with_plus_first(product: Product) -> Product:
    """Write b - a as -(a - b), so that b - a and a - b are recognised as one factor."""
    turned = [(b, n) for b, n in product.powers.items() if b.is_Add and b.could_extract_minus_sign()]
    return times((product, *(_turned(base, power) for base, power in turned)))


def _turned(base: Expr, power: int) -> Product:
    """The factor (-1)^n (-b)^n/b^n, which equals 1: it replaces b^n in a product by (-1)^n (-b)^n."""
    return Product(S.NegativeOne**power, {base: -power, -base: power})


class _Fraction(NamedTuple):
    """The numerator and the denominator as sums of terms, and the factor in front."""

    top: Terms
    bottom: Terms
    rest: Product


class _Fractions(Expanded):
    """The ring in which functions and roots count as symbols."""

    def _made(self, expr: Expr) -> Form:
        return self.letter(expr) if expr == PLUS_MINUS else super()._made(expr)

    def function(self, expr: Expr) -> Form:
        base, power = decompose_power(expr)  # exp(2 x) is the square of exp(x)
        return self.power(self.letter(base), power) if power > 0 else self.letter(expr)

    def fraction(self, product: Product) -> _Fraction:
        letters = {base: power for base, power in product.powers.items() if power < 0 and not base.is_Add}
        above = self._multiplied_out({base: power for base, power in product.powers.items() if power > 0})
        sums = {base: -power for base, power in product.powers.items() if power < 0 and base.is_Add}
        for base in sums:
            while sums[base] and (quotient := _quotient(above.terms, self.form(base).terms)) is not None:
                above, sums[base] = above._replace(terms=quotient), sums[base] - 1
        below = self._multiplied_out({base: power for base, power in sums.items() if power})
        return _Fraction(above.terms, below.terms, Product(product.number * below.below / above.below, letters))

    def _multiplied_out(self, powers: Mapping[Expr, int]) -> Form:
        forms = [self.power(self.form(base), power) for base, power in powers.items()]
        return reduce(self.product, sorted(forms, key=lambda form: len(form.terms)), ONE)

    def written(self, fraction: _Fraction) -> Expr:
        top, bottom, (number, letters) = fraction
        if not top:
            return S.Zero
        if len(bottom) > 1:
            top, bottom = _without_common(top, bottom)
        for terms in (top, bottom):
            if len(terms) == 1 and min(terms.values()) < 0:
                number, top, bottom = -number, *(_negative(t) if t is terms else t for t in (top, bottom))
        if number < 0 if len(top) == 1 < len(bottom) else _is_negative(self.expression(bottom, 1)):
            number, bottom = -number, _negative(bottom)
        if number < 0:
            number, top = -number, _negative(top)
        parts = (Product(number, letters), self.product_in_front(top), self.product_in_front(bottom, -1))
        return written(times(parts))

    def factors(self, base: Expr, power: int) -> Product:
        try:
            terms = self.form(base).terms if base.is_Add else {}
        except Outside:
            terms = {}
        if not terms or is_linear_in_some_letter(terms):
            return Product(S.One, {base: power})
        places = self._by_degree(terms)
        content, found = _polynomial(_polynomials(len(places)), terms, places).factor_list()
        inner = (self.product_in_front(_terms(factor, places), n * power) for factor, n in found)
        return times((Product(Rational(int(content)) ** power, {}), *inner))

    def _by_degree(self, terms: Terms) -> list[int]:
        """The places of the letters, the lowest degree first, because SymPy factors much faster in this order."""
        degrees = {place: max((m >> place) & ONES for m in terms) for place in _places(terms)}
        return sorted(degrees, key=lambda place: (degrees[place], str(self.name(place))))

    def without(self, function: type) -> Callable[[Terms], Terms]:
        """Return a function that replaces the square of `function`, sine or cosine, by 1 minus the square of the other
        function of the same angle. From an odd power, one factor `function` remains."""

        def turn(terms: Terms) -> Terms:
            for place, other in self._turning(terms):
                if isinstance(self.name(place), function):
                    terms = _by_other_square(terms, place, other)
            return terms

        return turn

    def in_pairs(self, terms: Terms) -> Terms:
        """Write each pair of terms such as x^2 and -x^2 cos^2 a as x^2 sin^2 a; a term without such a partner is
        unchanged."""
        left = dict(terms)
        turning = self._turning(terms)
        for monomial in terms:
            for place, other in turning if monomial in left else ():
                plain = monomial - (2 << place)
                if (monomial >> place) & ONES == 2 and left.get(plain) == -left[monomial]:
                    squared = plain + (2 << other)
                    left[squared] = left.get(squared, 0) + left.pop(plain)
                    del left[monomial]
                    break
        return {monomial: coefficient for monomial, coefficient in left.items() if coefficient}

    def _turning(self, terms: Terms) -> list[tuple[int, int]]:
        found = [self.name(place) for place in _places(terms)]
        turning = sorted((f for f in found if isinstance(f, sin | cos)), key=str)
        return [(self.place(f), self.place((cos if isinstance(f, sin) else sin)(f.args[0]))) for f in turning]


def _by_other_square(terms: Terms, place: int, other: int) -> Terms:
    """Replace s^2 by 1 - c^2; the bits of s in a monomial begin at `place`, and the bits of c begin at `other`."""
    found: Terms = {}
    for monomial, coefficient in terms.items():
        half = ((monomial >> place) & ONES) // 2
        plain = monomial - (2 * half << place)
        for k in range(half + 1):
            key = plain + (2 * k << other)
            found[key] = found.get(key, 0) + coefficient * comb(half, k) * (-1) ** k
    return {monomial: coefficient for monomial, coefficient in found.items() if coefficient}


def _is_negative(below: Expr) -> bool:
    return bool(below.is_negative if below.is_number else below.could_extract_minus_sign())


def _negative(terms: Terms) -> Terms:
    return {monomial: -coefficient for monomial, coefficient in terms.items()}


def _without_common(top: Terms, bottom: Terms) -> tuple[Terms, Terms]:
    places = _places([*top, *bottom])
    if _are_coprime(top, bottom, places):
        common = gcd(*top.values(), *bottom.values())
        return tuple({m: c // common for m, c in terms.items()} for terms in (top, bottom))  # type: ignore[return-value]
    ring = _polynomials(len(places))
    try:
        _, *left = _polynomial(ring, top, places).cofactors(_polynomial(ring, bottom, places))
    except HeuristicGCDFailed as failure:
        raise Outside from failure
    above, below = (_terms(each, places) for each in left)
    return above, below


def _quotient(top: Terms, divisor: Terms) -> Terms | None:
    """The quotient of two sums; None if the divisor has only one term, or if no quotient without remainder is found.
    Most remainders are detected modulo a prime."""
    places = _places([*top, *divisor])
    first = next(iter(_places(divisor)), None)
    if first is None or len(divisor) < 2 or not set(_places(divisor)) <= set(_places(top)):
        return None
    numbers = _numbers(places)
    images = [_image(_valued(terms, numbers), first, numbers[first]) for terms in (top, divisor)]
    if not images[1][0] or gf_rem(gf_strip(images[0]), images[1], PRIME, ZZ):
        return None
    ring = _polynomials(len(places))
    found, left = _polynomial(ring, top, places).div(_polynomial(ring, divisor, places))
    return None if left else _terms(found, places)


def _numbers(places: Sequence[int]) -> dict[int, int]:
    return {place: pow(3, 5 + 2 * n, PRIME) for n, place in enumerate(places)}


def _are_coprime(top: Terms, bottom: Terms, places: list[int]) -> bool:
    """Whether images modulo a prime show that two sums have no common factor that contains a symbol.

    In the images, numbers replace all symbols except one, called x here. A common factor of degree d in x leaves a
    common factor of degree d in the images, unless the leading coefficient of an image vanishes.
    Source: von zur Gathen, Gerhard, *Modern Computer Algebra*, section 6.5.
    """
    numbers = _numbers(places)
    above, below = (_valued(terms, numbers) for terms in (top, bottom))
    shared = set(_places(top)) & set(_places(bottom))
    return all(_is_coprime(*(_image(each, place, numbers[place]) for each in (above, below))) for place in shared)


def _valued(terms: Terms, numbers: Mapping[int, int]) -> Terms:
    """The value of each term modulo the prime, with numbers substituted for its symbols."""
    found: Terms = {}
    for monomial, coefficient in terms.items():
        value = coefficient % PRIME
        for place, number in numbers.items():
            power = (monomial >> place) & ONES
            if power:
                value = value * pow(number, power, PRIME) % PRIME
        found[monomial] = value
    return found


def _image(valued: Terms, place: int, number: int) -> list[int]:
    """The coefficients of the powers of one symbol, the highest first."""
    inverse = pow(number, -1, PRIME)
    degree = max((monomial >> place) & ONES for monomial in valued)
    found = [0] * (degree + 1)
    for monomial, value in valued.items():
        power = (monomial >> place) & ONES
        found[degree - power] += value * pow(inverse, power, PRIME)
    return [coefficient % PRIME for coefficient in found]


def _is_coprime(one: list[int], other: list[int]) -> bool:
    return bool(one[0] and other[0] and gf_degree(gf_gcd(one, other, PRIME, ZZ)) == 0)


def _places(monomials: Iterable[int]) -> list[int]:
    every = reduce(int.__or__, monomials, 0)
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
    ring = _Fractions()


def _ring() -> _Fractions:
    _Kept.ring = _Fractions() if _Kept.ring.is_full else _Kept.ring
    return _Kept.ring
