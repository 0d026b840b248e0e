"""Limiting cases: what is left of a result where a letter is small, large, or near a value."""

from __future__ import annotations

from itertools import islice
from typing import Any

from sympy import Abs, Expr, Mul, Pow, Rational, Symbol, factor_list, oo, sqrt

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expansion import (
    Expansion,
    NoExpansion,
    Series,
    expanded,
    in_ascending_powers,
    small_of,
    tidied_terms,
)
from derive.algebra.expressions import Relation, explicit
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.errors import Complaint, Rejected
from derive.mechanics.equations.unknowns import letter_of, meaning, unknown_of
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.step import Form, Level, Quantity, is_zero

__all__ = ["limiting_case"]

NEAR, NEARER = Rational(1, 10**8), Rational(1, 10**9)
POINTS = 4


def limiting_case(
    of: Quantity, letter: Any, to: Any = 0, order: int | None = None, key: str | None = None, symbol: str | None = None
) -> Quantity:
    """What a result is in a limiting case, f = c_n e^n + ... with e what is small: x, 1/x or x - a.

    of       a scalar, any unit
    letter   the letter that is small or large
    to       0 where it is small, SymPy's `oo` where it is large, else the value that it is near
    order    the highest power of what is small that is kept; the leading term alone if none is given
    Second route: numbers; the rest, divided by the last power that is kept, goes to zero with what is small.
    Outcomes: small, large, near; exact (nothing is left out).
    Errors: the result does not contain the letter; it has no such expansion, or begins beyond that order.
    Source: Morin, *Introduction to Classical Mechanics*, section 1.1 (special cases).
    """
    value, x = explicit(of.value), letter_of(unknown_of("limiting_case", letter))
    if not isinstance(value, Expr) or isinstance(value, Relation):
        raise Rejected(Complaint("wrong-argument", f"`limiting_case`: `{of.key}` is no number"))
    if x not in value.free_symbols:
        message = f"`limiting_case`: `{of.key}` does not contain {x.name}"
        raise Rejected(Complaint("nothing-to-put-in", message))
    place = explicit(to.value if isinstance(to, Quantity) else to)
    series = expansion_of(of, value, x, place, order)
    series = {n: _of_squares_drawn(c) for n, c in series.items()}
    power = Rational(order) if order is not None else max(series, default=Rational(0))
    found = tidied_terms(series, x, place)
    exact = is_zero(value - found)
    name = _name(of, symbol)
    return establish(
        "limits.limiting_case",
        name,
        lambda _: Expansion(_as_written(value, x, place), x, place, power),
        {"quantity": of},
        lines=Lines(
            law=Level.STANDARD,
            put_in=None,
            after=[Form(found, "result") if exact else Form(in_ascending_powers(series, x, place), "series")],
            result=False,
            arranged=lambda _: found,
            means={} if isinstance(name, Symbol) else meaning(name, found),
        ),
        routes={"numbers": lambda result: rest_vanishes(value, result, x, place, power)},
        outcome="exact" if exact else _sort_of(place),
        key=key or f"{of.key}_limit",
        kind=of.step.kind,
        telling=Telling(
            formulas={"letter": (x, x), **({"place": (place, place)} if place not in (oo, -oo) else {})},
            judged_by={"to": place, "value": value},
        ),
        scope=Scope(case_of=of),
    )


def expansion_of(of: Quantity, value: Expr, x: Symbol, place: Expr, order: int | None) -> Series:
    """Its terms to that order, the leading one alone without; refused where there are none in powers."""
    try:
        return expanded(value, x, place, None if order is None else Rational(order))
    except NoExpansion:
        message = f"`{of.key}` has no expansion in powers at {x.name} = {place}"
        help_line = None if order is None else "leave `order` out for the leading term alone"
        raise Rejected(Complaint("no-expansion", message, help=help_line)) from None


def _as_written(value: Expr, x: Symbol, place: Expr) -> Expr:
    """What is a polynomial already in ascending powers, its leading term in front: 2 pi sqrt(l/g) (1 + A^2/16)."""
    if place != 0 or value.is_Add or not value.is_polynomial(x):
        return value
    try:
        return in_ascending_powers(expanded(value, x, place, Rational(value.as_poly(x).degree())), x, place)
    except NoExpansion:
        return value


def _of_squares_drawn(value: Expr) -> Expr:
    """With |l_1 - l_2| for sqrt((l_1 + l_2)^2 - 4 l_1 l_2)."""
    drawn = {}
    for root in value.atoms(Pow):
        letters = root.base.free_symbols
        if root.exp != Rational(1, 2) or not letters or not root.base.is_polynomial(*letters):
            continue
        number, factors = factor_list(root.base)
        if number > 0 and all(times % 2 == 0 for _, times in factors):
            drawn[root] = sqrt(number) * Mul(*(Abs(part) ** (times // 2) for part, times in factors))
    return value.xreplace(drawn)


def _sort_of(place: Expr) -> str:
    if place == 0:
        return "small"
    return "large" if place in (oo, -oo) else "near"


def _name(of: Quantity, symbol: str | None) -> Any:
    if symbol is not None:
        return Symbol(symbol, real=True)
    return of.symbol if isinstance(of.symbol, Symbol) else unknown_of("limiting_case", of.symbol)


def rest_vanishes(value: Expr, found: Expr, x: Symbol, place: Expr, power: Rational) -> Verdict:
    """At two distances, one a tenth of the other: the rest over the last power kept is smaller by a root at least."""
    seen = 0
    letters = (letters_of(value) | letters_of(found)) - {x}
    for point in islice(points(letters, seed_of(value)), POINTS):
        sizes = []
        for near in (NEAR, NEARER):
            there = {**point, x: _at(place, near, point)}
            try:
                rest, small = value_at(value - found, there), value_at(small_of(x, place), there)
            except (Undefined, NoNumber):
                break
            sizes.append(abs((rest / abs(small) ** power).evalf(20)))
        if len(sizes) < 2:
            continue
        seen += 1
        if sizes[1] > sizes[0] * Rational(1, 2):
            where = tuple((str(name), str(number)) for name, number in point.items())
            return Verdict(Grade.REFUTED, f"the rest does not vanish to order {power} in what is small", where)
    if not seen:
        return Verdict(Grade.REFUTED, "undefined wherever it was tried")
    return Verdict(Grade.APPROXIMATION, f"to order {power} in what is small, in numbers")


def _at(place: Expr, near: Rational, point: Any) -> Expr:
    if place in (oo, -oo):
        return 1 / near if place == oo else -1 / near
    return place.subs(dict(point)) + near
