"""The leading terms of a result if a symbol is small, large or near a value, and two methods to check these terms."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import islice
from typing import Any

from sympy import (
    Abs,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    MatrixBase,
    Mul,
    Pow,
    Rational,
    Symbol,
    factor_list,
    nan,
    oo,
    sqrt,
    zoo,
)
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.equality import Grade, Verdict, equal
from derive.algebra.expansion import BeginsBeyond, NoExpansion, Series, expanded, small_of, tidied_terms
from derive.algebra.ranges import range_of
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.taylor import NoSeries, arithmetic_along
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.steps.step import Quantity

DISTANCES = ((Rational(1, 10**8), Rational(1, 10**9)), (Rational(1, 40), Rational(1, 80)))
POINTS = 4
SLOWEST = Rational(1, 6)  # the quotient in `rest_vanishes` must shrink at least as fast as this power of the distance


def entries_of(value: Any) -> list[Expr]:
    return list(value) if isinstance(value, MatrixBase) else [value]


def entry_by_entry(change: Callable[[Expr], Expr], value: Any) -> Any:
    """Apply the change to a number, or to each entry of a vector or tensor."""
    if isinstance(value, MatrixBase):
        return ImmutableDenseMatrix(*value.shape, [change(entry) for entry in value])
    return change(value)


def beginnings(of: Quantity, value: Any, x: Symbol, place: Expr, order: int | None) -> list[Series]:
    """The terms of each entry's series; without an order, only terms of the lowest power that occurs in any entry."""
    is_one = not isinstance(value, MatrixBase)
    each = [expansion_of(of, entry, x, place, order, is_one) for entry in entries_of(value)]
    if order is None:
        lowest = min((n for series in each for n in series), default=Rational(0))
        each = [{n: c for n, c in series.items() if n == lowest} for series in each]
    if not any(each):
        raise _has_none(of, x, place, order, begins_beyond=True)
    return [{n: _of_squares_drawn(c) for n, c in series.items()} for series in each]


def expansion_of(of: Quantity, value: Expr, x: Symbol, place: Expr, order: int | None, is_one: bool = True) -> Series:
    """The terms whose order is at most `order`; by default the leading term only. Rejects a value without an expansion
    in powers.

    is_one   whether the value is a scalar result. For an entry of a vector or tensor, a series that begins above
             `order` is not an error
    """
    try:
        return expanded(value, x, place, None if order is None else Rational(order))
    except NoExpansion as none:
        if isinstance(none, BeginsBeyond) and not is_one:
            return {}
        raise _has_none(of, x, place, order, isinstance(none, BeginsBeyond)) from None


def _has_none(of: Quantity, x: Symbol, place: Expr, order: int | None, begins_beyond: bool = False) -> Rejected:
    message = f"`{of.key}` has no expansion in powers at {x.name} = {place}"
    if begins_beyond and order is not None:
        message = f"the expansion of `{of.key}` at {x.name} = {place} has no term up to the order {order}"
    help_line = None if order is None else "omit `order` to get only the leading term"
    return Rejected(Complaint("no-expansion", message, help=help_line))


