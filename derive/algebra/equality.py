"""Whether two expressions are equal or two relations equivalent, and how this was decided.

proved          decided exactly, in most cases by `derive.algebra.normal_form`
sampled         both sides agree at random points, but no exact method decided
refuted         the sides differ, or they cannot be compared
definition      nothing is compared: the line defines a symbol
approximation   a rounded value or a series, whose error is checked separately

A sample never counts as a proof.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import reduce
from itertools import islice
from typing import Any

from sympy import (
    Abs,
    Basic,
    Expr,
    Float,
    Function,
    Integer,
    MatrixBase,
    MatrixExpr,
    Mul,
    Pow,
    Rational,
    cancel,
    cos,
    cot,
    nan,
    oo,
    sign,
    sin,
    tan,
    together,
    zoo,
)
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR5

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import Relation, explicit
from derive.algebra.normal_form import is_identity, vanishes
from derive.algebra.ranges import has_meaning, never_vanishes_within, strict_sign_within, without_abs
from derive.algebra.relation import TURNED
from derive.algebra.samples import (
    DIGITS,
    NoNumber,
    Sample,
    SamplePoint,
    Undefined,
    compared_at,
    letters_of,
    points,
    seed_of,
    shown,
    value_at,
)
from derive.algebra.trig_polynomials import monomial_ratio

MANY = 20  # greatest number of points drawn for each point that is needed; points without physical meaning are skipped
FIRST, POINTS = 2, 26  # numbers of points at which sides are compared before `vanishes` is tried, and after it fails
TURNS = 400  # greatest number of points drawn to find one where an argument of `Abs` or `sign` has the opposite sign
FEWEST = 8  # the fewest points at which two sides with symbols must both have values
UNTOLD = "undefined at every tested point"
LETTERS = 6  # greatest number of symbols with respect to which derivatives are compared
UNDEFINED = (nan, zoo, oo, -oo)


class Grade(StrEnum):
    PROVED = "proved"
    SAMPLED = "sampled"
    DEFINITION = "definition"
    APPROXIMATION = "approximation"
    REFUTED = "refuted"


LEAST_SURE_FIRST = (Grade.REFUTED, Grade.SAMPLED, Grade.APPROXIMATION, Grade.DEFINITION, Grade.PROVED)


class Compared(StrEnum):
    """What is compared, if anything: two lines of a calculation, or the result of a step and a second route, a check
    or a simulated motion."""

    LINES = "lines"
    ROUTE = "route"
    CHECK = "check"
    WITNESS = "witness"
    NOTHING = "nothing"


@dataclass(frozen=True)
class Evidence:
    """One claim about a step: what was compared for it, the grade of the decision, and its details."""

    claim: str
    compared: Compared
    grade: Grade
    detail: str = ""


@dataclass(frozen=True)
class Verdict:
    """The outcome of a comparison; `point` has the values of symbols at a point where the sides differ."""

    grade: Grade
    detail: str = ""
    point: tuple[tuple[str, str], ...] = ()

    def __bool__(self) -> bool:
        return self.grade is not Grade.REFUTED


def equal(left: Any, right: Any, nonzero: Sequence[Expr] = ()) -> Verdict:
    """Compare two scalars, two matrices entry by entry, or two relations.

    The grade of a matrix is the grade of its least certain entry. Relations count as equal if they are found to be
    equivalent. `nonzero` lists factors that may be divided out. In equations these factors are known not to vanish, and
    in inequalities they are known to be positive.
    """
    given: tuple[Any, Any] = (left, right)
    if not all(isinstance(value, Basic | MatrixBase | int) for value in given):
        return Verdict(
            Grade.REFUTED, f"{_short(left)} against {_short(right)}: at least one of them is not an expression"
        )
    try:
        left, right = without_abs(explicit(left)), without_abs(explicit(right))
    except (TypeError, ValueError, AttributeError, NotImplementedError) as error:  # SymPy cannot integrate
        return Verdict(Grade.REFUTED, f"{_short(left)} against {_short(right)}: {error}")
    try:
        return _compared(left, right, nonzero)
    except (TypeError, ValueError, NotImplementedError) as error:  # SymPy cannot handle a malformed expression
        return Verdict(Grade.REFUTED, f"{_short(left)} against {_short(right)}: {error}")


def _compared(left: Any, right: Any, nonzero: Sequence[Expr]) -> Verdict:
    if isinstance(left, Relation) or isinstance(right, Relation):
        return _equivalent(left, right, nonzero)
    if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
        return _equal_matrices(left, right)
    return _equal_scalars(left, right)


def _equal_matrices(left: Any, right: Any) -> Verdict:
    if getattr(left, "shape", None) != getattr(right, "shape", None):
        return Verdict(Grade.REFUTED, "the shapes differ")
    left, right = (side.as_explicit() if isinstance(side, MatrixExpr) else side for side in (left, right))
    worst = Verdict(Grade.PROVED, "identical")
    for a, b in zip(left, right, strict=True):
        verdict = _equal_scalars(a, b)
        if not verdict:
            return verdict
        if verdict.grade is Grade.SAMPLED or worst.detail == "identical":
            worst = verdict if worst.grade is not Grade.SAMPLED else worst
    return worst


def _equal_scalars(left: Expr, right: Expr) -> Verdict:
    if left.has(*UNDEFINED) or right.has(*UNDEFINED):
        return Verdict(Grade.REFUTED, f"{_short(left)} against {_short(right)}: at least one of them is undefined")
    if left == right:
        return Verdict(Grade.PROVED, "identical")
    if not (isinstance(left, Expr) and isinstance(right, Expr) and left.is_commutative and right.is_commutative):
        return Verdict(Grade.REFUTED, f"{_short(left)} against {_short(right)}: at least one of them is not a number")
    left, right = _stripped(left, right)
    if is_identity(left, right):
        return Verdict(Grade.PROVED, "polynomial normal form")
    for sample in _samples(left, right, FIRST):
        if not sample.agree:
            return _refutation(sample)
    difference = left - right
    if vanishes(difference):
        return Verdict(Grade.PROVED, "polynomial normal form")
    seen: list[SamplePoint] = []
    for sample in _samples(left, right, POINTS, thoroughly=True):
        if not sample.agree:
            return _refutation(sample)
        seen.append(sample.point)
    apart = _apart_where_signs_turn(left, right, seen)
    if apart is not None:
        return _refutation(apart)
    if len(seen) < FEWEST and letters_of(difference) or not seen:
        return Verdict(Grade.REFUTED, f"both sides have values at {len(seen)} points only" if seen else UNTOLD)
    if not letters_of(difference):
        # No symbols to vary: one number, computed to many digits, is still only a sample.
        return Verdict(Grade.SAMPLED, f"to {DIGITS} digits")
    return Verdict(Grade.SAMPLED, f"{len(seen)} points to {DIGITS} digits")


def _stripped(left: Expr, right: Expr) -> tuple[Expr, Expr]:
    """If both sides are values of the same function acos, asin or atan, return the two arguments: acos(u) equals
    acos(v) if and only if u equals v."""
    while left.func == right.func and left.func.__name__ in {"acos", "asin", "atan"} and len(left.args) == 1:
        left, right = left.args[0], right.args[0]
    return left, right


# --- samples ---------------------------------------------------------------------------------------------------------


def _samples(left: Expr, right: Expr, count: int, thoroughly: bool = False) -> Iterator[Sample]:
    """The values of both sides at points at which both sides are defined.

    Points at which neither side is real are used only if there are no other points, because two forms of one expression
    may have such values on different branches. Points that contradict an assumption of the problem, such as c^2 - v^2 >
    0, are left out.
    """
    letters = letters_of(left) | letters_of(right)
    drawn = points(letters, seed_of(left, right))
    found, beside, beyond = 0, [], 0
    for tried, point in enumerate(islice(drawn, MANY * count if letters else 1)):
        if tried >= 2 * count + beyond:
            break
        if not has_meaning(point):
            beyond += 1
            continue
        try:
            sample = compared_at(left, right, point, thoroughly)
        except (Undefined, NoNumber):
            continue
        if _is_imaginary(sample):
            beside.append(sample)
            continue
        yield sample
        found += 1
        if found == count:
            return
    if not found:
        yield from beside[:count]


def _apart_where_signs_turn(left: Expr, right: Expr, seen: Sequence[SamplePoint]) -> Sample | None:
    """Look for a point where the sides differ; None if no such point is found.

    If the argument of an `Abs` or a `sign` has only one sign at the points `seen`, points with the opposite sign are
    tried.
    """
    letters = letters_of(left) | letters_of(right)
    for inside in sorted({each.args[0] for each in (left - right).atoms(Abs, sign)}, key=str):
        sides = {side for point in seen if (side := _side(inside, point)) is not None}
        drawn = points(letters, seed_of(left, right, inside)) if len(sides) == 1 else iter(())
        for point in islice(drawn, TURNS):
            if _side(inside, point) in {None, *sides} or not has_meaning(point):
                continue
            try:
                sample = compared_at(left, right, point)
            except (Undefined, NoNumber):
                continue
            if not sample.agree and not _is_imaginary(sample):
                return sample
    return None


def _side(inside: Expr, point: SamplePoint) -> bool | None:
    try:
        value = value_at(inside, point)
    except (Undefined, NoNumber):
        return None
    return bool(value > 0) if value.is_real and value != 0 else None


def _is_imaginary(sample: Sample) -> bool:
    """Whether both sides have imaginary parts although all symbols are real."""
    letters_real = all(value.is_real for value in sample.point.values())
    return letters_real and all(abs(side.imag) > 1e-20 * abs(side) for side in (sample.left, sample.right))


def _refutation(sample: Sample) -> Verdict:
    where = tuple((str(letter), str(value)) for letter, value in sample.point.items())
    return Verdict(Grade.REFUTED, f"{shown(sample.left)!s} against {shown(sample.right)!s}", where)


# --- relations -------------------------------------------------------------------------------------------------------


def _equivalent(left: Any, right: Any, nonzero: Sequence[Expr]) -> Verdict:
    """Decide whether two equations or inequalities are equivalent. The main test is the ratio of their residuals: the
    sign of the ratio of two inequalities must be known, and the ratio of two equations must not vanish."""
    if not (isinstance(left, Relation) and isinstance(right, Relation)):
        return Verdict(Grade.REFUTED, "a relation against a value")
    if left.has(*UNDEFINED) or right.has(*UNDEFINED):
        return Verdict(Grade.REFUTED, f"{_short(left)} against {_short(right)}: at least one of them is undefined")
    if left == right:
        return Verdict(Grade.PROVED, "identical")
    if any(isinstance(side, MatrixBase) for side in (*left.sides, *right.sides)):
        return _equivalent_by_entries(left, right)
    if left.residual == 0 or right.residual == 0:
        if left.operator != right.operator:
            return Verdict(Grade.REFUTED, f"{left.operator} against {right.operator}")
        return _equal_scalars(left.residual, right.residual)
    whole = _seen_ratio(left, right)
    if whole is not None and _is_borne(left.operator, right.operator, _without_factors(whole, nonzero)):
        # If both residuals are zero, any factor fits, so a negative factor does not show that the operators agree.
        if left.operator != right.operator and vanishes(left.residual):
            said = f"{left.operator} against {right.operator}; the sides of each relation are equal"
            return Verdict(Grade.REFUTED, said)
        return Verdict(Grade.PROVED, f"equal up to the factor {whole}" if whole**2 != 1 else "polynomial normal form")
    if _same_mark(left.operator, right.operator, 1) and _both_squared(left, right):
        return Verdict(Grade.PROVED, "both sides squared, neither negative")
    if left.operator == right.operator == "=" and not nonzero:  # a counterexample is found faster than a common factor
        apart = _counterexample(left.residual, right.residual)
        if apart is not None:  # a refuted verdict is falsy, so compare with None
            return apart
    whole = _ratio(left.residual, right.residual) if whole is None else whole
    factor = _without_factors(whole, nonzero)
    known_sign = _known_sign(factor)
    if known_sign is None and (cleared := _cleared(left, right)) is not None:
        return _equivalent(*cleared, nonzero)
    if not _same_mark(left.operator, right.operator, known_sign or 0):
        return Verdict(Grade.REFUTED, f"their sides differ by the factor {_short(factor)}")
    if known_sign is None and not _never_vanishes(factor):
        apart = _counterexample(left.residual, right.residual) if left.operator == "=" else None
        if apart is not None:  # a refuted verdict is falsy, so compare with None
            return apart
        said = f"their sides differ by the factor {_short(factor)}, which may be zero or undefined"
        return Verdict(Grade.REFUTED, said)
    verdict = _equal_scalars(left.residual, whole * right.residual)
    return verdict if verdict.grade is Grade.REFUTED else Verdict(verdict.grade, f"equal up to the factor {whole}")


def _seen_ratio(left: Relation, right: Relation) -> Expr | None:
    """The ratio of the two residuals, if it is easily found; else None."""
    found = monomial_ratio(left.residual, right.residual)
    if found is None:
        signs = (Integer(sign) for sign in (1, -1) if _same_mark(left.operator, right.operator, sign))
        found = next((sign for sign in signs if vanishes(left.residual - sign * right.residual)), None)
    return found


def _is_borne(left: str, right: str, factor: Expr) -> bool:
    """Whether multiplication by this factor turns a relation with one operator into an equivalent relation with the
    other."""
    sign = _known_sign(factor)
    return _same_mark(left, right, sign or 0) and (sign is not None or _never_vanishes(factor))


def _equivalent_by_entries(left: Relation, right: Relation) -> Verdict:
    """Compare two equations between matrices, also with the sides of one equation exchanged."""
    shapes = {getattr(side, "shape", None) for side in (*left.sides, *right.sides)}
    if left.operator != right.operator or left.operator != "=" or len(shapes) > 1:
        return Verdict(Grade.REFUTED, f"`{left}` against `{right}`")
    verdicts = [_equal_matrices(left.left - left.right, sign * (right.left - right.right)) for sign in (1, -1)]
    return next((verdict for verdict in verdicts if verdict), verdicts[0])


def _cleared(left: Relation, right: Relation) -> tuple[Relation, Relation] | None:
    """Rewrite strict inequalities n/d > 0 as n d > 0. Each new inequality is equivalent to the old one, because neither
    is true where d vanishes. None unless both relations are strict inequalities and a denominator has a symbol."""
    strict = {left.operator, right.operator} <= {"<", ">"}
    quotients = [relation.residual.as_numer_denom() for relation in (left, right)]
    if not strict or not any(d.free_symbols for _, d in quotients):
        return None
    one, other = (Relation(n * d, each.operator, 0) for each, (n, d) in zip((left, right), quotients, strict=True))
    return one, other


def _known_sign(factor: Expr) -> int | None:
    """Return 1 if the factor is known to be positive for all allowed values of its symbols, -1 if it is known to be
    negative, else None."""
    above, below = (strict_sign_within(part) for part in factor.as_numer_denom())
    return above * below if above and below else None


def _never_vanishes(factor: Expr) -> bool:
    """Whether the factor is known to be nonzero and defined for all allowed values of its symbols."""
    return all(part.is_nonzero or never_vanishes_within(part) for part in factor.as_numer_denom())


def _counterexample(left: Expr, right: Expr) -> Verdict | None:
    """Look for a point where `right` is zero and `left` is not; None if no such point is found."""
    drawn = points(letters_of(left) | letters_of(right), seed_of(left, right))
    curved = {letter for part in right.atoms(Pow, Function) for letter in part.free_symbols}
    for letter in sorted(right.free_symbols - curved, key=lambda s: (not str(s).endswith("dot"), str(s))):
        slope = right.diff(letter)
        if slope == 0 or slope.has(letter) or letter.is_positive:
            continue
        for _, point in zip(range(FIRST), drawn, strict=False):
            others = {name: value for name, value in point.items() if name != letter}
            try:
                solved = value_at(-right.xreplace({letter: Integer(0)}) / slope, others)
                off, zero = (value_at(side, {**others, letter: solved}) for side in (left, right))
            except (Undefined, NoNumber):
                continue
            if abs(zero) < Rational(1, 10**30) < abs(off):
                where = tuple((str(name), str(value)) for name, value in others.items())
                return Verdict(
                    Grade.REFUTED, f"where one equation is true, the sides of the other differ by {off.evalf(6)}", where
                )
    return None


def _short(value: Any) -> str:
    try:
        text = str(value)
    except ValueError:  # Python refuses to write out an integer with thousands of digits
        return type(value).__name__
    return text if len(text) <= 80 else text[:80] + " ..."


def _same_mark(left: str, right: str, sign: int) -> bool:
    """Whether multiplication by a factor of this sign turns one operator into the other: a negative factor reverses an
    inequality."""
    if left in {"=", "!="} or right in {"=", "!="}:
        return left == right
    return bool(sign) and left == (right if sign > 0 else TURNED[right])


def _both_squared(left: Relation, right: Relation) -> bool:
    """Whether squaring both sides of one relation gives the other, up to a positive factor. The sides that are squared
    must be known not to be negative.
    """
    for squares, roots in ((left, right), (right, left)):
        difference = roots.left**2 - roots.right**2
        if difference != 0 and all(side.is_nonnegative or strict_sign_within(side) == 1 for side in roots.sides):
            factor = _ratio(squares.residual, difference)
            if (factor.is_positive or strict_sign_within(factor) == 1) and vanishes(
                squares.residual - factor * difference
            ):
                return True
    return False


def _ratio(above: Expr, below: Expr) -> Expr:
    if above.has(Float) or below.has(Float):  # inexact numbers are not cancelled
        return above / below
    # The ratios 1 and -1 are first tried at points, because `cancel` could take a minute.
    for turn in (Integer(1), Integer(-1)):
        samples = list(_samples(above, turn * below, FIRST))
        if samples and all(sample.agree for sample in samples):
            return turn
    try:
        found = cancel(together(_by_cosines(above) / _by_cosines(below)))
    except PolynomialError:
        found = above / below
    return found if _never_vanishes(found) else _ratio_by_a_letter(above, below) or found


def _ratio_by_a_letter(above: Expr, below: Expr) -> Expr | None:
    """The ratio of the derivatives with respect to a symbol, if this is also the ratio of the whole expressions; else
    None. This finds a common factor that is hidden in sin(2 x) or in a fractional power."""
    for letter in sorted(above.free_symbols & below.free_symbols, key=str)[:LETTERS]:
        slopes = derivative(above, letter), derivative(below, letter)
        if slopes[1] != 0:
            found = cancel(slopes[0] / slopes[1])
            apart = above - found * below
            if not found.has(letter) and _never_vanishes(found) and (apart.expand() == 0 or vanishes(apart)):
                return found
    return None


def _by_cosines(expr: Expr) -> Expr:
    """Write tangents and cotangents as quotients, and squares of sines in terms of cosines, so that common factors are
    visible."""
    expr = expr.replace(tan, lambda angle: sin(angle) / cos(angle))
    expr = expr.replace(cot, lambda angle: cos(angle) / sin(angle))
    return TR5(expr.expand(), max=8) if expr.has(sin) else expr


def _without_factors(expr: Expr, known: Sequence[Expr]) -> Expr:
    return reduce(_without_factor, known, expr)


def _without_factor(expr: Expr, known: Expr) -> Expr:
    """The expression without the integer powers of a factor that is known to be positive or not to vanish."""
    left: list[Expr] = []
    for factor in Mul.make_args(together(expr)):
        base, power = factor.as_base_exp()
        if not power.is_Integer or base not in {known, -known}:
            left.append(factor)
        elif base != known:
            left.append(Integer(-1) ** power)  # the factor is b - a, and a - b is known to be positive
    return Mul(*left)
