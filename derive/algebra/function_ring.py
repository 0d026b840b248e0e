"""Polynomials in symbols and angles, and in roots, absolute values, exponentials and other functions.

A root or an absolute value of a product is split into the roots or absolute values of the factors, as far as the signs
of the factors allow it. Each of these roots and absolute values becomes a new letter: a variable of the ring with a
relation, r^q = p or |p|^2 = p^2. A power with a sum as its exponent becomes a product, exp(u + v) = exp u exp v. For a
function without a rule in this module, only one property is used: equal arguments give equal values.

The new letters may depend on one another, so a form with terms may still be zero. A form without terms is zero,
provided that it contains no division by zero.

Source: Cox, Little, O'Shea, *Ideals, Varieties, and Algorithms*, ch. 2 (normal forms modulo relations).
"""

from __future__ import annotations

from contextlib import suppress
from functools import lru_cache
from math import gcd
from typing import Any

from sympy import (
    Abs,
    Derivative,
    E,
    Expr,
    I,
    Integer,
    Mul,
    Pow,
    Rational,
    S,
    cos,
    cosh,
    cot,
    csc,
    exp,
    factor_list,
    factorint,
    log,
    pi,
    sec,
    sign,
    sin,
    sinh,
    sqrt,
    sqrtdenest,
    tan,
    tanh,
    together,
)
from sympy.core.function import AppliedUndef

from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.sparse_polynomials import ONE, Form, Outside, Terms
from derive.algebra.trig_polynomials import ONES, TrigRing, terms_of_angle

HIGHEST = 500  # highest power of a sum, and highest multiple of an angle
PRIMES = 2**15  # largest trial divisor when a number is factored
_QUOTIENTS = {tan: (sin, cos), cot: (cos, sin), tanh: (sinh, cosh)}
_INVERSES = {sec: cos, csc: sin}

__all__ = ["FunctionRing"]


