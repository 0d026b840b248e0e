"""Invert momenta p that are not linear in the rates v, if L contains v only in linear terms and in one quadratic form.

Then p_i - b_i = g(s) (A v)_i with s = v . A v, where b is the value of p at v = 0. So v has the direction of
w = A^-1 (p - b), and v = u w. The factor u follows from g(u^2 S) u = 1 with S = w . A w. For a relativistic particle
g = 1/sqrt(1 - s/(m c^2)), so u = 1/sqrt(1 + S/(m c^2)).

Source: Landau, Lifshitz, *The Classical Theory of Fields*, section 9.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Dummy, Expr, Matrix, Symbol, diff, solve, sqrt

from derive.algebra.equality import equal
from derive.algebra.expressions import bound, explicit
from derive.algebra.tidy import tidied
from derive.solving.presentation import roots_together

MOST_OPERATIONS = 300  # greatest number of operations in the equation for u


def by_quadratic_form(momenta_of: Mapping[Symbol, Expr], rates: Sequence[Symbol]) -> dict[Symbol, Expr] | None:
    """Return each rate with its expression in the momenta. Return None if L contains the rates in any way other than in
    one quadratic form with diagonal A and in linear terms, or if u is not found."""
    at_rest = dict.fromkeys(rates, 0 * rates[0])
    values = [explicit(p) for p in momenta_of.values()]
    beside = [bound(p, at_rest) for p in values]
    bare = Matrix([p - b for p, b in zip(values, beside, strict=True)])
    form = Matrix([[bound(diff(p, v), at_rest) for v in rates] for p in values])
    if form.has(*rates) or not form.is_diagonal() or any(entry.is_zero is not False for entry in form.diagonal()):
        return None
    stretch = _stretch(bare, form, rates)
    if stretch is None:
        return None
    s, g = stretch
    size = Dummy("S", positive=True)
    factor_of = _length(g, s, size)
    if factor_of is None:
        return None
    own = [(p - b) / form[i, i] for i, (p, b) in enumerate(zip(momenta_of, beside, strict=True))]
    squared = sum((form[i, i] * w**2 for i, w in enumerate(own)), 0 * rates[0])
    u = roots_together(factor_of.xreplace({size: squared}))
    return {v: roots_together(w * u) for v, w in zip(rates, own, strict=True)}


def _stretch(bare: Matrix, form: Matrix, rates: Sequence[Symbol]) -> tuple[Symbol, Expr] | None:
    """Return s and g(s). Find g from the case in which only the first rate is nonzero, then check it for all rates;
    return None if the check fails."""
    s = Dummy("s", nonnegative=True)
    along = {rates[0]: sqrt(s / form[0, 0]), **dict.fromkeys(rates[1:], 0 * rates[0])}
    g = tidied(bound(bare[0], along) / (form[0, 0] * along[rates[0]]))
    whole = sum((form[i, i] * v**2 for i, v in enumerate(rates)), 0 * rates[0])
    if g.has(*rates) or not all(equal(bare[i], g.xreplace({s: whole}) * form[i, i] * v) for i, v in enumerate(rates)):
        return None
    return s, g


def _length(g: Expr, s: Symbol, size: Symbol) -> Expr | None:
    """Return the positive root u of g(u^2 S) u = 1 that is 1 for S = 0. Return None if the equation is too long, or if
    SymPy does not find this root."""
    u = Dummy("u", positive=True)
    equation = g.xreplace({s: u**2 * size}) * u - 1
    if equation.count_ops() > MOST_OPERATIONS:
        return None
    try:
        found = [root for root in solve(equation, u) if not root.has(u)]
    except NotImplementedError:  # the caller then rejects the momenta
        return None
    return next((root for root in found if root.xreplace({size: 0 * size}) == 1), None)
