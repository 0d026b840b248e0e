"""What must be true for each word that chooses a sentence about small motions with forces linear in the rates.

It is judged in numbers: with numbers for the letters, det(M s^2 + G s + K) is a polynomial in s whose roots are found
numerically, and the word is asked of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from sympy import Dummy, Expr, ImmutableDenseMatrix, Integer, Poly, Rational, prime, re
from sympy.matrices import MatrixBase

from derive.algebra.amplitudes import determinant_of
from derive.algebra.expressions import TIME, Relation, explicit
from derive.algebra.ranges import fulfilling, rational_in_range
from derive.algebra.tidy import tidied
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero

SHIFTS, LITTLE = 20, 1e-9
SCALES = (1, 30, Rational(1, 30), 3, Rational(1, 300))  # so that one letter is large where another is small
S = Dummy("s")


def _numbers(facts: Judged) -> Iterator[dict[Any, Expr]]:
    """Numbers for the letters, where the state exists."""
    matrices = [facts.inputs[role] for role in ("stiffness", "turning", "mass")]
    letters = sorted(set().union(*(each.free_symbols for each in matrices)), key=str)
    for shift in range(SHIFTS):
        drawn = {
            s: rational_in_range(
                s, Rational(prime(3 + (7 * i + 5 * shift) % 23), 11) * SCALES[(shift * (i + 1) + i) % 5]
            )
            for i, s in enumerate(letters)
        }
        drawn = fulfilling(drawn)
        exists = facts.inputs.get("exists")
        if exists is None or _holds(exists, drawn):
            yield drawn


def _holds(condition: Relation, point: dict[Any, Expr]) -> bool:
    difference = explicit(condition.left - condition.right).xreplace(point).evalf(30)
    return bool(difference > 0) == (condition.mark == ">")


def _roots(facts: Judged, point: dict[Any, Expr]) -> list[complex]:
    return _roots_of(*(ImmutableDenseMatrix(facts.inputs[role].xreplace(point)) for role in MATRICES))


MATRICES = ("stiffness", "turning", "mass")


@lru_cache(maxsize=128)
def _roots_of(stiffness: MatrixBase, turning: MatrixBase, mass: MatrixBase) -> list[complex]:
    """All different exponents s."""
    parts = (each.applyfunc(_as_number) for each in (stiffness, turning, mass))
    k, g, m = parts
    matrix = ImmutableDenseMatrix(k + S * g + S**2 * m)
    polynomial = Poly(determinant_of(matrix), S)
    return [complex(root) for root in polynomial.sqf_part().nroots(n=25, maxsteps=200)]


def _as_number(entry: Expr) -> Expr:
    return entry if entry.is_Rational else Rational(str(entry.evalf(40)))


def _is_among(value: complex, roots: list[complex]) -> bool:
    size = max(abs(root) for root in roots) + abs(value)
    return any(abs(value - root) <= LITTLE * size for root in roots)


def _frequency(sign: int | None) -> Predicate:
    def is_so(facts: Judged) -> bool:
        real = []
        for point in _numbers(facts):
            value = complex(explicit(facts.result).xreplace(point).evalf(25))
            exponent = value if sign == -1 else 1j * value
            if not _is_among(exponent, _roots(facts, point)):
                return False
            allowed = all(_holds(c, point) for c in facts.inputs["conditions"])
            positive = abs(value.imag) <= LITTLE * abs(value) and value.real > 0
            if allowed and not positive:
                return False
            real.append(positive)
        return sign is None or all(real)

    return is_so


def _free(facts: Judged) -> bool:
    return is_zero(facts.result) and all(_is_among(0j, _roots(facts, point)) for point in _numbers(facts))


def _steady(facts: Judged, point: dict[Any, Expr]) -> bool:
    """Whether all exponents are imaginary."""
    roots = _roots(facts, point)
    size = max(abs(root) for root in roots)
    return all(abs(root.real) <= LITTLE * size for root in roots)


def _always(steady: bool) -> Predicate:
    return lambda facts: all(_steady(facts, point) == steady for point in _numbers(facts))


def _depends(facts: Judged) -> bool:
    """All conditions together hold just where nothing grows; on their borders nothing is said."""
    conditions = facts.inputs["conditions"]
    points = [n for n in _numbers(facts) if not any(is_zero(explicit(c.residual).xreplace(n)) for c in conditions)]
    tried = [(all(_holds(c, n) for c in conditions), _steady(facts, n)) for n in points]
    return all(told == found for told, found in tried) and facts.result in conditions


def _is_among_conditions(facts: Judged, place: int) -> bool:
    """Whether it has this place among several."""
    conditions = facts.inputs["conditions"]
    return len(conditions) > 1 and bool(facts.result == conditions[place])


def _moving(facts: Judged) -> list[Expr]:
    return [entry for entry in facts.result if not is_zero(entry)]


def _at_quarters(facts: Judged) -> list[tuple[list[float], list[float]]]:
    """Where the two that move are at the beginning, and a little later, in numbers."""
    found = []
    for point in _numbers(facts):
        entries = [explicit(entry).xreplace(point) for entry in _moving(facts)]
        at = [[float(re(e.subs(TIME, t).evalf(20))) for e in entries] for t in (Integer(0), Rational(1, 10**6))]
        found.append((at[0], at[1]))
    return found


def _sense(wanted: int | None, circle: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        if len(_moving(facts)) != 2:
            return False
        turned = {1 if a[0] * b[1] - a[1] * b[0] > 0 else -1 for a, b in _at_quarters(facts)}
        first, second = _moving(facts)
        steady = is_zero(explicit(first**2 + second**2).diff(TIME))
        return steady == circle and (wanted is None or turned == {wanted})

    return is_so


def _departing(facts: Judged) -> bool:
    """All that move grow at one rate, which is real and positive."""
    rates = {tidied(entry.diff(TIME) / entry) for entry in map(explicit, _moving(facts))}
    (rate, *others) = rates
    return not others and not rate.has(TIME) and all(rate.xreplace(n).evalf(20) > 0 for n in _numbers(facts))


def _straight(facts: Judged) -> bool:
    """All that move vanish together."""
    first, *others = _moving(facts)
    return all(is_zero((other / first).diff(TIME)) for other in others)


def _sign_of_product(wanted: int) -> Predicate:
    def is_so(facts: Judged) -> bool:
        if len(facts.result) != 2:
            return False
        products = {(facts.result[0] * facts.result[1]).xreplace(n).evalf(20) for n in _numbers(facts)}
        return all(value * wanted > 0 for value in products)

    return is_so


def _damped(sign: int | None) -> Predicate:
    """-beta +- i omega are roots: with omega real, or imaginary."""

    def is_so(facts: Judged) -> bool:
        for point in _numbers(facts):
            beta = complex(explicit(facts.inputs["beta"]).xreplace(point).evalf(25))
            value = complex(explicit(facts.result).xreplace(point).evalf(25))
            turned = value if sign == -1 else 1j * value
            real = abs(value.imag) <= LITTLE * abs(value)
            roots = _roots(facts, point)
            if not (_is_among(-beta + turned, roots) and _is_among(-beta - turned, roots)):
                return False
            if sign is not None and not real or any(_holds(c, point) != real for c in facts.inputs["conditions"]):
                return False
        return bool(facts.inputs["conditions"]) == (sign is None)

    return is_so


def _rate(kind: str) -> Predicate:
    """Whether it is half the sum of two roots, or a root itself, with the other sign."""

    def is_so(facts: Judged) -> bool:
        for point in _numbers(facts):
            value, roots = complex(explicit(facts.result).xreplace(point).evalf(25)), _roots(facts, point)
            halves = [(a + b) / 2 for i, a in enumerate(roots) for b in roots[:i]]
            if not _is_among(-value, halves if kind == "oscillator" else roots):
                return False
            if kind != "oscillator" and (value.real > 0) != (kind == "decay"):
                return False
        return True

    return is_so


def _has_turning(facts: Judged) -> bool:
    return not all(is_zero(entry) for entry in facts.inputs["turning"])


_TABLE: dict[str, dict[str, Predicate]] = {
    "vibrations.gyroscopic_characteristic": {"generic": _has_turning, "plain": lambda facts: not _has_turning(facts)},
    "vibrations.gyroscopic_frequency": {
        "oscillating": _frequency(1),
        "growing": _frequency(-1),
        "free": _free,
        "conditional": _frequency(None),
    },
    "vibrations.gyroscopic_motion": {
        "departing": _departing,
        "circle_forwards": _sense(1, circle=True),
        "circle_backwards": _sense(-1, circle=True),
        "ellipse_forwards": _sense(1, circle=False),
        "ellipse_backwards": _sense(-1, circle=False),
        "ellipse": _sense(None, circle=False),
        "straight": _straight,
        "generic": lambda facts: len(_moving(facts)) > 2,
    },
    "vibrations.gyroscopic_stability": {
        "stable": _always(True),
        "unstable": _always(False),
        "depends": lambda facts: _depends(facts) and len(facts.inputs["conditions"]) == 1,
        "first": lambda facts: _depends(facts) and _is_among_conditions(facts, 0),
        "further": lambda facts: _depends(facts) and facts.result in facts.inputs["conditions"][1:-1],
        "last": lambda facts: _depends(facts) and _is_among_conditions(facts, -1),
    },
    "vibrations.damped_characteristic": {
        "one": lambda facts: Poly(facts.result.left, facts.inputs["exponent"]).degree() == 2,
        "several": lambda facts: Poly(explicit(facts.result.left), facts.inputs["exponent"]).degree() > 2,
    },
    "vibrations.damped_rate": {kind: _rate(kind) for kind in ("oscillator", "decay", "growth")},
    "vibrations.damped_frequency": {"oscillating": _damped(1), "conditional": _damped(None), "overdamped": _damped(-1)},
    "vibrations.damped_shape": {
        "in_phase": _sign_of_product(1),
        "opposite": _sign_of_product(-1),
        "generic": lambda facts: len(facts.result) > 1,
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
