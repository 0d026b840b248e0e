"""The time, and prescribed functions of the time such as the position X(t) of a shaken support.

A prescribed function X and its rates X_dot, X_ddot are symbols. X depends on the time alone, so the partial derivative
of a formula with respect to t includes the derivatives of X and of its rates.
"""

from __future__ import annotations

from typing import Any

from sympy import Expr, Integer, Symbol

from derive.algebra.dimensions import Dimension
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.node import explicit
from derive.errors import Complaint, Rejected

TIME = Symbol("t", real=True)  # the only time symbol

RATES = ("", "_dot", "_ddot", "_dddot")


class Prescribed(Symbol):
    """A prescribed function of the time, or one of its rates.

    sort      the kind of quantity of the function itself, such as "length"
    above     whether the function itself is always positive
    """

    __slots__ = ("above", "sort")

    sort: str
    above: bool

    def __new__(cls, name: str, sort: str, above: bool = False) -> Prescribed:
        assumed = {"positive": True} if above and not name.endswith(RATES[1:]) else {"real": True}
        made: Prescribed = Symbol.__xnew__(cls, name, **assumed)
        made.sort, made.above = sort, above
        return made

    def __getnewargs_ex__(self) -> tuple[Any, ...]:
        return (self.name, self.sort, self.above), {}

    def _hashable_content(self) -> tuple[Any, ...]:
        return (*super()._hashable_content(), self.sort, self.above)

    @classmethod
    def class_key(cls) -> tuple[Any, ...]:
        return Symbol.class_key()  # type: ignore[no-any-return]  # sorted among the other symbols in sums and products

    @property
    def free_symbols(self) -> set[Symbol]:
        return {self, TIME}

    @property
    def order(self) -> int:
        """The number of derivatives: 0 for X, 1 for X_dot."""
        return next(n for n in (3, 2, 1, 0) if self.name.endswith(RATES[n]))

    @property
    def function(self) -> Prescribed:
        """The function itself."""
        return self.rate(-self.order)

    @property
    def dimension(self) -> Dimension:
        return dimension_of_kind(self.sort) / dimension_of_kind("time") ** self.order

    def rate(self, order: int = 1) -> Prescribed:
        """The derivative of this order with respect to the time; rejects an order that is too high."""
        if self.order + order >= len(RATES):
            message = f"a derivative of {self.function.name} would be of a higher order than {len(RATES) - 1}"
            raise Rejected(Complaint("too-many-rates", message))
        return Prescribed(self.name.removesuffix(RATES[self.order]) + RATES[self.order + order], self.sort, self.above)

    def _eval_derivative(self, s: Symbol) -> Expr:
        if s == self:
            return Integer(1)
        return self.rate() if s == TIME else Integer(0)

    def _eval_derivative_n_times(self, s: Symbol, n: Any) -> Expr:
        return self.rate(int(n)) if s == TIME else self._eval_derivative(s) if n == 1 else Integer(0)


def depends_on_time(value: Any) -> bool:
    """Whether a formula contains the time or a prescribed function; coordinates and their rates do not count."""
    return TIME in explicit(value).free_symbols


def prescribed_in(value: Any) -> list[Prescribed]:
    """Return the prescribed functions and their rates in a formula, sorted by name."""
    return sorted((s for s in explicit(value).free_symbols if isinstance(s, Prescribed)), key=lambda s: s.name)
