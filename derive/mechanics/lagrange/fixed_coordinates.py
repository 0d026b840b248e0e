"""Coordinates and rates that several constraints together keep constant.

Two contacts of one body with a floor keep its angle and its height constant, although each contact alone only relates
the angle to the height. Two strings keep a particle at one place of a plane. Static friction in two directions keeps
two rates zero.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, combinations

from sympy import Add, Expr, Integer, Matrix, Poly, Pow, Rational, S, Symbol, cos, linsolve, sin, sqrt
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import depends_on_time, rate
from derive.algebra.tidy import tidied
from derive.steps.signs import sign_known
from derive.steps.step import is_zero

ZERO = Integer(0)
MOST = 4  # if there are more constraints than this, none of them is examined


@dataclass(frozen=True)
class KeptPositions:
    """Coordinates with their constant values, and the left sides f of the constraints f = 0 that together fix these
    values."""

    values: dict[Symbol, Expr]
    residuals: tuple[Expr, ...]


def fixed_together(residuals: Sequence[Expr], moving: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Return a mapping from coordinates to their constant values, for coordinates that at least two of the constraints
    fix together.

    residuals   f of each constraint f = 0 between coordinates
    moving      all coordinates

    First, for n constraints, test each set of n coordinates. If all constraints hold and are independent where these
    coordinates are zero, the coordinates are fixed at zero. Otherwise, look for a formula with a single coordinate: a
    sum or difference of two constraints, or a constraint from which other coordinates are eliminated. If this
    coordinate has a single admissible value, it is fixed; an angle whose sine vanishes is taken to be zero. The result
    is then empty unless the values satisfy exactly as many constraints as there are values.
    """
    if not 1 < len(residuals) <= MOST or any(map(depends_on_time, residuals)):
        return {}
    if zero := _all_zero(residuals, moving):
        return zero
    found: dict[Symbol, Expr] = {}
    while (new := _next(residuals, found, moving)) is not None:
        found[new[0]] = new[1]
    satisfied = [f for f in residuals if is_fixed_by(f, found)]
    return found if len(satisfied) == len(found) > 1 else {}


def is_fixed_by(residual: Expr, values: Mapping[Symbol, Expr]) -> bool:
    """Return whether a constraint contains some of these coordinates and holds for their values."""
    return not residual.free_symbols.isdisjoint(values) and is_zero(tidied(residual.xreplace(values)))


def _all_zero(residuals: Sequence[Expr], moving: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Return a set of coordinates with the value zero, as many as there are constraints. Where they are zero, all
    constraints hold for all values of the other coordinates, and are independent."""
    inside = [q for q in moving if any(f.has(q) for f in residuals)]
    for some in combinations(inside, len(residuals)):
        zero = dict.fromkeys(some, ZERO)
        if any(q.is_positive for q in some) or not all(is_zero(f.xreplace(zero)) for f in residuals):
            continue
        if not is_zero(Matrix(list(residuals)).jacobian(list(some)).xreplace(zero).det()):
            return zero
    return {}


def rates_at_rest(residuals: Sequence[Expr], moving: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Return the rates that vanish if all these constraints between rates hold, each with the value 0. Return an empty
    mapping if the constraints do not fix all their rates at 0."""
    rates = [rate(q) for q in moving if any(f.has(rate(q)) for f in residuals)]
    if not 1 < len(residuals) == len(rates):
        return {}
    (solved,) = linsolve(list(residuals), rates) or [()]
    return dict.fromkeys(rates, ZERO) if solved and all(is_zero(value) for value in solved) else {}


def _next(
    residuals: Sequence[Expr], found: Mapping[Symbol, Expr], moving: Sequence[Symbol]
) -> tuple[Symbol, Expr] | None:
    left = [each.xreplace(found) for each in residuals]
    for f in chain(_combined(left), _eliminated(left, moving)):
        inside = [q for q in moving if f.has(q)]
        if len(inside) == 1 and (value := _only_root(f, inside[0])) is not None:
            return inside[0], value
    return None


def _combined(residuals: Sequence[Expr]) -> Iterator[Expr]:
    """Yield the constraints, after a root of a sum is eliminated, and the sums and differences of each pair."""
    forms = [_without_root(f) for f in residuals]
    yield from forms
    for one, other in combinations(forms, 2):
        yield tidied((one - other).expand())
        yield tidied((one + other).expand())


def _eliminated(residuals: Sequence[Expr], moving: Sequence[Symbol]) -> list[Expr]:
    """Use each constraint q = f(other coordinates) to eliminate q, and return the other constraints, without a root of
    a sum."""
    left = [*residuals]
    while solved := next(((f, q) for f in left for q in moving if derivative(f, q) in (1, -1)), None):
        f, q = solved
        value = q - f / derivative(f, q)
        left = [tidied(each.xreplace({q: value})) for each in left if each is not f]
    return [tidied(_without_root(f)) for f in left]


def _without_root(f: Expr) -> Expr:
    """Return a^2 - b^2 S in place of a + b sqrt(S)."""
    roots = [p for p in f.atoms(Pow) if p.exp == Rational(1, 2) and p.base.is_Add]
    if len(roots) != 1:
        return f.expand()
    mark = Symbol("mark")
    marked = f.xreplace({roots[0]: mark})
    b = derivative(marked, mark)
    a = marked.xreplace({mark: ZERO})
    return (a**2 - b**2 * roots[0].base).expand() if not b.has(mark) else f.expand()


def _only_root(f: Expr, q: Symbol) -> Expr | None:
    """Return the only admissible root q of f(q) = 0. For a multiple of sin(q), return 0. Return None if there are
    several admissible roots or none, or if no formula for them is known."""
    if f.has(sin(q), cos(q)):
        return ZERO if not tidied(f / sin(q)).has(q) else None
    try:
        c = Poly(f, q).all_coeffs()
    except PolynomialError:
        return None
    if len(c) == 2:
        return tidied(-c[1] / c[0])
    if len(c) != 3:
        return None
    half = sqrt(tidied(c[1] ** 2 - 4 * c[0] * c[2]))
    roots = {tidied(Add(-c[1], sign * half) / (2 * c[0])) for sign in (1, -1)}
    admissible = [r for r in roots if not (q.is_positive and sign_known(r) in (0, -1)) and r.is_real is not False]
    return admissible[0] if len(admissible) == 1 and admissible[0] is not S.NaN else None
