"""What a line says, with its names as letters: both sides of every comparison between a page and what was derived.

Everything is carried out that can be: products of vectors, integrals, brackets between limits. A vector's name stands
for three letters of its own, a tensor's for nine. A derivative or a value at a place of something that is only named
is kept apart by letters of its own: `dL/dt` is the letter "d L/d t", and d/dt of a product follows the product rule.
"""

from __future__ import annotations

from typing import Any

from sympy import (
    Add,
    Derivative,
    Expr,
    Identity,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    MatAdd,
    MatMul,
    MatrixBase,
    MatrixSymbol,
    Mul,
    Symbol,
    cancel,
    diff,
    eye,
)
from sympy.core.function import AppliedUndef

from derive.algebra import expressions as ex
from derive.algebra.expansion import FirstOrder
from derive.algebra.expressions import AXES, explicit
from derive.algebra.node import Node
from derive.algebra.rounding import Rounded
from derive.units import read_unit


def meaning(value: Any) -> Any:
    """A scalar in letters, or an explicit matrix of them; of a relation, both sides."""
    if isinstance(value, MatrixBase):
        return ImmutableDenseMatrix(*value.shape, [meaning(entry) for entry in value])
    for kinds, carried_out in _METHODS:
        if isinstance(value, kinds):
            return carried_out(value)
    if not value.args or isinstance(value, Symbol):
        return value
    if isinstance(value, Node):
        return explicit(value._evaluated(*(meaning(arg) for arg in value.args)))
    return value.func(*(meaning(arg) for arg in value.args))


def letters_of(name: str, shape: tuple[Any, Any]) -> ImmutableDenseMatrix:
    rows, columns = (int(n) for n in shape)
    marks = [[f"{AXES[i]}{AXES[j]}" for j in range(columns)] if columns > 1 else [AXES[i]] for i in range(rows)]
    return ImmutableDenseMatrix([[_letter(f"{name} {mark}") for mark in line] for line in marks])


def differentiated(value: Any, by: str) -> Any:
    if isinstance(value, MatrixBase):
        return value.applyfunc(lambda entry: differentiated(entry, by))
    letters = sorted(value.free_symbols, key=str)
    return Add(*(diff(value, s) * _letter(f"d({s})/d({by})") for s in letters))


def taken_at(value: Any, letter: Any, place: Any) -> Any:
    where = f"{letter} = {cancel(place)}"  # a b/(2 (a + b)) is the same place as a b/(2 a + 2 b)
    return value.xreplace({s: _letter(f"{s} at {where}") for s in value.free_symbols})


def over_the_mass(value: Any, position: ImmutableDenseMatrix) -> Any:
    own = {component: _letter(f"own {component}") for component in position}
    return value.xreplace(own) * _letter("dm")


def in_unit(unit: str) -> Expr:
    return read_unit(unit).factor


def _letter(name: str) -> Symbol:
    return Symbol(name, real=True)


def _integral(expr: Any) -> Any:
    limits = [tuple(meaning(part) for part in limit) for limit in expr.limits]
    return explicit(Integral(meaning(expr.function), *limits))


def _bracket(expr: Any) -> Any:
    inside, x, lower, upper = (meaning(arg) for arg in expr.args)
    return inside.subs(x, upper) - inside.subs(x, lower)


def _slope(expr: Any) -> Any:
    value, x, order = expr.args
    value = meaning(value)
    for _ in range(int(order)):
        value = differentiated(value, str(x))
    return value


def _product(expr: Any) -> Any:
    whole: Any = Integer(1)
    for factor in expr.args:
        whole = whole * meaning(factor)
    return whole


def _sum(expr: Any) -> Any:
    first, *others = (meaning(arg) for arg in expr.args)
    for other in others:
        first = first + other
    return first


def _of_time(expr: Any) -> Symbol:
    return ex.rate(ex.scalar(expr.expr.func.__name__), int(expr.derivative_count))


_METHODS: tuple[tuple[Any, Any], ...] = (
    (MatrixSymbol, lambda e: letters_of(e.name, e.shape)),
    (Identity, lambda e: ImmutableDenseMatrix(eye(3))),
    (ex.Relation, lambda e: (meaning(e.left), e.operator, meaning(e.right))),
    (ex.TimeRate, lambda e: differentiated(meaning(e.args[0]), "t")),
    (ex.CarriedRate, lambda e: differentiated(meaning(e.args[0]), "t")),
    (ex.BodyRate, lambda e: differentiated(meaning(e.args[0]), "t in the body")),
    (ex.Partial, lambda e: differentiated(meaning(e.args[0]), str(e.args[1]))),
    (ex.Slope, _slope),
    (ex.At, lambda e: taken_at(meaning(e.args[0]), e.args[1], meaning(e.args[2]))),
    (ex.Component, lambda e: meaning(e.args[0])[AXES.index(e.args[1].name)]),
    (ex.MassIntegral, lambda e: over_the_mass(meaning(e.args[0]), meaning(e.args[1]))),
    (Integral, _integral),
    (ex.Bracket, _bracket),
    (ex.Truncated | FirstOrder, lambda e: meaning(e.args[0])),
    (ex.Amount | ex.MatrixAmount, lambda e: meaning(e.args[0]) * (in_unit(e.args[1].name) if e.args[1].name else 1)),
    (Rounded, lambda e: e.args[0]),
    (Derivative, _of_time),
    (AppliedUndef, lambda e: ex.scalar(e.func.__name__)),
    (MatAdd, _sum),
    (MatMul, _product),
    (Mul, _product),
)
