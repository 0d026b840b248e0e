"""Where a quantity is positive: an inequality, worked until one letter stands alone."""

from __future__ import annotations

from sympy import Abs, Dummy, Expr, Integer, Mul, Symbol, sqrt

from derive.errors import Complaint, Rejected
from derive.expressions import Relation, explicit
from derive.mechanics.arrangement import spread
from derive.step import Form, Level, Quantity, establish
from derive.tidy import tidied

TURNED = {">": "<", ">=": "<="}


def positive_where(of: Quantity, letter: Expr, or_zero: bool = False, key: str = "condition") -> Quantity:
    """Condition under which a quantity is positive, solved for one letter: v > 0 where R > a/2.

    of       a scalar, any unit
    letter   the letter to solve for: the quantity has one term with it, or with its square, and others without
    or_zero  whether zero is allowed too
    Second route: the sign of the quantity where the letter is a little above the bound, and a little below.
    Outcomes: conditional; squared (solved for the square of the letter only, because the sign of its bound is not
    known); always, never, vanishing (these where the sign does not depend on the letters).
    Errors: the inequality cannot be solved for that letter.
    Source: none needed: algebra of inequalities.
    """
    value = tidied(of.value)
    if value == 0 or value.is_positive or value.is_negative:
        return _of_known_sign(of, value, key)
    mark = ">=" if or_zero else ">"
    sign, core = _of_unknown_sign(value)
    letter, (bound, power, rising) = _chosen(letter, core, of)
    turned = mark if (rising > 0) == (sign > 0) else TURNED[mark]
    core = spread(sign * core)
    steps = [Form(Relation(core, mark, 0), "positive_factors", Level.STANDARD)]
    has_root = power == 1 or bool(bound.is_positive)
    alone = letter if has_root else letter**2
    if power == 2 and has_root:
        steps.append(Form(Relation(letter**2, turned, tidied(bound**2)), "solved", Level.STANDARD))
    above = 1 if turned == mark else -1
    return establish(
        "conditions.positive_where",
        None,
        lambda v: Relation(v, mark, 0),
        {"quantity": of},
        put_in=Level.STANDARD,
        between=steps,
        after=[Form(Relation(alone, turned, bound), "solved")],
        show_result=False,
        routes={
            "above": lambda _: _with_its_sign(value, alone, bound, beyond=True, sign=above),
            "below": lambda _: _with_its_sign(value, alone, bound, beyond=False, sign=-above),
        },
        outcome="conditional" if has_root else "squared",
        words={"strictly": "not_negative" if or_zero else "positive"},
        key=key,
        context={"letter": letter, "bound": bound, "of": of} if has_root else {"of": of},
        arranged=lambda _: Relation(alone, turned, bound),
    )


def _of_known_sign(of: Quantity, value: Expr, key: str) -> Quantity:
    outcome, mark = ("vanishing", "=") if value == 0 else ("always", ">") if value.is_positive else ("never", "<")
    size = {"=": Integer(0), ">": Abs(value), "<": -Abs(value)}[mark]
    return establish(
        "conditions.positive_where",
        None,
        lambda v: Relation(v, mark, 0),
        {"quantity": of},
        put_in=Level.STANDARD if value != 0 else None,
        show_result=False,
        routes={"sign": lambda _: (value, size)},
        outcome=outcome,
        key=key,
        context={"of": of},
        arranged=explicit,
    )


def _of_unknown_sign(value: Expr) -> tuple[int, Expr]:
    """The sign of the factors whose sign is known, and the product of those that decide."""
    sign, open_factors = 1, []
    for factor in Mul.make_args(value):
        if factor.is_negative:
            sign = -sign
        elif not factor.is_positive:
            open_factors.append(factor)
    return sign, Mul(*open_factors)


def _chosen(letter: Expr, core: Expr, of: Quantity) -> tuple[Symbol, tuple[Expr, int, int]]:
    """The letter itself, or the first one that will do of what was given for it, b of 2b for R; and its bound."""
    for symbol in sorted(letter.free_symbols & core.free_symbols, key=str):
        bound = _bound(core, symbol)
        if bound:
            return symbol, bound
    raise _unsolvable(of, letter)


def _bound(core: Expr, letter: Symbol) -> tuple[Expr, int, int] | None:
    """Where the core vanishes, the power of the letter, and whether the core rises (1) or falls (-1) with it.

    Of a square whose sign is not known, no root is taken.
    """
    polynomial = core.as_poly(letter)
    powers = [n for (n,), _ in polynomial.terms()] if polynomial else []
    if powers not in ([1, 0], [2, 0]):
        return None
    leading, rest = polynomial.all_coeffs()[0], polynomial.all_coeffs()[-1]
    rising = 1 if leading.is_positive else -1 if leading.is_negative else 0
    bound = tidied(-rest / leading)
    if not rising or (powers[0] == 1 and not bound.is_positive):
        return None
    if powers[0] == 2 and bound.is_positive:
        bound = tidied(sqrt(bound))
    return (spread(bound) if powers[0] == 1 else bound), powers[0], rising


def _unsolvable(of: Quantity, letter: Expr) -> Rejected:
    message = f"where `{of.key}` is positive cannot be told from {letter} alone"
    return Rejected(Complaint("no-condition", message, help="give another of the letters it depends on"))


def _with_its_sign(value: Expr, alone: Expr, bound: Expr, beyond: bool, sign: int) -> tuple[Expr, Expr]:
    """The value beside its bound, and its size with the sign that it should have."""
    little = Dummy("u", positive=True)
    if alone.is_Symbol:
        beside = bound * (1 + little) ** (1 if beyond else -1)
    else:  # S^2 a little beside its bound
        alone, beside = alone.base, sqrt(bound + (little if beyond else -little))
    there = tidied(value.subs(alone, beside))
    return there, sign * Abs(there)


def boundary_case(condition: Quantity) -> Relation | None:
    """The letter of a condition at its bound, R = a/2; nothing where there is no bound."""
    if "letter" not in condition.context:
        return None
    return Relation(condition.context["letter"], "=", condition.context["bound"])
