"""Solve equations of motion for their highest rates; the equations are linear in these rates."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Integer, Matrix, Symbol, diff

from derive.algebra.expressions import Relation, bound, explicit, rate
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.steps.step import Quantity

HIGHEST = 2  # highest order of a rate that equations of motion determine


def highest_rates(equations: Sequence[Quantity], moving: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Solve equations of motion for their highest rates. Reject equations that do not determine these rates."""
    residuals = [_equation(equation).residual.expand() for equation in equations]
    unknown = [highest for q in moving if (highest := _highest(q, residuals)) is not None]
    matrix = Matrix([[diff(residual, a) for a in unknown] for residual in residuals])
    rest = Matrix([bound(residual, dict.fromkeys(unknown, Integer(0))) for residual in residuals])
    if not unknown or matrix.rows != matrix.cols or matrix.has(*unknown) or tidied(matrix.det()) == 0:
        count = "1 equation" if len(equations) == 1 else f"{len(equations)} equations"
        message = f"derive cannot solve {count} of motion for {', '.join(a.name for a in unknown) or 'any rate'}"
        raise Rejected(Complaint("wrong-argument", message, help="give one equation for each coordinate that moves"))
    return dict(zip(unknown, (tidied(value) for value in matrix.LUsolve(-rest)), strict=True))


def _equation(quantity: Quantity) -> Relation:
    value = quantity.value
    if not (isinstance(value, Relation) and value.operator == "="):
        raise Rejected(Complaint("wrong-argument", f"`{quantity.key}` is not an equation"))
    return explicit(value)  # type: ignore[no-any-return]


def _highest(q: Symbol, residuals: Sequence[Expr]) -> Symbol | None:
    present = {s for residual in residuals for s in residual.free_symbols}
    return next((rate(q, n) for n in range(HIGHEST, 0, -1) if rate(q, n) in present), None)
