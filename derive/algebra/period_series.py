"""The period of an oscillation between turning points at -A and A, in powers of the amplitude A.

    period = 4 times the integral of dq/sqrt(f) from 0 to A

Here f(q) is the square of the rate of q. It is an even function of q, and it vanishes at A. With q = A sin u the zero
of f cancels: f/(A cos u)^2 is a power series in A whose coefficients are polynomials in sines and cosines. Source:
Landau, Lifshitz, *Mechanics*, section 11 (the period by energy; the pendulum is problem 1).
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from sympy import Add, Dummy, Expr, Integer, Mul, Rational, Symbol, cos, lambdify, nan, sin, sqrt
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR5

from derive.algebra.dimensions import Dimension, power, quotient
from derive.algebra.expansion import HIGHEST, SPOILT, NoExpansion
from derive.algebra.integrals import sine_and_cosine_integral
from derive.algebra.node import DimensionOf, ScalarNode, TextOf, explicit
from derive.algebra.taylor import NoSeries, taylor
from derive.algebra.tidy import tidied

ANGLE = Dummy("u", real=True)
DIGITS = 30  # digits of the numerical integral
MOST_VALUES = 2**13


class SwingTime(ScalarNode):
    """The integral of dq/sqrt(f) from 0 to A, as a series in A. Arguments: f, q, A, the highest power."""

    def doit(self, **hints: object) -> Expr:
        f, q, amplitude, order = self.args
        try:
            return quarter_swing(explicit(f), q, amplitude, int(order))
        except NoExpansion:
            return nan

    @property
    def variables(self) -> tuple[Expr, ...]:
        return (self.args[1],)

    def dimension(self, of: DimensionOf) -> Dimension | None:
        f, q, _, _ = self.args
        return quotient(of(q), power(of(f), Fraction(1, 2)))

    def lowered(self, text: TextOf) -> str:
        f, q, amplitude, _ = self.args
        return f"Integral(1/sqrt({text(f, (q,))}), ({text(q, (q,))}, 0, {text(amplitude)}))"


class SwingTimeOfNumbers(ScalarNode):
    """A `SwingTime` integral with numbers for its symbols. Arguments: the `SwingTime`, the symbols, the numbers."""

    def doit(self, **hints: object) -> Expr:
        swing, letters, amounts = self.args
        f, q, amplitude, _ = swing.args
        numbers = {letter: explicit(amount) for letter, amount in zip(letters, amounts, strict=True)}
        time = half_swing(f.xreplace(numbers), q, amplitude.xreplace(numbers), DIGITS)
        return nan if time is None else time / 2

    @property
    def variables(self) -> tuple[Expr, ...]:
        return (self.args[0].args[1],)

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return of(self.args[0])

    def lowered(self, text: TextOf) -> str:
        swing, letters, amounts = self.args
        return text(swing.xreplace({letter: explicit(a) for letter, a in zip(letters, amounts, strict=True)}))


def half_swing(f: Expr, q: Symbol, amplitude: Expr, digits: int) -> Rational | None:
    """The numerical integral of dq/sqrt(f) from -A to A; None if f is not positive between -A and A, or if the result
    does not converge.

    With q = A sin u, the integrand 1/sqrt(f/(A cos u)^2) is periodic and has the same value at u and pi - u. So the
    mean of equidistant values converges fast.
    Source: Trefethen, Weideman, *SIAM Review* 56 (2014), section 3.
    """
    from mpmath import mp

    with mp.workdps(digits + 15):
        square = lambdify(q, f, "mpmath")
        a = mp.mpf(amplitude.evalf(mp.dps))

        def integrand(part: Any) -> Any:
            u = mp.pi * (part - mp.mpf(1) / 2)
            there = square(a * mp.sin(u))
            return a * mp.cos(u) / mp.sqrt(there) if there > 0 else mp.nan

        before, count = None, 8
        while count <= MOST_VALUES:
            now = mp.pi * sum(integrand((k + mp.mpf(1) / 2) / count) for k in range(count)) / count
            if mp.isnan(now):
                return None
            if before is not None and abs(now - before) <= abs(now) * mp.mpf(10) ** -digits:
                return Rational(str(now))
            before, count = now, 2 * count
    return None


def is_isochronous(f: Expr, q: Symbol, amplitude: Symbol, squared_frequency: Expr) -> bool:
    """Whether it is shown that the swing with q_dot^2 = f has this squared angular frequency for every amplitude A.

    This is shown for f = w(q) (D(A) - D(q)), the form that conservation of energy gives. The coordinate S = sqrt(D(q))
    then satisfies S_dot^2 = w D'^2 (S(A)^2 - S^2)/(4 D), which is a simple harmonic oscillation if w D'^2/(4 D) is the
    constant omega^2.
    """
    height = tidied(f.subs(q, 0))  # D(A), if w(0) = 1 and D(0) = 0
    here = height.subs(amplitude, q)
    weight = -f.subs(amplitude, 0) / here
    separable = f - weight * (height - here)
    return bool(tidied(separable) == 0 and tidied(weight * here.diff(q) ** 2 - 4 * squared_frequency * here) == 0)


def quarter_swing(f: Expr, q: Symbol, amplitude: Symbol, order: int) -> Expr:
    """The integral of dq/sqrt(f) from 0 to A as a series in the amplitude A; `order` is the highest power. Raises
    `NoExpansion` if the series is not found."""
    inside = reduced_square(f, q, amplitude, order)
    (leading, *rest) = inside
    if leading.has(ANGLE) or leading == 0:
        raise NoExpansion(f)
    corrections = [TR5(tidied(c / leading).expand(), max=2 * HIGHEST).expand() for c in rest]
    terms = [_mean(term) * amplitude**k for k, term in enumerate(_inverse_root(corrections, order))]
    return tidied(1 / sqrt(leading)) * Add(*terms)


def reduced_square(f: Expr, q: Symbol, amplitude: Symbol, order: int) -> list[Expr]:
    """The coefficients of A^0, ..., A^order in f/(A cos u)^2 at q = A sin u. Raises `NoExpansion` if
    they are not found."""
    if order > HIGHEST - 2 or not tidied(f.subs(q, -q) - f) == 0 or not tidied(f.subs(q, amplitude)) == 0:
        raise NoExpansion(f)
    none = [Integer(0)] * (order + 1)
    try:
        powers = taylor(f, {q: (*none[:1], sin(ANGLE), *none), amplitude: (*none[:1], Integer(1), *none)}, order + 2)
    except NoSeries:
        raise NoExpansion(f) from None
    found = [TR5(power.expand(), max=2 * HIGHEST).expand() for power in powers]
    if any(c.has(*SPOILT) for c in found) or found[0] != 0 or found[1] != 0:
        raise NoExpansion(f)
    return [_divided(c, f) for c in found[2:]]


def _divided(coefficient: Expr, f: Expr) -> Expr:
    c = Dummy("c")
    written = coefficient.xreplace({cos(ANGLE): c})
    try:
        polynomial = written.as_poly(c)
    except PolynomialError:
        polynomial = None
    if written == 0:
        return Integer(0)
    if polynomial is None or written.has(ANGLE) or any(n < 2 for (n,) in polynomial.monoms()):
        raise NoExpansion(f)
    return Add(*(tidied(k) * cos(ANGLE) ** (n - 2) for (n,), k in polynomial.terms()))


def _inverse_root(corrections: list[Expr], order: int) -> list[Expr]:
    """The coefficients of (1 + sum of c_k A^k)^(-1/2), from y' (1 + e) = -(1/2) e' y, power by power."""
    found: list[Expr] = [Integer(1)]
    for n in range(1, order + 1):
        terms = [(Rational(-k, 2) - (n - k)) * corrections[k - 1] * found[n - k] for k in range(1, n + 1)]
        found.append((Add(*terms) / n).expand())
    return found


def _mean(term: Expr) -> Expr:
    """The integral over u from 0 to pi/2 of a polynomial in cos u."""
    total = Integer(0)
    for part in Add.make_args(term.expand()):
        outside, inside = part.as_independent(ANGLE, as_Add=False)
        base, n = inside.as_base_exp() if inside.has(ANGLE) else (cos(ANGLE), Integer(0))
        if base != cos(ANGLE) or not n.is_Integer:
            raise NoExpansion(term)
        total += Mul(outside, sine_and_cosine_integral(0, int(n))) / 2
    return tidied(total)
