"""Use derivatives to find the first terms of an expression in which a symbol is small, large, or near a value.

    f = N/D: N and D are expanded in Taylor series in the small quantity, and the series are divided

The leading power may be negative or half-integer. Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*,
3.6.22 (quotient of power series).
"""

from __future__ import annotations

from sympy import (
    AccumBounds,
    Add,
    Dummy,
    Expr,
    Integer,
    Rational,
    Symbol,
    cosh,
    diff,
    exp,
    ilcm,
    nan,
    oo,
    sinh,
    tanh,
    together,
    zoo,
)
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import Factors, Terms
from derive.algebra.length import length
from derive.algebra.node import DimensionOf, Node, ScalarNode, TextOf, explicit
from derive.algebra.tidy import tidied

HIGHEST = 10  # highest order of a derivative
LARGEST = 4000  # greatest number of operations of an expression that is expanded
SMALL = Dummy("epsilon", positive=True)
SPOILT = (nan, zoo, oo, -oo, AccumBounds)

Series = dict[Rational, Expr]  # power -> coefficient


class NoExpansion(Exception):
    """No expansion in powers was found at this limit."""


class BeginsBeyond(NoExpansion):
    """The expansion begins with a power above the requested one, so all requested terms are zero."""


class Expansion(ScalarNode):
    """The first terms of f as a series in the small quantity. Arguments: f, the symbol, its limit, the highest power.

    The small quantity is x if x goes to 0, 1/x if x goes to infinity, -1/x if x goes to -infinity, and x - a near a.
    """

    def doit(self, **hints: object) -> Expr:
        f, x, to, power = self.args
        try:
            return tidied_terms(expanded(explicit(f), x, to, power), x, to)
        except BeginsBeyond:
            return Integer(0)
        except NoExpansion:
            return nan

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return of(self.args[0])

    def lowered(self, text: TextOf) -> str:
        return text(self.args[0])


class Approach(Node):
    """A symbol or a ratio that goes to a limit, S -> oo. Arguments: the symbol or ratio, and the limit."""

    def _evaluated(self, what: Expr, to: Expr) -> Expr:
        return Approach(what, to)

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return of(self.args[0])

    def lowered(self, text: TextOf) -> str:
        return f"Tuple({text(self.args[0])}, {text(self.args[1])})"


class FirstOrder(ScalarNode):
    """The terms of f up to first order in several small symbols. Arguments: f, and the symbols.

    A page displays the node as f.
    """

    def _evaluated(self, f: Expr, *small: Expr) -> Expr:
        none = dict.fromkeys(small, Integer(0))
        return Add(f.subs(none), *(s * diff(f, s).subs(none) for s in small))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return of(self.args[0])

    def lowered(self, text: TextOf) -> str:
        return text(explicit(self))


def expanded(f: Expr, x: Symbol, to: Expr, power: Rational | None = None) -> Series:
    """The terms in which the power of the small quantity is at most `power`, as power -> coefficient; by default only
    the leading term. The result for f = 0 is empty. Raises `NoExpansion` if no expansion is found."""
    written = in_small(f, x, to)
    if written.count_ops() > LARGEST:
        raise NoExpansion(f)
    try:
        return _quotient(written, power)
    except BeginsBeyond:
        raise
    except NoExpansion:
        halved = {SMALL: SMALL**2}
        doubled = _quotient(tidied(written.xreplace(halved)), None if power is None else 2 * power)
        return {n / 2: c for n, c in doubled.items()}


def in_small(f: Expr, x: Symbol, to: Expr) -> Expr:
    """The expression in terms of the small quantity; at infinity, without exponentials that vanish there."""
    if to in (oo, -oo):
        return tidied(_without_what_dies(f.subs(x, (1 if to == oo else -1) / SMALL)))
    return tidied(f.subs(x, to + SMALL))


