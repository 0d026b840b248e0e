"""Arithmetic with several results: a ratio of two frequencies, the difference of two motions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sympy import Abs, Expr, MatrixBase, Mul, Pow, Rational, Symbol, cancel, factor, sqrt

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, bound, explicit, scalar
from derive.errors import Complaint, Rejected
from derive.mechanics.answers import claims
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Formula, in_results
from derive.solving.presentation import presented
from derive.solving.unknowns import left_over, unknown_of
from derive.steps.establish import Lines, Scope, establish
from derive.steps.rule import Rule
from derive.steps.step import Quantity
from derive.steps.subject import EVERYTHING

__all__ = ["combination"]

HALF = Rational(1, 2)
LARGEST = 200  # if a formula has more operations than this, factors under its roots are not cancelled


COMBINATION = Rule(
    "answers.combination",
    source="none needed: a definition",
    outcomes={"generic": claims.combination_generic, "named": claims.combination_named},
)


def combination(expression: Expr, values: Mapping[Symbol, Quantity], key: str, symbol: str | None = None) -> Quantity:
    """Quantity computed from results by a formula: pi Omega/omega, the angle from one apsis to the next.

    expression   the formula, with letters and with placeholders for the results
    values       placeholder -> its result; for an equation that is solved for a letter, its right side is used
    symbol       the letter of the quantity; by default the key

    The grade of the step is "definition", because no check can show that the formula has the meaning of the letter.
    Outcomes: generic, named (a formula of letters only).
    Errors: a result is not a number, for example a vector or an equation that is not solved.
    Source: none needed: a definition.
    """
    inputs = {quantity.key: _number(quantity) for quantity in values.values()}

    def law(*those: Any) -> Expr:
        return bound(expression, dict(zip(values, those, strict=True)))

    return establish(
        COMBINATION,
        scalar(symbol or key),
        law,
        inputs,
        key=key,
        outcome="generic" if values else "named",
        lines=Lines(arranged=_cancelled),
        parents=[q for q in values.values() if q not in inputs.values()],
        scope=Scope(differ=EVERYTHING),
    )


def _cancelled(value: Expr) -> Expr:
    plain = presented(value)
    if plain.count_ops() > LARGEST:
        return plain

    roots = [f for f in Mul.make_args(plain) if isinstance(f, Pow) and abs(f.exp) == HALF]
    below = factor(cancel(Mul(*(f**2 for f in roots))))
    rooted = presented(Mul(*(f for f in Mul.make_args(plain) if f not in roots)) * sqrt(below))
    return rooted if rooted.count_ops() < plain.count_ops() and equal(rooted, plain) else plain


def _number(quantity: Quantity) -> Quantity | Expr:
    """Return a scalar: the quantity itself if its symbol is a letter or an absolute value such as |x_dot|, otherwise
    its value. For an equation that is solved for a letter, return the right side."""
    value = quantity.value
    if not isinstance(value, Relation | MatrixBase):
        return quantity if isinstance(quantity.symbol, Symbol | Abs) else explicit(value)
    if isinstance(value, Relation) and value.operator == "=" and isinstance(value.left, Symbol):
        right = explicit(value.right)
        if not left_over(right, unknown_of("combination", value.left)):
            return right
    raise Rejected(Complaint("wrong-argument", f"`combination`: `{quantity.key}` is not a number"))


@in_results(
    "value",
    "the value of a formula with answers and letters: `pi*rate/frequency`, `v - R*w`, `-S` for a constraint force `S`; "
    "all terms must have the same dimension",
    formula="value: a formula with the names of answers and with letters",
    symbol="symbol",
)
def _in_results(formula: Formula, key: str, symbol: str | None = None) -> Quantity:
    return checked(combination)(*formula, key=key, symbol=symbol)
