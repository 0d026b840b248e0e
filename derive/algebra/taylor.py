"""Taylor series of a formula along a motion: each symbol has its own series, and the series are added and multiplied.

The arithmetic needs no derivatives. If x = x_0 + x_1 s + ... and y = y_0 + y_1 s + ..., the coefficients of x y are the
sums of x_j y_(k-j). The coefficients of sin u and cos u follow from each other by (sin u)' = u' cos u and (cos u)' =
-u' sin u.
The coefficients of y = x^a follow from x y' = a x' y, and the coefficients of y = exp(u) from y' = u' y.

Source: Griewank, Walther, *Evaluating Derivatives*, ch. 13 (Taylor arithmetic).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce

from sympy import (
    Abs,
    Add,
    Expr,
    Integer,
    Mul,
    Pow,
    Rational,
    Symbol,
    cos,
    diff,
    exp,
    factorial,
    nan,
    series,
    sin,
    tan,
    together,
    zoo,
)

from derive.algebra.expressions import RATES, TIME, Prescribed, as_expr, rate, stand_in
from derive.algebra.normal_form import vanishes

__all__ = ["NoSeries", "arithmetic_along", "coefficient_along", "series_along", "slope", "taylor"]

ZERO = Integer(0)
DEEPEST = 8  # highest order to which a numerator and a denominator may vanish together

Series = tuple[Expr, ...]


class NoSeries(Exception):
    """This module does not find the series of the formula."""


def taylor(expr: Expr, letters: Mapping[Symbol, Sequence[Expr]], order: int) -> Series:
    """The coefficients of s^0, ..., s^order; symbols without a series are constants. Raises `NoSeries` if the
    coefficients are not found."""
    return _Arithmetic(letters, order).of(expr)


def slope(expr: Expr | int, letter: Symbol) -> Expr:
    """The partial derivative with respect to a symbol q: the coefficient of s if q is replaced by q + s."""
    expr = as_expr(expr)  # may be a plain number
    if letter not in expr.free_symbols:
        return ZERO
    try:
        return taylor(expr, {letter: (letter, Integer(1))}, 1)[1]
    except NoSeries:
        return diff(expr, letter)


def coefficient_along(expr: Expr, place: Mapping[Symbol, Expr], direction: Mapping[Symbol, Expr], order: int) -> Expr:
    """The coefficient of s^order after each symbol is replaced by its place plus s times its direction."""
    return series_along(expr, place, direction, order)[order]


def series_along(
    expr: Expr, place: Mapping[Symbol, Expr], direction: Mapping[Symbol, Expr], order: int
) -> Sequence[Expr]:
    """The coefficients of s^0, ..., s^order after each symbol is replaced by its place plus s times its direction."""
    try:
        return arithmetic_along(expr, place, direction, order)
    except NoSeries:
        s = stand_in("s_small")
        moved = expr.subs({q: at + s * direction[q] for q, at in place.items()}, simultaneous=True)
        terms = series(moved, s, 0, order + 1).removeO().expand()
        return [terms.coeff(s, n) for n in range(order + 1)]


def arithmetic_along(
    expr: Expr, place: Mapping[Symbol, Expr], direction: Mapping[Symbol, Expr], order: int
) -> Sequence[Expr]:
    """The coefficients of `series_along` by Taylor arithmetic, also for a quotient that is 0/0 at the place. Raises
    `NoSeries` if they are not found."""
    paths = {q: (at, direction[q], *[ZERO] * (order + DEEPEST)) for q, at in place.items()}
    found = taylor(expr, paths, order)
    return _of_quotient(expr, paths, order) if any(part.has(nan, zoo) for part in found) else found


def _of_quotient(expr: Expr, paths: Mapping[Symbol, Sequence[Expr]], order: int) -> Sequence[Expr]:
    """The coefficients of `arithmetic_along` for a quotient whose numerator and denominator both vanish at the
    place."""
    above, below = together(expr).as_numer_denom()
    lowest, under = next(_beginnings(below, paths, order), (None, ()))
    if lowest is None:
        raise NoSeries
    over = taylor(above, paths, order + lowest)
    if not all(map(vanishes, over[:lowest])):
        raise NoSeries
    found: list[Expr] = []
    for k in range(order + 1):
        carried = Add(*(under[lowest + k - j] * found[j] for j in range(k)))
        found.append((over[lowest + k] - carried) / under[lowest])
    return found


def _beginnings(below: Expr, paths: Mapping[Symbol, Sequence[Expr]], order: int) -> Iterator[tuple[int, Series]]:
    """Yield the powers with which the series of `below` may begin, each with this series. These are the powers whose
    coefficients are not shown to vanish, first in a short series and then in a longer one.
    """
    for deep in (DEEPEST // 4, DEEPEST):
        under = taylor(below, paths, order + deep)
        yield from ((n, under) for n, part in enumerate(under[: deep + 1]) if not vanishes(part))


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
                return self._constant(expr.func(*(part[0] for part in parts)))
            resting = [part[0] for part in parts if not any(part[1:])]
            return self._sum(resting, moving) if expr.is_Add else self._times(Mul(*resting), moving)
        if isinstance(expr, Pow) and expr.exp.is_Integer:
            x = self.of(expr.base)
            if not any(x[1:]):
                return self._constant(x[0] ** expr.exp)
            return reduce(self._product, [x if expr.exp > 0 else self._one_over(x)] * abs(int(expr.exp)))
        if isinstance(expr, Pow) and not expr.exp.free_symbols & self._letters.keys():
            return self._power(self.of(expr.base), expr.exp)
        if isinstance(expr, exp):
            return self._exponential(self.of(expr.args[0]))
        if isinstance(expr, sin | cos):
            return self._turning(self.of(expr.args[0]))[isinstance(expr, cos)]
        if isinstance(expr, tan):
            sine, cosine = self._turning(self.of(expr.args[0]))
            return self._product(sine, self._one_over(cosine))
        if not expr.free_symbols & self._letters.keys():
            return self._constant(expr)
        if isinstance(expr, Abs) and expr.args[0].is_real:
            return self._size(self.of(expr.args[0]))
        raise NoSeries

    def _constant(self, expr: Expr) -> Series:
        return (expr, *(ZERO for _ in self._orders[1:]))

    def _atom(self, expr: Expr) -> Series:
        series = self._letters.get(expr)
        if series is None and isinstance(expr, Prescribed):
            return self._prescribed(expr)
        if series is None:
            return self._constant(expr)
        if len(series) < len(self._orders):
            raise NoSeries
        return tuple(series[: len(self._orders)])

    def _prescribed(self, function: Prescribed) -> Series:
        """The series X + X_dot s + X_ddot s^2/2 + ..., where the series of the time is t + s."""
        times = self._letters.get(TIME)
        if times is None:
            return self._constant(function)
        if times[0] != TIME or times[1] != 1 or any(times[2:]) or function.order + self._orders[-1] >= len(RATES):
            raise NoSeries
        return tuple((rate(function, n) if n else function) / factorial(n) for n in self._orders)

    def _sum(self, resting: list[Expr], moving: list[Series]) -> Series:
        first, *others = zip(*moving, strict=True)
        return (Add(*resting, *first), *(Add(*parts) for parts in others))

    def _times(self, resting: Expr, moving: list[Series]) -> Series:
        return tuple(resting * part for part in reduce(self._product, moving))

    def _product(self, x: Series, y: Series) -> Series:
        return tuple(Add(*(x[j] * y[k - j] for j in range(k + 1) if x[j] and y[k - j])) for k in self._orders)

    def _one_over(self, x: Series) -> Series:
        """The series whose product with x is 1 + 0 s + ..."""
        found = [1 / x[0]]
        for k in self._orders[1:]:
            found.append(-Add(*(x[j] * found[k - j] for j in range(1, k + 1))) / x[0])
        return tuple(found)

    def _power(self, x: Series, a: Expr) -> Series:
        """The series of y = x^a, term by term from x y' = a x' y."""
        if x[0] == 0 and any(x[1:]):
            raise NoSeries
        found = [x[0] ** a]
        for k in self._orders[1:]:
            parts = ((a * j - (k - j)) * x[j] * found[k - j] for j in range(1, k + 1) if x[j])
            found.append(Add(*parts) / (k * x[0]))
        return tuple(found)

    def _exponential(self, u: Series) -> Series:
        found = [exp(u[0])]
        for k in self._orders[1:]:
            found.append(Add(*(Rational(j, k) * u[j] * found[k - j] for j in range(1, k + 1) if u[j])))
        return tuple(found)

    def _size(self, u: Series) -> Series:
        """The series of |u|: the sign of u_0 times the series of u."""
        if u[0] == 0:
            raise NoSeries
        return (Abs(u[0]), *(u[0] / Abs(u[0]) * part for part in u[1:]))

    def _turning(self, u: Series) -> tuple[Series, Series]:
        sine, cosine = [sin(u[0])], [cos(u[0])]
        for k in self._orders[1:]:
            steps = [(Rational(j, k) * u[j], k - j) for j in range(1, k + 1) if u[j]]
            sine.append(Add(*(step * cosine[i] for step, i in steps)))
            cosine.append(-Add(*(step * sine[i] for step, i in steps)))
        return tuple(sine), tuple(cosine)
