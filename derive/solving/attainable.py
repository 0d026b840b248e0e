"""The values that are possible for a symbol with a range, and for a sine or a cosine."""

from __future__ import annotations

from itertools import islice

from sympy import Expr, Pow, Rational, Symbol, cos, sin

from derive.algebra.expressions import Relation
from derive.algebra.ranges import Range, ends_within, range_of
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.solving.relations import positive
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity

DRAWN = 24  # greatest number of sets of numbers that are drawn for the symbols
LITTLE = Rational(1, 10**12)


def within_one(value: Expr) -> tuple[Relation | None, bool]:
    """The condition for -1 < v < 1, and whether v is known to violate it. The condition is None if its truth is
    known."""
    sign = sign_for_all(value)
    value = _without_higher_root(value) if sign == 1 else value
    room = tidied(1 - value) if sign == 1 else tidied(1 + value) if sign == -1 else tidied(1 - value**2)
    known = sign_for_all(room)
    if known is not None:
        return None, known != 1
    return positive(room), False


def _without_higher_root(value: Expr) -> Expr:
    """Return v^n in place of a positive v with nth roots, n > 2: v^n is less than 1 if and only if v is."""
    roots = [int(power.exp.q) for power in value.atoms(Pow) if power.exp.is_Rational]
    n = max(roots, default=1)
    return tidied(value**n) if n > 2 else value


def reached(unknown: Expr, value: Expr) -> tuple[Relation | None, bool]:
    """The condition under which an unknown can have the value, and whether this is known to be impossible.

    A sine or cosine is between -1 and 1, and the value of a symbol is in the range of this symbol. The condition is
    None if the unknown is not a sine or cosine, or if the truth of the condition is known.
    """
    exists, never = (None, False)
    if isinstance(unknown, sin | cos) and value not in (1, -1):
        exists, never = within_one(value)
    return exists, never or is_out_of_range(unknown, value)


def is_out_of_range(unknown: Expr, value: Expr) -> bool:
    """Whether the value is known to be outside the possible values of the unknown."""
    ends = ends_within(unknown)
    beyond = (value - ends[1], ends[0] - value) if ends else ()
    return any(end.is_finite is not False and sign_for_all(tidied(end)) in (0, 1) for end in beyond)


def lies_within(letter: Symbol, value: Expr, exists: Relation | None) -> bool | None:
    """Whether a value is in the range of a symbol, tested with numbers that satisfy the condition `exists`.

    None if different numbers give different results, or if no numbers can be tested. A symbol without a range may have
    any value.
    """
    known, seen = range_of(letter), set()
    if known is None:
        return True
    condition = [] if exists is None else [exists]
    letters = letters_of(value).union(*(letters_of(each.residual) for each in condition))
    for point in islice(points(letters, seed_of(value)), DRAWN if letters else 1):
        try:
            if any(bool(value_at(each.residual, point) > 0) != (each.operator == ">") for each in condition):
                continue
            seen.add(_is_inside(value_at(value, point), known))
        except (Undefined, NoNumber, TypeError):
            continue
    return seen.pop() if len(seen) == 1 else None


def _is_inside(number: Expr, known: Range) -> bool:
    ends = number - known.least, known.greatest - number
    return all(
        bool(abs(end) < LITTLE and closed or end > LITTLE) for end, closed in zip(ends, known.closed, strict=True)
    )


def existence(of: Quantity, solution: Relation) -> Relation | None:
    """The condition under which the solution of an equation exists; None if there is no such condition, and for an
    inequality. Rejects an equation whose solution is known never to exist."""
    alone, solved = solution.sides
    exists, never = reached(alone, solved) if solution.operator == "=" else (None, False)
    if never:
        letters = ", ".join(sorted(s.name for s in alone.free_symbols))
        message = f"the condition on `{of.key}` requires {alone} = {solved}, but no value of {letters} gives this"
        raise Rejected(Complaint("no-condition", message))
    return exists
