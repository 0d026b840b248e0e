"""The Poisson bracket, as a node: {f, g} of two functions of coordinates and momenta.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 9.5.
"""

from __future__ import annotations

from sympy import Add, Expr, diff

from derive.algebra.dimensions import Dimension, product, quotient
from derive.algebra.node import DimensionOf, ScalarNode, TextOf, explicit


class PoissonBracket(ScalarNode):
    """{f, g}. Arguments: f, g, then each coordinate followed by its momentum."""

    @property
    def pairs(self) -> tuple[tuple[Expr, Expr], ...]:
        """Each coordinate with its momentum."""
        return tuple(zip(self.args[2::2], self.args[3::2], strict=True))

    def doit(self, **hints: object) -> Expr:
        f, g = (explicit(arg) for arg in self.args[:2])
        return Add(*(diff(f, q) * diff(g, p) - diff(f, p) * diff(g, q) for q, p in self.pairs))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        q, p = self.pairs[0]
        return quotient(product([of(self.args[0]), of(self.args[1])]), product([of(q), of(p)]))

    def lowered(self, text: TextOf) -> str:
        f, g = (text(arg) for arg in self.args[:2])
        terms = []
        for pair in self.pairs:
            q, p = (text(s) for s in pair)
            terms += [f"Derivative({f}, {q})*Derivative({g}, {p}) - Derivative({f}, {p})*Derivative({g}, {q})"]
        return f"({' + '.join(terms)})"
