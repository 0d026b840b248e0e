"""Where a quantity is positive: an inequality, worked until one letter stands alone."""

from __future__ import annotations

from sympy import Abs, Dummy, Expr, Integer, Mul, Symbol, nan, sqrt

from derive.algebra.collect import spread
from derive.algebra.expressions import Relation, explicit
from derive.algebra.ranges import strict_sign_within
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.steps.establish import Lines, Telling, establish
from derive.steps.record import assumed
from derive.steps.step import Form, Level, Quantity, is_zero

__all__ = ["boundary_case", "positive_where"]

TURNED = {">": "<", ">=": "<="}
_WORDS = {1: ("always", ">"), -1: ("never", "<"), 0: ("vanishing", "=")}
TRUE_FOR = {"=": (0,), "!=": (1, -1), ">": (1,), "<": (-1,), ">=": (0, 1), "<=": (0, -1)}  # mark -> signs


def positive_where(of: Quantity, letter: Expr, or_zero: bool = False, key: str = "condition") -> Quantity:
    """Condition under which a quantity is positive, solved for one letter: v > 0 where R > a/2.

    of       a scalar, any unit
    letter   the letter to solve for: the quantity has one term with it, or with its square, and others without
    or_zero  whether zero is allowed too
    Second route: whether the quantity is positive where the letter is a little above the bound, at it, and a little
    below, against what the solved relation says there.
    Outcomes: conditional; squared (solved for the square of the letter only, because the sign of its bound is not
    known); always, never, vanishing (these where the sign does not depend on the letters).
    Errors: the inequality cannot be solved for that letter.
    Source: none needed: algebra of inequalities.
    """
    value = tidied(of.value)
    if value == 0 or strict_sign_within(value) is not None:
        return _of_known_sign(of, value, key)
    mark = ">=" if or_zero else ">"
    sign, core = _of_unknown_sign(value)
    letter, (bound, power, rising) = _chosen(letter, core, of)
    turned = mark if (rising > 0) == (sign > 0) else TURNED[mark]
    core = spread(sign * core)
    steps = [Form(Relation(core, mark, 0), "positive_factors", Level.STANDARD)]
    has_root = power == 1 or bool(_is_positive(bound) and letter.is_positive)
    alone = letter if has_root else letter**2
    if power == 2 and has_root:
        steps.append(Form(Relation(letter**2, turned, tidied(bound**2)), "solved", Level.STANDARD))
    return establish(
        "conditions.positive_where",
        None,
        lambda v: Relation(v, mark, 0),
        {"quantity": of},
        lines=Lines(
            put_in=Level.STANDARD,
            between=steps,
            after=[Form(Relation(alone, turned, bound), "solved", nonzero=(value / core,))],
            result=False,
            arranged=lambda _: Relation(alone, turned, bound),
        ),
        routes={
            "above": lambda found: _truths_beside(found, value, or_zero, 1),
            "at": lambda found: _truths_beside(found, value, or_zero, 0),
            "below": lambda found: _truths_beside(found, value, or_zero, -1),
        },
        outcome="conditional" if has_root else "squared",
        telling=Telling(words={"strictly": "not_negative" if or_zero else "positive"}),
        key=key,
    )


def _of_known_sign(of: Quantity, value: Expr, key: str) -> Quantity:
    outcome, mark = _WORDS[strict_sign_within(value) or 0]
    return establish(
        "conditions.positive_where",
        None,
        lambda v: Relation(v, mark, 0),
        {"quantity": of},
        lines=Lines(put_in=Level.STANDARD if value != 0 else None, result=False, arranged=explicit),
        routes={"sign": lambda found: (found.residual, of_the_size(value, found.mark))},
        outcome=outcome,
        key=key,
    )


def of_the_size(value: Expr, mark: str) -> Expr:
    """What a difference must be if the mark is right: of the value's size, with the sign that the mark says."""
    return {"=": Integer(0), ">": Abs(value), "<": -Abs(value)}.get(mark, nan)


def _of_unknown_sign(value: Expr) -> tuple[int, Expr]:
    """The sign of the factors whose sign is known, and the product of those that decide."""
    sign, open_factors = 1, []
    for factor in Mul.make_args(value):
        known = strict_sign_within(factor)
        if known is None:
            open_factors.append(factor)
        else:
            sign *= known
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
    rising = strict_sign_within(leading) or 0
    bound = tidied(-rest / leading)
    if not rising or (powers[0] == 1 and letter.is_positive and not _is_positive(bound)):
        return None
    if powers[0] == 2 and _is_positive(bound) and letter.is_positive:
        bound = tidied(sqrt(bound))
    return (spread(bound) if powers[0] == 1 else bound), powers[0], rising


def _is_positive(value: Expr) -> bool:
    return strict_sign_within(value) == 1


def _unsolvable(of: Quantity, letter: Expr) -> Rejected:
    message = f"where `{of.key}` is positive cannot be told from {letter} alone"
    return Rejected(Complaint("no-condition", message, help="give another of the letters it depends on"))


def _truths_beside(found: Relation, value: Expr, or_zero: bool, side: int) -> tuple[Expr, Expr]:
    """Whether the solved relation is true beside its bound, and whether the quantity is positive there, or zero."""
    alone, bound = found.sides
    letter = alone.base if alone.is_Pow else alone
    there = sqrt(_beside(bound, side, alone.is_Pow)) if alone.is_Pow else _beside(bound, side, False)
    sign = sign_by_factors(tidied(value.subs(letter, there)))
    as_wanted = nan if sign is None else Integer(int(sign > 0 or (or_zero and sign == 0)))
    return truth(found.mark, tidied(explicit(alone.subs(letter, there) - bound))), as_wanted


def _beside(bound: Expr, side: int, of_square: bool) -> Expr:
    """A little beside a bound: by a factor where it is positive, so that no sign is passed; else by an amount."""
    little = Dummy("u", positive=True)
    if _is_positive(bound) and not of_square:
        return bound * (1 + little) ** side
    return bound + side * little


def truth(mark: str, residual: Expr) -> Expr:
    """1 where a difference has the sign that the mark wants, 0 where not; undefined where it is not known."""
    sign = sign_by_factors(tidied(residual))
    return nan if sign is None else Integer(int(sign in TRUE_FOR[mark]))


def sign_by_factors(value: Expr) -> int | None:
    """The sign of a product by those of its factors, multiplied out where that shows it."""
    if is_zero(value):
        return 0
    found = 1
    for factor in Mul.make_args(value):
        base, power = factor.as_base_exp()
        forms = (factor, factor.expand()) if not power.is_Integer else (base**power, base.expand() ** power)
        if not any(form.is_positive or form.is_negative for form in forms):
            ranged = strict_sign_within(factor)
            if ranged is not None:
                found *= ranged
                continue
            if _is_square_that_lasts(base, power):
                continue
            return None
        found *= -1 if any(form.is_negative for form in forms) else 1
    return found


def _is_square_that_lasts(base: Expr, power: Expr) -> bool:
    """An even power of a real letter that stands below a fraction, or is assumed not to vanish."""
    lasts = power.is_negative or Relation(base, "!=", Integer(0)) in assumed()
    return bool(base.is_Symbol and base.is_real and power.is_even and lasts)


def boundary_case(condition: Quantity) -> Relation | None:
    """The letter of a condition at its bound, R = a/2; nothing where there is no bound."""
    relation = condition.value
    if not isinstance(relation, Relation) or not isinstance(relation.left, Symbol):
        return None
    return Relation(relation.left, "=", relation.right)
