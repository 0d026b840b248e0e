"""Roots without a closed form, of polynomials with only real roots: a root is identified by its place in ascending
order.

If the coefficients are rational numbers, the value of a root is exact: an algebraic number of SymPy, which can be
computed to any number of digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mpmath
from sympy import CRootOf, Expr, Poly, Symbol, Tuple
from sympy.abc import x as _ANY

from derive.algebra.dimensions import Dimension, quotient
from derive.algebra.node import DimensionOf, ScalarNode, TextOf, explicit

__all__ = ["OrderedRoot", "root_in_order"]


class OrderedRoot(ScalarNode):
    """A root of a polynomial with only real roots. Arguments: the coefficients from the highest power, the place of the
    root in ascending order, its name."""

    def __new__(cls, coefficients: Sequence[Expr], number: int, name: Symbol) -> Any:
        return super().__new__(cls, Tuple(*coefficients), number, name)

    @property
    def free_symbols(self) -> set[Any]:
        return set(self.args[0].free_symbols)

    @property
    def name(self) -> Symbol:
        """The symbol of the root; its name includes the place of the root."""
        return self.args[2]

    @property
    def variables(self) -> tuple[Expr, ...]:
        return (self.args[2],)

    def doit(self, **hints: object) -> Expr:
        coefficients, number, name = self.args
        known = [explicit(each) for each in coefficients]
        if all(each.is_Rational for each in known):
            return CRootOf(Poly(known, _ANY), int(number) - 1, radicals=False)
        return OrderedRoot(known, number, name)

    def dimension(self, of: DimensionOf) -> Dimension | None:
        """The dimension of the second coefficient divided by the dimension of the first, since all terms of the
        polynomial have the same dimension."""
        highest, second = self.args[0][:2]
        return quotient(of(second), of(highest))

    def lowered(self, text: TextOf) -> str:
        """The root as an undefined function, because SymPy has such roots only for numerical coefficients."""
        coefficients, number, _ = self.args
        return f"Function('ordered_root')({', '.join(text(each) for each in coefficients)}, {number})"


def root_in_order(coefficients: Sequence[Any], number: int) -> Any:
    """The root at this place in ascending order: a floating-point root, improved by Newton's method to the precision of
    mpmath."""
    from numpy import roots

    mp = mpmath.mp
    with mp.workprec(2 * mp.prec):
        terms = [mp.mpf(each) for each in coefficients]
        floats = [float(term / max(map(abs, terms))) for term in terms]
        found, before = mp.mpf(sorted(roots(floats).real)[number - 1]), mp.inf
        for _ in range(60):
            value, slope = mp.polyval(terms, found, derivative=1)
            if slope == 0 or abs(value / slope) >= before:
                break
            found, before = found - value / slope, abs(value / slope)
    return +found