def _without_what_dies(f: Expr) -> Expr:
    """Drop exponentials that go to zero faster than any power: for long times only 1 is left of 1 - exp(-k t)."""
    f = f.replace(lambda e: isinstance(e, sinh | cosh | tanh) and e.has(SMALL), lambda e: e.rewrite(exp))
    rates = {e: (e.args[0] * SMALL).expand() for e in f.atoms(exp) if e.has(SMALL)}
    rates = {e: rate for e, rate in rates.items() if not rate.has(SMALL) and rate.is_nonzero}
    if not rates:
        return f
    first = next(iter(rates.values()))
    ratios = {e: tidied(rate / first) * (-1 if first.is_positive else 1) for e, rate in rates.items()}
    if first.is_positive is first.is_negative or not all(ratio.is_Rational for ratio in ratios.values()):
        raise NoExpansion(f)
    dying, whole = Dummy("d", positive=True), ilcm(1, *(ratio.q for ratio in ratios.values()))
    left = together(f.xreplace({e: dying ** (whole * ratio) for e, ratio in ratios.items()})).subs(dying, 0)
    if left.has(*SPOILT):
        raise NoExpansion(f)
    return left


def small_of(x: Symbol, to: Expr) -> Expr:
    """The small quantity: 1/x, -1/x or x - a."""
    return 1 / x if to == oo else -1 / x if to == -oo else x - to


def tidied_terms(series: Series, x: Symbol, to: Expr) -> Expr:
    small = small_of(x, to)
    return Add(*(tidied(c) * small**n for n, c in sorted(series.items())))


def in_ascending_powers(series: Series, x: Symbol, to: Expr) -> Expr:
    """The terms in ascending powers; the leading term is factored out if the result is not longer."""
    small = small_of(x, to)
    terms = [(n, tidied(c)) for n, c in sorted(series.items())]
    plain = Terms(*(c * small**n for n, c in terms))
    if len(terms) < 2:
        return tidied_terms(series, x, to)
    (first, leading), *rest = terms
    inside = Terms(Integer(1), *(tidied(c / leading) * small ** (n - first) for n, c in rest))
    lead = leading * small**first
    forms = [plain] if lead == 1 else [Factors(lead, inside), plain]
    return min(forms, key=lambda form: sum(length(part) for part in form.args))


def _quotient(f: Expr, power: Rational | None) -> Series:
    above, below = f.as_numer_denom()
    bottom, low = _taylor(below, 0)
    top, high = _taylor(above, 0)
    if not top:
        return {}
    first = Rational(high - low)
    if power is not None and power < first:
        raise BeginsBeyond(f)
    count = 0 if power is None else int(power - first)
    if count > HIGHEST:
        raise NoExpansion(f)
    top, _ = _taylor(above, high + count)
    bottom, _ = _taylor(below, low + count)
    found: list[Expr] = []
    for k in range(count + 1):
        carried = Add(*(found[j] * bottom.get(low + k - j, Integer(0)) for j in range(k)))
        found.append(tidied((top.get(high + k, Integer(0)) - carried) / bottom[low]))
    return {first + k: c for k, c in enumerate(found) if c != 0}


def _taylor(f: Expr, up_to: int) -> tuple[dict[int, Expr], int]:
    """The nonzero Taylor coefficients by their powers, and the lowest of these powers. Raises `NoExpansion` if a
    coefficient is infinite or undefined, or if a derivative of an order above `HIGHEST` would be needed.

    The series ends at the power `up_to`, or at the power of its first nonzero coefficient, if that power is higher.
    """
    found: dict[int, Expr] = {}
    derivative, factorial = f, Integer(1)
    for n in range(HIGHEST + 1):
        if n:
            derivative, factorial = diff(derivative, SMALL), factorial * n
        try:
            coefficient = tidied(derivative.subs(SMALL, 0)) / factorial
        except (PolynomialError, ZeroDivisionError, ValueError):
            raise NoExpansion(f) from None
        if coefficient.has(*SPOILT):
            raise NoExpansion(f)
        if coefficient != 0:
            found[n] = coefficient
        if found and n >= up_to:
            return found, min(found)
        if derivative == 0:
            break
    if derivative != 0 and (not found or up_to > HIGHEST):
        raise NoExpansion(f)
    return found, min(found, default=0)
