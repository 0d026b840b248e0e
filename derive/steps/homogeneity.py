"""The dimension of an expression, and the check that every line of a derivation is homogeneous.

Only the declared symbols need a dimension. The symbol of a step gets the dimension of the result, and a variable of
integration gets the dimension of the limits. Zero has the dimension `None`, which fits any other dimension.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from typing import Any
from zlib import crc32

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
    Rational,
    Symbol,
)

from derive.algebra import expressions as ex
from derive.algebra.dimensions import NUMBER, Dimension, exponents, power, product
from derive.algebra.equality import Grade
from derive.algebra.kinds import Inhomogeneous, common, dimension_of_kind, kind_with_article
from derive.algebra.mass_integral import MassIntegral, dimensions_of_variables
from derive.algebra.node import DimensionOf, Node
from derive.errors import Complaint, Place, Rejected
from derive.steps.step import Step

Table = dict[Any, Dimension | None]


def dimension_of(expr: Any, table: Mapping[Any, Dimension | None]) -> Dimension | None:
    """Return the dimension of an expression; None fits every dimension.

    Errors: `Inhomogeneous` if the parts do not fit together; `KeyError` for a name that is not in the table;
    `TypeError` for an expression without a rule.
    """

    def of(part: Any, variables: Mapping[Any, Dimension | None] | None = None) -> Dimension | None:
        return dimension_of(part, {**table, **variables} if variables else table)

    if isinstance(expr, MatrixBase):
        return common(list(expr), of)
    if isinstance(expr, ex.Prescribed):
        return expr.dimension
    if isinstance(expr, Symbol | MatrixSymbol):
        return table[expr]
    if expr in table:  # names that are expressions, such as cos(theta) and |tau|
        return table[expr]
    if isinstance(expr, Identity):
        return NUMBER
    if getattr(expr, "is_number", False):
        return None if ex.explicit(expr) == 0 else NUMBER
    if isinstance(expr, Node):
        return expr.dimension(of)
    if isinstance(expr, Add | MatAdd):
        return common(expr.args, of)
    if isinstance(expr, Mul | MatMul):
        return product(of(arg) for arg in expr.args)
    if isinstance(expr, Pow):
        return power(of(expr.base), _number_of(expr.exp))
    if isinstance(expr, Abs):
        return of(expr.args[0])
    if isinstance(expr, Integral):
        inner = dimensions_of_variables(expr.limits, of)
        return product([of(expr.function, inner), *(inner[x] for x, *_ in expr.limits)])
    if isinstance(expr, Function):
        return _of_numbers(expr, of)
    raise TypeError(f"no rule for the dimension of {type(expr).__name__}")


def _number_of(exponent: Any) -> Fraction:
    """Return an exponent as a number, with fixed numbers for its symbols."""
    some = {s: Rational(101 + crc32(s.name.encode()) % 97, 89) for s in exponent.free_symbols}
    value = ex.explicit(exponent.xreplace(some))
    if not isinstance(value, Rational):
        raise TypeError(f"no rule for the exponent {exponent}")
    return Fraction(value.p, value.q)


def _of_numbers(expr: Any, of: DimensionOf) -> Dimension | None:
    for arg in expr.args:
        dimension = of(arg)
        if dimension not in (None, NUMBER):
            raise Inhomogeneous(arg, dimension, expr.func.__name__ + "(...)", NUMBER)
    return NUMBER


def dimension_table(
    declared: Mapping[Any, Dimension | None], steps: Iterable[Step], script: Place | None = None
) -> tuple[Table, list[Complaint]]:
    """Return the dimensions of the names, and an error for each step that is not homogeneous or does not fit its kind.

    A symbol that is neither given nor a coordinate nor introduced by a step is rejected; this error has the place
    `script`.
    """
    table: Table = {**declared, ex.PLUS_MINUS: NUMBER, ex.TIME: dimension_of_kind("time")}
    complaints: list[Complaint] = []
    for step in steps:
        table.update(_moving_names(step))
        local = {**table, **_opened_names(step, table)}
        try:
            dimension = _of_chain(step, local)
        except KeyError as unknown:
            message = f"`{step.key}` contains {unknown.args[0]}, which is neither given nor a coordinate"
            help_line = 'ask for it in `solve()`, or name a variable with `coordinate("...")`'
            raise Rejected(Complaint("unknown-letter", message, script, help=help_line)) from None
        except Inhomogeneous as mismatch:
            complaints.append(_complaint(step, str(mismatch)))
            dimension = dimension_of_kind(step.kind) if step.kind else None
        if step.kind and dimension is not None and dimension != dimension_of_kind(step.kind):
            wanted = f"{kind_with_article(step.kind)} must have {exponents(dimension_of_kind(step.kind))}"
            complaints.append(_complaint(step, f"its dimension is {exponents(dimension)}, but {wanted}"))
        table.update(local)
        table.update(_names_of(step, dimension))
    return table, complaints


def variables_of_integrals(step: Step, table: Mapping[Any, Dimension | None]) -> Table:
    """Return the dimensions of the variables in the integrals of a step; a dimension is None if two integrals disagree.

    table   the dimensions of the other names in the lines of the step
    """
    found: Table = {}
    for form in step.chain:
        for name, dimension in _variables_in(form.expr, table):
            found[name] = dimension if found.get(name, dimension) == dimension else None
    return found


def _variables_in(expr: Any, table: Mapping[Any, Dimension | None]) -> Iterator[tuple[Any, Dimension | None]]:
    """Yield the variables of integration that a page prints in an expression, each with its dimension. For an integral
    over the mass, only the position r is printed."""

    def of(part: Any, variables: Mapping[Any, Dimension | None] | None = None) -> Dimension | None:
        return dimension_of(part, {**table, **variables} if variables else table)

    inner: Table = {}
    if isinstance(expr, MassIntegral):
        r = expr.args[1]
        yield r, expr.dimensions_inside(of)[r]
        return
    if isinstance(expr, Integral):
        inner = dimensions_of_variables(expr.limits, of)
    elif isinstance(expr, ex.Bracket):
        _, x, *limits = expr.args
        inner = {x: common(limits, of)}
    yield from inner.items()
    for part in expr.args:
        yield from _variables_in(part, {**table, **inner} if inner else table)


def _moving_names(step: Step) -> Table:
    """Return the dimensions of the coordinates that a step introduces, and of their rates. The dimension is None for a
    name without a kind."""
    time = dimension_of_kind("time")
    return {
        (ex.rate(q, n) if n else q): dimension_of_kind(kind) / time**n if kind else None
        for q, kind in step.coordinates
        for n in range(4)
    }


def _opened_names(step: Step, table: Table) -> Table:
    """Return the dimensions of names that a definition introduces, such as the components of a general angular
    velocity."""
    if step.kind is None or all(e.grade is not Grade.DEFINITION for e in step.evidence):
        return {}
    free: set[Basic] = set().union(*(_free(form.expr) for form in step.chain))
    return {name: dimension_of_kind(step.kind) for name in free if name not in table}


def _free(expr: Any) -> set[Basic]:
    bound = {x for node in expr.atoms(Node) for x in node.variables}
    return {name for name in expr.free_symbols if name not in bound}


def _of_chain(step: Step, table: Table) -> Dimension | None:
    """Return the common dimension of those lines of a step that are not relations; None if it is unknown. Raise
    `Inhomogeneous` if the dimensions differ, or if the two sides of a relation have different dimensions."""
    first: tuple[Any, Dimension] | None = None
    for form in step.chain:
        dimension = dimension_of(form.expr, table)
        if dimension is None or isinstance(form.expr, ex.Relation):  # lines of a relation may differ by a factor
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