def _of_squares_drawn(value: Expr) -> Expr:
    """Replace roots of squares: |l_1 - l_2| for sqrt((l_1 + l_2)^2 - 4 l_1 l_2)."""
    drawn = {}
    for root in value.atoms(Pow):
        letters = root.base.free_symbols
        if root.exp != Rational(1, 2) or not letters or not root.base.is_polynomial(*letters):
            continue
        number, factors = factor_list(root.base)
        if number > 0 and all(times % 2 == 0 for _, times in factors):
            drawn[root] = sqrt(number) * Mul(*(Abs(part) ** (times // 2) for part, times in factors))
    return value.xreplace(drawn)


# --- second routes ---------------------------------------------------------------------------------------------------


def terms_by_arithmetic(value: Any, series: Sequence[Series], x: Symbol, place: Expr, power: Rational) -> Any | None:
    """The terms of the series, computed by arithmetic without derivatives; None if they are not found."""
    first = min((n for each in series for n in each), default=Rational(0))
    if not first.is_Integer or not power.is_Integer:
        return None
    s = Dummy("s", positive=True)
    there = 1 / s if place == oo else -1 / s if place == -oo else place + s

    def terms(entry: Expr) -> Expr:
        moved = tidied(entry.xreplace({x: there}) * s ** (-first))
        found = arithmetic_along(moved, {s: Integer(0)}, {s: Integer(1)}, int(power - first))
        return tidied_terms({first + k: tidied(c) for k, c in enumerate(found)}, x, place)

    try:
        found = entry_by_entry(terms, value)
        return None if found.has(nan, zoo) else found
    except (NoSeries, PolynomialError, ZeroDivisionError):
        return None


def to_that_order(found: Any, again: Any, whole: bool) -> Verdict:
    """Compare two sets of terms. Equal terms have the grade APPROXIMATION, unless `whole` is true, as for a limit."""
    verdict = equal(found, again)
    if whole or verdict.grade is Grade.REFUTED:
        return verdict
    return Verdict(Grade.APPROXIMATION, f"to that order, {verdict.detail}")


def rest_vanishes(value: Any, found: Any, x: Symbol, place: Expr, power: Rational) -> Verdict:
    """Compare the remainder at two distances: the remainder divided by the last power kept must shrink.

    The next power may be fractional, as in a + b x^(1/4), so the quotient may shrink more slowly than the distance.
    Both sides of the value `place` are tested if both are possible. For example, |m - M| has different leading terms on
    the two sides of m = M.
    """
    for before, after in zip(entries_of(value), entries_of(found), strict=True):
        for side in _sides(x, place):
            verdict = _rest_of_entry(before, after, x, place, power, side)
            if verdict.grade is Grade.REFUTED:
                return verdict
    return Verdict(Grade.APPROXIMATION, f"to order {power} in the small quantity, numerically")


def _sides(x: Symbol, place: Expr) -> tuple[int, ...]:
    known = range_of(x)
    if place in (oo, -oo):
        return (1,)
    if (place == 0 and x.is_nonnegative) or (known is not None and place == known.least):
        return (1,)
    return (-1,) if known is not None and place == known.greatest else (1, -1)


def _rest_of_entry(value: Expr, found: Expr, x: Symbol, place: Expr, power: Rational, side: int) -> Verdict:
    """Compare the remainder of one entry at two distances close to `place`, or at two larger distances if the remainder
    has no value there."""
    seen = 0
    letters = (letters_of(value) | letters_of(found) | letters_of(place)) - {x}
    for point in islice(points(letters, seed_of(value)), POINTS):
        tried = (_shrinks(value, found, x, place, power, side, point, distances) for distances in DISTANCES)
        shrinks = next((each for each in tried if each is not None), None)
        if shrinks is None:
            continue
        seen += 1
        if not shrinks:
            where = tuple((str(name), str(number)) for name, number in point.items())
            return Verdict(Grade.REFUTED, f"the remainder does not vanish to order {power}", where)
    if not seen:
        return Verdict(Grade.REFUTED, "undefined at every tested point")
    return Verdict(Grade.APPROXIMATION, "numerically")


def _shrinks(
    value: Expr, found: Expr, x: Symbol, place: Expr, power: Rational, side: int, point: Any, distances: Any
) -> bool | None:
    """Whether the remainder, divided by the power of the small quantity, shrinks fast enough (`SLOWEST`).

    The farther and the closer of two distances are compared. The result is None if the remainder has no value.
    """
    sizes = []
    for near in distances:
        there = {**point, x: _at(place, near, point, side)}
        try:
            rest, small = value_at(value - found, there), value_at(small_of(x, place), there)
        except (Undefined, NoNumber):
            return None
        sizes.append(abs((rest / abs(small) ** power).evalf(20)))
    farther, closer = distances
    return bool(sizes[1] <= sizes[0] * (closer / farther) ** SLOWEST)


def _at(place: Expr, near: Rational, point: Any, side: int) -> Expr:
    if place in (oo, -oo):
        return 1 / near if place == oo else -1 / near
    return place.subs(dict(point)) + side * near
