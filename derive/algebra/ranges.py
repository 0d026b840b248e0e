"""Symbols that lie between two numbers, 0 < alpha < pi/2, and the signs that follow from this."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from math import prod
from typing import Any

from sympy import (
    Abs,
    Add,
    Dummy,
    Expr,
    Integer,
    Mul,
    Poly,
    Pow,
    Rational,
    Symbol,
    atan,
    binomial,
    cos,
    floor,
    oo,
    pi,
    sin,
    tan,
    together,
)
from sympy.simplify.fu import TR5, TR6

from derive.algebra.order import known_order


@dataclass(frozen=True)
class Range:
    """The interval from `least` to `greatest` in which a symbol lies. An end belongs to the range only if it is
    `closed`.

    Either end may be infinite. `written` is the text of the range in a file.
    """

    least: Expr
    greatest: Expr
    closed: tuple[bool, bool] = (False, False)
    written: str = field(default="", compare=False)

    def holds(self, number: Expr) -> bool:
        """Whether the number is in the range."""
        ways = number - self.least, self.greatest - number
        return all(
            way.is_extended_positive or closed and way.is_zero for way, closed in zip(ways, self.closed, strict=True)
        )

    @property
    def is_above_zero(self) -> bool:
        return bool(self.least.is_extended_positive or self.least.is_zero and not self.closed[0])

    def at(self, way: Expr) -> Expr:
        """A number in the range; it increases with `way`, where 0 < way < 1."""
        if self.least.is_finite and self.greatest.is_finite:
            return self.least + (self.greatest - self.least) * way
        beyond = way / (1 - way)
        if self.least.is_finite:
            return self.least + beyond
        return self.greatest - 1 / beyond if self.greatest.is_finite else beyond - 1 / beyond

    def near(self, number: Expr) -> Expr:
        """Map a positive number to a number in the range by an increasing function."""
        return number if self == POSITIVE else self.at(number / (1 + number))


LARGEST = 200  # greatest number of operations of a sum in which squares of sines and cosines are replaced
POSITIVE = Range(Integer(0), oo, written="(0, infinity)")

_KNOWN: ContextVar[Mapping[Symbol, Range]] = ContextVar("ranges", default={})  # noqa: B039  the default is never changed


_POSITIVE: ContextVar[tuple[Expr, ...]] = ContextVar("positive", default=())


@contextmanager
def own_meaning() -> Iterator[None]:
    """Forget all assumptions of positivity for the `with` block, and restore them after it."""
    token = _POSITIVE.set(())
    try:
        yield
    finally:
        _POSITIVE.reset(token)


@contextmanager
def where_positive(expr: Expr) -> Iterator[None]:
    """Skip points at which this expression is known not to be positive, within the `with` block."""
    token = _POSITIVE.set((*_POSITIVE.get(), expr))
    try:
        yield
    finally:
        _POSITIVE.reset(token)


def take_as_positive(expr: Expr) -> None:
    """Assume from now on that the expression is positive, such as c^2 - v^2 for a body with the speed v."""
    if expr not in _POSITIVE.get():
        _POSITIVE.set((*_POSITIVE.get(), expr))


def taken_as_positive() -> tuple[Expr, ...]:
    """The expressions that have been assumed positive so far."""
    return _POSITIVE.get()


def known_ranges() -> Mapping[Symbol, Range]:
    """The symbols that have a known range, each with its range."""
    return _KNOWN.get()


def has_meaning(point: Mapping[Expr, Expr]) -> bool:
    """Return False if the point is known to contradict an assumption of positivity, else True."""
    told = (each for each in _POSITIVE.get() if each.free_symbols <= point.keys())
    return all(each.xreplace(dict(point)).evalf(20).is_positive is not False for each in told)


@contextmanager
def within(ranges: Mapping[Symbol, Range]) -> Iterator[None]:
    """Assume these ranges of symbols within the `with` block."""
    token = _KNOWN.set({**_KNOWN.get(), **ranges})
    try:
        yield
    finally:
        _KNOWN.reset(token)


def range_of(letter: Any) -> Range | None:
    return _KNOWN.get().get(letter)


def rational_in_range(letter: Any, number: Expr) -> Expr:
    """Map a positive number to a rational number in the range of a symbol; without a range the number is unchanged."""
    known = range_of(letter)
    if known is None:
        return number
    there = known.near(number)
    return there if there.is_Rational else Rational(str(there.evalf(20)))


def fulfilling(point: Mapping[Any, Any]) -> dict[Any, Any]:
    """The point, with the numbers of some symbols changed so that, if possible, the numbers satisfy the assumed
    relations."""
    order = known_order()
    return order.at(point, _fits) if order else dict(point)


def _fits(letter: Any, number: Expr) -> bool:
    known = range_of(letter)
    return known.holds(number) if known is not None else not (letter.is_positive and not number.is_positive)


def without_abs(value: Any) -> Any:
    """Remove each absolute value if the ranges of symbols or the assumed relations determine the sign of its argument.
    Also write (sin(a)^3)^(2/3) as sin(a)^2 where sin(a) > 0."""
    known = _KNOWN.get()
    if not hasattr(value, "atoms") or not (value.free_symbols & known.keys() or known_order().touches(value)):
        return value
    sizes = {size: sign * size.args[0] for size in value.atoms(Abs) if (sign := sign_within(size.args[0]))}
    roots = [p for p in value.atoms(Pow) if p.exp.is_Rational and not p.exp.is_Integer]
    powers = {root: whole for root in roots if (whole := _with_whole_powers_out(root)) != root}
    return value.xreplace({**sizes, **powers}) if sizes or powers else value


def _with_whole_powers_out(root: Pow) -> Expr:
    outside = [
        power
        for power in Mul.make_args(root.base)
        if power.is_Pow and (power.exp * root.exp).is_Integer and sign_within(power.base) == 1
    ]
    inside = Mul(*(factor for factor in Mul.make_args(root.base) if factor not in outside))
    return Mul(Pow(inside, root.exp), *(Pow(power.base, power.exp * root.exp) for power in outside))


def with_positive_factors_out(value: Expr) -> Expr:
    """Take positive factors with sines, cosines or tangents out of roots: sqrt(1 + v^2/sin(a)^2) becomes
    sqrt(sin(a)^2 + v^2)/sin(a) where sin(a) > 0."""
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
    """The sign of an expression, 1 or -1; None if it is not known. The sign must be the same at all points that the
    ranges of the symbols and the assumed relations allow. The ends of the ranges are left out."""
    signs = [_sign_of_factor(factor) for factor in Mul.make_args(expr)]
    return None if None in signs else prod(sign for sign in signs if sign)


def strict_sign_within(expr: Expr) -> int | None:
    """The sign that `sign_within` finds, if the expression also has this sign at the ends that belong to the ranges;
    else None."""
    sign = sign_within(expr)
    if sign is None:
        return None
    closed = ((letter, end) for letter in expr.free_symbols for end in _ends_included(letter))
    return sign if all(strict_sign_within(expr.xreplace({letter: end})) == sign for letter, end in closed) else None


def _ends_included(letter: Any) -> list[Expr]:
    known = range_of(letter)
    ends = zip((known.least, known.greatest), known.closed, strict=True) if known is not None else ()
    return [end for end, closed in ends if closed]


def never_vanishes_within(expr: Expr) -> bool:
    """Whether the assumptions and the ranges of the symbols show that the expression is nowhere zero."""
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
    if factor.free_symbols.isdisjoint(_KNOWN.get()) and not factor.has(atan):
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
    for sign in (1, -1):
        terms = [sign * term for term in total.args]
        strict = [sign_within(term) == 1 for term in terms]
        if any(strict) and all(sure or _is_nonnegative(term) for sure, term in zip(strict, terms, strict=True)):
            return sign
    ends = _ends(total)
    sign_of_bounds = None if ends is None else _sign_between(*ends)
    return _sign_as_product(total) if sign_of_bounds is None else sign_of_bounds


def _is_nonnegative(term: Expr) -> bool:
    """Whether the term is known not to be negative, such as c^2 sin(alpha) for 0 < alpha < pi."""
    if term.is_nonnegative:
        return True
    open_factors = Mul(*(f for f in Mul.make_args(term) if not f.is_nonnegative))
    return sign_within(open_factors) == 1


def _sign_by_squares(total: Add) -> int | None:
    """The sign of a sum with squares of sines or cosines, such as m + M - m cos^2. None if the sign is unknown."""
    if not total.has(sin, cos) or total.count_ops() > LARGEST:
        return None
    for squares in (total, TR5(total.expand()), TR6(total.expand())):
        terms = Add.make_args(squares.expand())
        for sign in (1, -1):
            signed = [sign * term for term in terms]
            if not all(term.is_nonnegative for term in signed):
                continue
            if any(term.is_positive for term in signed) or _have_sine_and_cosine(signed):
                return sign
    return _sign_by_bounds_of_cosine(total)


def _sign_by_bounds_of_cosine(total: Add) -> int | None:
    """The sign of a polynomial in the cosine c of one angle, such as M + m (2 + c - c^2); None if it is unknown.

    A polynomial between -1 and 1 lies between its Bernstein coefficients. It has their sign if none of them has the
    opposite sign and the first and the last are not zero.
    """
    angles = {f.args[0] for f in total.atoms(sin, cos)}
    c, u = Dummy("c"), Dummy("u")
    value = TR5(total.expand()).xreplace({cos(angle): c for angle in angles}).expand()
    if len(angles) != 1 or value.has(sin, cos) or not value.is_polynomial(c):
        return None
    powers = Poly(value.xreplace({c: 2 * u - 1}), u).all_coeffs()[::-1]
    n = len(powers) - 1
    bounds = [Add(*(binomial(i, k) * powers[k] / binomial(n, k) for k in range(i + 1))).expand() for i in range(n + 1)]
    for sign in (1, -1):
        signed = [sign * each for each in bounds]
        if all(each.is_nonnegative for each in signed) and signed[0].is_positive and signed[-1].is_positive:
            return sign
    return None


def _have_sine_and_cosine(terms: Sequence[Expr]) -> bool:
    """Whether these terms contain the squares of the sine and of the cosine of one angle, each with a positive factor,
    as in M sin^2 + m cos^2. The sine and the cosine never vanish together."""
    positive = {
        square.base for term in terms for square in term.atoms(Pow) if square.exp == 2 and (term / square).is_positive
    }
    return any(cos(each.args[0]) in positive for each in positive if isinstance(each, sin))


def _sign_as_product(total: Add) -> int | None:
    """The sign of a sum or difference of two sines or two cosines, from its form as a product; None if it is
    unknown."""
    if len(total.args) != 2:
        return None
    (factor, one), (other_factor, other) = (term.as_independent(sin, cos, as_Add=False) for term in total.args)
    if not isinstance(one, sin | cos) or one.func != other.func or other_factor not in (factor, -factor):
        return None
    half_sum, half_difference = ((one.args[0] + sign * other.args[0]) / 2 for sign in (1, -1))
    if other_factor == factor:
        product = one.func(half_sum) * cos(half_difference)
    elif isinstance(one, sin):
        product = cos(half_sum) * sin(half_difference)
    else:
        product = -sin(half_sum) * sin(half_difference)
    return sign_within(factor * product)


def _sign_of_function(function: Expr) -> int | None:
    """The sign of a sine, cosine or tangent, from the range of its angle; None if it is unknown."""
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
    """The bounds of an expression; None if they are unknown, or if the range of a symbol includes one of its ends."""
    if any(True in known.closed for letter in expr.free_symbols if (known := range_of(letter)) is not None):
        return None
    return _ends(expr)


def _ends(expr: Expr) -> tuple[Expr, Expr] | None:
    """The bounds of a sum of numbers and of multiples of expressions with bounds (`_between`); None if they are
    unknown."""
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
    """The bounds of a symbol, a function or a power; None if they are unknown."""
    if (known := _range_of_letter(rest)) is not None:
        return known.least, known.greatest
    if isinstance(rest, atan):
        sign = sign_within(rest.args[0])
        return (Integer(0) if sign == 1 else -pi / 2), (Integer(0) if sign == -1 else pi / 2)
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