class FunctionRing(TrigRing):
    """The polynomials in letters and functions."""

    highest = HIGHEST

    def __init__(self, units: dict[object, int]) -> None:
        super().__init__(units)
        self._dependent = 0  # the bits of the letters that may depend on one another
        self._known: dict[type, list[tuple[Expr, Form]]] = {}
        self._angles: dict[Expr, Expr] = {}

    def is_zero(self, form: Form) -> bool:
        """Whether the form is shown to be zero, provided that it contains no division by zero."""
        terms = self.cleared(form).terms
        return not terms or self.has_parts_of_pi(terms) and self.is_zero_by_roots_of_one(terms)

    def is_nonzero(self, form: Form) -> bool:
        """Whether the form is shown to be nonzero, because it has terms whose letters do not depend on one another."""
        terms = self.cleared(form).terms
        return bool(terms) and not self.letters_in(terms) & self._dependent and not self.has_parts_of_pi(terms)

    def is_unsure(self, terms: Terms) -> bool:
        return False  # `normal_form` checks at the end whether a divisor vanishes

    def function(self, expr: Expr) -> Form:
        kind = type(expr)
        if kind in _QUOTIENTS:
            above, below = (self.form(of(*expr.args)) for of in _QUOTIENTS[kind])
            return self.product(above, self.one_over(below))
        if kind in _INVERSES:
            return self.inverse(_INVERSES[kind](*expr.args))
        if isinstance(expr, sinh | cosh):
            return self._hyperbolic(expr)
        if isinstance(expr, exp) or expr is E:
            return self._exponential(expr.args[0] if expr.args else S.One)
        if isinstance(expr, log) and len(expr.args) == 1:
            return self._logarithm(expr.args[0])
        if isinstance(expr, Pow):
            return self._root(expr.base, expr.exp) if expr.exp.is_Rational else self._power_of(expr.base, expr.exp)
        if expr == PLUS_MINUS:
            return self._letter_of_power(expr, 2, ONE)
        if isinstance(expr, Abs) and all(part.is_real for part in expr.args[0].as_numer_denom()):
            return self._absolute(expr.args[0])
        if isinstance(expr, sign) and expr.args[0].is_real:  # sign(u) = u/|u|, valid only where u is not zero
            return self.product(self.form(expr.args[0]), self.one_over(self._absolute(expr.args[0])))
        return super().function(expr) if isinstance(expr, sin | cos) or expr in {I, pi} else self._opaque(expr)

    # --- letters ------------------------------------------------------------------------------------------------

    def _letter_of_power(self, key: object, order: int, of: Form, n: int = 1) -> Form:
        """The n-th power of the letter x that satisfies x^order = `of`."""
        place = self.related_letter(key, order, of)
        self._dependent |= ONES << place
        return Form({n << place: 1}, 1, abs(n), of.cost)

    def _dependent_place(self, key: object) -> int:
        place = self.place(key)
        self._dependent |= ONES << place
        return place

    def _opaque(self, expr: Expr) -> Form:
        if expr.is_infinite or expr is S.NaN:
            raise Outside
        if isinstance(expr, AppliedUndef | Derivative):
            return self.letter(expr)
        known = self._known.setdefault(type(expr), [])
        for other, letter in known:
            if len(other.args) == len(expr.args) > 0 and all(map(self._agree, other.args, expr.args)):
                return letter
        letter = Form({1 << self._dependent_place(expr): 1}, reach=1)
        known.append((expr, letter))
        return letter

    def _agree(self, a: Any, b: Any) -> bool:
        """Whether two arguments are equal; arguments that are not expressions must be identical."""
        return bool(a == b) or isinstance(a, Expr) and isinstance(b, Expr) and self._are_equal(a, b)

    def _are_equal(self, a: Expr, b: Expr) -> bool:
        try:
            return self.is_zero(self.difference(self.form(a), self.form(b)))
        except Outside:
            return False

    def angle(self, angle: Expr) -> Expr:
        """Return the angle. An angle that `TrigRing` does not handle is replaced by the first earlier angle that is
        equal to it, if there is one."""
        try:
            return super().angle(angle)
        except Outside:
            found = self._angles.get(angle)
            if found is None:
                with suppress(Outside):
                    self.form(angle)  # so that the angles inside this angle are known before it is compared
                alike = (known for known in list(self._angles.values()) if self._are_equal(known, angle))
                found = self._angles[angle] = next(alike, angle)
            return found

    # --- powers -------------------------------------------------------------------------------------------------

    def _exponential(self, exponent: Expr) -> Form:
        """The exponential of a sum as a product with one factor for each term."""
        powers = 0
        for number, term in terms_of_angle(exponent):
            if I in Mul.make_args(term):
                angle = self.angle(term / I)
                powers += self.multiple(number, angle) << self.place((angle,))
            else:
                powers += self._multiple_of((exp, self.angle(term)), number)
        return Form({powers: 1}, 1, HIGHEST)

    def _power_of(self, base: Expr, exponent: Expr) -> Form:
        """Expand a power by b^(u + v) = b^u b^v, and by (a b)^u = a^u b^u if a is known not to be negative."""
        powers, product = 0, ONE
        factors = [(self._key(factor), power) for factor, power in factors_under_a_root(base, 1)]
        for number, term in terms_of_angle(exponent):
            if term is S.One:
                product = self.product(product, self.form(Pow(base, number)))
                continue
            for key, power in factors:
                powers += self._multiple_of((Pow, key, self.angle(term)), number * power)
        return self.product(product, Form({powers: 1}, 1, HIGHEST))

    def _multiple_of(self, key: object, number: Rational) -> int:
        return self.multiple(number, key) << self._dependent_place(key)

    def _key(self, expr: Expr) -> object:
        form = self.form(expr)
        return frozenset(form.terms.items()), form.below

    def _hyperbolic(self, expr: Expr) -> Form:
        grows, falls = (self._exponential(sign * expr.args[0]) for sign in (1, -1))
        double = self.sum([grows, falls]) if isinstance(expr, cosh) else self.difference(grows, falls)
        return double._replace(below=2 * double.below)

    def _logarithm(self, of: Expr) -> Form:
        """Expand a logarithm by log(a b) = log a + log b if a is known not to be negative."""
        logs = [
            Form({1 << self._dependent_place((log, self._key(factor))): power}, reach=1)
            for factor, power in factors_under_a_root(of, 1)
        ]
        return self.sum(logs) if logs else Form({})

    def _root(self, base: Expr, exponent: Rational) -> Form:
        """p^(n/q) as a product of roots of factors, so that sqrt(6) is sqrt(2) sqrt(3)."""
        q, product = int(exponent.q), ONE
        denested = _denested(base) if q == 2 and base.is_number and base.has(Pow) else None
        if denested is not None:
            return self.form(denested**exponent.p)
        for factor, power in factors_under_a_root(base, q):
            product = self.product(product, self._root_of_factor(factor, q, power * int(exponent.p)))
        return product

    def _root_of_factor(self, factor: Expr, q: int, n: int) -> Form:
        of = self.form(factor)
        if not of.terms:
            raise Outside
        if q == 2 and factor == -1:
            return self.power(Form({1: 1}), n % 4)
        if of.terms.keys() == {0} and not factor.is_Rational:  # such as sin^2 + cos^2
            return self.form(Pow(Rational(of.terms[0], of.below), Rational(n, q)))
        if len(of.terms) > 1:
            number, of = _number_in_front(of)
            letter = self._letter_of_power((Pow, q, frozenset(of.terms.items())), q, of, n)
            return self.product(self.form(Pow(number, Rational(n, q))), letter)
        key = (Pow, q, frozenset(of.terms.items()), of.below)
        whole, rest = divmod(n, q)
        front = self.power(of, whole) if whole >= 0 else self.power(self.one_over(of), -whole)
        return self.product(front, self._letter_of_power(key, q, of, rest)) if rest else front

    def _absolute(self, inside: Expr) -> Form:
        """|p| as a product over irreducible factors f: f itself if it is known not to be negative, else a letter
        g with g^2 = f^2."""
        product = ONE
        for factor, power in _irreducible_factors(inside):
            factor = -factor if factor.could_extract_minus_sign() else factor
            size = self.form(factor) if factor.is_nonnegative else self._size(self.form(factor))
            product = self.product(product, self.power(size if power > 0 else self.one_over(size), abs(power)))
        return product

    def _size(self, form: Form) -> Form:
        if form.terms and form.terms[max(form.terms)] < 0:
            form = self.difference(Form({}), form)
        if not form.terms:
            return form
        number, form = _number_in_front(form)
        size = self._letter_of_power((Abs, frozenset(form.terms.items())), 2, self.product(form, form))
        return self.product(self.form(number), size)


