"""What must be true for each word that chooses a sentence about steady motions."""

from __future__ import annotations

from sympy import Expr, Integer, Rational, Symbol, prime

from derive.algebra.expressions import rate
from derive.algebra.ranges import range_of
from derive.steps.known_numbers import with_numbers
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _number(letter: Symbol, n: int, shift: int) -> Expr:
    """One large where another is small; within the range of the letter where it has one."""
    if (known := range_of(letter)) is not None:
        return known.at(Rational(1 + (3 * n + 5 * shift) % 7, 8))
    return Rational(prime(2 + (11 * n + 5 * shift + n * shift) % 29), 7 + n)


def _signs(facts: Judged) -> set[int]:
    """For the numbers that are given, or some in place of the letters that let the state exist."""
    result, exists = with_numbers(facts.result), facts.inputs.get("exists")
    condition = with_numbers(exists.residual) * (1 if exists.mark == ">" else -1) if exists is not None else Integer(1)
    letters = sorted(result.free_symbols | condition.free_symbols, key=str)
    found = set()
    for shift in range(24):
        numbers = {s: _number(s, i, shift) for i, s in enumerate(letters)}
        if condition.xreplace(numbers).evalf(30) > 0:
            found.add(1 if result.xreplace(numbers).evalf(30) > 0 else -1)
    return found


def _always(sign: int) -> Predicate:
    return lambda facts: not is_zero(facts.result) and _signs(facts) == {sign}


def _nothing_else_moves(facts: Judged) -> bool:
    """Of an equation of motion is left what holds no acceleration, and not the rate of its own coordinate."""
    q = facts.inputs["coordinate"]
    moving = {s for s in facts.result.free_symbols if s.name.endswith("_ddot")} | {rate(q)}
    return not is_zero(facts.result.residual) and not moving & facts.result.free_symbols


_TABLE: dict[str, dict[str, Predicate]] = {
    "steady.motion": {
        "generic": lambda facts: not is_zero(facts.result.residual),
        "always": lambda facts: is_zero(facts.result.residual),
        "of_equation": _nothing_else_moves,
    },
    "steady.frequency_squared": {
        "stable": _always(1),
        "unstable": _always(-1),
        "neutral": lambda facts: is_zero(facts.result),
        "conditional": lambda facts: not is_zero(facts.result),
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
