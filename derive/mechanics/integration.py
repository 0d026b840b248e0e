"""Integrals over a box, worked the way a person writes them.

The integrand is a sum of products of powers and the limits are constants, so each term separates into three integrals
of one variable. The lines are: split, antiderivatives in brackets, their values, the products, the mass collected.
"""

from __future__ import annotations

from sympy import Expr, Integral, Mul, Symbol, integrate
from sympy.core import Add

from derive.expressions import Bracket, Factors, Group, Terms, explicit
from derive.step import Form, Level
from derive.tidy import tidied

OneVariable = tuple[Symbol, Expr, Expr]


def worked_integral(integral: Integral, rho: Symbol, volume: Expr) -> list[Form]:
    """The lines between rho times the integral and its value in terms of the mass, M = rho V."""
    limits = [tuple(limit) for limit in reversed(integral.limits)]
    terms = Add.make_args(integral.function)
    sign = -1 if len(terms) == 1 and terms[0].could_extract_minus_sign() else 1
    terms = [sign * term for term in terms]
    split = [_separated(term, limits) for term in terms]
    return [
        Form(
            _times(sign * rho, [Factors(*(Integral(f, limit) for f, limit in parts)) for parts in split]),
            "separate",
            Level.STANDARD,
        ),
        Form(_times(sign * rho, [_with_brackets(parts) for parts in split]), "antiderivative", Level.STANDARD),
        Form(_times(sign * rho, [_with_values(parts) for parts in split]), "limits", Level.FULL),
        Form(
            _times(sign * rho, [Mul(*(explicit(Integral(f, limit)) for f, limit in parts)) for parts in split]),
            "multiplied",
            Level.STANDARD,
        ),
        *_mass_collected(integral, sign, rho, volume),
    ]


def _separated(term: Expr, limits: list[OneVariable]) -> list[tuple[Expr, OneVariable]]:
    """Each variable's own factor of the term; a number goes with the first variable that occurs."""
    number, rest = term.as_coeff_Mul()
    factors = [(Mul(*(f for f in Mul.make_args(rest) if f.has(limit[0]))), limit) for limit in limits]
    if number != 1:
        first = next((i for i, (f, limit) in enumerate(factors) if f.has(limit[0])), 0)
        factors[first] = (number * factors[first][0], factors[first][1])
    return factors


def _times(rho: Expr, terms: list[Expr]) -> Expr:
    return Factors(rho, *_flat(terms[0])) if len(terms) == 1 else Factors(rho, Terms(*terms))


def _flat(term: Expr) -> tuple[Expr, ...]:
    return term.args if isinstance(term, Factors) else (term,)


def _with_brackets(parts: list[tuple[Expr, OneVariable]]) -> Expr:
    """Lengths of the plain integrals first, then the antiderivatives between their limits."""
    plain = [upper - lower for f, (_, lower, upper) in parts if f == 1]
    brackets = [Bracket(integrate(f, x), x, lower, upper) for f, (x, lower, upper) in parts if f != 1]
    return Factors(*plain, *brackets)


def _with_values(parts: list[tuple[Expr, OneVariable]]) -> Expr:
    plain = [upper - lower for f, (_, lower, upper) in parts if f == 1]
    values = [explicit(Integral(f, limit)) for f, limit in parts if f != 1]
    return Factors(*plain, *values)


def _mass_collected(integral: Integral, sign: int, rho: Symbol, volume: Expr) -> list[Form]:
    """13/3 (6 a^3 rho) a^2: the density and the volume brought together, ready to become the mass."""
    value = tidied(integral)
    if value == 0:
        return []
    number, rest = tidied(value / volume).primitive()
    if rest.could_extract_minus_sign():
        number, rest = -number, -rest
    number_part = [number] if number != 1 else []
    return [
        *([Form(rho * value, "added", Level.FULL)] if isinstance(integral.function, Add) else []),
        Form(Factors(*number_part, Group(volume * rho), rest), "mass_collected", Level.STANDARD),
    ]
