"""Isolate a letter that an expression holds in one power alone: x^n = -b/a of a x^n + b."""

from __future__ import annotations

from typing import NamedTuple

from sympy import Expr, Integer, Symbol, sqrt

from derive.algebra.tidy import tidied


class Isolated(NamedTuple):
    """The value of x^n where a x^n + b vanishes, n, and a, of whose sign the expression is above that value."""

    value: Expr
    power: int
    leading: Expr


def isolated(expr: Expr, letter: Symbol) -> Isolated | None:
    """Return what x^n is where the expression vanishes; None where its numerator is not of the form a x^n + b."""
    polynomial = expr.as_numer_denom()[0].as_poly(letter)
    terms = polynomial.terms() if polynomial is not None else []
    if len(terms) not in (1, 2) or terms[0][0] == (0,) or terms[1:] and terms[1][0] != (0,):
        return None
    (((power,), leading), *others) = terms
    rest = others[0][1] if others else Integer(0)
    return Isolated(-rest / leading, int(power), leading)


def solved_for_letter(expr: Expr, letter: Symbol) -> Expr | None:
    """Return the value of a letter at which the expression vanishes, if that is one value other than zero.

    The letter occurs in the first power alone, or in the second if it is positive.
    """
    found = isolated(expr, letter)
    if found is None or found.value == 0 or found.power > (2 if letter.is_positive else 1):
        return None
    value = tidied(found.value)
    return value if found.power == 1 else tidied(sqrt(value))
