"""Solve a relation between a value v and zero, such as v > 0 or v = 0, for a symbol or another unknown."""

from __future__ import annotations

from math import prod
from typing import Any, NamedTuple

from sympy import Add, Expr, Integer, Mul, Pow, Symbol, expand, factor_list, sqrt

from derive.algebra.collect import LONGEST_PRODUCT, spread
from derive.algebra.expressions import Relation
from derive.algebra.length import length
from derive.algebra.relation import TURNED, sides_without_minus
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.solving.presentation import presented, without_positive
from derive.solving.unknowns import left_over, mark_for, unknown_of, with_unknown, without_factors_beside
from derive.steps.signs import DECIDES, sign_for_all, sign_known
from derive.steps.step import Quantity


class Isolated(NamedTuple):
    """An expression a (x^n - v): `value` is v, `power` is n and `factor` is a."""

    value: Expr
    power: int
    factor: Expr


def mark_between(mark: str, sign: int | None) -> str | None:
    """Turn the operator between a (x^n - v) and zero into the operator between x^n and v; `sign` is the sign of a.

    Return None if an inequality would be divided by a factor whose sign is unknown.
    """
    return mark if mark in ("=", "!=") else {1: mark, -1: TURNED[mark]}.get(sign or 0)


def isolated(expr: Expr, letter: Symbol) -> Isolated | None:
    """The expression in the form a (x^n - v); None if it does not have this form."""
    above, below = expr.as_numer_denom()
    polynomial = above.as_poly(letter)
    terms = polynomial.terms() if polynomial is not None else []
    if len(terms) not in (1, 2) or terms[0][0] == (0,) or terms[1:] and terms[1][0] != (0,):
        return None
    (((power,), leading), *others) = terms
    rest = others[0][1] if others else Integer(0)
    return Isolated(-rest / leading, int(power), leading / below)


def solved_for_letter(expr: Expr, letter: Symbol) -> Expr | None:
    """The value of a symbol at which the expression vanishes; None if this value is zero or is not found."""
    found = isolated(expr, letter)
    if found is None or found.value == 0 or found.power > (2 if letter.is_positive else 1):
        return None
    value = tidied(found.value)
    return value if found.power == 1 else tidied(sqrt(value))


def positive(value: Expr, letter: Symbol | None = None) -> Relation:
    """The condition v > 0 without positive factors, solved for the symbol if possible.

    letter   the symbol; by default the only symbol whose square occurs

    An unsolved difference of two terms becomes a relation between the terms, as in M g > k l.
    """
    above, below = tidied(value).as_numer_denom()
    core = expand(without_positive(above) * without_positive(below))  # a/b has the same sign as a b
    core = _without_sums_of_known_sign(core)
    chosen = [letter] if letter is not None else [s for s in sorted(core.free_symbols, key=str) if core.has(s**2)]
    if len(chosen) == 1 and (solved := _solved(core, chosen[0])) is not None:
        return solved
    more, less = sides_without_minus(core)
    if less == 0 or not (more == 0 or more.is_Add or less.is_Add):
        return Relation(spread(more), ">", spread(less))
    return Relation(_in_factors(core.as_content_primitive()[1]), ">", 0)


def _without_sums_of_known_sign(core: Expr) -> Expr:
    """Divide by the absolute values of the factors that are sums of known sign, such as g R + v^2."""
    if length(core) > LONGEST_PRODUCT or not core.is_polynomial():
        return core
    number, factors = factor_list(core)
    signs = {factor: sign_known(factor) for factor, _ in factors if isinstance(factor, Add)}
    known = {factor for factor, sign in signs.items() if sign in (1, -1)}
    if not known or len(known) == len(factors):
        return core
    turned = prod(sign**times for factor, times in factors if (sign := signs.get(factor)) in (1, -1))
    return expand(turned * number * Mul(*(factor**times for factor, times in factors if factor not in known)))


def _in_factors(core: Expr) -> Expr:
    """Factor the sum if it is a product of sums, such as (k - m w^2) (c - m w^2)."""
    if length(core) > LONGEST_PRODUCT or not core.is_polynomial():
        return tidied(core)
    number, factors = factor_list(core)
    sums = [(factor, times) for factor, times in factors if isinstance(factor, Add)]
    return tidied(core) if len(sums) < 2 else number * Mul(*(tidied(factor) ** times for factor, times in factors))


def _solved(core: Expr, letter: Symbol) -> Relation | None:
    found = isolated(core, letter)
    if found is None or found.value == 0 or found.power % 2 == 0 and found.power != 2:
        return None
    mark = mark_between(">", sign_for_all(found.factor))
    return Relation(letter**found.power, mark, spread(tidied(found.value))) if mark is not None else None


