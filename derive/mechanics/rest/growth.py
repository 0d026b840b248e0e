"""Decide numerically whether displacements from an equilibrium grow, from the exponents of the linearised motion.

For small motions, the virtual work of m a - F along each coordinate is linear in displacements, rates and
accelerations. Finite differences give the matrices M, C and K; a motion proportional to exp(s t) is possible if
det(M s^2 + C s + K) = 0.
Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1 (extended by forces that depend on the rates).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from itertools import product
from typing import Any

from mpmath import mp
from sympy import Expr, Integer, Rational, Symbol, lambdify

from derive.algebra.expressions import explicit, rate
from derive.algebra.ranges import has_meaning, rational_in_range
from derive.mechanics.hamilton.facts import SeenWith
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.model.system import System
from derive.mechanics.rest.facts import matter_behind
from derive.steps.step import Quantity

DIGITS = 75
# A growth rate counts as zero if it is less than 10^-SMALL times the largest exponent. A gyroscopic force or an
# eigenvalue of M counts as zero if it is less than 10^-SMALL times the largest entry of its matrix.
SMALL = 10
FEW = 3  # number of sets of numbers that are tried; `grows_always` tries more if gyroscopic forces act
ELSEWHERE = Rational(3, 8)  # value of a coordinate that the energy does not contain
SIZES = (Rational(17, 23), Rational(2300, 7), Rational(3, 71))  # values of symbols that the energy does not contain

Numbers = Mapping[Symbol, Expr]
Leftover = Callable[..., Sequence[Any]]


def matter_of(potential: Quantity) -> Matter | None:
    """Return the mass points and forces to which a potential energy belongs, including magnetic forces; None if they
    are unknown."""
    if potential.fact(SeenWith) is None and isinstance(potential.subject.body, System):
        return potential.subject.body.matter
    return matter_behind(potential)


def grows_always(matter: Matter, place: Mapping[Symbol, Expr], points: Sequence[Numbers]) -> bool:
    """Whether, for all numbers tried, some small displacement from the equilibrium grows.

    place    the equilibrium values of the coordinates
    points   numbers for the symbols of the energy, such that the energy falls in some direction

    If gyroscopic forces act, all points are tried with several values of the other symbols; otherwise a few points are
    enough. Numbers for which `_motion` gives no matrices are skipped; the result is also true if no numbers are left.
    """
    tried = 0
    for point in points:
        for size in SIZES:
            motion = _motion(matter, place, point, size)
            if motion is None:
                continue
            if not _grows(*motion):
                return False
            if not _is_turned(*motion):  # then the displacement grows for any values of the other symbols
                tried += 1
                break
        if tried >= FEW:
            break
    return True


def inertia_is_positive(matter: Matter, place: Mapping[Symbol, Expr], points: Sequence[Numbers]) -> bool:
    """Whether M has no negative eigenvalue at equilibrium, tested at the first few points; the kinetic energy is then
    not negative there."""
    for point, falling in product(points[:FEW], (False, True)):
        motion = _motion(matter, place, point, SIZES[0], falling)
        if motion is None:
            continue
        with mp.workdps(DIGITS):
            least = min(mp.eigsy((motion[0] + motion[0].T) / 2, eigvals_only=True))
            if least < -_largest(motion[0]) * mp.mpf(10) ** -SMALL:
                return False
    return True


def is_turned_aside(matter: Matter, place: Mapping[Symbol, Expr], points: Sequence[Numbers]) -> bool:
    """Whether gyroscopic forces act, as in a rotating frame or in a magnetic field: C is not symmetric."""
    motions = (_motion(matter, place, point, SIZES[0]) for point in points[:FEW])
    return any(motion is not None and _is_turned(*motion) for motion in motions)


@lru_cache(maxsize=16)  # each equilibrium of a system needs the same function
def _left_over(matter: Matter) -> tuple[tuple[Symbol, ...], Leftover]:
    """Return the constant symbols in m a - F, and m a - F along each coordinate as a function of coordinates, rates,
    accelerations and these symbols."""
    moving = matter.coordinates
    idle = {other.multiplier: Integer(0) for other in matter.others if other.multiplier is not None}
    left = [explicit(matter.inertia_along(q) - matter.force_along(q)).xreplace(idle) for q in moving]
    varied = [each for order in (0, 1, 2) for each in ([rate(q, order) for q in moving] if order else moving)]
    letters = tuple(sorted(set().union(*(each.free_symbols for each in left)) - set(varied), key=str))
    return letters, lambdify([*varied, *letters], left, "mpmath", cse=True, dummify=True)


def _motion(
    matter: Matter, place: Numbers, point: Numbers, size: Expr, falling: bool = False
) -> tuple[Any, Any, Any] | None:
    """Return M, C and K, the derivatives of m a - F with respect to accelerations, rates and coordinates, at rest.

    falling   whether the symbols that the energy does not contain get decreasing values, in their order; by default the
              values increase

    Return None if the coordinates are singular, like the angles of an upright top, or if the numbers do not
    satisfy the assumptions of positivity.
    """
    letters, left = _left_over(matter)
    count = len(matter.coordinates)
    with mp.workdps(DIGITS):
        sizes = (size / (1 + Rational(i, 9)) if falling else size + Rational(i, 9) for i in range(len(letters)))
        others = {s: rational_in_range(s, n) for s, n in zip(letters, sizes, strict=True) if s not in point}
        if not has_meaning({**point, **others}):
            return None
        known = [_number({**point, **others}[s]) for s in letters]
        there = [_number(place.get(q, ELSEWHERE).xreplace(dict(point))) for q in matter.coordinates]
        still = [*there, *[mp.mpf(0)] * (2 * count)]
        try:
            k, c, m = (_slopes(lambda *at: left(*at, *known), still, order * count, count) for order in (0, 1, 2))
        except ZeroDivisionError:
            return None
    return m, c, k


def _slopes(left: Leftover, still: Sequence[Any], first: int, count: int) -> Any:
    """Return the derivatives of the residuals with respect to the `count` arguments from number `first` on, by central
    differences."""
    step = mp.mpf(10) ** -(DIGITS // 3)
    found = mp.matrix(count, count)
    for k in range(count):
        ahead, behind = (left(*(x + turn * step * (i == first + k) for i, x in enumerate(still))) for turn in (1, -1))
        for i in range(count):
            found[i, k] = mp.re(ahead[i] - behind[i]) / (2 * step)
    return found


def _number(value: Expr) -> Any:
    return mp.mpf(str(value.evalf(DIGITS)))


def _grows(inertia: Any, damping: Any, stiffness: Any) -> bool:
    """Whether an exponent, an eigenvalue of the equivalent first-order system, has a positive real part."""
    count = inertia.rows
    with mp.workdps(DIGITS):
        try:
            inverse = inertia**-1
        except ZeroDivisionError:  # a coordinate without inertia, like an angle at r = 0, has no definite motion
            return True
        motion = mp.zeros(2 * count)
        of_place, of_rate = inverse * stiffness, inverse * damping
        for i in range(count):
            motion[i, count + i] = 1
            for k in range(count):
                motion[count + i, k], motion[count + i, count + k] = -of_place[i, k], -of_rate[i, k]
        exponents = mp.eig(motion, left=False, right=False)
        fastest = max(abs(s) for s in exponents)
        return bool(max(mp.re(s) for s in exponents) > fastest * mp.mpf(10) ** -SMALL)


def _is_turned(inertia: Any, damping: Any, stiffness: Any) -> bool:
    """Whether the matrix C, the derivatives with respect to the rates, is not symmetric."""
    return bool(_largest(damping - damping.T) > mp.mpf(10) ** -SMALL * (_largest(damping) + mp.mpf(10) ** -SMALL))


def _largest(matrix: Any) -> Any:
    return max(abs(entry) for entry in matrix)
