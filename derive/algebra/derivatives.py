"""Partial derivatives of sums, products, integer powers, sines, cosines and absolute values; SymPy differentiates the
other functions.

The derivative with respect to the time includes the derivatives of prescribed functions of the time.
Where u is not zero, the derivative of |u|, such as a distance along a line, is u/|u| times the derivative of u.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from sympy import Abs, Add, Expr, Integer, MatrixBase, Mul, Pow, Symbol, cos, diff, sign, sin

from derive.algebra.prescribed import Prescribed

__all__ = ["derivative"]

ZERO, ONE = Integer(0), Integer(1)


def derivative(expr: Any, *by: Symbol | int) -> Any:
    """The partial derivative with respect to each symbol in turn; a number after a symbol is the order of the
    derivative with respect to this symbol. A matrix is differentiated entry by entry."""
    if isinstance(expr, MatrixBase):
        return expr.applyfunc(lambda entry: derivative(entry, *by))
    for s in _in_turn(by):
        expr = _derivative(expr, s) if isinstance(expr, Expr) and isinstance(s, Symbol) else diff(expr, s)
    return expr


def _in_turn(by: Sequence[Symbol | int]) -> list[Symbol]:
    letters: list[Symbol] = []
    for each in by:
        letters += [each] if isinstance(each, Symbol) else [letters.pop()] * int(each)
    return letters


@lru_cache(maxsize=16384)
def _letters(expr: Expr) -> frozenset[Symbol]:
    if expr.is_Symbol:
        return frozenset(expr.free_symbols)
    if expr.is_Add or expr.is_Mul or expr.is_Pow or isinstance(expr, sin | cos):
        return frozenset().union(*map(_letters, expr.args))
    return frozenset(expr.free_symbols)


def _derivative(expr: Expr, s: Symbol) -> Expr:
    if isinstance(expr, Prescribed):
        return diff(expr, s)
    if expr.is_Atom:
        return ONE if expr == s else ZERO
    return _derivative_by_parts(expr, s) if s in _letters(expr) else ZERO


@lru_cache(maxsize=16384)
def _derivative_by_parts(expr: Expr, s: Symbol) -> Expr:
    if expr.is_Add:
        return Add(*(_derivative(term, s) for term in expr.args))
    if expr.is_Mul:
        return Add(*_by_factors(expr, s))
    if isinstance(expr, Pow) and expr.exp.is_Integer:
        inner = _derivative(expr.base, s)
        return expr * (inner * expr.exp / expr.base) if inner else ZERO
    if isinstance(expr, sin | cos):
        inner = _derivative(expr.args[0], s)
        outer = cos(expr.args[0]) if isinstance(expr, sin) else -sin(expr.args[0])
        return outer * inner if inner else ZERO
    if isinstance(expr, Abs) and expr.args[0].is_real:
        inner = _derivative(expr.args[0], s)
        return expr.args[0] / expr * inner if inner else ZERO
    return _along_distances(expr, s)


def _along_distances(expr: Expr, s: Symbol) -> Expr:
    """The derivative that SymPy computes, with u/|u| in place of the sign of u."""
    found = diff(expr, s)
    return found.replace(sign, lambda u: u / Abs(u)) if found.has(sign) else found


def _by_factors(product: Mul, s: Symbol) -> list[Expr]:
    factors, terms = product.args, []
    for i, factor in enumerate(factors):
        inner = _derivative(factor, s)
        if inner:
            terms.append(Mul(*factors[:i], inner, *factors[i + 1 :]))
    return terms