def border_of(condition: Relation) -> Relation | None:
    """The equation `symbol = value` at the boundary of the condition; None if no symbol can be isolated."""
    left, right = condition.sides
    if isinstance(left, Symbol):
        return Relation(left, "=", right)
    if isinstance(left, Pow) and left.exp == 2 and isinstance(left.base, Symbol) and right.is_positive:
        return Relation(left.base, "=", sqrt(right))
    for one, other in ((left, right), (right, left)):
        for s in sorted(one.free_symbols - other.free_symbols, key=str):
            if s.is_positive and one.as_poly(s) is not None and (one / s).cancel().has(s) is False:
                return Relation(s, "=", tidied(other * s / one))
    return None


# --- another unknown ---


def solved_in_letters(of: Quantity, value: Expr, mark: str, letter: Any) -> Relation | None:
    """The relation between a value and zero, solved for a symbol or another unknown; None if it cannot be solved."""
    try:
        return solved_for_unknown(of, tidied(value), mark, unknown_of("where", letter))
    except Rejected:
        return None


def conditions_told(**conditions: Relation | None) -> dict[str, tuple[Relation, Relation]]:
    """Return, by role, the conditions that a sentence states, each with its tidied form."""
    return {
        role: (each, Relation(tidied(each.left), each.operator, tidied(each.right)))
        for role, each in conditions.items()
        if each is not None
    }


def number_of(of: Quantity) -> Expr:
    if not isinstance(of.value, Expr) or isinstance(of.value, Relation):
        raise Rejected(Complaint("wrong-argument", f"`{of.key}` is not a number, so it cannot be compared"))
    return of.value


def solved_for_unknown(of: Quantity, difference: Expr, mark: str, unknown: Expr) -> Relation:
    """The relation between a difference and zero, solved for an unknown u. Rejects a difference that cannot be solved
    for u.

    If the difference contains u only as u^2, the relation is solved for u^2. If neither u nor the other side can be
    negative, the relation is then solved for u.
    """
    u = mark_for(unknown)
    written, beside = without_factors_beside(with_unknown(difference, unknown, u), unknown, u)
    if left_over(written, unknown):
        raise unsolvable(of, unknown)
    factors = Mul.make_args(written)
    core = Mul(*(f for f in factors if f.has(u) and sign_for_all(f.xreplace({u: unknown})) != 1))
    outside = Mul(written / core, *beside).xreplace({u: unknown})
    found = isolated(core, u)
    if found is None or found.power > 2 or found.factor.has(u):
        raise unsolvable(of, unknown, power=1 if found is None else found.power)
    turned = mark_between(mark, sign_known(found.factor * outside))
    if turned is None:
        raise unsolvable(of, unknown, _without_sign(found.factor * outside))
    solved = Relation(unknown**found.power, turned, presented(found.value))
    return without_square(solved) if found.power == 2 else solved


def without_square(condition: Relation) -> Relation:
    """Return x > sqrt(v) for x^2 > v if x and v are never negative, and the same for the other operators. Return any
    other condition unchanged."""
    left, right = condition.sides
    if not (left.is_Pow and left.exp == 2 and left.base.is_nonnegative and right.is_nonnegative):
        return condition
    return Relation(left.base, condition.operator, presented(sqrt(right)))


def _without_sign(value: Expr) -> Expr | None:
    """The first factor whose sign is unknown; None if all signs are known."""
    return next((f for f in Mul.make_args(tidied(value)) if sign_known(f) is None), None)


def divided_out(difference: Expr, alone: Expr, solved: Expr) -> tuple[Expr, ...]:
    """The absolute value of the factor difference/(alone - solved), as a tuple; empty if the sign of the factor is
    unknown."""
    slope = tidied(difference.diff(alone)) if alone.is_Symbol else alone
    factor = slope if slope != 0 and not slope.has(alone) else tidied(difference / (alone - solved))
    return {1: (factor,), -1: (-factor,)}.get(sign_known(factor) or 0, ())


class NotLinear(Rejected):
    """The error for a result that is linear neither in an unknown nor in a power of it."""


def unsolvable(of: Quantity, unknown: Expr, factor: Expr | None = None, power: int = 1) -> Rejected:
    if factor is not None:
        message = f"`{of.key}` cannot be solved for {unknown}: it would be divided by {factor}, whose sign is unknown"
        letters = ", ".join(sorted(f"`{s}`" for s in factor.free_symbols))
        help_line = f"declare the sign of {letters}: `positive` before the kind, or a range, `in (0, pi/2)`"
        more, less = sides_without_minus(factor)
        if more != 0 and less != 0 and all(sign_known(s) is not None for s in factor.free_symbols):
            help_line = f"{DECIDES} {less} < {more}"
        return Rejected(Complaint("no-condition", message, help=help_line))
    message = f"`{of.key}` cannot be solved for {unknown}: it is not linear in {unknown}"
    if power > 1:
        help_line = f"write `{unknown**power}` in place of `{unknown}`"
        return Rejected(Complaint("no-condition", message, help=help_line))
    return NotLinear(
        Complaint(
            "no-condition",
            message,
            help="find its zeros with `roots`, or give another symbol on which this result depends",
        )
    )
