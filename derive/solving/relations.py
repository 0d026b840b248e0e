"""Solve a relation, v > 0 or v = 0, for one symbol; find its possible values and the divisors that must not vanish."""

from __future__ import annotations

from typing import Any

from sympy import Expr, Mul, sqrt

from derive.algebra.expressions import Relation
from derive.algebra.ranges import strict_sign_within
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.solving.attainable import reached
from derive.solving.isolation import isolated
from derive.solving.presentation import presented
from derive.solving.unknowns import left_over, mark_for, unknown_of, with_unknown, without_factors_beside
from derive.steps.signs import sign_known
from derive.steps.step import Quantity

TURNED = {">": "<", ">=": "<=", "<": ">", "<=": ">=", "=": "=", "!=": "!="}


def solved_in_letters(of: Quantity, value: Expr, mark: str, letter: Any) -> Relation | None:
    """The relation between a value and zero, solved for a symbol; None if that is not possible without numbers."""
    try:
        alone, solved, turned = solved_for_unknown(of, tidied(value), mark, unknown_of("where", letter))
    except Rejected:
        return None
    return Relation(alone, turned, solved)


def conditions_told(**conditions: Relation | None) -> dict[str, tuple[Relation, Relation]]:
    """The conditions that the sentence states."""
    return {
        role: (each, Relation(tidied(each.left), each.operator, tidied(each.right)))
        for role, each in conditions.items()
        if each is not None
    }


def existence(of: Quantity, alone: Expr, mark: str, solved: Expr) -> Relation | None:
    """The condition under which a solution of an equation exists; an inequality holds or fails without one."""
    exists, never = reached(alone, solved) if mark == "=" else (None, False)
    if never:
        letters = ", ".join(sorted(s.name for s in alone.free_symbols))
        message = f"the condition on `{of.key}` requires {alone} = {solved}, but no value of {letters} gives this"
        raise Rejected(Complaint("no-condition", message))
    return exists


def number_of(of: Quantity) -> Expr:
    if not isinstance(of.value, Expr) or isinstance(of.value, Relation):
        raise Rejected(Complaint("wrong-argument", f"`{of.key}` is not a number, so it cannot be compared"))
    return of.value


def solved_for_unknown(of: Quantity, difference: Expr, mark: str, unknown: Expr) -> tuple[Expr, Expr, str]:
    """The left side, which is the unknown or its square; its bound, and the mark between them."""
    u = mark_for(unknown)
    written, beside = without_factors_beside(with_unknown(difference, unknown, u), unknown, u)
    if left_over(written, unknown):
        raise unsolvable(of, unknown)
    factors = Mul.make_args(written)
    core = Mul(*(f for f in factors if f.has(u) and strict_sign_within(f.xreplace({u: unknown})) != 1))
    outside = Mul(written / core, *beside).xreplace({u: unknown})
    found, below = isolated(core, u), core.as_numer_denom()[1]
    if found is None or found.power > 2 or below.has(u):
        raise unsolvable(of, unknown)
    divided = found.leading * outside / below
    rising = sign_known(divided)
    if not rising and mark not in ("=", "!="):
        raise unsolvable(of, unknown, _without_sign(divided))
    solved = presented(found.value)
    turned = mark if rising != -1 else TURNED[mark]
    if found.power == 1:
        return unknown, solved, turned
    if unknown.is_nonnegative and solved.is_nonnegative:
        return unknown, presented(sqrt(solved)), turned
    return unknown**2, solved, turned


def _without_sign(value: Expr) -> Expr | None:
    """The first factor whose sign is unknown."""
    return next((f for f in Mul.make_args(tidied(value)) if sign_known(f) is None), None)


def divided_out(difference: Expr, alone: Expr, solved: Expr) -> tuple[Expr, ...]:
    """The factor by which the two sides differ, made positive; empty if its sign is unknown."""
    slope = tidied(difference.diff(alone)) if alone.is_Symbol else alone
    factor = slope if slope != 0 and not slope.has(alone) else tidied(difference / (alone - solved))
    return {1: (factor,), -1: (-factor,)}.get(sign_known(factor) or 0, ())


def unsolvable(of: Quantity, unknown: Expr, factor: Expr | None = None) -> Rejected:
    if factor is not None:
        message = f"`{of.key}` cannot be solved for {unknown}: it would be divided by {factor}, whose sign is unknown"
        letters = ", ".join(sorted(f"`{s}`" for s in factor.free_symbols))
        help_line = f"declare the sign of {letters}: `positive` before the kind, or a range, `in (0, pi/2)`"
        return Rejected(Complaint("no-condition", message, help=help_line))
    message = f"`{of.key}` cannot be solved for {unknown}: it is not linear in {unknown}"
    return Rejected(Complaint("no-condition", message, help="give another symbol that it depends on"))
