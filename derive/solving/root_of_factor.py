"""One root of a linear or quadratic factor of a polynomial: its formula, and its value in textbook form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from sympy import Add, Expr, Integer, Mul, Poly, Pow, Rational, factor_list, gcd, sqrt
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import Factors, Ratio, Root, Terms
from derive.algebra.tidy import tidied
from derive.solving.presentation import presented
from derive.steps.signs import sign_known
from derive.steps.step import Fact

FOUR = Integer(4)


@dataclass(frozen=True)
class RootOf(Fact):
    """One root of a linear or quadratic factor of a polynomial, given by the coefficients of this factor, from the
    highest power to the lowest.

    sign    the sign before the square root, 1 or -1; 0 for a linear factor
    times   the power of the factor in the polynomial
    """

    coefficients: tuple[Expr, ...]
    sign: int
    times: int

    @property
    def discriminant(self) -> Expr:
        a, b, c = self.coefficients
        return tidied(b**2 - FOUR * a * c)

    @property
    def value(self) -> Expr:
        if len(self.coefficients) == 2:
            a, b = self.coefficients
            return tidied(-b / a)
        a, b, _ = self.coefficients
        return _drawn(a, b, self.discriminant, self.sign)

    def sign_where_real(self, sign_of: Callable[[Expr], int | None] = sign_known) -> int | None:
        """The sign of the root where the root is real; None if the sign is unknown.

        For a quadratic factor Vieta's formulas apply: if the product c/a of the roots is positive, both roots have the
        sign of their sum -b/a. If b = 0, real roots require that a and c have opposite signs.
        """
        if len(self.coefficients) == 2:
            return sign_of(self.value)
        a, b, c = self.coefficients
        upper = self.sign * (sign_of(a) or (-(sign_of(c) or 0) if b == 0 else 0))
        product, total = sign_of(tidied(c / a)), sign_of(tidied(-b / a))
        if product == -1 or b == 0:
            return upper or None
        if product == 1 and total is not None:
            return total
        if product == 0 and total:
            return total if upper == total else 0
        return sign_of(self.value)

    @property
    def formula(self) -> Expr:
        if len(self.coefficients) == 2:
            a, b = self.coefficients
            return Ratio(-b, a)
        a, b, c = self.coefficients
        under = Root(Terms(b**2, -FOUR * a * c))
        return Ratio(Terms(-b, under if self.sign > 0 else Factors(Integer(-1), under)), 2 * a)


def roots_of(factor: Poly, times: int = 1) -> list[RootOf]:
    """The root of a linear polynomial, or both roots of a quadratic polynomial, first the root with the minus sign
    before the square root."""
    coefficients = tuple(tidied(c) for c in factor.all_coeffs())
    return [RootOf(coefficients, sign, times) for sign in ((0,) if len(coefficients) == 2 else (-1, 1))]


def _drawn(a: Expr, b: Expr, discriminant: Expr, sign: int) -> Expr:
    """Write a root as k (-b/k +- sqrt(D/k^2))/(2 a), where k is a common factor of b and of the square root of D."""
    under = sqrt(discriminant)
    if not any(isinstance(part, Pow) and part.exp == Rational(1, 2) and part.free_symbols for part in under.atoms(Pow)):
        return presented((-b + sign * under) / (2 * a))
    if b == 0:
        return presented(sign * under / (2 * a), in_sums=False)
    common = _common_root(b, discriminant)
    inside = presented(discriminant / common**2, in_sums=False)
    both = Add(tidied(-b / common), sign * sqrt(inside))
    return Mul(tidied(common / (2 * a)), both)


def _common_root(b: Expr, discriminant: Expr) -> Expr:
    """A common factor k of b and of the square root of the discriminant D, such that b/k and D/k^2 stay polynomials."""
    try:
        content, factors = factor_list(gcd(b**2, discriminant))
    except PolynomialError:
        return Integer(1)
    number = sqrt(content)
    k = number if number.is_Rational else Integer(1)
    return k * Mul(*(base ** (power // 2) for base, power in factors if base.is_positive))
