"""Points at which two expressions are compared, and the values of the expressions at these points.

A point gives each symbol a random number; the numbers are of several orders of magnitude. The seed is computed from the
expressions, so each run has the same points for the same expressions. A difference counts only if more digits confirm
it; a difference that shrinks as digits are added counts as zero.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from random import Random
from typing import Any
from zlib import crc32

import mpmath
from mpmath import mp
from sympy import (
    Derivative,
    Dummy,
    E,
    Expr,
    Float,
    I,
    Integer,
    MatrixBase,
    Piecewise,
    Rational,
    S,
    Symbol,
    preorder_traversal,
)
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.logic.boolalg import And, Not, Or

from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.node import ScalarNode, explicit
from derive.algebra.ordered_roots import OrderedRoot, root_in_order
from derive.algebra.ranges import fulfilling, range_of

DIGITS = 50
WORKING = (60, 160, 420)  # precisions in digits, tried in this order until a comparison is decided and confirmed
SPARE = 20  # working digits that may be lost by rounding, cancellation and large arguments

NEGLIGIBLE = 1e-25  # a matrix entry smaller than this counts as a rounding error
RANKS_TRIED = 8  # greatest number of points that are drawn to find the rank of a matrix

ORDINARY = (0,)
TINY, LARGE = (-2, -5, -9, -14), (1, 2, 4, 7)  # powers of ten

SamplePoint = Mapping[Expr, Expr]


class Undefined(Exception):
    """The expression has no value at this point, for example because of a division by zero."""


class NoNumber(Exception):
    """The value of the expression at this point cannot be computed."""


@dataclass(frozen=True)
class Sample:
    """The values of two expressions at a point, and whether these values agree."""

    point: SamplePoint
    left: Any
    right: Any
    agree: bool


def points(letters: set[Expr], seed: int) -> Iterator[SamplePoint]:
    """Yield points without end; the numbers of the first points are of ordinary size."""
    ordered = sorted(letters, key=str)
    source = Random(seed)
    for scales in (ORDINARY, ORDINARY, ORDINARY, *((tiny,) for tiny in TINY), *((large,) for large in LARGE)):
        yield from _of_both_signs(ordered, [scales[0]] * len(ordered), source)
    while True:
        yield from _of_both_signs(ordered, [source.choice(TINY + 4 * ORDINARY + LARGE) for _ in ordered], source)


def _of_both_signs(letters: list[Expr], scales: list[int], source: Random) -> Iterator[SamplePoint]:
    """Yield two points. A symbol without a range has opposite signs at them, if its assumptions allow both signs."""
    signs = [source.choice((1, -1)) for _ in letters]
    for turn in (1, -1):
        point = {
            letter: _drawn(letter, k, turn * s, source) for letter, k, s in zip(letters, scales, signs, strict=True)
        }
        yield fulfilling(point)


def _drawn(letter: Expr, scale: int, sign: int, source: Random) -> Expr:
    if letter == PLUS_MINUS:
        return Integer(sign)
    if (known := range_of(letter)) is not None:
        return known.at(Rational(source.randint(1, 96), 97))
    if letter.is_nonnegative:
        sign = 1
    elif letter.is_nonpositive:
        sign = -1
    if letter.is_integer:
        size = Integer(source.randint(1, 9) if scale <= 0 else source.randint(10, 99))
        if letter.is_even or letter.is_odd:
            size = 2 * size + (1 if letter.is_odd else 0)
        return sign * size
    size = Rational(source.randint(11, 97), source.randint(23, 61)) * Integer(10) ** scale
    if letter.is_imaginary:
        return sign * size * I
    if isinstance(letter, Symbol) and letter.is_extended_real is None and not isinstance(letter, Dummy):
        return sign * size * (1 + source.choice((0, 1, -2)) * I / 3)
    return sign * size


def letters_of(expr: Expr) -> set[Expr]:
    """The quantities that can be varied freely: free symbols, unknown functions and their derivatives."""
    functions = expr.atoms(AppliedUndef) | expr.atoms(Derivative)
    return set(functions) | {s for s in expr.free_symbols if isinstance(s, Symbol)}


def seed_of(*exprs: Expr) -> int:
    """A number computed from the expressions; it is the same in each run."""
    nodes = (node for expr in exprs for node in preorder_traversal(expr))
    marks = (f"{hash(n.p)}/{hash(n.q)}" if n.is_Rational else type(n).__name__ if n.args else str(n) for n in nodes)
    return crc32(" ".join(marks).encode())


def compared_at(left: Expr, right: Expr, point: SamplePoint, thoroughly: bool = False) -> Sample:
    """The values of both sides at a point; raises `Undefined` or `NoNumber`.

    With `thoroughly`, agreement counts only if more digits confirm the value of each side, or show that it is zero.
    """
    before: tuple[Any, Any, Any] | None = None
    for digits in WORKING:
        with mp.workdps(digits):
            value = Values(point)
            a, b = value(left), value(right)
            apart = abs(a - b)
            sure = not thoroughly or before is not None and _settled(before[0], a) and _settled(before[1], b)
            if apart <= (abs(a) + abs(b)) * mp.mpf(10) ** (SPARE - digits):
                if sure:
                    return Sample(point, a, b, True)
            elif before is not None and before[2]:
                told = not value.cancelled or digits == WORKING[-1]
                if told and abs(apart - before[2]) <= before[2] * mp.mpf(10) ** -6:
                    return Sample(point, a, b, False)
                if sure and _shrinks(before[2], apart):
                    return Sample(point, a, b, True)
            before = (a, b, apart)
    raise NoNumber(left)


def _settled(before: Any, now: Any) -> bool:
    """Whether more digits confirm a value, or show that it is zero."""
    return bool(abs(before - now) <= abs(now) * mp.mpf(10) ** -30) or _shrinks(abs(before), abs(now))


def _shrinks(before: Any, now: Any) -> bool:
    """Whether a number is only a rounding error, which shrinks as digits are added."""
    return bool(now <= before * mp.mpf(10) ** -20)


def value_at(expr: Expr, point: SamplePoint) -> Expr:
    """The value of an expression at a point, confirmed at a higher precision.

    Returns zero if the value shrinks as digits are added. Raises `Undefined` or `NoNumber`.
    """
    before: Any = None
    for digits in (30, *WORKING):
        with mp.workdps(digits):
            values = Values(point)
            try:
                now = values(expr)
            except Undefined:  # a divisor that has lost all its digits
                if digits == WORKING[-1]:
                    raise
                continue
            if now and before is not None and abs(before - now) <= abs(now) * mp.mpf(10) ** -25:
                return as_sympy(now)
            if before is not None and digits == WORKING[-1]:
                if _shrinks(abs(before), abs(now)) or before == 0 and values.cancelled:
                    return S.Zero
            before = now
    raise NoNumber(expr)


def is_zero_everywhere(expr: Expr) -> bool | None:
    """Whether the expression is zero at the sampled points where its value is found; None if no value is found."""
    found: bool | None = None
    letters = letters_of(expr)
    for point in islice(points(letters, seed_of(expr)), 6 if letters else 1):
        try:
            with mp.workdps(WORKING[0]):
                clear = abs(Values(point)(expr)) > mp.mpf(10) ** -25  # rounding errors at an ordinary point are smaller
            if clear or not compared_at(expr, S.Zero, point).agree:
                return False
        except Undefined:
            continue
        except NoNumber:
            return found
        found = True
    return found


def generic_rank(matrix: MatrixBase) -> int:
    """The rank of a matrix for almost all values of its symbols: the largest rank at sampled points.

    Raises `NoNumber` if the matrix is undefined at all points that are tried, or if an entry cannot be computed at one
    of them.
    """
    letters = set[Expr]().union(*map(letters_of, matrix))
    ranks: list[int] = []
    for point in islice(points(letters, seed_of(*matrix)), RANKS_TRIED):
        with suppress(Undefined), mp.workdps(DIGITS):
            value = Values(point)
            ranks.append(_rank([[value(entry) for entry in row] for row in matrix.tolist()]))
        if len(ranks) == (2 if letters else 1):
            break
    if not ranks:
        raise NoNumber(matrix)
    return max(ranks)


def _rank(rows: list[list[Any]]) -> int:
    """The rank of a matrix of numbers, by elimination with the largest pivot; the rows are changed."""
    rank = 0
    for column in range(len(rows[0]) if rows else 0):
        below = rows[rank:]
        if not below:
            break
        pivot = max(below, key=lambda row: abs(row[column]))
        if abs(pivot[column]) < NEGLIGIBLE:
            continue
        below.remove(pivot)
        for row in below:
            factor = row[column] / pivot[column]
            row[column:] = [x - factor * y for x, y in zip(row[column:], pivot[column:], strict=True)]
        rows[rank:] = [pivot, *below]
        rank += 1
    return rank


def shown(value: Any, figures: int = 6) -> Expr:
    """A value as a SymPy number with this many figures; a negligible imaginary part is dropped."""
    if isinstance(value, mpmath.mpc) and _bits(value.imag) < _bits(value.real) - 100:
        value = value.real
    return as_sympy(value).evalf(figures)


def as_sympy(x: Any) -> Expr:
    """A number of mpmath as a number of SymPy."""
    parts = (x.real, x.imag) if isinstance(x, mpmath.mpc) else (x, mp.mpf(0))
    real, imaginary = (Float._new(part._mpf_, max(mp.prec, part._mpf_[3])) if part else S.Zero for part in parts)
    return real + I * imaginary


# --- the value of an expression --------------------------------------------------------------------------------------

_OF_ZERO = -(10**30)
# Largest argument of a function in `_GROWING`, and largest size of a power: the exponent times the number of bits of
# the base. If the exponent is a multiple of 1/2, the size may be four times this number. Larger values would hide the
# other terms of a sum.
_LARGEST = 300
_MOST = 60  # greatest number of bits of the integer part of a function's argument, and of an exponent
_GROWING = {"exp", "sinh", "cosh", "tanh", "coth", "sech", "csch", "erf"}
_OF_ANY_SIZE = {"Abs", "sign", "re", "im", "conjugate", "arg", "Max", "Min", "log"}
_ONE_ARGUMENT = {
    name: getattr(mp, name)
    for name in ("sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "sinh", "cosh", "tanh", "coth")
} | {"asinh": mp.asinh, "acosh": mp.acosh, "exp": mp.exp, "erf": mp.erf}


class Values:
    """The values of expressions at one point, at mpmath's current precision; common parts are computed once."""

    def __init__(self, point: SamplePoint) -> None:
        self.cancelled = False  # whether the terms of a sum cancelled in almost all digits, so the sum may be zero
        self.known: dict[Expr, Any] = {}
        for letter, value in point.items():
            self.known[letter] = self._taken(value)

    def __call__(self, expr: Expr) -> Any:
        try:
            return self._of(expr)
        except (ZeroDivisionError, ValueError, OverflowError) as error:
            raise Undefined(expr) from error

    def _of(self, expr: Expr) -> Any:
        found = self.known.get(expr)
        if found is None:
            found = self.known[expr] = self._taken(expr)
        return found

    def _taken(self, expr: Expr) -> Any:
        if expr.is_Rational:
            return mp.mpf(expr.p) / expr.q
        if expr.is_Add:
            return self._summed([self._of(arg) for arg in expr.args])
        if expr.is_Mul:
            product = mp.mpf(1)
            for arg in expr.args:
                product = product * self._of(arg)
            return product
        if expr.is_Pow:
            return self._power(expr.base, expr.exp)
        if expr.is_Atom:
            return _atom(expr)
        return self._function(expr)

    def _summed(self, terms: list[Any]) -> Any:
        total = sum(terms, mp.mpf(0))
        self.cancelled |= _is_cancelled(total, terms)
        return total

    def _power(self, base: Expr, exponent: Expr) -> Any:
        x = self._of(base)
        if base.is_Add and exponent.is_negative and _is_cancelled(x, [self._of(term) for term in base.args]):
            raise Undefined(base)
        if exponent.is_Integer:
            return _whole_power(x, int(exponent))
        if exponent.is_Rational and exponent.q == 2:
            return _whole_power(mp.sqrt(x), int(exponent.p))
        n = self._of(exponent)
        if x == 0:
            if mp.re(n) > 0:
                return mp.mpf(0)
            raise Undefined(base)
        if abs(n) * max(1, abs(_bits(x))) > _LARGEST:
            raise NoNumber(exponent)
        return mp.exp(n) if base is E else mp.power(x, n)

    def _function(self, expr: Expr) -> Any:
        name = type(expr).__name__
        if isinstance(expr, OrderedRoot):
            return root_in_order([_real(self._of(each)) for each in expr.args[0]], int(expr.args[1]))
        if isinstance(expr, ScalarNode):
            return self._of(explicit(expr))
        if isinstance(expr, Piecewise):
            return self._piece(expr)
        if name in {"Integral", "Sum", "Product", "Limit", "Subs"} or not getattr(expr, "is_Function", False):
            return self._by_sympy(expr)
        arguments = [self._of(arg) for arg in expr.args]
        if name in _GROWING and abs(arguments[0]) > _LARGEST:
            raise NoNumber(expr)
        if name not in _OF_ANY_SIZE and any(_bits(x) > _MOST for x in arguments):
            raise NoNumber(expr)
        taken = _ONE_ARGUMENT.get(name) or _OTHERS.get(name)
        value = taken(*arguments) if taken else self._by_sympy(expr)
        if not mp.isfinite(value):  # an infinite value cannot be compared
            raise Undefined(expr)
        return value

    def _piece(self, expr: Expr) -> Any:
        for value, condition in expr.args:
            if self._holds(condition):
                return self._of(value)
        raise Undefined(expr)

    def _holds(self, condition: Any) -> bool:
        if condition in (S.true, S.false):
            return bool(condition)
        if isinstance(condition, And):
            return all(self._holds(arg) for arg in condition.args)
        if isinstance(condition, Or):
            return any(self._holds(arg) for arg in condition.args)
        if isinstance(condition, Not):
            return not self._holds(condition.args[0])
        if not isinstance(condition, Relational):
            raise NoNumber(condition)
        difference = self._summed([self._of(condition.lhs), -self._of(condition.rhs)])
        if condition.rel_op in {"==", "!="}:
            return bool(difference == 0) is (condition.rel_op == "==")
        x = _real(difference)
        return bool({"<": x < 0, "<=": x <= 0, ">": x > 0, ">=": x >= 0}[condition.rel_op])

    def _by_sympy(self, expr: Expr) -> Any:
        """Evaluate an expression with SymPy, because this module has no rule for it."""
        letters = letters_of(expr)
        if not letters <= self.known.keys() or expr.count_ops() > 200:
            raise NoNumber(expr)
        try:
            put_in = {x: as_sympy(self.known[x]) for x in sorted(letters, key=lambda e: isinstance(e, Symbol))}
            for letter, value in put_in.items():
                expr = expr.xreplace({letter: value})
            value = expr.evalf(mp.dps)
        except (TypeError, AttributeError, RecursionError, NotImplementedError) as error:  # SymPy finds no value
            raise NoNumber(expr) from error
        real, imaginary = value.as_real_imag()
        if not (real.is_Number and imaginary.is_Number):
            raise Undefined(expr) if value.has(S.NaN, S.ComplexInfinity) else NoNumber(expr)
        if not (real.is_finite and imaginary.is_finite):
            raise Undefined(expr)
        parts = [mp.mpf(part.p) / part.q if part.is_Rational else mp.mpf(part._mpf_) for part in (real, imaginary)]
        return mp.mpc(*parts) if parts[1] else parts[0]


