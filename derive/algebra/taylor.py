"""Taylor series of a formula along a motion: each letter goes by its own series, and these are added and multiplied.

No derivative is taken anywhere: if x = x_0 + x_1 s + ... and y likewise, the coefficients of x y are the sums of
x_j y_(k-j), and those of a sine and its cosine follow from each other by s' = u' c, c' = -u' s; those of a power
y = x^a from x y' = a x' y.

Source: Griewank, Walther, *Evaluating Derivatives*, ch. 13 (Taylor arithmetic).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce

from sympy import Add, Expr, Integer, Mul, Pow, Rational, Symbol, cos, diff, exp, sin

__all__ = ["NoSeries", "slope", "taylor"]

ZERO = Integer(0)

Series = tuple[Expr, ...]


class NoSeries(Exception):
    """The formula has a function whose series is not known here, or a letter whose series is not long enough."""


def taylor(expr: Expr, letters: Mapping[Symbol, Sequence[Expr]], order: int) -> Series:
    """The coefficients of s^0, ..., s^order; letters without a series are constants. Raises `NoSeries`."""
    return _Arithmetic(letters, order).of(expr)


def slope(expr: Expr | int, letter: Symbol) -> Expr:
    """How it changes with one letter, all others kept: the coefficient of s where the letter goes by q + s."""
    expr = ZERO + expr  # a plain number too
    if letter not in expr.free_symbols:
        return ZERO
    try:
        return taylor(expr, {letter: (letter, Integer(1))}, 1)[1]
    except NoSeries:
        return diff(expr, letter)


class _Arithmetic:
    def __init__(self, letters: Mapping[Symbol, Sequence[Expr]], order: int) -> None:
        self._letters = letters
        self._orders = range(order + 1)
        self._known: dict[Expr, Series] = {}

    def of(self, expr: Expr) -> Series:
        found = self._known.get(expr)
        if found is None:
            found = self._known[expr] = self._found(expr)
        return found

    def _found(self, expr: Expr) -> Series:
        if expr.is_Atom:
            return self._atom(expr)
        if expr.is_Add or expr.is_Mul:
            parts = [self.of(part) for part in expr.args]
            moving = [part for part in parts if any(part[1:])]
            if not moving:
                return self._constant(expr)
            resting = [part[0] for part in parts if not any(part[1:])]
            return self._sum(resting, moving) if expr.is_Add else self._times(Mul(*resting), moving)
        if isinstance(expr, Pow) and expr.exp.is_Integer:
            x = self.of(expr.base)
            if not any(x[1:]):
                return self._constant(expr)
            return reduce(self._product, [x if expr.exp > 0 else self._one_over(x)] * abs(int(expr.exp)))
        if isinstance(expr, Pow) and not expr.exp.free_symbols & self._letters.keys():
            x = self.of(expr.base)
            return self._power(x, expr) if any(x[1:]) else self._constant(expr)
        if isinstance(expr, exp):
            u = self.of(expr.args[0])
            return self._growing(u) if any(u[1:]) else self._constant(expr)
        if isinstance(expr, sin | cos):
            return self._turning(self.of(expr.args[0]))[isinstance(expr, cos)]
        if not expr.free_symbols & self._letters.keys():
            return self._constant(expr)
        raise NoSeries

    def _constant(self, expr: Expr) -> Series:
        return (expr, *(ZERO for _ in self._orders[1:]))

    def _atom(self, expr: Expr) -> Series:
        series = self._letters.get(expr)
        if series is None:
            return self._constant(expr)
        if len(series) < len(self._orders):
            raise NoSeries
        return tuple(series[: len(self._orders)])

    def _sum(self, resting: list[Expr], moving: list[Series]) -> Series:
        first, *others = zip(*moving, strict=True)
        return (Add(*resting, *first), *(Add(*parts) for parts in others))

    def _times(self, resting: Expr, moving: list[Series]) -> Series:
        return tuple(resting * part for part in reduce(self._product, moving))

    def _product(self, x: Series, y: Series) -> Series:
        return tuple(Add(*(x[j] * y[k - j] for j in range(k + 1) if x[j] and y[k - j])) for k in self._orders)

    def _one_over(self, x: Series) -> Series:
        """Its product with x is 1 + 0 s + ..."""
        found = [1 / x[0]]
        for k in self._orders[1:]:
            found.append(-Add(*(x[j] * found[k - j] for j in range(1, k + 1))) / x[0])
        return tuple(found)

    def _power(self, x: Series, of: Pow) -> Series:
        """Of y = x^a, by x y' = a x' y."""
        found: list[Expr] = [of.func(x[0], of.exp)]
        for k in self._orders[1:]:
            steps = [(of.exp * j - (k - j)) * x[j] * found[k - j] for j in range(1, k + 1) if x[j]]
            found.append(Add(*steps) / (k * x[0]))
        return tuple(found)

    def _growing(self, u: Series) -> Series:
        """The exponential y, by y' = u' y."""
        found: list[Expr] = [exp(u[0])]
        for k in self._orders[1:]:
            found.append(Add(*(Rational(j, k) * u[j] * found[k - j] for j in range(1, k + 1) if u[j])))
        return tuple(found)

    def _turning(self, u: Series) -> tuple[Series, Series]:
        """The sine and the cosine."""
        sine, cosine = [sin(u[0])], [cos(u[0])]
        for k in self._orders[1:]:
            steps = [(Rational(j, k) * u[j], k - j) for j in range(1, k + 1) if u[j]]
            sine.append(Add(*(step * cosine[i] for step, i in steps)))
            cosine.append(-Add(*(step * sine[i] for step, i in steps)))
        return tuple(sine), tuple(cosine)
