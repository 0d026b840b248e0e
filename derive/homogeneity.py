"""The dimension of an expression, and the check that every line of a derivation is homogeneous.

Only the declared symbols need a dimension: a step gives its own symbol the dimension of its result, and a variable
of integration has that of its limits. `None` stands for what fits anything: zero, and numbers with units.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import reduce
from operator import mul
from typing import Any

from sympy import (
    Abs,
    Add,
    Basic,
    Function,
    Identity,
    Integral,
    MatAdd,
    MatMul,
    MatrixBase,
    MatrixSymbol,
    Mul,
    Pow,
    Symbol,
)

from derive import expressions as ex
from derive.dimensions import NUMBER, Dimension, dimension_of_kind, exponents, kind_with_article, named
from derive.errors import Complaint
from derive.evidence import Grade
from derive.step import Step

Table = dict[Any, Dimension | None]


class Inhomogeneous(Exception):
    """Two terms of one sum differ in dimension, or a function has an argument that is not a number."""

    def __init__(self, term: Any, dimension: Dimension, other: Any, expected: Dimension):
        self.term, self.dimension, self.other, self.expected = term, dimension, other, expected
        super().__init__(f"`{term}` is {named(dimension)}, but `{other}` is {named(expected)}")


def dimension_of(expr: Any, table: Mapping[Any, Dimension | None]) -> Dimension | None:
    """The dimension of an expression; raises `Inhomogeneous` with the offending term, KeyError for an unknown name."""
    if isinstance(expr, MatrixBase):
        return _common(list(expr), table)
    if isinstance(expr, Symbol | MatrixSymbol):
        return table[expr]
    if expr in table:  # such names as cos(theta) and |tau|
        return table[expr]
    if isinstance(expr, Identity):
        return NUMBER
    if isinstance(expr, ex.Amount | ex.MatrixAmount):
        return None
    if getattr(expr, "is_number", False):
        return None if ex.explicit(expr) == 0 else NUMBER
    if isinstance(expr, Add | MatAdd | ex.Terms):
        return _common(expr.args, table)
    if isinstance(expr, ex.Relation):
        return _common(expr.sides, table)
    if isinstance(expr, ex.Partial):
        above, below = (dimension_of(arg, table) for arg in expr.args)
        return None if above is None or below is None else above / below
    if isinstance(expr, ex.Slope):
        f, x = (dimension_of(arg, table) for arg in expr.args[:2])
        return None if f is None or x is None else f / x ** int(expr.args[2])
    if isinstance(expr, ex.At | ex.Truncated):
        return dimension_of(expr.args[0], table)
    if isinstance(expr, ex.TimeRate):
        moving = dimension_of(expr.args[0], table)
        return None if moving is None else moving / dimension_of_kind("time")
    if isinstance(expr, ex.Component):
        return dimension_of(expr.args[0], table)
    if isinstance(expr, ex.BodyRate):
        vector = dimension_of(expr.args[0], table)
        return None if vector is None else vector / dimension_of_kind("time")
    if isinstance(expr, ex.CarriedRate):
        return _product(dimension_of(arg, table) for arg in expr.args[:2])
    if isinstance(expr, Mul | MatMul | ex.Factors | ex.Dot | ex.Cross | ex.Outer):
        return _product(dimension_of(arg, table) for arg in expr.args)
    if isinstance(expr, ex.Ratio):
        above, below = (dimension_of(arg, table) for arg in expr.args)
        return None if above is None or below is None else above / below
    if isinstance(expr, Pow):
        base = dimension_of(expr.base, table)
        return None if base is None else base ** Fraction(expr.exp.p, expr.exp.q)
    if isinstance(expr, ex.Root):
        inside = dimension_of(expr.args[0], table)
        return None if inside is None else inside ** Fraction(1, 2)
    if isinstance(expr, ex.Norm | ex.Group | Abs):
        return dimension_of(expr.args[0], table)
    if isinstance(expr, ex.Bracket):
        antiderivative, x, *limits = expr.args
        return dimension_of(antiderivative, {**table, x: _common(limits, table)})
    if isinstance(expr, Integral):
        return _integral(expr.function, expr.limits, table)
    if isinstance(expr, ex.MassIntegral):
        return _mass_integral(expr, table)
    if isinstance(expr, Function):
        return _of_numbers(expr, table)
    raise TypeError(f"no rule for the dimension of {type(expr).__name__}")


def _common(terms: Iterable[Any], table: Mapping[Any, Dimension | None]) -> Dimension | None:
    """The one dimension of all terms of a sum."""
    first: tuple[Any, Dimension] | None = None
    for term in terms:
        dimension = dimension_of(term, table)
        if dimension is None:
            continue
        if first is None:
            first = (term, dimension)
        elif dimension != first[1]:
            raise Inhomogeneous(term, dimension, *first)
    return first[1] if first else None


def _product(dimensions: Iterable[Dimension | None]) -> Dimension | None:
    found = list(dimensions)
    return None if None in found else reduce(mul, found, NUMBER)


def _integral(function: Any, limits: Any, table: Mapping[Any, Dimension | None]) -> Dimension | None:
    inner = dict(table)
    for x, *ends in reversed(limits):  # outermost first: inner limits may contain outer variables
        inner[x] = _common(ends, inner)
    return _product([dimension_of(function, inner), *(inner[x] for x, *_ in limits)])


def _mass_integral(expr: ex.MassIntegral, table: Mapping[Any, Dimension | None]) -> Dimension | None:
    integrand, r, density, position, jacobian, *limits = expr.args
    inner = dict(table)
    for x, *ends in reversed(limits):
        inner[x] = _common(ends, inner)
    inner[r] = _common(position, inner)
    volume = _product([dimension_of(jacobian, inner), *(inner[x] for x, *_ in limits)])
    return _product([dimension_of(integrand, inner), dimension_of(density, inner), volume])


def _of_numbers(expr: Any, table: Mapping[Any, Dimension | None]) -> Dimension | None:
    for arg in expr.args:
        dimension = dimension_of(arg, table)
        if dimension not in (None, NUMBER):
            raise Inhomogeneous(arg, dimension, expr.func.__name__ + "(...)", NUMBER)
    return NUMBER


def dimension_table(declared: Mapping[Any, Dimension | None], steps: Iterable[Step]) -> tuple[Table, list[Complaint]]:
    """Every name's dimension, step by step, and a complaint for each line that is not homogeneous."""
    table: Table = {**declared, ex.PLUS_MINUS: NUMBER}
    complaints: list[Complaint] = []
    for step in steps:
        table.update(_moving_names(step))
        local = {**table, **_opened_names(step, table)}
        try:
            dimension = _of_chain(step, local)
        except Inhomogeneous as fault:
            complaints.append(_complaint(step, str(fault)))
            dimension = dimension_of_kind(step.kind) if step.kind else None
        if step.kind and dimension is not None and dimension != dimension_of_kind(step.kind):
            wanted = f"{kind_with_article(step.kind)} must have {exponents(dimension_of_kind(step.kind))}"
            complaints.append(_complaint(step, f"its dimension is {exponents(dimension)}, but {wanted}"))
        table.update(local)
        table.update(_names_of(step, dimension))
    return table, complaints