def _is_cancelled(total: Any, terms: list[Any]) -> bool:
    """Whether the terms of a sum cancelled in almost all digits, so the sum may be zero."""
    return _bits(total) < max(map(_bits, terms)) - int(mp.prec) + 30


def _bits(x: Any) -> int:
    """The number of bits of the integer part of a number; zero or negative for a number below 1."""
    if isinstance(x, mpmath.mpc):
        return max(_bits(x.real), _bits(x.imag))
    _, mantissa, exponent, length = x._mpf_
    if mantissa:
        return int(exponent + length)
    if exponent:
        raise Undefined(x)  # infinity, or not a number
    return _OF_ZERO


def _whole_power(x: Any, n: int) -> Any:
    if n < 0 and x == 0:
        raise Undefined(x)
    if x and abs(n) > 1 and abs(n) * abs(_bits(x)) > 4 * _LARGEST or abs(n) > 2**_MOST:
        raise NoNumber(n)
    return x**n


def _atom(expr: Expr) -> Any:
    if expr is S.ImaginaryUnit:
        return mp.mpc(0, 1)
    if expr.is_NumberSymbol:
        return +mp.mpf(expr._to_mpmath(mp.prec + 10))
    if expr.is_Float:
        return mp.mpf(expr._mpf_)
    if expr.is_number:
        raise Undefined(expr)
    raise NoNumber(expr)


