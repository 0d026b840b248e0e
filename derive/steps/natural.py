"""A line that writes the result of a step with the symbols of other quantities, if this is shorter.

Three kinds of quantities are used:

- those that the problem defines under `define:`;
- those that a verb proposes because they are usual in its field, such as beta = b/(2 m);
- results of earlier steps on which the step depends, if their rule allows this, such as the radius r_0 of a circular
  orbit.

The new line is checked like every line of a chain.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from sympy import Expr, Symbol

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, At, Relation, bound, explicit, is_matrix, rate
from derive.algebra.natural import Shortened, shortened
from derive.steps import record
from derive.steps.level import Level
from derive.steps.step import NUMBERS, ONLY_ABOUT, Fact, Form, Quantity

NATURAL = "natural"  # the reason of a line that is written with the symbols of other quantities


@dataclass(frozen=True)
class NamesValue(Fact):
    """A mark on a quantity: its symbol may replace its value in the results of later steps."""


@dataclass(frozen=True)
class Proposal:
    """A usual quantity that a verb proposes; it becomes a step only if it makes a result shorter.

    symbol  the symbol that the quantity usually has
    value   its value in the symbols of the problem
    make    the function that derives and returns the quantity
    """

    symbol: Symbol
    value: Expr
    make: Callable[[], Quantity]


class NaturalQuantities:
    """The quantities in which one step may write its result and the conditions of its sentence.

    used   the quantities whose symbols have replaced their values so far
    """

    def __init__(self, symbol: Any, result: Any, inputs: Sequence[Quantity], proposals: Sequence[Proposal]):
        constants, states = [], []
        if record.may_use_quantities():
            constants = [*proposals, *_named(record.defined_quantities())]
            states = list(_named(_ancestors(inputs)))
        named = symbol.args[0] if isinstance(symbol, At) else symbol  # U'' for U''(r_0)
        own: set[Any] = getattr(named, "free_symbols", set())  # omega_0 if the result is omega_0^2
        self._constants = {each.symbol: each for each in constants if each.symbol not in own}
        others = (each for each in states if each.symbol not in own and each.value != result)
        self._known = {**{each.symbol: each for each in others}, **self._constants}
        self.used: list[Quantity] = []

    def chain(self, chain: Sequence[Form], result: Any) -> list[Form]:
        """Return the chain, with a line in the symbols of other quantities if this line is shorter than the result."""
        last = next((i for i in reversed(range(len(chain))) if chain[i].because not in NUMBERS), None)
        found = None if last is None or chain[last].because in ONLY_ABOUT else self._shortened(result, self._known)
        if last is None or found is None:
            return list(chain)
        before = chain[last] if found.nonzero else replace(chain[last], level=Level.FULL)
        return [*chain[:last], before, Form(found.value, NATURAL, nonzero=found.nonzero), *chain[last + 1 :]]

    def formulas(self, formulas: Mapping[str, tuple[Any, Any]]) -> dict[str, Any]:
        """Return, by role, the formulas of a sentence that become shorter in defined and proposed quantities.

        Results of earlier steps are not used, because a condition for a state must not contain the symbols of this
        state.
        """
        found = {role: self._shortened(formula, self._constants) for role, (formula, _) in formulas.items()}
        return {role: short.value for role, short in found.items() if short is not None}

    def _shortened(self, value: Any, known: Mapping[Symbol, Proposal]) -> Shortened | None:
        """Return a shorter form of a value or a condition in known quantities, or None.

        In a value that changes, such as a kinetic energy, no symbol is eliminated. The symbol of a defined quantity
        only replaces the formula of this quantity, such as mu for m_1 m_2/(m_1 + m_2).
        """
        moving = {rate(q, order) for q in record.named_coordinates() for order in range(3)}
        is_value = isinstance(value, Expr) and not is_matrix(value)
        changes = is_value and bool(value.free_symbols & moving)
        if changes:
            defined = {each.symbol for each in record.defined_quantities()}
            known = {name: each for name, each in known.items() if name in defined}
        if not known or not (is_value or isinstance(value, Relation)):
            return None
        kept = {TIME, *moving}
        found = shortened(value, {name: each.value for name, each in known.items()}, kept, only_whole=changes)
        if found is None:
            return None
        names = [name for name in found.used if name in found.value.free_symbols]
        values = {name: known[name].value for name in names}
        back = explicit(bound(found.value, values))
        if isinstance(value, Relation) and (value.left, value.operator) == (back.left, back.operator):
            value, back = value.right, back.right
        if not equal(value, back, found.nonzero):
            return None
        self.used += [made for name in names if (made := known[name].make()) not in self.used]
        return found


def _ancestors(quantities: Sequence[Quantity]) -> Iterator[Quantity]:
    """Return the quantities, among the given ones and their ancestors, whose symbols may replace their values."""
    ancestors = (each for quantity in quantities for each in quantity.ancestors())
    return (quantity for quantity in ancestors if quantity.fact(NamesValue))


def _named(quantities: Iterable[Quantity]) -> Iterator[Proposal]:
    for quantity in quantities:
        for symbol, value in ((symbol, explicit(value)) for symbol, value in quantity.named_values):
            if isinstance(symbol, Symbol) and isinstance(value, Expr) and value.free_symbols:
                yield Proposal(symbol, value, partial(_itself, quantity))


def _itself(quantity: Quantity) -> Quantity:
    return quantity
