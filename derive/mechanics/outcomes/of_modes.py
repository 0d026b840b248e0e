"""What must be true for each word that chooses a sentence about linear equations and their modes.

Frequencies are judged in numbers: with some positive numbers for the letters, det(K - lambda M) is a polynomial in one
unknown, and it is asked whether it vanishes at the square of what was found, and whether its slope does.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import islice

from sympy import Abs, Dummy, Expr, I, ImmutableDenseMatrix, Integer, Poly, Rational, prime

from derive.algebra.amplitudes import determinant_of
from derive.algebra.expressions import explicit, rate
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.ranges import rational_in_range
from derive.mechanics.outcomes.signs import always_sign, lasts, turned, vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of, told_by
from derive.steps.step import is_zero

LITTLE = Rational(1, 10**15)


def _numbers(facts: Judged) -> Iterator[dict[Expr, Expr]]:
    """Numbers for the letters, from one scale to another and of both signs; of a letter with a range those of it."""
    letters = sorted(facts.inputs["stiffness"].free_symbols | facts.inputs["mass"].free_symbols, key=str)
    drawn = (
        turned(
            {
                s: rational_in_range(s, Rational(prime(4 + (5 * i + 3 * shift + i * shift) % 17), 3 + (i + shift) % 4))
                for i, s in enumerate(letters)
            },
            shift,
        )
        for shift in range(40)
    )
    yield from islice((numbers for numbers in drawn if _exists(facts, numbers)), 5)


def _exists(facts: Judged, numbers: dict[Expr, Expr]) -> bool:
    """Whether these numbers fulfil the condition under which there is the state of rest."""
    condition = facts.inputs.get("exists")
    if condition is None:
        return True
    difference = condition.residual.xreplace(numbers)
    return bool(difference > 0 if condition.mark == ">" else difference < 0)


def _polynomial(facts: Judged, numbers: dict[Expr, Expr]) -> Poly:
    """det(K - lambda M) with numbers for the letters."""
    stiffness, mass = (ImmutableDenseMatrix(facts.inputs[role].xreplace(numbers)) for role in ("stiffness", "mass"))
    return _determinant(stiffness, mass)


@lru_cache(maxsize=64)  # each frequency and each shape of a system asks for the same few
def _determinant(stiffness: ImmutableDenseMatrix, mass: ImmutableDenseMatrix) -> Poly:
    unknown = Dummy("lambda")
    return Poly(determinant_of(stiffness - unknown * mass), unknown)


def _vanishes_at(polynomial: Poly, place: Expr) -> bool:
    value = polynomial.eval(place.evalf(40))
    size = sum((Abs(c * place.evalf(40) ** n) for (n,), c in polynomial.terms()), Integer(0))
    return bool(Abs(value) <= LITTLE * size)


def _is_root(square: Expr, facts: Judged, times: int | None) -> bool:
    """Whether det(K - lambda M) vanishes there; once, or as often as its slope does too."""
    for numbers in _numbers(facts):
        polynomial, place = _polynomial(facts, numbers), explicit(square.xreplace(numbers))
        several = _vanishes_at(polynomial.diff(), place)
        if not _vanishes_at(polynomial, place) or times is not None and several != (times > 1):
            return False
    return True


def _sign_everywhere(value: Expr, facts: Judged) -> int | None:
    """The sign at all points that were tried, if it is one."""
    signs = set()
    for numbers in _numbers(facts):
        there = explicit(value.xreplace(numbers)).evalf(30)
        signs.add(0 if is_zero(value) else 1 if there.is_positive else -1 if there.is_negative else None)
    return signs.pop() if len(signs) == 1 else None


def _frequency(sign: int | None, repeated: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        square = -(facts.result**2) if sign == -1 else facts.result**2
        decided = sign is None or _sign_everywhere(square, facts) == sign
        return decided and _is_not_negative(facts) and _is_root(square, facts, 2 if repeated else 1)

    return is_so


def _is_in_order(whole: bool) -> Predicate:
    """Whether it is a root of the determinant, and the number of its letter is that of its place, by Sturm's theorem,
    among all roots, or among those of a factor of lower degree."""

    def is_so(facts: Judged) -> bool:
        square = facts.result**2
        if not isinstance(square, OrderedRoot):
            return False
        place, size = int(str(square.name).rpartition("_")[2]), facts.inputs["stiffness"].shape[0]
        unknown = Dummy("lambda")
        for numbers in _numbers(facts):
            factor = Poly([each.xreplace(numbers) for each in square.args[0]], unknown)
            below = Rational(str(explicit(square.xreplace(numbers)).evalf(40) * (1 - LITTLE)))
            own = _polynomial(facts, numbers) if whole else factor
            if own.count_roots(sup=below) != place - 1 or (factor.degree() == size) != whole:
                return False
        return _is_root(square, facts, 1) and _sign_everywhere(square, facts) == 1

    return is_so


def _is_not_negative(facts: Judged) -> bool:
    """Of the two roots of a square the frequency is that which is not negative, wherever it is real."""
    there = [explicit(facts.result.xreplace(numbers)).evalf(30) for numbers in _numbers(facts)]
    return not any(value.is_negative or (value / I).is_negative for value in there)


def _of_pair(same: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        if len(facts.result) != 2:
            return False
        product = facts.result[0] * facts.result[1]
        return _sign_everywhere(product, facts) == (1 if same else -1) and _oscillates(facts)

    return is_so


def _alone(facts: Judged) -> bool:
    moving = [entry for entry in facts.result if not is_zero(entry)]
    return len(facts.result) == 2 and len(moving) == 1 and _oscillates(facts)


def _oscillates(facts: Judged) -> bool:
    return not is_zero(facts.inputs["squared"]) and always_sign(-1, lambda f: f.inputs["squared"])(facts) is False


def _repeated(facts: Judged) -> bool:
    return _is_root(facts.inputs["squared"], facts, 2)


def _displaced(facts: Judged) -> bool:
    return any(not is_zero(value) for value in facts.inputs["place"])


def _linear(displaced: bool, lossy: bool | None, driven: bool) -> Predicate:
    """At rest or elsewhere, with a drag or without, by what the equation itself holds."""

    def is_so(facts: Judged) -> bool:
        found = _displaced(facts), not is_zero(facts.inputs["loss"]), not is_zero(facts.result.right)
        letters = facts.inputs["displacements"]
        if len(letters) == 1 and explicit(facts.result).left.has(rate(*letters)) != found[1]:
            return False  # of one coordinate the equation itself shows the drag
        return found[0] == displaced and found[2] == driven and lossy in (None, found[1])

    return is_so


def _drifts_as_told(facts: Judged, outcome: str) -> bool:
    """That no force acts to any order needs equations that leave nothing of a uniform motion, in numbers."""
    if "drift" not in facts.inputs:
        return True
    left = facts.inputs["left"]
    letters = sorted(set().union(*(each.free_symbols for each in left)), key=str)
    for n in (1, 2):
        point = {s: rational_in_range(s, Rational(prime(5 + 3 * i + n), 7 + n)) for i, s in enumerate(letters)}
        if any(abs(each.xreplace(point).evalf(30)) > LITTLE for each in left):
            return False
    return bool(left)


_TABLE: dict[str, dict[str, Predicate]] = {
    "vibrations.linearised": {
        "generic": _linear(displaced=False, lossy=False, driven=False),
        "displaced": _linear(displaced=True, lossy=False, driven=False),
        "damped": _linear(displaced=False, lossy=True, driven=False),
        "displaced_damped": _linear(displaced=True, lossy=True, driven=False),
        "driven": _linear(displaced=False, lossy=None, driven=True),
        "displaced_driven": _linear(displaced=True, lossy=None, driven=True),
    },
    "vibrations.superposition": {"generic": lasts, "zero": vanishes},
    "vibrations.mode_frequency": {
        f"{word}{suffix}": _frequency(sign, repeated)
        for word, sign in (("oscillating", 1), ("growing", -1), ("free", 0), ("conditional", None))
        for suffix, repeated in (("", False), ("_repeated", True))
    }
    | {"ordered": _is_in_order(whole=True), "ordered_part": _is_in_order(whole=False)},
    "vibrations.mode_shape": {
        "in_phase": _of_pair(same=True),
        "opposite": _of_pair(same=False),
        "alone": _alone,
        "generic": lambda facts: _oscillates(facts) and not _repeated(facts),
        "uniform": lambda facts: is_zero(facts.inputs["squared"]),
        "departing": always_sign(-1, lambda facts: facts.inputs["squared"]),
        "any_of_several": _repeated,
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
for _rule in ("vibrations.mode_frequency", "vibrations.mode_shape"):
    told_by(_rule, _drifts_as_told)