def _real(x: Any) -> Any:
    """The value as a real number; raises `Undefined` if its imaginary part is more than a rounding error."""
    if not isinstance(x, mpmath.mpc):
        return x
    if x.imag and _bits(x.imag) > _bits(x.real) - mp.prec + 30:
        raise Undefined(x)
    return x.real


def _logarithm(x: Any, base: Any = None) -> Any:
    return mp.log(x) if base is None else mp.log(x) / mp.log(base)


def _bounded_factorial(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    def taken(x: Any) -> Any:
        if _bits(x) > 20:
            raise NoNumber(x)
        return function(x)

    return taken


def _step(x: Any, at_zero: Any = None) -> Any:
    x = _real(x)
    return (mp.mpf(1) / 2 if at_zero is None else at_zero) if x == 0 else mp.mpf(int(x > 0))


_OTHERS: dict[str, Callable[..., Any]] = {
    "log": _logarithm,
    "atanh": mp.atanh,
    "acot": mp.acot,
    "gamma": _bounded_factorial(mp.gamma),
    "factorial": _bounded_factorial(mp.factorial),
    "atan2": lambda y, x: mp.atan2(_real(y), _real(x)),
    "Abs": lambda x: abs(x),
    "sign": mp.sign,
    "re": mp.re,
    "im": mp.im,
    "conjugate": mp.conj,
    "arg": mp.arg,
    "Max": lambda *xs: max(map(_real, xs)),
    "Min": lambda *xs: min(map(_real, xs)),
    "floor": lambda x: mp.floor(_real(x)),
    "ceiling": lambda x: mp.ceil(_real(x)),
    "Heaviside": _step,
    "Mod": lambda x, y: _real(x) - _real(y) * mp.floor(_real(x) / _real(y)),
}