def _number_in_front(form: Form) -> tuple[Rational, Form]:
    content = gcd(*form.terms.values())
    terms = {monomial: coefficient // content for monomial, coefficient in form.terms.items()}
    return Rational(content, form.below), form._replace(terms=terms, below=1)


# --- radicands -------------------------------------------------------------------------------------------------------


def _denested(base: Expr) -> Expr | None:
    """The square root without nested roots, sqrt(2) + sqrt(3) for 5 + 2 sqrt(6); None if it is not found."""
    found = sqrtdenest(sqrt(base))
    if isinstance(found, Pow) or found.is_nonnegative is not True:
        return None
    return found if (found**2).expand() == base.expand() else None


@lru_cache(maxsize=4096, typed=True)
def factors_under_a_root(base: Expr, q: int) -> tuple[tuple[Expr, int], ...]:
    """Factors of the radicand with their powers; the product of these powers is the radicand.

    Factors that are known to be non-negative are separated. Under a square root, an even power of another real factor f
    becomes a power of |f|.
    """
    found: list[tuple[Expr, int]] = []
    unsure: Expr = Integer(1)
    for factor, power in _irreducible_factors(base):
        if factor.is_nonnegative:
            found.append((factor, power))
        elif q == 2 and factor.is_real and abs(power) > 1:
            even = power - power % 2
            found.append((Abs(factor), even))
            unsure *= factor ** (power - even)
        else:
            unsure *= factor**power
    if unsure != 1:
        found.append((unsure, 1))
    return tuple(found)


def _irreducible_factors(expr: Expr) -> list[tuple[Expr, int]]:
    if expr.is_Symbol:
        return [(expr, 1)]
    above, below = together(expr).as_numer_denom()
    return [(factor, sign * power) for part, sign in ((above, 1), (below, -1)) for factor, power in _irreducible(part)]


def _irreducible(part: Expr) -> list[tuple[Expr, int]]:
    if part.is_Rational:
        return _prime_factors(part)
    if part.is_number:
        return [(part, 1)]
    content, factors = factor_list(part)
    return [*_prime_factors(content), *((factor, int(power)) for factor, power in factors)]


def _prime_factors(number: Expr) -> list[tuple[Expr, int]]:
    if not number.is_Rational:
        return [(number, 1)]
    sign: list[tuple[Expr, int]] = [(Integer(-1), 1)] if number < 0 else []
    primes = {**factorint(abs(number.p), limit=PRIMES), **{p: -e for p, e in factorint(number.q, limit=PRIMES).items()}}
    return sign + [(Integer(p), e) for p, e in primes.items() if p != 1]
