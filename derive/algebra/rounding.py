"""Numbers for the page, rounded once, from the exact value, to a given number of significant figures."""

from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Decimal
from typing import Any

from sympy import Expr, Float, Integer, MatMul, MatrixBase, Rational, cancel

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.expressions import Amount, Factors, MatrixAmount, Relation, explicit
from derive.algebra.node import DimensionOf, ScalarNode, TextOf
from derive.algebra.samples import value_at

SPARE = 25  # digits beyond those requested, so that the last figure is rounded correctly


def rounded(exact: Expr, figures: int) -> Rational:
    """The nearest decimal with that number of significant figures, as an exact rational number."""
    value = _decimal(exact, figures + SPARE)
    if value == 0:
        return Integer(0)
    place = value.adjusted() - figures + 1
    return Rational(str(value.quantize(Decimal(1).scaleb(place), rounding=ROUND_HALF_EVEN)))


def _decimal(exact: Expr, digits: int) -> Decimal:
    if exact == 0:
        return Decimal(0)
    from decimal import localcontext

    with localcontext() as context:
        context.prec = digits
        return +Decimal(str(Float(exact.evalf(digits + 5), digits + 5)))


class Rounded(ScalarNode):
    """A decimal number with its number of significant figures, so that 21.60 keeps its zero. Arguments: the rational
    number, the figures."""

    def doit(self, **hints: Any) -> Expr:
        return self.args[0]

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return NUMBER

    def lowered(self, text: TextOf) -> str:
        return f"Rational('{decimal_text(self)}')"


def rounded_form(exact: Any, figures: int) -> Any:
    """The value with a `Rounded` number in place of each exact number; zero stays zero."""
    exact = explicit(exact)
    if isinstance(exact, MatrixBase):
        return exact.applyfunc(lambda e: rounded_form(e, figures))
    value = rounded(exact, figures)
    return Integer(0) if value == 0 else Rounded(value, Integer(figures))


def decimal_text(number: Rounded) -> str:
    """The number as plain text with all significant figures: `0.92951`, `21.64`, `6.500e-4`."""
    value, figures = number.args
    decimal = Decimal(value.p) / Decimal(value.q)
    place = decimal.adjusted() - int(figures) + 1
    kept = decimal.quantize(Decimal(1).scaleb(place))
    if -4 < decimal.adjusted() < 6 and place <= 0:
        return f"{kept:f}"
    return f"{kept:e}".replace("e+", "e").replace("E+", "e").replace("E", "e")


def off_by_more_than_half_a_unit(exact: Any, shown: Any) -> tuple[str, str] | None:
    """The first rounded number that differs from its exact value by more than half a unit of its last place, and the
    exact value.

    Returns None if there is no such number. In a relation, the right side is the rounded number. mpmath computes the
    exact value here, while `rounded` uses SymPy's own `evalf`.
    """
    for number, factor, value in _pairs(shown, exact):
        target = explicit(number)
        half = half_a_unit(number) if isinstance(number, Rounded) else Integer(0)
        if abs(Rational(value_at(value / factor, {})) - target) > half * (1 + Rational(1, 10**30)):
            return str(target), str(value)
    return None


def half_a_unit(number: Rounded) -> Rational:
    """The largest rounding error of a rounded number: half a unit of its last place."""
    decimal = Decimal(number.args[0].p) / Decimal(number.args[0].q)
    return Rational(10) ** (decimal.adjusted() - int(number.args[1]) + 1) / 2


def _pairs(shown: Any, exact: Any) -> list[tuple[Any, Expr, Expr]]:
    factor: Expr = Integer(1)
    if isinstance(shown, Relation):
        shown, exact = shown.right, exact.right
    if isinstance(shown, Amount | MatrixAmount):
        shown, factor = shown.args[0], shown.args[2]
    if isinstance(shown, Factors):  # a rounded number in front of symbols
        shown, letters = shown.args
        exact = (exact / letters).cancel()
    if isinstance(shown, MatMul):  # a vector of rounded numbers with a factor of symbols in front of it
        letters, shown = shown.args
        exact = (exact / letters).applyfunc(cancel)
    if isinstance(shown, MatrixBase):
        return [(n, factor, e) for n, e in zip(shown, exact, strict=True)]
    return [(shown, factor, exact)]
