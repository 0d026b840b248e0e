"""Letters that lie between two numbers, 0 < alpha < pi/2, and the signs that are settled by it.

This is the one notion of a sign that holds whatever the letters are: laws, lines, outcomes and conditions ask here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from math import prod
from typing import Any

from sympy import Abs, Add, Expr, Integer, Mul, Pow, Rational, Symbol, cos, floor, oo, pi, sin, tan, together
from sympy.simplify.fu import TR5, TR6

from derive.algebra.order import known_order


@dataclass(frozen=True)
class Range:
    """The letter is greater than one number and less than the other; an end that is `closed` it may have.

    Either end may be infinite. `written` is how a file has it.
    """

    least: Expr
    greatest: Expr
    closed: tuple[bool, bool] = (False, False)
    written: str = field(default="", compare=False)

    def holds(self, number: Expr) -> bool:
        """Whether the number is one of those in the range."""
        ways = number - self.least, self.greatest - number
        return all(
            way.is_extended_positive or closed and way.is_zero for way, closed in zip(ways, self.closed, strict=True)
        )

    @property
    def is_above_zero(self) -> bool:
        return bool(self.least.is_extended_positive or self.least.is_zero and not self.closed[0])

    def at(self, way: Expr) -> Expr:
        """The number that is a part of the way, 0 < way < 1, from the lower end to the upper."""
        if self.least.is_finite and self.greatest.is_finite:
            return self.least + (self.greatest - self.least) * way
        beyond = way / (1 - way)
        if self.least.is_finite:
            return self.least + beyond
        return self.greatest - 1 / beyond if self.greatest.is_finite else beyond - 1 / beyond

    def near(self, number: Expr) -> Expr:
        """A number of the range for any positive one, growing with it, itself where nothing stands against that."""
        return number if self == POSITIVE else self.at(number / (1 + number))


LARGEST = 200  # operations of a sum whose squares are turned into one another
POSITIVE = Range(Integer(0), oo, written="(0, infinity)")

_KNOWN: ContextVar[Mapping[Symbol, Range]] = ContextVar("ranges", default={})  # noqa: B039  which nobody changes


_POSITIVE: ContextVar[tuple[Expr, ...]] = ContextVar("positive", default=())


@contextmanager
def own_meaning() -> Iterator[None]:
    """What is taken to be positive inside is forgotten behind it."""
    token = _POSITIVE.set(())
    try:
        yield
    finally:
        _POSITIVE.reset(token)


def take_as_positive(expr: Expr) -> None:
    """From here on nothing has a meaning where this is not positive, as c^2 - v^2 of what moves with the speed v."""
    if expr not in _POSITIVE.get():
        _POSITIVE.set((*_POSITIVE.get(), expr))


def taken_as_positive() -> tuple[Expr, ...]:
    """What has been taken to be positive so far."""
    return _POSITIVE.get()


def known_ranges() -> Mapping[Symbol, Range]:
    """The letters that are known to lie in a range."""
    return _KNOWN.get()


def has_meaning(point: Mapping[Expr, Expr]) -> bool:
    """Whether nothing that is taken to be positive is otherwise there, as far as the point tells."""
    told = (each for each in _POSITIVE.get() if each.free_symbols <= point.keys())
    return all(each.xreplace(dict(point)).evalf(20).is_positive is not False for each in told)


@contextmanager
def within(ranges: Mapping[Symbol, Range]) -> Iterator[None]:
    """What is done inside knows these letters to lie in their ranges."""
    token = _KNOWN.set({**_KNOWN.get(), **ranges})
    try:
        yield
    finally:
        _KNOWN.reset(token)


def range_of(letter: Any) -> Range | None:
    return _KNOWN.get().get(letter)


def rational_in_range(letter: Any, number: Expr) -> Expr:
    """A positive number, or for a letter that lies in a range a rational one of that range in its place."""
    known = range_of(letter)
    if known is None:
        return number
    there = known.near(number)
    return there if there.is_Rational else Rational(str(there.evalf(20)))


def fulfilling(point: Mapping[Any, Any]) -> dict[Any, Any]:
    """Numbers for letters, changed so that they fulfil the relations that are taken to hold."""
    order = known_order()
    return order.at(point, _fits) if order else dict(point)


def _fits(letter: Any, number: Expr) -> bool:
    known = range_of(letter)
    return known.holds(number) if known is not None else not (letter.is_positive and not number.is_positive)


def settled(value: Any) -> Any:
    """The value without absolute values of what has one sign in the ranges of its letters."""
    known = _KNOWN.get()
    if not hasattr(value, "atoms") or not (value.free_symbols & known.keys() or known_order().touches(value)):
        return value
    sizes = {size: sign * size.args[0] for size in value.atoms(Abs) if (sign := sign_within(size.args[0]))}
    return value.xreplace(sizes) if sizes else value


def with_positive_factors_out(value: Expr) -> Expr:
    """sqrt(u^2 + v^2/sin(a)^2) as sqrt(u^2 sin(a)^2 + v^2)/sin(a), where the range of a makes sin(a) positive."""
    known = _KNOWN.get()
    if not known:
        return value
    roots = [p for p in value.atoms(Pow) if p.exp.is_Rational and not p.exp.is_Integer and p.has(sin, cos, tan)]
    drawn = {root: found for root in roots if root.base.free_symbols & known.keys() and (found := _drawn_out(root))}
    return value.xreplace(drawn) if drawn else value


def _drawn_out(root: Pow) -> Expr | None:
    outside, inside = Integer(1), Integer(1)
    above, below = together(root.base).as_numer_denom()
    for part, sign in ((above, 1), (below, -1)):
        for factor in Mul.make_args(part):
            base, power = factor.as_base_exp()
            if base.has(sin, cos, tan) and power.is_Integer and sign_within(base) == 1:
                outside *= Pow(base, sign * power * root.exp)
            else:
                inside *= Pow(factor, sign)
    return outside * Pow(inside, root.exp) if outside != 1 else None


def sign_within(expr: Expr) -> int | None:
    """1 or -1 where the sign is the same for all values in the ranges of the letters; None where that is not known."""
    signs = [_sign_of_factor(factor) for factor in Mul.make_args(expr)]
    return None if None in signs else prod(sign for sign in signs if sign)


def strict_sign_within(expr: Expr) -> int | None:
    """The same where no letter may have an end of its range, at which the value may vanish."""
    if any(True in known.closed for letter in expr.free_symbols if (known := range_of(letter)) is not None):
        return None
    return sign_within(expr)


def never_vanishes_within(expr: Expr) -> bool:
    """Whether the expression is nowhere zero, by what its letters are and by the ranges in which they lie."""
    return all(
        bool(base.is_nonzero) or strict_sign_within(base) is not None
        for base in (factor.as_base_exp()[0] for factor in Mul.make_args(expr))
    )


def _sign_of_factor(factor: Expr) -> int | None:
    if factor.is_positive or factor.is_negative:
        return 1 if factor.is_positive else -1
    if isinstance(factor, Add) and (sign := _sign_by_squares(factor)):
        return sign
    if known_order().touches(factor) and (sign := known_order().sign(factor, sign_within)):
        return sign
    if factor.free_symbols.isdisjoint(_KNOWN.get()):
        return None
    if isinstance(factor, Pow):
        return _sign_of_power(factor.base, factor.exp)
    if isinstance(factor, Abs):
        return 1 if sign_within(factor.args[0]) else None
    if isinstance(factor, sin | cos | tan):
        return _sign_of_function(factor)
    if (known := _range_of_letter(factor)) is not None:
        return _sign_between(known.least, known.greatest)
    return _sign_of_sum(factor) if isinstance(factor, Add) else None


def _sign_of_power(base: Expr, exponent: Expr) -> int | None:
    sign = sign_within(base)
    if exponent.is_Integer:
        return sign**2 if sign and exponent % 2 == 0 else sign
    return 1 if sign == 1 and exponent.is_real else None


def _range_of_letter(factor: Expr) -> Range | None:
    return range_of(factor) if isinstance(factor, Symbol) else None


def _sign_between(least: Expr, greatest: Expr) -> int | None:
    return 1 if least.is_extended_nonnegative else -1 if greatest.is_extended_nonpositive else None


def _sign_of_sum(total: Expr) -> int | None:
    """By the sign that all its terms have; or by the ends between which it lies."""
    for sign in (1, -1):
        terms = [sign * term for term in total.args]
        strict = [sign_within(term) == 1 for term in terms]
        if any(strict) and all(sure or _is_nonnegative(term) for sure, term in zip(strict, terms, strict=True)):
            return sign
    ends = _ends(total)
    return None if ends is None else _sign_between(*ends)


def _is_nonnegative(term: Expr) -> bool:
    """Whether its factors are positive, or not negative: c^2 sin(alpha)."""
    if term.is_nonnegative:
        return True
    open_factors = Mul(*(f for f in Mul.make_args(term) if not f.is_nonnegative))
    return sign_within(open_factors) == 1


def _sign_by_squares(total: Add) -> int | None:
    """Of a sum that is of one sign though sines or cosines stand in it: m + M - m cos^2, M + m sin^2."""
    if not total.has(sin, cos) or total.count_ops() > LARGEST:
        return None
    for squares in (total, TR5(total.expand()), TR6(total.expand())):
        terms = Add.make_args(squares.expand())
        for sign in (1, -1):
            signed = [sign * term for term in terms]
            if all(term.is_nonnegative for term in signed) and any(term.is_positive for term in signed):
                return sign
    return None


def _sign_of_function(function: Expr) -> int | None:
    """By the quarter of the circle, or the half, in which its angle stays."""
    ends = _ends(function.args[0])
    if ends is None or not (ends[0].is_finite and ends[1].is_finite):
        return None
    width = pi / 2 if isinstance(function, tan) else pi
    shift = pi / 2 if isinstance(function, cos) else Integer(0)
    first = floor((ends[0] + shift) / width)
    if (ends[1] + shift - (first + 1) * width).is_positive is not False:
        return None
    return -1 if first % 2 else 1


def ends_within(expr: Expr) -> tuple[Expr, Expr] | None:
    """Between which numbers a letter lies, or a sine or cosine; nothing where that is open or an end is reached."""
    if any(True in known.closed for letter in expr.free_symbols if (known := range_of(letter)) is not None):
        return None
    return _ends(expr)


def _ends(expr: Expr) -> tuple[Expr, Expr] | None:
    """Between which numbers a sum of multiples of letters, sines and cosines lies, neither of which it has."""
    least: Expr = Integer(0)
    greatest: Expr = Integer(0)
    for term in Add.make_args(expr):
        number, rest = term.as_coeff_Mul()
        if rest == 1 or rest.is_number:
            ends: tuple[Expr, Expr] | None = (term, term)
        elif (between := _between(rest)) is not None:
            ends = (number * between[0], number * between[1])
            ends = ends if number.is_positive else ends[::-1]
        else:
            return None
        assert ends is not None
        least, greatest = least + ends[0], greatest + ends[1]
    return least, greatest


def _between(rest: Expr) -> tuple[Expr, Expr] | None:
    """The ends of a letter, or of a sine or a cosine, or a power of one, that only rises or only falls in the range."""
    if (known := _range_of_letter(rest)) is not None:
        return known.least, known.greatest
    if isinstance(rest, Pow) and rest.exp.is_Integer and rest.exp.is_positive and sign_within(rest.base) == 1:
        ends = _between(rest.base)
        return (ends[0] ** rest.exp, ends[1] ** rest.exp) if ends and ends[0].is_nonnegative else None
    if not isinstance(rest, sin | cos):
        return None
    slope = cos(rest.args[0]) if isinstance(rest, sin) else -sin(rest.args[0])
    ends, rising = _ends(rest.args[0]), sign_within(slope)
    if ends is None or rising is None:
        return None
    first, last = (rest.func(end) for end in ends)
    return (first, last) if rising == 1 else (last, first)
