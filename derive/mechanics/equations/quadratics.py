"""Quadratic equations of motion at rest: their discriminant, the roots as one formula, and each of them.

An equation a x^2 + b x + c = 0 may be a general one in letters; the values that the letters have here are put in
after the formula, so that the page shows both. Where a is zero the equation is linear and has one root.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, Integer, Mul, Symbol, resultant, sqrt

from derive.algebra.expressions import PLUS_MINUS, Factors, Ratio, Relation, Root, Terms, bound, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.steps.establish import Lines, Telling, establish
from derive.steps.known_numbers import sign_known
from derive.steps.step import Fact, Quantity

__all__ = ["discriminant", "roots_of"]

FOUR = Integer(4)


@dataclass(frozen=True)
class Quadratic:
    """The coefficients of a x^2 + b x + c."""

    a: Expr
    b: Expr
    c: Expr

    def with_values(self, values: dict[Any, Any]) -> Quadratic:
        return Quadratic(*(tidied(bound(each, values)) for each in (self.a, self.b, self.c)))

    def at(self, x: Expr) -> Expr:
        return self.a * x**2 + self.b * x + self.c

    @property
    def is_linear(self) -> bool:
        return bool(self.a == 0)

    @property
    def discriminant(self) -> Expr:
        return self.b**2 - FOUR * self.a * self.c


def coefficients_of(equation: Quantity, x: Symbol) -> Quadratic:
    """Those of a relation that is quadratic in x, or linear; the first without a minus sign."""
    polynomial = equation.value.residual.as_poly(x) if isinstance(equation.value, Relation) else None
    if polynomial is None or polynomial.degree() not in (1, 2):
        message = f"`{equation.key}` is not a linear or quadratic equation in {x.name}"
        raise Rejected(Complaint("not-quadratic", message))
    turn = -1 if polynomial.LC().could_extract_minus_sign() else 1
    missing = [Integer(0)] * (2 - polynomial.degree())
    return Quadratic(*(turn * each for each in (*missing, *polynomial.all_coeffs())))


@dataclass(frozen=True)
class Roots(Fact):
    """The quadratic equation that roots are those of: in letters, with values put in, its unknown, these values."""

    missing = "is not the roots of a quadratic equation"
    general: Quadratic
    quadratic: Quadratic
    unknown: Symbol
    values: tuple[Quantity, ...]


def _put_in(values: Sequence[Quantity]) -> dict[Any, Any]:
    return {q.symbol: q.value for q in values}


def discriminant(roots: Quantity, symbol: str = "Delta", key: str = "discriminant") -> Quantity:
    """Discriminant of a quadratic equation, Delta = b^2 - 4 a c: the roots are real where it is not negative.

    roots   as `roots_of` yields them
    Second route: the resultant of a x^2 + b x + c and its derivative, which is -a Delta.
    Outcomes: positive, negative, vanishing, conditional (not known from the letters).
    Errors: the equation is linear.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    of = roots.needed(Roots)
    general, here, values, x = of.general, of.quadratic, of.values, of.unknown
    if here.is_linear:
        raise Rejected(Complaint("not-quadratic", f"`{roots.key}` has the root of a linear equation"))

    def by_resultant(found: Expr) -> tuple[Expr, Expr]:
        return -here.a * found, resultant(here.at(x), 2 * here.a * x + here.b, x)

    return establish(
        "quadratics.discriminant",
        scalar(symbol),
        lambda *those: _with_those(_of_terms(general), values, those),
        {q.key: q for q in values},
        routes={"resultant": by_resultant},
        outcome=lambda found: _SIGNS[sign_known(found)],
        key=key,
        parents=[roots],
    )


def _with_those(expr: Expr, values: Sequence[Quantity], those: Sequence[Any]) -> Expr:
    """The formula with names or with values for the letters of some quantities."""
    return bound(expr, dict(zip((q.symbol for q in values), those, strict=True)))


_SIGNS = {1: "positive", -1: "negative", 0: "vanishing", None: "conditional"}


def _of_terms(of: Quadratic) -> Expr:
    return Terms(of.b**2, -FOUR * of.a * of.c)


