"""Definite integrals of the few kinds that occur for solid bodies, evaluated exactly and fast.

    powers     x^q, including 1/x
    products   x^n sin(m x), x^n cos(m x), x^n exp(m x), by parts
    sines      sin(m x), cos(n x) and their products, over any limits
    chords     y^m (w^2 - y^2)^(k/2) from -w to w: integrals over a disc of radius w in Cartesian coordinates

SymPy's own integrator is slow for these kinds, and may give a wrong result or none for chords. Source: Abramowitz,
Stegun, *Handbook of Mathematical Functions*, 4.3.127 and 6.2.1 (powers of sine and cosine).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from sympy import Add, Expr, Integer, Mul, Poly, Pow, Rational, Symbol, cos, exp, log, pi, sin
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR8

Limits = Sequence[tuple[Symbol, Expr, Expr]]
HALF = Rational(1, 2)
MOST_PARTS = 12  # the highest n for which x^n f(m x + c) is integrated by parts


def definite(value: Expr, limits: Limits) -> Expr | None:
    """The integral of an explicit expression; `limits` begins with the innermost limits. None if the methods of this
    module do not apply to a term."""
    return _definite(value, tuple(tuple(limit) for limit in limits))


@lru_cache(maxsize=1024)
def _definite(value: Expr, limits: Limits) -> Expr | None:
    for i, (x, lower, upper) in enumerate(limits):
        terms = [_term(outside, inside, x, lower, upper, limits[i + 1 :]) for outside, inside in _terms(value, x)]
        if any(term is None for term in terms):
            return None
        value = Add(*terms)
    return _expanded(value)


def antiderivative(value: Expr, x: Symbol) -> Expr | None:
    """An antiderivative of the value, found term by term; None if no antiderivative of a term is found."""
    found = [(outside, _antiderivative_of_factor(inside, x)) for outside, inside in _terms(value, x)]
    return None if any(whole is None for _, whole in found) else Add(*(outside * whole for outside, whole in found))


def _terms(value: Expr, x: Symbol) -> list[tuple[Expr, Expr]]:
    """The terms of the value, each split into a factor without x and a factor with x."""
    found = []
    for term in Add.make_args(_expanded(value)):
        outside, inside = _apart(term, x)
        if any(f.has(x) for f in inside.atoms(sin, cos)) and _odd_powers(inside, x) is None:
            parts = (_apart(part, x) for part in Add.make_args(_by_sums(inside)))
            found += [(outside * more, part) for more, part in parts]
        else:
            found.append((outside, inside))
    return found


@lru_cache(maxsize=1024)
def _by_sums(product: Expr) -> Expr:
    return TR8(product).expand()


def _expanded(value: Expr) -> Expr:
    return value if all(map(_is_product, Add.make_args(value))) else value.expand()


def _is_product(term: Expr) -> bool:
    factors = (factor.as_base_exp() for factor in Mul.make_args(term))
    return all(
        (base.is_Atom or isinstance(base, sin | cos) and base.args[0].is_Atom) and exponent.is_Number
        for base, exponent in factors
    )


def _apart(term: Expr, x: Symbol) -> tuple[Expr, Expr]:
    factors: tuple[list[Expr], list[Expr]] = [], []
    for factor in Mul.make_args(term):
        factors[factor.has(x)].append(factor)
    return Mul(*factors[False]), Mul(*factors[True])


@lru_cache(maxsize=1024)
def _antiderivative_of_factor(inside: Expr, x: Symbol) -> Expr | None:
    if inside in (0, 1):
        return inside * x
    power = inside.as_coeff_exponent(x)
    if power[0] == 1 and power[1].is_Integer and power[1] >= 0:
        return x ** (power[1] + 1) / (power[1] + 1)
    if isinstance(inside, sin | cos):
        rate = inside.args[0].diff(x)
        if rate != 0 and not rate.has(x):
            whole = -cos(inside.args[0]) if isinstance(inside, sin) else sin(inside.args[0])
            return whole / rate
    if (odd := _odd_powers(inside, x)) is not None:
        return odd
    if power[0] == 1 and power[1].is_Rational:
        return log(x) if power[1] == -1 else x ** (power[1] + 1) / (power[1] + 1)
    return _powers_by_parts(inside, x)


@lru_cache(maxsize=1024)
def _odd_powers(inside: Expr, x: Symbol) -> Expr | None:
    """The antiderivative of sin^p(u) cos^q(u), with u linear in x, if p or q is odd. It is found by a substitution,
    such as c = cos u in sin^3 u = (1 - cos^2 u) sin u. None for any other product, and for a single sine or cosine."""
    powers = dict(factor.as_base_exp() for factor in Mul.make_args(inside))
    angle = next((f.args[0] for f in powers if isinstance(f, sin | cos)), None)
    if angle is None or powers.keys() - {sin(angle), cos(angle)}:
        return None
    p, q = (powers.get(f(angle), Integer(0)) for f in (sin, cos))
    rate = angle.diff(x)
    if any(not n.is_Integer or n < 0 for n in (p, q)) or p + q < 2 or rate == 0 or rate.has(x):
        return None
    if q % 2 and (q <= p or p % 2 == 0):
        return _of_powers(sin(angle), p, (q - 1) // 2) / rate
    return -_of_powers(cos(angle), q, (p - 1) // 2) / rate if p % 2 else None


def _of_powers(c: Expr, n: Integer, half: Integer) -> Expr:
    """The antiderivative of c^n (1 - c^2)^half as a polynomial in c."""
    u = Symbol("u")
    return Poly(u**n * (1 - u**2) ** half, u).integrate().as_expr().subs(u, c)


def _powers_by_parts(inside: Expr, x: Symbol) -> Expr | None:
    """The antiderivative of x^n f(m x + c), where f is a sine, a cosine or an exponential and n is at most
    `MOST_PARTS`; None for any other product."""
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
    """x^n F minus the integral of n x^(n-1) F, where F is the antiderivative of f."""
    angle = f.args[0]
    sign, other = (-cos(angle) if isinstance(f, sin) else sin(angle) if isinstance(f, cos) else f).as_coeff_Mul()
    first = x**n * sign * other / rate
    return first if n == 0 else first - n * sign / rate * _by_parts(n - 1, other, x, rate)


def _term(outside: Expr, inside: Expr, x: Symbol, lower: Expr, upper: Expr, outer: Limits) -> Expr | None:
    found = _antiderivative_of_factor(inside, x)
    if found is not None:
        return outside * (found.xreplace({x: upper}) - found.xreplace({x: lower}))
    return _chord_integral(outside, inside, x, lower, upper, outer)


def _chord_integral(outside: Expr, inside: Expr, y: Symbol, lower: Expr, upper: Expr, outer: Limits) -> Expr | None:
    """The integral of y^m (w^2 - y^2)^(k/2) from -w to w: the substitution y = w sin u gives w^(m+k+1) times a number.
    None for any other integral.

    The result is also None if w may be negative, because the root is w cos u only for w >= 0.
    """
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
    """Whether it is known that w >= 0 between the limits.

    A function w that is linear in one variable of integration must be non-negative at both limits of this variable.
    """
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
    """Whether the value contains a root of an expression with symbols."""
    return any(power.exp.is_Rational and not power.exp.is_Integer and power.free_symbols for power in value.atoms(Pow))
