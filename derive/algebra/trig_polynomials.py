"""Polynomials in letters and in sines and cosines of angles, in a normal form.

Two polynomials without roots are equal if and only if their forms are equal.

Each angle q that occurs is represented by z = exp(i q), with cos q = (z + 1/z)/2 and sin q = (z - 1/z)/(2 i). Then the
exponential of a sum of multiples of angles is a product of powers of these z, and sin^2 + cos^2 = 1 needs no extra
rule. A divisor is represented by an additional letter, which is eliminated again before a form is compared with zero.

The letters and the z of angles that are products of letters satisfy no polynomial relation, because exponential
functions of such angles are algebraically independent. So only the form without terms is zero. The z of a fraction of
pi is a root of unity, and a form is reduced by the irreducible equation of this root. A square root is a letter whose
square is known. Square roots may depend on one another, so nothing is decided if a form still contains roots.

Sources: Cox, Little, O'Shea, *Ideals, Varieties, and Algorithms*, ch. 2 (normal forms); Lang, *Algebra*, ch. VI,
section 3 (cyclotomic polynomials are irreducible) and section 4 (the independence of characters).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import gcd, lcm
from typing import Any, TypeVar

from sympy import Add, Expr, I, Mul, Pow, Rational, S, Symbol, cos, cyclotomic_poly, pi, sin, tan

from derive.algebra.sparse_polynomials import PARTS, WIDTH, Form, Outside, Ring, Terms

WORK = 3_000_000  # greatest `cost` of a form; slower methods decide about longer expressions
LONGEST, STEEPEST = 60, 8  # greatest number of operations in an angle, and highest power in an angle
ONES, HALF = (1 << WIDTH) - 1, 1 << (WIDTH - 1)

R = TypeVar("R", bound="TrigRing")
Answer = TypeVar("Answer")

__all__ = ["Finer", "Outside", "TrigRing", "are_equal", "asked", "is_zero", "monomial_ratio"]


def is_zero(expr: Expr) -> bool:
    """Whether the expression is zero; raises `Outside` if this module cannot decide that."""
    if _has_nested_roots(expr):
        raise Outside
    return asked(TrigRing, lambda ring: ring.is_zero(ring.form(expr)), expr)


def are_equal(left: Expr, right: Expr) -> bool:
    """Whether two expressions are equal; raises `Outside` if this module cannot decide that."""
    if _has_nested_roots(left) or _has_nested_roots(right):
        raise Outside
    return asked(TrigRing, lambda ring: ring.is_zero(ring.difference(ring.form(left), ring.form(right))), left, right)


def monomial_ratio(left: Expr, right: Expr) -> Expr | None:
    """The ratio of the first expression to the second, if it is a number times powers of symbols; else None."""
    if _has_nested_roots(left) or _has_nested_roots(right):
        return None
    try:
        return asked(TrigRing, lambda ring: ring.ratio(ring.form(left), ring.form(right)), left, right)
    except Outside:
        return None


def asked(kind: type[R], question: Callable[[R], Answer], *exprs: Expr) -> Answer:
    """Ask the cached ring of this kind a question; raises `Outside` if the ring cannot answer."""
    ring: Any = KEPT.get(kind)
    ring = kind({}) if ring is None or ring.is_full else ring
    has_restarted = False
    while True:
        KEPT[kind] = ring
        if any(expr in ring.outside for expr in exprs):
            raise Outside
        try:
            return question(ring)
        except Finer as finer:
            units = {**ring.units, finer.angle: lcm(ring.units.get(finer.angle, 1), finer.parts)}
            if units[finer.angle] > PARTS:
                if has_restarted:
                    raise Outside from None
                units, has_restarted = {finer.angle: finer.parts}, True
            ring = kind(units)
        except Outside:
            if len(exprs) == 1:
                ring.outside.update(exprs)
            raise


@lru_cache(maxsize=16384)  # tested first, because an expression with nested roots has no useful form
def _has_nested_roots(expr: Expr) -> bool:
    """Whether the expression contains roots of roots, or roots other than square roots."""
    if isinstance(expr, Pow) and expr.exp.is_Rational and not expr.exp.is_Integer:
        return bool(expr.exp.q != 2 or _has_roots(expr.base))
    return any(_has_nested_roots(part) for part in expr.args if part.args)


@lru_cache(maxsize=16384)
def _has_roots(expr: Expr) -> bool:
    is_root = isinstance(expr, Pow) and expr.exp.is_Rational and not expr.exp.is_Integer
    return is_root or any(_has_roots(part) for part in expr.args if part.args)


def _is_in_angles(base: Expr) -> bool:
    """Whether the base of a power may occur in an angle, as phi_dot, t and cos theta occur in phi_dot t cos theta."""
    return base.is_Symbol or isinstance(base, sin | cos) and base.args[0].is_Symbol


def terms_of_angle(angle: Expr) -> list[tuple[Rational, Expr]]:
    """The terms of an expanded angle, each with its numerical factor; raises `Outside` if there may be too many."""
    if angle.is_Symbol:
        return [(S.One, angle)]
    if angle.count_ops() > LONGEST or any(p.exp.is_number and abs(p.exp) > STEEPEST for p in angle.atoms(Pow)):
        raise Outside
    return [term.as_coeff_Mul(rational=True) for term in Add.make_args(angle.expand())]


class Finer(Exception):
    """An angle must be divided into smaller parts."""

    def __init__(self, angle: object, parts: int):
        super().__init__(angle)
        self.angle, self.parts = angle, parts


class TrigRing(Ring):
    """The polynomials in letters, in exp(i q) for angles q, in square roots, and in the reciprocals of sums that are
    divisors."""

    work = WORK

    def __init__(self, units: dict[object, int]) -> None:
        super().__init__()
        self.units = units  # angle -> number of parts into which this angle is divided
        self.outside: set[Expr] = set()
        self._relations: list[tuple[int, int, Form]] = []  # place of a letter, its known power, form of this power
        self._related = 0  # the bits of all letters in `_relations`
        self._middle = (0, 0)

    # --- from expressions ---------------------------------------------------------------------------------------

    def function(self, expr: Expr) -> Form:
        if isinstance(expr, sin | cos):
            return self._circular(expr)
        if isinstance(expr, tan):
            sine, cosine = (self.form(of(expr.args[0])) for of in (sin, cos))
            return self.product(sine, self.one_over(cosine))
        if expr is I:
            return Form({1: 1})
        if expr is pi:
            return self.letter(pi)
        if isinstance(expr, Pow) and expr.exp.is_Rational and expr.exp.q == 2:
            return self._root(self.form(expr.base), int(expr.exp.p))
        raise Outside

    def _root(self, square: Form, n: int) -> Form:
        """A power of the square root of a form."""
        if not square.terms or self.is_unsure(square.terms) or abs(n) > self.highest:
            raise Outside
        shared = gcd(square.below, *square.terms.values())
        terms = {monomial: coefficient // shared for monomial, coefficient in square.terms.items()}
        key = (frozenset(terms.items()), square.below // shared)
        return Form({n << self.related_letter(key, 2, square): 1}, 1, abs(n), square.cost)

    def _circular(self, function: Expr) -> Form:
        """cos q = (z + 1/z)/2 and sin q = (-i z + i/z)/2"""
        z, reach = 0, 0
        for number, term in terms_of_angle(function.args[0]):
            angle = self.angle(term)
            z += self.multiple(number, angle) << self.place((angle,))
            reach = max(reach, abs(int(number.p)))
        if isinstance(function, cos):
            return Form({z: 1, -z: 1}, 2, reach)
        return Form({z + 1: -1, -z + 1: 1}, 2, reach)

    def angle(self, angle: Expr) -> Expr:
        """A representative of the angle, the same for angles that are recognised as equal."""
        powers = (factor.as_base_exp() for factor in Mul.make_args(angle))
        if angle is not pi and not all(_is_in_angles(base) and power.is_Integer for base, power in powers):
            raise Outside
        return angle

    def multiple(self, number: Rational, angle: object) -> int:
        """How many parts of the angle make up `number` times the angle. Raises `Finer` if the angle must be divided
        into more parts."""
        if abs(number.p) > self.highest or number.q > PARTS:
            raise Outside
        parts = self.units.get(angle, 1)
        if parts % number.q:
            raise Finer(angle, int(number.q))
        return int(number.p) * (parts // int(number.q))

    # --- quotients ----------------------------------------------------------------------------------------------

    def inverse(self, base: Expr) -> Form:
        return self.one_over(self.form(base))

    def one_over(self, form: Form) -> Form:
        """The reciprocal of a form: 1/monomial times a letter for the reciprocal of the remaining factor. Raises
        `Outside` if the form may be zero."""
        if not form.terms:  # the divisor is zero
            raise Outside
        last = _monomial_over(max(form.terms), form)
        return last if len(form.terms) == 1 else self.product(last, self._divisor(self.product(form, last)))

    def _divisor(self, form: Form) -> Form:
        content = gcd(*form.terms.values())
        terms = {monomial: coefficient // content for monomial, coefficient in form.terms.items()}
        key = frozenset(terms.items())
        if self.is_unsure(terms):
            raise Outside
        place = self.related_letter(key, -1, Form(terms, 1, form.reach))
        scale = gcd(form.below, content)
        return Form({1 << place: form.below // scale}, content // scale, 1, form.cost)

    def is_zero(self, form: Form) -> bool:
        """Whether the form is zero after roots and divisors are eliminated, in the reverse order of their introduction.

        Raises `Outside` if roots are left.
        """
        form = self.cleared(form)
        if not form.terms or self.has_parts_of_pi(form.terms) and self.is_zero_by_roots_of_one(form.terms):
            return True
        if self._has_roots(form.terms):
            raise Outside
        return False

    def cleared(self, form: Form) -> Form:
        """Return a multiple of the form in which the known powers of letters (see `related_letter`) are replaced."""
        for place, order, of in reversed(self._relations):
            present = self.letters_in(form.terms) & self._related
            if not present:
                return form
            if present >> place & ONES:
                form = self._lowered(form, place, order, of)
        return form

    def related_letter(self, key: object, order: int, of: Form) -> int:
        """Return the place of the letter whose `order`-th power equals `of`; if the letter is new, add it to the
        ring."""
        known = key in self.letters
        place = self.place(key)
        if not known:
            self._relations.append((place, order, of))
            self._related |= ONES << place
        return place

    def ratio(self, a: Form, b: Form) -> Expr | None:
        """The ratio of the first form to the second, if it is a number times powers of symbols; else None."""
        if not a.terms or len(a.terms) != len(b.terms):
            return None
        first, second = max(a.terms), max(b.terms)
        c, d, between = a.terms[first], b.terms[second], first - second
        if between & 3 or any(a.terms.get(m + between, 0) * d != n * c for m, n in b.terms.items()):
            return None
        factors: list[Expr] = [Rational(c * b.below, d * a.below)]
        for letter, place in self.letters.items():
            power = self._power_in(between, place)
            if power and not isinstance(letter, Symbol):
                return None
            factors += [Pow(letter, power)] if power else []
        return Mul(*factors)

    def is_unsure(self, terms: Terms) -> bool:
        """Whether the terms contain roots or parts of pi, so that they may be zero even if no terms cancel."""
        return self.has_parts_of_pi(terms) or self._has_roots(terms)

    def has_parts_of_pi(self, terms: Terms) -> bool:
        place = self.letters.get((pi,))
        return place is not None and bool(self.letters_in(terms) >> place & ONES)

    def _has_roots(self, terms: Terms) -> bool:
        present = self.letters_in(terms) & self._related
        return bool(present) and any(order > 0 and present >> place & ONES for place, order, _ in self._relations)

    def is_zero_by_roots_of_one(self, terms: Terms) -> bool:
        """Whether the terms add up to zero; exp(i pi/parts) and i are roots of unity."""
        place, parts = self.letters[(pi,)], self.units.get(pi, 1)
        order = lcm(2 * parts, 4)
        sums: dict[int, dict[int, int]] = {}
        for monomial, coefficient in terms.items():
            power = self._power_in(monomial, place)
            turn = (power * (order // (2 * parts)) + (monomial & 1) * (order // 4)) % order
            of_rest = sums.setdefault((monomial - (power << place)) & ~1, {})
            of_rest[turn] = of_rest.get(turn, 0) + coefficient
        return all(_vanishes_at_root_of_one(powers, order) for powers in sums.values())

    def _lowered(self, form: Form, place: int, order: int, of: Form) -> Form:
        """Replace the known power of a letter by the form `of` that equals it. The result is the form times a power of
        `of`."""
        by_power: dict[int, Terms] = {}
        for monomial, coefficient in form.terms.items():
            whole = self._power_in(monomial, place) // order
            by_power.setdefault(whole, {})[monomial - (order * whole << place)] = coefficient
        lowest = min(by_power)
        parts = [
            self.product(form._replace(terms=terms), self.power(of, whole - lowest))
            for whole, terms in by_power.items()
        ]
        return self.sum(parts)

    def letters_in(self, terms: Terms) -> int:
        """A whole number with nonzero bits at the places of all letters that occur."""
        middle, found = self._half_of_all(), 0
        for monomial in terms:
            found |= (monomial + middle) ^ middle
        return found

    def _power_in(self, monomial: int, place: int) -> int:
        """The power of the letter at this place."""
        return (((monomial + self._half_of_all()) >> place) & ONES) - HALF

    def _half_of_all(self) -> int:
        count = len(self.letters)
        if self._middle[0] != count:
            self._middle = count, ((1 << WIDTH * count) - 1) // ONES * HALF << 2
        return self._middle[1]


def _monomial_over(monomial: int, form: Form) -> Form:
    """The reciprocal of a monomial with its coefficient: 1/(i m) = -i/m."""
    turns, coefficient = monomial & 1, form.terms[monomial]
    sign = (-1 if turns else 1) * (1 if coefficient > 0 else -1)
    return Form({turns - (monomial - turns): sign * form.below}, abs(coefficient), form.reach, form.cost)


def _vanishes_at_root_of_one(powers: dict[int, int], order: int) -> bool:
    """Whether a polynomial is zero at exp(2 i pi/order), by division by the cyclotomic polynomial."""
    modulus = _irreducible_at(order)
    degree = len(modulus) - 1
    left = [powers.get(n, 0) for n in range(order)]
    for n in range(order - 1, degree - 1, -1):
        if left[n]:
            for k, coefficient in enumerate(modulus):
                left[n - degree + k] -= left[n] * coefficient if k < degree else 0
    return not any(left[:degree])


@lru_cache(maxsize=PARTS)
def _irreducible_at(order: int) -> tuple[int, ...]:
    """The coefficients of the cyclotomic polynomial, the lowest power first; the leading one is 1."""
    return tuple(int(c) for c in reversed(cyclotomic_poly(order, polys=True).all_coeffs()))


KEPT: dict[type[TrigRing], TrigRing] = {}  # the rings that are reused from one question to the next