def roots_of(
    equation: Quantity,
    x: Symbol,
    *values: Quantity,
    key: str = "roots",
    kind: str | None = None,
    one_stands_for: Sequence[str] = (),
) -> Quantity:
    """Roots of a quadratic equation, x = (-b +- sqrt(b^2 - 4 a c))/(2 a); x = -c/b where a is zero.

    equation   a x^2 + b x + c = 0
    x          the unknown
    values     what letters of the coefficients stand for here
    kind       what kind of quantity x is
    one_stands_for   keys of answers that this step gives where there is only one root
    Second route: put back into the equation; the sum of the two is -b/a.
    Outcomes: two, none, double, conditional (by the sign of b^2 - 4 a c), opposite (two, one of each sign), linear.
    Errors: the equation is not quadratic in x, or a and b both vanish.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    general = coefficients_of(equation, x)
    here = general.with_values(_put_in(values))
    if here.a == 0 and here.b == 0:
        raise Rejected(Complaint("no-roots", f"`{equation.key}` does not depend on {x.name} here"))
    linear = here.is_linear
    excluded = _may_vanish(here.a)
    formula = _linear_formula(general) if linear else _formula(general)
    outcome = "linear" if linear else character(here)

    def sum_of_both(found: Expr) -> tuple[Expr, Expr]:
        if linear:
            return found, -here.c / here.b
        return found + found.xreplace({PLUS_MINUS: -PLUS_MINUS}), -here.b / here.a

    return establish(
        "quadratics.roots_of",
        x,
        lambda _, __, *those: _with_those(formula, values, those),
        {"equation": equation, "unknown": x, **{q.key: q for q in values}},
        routes={"put_back": lambda found: (here.at(found), Integer(0)), "sum": sum_of_both},
        outcome=outcome,
        telling=Telling(
            judged_by={"quadratic": here},
            formulas={"excluded": (excluded, Relation(tidied(excluded.left), "!=", 0))} if excluded else {},
            stands_for=one_stands_for if linear else (),
        ),
        lines=Lines(arranged=lambda found: tidied(found) if linear else _arranged(here, found)),
        key=key,
        facts=[Roots(general, here, x, values)],
        kind=kind,
    )


def _may_vanish(leading: Expr) -> Relation | None:
    """What must not vanish for the equation to be quadratic: factors of a that nothing decides."""
    unsure = [f.as_base_exp()[0] for f in Mul.make_args(leading) if sign_known(f) is None]
    unsure = [f for f in unsure if not f.is_nonzero]
    return Relation(Mul(*unsure), "!=", 0) if unsure else None


def character(of: Quadratic) -> str:
    """What the roots are like: told by the discriminant and by the sign of their product."""
    sign = sign_known(of.discriminant)
    if sign == 1:
        return "opposite" if sign_known(of.a * of.c) == -1 else "two"
    return "conditional" if sign is None else {-1: "none", 0: "double"}[sign]


def _linear_formula(of: Quadratic) -> Expr:
    """-c/b, with as few minus signs as it needs."""
    return Ratio(of.c, -of.b) if of.b.could_extract_minus_sign() else Ratio(-of.c, of.b)


def _formula(of: Quadratic) -> Expr:
    return Ratio(Terms(-of.b, Factors(PLUS_MINUS, Root(_of_terms(of)))), 2 * of.a)


def _arranged(of: Quadratic, found: Expr) -> Expr:
    """k (u +- sqrt(u^2 - w)), where u is what the coefficient b alone has: S, not m a^2 S."""
    own = [
        f
        for f in Mul.make_args(-of.b)
        if f.free_symbols and not (of.a.has(*f.free_symbols) or of.c.has(*f.free_symbols))
    ]
    u = Mul(*own)
    outside = tidied(-of.b / u)
    if sign_known(outside) == -1:
        u, outside = -u, -outside
    if sign_known(outside) != 1:
        return tidied(found)
    k = tidied(outside / (2 * of.a))
    inside = Add(*(tidied(term) for term in (u**2, -FOUR * of.a * of.c / outside**2)))
    both = Add(u, PLUS_MINUS * sqrt(inside), evaluate=False)
    return Mul(*Mul.make_args(k), both, evaluate=False) if k != 1 else both
