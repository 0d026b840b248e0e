"""Are two expressions equal, two relations equivalent, and how do we know?

    proved          decided exactly, by `derive.exact`
    sampled         agrees at random exact points, but no exact method decided it
    refuted         differs at a point, which is named
    definition      nothing to compare: the line says what a symbol means
    approximation   a rounded value or a series, itself checked

Points come first: they are cheap and refute at once. A sample never counts as a proof.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from sympy import Derivative, Expr, Integer, MatrixBase, Mul, Rational, Symbol, cancel, nan, oo, sin, together, zoo
from sympy.core.function import AppliedUndef
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR5

from derive.exact import vanishes
from derive.expressions import PLUS_MINUS, Relation, explicit

POINTS = 8
DIGITS = 50


class Grade(StrEnum):
    PROVED = "proved"
    SAMPLED = "sampled"
    DEFINITION = "definition"
    APPROXIMATION = "approximation"
    REFUTED = "refuted"


LEAST_SURE_FIRST = (Grade.REFUTED, Grade.SAMPLED, Grade.APPROXIMATION, Grade.DEFINITION, Grade.PROVED)


@dataclass(frozen=True)
class Evidence:
    """One claim about a step, how it was decided, and what is needed to look again."""

    claim: str
    grade: Grade
    detail: str = ""

    @property
    def is_of_line(self) -> bool:
        """Whether it compares two lines of a chain; else it is of a second route, or of a definition."""
        return self.claim.startswith("line ")


@dataclass(frozen=True)
class Verdict:
    """The outcome of a comparison; `point` refutes when the grade is `refuted`."""

    grade: Grade
    detail: str = ""
    point: tuple[tuple[str, str], ...] = ()

    def __bool__(self) -> bool:
        return self.grade is not Grade.REFUTED


def equal(left: Any, right: Any, nonzero: Sequence[Expr] = ()) -> Verdict:
    """Compare two scalars, two matrices entry by entry, or two relations.

    A matrix is as sure as its least sure entry. Relations are equal when each follows from the other; `nonzero` are
    factors that may be divided out because they are known not to vanish (in an inequality, to be positive).
    """
    left, right = explicit(left), explicit(right)
    if isinstance(left, Relation) or isinstance(right, Relation):
        return _equivalent(left, right, nonzero)
    if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
        return _equal_matrices(left, right)
    return _equal_scalars(left, right)


def _equal_matrices(left: Any, right: Any) -> Verdict:
    if getattr(left, "shape", None) != getattr(right, "shape", None):
        return Verdict(Grade.REFUTED, "the shapes differ")
    worst = Verdict(Grade.PROVED, "identical")
    for a, b in zip(left, right, strict=True):
        verdict = _equal_scalars(a, b)
        if not verdict:
            return verdict
        if verdict.grade is Grade.SAMPLED or worst.detail == "identical":
            worst = verdict if worst.grade is not Grade.SAMPLED else worst
    return worst


def _equal_scalars(left: Expr, right: Expr) -> Verdict:
    if left.has(nan, zoo) or right.has(nan, zoo):
        return Verdict(Grade.REFUTED, f"{left} against {right}, and one of them is undefined")
    if left == right:
        return Verdict(Grade.PROVED, "identical")
    left, right = _stripped(left, right)
    for point in _points(left, right, 2):
        if not _agree(left, right, point):
            return _refutation(left, right, point)
    difference = left - right
    if vanishes(difference):
        return Verdict(Grade.PROVED, "polynomial normal form")
    seen = 0
    for point in _points(left, right, POINTS):
        if not _agree(left, right, point):
            return _refutation(left, right, point)
        seen += 1
    if seen == 0:
        return Verdict(Grade.REFUTED, "undefined wherever it was tried")
    if not _letters(difference):
        # No letters to vary: one number, computed to many digits, is still only a sample.
        return Verdict(Grade.SAMPLED, f"to {DIGITS} digits")
    return Verdict(Grade.SAMPLED, f"{seen} points to {DIGITS} digits")


def _stripped(left: Expr, right: Expr) -> tuple[Expr, Expr]:
    """acos(u) and acos(v) agree exactly if u and v do: take off what is one-to-one."""
    while left.func == right.func and left.func.__name__ in {"acos", "asin", "atan"} and len(left.args) == 1:
        left, right = left.args[0], right.args[0]
    return left, right


# --- samples ---------------------------------------------------------------------------------------------------------


def _points(left: Expr, right: Expr, count: int) -> Iterator[dict[Expr, Expr]]:
    """Points at which both sides are defined: exact rationals, the same ones in every run."""
    letters = sorted(_letters(left) | _letters(right), key=str)
    source = random.Random(20_777)
    found = 0
    for _ in range(6 * count):
        point = {letter: _draw(letter, source) for letter in letters}
        if _defined(left, point) and _defined(right, point):
            yield point
            found += 1
        if found == count:
            return


def _letters(expr: Expr) -> set[Expr]:
    """What can be varied freely: symbols other than bound ones, functions of time and their derivatives."""
    functions = expr.atoms(AppliedUndef) | expr.atoms(Derivative)
    return set(functions) | {s for s in expr.free_symbols if isinstance(s, Symbol)}


def _draw(letter: Expr, source: random.Random) -> Expr:
    size = Rational(source.randint(11, 97), source.randint(23, 61))
    if letter == PLUS_MINUS:
        return Integer(source.choice((1, -1)))
    if letter.is_integer:
        return Integer(source.randint(1, 9))
    if letter.is_positive or letter.is_nonnegative:
        return size
    return size if source.random() < 0.5 else -size


def _at(expr: Expr, point: dict[Expr, Expr]) -> Expr:
    ordered = sorted(point, key=lambda e: (isinstance(e, Symbol), isinstance(e, AppliedUndef)))  # derivatives first
    for letter in ordered:
        expr = expr.xreplace({letter: point[letter]})
    # A zero in disguise comes out as noise of no significant digit, which would differ from 0 by 100%.
    return expr.evalf(DIGITS).replace(lambda e: e.is_Float and e._prec == 1, lambda e: Integer(0))


def _defined(expr: Expr, point: dict[Expr, Expr]) -> bool:
    value = _at(expr, point)
    return bool(value.is_number) and not value.has(nan, zoo, oo, -oo)


def _agree(left: Expr, right: Expr, point: dict[Expr, Expr]) -> bool:
    a, b = _at(left, point), _at(right, point)
    scale = abs(a) + abs(b)
    return bool(scale == 0 or abs(a - b) <= scale * Rational(1, 10 ** (DIGITS - 10)))


def _refutation(left: Expr, right: Expr, point: dict[Expr, Expr]) -> Verdict:
    a, b = _at(left, point), _at(right, point)
    where = tuple((str(letter), str(value)) for letter, value in point.items())
    return Verdict(Grade.REFUTED, f"{a.evalf(6)} against {b.evalf(6)}", where)


# --- relations -------------------------------------------------------------------------------------------------------

_TURNED = {"=": "=", "!=": "!=", "<": ">", ">": "<", "<=": ">=", ">=": "<="}


def _equivalent(left: Any, right: Any, nonzero: Sequence[Expr]) -> Verdict:
    """Whether two equations, or two inequalities, say the same: their residuals differ by a factor of known sign."""
    if not (isinstance(left, Relation) and isinstance(right, Relation)):
        return Verdict(Grade.REFUTED, "a relation against a value")
    if left == right:
        return Verdict(Grade.PROVED, "identical")
    if _same_mark(left.mark, right.mark, 1) and _both_squared(left, right):
        return Verdict(Grade.PROVED, "both sides squared, neither negative")
    for sign in (1, -1):
        if _same_mark(left.mark, right.mark, sign) and vanishes(left.residual - sign * right.residual):
            return Verdict(Grade.PROVED, "polynomial normal form")
    if left.residual == 0 or right.residual == 0:
        if left.mark != right.mark:
            return Verdict(Grade.REFUTED, f"{left.mark} against {right.mark}")
        return _equal_scalars(left.residual, right.residual)
    if left.mark == right.mark and vanishes(left.residual - right.residual):
        return Verdict(Grade.PROVED, "polynomial normal form")
    factor = _ratio(left.residual, right.residual)
    for known in nonzero:
        factor = _without_factor(factor, known)
    if not _same_mark(left.mark, right.mark, 1 if factor.is_positive else -1 if factor.is_negative else 0):
        return Verdict(Grade.REFUTED, f"their sides differ by the factor {_short(factor)}")
    if not factor.is_nonzero:
        apart = _counterexample(left.residual, right.residual) if left.mark == "=" else None
        if apart is not None:  # a refutation is false as a truth value
            return apart
        return Verdict(Grade.REFUTED, f"their sides differ by {_short(factor)}, which may be zero")
    whole = _ratio(left.residual, right.residual)
    verdict = _equal_scalars(left.residual, whole * right.residual)
    return verdict if verdict.grade is Grade.REFUTED else Verdict(verdict.grade, f"multiples of each other by {whole}")


def _counterexample(left: Expr, right: Expr) -> Verdict | None:
    """A point at which the second equation holds and the first does not: solved for a letter that it holds linearly."""
    for letter in sorted(right.free_symbols, key=lambda s: (not str(s).endswith("dot"), str(s))):
        slope = right.diff(letter)
        if slope == 0 or slope.has(letter) or letter.is_positive:
            continue
        for point in _points(left, right, 1):
            others = {name: value for name, value in point.items() if name != letter}
            at = {**others, letter: _at(letter - right / slope, {**others, letter: Integer(0)})}
            if abs(_at(right, at)) < Rational(1, 10**30) < abs(_at(left, at)):
                where = tuple((str(name), str(value)) for name, value in others.items())
                return Verdict(Grade.REFUTED, f"where one holds, the other has {_at(left, at).evalf(6)} for 0", where)
    return None


def _short(factor: Expr) -> str:
    text = str(factor)
    return text if len(text) <= 80 else text[:80] + " ..."


def _same_mark(left: str, right: str, sign: int) -> bool:
    """An equation bears any factor, an inequality keeps its mark under a positive one and is turned by a negative."""
    if left in {"=", "!="} or right in {"=", "!="}:
        return left == right
    return bool(sign) and left == (right if sign > 0 else _TURNED[right])


def _both_squared(left: Relation, right: Relation) -> bool:
    """x^2 > y^2, or a positive multiple of it, says the same as x > y when neither x nor y is negative."""
    for squares, roots in ((left, right), (right, left)):
        difference = roots.left**2 - roots.right**2
        if difference != 0 and all(side.is_nonnegative for side in roots.sides):
            factor = _ratio(squares.residual, difference)
            if factor.is_positive and vanishes(squares.residual - factor * difference):
                return True
    return False


def _ratio(above: Expr, below: Expr) -> Expr:
    try:
        return cancel(together(_by_cosines(above) / _by_cosines(below)))
    except PolynomialError:
        return above / below


def _by_cosines(expr: Expr) -> Expr:
    """Multiplied out, with the squares of sines written by those of cosines, so that common factors show."""
    return TR5(expr.expand(), max=8) if expr.has(sin) else expr


def _without_factor(expr: Expr, known: Expr) -> Expr:
    """The expression without a factor, in whatever power, that is known to be positive or not to vanish."""
    left: list[Expr] = []
    for factor in Mul.make_args(together(expr)):
        base, power = factor.as_base_exp()
        if not power.is_Integer or base not in {known, -known}:
            left.append(factor)
        elif base != known:
            left.append(Integer(-1) ** power)  # b - a where a - b is known to be positive
    return Mul(*left)
