"""Trial numbers: the points at which predicates test a statement, and the tests that predicates have in common.

A point gives each symbol a number in its range. The numbers have several sizes, and both signs where these are allowed.

A statement is accepted only if it is true at each point where it has a meaning, and if there is such a point.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import count, islice
from typing import Any, TypeAlias

from mpmath.libmp import NoConvergence
from sympy import Expr, Integer, Poly, Rational, primerange

from derive.algebra.expressions import PLUS_MINUS, Relation, explicit
from derive.algebra.order import known_order
from derive.algebra.ranges import fulfilling, range_of, rational_in_range
from derive.algebra.samples import NoNumber, Undefined, letters_of, value_at
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assumed

Point: TypeAlias = Mapping[Any, Expr]

TRIED = 24  # largest number of points that `trial_points` returns, if its caller does not choose another number
DRAWN = 240  # largest number of points that are drawn to find points that satisfy the conditions
# Largest number of pairs of points on opposite sides of one border; number of times that their distance is halved.
PAIRS, HALVINGS = 4, 10
SCALES = (1, 30, Rational(1, 30), 3, Rational(1, 300))
PRIMES = tuple(primerange(5, 130))
ALLOWED = {"=": (0,), "!=": (1, -1), ">": (1,), "<": (-1,), ">=": (0, 1), "<=": (0, -1)}  # signs of (left - right)
SMALL = Rational(1, 10**20)  # a ratio of imaginary to real part below this number is a rounding error


def trial_points(letters: Iterable[Any], *conditions: Relation, tried: int = TRIED) -> list[Point]:
    """Return points at which the conditions hold. A point has a number for each symbol in `letters` and in the
    conditions; without symbols, the only possible point is empty."""
    chosen = sorted({*letters, *(s for each in conditions for s in letters_of(explicit(each.residual)))}, key=str)
    drawn = islice(_drawn(chosen), DRAWN) if chosen else iter([{}])
    return list(islice((point for point in drawn if _fulfils(point, conditions)), tried))


def _drawn(letters: list[Any]) -> Iterator[Point]:
    either = [letter for letter in letters if may_be_negative(letter)]
    for n in count():
        turned = {letter: -1 for i, letter in enumerate(either) if n >> i % 4 & 1}
        sizes = (
            Integer(1) if letter == PLUS_MINUS else rational_in_range(letter, _size(i, n))
            for i, letter in enumerate(letters)
        )
        yield fulfilling({s: turned.get(s, 1) * size for s, size in zip(letters, sizes, strict=True)})


def _size(i: int, n: int) -> Expr:
    """Return the size of the number for the symbol with index i at point n. Many pairs of scales occur for any two
    symbols."""
    scale = SCALES[(n % 5 * (i + 1) + n // 5 * (2 * i + 1) + i // 5 * (n % 3)) % 5] if n % 3 else 1
    return Rational(PRIMES[(11 * i + 5 * n + i * n) % 29], 7 + i) * scale


def _fulfils(point: Point, conditions: Iterable[Relation]) -> bool:
    try:
        return all(holds_at(each, point) for each in conditions)
    except (Undefined, NoNumber):
        return False


def may_be_negative(letter: Any) -> bool:
    """Whether the sign of the symbol is free: the symbol is not declared nonnegative, and it has no range."""
    return not letter.is_nonnegative and range_of(letter) is None


def assumptions_about(letters: Iterable[Any]) -> list[Relation]:
    """Return those assumptions of the page that contain only these symbols after the given numbers are substituted."""
    known = set(letters)
    conditions = [explicit(with_numbers(each)) for each in assumed()]
    return [each for each in conditions if letters_of(each.residual) <= known]


def real_at(value: Any, point: Point) -> Expr | None:
    """Return the value at a point; None if the value is not real."""
    real, imaginary = value_at(explicit(value), point).as_real_imag()
    return real if abs(imaginary) <= abs(real) * SMALL else None


def sign_at(value: Any, point: Point) -> int | None:
    """Return the sign of the value at a point, 1, -1 or 0; None if the value is not real."""
    number = real_at(value, point)
    return None if number is None else 0 if number == 0 else 1 if number > 0 else -1


def holds_at(condition: Relation, point: Point) -> bool:
    """Whether a condition is true at a point; raise `Undefined` for an inequality between values that are not real."""
    sign = sign_at(condition.residual, point)
    if sign is None and condition.operator not in ("=", "!="):
        raise Undefined(condition)
    return condition.operator == "!=" if sign is None else sign in ALLOWED[condition.operator]


def signs(value: Any, points: Iterable[Point]) -> set[int | None]:
    """Return the set of the signs of a value at the points; it contains None if the value has no sign at a point."""
    found = set[int | None]()
    for point in points:
        try:
            found |= sign_as_set(value, point)
        except NoNumber:
            found.add(None)
    return found


def signs_of(value: Expr, *conditions: Relation) -> set[int | None]:
    """Return the set of signs of a value at trial numbers for which the conditions hold."""
    return signs(value, trial_points(letters_of(explicit(value)), *conditions))


def sign_found(value: Expr) -> int | None:
    """Return the sign that a value has at all trial numbers that the assumptions allow; None if there is no common
    sign.

    The given numbers are substituted. Points at which the value is too large or too small to compute do not count.
    """
    known = with_numbers(explicit(value))
    found = set[int | None]()
    for point in trial_points(letters_of(known), *assumptions_about(letters_of(known))):
        with suppress(NoNumber):
            found |= sign_as_set(known, point)
    return next(iter(found)) if len(found) == 1 else None


def sign_as_set(value: Expr, point: Point) -> set[int | None]:
    """Return a set with one entry: the sign of a value at a point, or None if it has none."""
    try:
        return {sign_at(value, point)}
    except Undefined:
        return {None}


def everywhere(points: Iterable[Point], is_so: Callable[[Point], bool | None]) -> bool:
    """Whether a statement is true at each point where it has a meaning, and has a meaning at one point at least.

    is_so   a function that returns whether the statement is true at a point; None, or an error, if it has no meaning
            there
    """
    found = _judged(points, is_so)
    return bool(found) and all(found)


def roots_of(polynomial: Poly) -> list[complex]:
    """Return the distinct roots of a polynomial whose coefficients are numbers; raise `NoNumber` if the roots are not
    found."""
    exact = Poly([as_rational(each) for each in polynomial.all_coeffs()], polynomial.gen)
    try:
        return [complex(root) for root in exact.sqf_part().nroots(n=25, maxsteps=200)]
    except NoConvergence:
        raise NoNumber(polynomial.as_expr()) from None


def as_rational(number: Expr) -> Expr:
    """Return a rational number unchanged, and any other number rounded to 40 digits as a rational number."""
    return number if number.is_Rational else Rational(str(number.evalf(40)))


def decides(condition: Relation, points: Iterable[Point]) -> bool:
    """Whether a condition is true at some of the points and false at others."""
    return {holds_at(condition, point) for point in points} == {True, False}


def just_where(
    conditions: Sequence[Relation], is_so: Callable[[Point], bool | None], letters: Iterable[Any], *given: Relation
) -> bool:
    """Whether a statement is true at trial points where all conditions hold and false at the others. Points close to
    the border of each condition are also tested.

    is_so     as for `everywhere`
    letters   symbols of the statement
    given     conditions under which the statement is made
    """

    def agrees(point: Point) -> bool | None:
        verdict = is_so(point)
        return None if verdict is None else verdict == all(holds_at(each, point) for each in conditions)

    chosen = {*letters, *(s for each in conditions for s in letters_of(explicit(each.residual)))}
    points = trial_points(chosen, *given)
    beside = [point for each in conditions for point in beside_border(each, points, *given)]
    return everywhere([*points, *beside], agrees)


def beside_border(condition: Relation, points: Sequence[Point], *given: Relation) -> list[Point]:
    """Return points close to the border of a condition, on both sides."""
    ahead, behind = ([point for point in points if _side(condition, point) is side] for side in (True, False))
    pairs = [_narrowed(condition, *ends) for ends in islice(zip(ahead, behind, strict=False), PAIRS)]
    kept = [*given, *(Relation(each, ">", 0) for each in known_order().positive)]
    return [point for pair in pairs for point in pair if _fulfils(point, kept)]


def _side(condition: Relation, point: Point) -> bool | None:
    try:
        return holds_at(condition, point)
    except (Undefined, NoNumber):
        return None


def _narrowed(condition: Relation, one: Point, other: Point) -> tuple[Point, ...]:
    """Return two points close to each other: the condition holds only at the first of them. The result is empty if the
    condition has no meaning at a point between the given points."""
    for _ in range(HALVINGS):
        middle = {s: (number + other[s]) / 2 for s, number in one.items()}
        side = _side(condition, middle)
        if side is None:
            return ()
        one, other = (middle, other) if side else (one, middle)
    return one, other


def _judged(points: Iterable[Point], is_so: Callable[[Point], bool | None]) -> list[bool]:
    found = []
    for point in points:
        try:
            verdict = is_so(point)
        except (Undefined, NoNumber):
            continue
        if verdict is not None:
            found.append(bool(verdict))
    return found
