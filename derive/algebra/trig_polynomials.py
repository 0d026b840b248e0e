"""Polynomials in letters and in sines and cosines of angles, in a form that only equal ones share.

Each angle q that occurs is written by z = exp(i q), so that cos q = (z + 1/z)/2 and sin q = (z - 1/z)/(2 i): sums and
multiples of angles are products of powers of such z, and sin^2 + cos^2 = 1 needs no rule of its own. What is divided by
is a letter more, and is multiplied out again before anything is said to vanish.

The letters and the z of angles that are products of letters do not depend on one another by any polynomial (exponential
functions of such angles are algebraically independent), so that a form without terms is the only one of zero. An angle
may also have sines and cosines of letters as factors: written alike, it is the same one. The z of
parts of pi is a root of one, and what holds of it follows from its irreducible equation, by which a form is reduced.
A square root is a letter whose square is known; such roots may depend on one another, so that nothing is said where
some are left.

Sources: Cox, Little, O'Shea, *Ideals, Varieties, and Algorithms*, ch. 2 (normal forms); Lang, *Algebra*, ch. VI,
section 3 (cyclotomic polynomials are irreducible) and section 4 (the independence of characters).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import gcd, lcm

from sympy import Add, Expr, I, Mul, Pow, Rational, cos, cyclotomic_poly, pi, sin, tan

from derive.algebra.sparse_polynomials import HIGHEST, PARTS, WIDTH, Form, Outside, Ring, Terms

LONGEST = 60  # operations that an angle is written with, and powers in it
SMALL = range(-8, 9)

__all__ = ["Outside", "TrigRing", "are_equal", "is_zero"]


def is_zero(expr: Expr) -> bool:
    """Whether the expression is zero; raises `Outside` where that is not for this module to say."""
    return _asked(lambda ring: ring.is_zero(ring.form(expr)), expr)


def are_equal(left: Expr, right: Expr) -> bool:
    """Whether two expressions are equal; raises `Outside` where that is not for this module to say."""
    return _asked(lambda ring: ring.is_zero(ring.difference(ring.form(left), ring.form(right))), left, right)


def _asked(question: Callable[[TrigRing], bool], *exprs: Expr) -> bool:
    ring = TrigRing({}) if _Kept.ring.is_full else _Kept.ring
    begun_anew = False
    while True:
        _Kept.ring = ring
        if any(expr in ring.outside or _has_nested_roots(expr) for expr in exprs):
            raise Outside
        try:
            return question(ring)
        except _Finer as finer:
            units = {**ring.units, finer.angle: lcm(ring.units.get(finer.angle, 1), finer.parts)}
            if units[finer.angle] > PARTS:  # what was asked before must not count
                if begun_anew:
                    raise Outside from None
                units, begun_anew = {finer.angle: finer.parts}, True
            ring = TrigRing(units)
        except Outside:
            if len(exprs) == 1:
                ring.outside.update(exprs)
            raise


@lru_cache(maxsize=16384)  # told before any form is made, which would be for nothing
def _has_nested_roots(expr: Expr) -> bool:
    """Whether there are roots of roots, or others than square ones."""
    if isinstance(expr, Pow) and expr.exp.is_Rational and not expr.exp.is_Integer:
        return bool(expr.exp.q != 2 or _has_roots(expr.base))
    return any(_has_nested_roots(part) for part in expr.args if part.args)


@lru_cache(maxsize=16384)
def _has_roots(expr: Expr) -> bool:
    is_root = isinstance(expr, Pow) and expr.exp.is_Rational and not expr.exp.is_Integer
    return is_root or any(_has_roots(part) for part in expr.args if part.args)


def _is_in_angles(base: Expr) -> bool:
    """A letter, or the sine or cosine of one, as in the angle phi_dot t cos theta of a steady precession."""
    return base.is_Symbol or isinstance(base, sin | cos) and base.args[0].is_Symbol


class _Finer(Exception):
    """Of an angle there is a part that is no whole number of those whose exponential has a letter."""

    def __init__(self, angle: Expr, parts: int):
        super().__init__(angle)
        self.angle, self.parts = angle, parts


class TrigRing(Ring):
    """The polynomials in letters, in exp(i q) of angles, and in one over each sum that is divided by."""

    def __init__(self, units: dict[Expr, int]) -> None:
        super().__init__()
        self.units = units  # into how many parts an angle is divided
        self.outside: set[Expr] = set()
        self._divisors: list[tuple[int, Form]] = []
        self._roots: list[tuple[int, Form]] = []
        self._middle = (0, 0)

    # --- from expressions ---------------------------------------------------------------------------------------

    def function(self, expr: Expr) -> Form:
        if isinstance(expr, sin | cos):
            return self._circular(expr)
        if isinstance(expr, tan):
            sine, cosine = (self.form(of(expr.args[0])) for of in (sin, cos))
            return self.product(sine, self._one_over(cosine))
        if expr is I:
            return Form({1: 1})
        if expr is pi:
            return self.letter(pi)
        if isinstance(expr, Pow) and expr.exp.is_Rational and expr.exp.q == 2:
            return self._root(self.form(expr.base), int(expr.exp.p))
        raise Outside

    def _root(self, square: Form, n: int) -> Form:
        """A power of the square root of what is known not to vanish."""
        if not square.terms or self._is_unsure(square.terms) or abs(n) > HIGHEST:
            raise Outside
        shared = gcd(square.below, *square.terms.values())
        terms = {monomial: coefficient // shared for monomial, coefficient in square.terms.items()}
        key = (frozenset(terms.items()), square.below // shared)
        if key not in self.letters:
            self._roots.append((self.place(key), square))
        return Form({n << self.place(key): 1}, 1, abs(n), square.cost)

    def _circular(self, function: Expr) -> Form:
        """cos q = (z + 1/z)/2 and sin q = (-i z + i/z)/2"""
        z, reach = 0, 0
        angle = function.args[0]
        if not angle.is_Symbol and (angle.count_ops() > LONGEST or any(p.exp not in SMALL for p in angle.atoms(Pow))):
            raise Outside
        for term in Add.make_args(angle.expand()):
            number, angle = term.as_coeff_Mul(rational=True)
            z += self._multiple(number, angle) << self.place((angle,))
            reach = max(reach, abs(int(number.p)))
        if isinstance(function, cos):
            return Form({z: 1, -z: 1}, 2, reach)
        return Form({z + 1: -1, -z + 1: 1}, 2, reach)

    def _multiple(self, number: Rational, angle: Expr) -> int:
        """How many of the smallest parts of the angle there are."""
        powers = (factor.as_base_exp() for factor in Mul.make_args(angle))
        if angle is not pi and not all(_is_in_angles(base) and power.is_Integer for base, power in powers):
            raise Outside
        if abs(number.p) > HIGHEST or number.q > PARTS:
            raise Outside
        parts = self.units.get(angle, 1)
        if parts % number.q:
            raise _Finer(angle, int(number.q))
        return int(number.p) * (parts // int(number.q))

    # --- quotients ----------------------------------------------------------------------------------------------

    def inverse(self, base: Expr) -> Form:
        return self._one_over(self.form(base))

    def _one_over(self, form: Form) -> Form:
        """One over it: of a monomial a monomial; of a sum that of its last one, times a letter for what is left."""
        if not form.terms:  # it is zero, and so nothing is said of what is divided by it
            raise Outside
        last = _monomial_over(max(form.terms), form)
        return last if len(form.terms) == 1 else self.product(last, self._divisor(self.product(form, last)))

    def _divisor(self, form: Form) -> Form:
        """The letter that stands for one over a sum, the same for the same sum but for its number."""
        content = gcd(*form.terms.values())
        terms = {monomial: coefficient // content for monomial, coefficient in form.terms.items()}
        key = frozenset(terms.items())
        if self._is_unsure(terms):
            raise Outside
        if key not in self.letters:
            self._divisors.append((self.place(key), Form(terms, 1, form.reach)))
        scale = gcd(form.below, content)
        return Form({1 << self.place(key): form.below // scale}, content // scale, 1, form.cost)

    def is_zero(self, form: Form) -> bool:
        """Whether it has no terms once roots are squared and what is divided by is multiplied out, the latest first.

        Raises `Outside` where roots are left.
        """
        for place, square in self._roots:
            if form.terms:
                form = self._squared(form, place, square)
        for place, divisor in reversed(self._divisors):
            if form.terms:
                form = self._multiplied_out(form, place, divisor)
        if not form.terms or self._has_parts_of_pi(form.terms) and self._is_zero_by_roots_of_one(form.terms):
            return True
        if self._has_roots(form.terms):
            raise Outside
        return False

    def _is_unsure(self, terms: Terms) -> bool:
        """Whether a sum may vanish although it has terms."""
        return self._has_parts_of_pi(terms) or self._has_roots(terms)

    def _has_parts_of_pi(self, terms: Terms) -> bool:
        place = self.letters.get((pi,))
        return place is not None and any(self._power_in(monomial, place) for monomial in terms)

    def _has_roots(self, terms: Terms) -> bool:
        return any(self._power_in(monomial, place) for place, _ in self._roots for monomial in terms)

    def _is_zero_by_roots_of_one(self, terms: Terms) -> bool:
        """Whether, before each product of the other letters, the sum of powers of exp(i pi/parts) and of i is zero."""
        place, parts = self.letters[(pi,)], self.units.get(pi, 1)
        order = lcm(2 * parts, 4)
        sums: dict[int, dict[int, int]] = {}
        for monomial, coefficient in terms.items():
            power = self._power_in(monomial, place)
            turn = (power * (order // (2 * parts)) + (monomial & 1) * (order // 4)) % order
            of_rest = sums.setdefault((monomial - (power << place)) & ~1, {})
            of_rest[turn] = of_rest.get(turn, 0) + coefficient
        return all(_vanishes_at_root_of_one(powers, order) for powers in sums.values())

    def _squared(self, form: Form, place: int, square: Form) -> Form:
        """With the root in its first power at most; times as much of the square as takes it out from below."""
        by_power: dict[int, Terms] = {}
        for monomial, coefficient in form.terms.items():
            whole = self._power_in(monomial, place) // 2
            by_power.setdefault(whole, {})[monomial - (2 * whole << place)] = coefficient
        if by_power.keys() == {0}:
            return form
        lowest = min(*by_power, 0)
        parts = [
            self.product(form._replace(terms=terms), self.power(square, whole - lowest))
            for whole, terms in by_power.items()
        ]
        return self.sum(parts)

    def _multiplied_out(self, form: Form, place: int, divisor: Form) -> Form:
        by_power: dict[int, Terms] = {}
        for monomial, coefficient in form.terms.items():
            power = self._power_in(monomial, place)
            by_power.setdefault(power, {})[monomial - (power << place)] = coefficient
        if by_power.keys() == {0}:
            return form
        highest = max(by_power)
        parts = [
            self.product(form._replace(terms=terms), self.power(divisor, highest - power))
            for power, terms in by_power.items()
        ]
        return self.sum(parts)

    def _power_in(self, monomial: int, place: int) -> int:
        """The power of the letter at that place: with the half of all of them added, none is negative."""
        half = 1 << (WIDTH - 1)
        if self._middle[0] != len(self.letters):
            self._middle = len(self.letters), sum(half << other for other in self.letters.values())
        return (((monomial + self._middle[1]) >> place) & ((1 << WIDTH) - 1)) - half


def _monomial_over(monomial: int, form: Form) -> Form:
    """1/(i m) = -i/m, by the number that stands before it."""
    turns, coefficient = monomial & 1, form.terms[monomial]
    sign = (-1 if turns else 1) * (1 if coefficient > 0 else -1)
    return Form({turns - (monomial - turns): sign * form.below}, abs(coefficient), form.reach, form.cost)


def _vanishes_at_root_of_one(powers: dict[int, int], order: int) -> bool:
    """Whether a polynomial is zero at exp(2 i pi/order): divided by the irreducible one, it leaves nothing."""
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
    """The coefficients of the cyclotomic polynomial, the lowest power first; that of the highest is 1."""
    return tuple(int(c) for c in reversed(cyclotomic_poly(order, polys=True).all_coeffs()))


class _Kept:
    """The ring that goes from one question to the next."""

    ring = TrigRing({})