def _moving_names(step: Step) -> Table:
    """The coordinates that a step brings in, and their rates."""
    time = dimension_of_kind("time")
    return {
        (ex.rate(q, n) if n else q): dimension_of_kind(kind) / time**n for q, kind in step.coordinates for n in range(4)
    }


def _opened_names(step: Step, table: Table) -> Table:
    """Names that a definition brings in, such as the components of any angular velocity, have its kind's dimension."""
    if step.kind is None or all(e.grade is not Grade.DEFINITION for e in step.evidence):
        return {}
    free: set[Basic] = set().union(*(form.expr.free_symbols - _integrated(form.expr) for form in step.chain))
    return {name: dimension_of_kind(step.kind) for name in free if name not in table}


def _integrated(expr: Any) -> set[Basic]:
    """The variables of integration of an integral over the mass, which are no names of its own."""
    return {x for whole in expr.atoms(ex.MassIntegral) for x, *_ in whole.args[5:]}


def _of_chain(step: Step, table: Table) -> Dimension | None:
    """The common dimension of all lines of a step."""
    first: tuple[Any, Dimension] | None = None
    for form in step.chain:
        dimension = dimension_of(form.expr, table)
        if dimension is None or isinstance(form.expr, ex.Relation):  # a relation may be divided by what it pleases
            continue
        if first is None:
            first = (form.expr, dimension)
        elif dimension != first[1]:
            raise Inhomogeneous(form.expr, dimension, *first)
    return first[1] if first else None


def _names_of(step: Step, dimension: Dimension | None) -> Table:
    if dimension is None and step.kind:
        dimension = dimension_of_kind(step.kind)
    names: Table = {} if step.symbol is None else {step.symbol: dimension}
    if isinstance(step.symbol, MatrixSymbol) and step.symbol.shape == (3, 1):
        names.update(dict.fromkeys(ex.component_names(step.symbol.name), dimension))
    if isinstance(step.symbol, MatrixBase):
        names.update(dict.fromkeys(step.symbol, dimension))
    return names


def _complaint(step: Step, message: str) -> Complaint:
    return Complaint("dimension", f"`{step.key}`: {message}")
