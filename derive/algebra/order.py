"""Assumed relations between symbols, such as l < r_0 or v_0^2 < g R, and their consequences for signs and samples.

A symbol is replaced by its value from the relation: r_0 = l + u, with an amount u > 0. The sign of a polynomial in l
and r_0 can then often be read from its coefficients.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from math import prod

from sympy import Add, Dummy, Expr, Integer, Rational, Symbol, cancel, expand, together

PARTS = 12  # number of sizes that are tried for an amount; each is an eighth of the previous size
LARGEST = 400  # greatest number of operations of an expression that is expanded after symbols are replaced

SignOf = Callable[[Expr], int | None]


class Contradiction(Exception):
    """The relation contradicts earlier relations."""


@dataclass(frozen=True)
class Order:
    """Relations that are assumed to hold.

    positive   differences that are assumed to be greater than zero
    replaced   symbol -> the expression that replaces it, from one of the relations; the expression contains amounts and
               symbols that are not replaced
    amounts    replaced symbol -> the amount in its value: positive, or not negative if the relation is not strict
    """

    positive: tuple[Expr, ...] = ()
    replaced: Mapping[Symbol, Expr] = field(default_factory=dict)
    amounts: Mapping[Symbol, Symbol] = field(default_factory=dict)

    def with_relation(self, difference: Expr, strict: bool, sign_of: SignOf) -> Order:
        """Return these relations and a further one: the difference is greater than zero, or may be zero if the relation
        is not strict. Raise `Contradiction` if the further relation is known to contradict these relations. A relation
        that is known to follow from them is left out."""
        there, below = together(self.put_in(difference)).as_numer_denom()
        there = expand(there) if sign_of(below) == 1 else expand(there / below)
        sign = 0 if there.is_zero else sign_of(there)
        if sign == -1 or sign == 0 and strict or strict and there.is_nonpositive:
            raise Contradiction
        if sign is not None:
            return self
        positive = (*self.positive, difference) if strict else self.positive
        letter, value, amount = _letter_replaced(there, strict, sign_of)
        if letter is None:
            return Order(positive, self.replaced, self.amounts)
        replaced = {s: expand(v.xreplace({letter: value})) for s, v in self.replaced.items()}
        amounts = {**self.amounts, letter: amount}
        return Order(positive, {**replaced, letter: value}, amounts)

    def put_in(self, expr: Expr) -> Expr:
        """The expression with the values of all replaced symbols substituted."""
        return expr.xreplace(dict(self.replaced)) if self.replaced else expr

    def touches(self, expr: Expr) -> bool:
        """Whether the relations can matter for the expression."""
        if not self:
            return False
        known = self.replaced.keys() | set().union(*(each.free_symbols for each in self.positive))
        return not known.isdisjoint(expr.free_symbols)

    def __bool__(self) -> bool:
        return bool(self.positive or self.replaced)

    def sign(self, expr: Expr, sign_of: SignOf) -> int | None:
        """The sign of an expression; None if the relations are not found to determine the sign."""
        if expr == 0:
            return 0
        for difference in self.positive:
            ratio = cancel(expr / difference)
            if ratio.is_number and ratio.is_real:
                return 1 if ratio > 0 else -1
        there = self.put_in(expr)
        if there == expr or there.count_ops() > LARGEST:
            return None
        if not isinstance(there, Add):
            return sign_of(there)
        above, below = together(there).as_numer_denom()
        signs = sign_of(expand(above)), sign_of(below)
        return None if None in signs else prod(sign for sign in signs if sign is not None)

    def at(self, point: Mapping[Expr, Expr], fits: Callable[[Expr, Expr], bool]) -> dict[Expr, Expr]:
        """The point, with the numbers of replaced symbols changed so that they satisfy the relations. The amounts are
        made smaller until the numbers fit their symbols (`fits`), or until `PARTS` sizes have been tried."""
        missing = set().union(*(v.free_symbols for v in self.replaced.values())) - {*self.amounts.values(), *point}
        free = {**point, **{s: Rational(7 + 2 * n, 5) for n, s in enumerate(sorted(missing, key=str))}}
        wanted = [(s, value) for s, value in self.replaced.items() if s in point]
        found = dict(point)
        for part in range(PARTS if wanted else 0):
            more = {u: abs(free.get(s, Rational(3, 2))) / 8**part for s, u in self.amounts.items()}
            found = {**point, **{s: value.xreplace({**free, **more}) for s, value in wanted}}
            if all(fits(s, found[s]) for s, _ in wanted):
                break
        return found


def _letter_replaced(
    difference: Expr, strict: bool, sign_of: SignOf
) -> tuple[Symbol, Expr, Symbol] | tuple[None, None, None]:
    """A symbol in which the difference is linear, its value, and a new amount: with this value, the difference equals
    the amount. Each of the three is None if no symbol is found."""
    amount = Dummy("more", positive=True) if strict else Dummy("more", nonnegative=True)
    for letter in sorted((s for s in difference.free_symbols if isinstance(s, Symbol)), key=str):
        slope = difference.diff(letter)
        if slope.has(letter) or (sign := sign_of(slope)) is None or sign == 0:
            continue
        value = expand((amount - difference.xreplace({letter: Integer(0)})) / slope)
        if not letter.is_positive or sign_of(value) == 1:
            return letter, value, amount
    return None, None, None


_ORDER: ContextVar[Order] = ContextVar("order", default=Order())  # noqa: B039  the default is never changed


@contextmanager
def in_order(order: Order) -> Iterator[None]:
    """Assume these relations within the `with` block."""
    token = _ORDER.set(order)
    try:
        yield
    finally:
        _ORDER.reset(token)


def known_order() -> Order:
    return _ORDER.get()
