"""Decide exactly whether an expression is zero.

Polynomials in symbols, sines and cosines have a normal form (`trig_polynomials`). For other expressions, a ring has
additional letters that represent roots, absolute values and other functions.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from sympy import (
    Abs,
    Dummy,
    Expr,
    Integer,
    Mul,
    Pow,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    cos,
    expand_trig,
    igcd,
    ilcm,
    nan,
    oo,
    pi,
    sin,
    tan,
    zoo,
)
from sympy.polys.polyerrors import PolynomialError

from derive.algebra import trig_polynomials
from derive.algebra.expressions import explicit
from derive.algebra.function_ring import HIGHEST, FunctionRing
from derive.algebra.ranges import with_positive_factors_out, without_abs
from derive.algebra.samples import is_zero_everywhere
from derive.algebra.sparse_polynomials import Outside
from derive.algebra.trig_polynomials import asked

LARGEST = 4000  # greatest number of operations of an expression that is rewritten in terms of smaller angles


def vanishes(expr: Expr) -> bool:
    """Whether the expression is zero, decided exactly; False means "not shown", never "not zero"."""
    expr = without_abs(explicit(expr))
    if expr == 0:
        return True
    if not isinstance(expr, Expr) or expr.has(nan, zoo, oo, -oo):
        return False
    try:
        return trig_polynomials.is_zero(expr)
    except Outside:
        return _vanishes_by_relations(with_positive_factors_out(expr))


def is_identity(left: Expr, right: Expr) -> bool:
    """Whether two expressions have the same normal form in symbols, sines and cosines; False means "not shown"."""
    try:
        return trig_polynomials.are_equal(left, right)
    except Outside:
        return False


@lru_cache(maxsize=4096, typed=True)
def _vanishes_by_relations(expr: Expr) -> bool:
    try:
        expr = _with_common_angles(expr)
        return not expr.has(nan, zoo) and _is_zero(expr) and not any(map(_is_nothing, _divisors(expr)))
    except (Outside, PolynomialError, NotImplementedError, ZeroDivisionError, ValueError):  # too large or 0/0
        return False


def _is_zero(expr: Expr) -> bool:
    return asked(FunctionRing, lambda ring: ring.is_zero(ring.form(expr)), expr)


def _divisors(expr: Expr) -> set[Expr]:
    return {power.base for power in expr.atoms(Pow) if power.exp.is_negative and not power.base.is_Symbol}


def _is_nothing(divisor: Expr) -> bool:
    """Whether a divisor is zero everywhere, so that a quotient which seems to be zero is 0/0."""
    if asked(FunctionRing, lambda ring: ring.is_nonzero(ring.form(divisor)), divisor):
        return False
    everywhere = is_zero_everywhere(divisor)
    return _is_zero(divisor) if everywhere is None else everywhere


def _hides_angles(expr: Expr) -> bool:
    """Whether a sine, cosine or tangent is under a root or in an absolute value, or an angle contains pi or an inverse
    function."""
    under = (root for root in expr.atoms(Pow, Abs) if not (root.is_Pow and root.exp.is_Integer))
    angles = (function.args[0] for function in expr.atoms(sin, cos, tan))
    return any(each.has(sin, cos, tan) for each in under) or any(each.has(acos, asin, atan, pi) for each in angles)


def _with_common_angles(expr: Expr) -> Expr:
    """If `_hides_angles` is true for an expression, rewrite the expression with sines and cosines of smaller angles."""
    if not _hides_angles(expr):
        return expr
    expr = expr.replace(lambda e: isinstance(e, tan), lambda e: sin(e.args[0]) / cos(e.args[0]))
    functions = expr.atoms(sin, cos)
    if all(function.args[0].is_Symbol for function in functions):
        return expr
    if expr.count_ops() > LARGEST:
        raise Outside
    units = _smallest_angles(functions)
    replaced = {}
    for function in functions:
        terms = [_as_multiple(term, units) for term in _angle_terms(function.args[0])]
        inner = sum((n * unit for n, unit in terms), Integer(0))
        replaced[function] = expand_trig(function.func(inner))
    expanded = expr.xreplace(replaced)
    return expanded.xreplace({dummy: angle for angle, dummy in units.values()})


def _angle_terms(angle: Expr) -> list[tuple[Rational, Expr]]:
    return [term.as_coeff_Mul(rational=True) for term in angle.expand().as_ordered_terms()]


def _smallest_angles(functions: set[Any]) -> dict[Expr, tuple[Expr, Symbol]]:
    """For each group of angles with rational ratios, return the largest angle of which all are whole multiples, and a
    dummy symbol for this angle."""
    found: dict[Expr, list[Rational]] = {}
    for function in functions:
        for coefficient, rest in _angle_terms(function.args[0]):
            found.setdefault(rest, []).append(coefficient)
    units = {}
    for rest, coefficients in found.items():
        denominator = ilcm(1, *(c.q for c in coefficients))
        numerator = igcd(0, *(c.p * (denominator // c.q) for c in coefficients)) or 1
        units[rest] = (Mul(Rational(numerator, denominator), rest), Dummy("angle", real=True))
    return units


def _as_multiple(term: tuple[Rational, Expr], units: dict[Expr, tuple[Expr, Symbol]]) -> tuple[Integer, Expr]:
    coefficient, rest = term
    angle, dummy = units[rest]
    multiple = Integer(coefficient / angle.as_coeff_Mul(rational=True)[0])
    if abs(multiple) > HIGHEST:
        raise PolynomialError(f"the factor {multiple} of an angle is too large to expand")
    return multiple, dummy
