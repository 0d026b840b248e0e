"""Sparse sums of monomials in many letters; each monomial is stored as one whole number.

A letter is a variable of the ring: a symbol, or an expression that counts as a symbol. The powers of all letters of a
monomial, with their signs, are packed into one whole number, so one addition multiplies two monomials.

Source: Monagan, Pearce, *Sparse polynomial division using a heap*, J. Symb. Comp. 46 (2011), section 2 (packed
monomials).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm
from typing import NamedTuple

from sympy import Expr, Pow, Symbol

from derive.algebra.expressions import PLUS_MINUS

WIDTH = 24  # bits for the power of a letter and the sign of the power
PARTS = 64  # the largest number of equal parts into which an angle may be divided
FARTHEST = 2 ** (WIDTH - 2) // PARTS  # highest power of a letter
HIGHEST = 60  # highest power of a sum, and highest multiple of an angle
WORK = 200_000  # greatest `cost` of a form
LETTERS = 120  # a ring with more letters, or with more forms than `FORMS`, is replaced by an empty one
FORMS = 20_000

Terms = dict[int, int]


class Outside(Exception):
    """The expression has no such form, or is too large."""


class Form(NamedTuple):
    """A sum of whole multiples of monomials, divided by one whole number.

    No power in the sum exceeds `reach`. `cost` measures the work for the sum; it also counts cached parts, so that the
    same expressions are rejected in every run.
    """

    terms: Terms
    below: int = 1
    reach: int = 0
    cost: int = 0


ONE = Form({0: 1})


class Ring:
    """Letters with their places in a monomial, and the forms already computed.

    The lowest two bits of a monomial store the power, 0 or 1, of the imaginary unit i. Above them, each letter has
    `WIDTH` bits.
    """

    highest, work = HIGHEST, WORK

    def __init__(self) -> None:
        self.letters: dict[object, int] = {}
        self.forms: dict[Expr, Form] = {}

    @property
    def is_full(self) -> bool:
        return len(self.forms) > FORMS or len(self.letters) > LETTERS

    def form(self, expr: Expr) -> Form:
        """The form of an expression; raises `Outside` if the expression has no form."""
        found = self.forms.get(expr)
        if found is None:
            found = self.forms[expr] = self._made(expr)
        return found

    def _made(self, expr: Expr) -> Form:
        if expr.is_Rational:
            return Form({0: int(expr.p)} if expr.p else {}, int(expr.q))
        if isinstance(expr, Symbol) and expr != PLUS_MINUS:
            if not expr.is_commutative:
                raise Outside
            return self.letter(expr)
        if expr.is_Add:
            return self.sum([self.form(arg) for arg in expr.args])
        if expr.is_Mul:
            return self._product_of([self.form(arg) for arg in expr.args])
        if isinstance(expr, Pow) and expr.exp.is_Integer:
            n = int(expr.exp)
            return self.power(self.form(expr.base), n) if n >= 0 else self.power(self.inverse(expr.base), -n)
        return self.function(expr)

    def function(self, expr: Expr) -> Form:
        """The form of an expression that is not a number, symbol, sum, product or integer power."""
        raise Outside

    def inverse(self, base: Expr) -> Form:
        """The form of the reciprocal of an expression."""
        raise Outside

    def letter(self, letter: object) -> Form:
        return Form({1 << self.place(letter): 1}, reach=1)

    def place(self, letter: object) -> int:
        """The bit at which the power of a letter begins."""
        return self.letters.setdefault(letter, 2 + WIDTH * len(self.letters))

    def sum(self, forms: Sequence[Form]) -> Form:
        below = lcm(*(form.below for form in forms))
        terms: Terms = {}
        for form in forms:
            scale = below // form.below
            for monomial, coefficient in form.terms.items():
                terms[monomial] = terms.get(monomial, 0) + coefficient * scale
        cost = sum(form.cost + len(form.terms) for form in forms)
        return self._checked(Form(_without_zeros(terms), below, max(form.reach for form in forms), cost))

    def difference(self, left: Form, right: Form) -> Form:
        opposite = {monomial: -coefficient for monomial, coefficient in right.terms.items()}
        return self.sum([left, right._replace(terms=opposite)])

    def _product_of(self, forms: Sequence[Form]) -> Form:
        found = ONE
        for form in sorted(forms, key=lambda form: len(form.terms)):
            found = self.product(found, form)
        return found

    def product(self, a: Form, b: Form) -> Form:
        cost = a.cost + b.cost + len(a.terms) * len(b.terms)
        terms: Terms = {}
        found = self._checked(Form(terms, a.below * b.below, a.reach + b.reach, cost))
        for m, c in a.terms.items():
            for n, d in b.terms.items():
                monomial, coefficient = m + n, c * d
                if monomial & 2:  # i i = -1
                    monomial, coefficient = monomial - 2, -coefficient
                terms[monomial] = terms.get(monomial, 0) + coefficient
        return found._replace(terms=_without_zeros(terms)) if len(a.terms) > 1 else found

    def power(self, form: Form, n: int) -> Form:
        if n > (self.highest if len(form.terms) > 1 else FARTHEST):
            raise Outside
        found = ONE
        for bit in bin(n)[2:]:
            found = self.product(found, found)
            if bit == "1":
                found = self.product(form, found)
        return found

    def _checked(self, form: Form) -> Form:
        if form.cost > self.work or form.reach > FARTHEST:
            raise Outside
        return form


def _without_zeros(terms: Terms) -> Terms:
    return {monomial: coefficient for monomial, coefficient in terms.items() if coefficient}
