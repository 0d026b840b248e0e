"""Unknowns: expressions for which an equation may be solved or a value may be substituted, such as a symbol or a
cosine.

An unknown is an expression of one symbol, such as theta_dot^2 or cos(theta). A substitution replaces the unknown
wherever it occurs. An equation that also contains the symbol outside the unknown usually cannot be solved for this
unknown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import (
    Dummy,
    Expr,
    Function,
    Integer,
    Matrix,
    Mul,
    Pow,
    Symbol,
    acos,
    asin,
    atan,
    cos,
    sin,
    tan,
)

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import RATES, Relation, explicit, rate
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension
from derive.algebra.lowest_terms import factored
from derive.algebra.ranges import never_vanishes_within
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.solving.presentation import LARGEST
from derive.steps.record import assume
from derive.steps.step import Fact, Quantity

INVERSE = {cos: acos, sin: asin, tan: atan}
UNKNOWNS = "a symbol, a positive integer power of a symbol, or the sine, cosine or tangent of a symbol"


@dataclass(frozen=True)
class ValueOf(Fact):
    """A fact of a root of an equation: the unknown of this equation. The root can replace this unknown even if the
    symbol of the root is different."""

    missing = "is not a root of an equation"
    unknown: Expr


def unknown_of(verb: str, given: Any) -> Expr:
    """The unknown that an argument of a verb names: a symbol, or an expression such as cos(theta). Rejects any other
    argument.
    """
    found = getattr(given, "symbol", given)
    if isinstance(found, Symbol) or _letter_within(found) is not None:
        return found
    message = f"the unknown of `{verb}` must be {UNKNOWNS}, but it is {found}"
    raise Rejected(Complaint("wrong-argument", message))


def _letter_within(unknown: Any) -> Symbol | None:
    if isinstance(unknown, Pow) and isinstance(unknown.base, Symbol) and unknown.exp.is_Integer and unknown.exp > 0:
        return unknown.base
    if isinstance(unknown, Function) and unknown.func in INVERSE and isinstance(unknown.args[0], Symbol):
        return unknown.args[0]
    return None


def letter_of(unknown: Expr) -> Symbol:
    """The symbol in an unknown, such as theta in cos(theta); rejects any other expression."""
    found = unknown if isinstance(unknown, Symbol) else _letter_within(unknown)
    if found is None:
        raise Rejected(Complaint("wrong-argument", f"{unknown} is not {UNKNOWNS}"))
    return found


def meaning(unknown: Expr, value: Expr) -> dict[Symbol, Expr]:
    """Return the value of the symbol in the unknown: for cos(theta) = 2/3, theta is acos(2/3)."""
    if isinstance(unknown, Symbol):
        return {unknown: value}
    letter = letter_of(unknown)
    if isinstance(unknown, Pow):
        return {letter: Pow(value, 1 / unknown.exp)}
    return {letter: INVERSE[unknown.func](value)}


def with_unknown(expr: Expr, unknown: Expr, value: Expr) -> Expr:
    """Substitute a value for the unknown, also in expressions that contain it only implicitly.

    A value of theta_dot^2 is substituted in theta_dot^4, a value of cos(theta) in sin(theta)^2, and a value of
    tan(theta) in sin(theta) = tan(theta) cos(theta).
    """
    if isinstance(unknown, Symbol):
        return expr.xreplace({unknown: value})
    if isinstance(unknown, Pow):
        base, n = unknown.args

        def power(e: Expr) -> Expr:
            return value ** (e.exp / n)

        return expr.replace(lambda e: isinstance(e, Pow) and e.base == base and (e.exp / n).is_Integer, power)
    angle = unknown.args[0]
    other = {cos: sin, sin: cos}.get(unknown.func)
    found = expr.xreplace({unknown: value})
    if unknown.func is tan and found.has(sin(angle)):
        return factored(found.xreplace({sin(angle): value * cos(angle)}))
    if other is None or not found.has(other(angle)):
        return found

    def square(e: Expr) -> Expr:
        return (1 - value**2) ** (e.exp / 2)

    return found.replace(lambda e: isinstance(e, Pow) and e.base == other(angle) and (e.exp / 2).is_Integer, square)


def left_over(expr: Expr, unknown: Expr) -> bool:
    """Whether an expression still contains the symbol of an unknown."""
    return letter_of(unknown) in explicit(expr).free_symbols


def is_number(quantity: Quantity) -> bool:
    """Whether the quantity is a scalar value, not a relation, a vector or a tensor."""
    return isinstance(quantity.value, Expr) and not isinstance(quantity.value, Relation)


def residual_of(verb: str, equation: Quantity, or_value: bool = False) -> Expr:
    """The left side of an equation minus its right side, or, with `or_value`, a scalar value itself. Rejects anything
    else."""
    value = equation.value
    if or_value and is_number(equation):
        return explicit(value)
    if not isinstance(value, Relation) or value.operator != "=":
        wanted, kind = ("an equation or a scalar", "neither") if or_value else ("an equation", "not one")
        message = f"`{verb}` needs {wanted}, but `{equation.key}` is {kind}"
        raise Rejected(
            Complaint(
                "wrong-argument",
                message,
                help=Spelled(
                    "give an equation of motion, a condition, or an equation made by `let`",
                    "name an equation of motion or a condition",
                ),
            )
        )
    return explicit(value).residual


def mark_for(unknown: Expr) -> Dummy:
    return Dummy("u", positive=True) if unknown.is_positive else Dummy("u", real=True)


def polynomial_in(
    verb: str, equation: Quantity, unknowns: Sequence[Expr], or_value: bool = False
) -> tuple[Expr, list[Dummy]]:
    """Return the residual of an equation with a dummy symbol in place of each unknown, and the list of dummy symbols.

    Factors that contain the symbol of an unknown but not the unknown itself are dropped. Without `or_value`, the
    assumption that these factors do not vanish is recorded where it is needed.
    """
    left = residual_of(verb, equation, or_value)
    marks = [mark_for(unknown) for unknown in unknowns]
    for unknown, mark in zip(unknowns, marks, strict=True):
        left, beside = without_factors_beside(with_unknown(left, unknown, mark), unknown, mark)
        unsure = [f for f in beside if not never_vanishes_within(f) and not _is_below(f, unknown)]
        if unsure and not or_value:
            assume(Relation(Mul(*unsure), "!=", Integer(0)))
        if left_over(left, unknown):
            message = f"`{verb}`: `{equation.key}` contains {letter_of(unknown).name} outside {unknown}"
            raise Rejected(Complaint("wrong-argument", message))
    return left, marks


def factors_elsewhere(value: Expr, unknown: Expr) -> list[Expr]:
    """The factors that may vanish and that contain the symbol of the unknown but not the unknown itself."""
    mark = mark_for(unknown)
    _, beside = without_factors_beside(with_unknown(value, unknown, mark), unknown, mark)
    above = (f.as_base_exp() for f in beside if not never_vanishes_within(f))
    return [base for base, power in above if power.is_positive and not _is_below(base, unknown)]


def _is_below(factor: Expr, unknown: Expr) -> bool:
    """Whether a factor is the cosine in tan(theta) = sin(theta)/cos(theta). Where the cosine vanishes, the sine does
    not vanish, so an equation for the tangent has no root there."""
    return isinstance(unknown, tan) and factor == cos(unknown.args[0])


def without_factors_beside(left: Expr, unknown: Expr, mark: Dummy) -> tuple[Expr, list[Expr]]:
    """Split off the factors that contain the symbol of the unknown but not the unknown itself.

    If the unknown is cos(theta), sin(theta)(a cos(theta) - b) is split into a cos(theta) - b and the factor sin(theta).
    """
    for form in (left, factored(left)) if left.is_Add and left.count_ops() <= LARGEST else (left,):
        factors = Mul.make_args(form)
        beside = [f for f in factors if left_over(f, unknown) and not f.has(mark)]
        rest = Mul(*(f for f in factors if f not in beside))
        if beside and rest.has(mark):
            return rest, beside
    return left, []


def kind_of_unknown(unknown: Expr, known: Mapping[Symbol, str]) -> str | None:
    """The kind of an unknown that is a symbol in `known` or a rate of such a symbol; None if there is no such kind."""
    if not isinstance(unknown, Symbol):
        return None
    if unknown in known:
        return known[unknown]
    for q, kind in known.items():
        order = next((n for n in range(1, len(RATES)) if rate(q, n) == unknown), 0)
        if order and kind == "angle":
            return {1: "angular speed", 2: "angular acceleration"}.get(order)
        if order:
            return kind_of_dimension(_per_time(dimension_of_kind(kind), order))
    return None


def _per_time(dimension: Dimension, order: int) -> Dimension:
    return dimension / dimension_of_kind("time") ** order


def coordinates_of(*quantities: Quantity) -> dict[Symbol, str]:
    return {q: kind for quantity in quantities for q, kind in quantity.coordinates.items()}


def linear_coefficients(expressions: Sequence[Expr], marks: Sequence[Symbol]) -> tuple[Matrix, Matrix] | None:
    """The matrix A and right side b of linear equations A u = b; None if an equation is not linear."""
    matrix = Matrix([[tidied(each.diff(mark)) for mark in marks] for each in expressions])
    if matrix.has(*marks):
        return None
    at_zero = dict.fromkeys(marks, Integer(0))
    return matrix, Matrix([-tidied(each.xreplace(at_zero)) for each in expressions])
