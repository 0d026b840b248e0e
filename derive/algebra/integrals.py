"""Definite integrals of the few kinds that solids need, done exactly and at once.

    powers              x^q, 1/x among them
    with powers         x^n sin(m x), x^n cos(m x), x^n exp(m x), by parts
    sines and cosines   sin(m x), cos(n x) and their products, over any limits
    chords              y^m (w^2 - y^2)^(k/2) from -w to w: what a disc of radius w gives in Cartesian coordinates

SymPy's own integrator is slow for the first two and wrong or silent for the third. What is of no such kind gives
None. Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 4.3.127 and 6.2.1 (powers of sine and cosine).
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Add, Expr, Integer, Mul, Poly, Pow, Rational, Symbol, cos, exp, log, pi, sin
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR8

Limits = Sequence[tuple[Symbol, Expr, Expr]]
HALF = Rational(1, 2)
MOST_PARTS = 12  # the power beyond which nothing is integrated by parts


def definite(value: Expr, limits: Limits) -> Expr | None:
    """The integral of an explicit expression, limits innermost first, or None where a term is of no known kind."""
    for i, (x, lower, upper) in enumerate(limits):
        terms = [_term(term, x, lower, upper, limits[i + 1 :]) for term in Add.make_args(_prepared(value, x))]
        if any(term is None for term in terms):
            return None
        value = Add(*terms)
    return value.expand()


def antiderivative(value: Expr, x: Symbol) -> Expr | None:
    """A function whose derivative is the value, term by term; None where a term is of no known kind."""
    found = [_antiderivative_of_term(term, x) for term in Add.make_args(_prepared(value, x))]
    return None if any(term is None for term in found) else Add(*found)


def _prepared(value: Expr, x: Symbol) -> Expr:
    """A sum of terms; products of sines and cosines of x as sums of them."""
    value = value.expand()
    return TR8(value).expand() if any(f.has(x) for f in value.atoms(sin, cos)) else value


def _antiderivative_of_term(term: Expr, x: Symbol) -> Expr | None:
    outside, inside = term.as_independent(x, as_Add=False)
    if term == 0 or inside == 1:
        return term * x
    power = inside.as_coeff_exponent(x)
    if power[0] == 1 and power[1].is_Integer and power[1] >= 0:
        return outside * x ** (power[1] + 1) / (power[1] + 1)
    if isinstance(inside, sin | cos):
        rate = inside.args[0].diff(x)
        if rate != 0 and not rate.has(x):
            whole = -cos(inside.args[0]) if isinstance(inside, sin) else sin(inside.args[0])
            return outside * whole / rate
    if power[0] == 1 and power[1].is_Rational:
        return outside * (log(x) if power[1] == -1 else x ** (power[1] + 1) / (power[1] + 1))
    by_parts = _powers_by_parts(inside, x)
    return None if by_parts is None else outside * by_parts


def _powers_by_parts(inside: Expr, x: Symbol) -> Expr | None:
    """Of x^n f(m x + c), f a sine, a cosine or an exponential."""
    f, n = inside, 0
    for part in Mul.make_args(inside):
        base, exponent = part.as_base_exp()
        if base == x and exponent.is_Integer and exponent > 0:
            n, f = int(exponent), inside / part
    if not isinstance(f, sin | cos | exp) or n > MOST_PARTS:
        return None
    rate = f.args[0].diff(x)
    return None if rate == 0 or rate.has(x) else _by_parts(n, f, x, rate)


def _by_parts(n: int, f: Expr, x: Symbol, rate: Expr) -> Expr:
    """x^n F less the integral of n x^(n-1) F, F the antiderivative of f."""
    angle = f.args[0]
    sign, other = (-cos(angle) if isinstance(f, sin) else sin(angle) if isinstance(f, cos) else f).as_coeff_Mul()
    first = x**n * sign * other / rate
    return first if n == 0 else first - n * sign / rate * _by_parts(n - 1, other, x, rate)


def _term(term: Expr, x: Symbol, lower: Expr, upper: Expr, outer: Limits) -> Expr | None:
    found = _antiderivative_of_term(term, x)
    if found is not None:
        return found.subs(x, upper) - found.subs(x, lower)
    return _chord_integral(term, x, lower, upper, outer)


def _chord_integral(term: Expr, y: Symbol, lower: Expr, upper: Expr, outer: Limits) -> Expr | None:
    """y = w sin u turns the integral of y^m (w^2 - y^2)^(k/2) from -w to w into w^(m+k+1) times a number.

    This needs w >= 0, or the root is not w cos u: the outer limits must show it.
    """
    outside, inside = term.as_independent(y, as_Add=False)
    m, k = 0, 0
    for base, exponent in (factor.as_base_exp() for factor in Mul.make_args(inside)):
        if base == y and exponent.is_Integer and exponent > 0:
            m = int(exponent)
        elif (
            exponent.is_Rational
            and exponent.q == 2
            and exponent > 0
            and (base - upper**2 + y**2).expand() == 0
            and k == 0
        ):
            k = int(2 * exponent)
        else:
            return None
    if (lower + upper).expand() != 0 or not _nonnegative_within(upper, outer):
        return None
    return outside * upper ** (m + k + 1) * sine_and_cosine_integral(m, k + 1)


def sine_and_cosine_integral(m: int, n: int) -> Expr:
    """The integral of sin^m u cos^n u over half a turn, from -pi/2 to pi/2, by the recurrence of Wallis."""
    if m % 2:
        return Integer(0)
    if m:
        return Rational(m - 1, m + n) * sine_and_cosine_integral(m - 2, n)
    if n < 2:
        return pi if n == 0 else Integer(2)
    return Rational(n - 1, n) * sine_and_cosine_integral(0, n - 2)


def _nonnegative_within(w: Expr, outer: Limits) -> bool:
    """Whether w >= 0 between the limits: known of itself, or linear there and not negative at either end."""
    if w.is_nonnegative or isinstance(w, Pow) and w.exp == HALF:
        return True
    inside = [limit for limit in outer if w.has(limit[0])]
    if len(inside) != 1:
        return False
    z, *ends = inside[0]
    try:
        linear = Poly(w, z).degree() == 1
    except PolynomialError:
        return False
    return linear and all(w.subs(z, end).expand().is_nonnegative for end in ends)


def has_root(value: Expr) -> bool:
    """Whether a root of something that may vary occurs."""
    return any(power.exp.is_Rational and not power.exp.is_Integer and power.free_symbols for power in value.atoms(Pow))
