"""The factor between a multiplier and the constraint force: the length of the gradient of the condition in space.

For a condition f = c with the multiplier lambda, the virtual work of the constraint force is lambda df. The force on a
particle is therefore lambda times the gradient of f. If there is only one particle and this gradient has the length 1,
the magnitude of the force is |lambda|.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4; Lanczos, *The Variational Principles of Mechanics*,
chapter III.
"""

from __future__ import annotations

from sympy import Add, Expr, ImmutableDenseMatrix, sqrt
from sympy.matrices.exceptions import NonInvertibleMatrixError

from derive.algebra.amplitudes import inverse_of
from derive.algebra.derivatives import derivative
from derive.algebra.tidy import tidied
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.description import description_behind
from derive.steps.step import Quantity


def gradient_length(kept: Constraint, lagrangian: Quantity) -> Expr | None:
    """The length of the gradient of f with respect to the position of a single particle, divided by `kept.gradient`.

    The coordinates must allow every displacement of this particle, without redundant coordinates. In other cases, and
    for a constraint on rates, the result is None.
    """
    described = description_behind(lagrangian)
    description = described.description if described is not None else None
    if description is None or description.bodies or len(description.particles) != 1 or kept.in_rates:
        return None
    (particle,) = description.particles
    q = [symbol for symbol, _ in description.coordinates]
    jacobian = ImmutableDenseMatrix([[derivative(c, s) for s in q] for c in particle.place])
    if jacobian.shape[0] != jacobian.shape[1]:
        return None
    slopes = ImmutableDenseMatrix([kept.along(s) for s in q])
    try:
        gradient = inverse_of(jacobian.T) * slopes
    except NonInvertibleMatrixError:
        return None
    square = tidied(Add(*(c**2 for c in gradient)))
    return sqrt(_where_kept(square, kept))


def _where_kept(square: Expr, kept: Constraint) -> Expr:
    """Simplify a square with the condition: 4 l^2, not 4 x^2 + 4 y^2, for the condition x^2 + y^2 = l^2."""
    moving = list(kept.coordinates)
    divided, condition = square.as_poly(*moving), kept.residual.as_poly(*moving)
    if divided is None or condition is None or divided.total_degree() < condition.total_degree():
        return square
    return tidied(divided.rem(condition).as_expr())
