"""Quantities that a problem defines: `define: {beta: b/(2*m), omega_0: sqrt(k/m)}`."""

from __future__ import annotations

from collections.abc import Iterable

from sympy import Expr, Symbol

from derive.steps import record
from derive.steps.establish import Lines, establish
from derive.steps.level import Level, Manner
from derive.steps.rule import Rule, Shown
from derive.steps.step import Quantity

QUANTITY = Rule(
    "defined.quantity",
    source="none needed: a definition",
    shown=Shown(brief=Manner.TOLD, standard=Manner.TOLD),
    names_value=True,
)


def define(formulas: Iterable[tuple[Symbol, Expr]]) -> None:
    """Make a step for each quantity of `define:`. A formula may contain quantities that are defined before it."""
    for symbol, formula in formulas:
        record.add_definition(_quantity(symbol, formula, record.defined_quantities()))


def _quantity(symbol: Symbol, formula: Expr, before: Iterable[Quantity]) -> Quantity:
    """A quantity that the author defines by a formula in the symbols of the problem.

    Source: none needed: a definition.
    """
    used = {quantity.symbol: quantity for quantity in before if formula.has(quantity.symbol)}
    return establish(
        QUANTITY,
        symbol,
        lambda *names: formula.subs(dict(zip(used, names, strict=True))),
        {name.name: quantity for name, quantity in used.items()},
        key=symbol.name,
        lines=Lines(put_in=None, law=Level.BRIEF, result=False, arranged=lambda value: value),
    )
