"""The integral of f(r) dm over a body, as a node, and the dimensions of the variables of an integral."""

from __future__ import annotations

from typing import Any

from sympy import Integral

from derive.algebra.dimensions import Dimension, product
from derive.algebra.kinds import common
from derive.algebra.node import DimensionOf, MatrixNode, TextOf, Value, explicit


class MassIntegral(MatrixNode):
    """The integral of f(r) dm over a body, where f is a vector or a tensor.

    Arguments, in this order:

    - f, which contains the vector name r; and the name r;
    - the density;
    - the position as a function of the coordinates of the region;
    - the volume element divided by the differentials of these coordinates;
    - the limits, innermost first.
    """

    @property
    def shape(self) -> tuple[Any, Any]:
        return self.args[0].shape  # type: ignore[no-any-return]

    @property
    def variables(self) -> tuple[Any, ...]:
        return (self.args[1], *(x for x, *_ in self.args[5:]))

    def doit(self, **hints: Any) -> Value:
        integrand, r, density, position, jacobian, *limits = self.args
        at = explicit(integrand.xreplace({r: position}))
        outside, inside = density.as_independent(*(x for x, *_ in limits), as_Add=False)
        return at.applyfunc(lambda f: outside * explicit(Integral(inside * f * jacobian, *limits)))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        integrand, _, density, _, jacobian, *limits = self.args
        inner = self.dimensions_inside(of)
        parts = [of(part, inner) for part in (integrand, density, jacobian)]
        return product([*parts, *(inner[x] for x, *_ in limits)])

    def dimensions_inside(self, of: DimensionOf) -> dict[Any, Dimension | None]:
        """The dimensions of the variables that the integral binds."""
        _, r, _, position, _, *limits = self.args
        inner = dimensions_of_variables(limits, of)
        inner[r] = common(position, lambda entry: of(entry, inner))
        return inner

    def lowered(self, text: TextOf) -> str:
        integrand, r, density, position, jacobian, *limits = self.args
        at = explicit(integrand.xreplace({r: position}))
        return text(at.applyfunc(lambda f: Integral(density * f * jacobian, *limits)))


def dimensions_of_variables(limits: Any, of: DimensionOf) -> dict[Any, Dimension | None]:
    """The dimension of each variable of integration, from its limits."""
    inner: dict[Any, Dimension | None] = {}
    for x, *ends in reversed(limits):
        inner[x] = common(ends, lambda end: of(end, inner))
    return inner
