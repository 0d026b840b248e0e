"""The slip in a wrong formula (a factor, a sign or a term), and special values for which the formula is right.

A slip is found by exact division, or confirmed by `equal`. The values at a few points only exclude slips that the
answer cannot have, or suggest a factor.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from itertools import combinations
from typing import Any

import sympy
from sympy import Add, Expr, Function, Integer, Pow, Rational, Symbol, cancel, cos, pi, sin, sqrt

from derive.algebra.equality import equal
from derive.algebra.trig_polynomials import monomial_ratio
from derive.audit.fingerprint import CLOSE, differ, fingerprint
from derive.audit.time_limit import FAULTS
from derive.grading.outcomes import Outcome

MOST_TERMS = 60  # greatest number of terms of a sum that are searched
MOST_PROPOSALS = 600
SHORTEST = 10  # the greatest number of operations in a ratio that is shown
_BASES = (Integer(1), pi, 1 / pi, sqrt(2), sqrt(3), pi**2, 1 / pi**2, sqrt(5), sqrt(6), sqrt(7), sqrt(pi))
_SCALES = (Rational(1, 2), Integer(2), Rational(1, 3), Integer(3), Rational(1, 4), Integer(4))
Shown = Callable[[Any], str]
Found = tuple[Outcome, str]


def are_equal(left: Expr, right: Expr) -> bool:
    try:
        return bool(equal(left, right))
    except FAULTS:
        return False


def are_surely_equal(left: Expr, right: Expr) -> bool:
    """Whether two expressions are equal; numbers quickly exclude most expressions that are not equal."""
    return not differ(left, right) and are_equal(left, right)


def factor_between(left: Expr, right: Expr) -> Expr | None:
    """Return left / right if it is found and is a number, a product of powers of symbols, or a short expression; else
    None."""
    if left == 0 or right == 0:
        return None
    try:
        found = monomial_ratio(left, right)
        if found is None:
            found = _number_between(left, right)
        if found is None and sympy.count_ops(left) + sympy.count_ops(right) < 120:
            short = sympy.factor_terms(cancel(left / right))
            found = short if sympy.count_ops(short) <= SHORTEST and are_surely_equal(left, short * right) else None
    except FAULTS:
        return None
    return found


def _number_between(left: Expr, right: Expr) -> Expr | None:
    """Return the ratio of two expressions if it is a number that can be recognised; otherwise None."""
    one, other = fingerprint(left), fingerprint(right)
    if one is None or other is None or any(abs(each) < 1e-12 for each in other):
        return None
    ratios = [a / b for a, b in zip(one, other, strict=True)]
    if any(abs(each - ratios[0]) > CLOSE * abs(ratios[0]) for each in ratios) or abs(ratios[0].imag) > CLOSE:
        return None
    for base in _BASES:
        simple = Fraction(ratios[0].real / float(base)).limit_denominator(240)
        value = Rational(simple.numerator, simple.denominator) * base
        if value != 0 and abs(float(value) - ratios[0].real) < 1e-9 * abs(ratios[0].real):
            return value if are_equal(left, value * right) else None
    return None


def slips_between(answer: Expr, right: Expr, shown: Shown) -> Iterator[Found]:
    """Yield the slips of an answer, the simplest first: slips in whole terms, then slips inside sums and functions."""
    yield from _of_terms(answer, right, shown)
    yield from _inside(answer, right, shown)


def _of_terms(answer: Expr, right: Expr, shown: Shown) -> Iterator[Found]:
    try:
        difference = sympy.expand(right - answer)
        wanted, given = (Add.make_args(sympy.expand(each)) for each in (right, answer))
    except FAULTS:
        return
    for term in _grouped(right, wanted):
        ratio = monomial_ratio(difference, term) if difference != 0 else None
        if ratio is None or not ratio.is_number or len(wanted) < 2:
            continue
        if ratio == 1:
            yield Outcome.MISSING, f"the term {shown(term)} is missing"
        elif ratio == 2:
            yield Outcome.SIGN, f"the term {shown(term)} has the wrong sign"
        else:
            yield (
                Outcome.FACTOR,
                f"the term {shown(term)} has the wrong factor: the answer has {shown((1 - ratio) * term)}",
            )
    for term in _grouped(answer, given):
        if len(given) > 1 and are_surely_equal(difference, -term):
            yield Outcome.EXTRA, f"the term {shown(term)} is superfluous"
    mine, right_ones = ([each for each in terms if each not in others] for terms, others in
                        ((given, wanted), (wanted, given)))  # fmt: skip
    if len(mine) == len(right_ones) == 1 and len(wanted) > 1:
        ratio = mine[0] / right_ones[0]
        swapped = {ratio.func, (1 / ratio).func} & {sympy.tan, sympy.cot}
        if ratio == -1:
            yield Outcome.SIGN, f"the term {shown(right_ones[0])} has the wrong sign"
        elif sympy.count_ops(ratio) <= SHORTEST and not swapped and not swaps(ratio):
            yield Outcome.FACTOR, f"it has {shown(mine[0])} instead of {shown(right_ones[0])}"
    if len(wanted) > 3:
        for pair in combinations(wanted[:8], 2):
            if are_surely_equal(difference, Add(*pair)):
                yield Outcome.MISSING, f"the terms {shown(pair[0])} and {shown(pair[1])} are missing"


def swaps(ratio: Expr) -> bool:
    """Whether numerator and denominator of a ratio contain functions, as if one function were written in place of
    another."""
    above, below = ratio.as_numer_denom()
    return bool(above.atoms(Function) and below.atoms(Function))


def _grouped(value: Expr, expanded: tuple[Expr, ...]) -> list[Expr]:
    return list(dict.fromkeys((*Add.make_args(value), *expanded)))[:MOST_TERMS]


def _inside(answer: Expr, right: Expr, shown: Shown) -> Iterator[Found]:
    """Yield each slip that turns the right formula into the answer by a single change inside the formula, and each
    superfluous term inside a sum of the answer."""
    for count, (outcome, because, changed) in enumerate(_changes(right, shown)):
        if count > MOST_PROPOSALS:
            return
        if are_surely_equal(answer, changed):
            yield outcome, because
    for total in _sums_in(answer):
        for term in total.args[:MOST_TERMS]:
            if are_surely_equal(_replaced(answer, total, total - term), right):
                yield Outcome.EXTRA, f"the term {shown(term)} of {shown(total)} is superfluous"


def _changes(right: Expr, shown: Shown) -> Iterator[tuple[Outcome, str, Expr]]:
    for total in _sums_in(right):
        where = "" if total == right else f" of {shown(total)}"
        for term in total.args[:MOST_TERMS]:
            because = f"the term {shown(term)}{where}"
            yield Outcome.MISSING, f"{because} is missing", _replaced(right, total, total - term)
            yield Outcome.SIGN, f"{because} has the wrong sign", _replaced(right, total, total - 2 * term)
            for scale in _SCALES:
                told = f"{because} has the wrong factor: the answer has {shown(scale * term)}"
                yield Outcome.FACTOR, told, _replaced(right, total, total + (scale - 1) * term)
    for one in sorted(right.atoms(sin, cos), key=str):
        other = (cos if isinstance(one, sin) else sin)(*one.args)
        yield Outcome.DIFFERENT, f"it has {shown(other)} instead of {shown(one)}", _replaced(right, one, other)
    for power in sorted((each for each in right.atoms(Pow) if each.exp.is_Rational), key=str):
        for scale in (Rational(1, 2), Integer(2), Integer(-1)):
            changed = power.base ** (power.exp * scale)
            because = f"it has {shown(changed)} instead of {shown(power)}"
            yield Outcome.DIFFERENT, because, _replaced(right, power, changed)


def _sums_in(value: Expr) -> list[Expr]:
    found = [each for each in sympy.preorder_traversal(value) if isinstance(each, Add)]
    return list(dict.fromkeys(found))[:20]


def _replaced(value: Expr, part: Expr, by: Expr) -> Expr:
    return value.xreplace({part: by})


def special_values(answer: Expr, right: Expr, kinds: Mapping[Symbol, object], angles: set[Symbol], shown: Shown) -> str:
    """Return special values of the letters for which a wrong answer equals the right one, as text; "" if none is found.

    kinds    letter -> its kind; two letters of the same kind may be set equal
    angles   letters that may be 0 or pi/2
    """
    free = answer.free_symbols | right.free_symbols
    for one, other in combinations(sorted(free & set(kinds), key=str), 2):
        if kinds[one] == kinds[other] and _agree_with({one: other}, answer, right):
            return f"{shown(one)} = {shown(other)}"
    for letter in sorted(free & angles, key=str):
        for value, text in ((Integer(0), "0"), (pi / 2, "pi/2")):
            if _agree_with({letter: value}, answer, right):
                return f"{shown(letter)} = {text}"
    return ""


def _agree_with(put_in: dict[Symbol, Any], answer: Expr, right: Expr) -> bool:
    try:
        one, other = answer.subs(put_in), right.subs(put_in)
    except FAULTS:
        return False
    if one.has(sympy.nan, sympy.zoo, sympy.oo) or other == 0 or not other.free_symbols - set(put_in):
        return False
    return are_surely_equal(one, other)


__all__ = ["are_equal", "are_surely_equal", "factor_between", "slips_between", "special_values", "swaps"]
