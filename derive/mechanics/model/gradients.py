"""The factor between a multiplier and its force: the length of the gradient of its condition in space.

A multiplier lambda does the work lambda df. If the gradient of f has the length 1 on the only particle, lambda is the
magnitude of the force; otherwise the force on a particle is lambda times that gradient.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4; Lanczos, *The Variational Principles of Mechanics*,
section III.2.
"""

from __future__ import annotations

from sympy import Add, Expr, ImmutableDenseMatrix, sqrt
from sympy.matrices.exceptions import NonInvertibleMatrixError

from derive.algebra.derivatives import derivative
from derive.algebra.tidy import tidied
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.described import Described
from derive.steps.step import Quantity


def gradient_length(kept: Constraint, lagrangian: Quantity) -> Expr | None:
    """The length of a condition's gradient by the place of a single particle whose coordinates leave it free to move;
    None for several particles, for bodies, or for a condition on rates."""
    described = next((known for q in lagrangian.ancestors() if (known := q.fact(Described)) is not None), None)
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
        gradient = jacobian.T.inv() * slopes
    except NonInvertibleMatrixError:
        return None
    square = tidied(Add(*(c**2 for c in gradient)))
    return sqrt(_where_kept(square, kept))


def _where_kept(square: Expr, kept: Constraint) -> Expr:
    """4 l^2, not 4 x^2 + 4 y^2, for the condition x^2 + y^2 = l^2."""
    moving = list(kept.coordinates)
    divided, condition = square.as_poly(*moving), kept.residual.as_poly(*moving)
    if divided is None or condition is None or divided.total_degree() < condition.total_degree():
        return square
    return tidied(divided.rem(condition).as_expr())
