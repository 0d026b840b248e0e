"""What must be true for each word that chooses a sentence about states of rest and their stability.

It is judged in numbers: with numbers for the letters a value is real or it is not, and a curvature has a sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import combinations_with_replacement
from typing import Any

from mpmath import mp
from sympy import (
    Abs,
    Dummy,
    Expr,
    Function,
    Mul,
    Poly,
    Pow,
    Rational,
    default_sort_key,
    factor_list,
    gcd_list,
    im,
    lambdify,
    prime,
    together,
)
from sympy.matrices import MatrixBase

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import Relation, explicit, rate
from derive.algebra.ranges import fulfilling, has_meaning, rational_in_range
from derive.mechanics.outcomes.growth import grows_always, inertia_is_positive, is_turned_aside, matter_of
from derive.mechanics.outcomes.on_constraints import signs_on_constraints
from derive.mechanics.outcomes.searched import none_is_missing
from derive.mechanics.outcomes.signs import always_sign, lasts, may_be_negative, same_equation, vanishes
from derive.mechanics.rest.counting import is_countable
from derive.steps.known_numbers import sign_known
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.record import assumed, assumed_in_words
from derive.steps.step import is_zero

SHIFTS = 24
LITTLE = Rational(1, 10**12)


def _numbers(letters: set[Any]) -> Iterator[dict[Any, Expr]]:
    """Numbers for the letters, one large where another is small, of all the orders that they may have.

    A letter that may be negative is so in some of them.
    """
    ordered = sorted(letters, key=str)
    for shift in range(SHIFTS):
        drawn = [Rational(prime(2 + (11 * i + 5 * shift + i * shift) % 29), 7 + i) for i in range(len(ordered))]
        turned = [-1 if may_be_negative(s) and shift >> i % 4 & 1 else 1 for i, s in enumerate(ordered)]
        numbers = zip(ordered, drawn, turned, strict=True)
        yield fulfilling({s: turn * rational_in_range(s, number) for s, number, turn in numbers})


def _entries(value: Any) -> list[Expr]:
    return list(value) if isinstance(value, MatrixBase) else [value]


def _is_real(value: Any, point: dict[Any, Expr]) -> bool:
    return all(abs(im(entry.xreplace(point).evalf(30))) < LITTLE for entry in _entries(value))


def _holds(condition: Relation, point: dict[Any, Expr]) -> bool:
    difference = explicit(condition.left - condition.right).xreplace(point).evalf(30)
    return bool(difference > 0) == (condition.mark == ">")


def _letters(facts: Judged) -> set[Any]:
    found = set().union(*(entry.free_symbols for entry in (*_entries(facts.result), *_sided_forces(facts))))
    found -= set(facts.inputs.get("sought", ()))
    exists = facts.inputs.get("exists")
    return found | (set(exists.free_symbols) if exists is not None else set())


def _is_there(facts: Judged, point: dict[Any, Expr]) -> bool:
    """It is real, what is a distance is positive, and no force is left there."""
    if not _is_real(facts.result, point):
        return False
    entries = _entries(facts.result)
    if not all(entries[int(i)].xreplace(point).evalf(30) > 0 for i in facts.inputs["distances"]):
        return False
    there = dict(zip(facts.inputs["sought"], entries, strict=False))
    return all(abs(force.xreplace(there).xreplace(point).evalf(30)) < LITTLE for force in _sided_forces(facts))


def _sided_forces(facts: Judged) -> list[Expr]:
    """The forces that have another formula on each side of a place, as that of a spring along a line."""
    sought = facts.inputs.get("sought", ())
    if len(sought) != len(_entries(facts.result)):
        return []
    return [force for i in range(len(sought)) if (force := _force(facts, i)).has(Abs)]


def _force(facts: Judged, i: int) -> Expr:
    return explicit(facts.inputs[f"condition_{i}"].residual)


def _anywhere(facts: Judged) -> bool:
    """It is there whatever the numbers, and no condition is told."""
    return "exists" not in facts.inputs and all(_is_there(facts, n) for n in _numbers(_letters(facts)))


def _several(facts: Judged) -> bool:
    return bool(facts.inputs["count"] > 1)


def _under_its_condition(facts: Judged) -> bool:
    """It is there just where the condition holds, which some of the numbers fulfil and some do not."""
    if "exists" not in facts.inputs:
        return False
    tried = [(_holds(facts.inputs["exists"], n), _is_there(facts, n)) for n in _numbers(_letters(facts))]
    return all(holds == real for holds, real in tried) and {holds for holds, _ in tried} == {True, False}


def _all_are_told(facts: Judged) -> bool:
    """Of several coordinates no place without a force is left out; of one all are counted by a route."""
    sought = facts.inputs["sought"]
    if is_countable(sought):
        return True
    forces = tuple(_force(facts, i) for i in range(len(sought)))
    return none_is_missing(forces, sought, facts.inputs["angles"], facts.inputs["states"])


# --- stability ---


def _moving(facts: Judged) -> tuple[Any, ...]:
    return tuple(facts.inputs["coordinates"])


def _letters_here(facts: Judged) -> list[Any]:
    of_energy = facts.inputs["potential_here"].free_symbols | set().union(
        *(value.free_symbols for value in facts.inputs["place"])
    )
    return sorted((_letters(facts) | of_energy) - set(_moving(facts)), key=str)


def _signs_by_numbers(facts: Judged) -> list[tuple[dict[Any, Expr], int]]:
    """Some numbers for the letters, where the state exists, and how the energy changes there to second order."""
    exists, letters = facts.inputs.get("exists"), _letters_here(facts)
    points = [n for n in _numbers(set(letters)) if exists is None or _holds(exists, n)]
    numbers = tuple(tuple(point[s] for s in letters) for point in points)
    signs = _signs_at(facts.inputs["potential_here"], _moving(facts), facts.inputs["place"], tuple(letters), numbers)
    return list(zip(points, signs, strict=True))


@lru_cache(maxsize=16)  # the predicates of one outcome ask for the same
def _signs_at(
    potential: Expr, moving: tuple[Any, ...], there: tuple[Expr, ...], letters: tuple[Any, ...], numbers: Any
) -> list[int]:
    energy = lambdify([*letters, *moving], potential, "mpmath", dummify=True)
    place = lambdify(letters, list(there), "mpmath")
    with mp.workdps(50):
        found = []
        for point in numbers:
            known = [mp.mpf(int(number.p)) / int(number.q) for number in point]
            found.append(_second_order(lambda *at, known=known: energy(*known, *at), place(*known)))
    return found


def _signs(facts: Judged) -> set[int]:
    return {sign for _, sign in _signs_by_numbers(facts)}


def _second_order(energy: Callable[..., Any], place: Sequence[Any]) -> int:
    """1 where the energy rises in all directions, -1 where it falls in one, 0 where it rises in all but some.

    Nothing is differentiated: the energy is compared a little to all sides, which gives the matrix of second order,
    and its least eigenvalue has that sign, each coordinate being measured in a size of its own.
    """
    step, here, size = mp.mpf(10) ** -12, energy(*place), len(place)

    def gained(*ways: int) -> Any:
        moved = [x + step * way for x, way in zip(place, ways, strict=True)]
        return (energy(*moved) - here) / step**2

    def twice(i: int, j: int) -> Any:
        """The second order along the sum of two directions."""
        way = [int(k == i) + int(k == j and j != i) for k in range(size)]
        return gained(*way) + gained(*(-w for w in way))

    alone = [mp.re(twice(i, i)) for i in range(size)]
    matrix = mp.matrix(size, size)
    for i, j in combinations_with_replacement(range(size), 2):
        matrix[i, j] = matrix[j, i] = alone[i] if i == j else (mp.re(twice(i, j)) - alone[i] - alone[j]) / 2
    noise = (abs(here) + mp.mpf(10) ** -6) * mp.mpf(10) ** -16
    rough = [max(abs(matrix[i, j]) for j in range(size)) for i in range(size)]
    kept = [i for i in range(size) if rough[i] > noise]
    scaled = mp.matrix(len(kept), len(kept))
    for m, i in enumerate(kept):
        for n, j in enumerate(kept):
            scaled[m, n] = matrix[i, j] / mp.sqrt(rough[i] * rough[j])
    least = min(mp.eigsy(scaled, eigvals_only=True)) if kept else mp.mpf(0)
    if least < -(mp.mpf(10) ** -12):
        return -1
    return 1 if least > mp.mpf(10) ** -12 and len(kept) == size else 0


def _always(sign: int) -> Predicate:
    return lambda facts: _signs(facts) == {sign}


def _runs_away(facts: Judged) -> bool:
    """Where the energy falls to some side the motion grows; what turns the motion aside would hold it all the same."""
    matter = matter_of(facts.quantities["potential"])
    falling = [numbers for numbers, sign in _signs_by_numbers(facts) if sign == -1]
    return matter is None or grows_always(matter, _at_rest(facts), falling)


def _kinetic_energy_is_positive(facts: Judged) -> bool:
    """A minimum of the potential energy is stable only then; numbers without a meaning do not count."""
    matter = matter_of(facts.quantities["potential"])
    there = [numbers for numbers, _ in _signs_by_numbers(facts) if has_meaning(numbers)]
    return matter is None or inertia_is_positive(matter, _at_rest(facts), there)


def _falls_as_told(facts: Judged) -> bool:
    """The energy along a straight line through the state of rest, in the direction that is told, and its curvature."""
    along, told = Dummy("s"), facts.inputs["falling"]
    moved = zip(_moving(facts), facts.inputs["place"], _entries(explicit(facts.inputs["direction"])), strict=True)
    energy = facts.inputs["potential_here"].subs({q: at + along * way for q, at, way in moved}, simultaneous=True)
    curvature = derivative(energy, along, 2).subs(along, 0)
    return is_zero(curvature - told) and bool(always_sign(-1, lambda _: told)(facts))


def _nothing_turns_it(facts: Judged) -> bool:
    matter = matter_of(facts.quantities["potential"])
    there = [numbers for numbers, _ in _signs_by_numbers(facts)]
    return matter is None or not is_turned_aside(matter, _at_rest(facts), there)


def _numbers_here(facts: Judged) -> list[dict[Any, Expr]]:
    return list(_numbers(set(_letters_here(facts))))


def _at_rest(facts: Judged) -> dict[Any, Expr]:
    return dict(zip(_moving(facts), facts.inputs["place"], strict=True))


def _both(*predicates: Predicate) -> Predicate:
    return lambda facts: all(predicate(facts) for predicate in predicates)


def _higher(kind: str) -> Predicate:
    """To second order it is level; the first derivative that is not zero tells what it is."""

    def is_so(facts: Judged) -> bool:
        if not all(is_zero(entry) for entry in _entries(facts.result)):
            return False
        return len(_moving(facts)) == 1 and kind_of_order(facts.inputs["potential_here"], facts) == kind

    return is_so


def _undecided(facts: Judged) -> bool:
    """No order decides; the sentence tells of the derivative whose sign is not known, where there is one."""
    return bool(_higher("open" if "higher" in facts.inputs else "flat")(facts))


def kind_of_order(value: Expr, facts: Judged) -> str:
    (q,), (place,) = _moving(facts), facts.inputs["place"]
    for order in range(2, 9):
        there = derivative(value, q, order).xreplace({q: place})
        if not is_zero(there):
            signs = {1 if there.xreplace(n).evalf(20) > 0 else -1 for n in _numbers(there.free_symbols)}
            if order % 2 or signs == {-1}:
                return "unstable"
            return "stable" if signs == {1} else "open"
    return "flat"


def _depends(border: str | None) -> Predicate:
    """The sign is not one for all numbers; the condition that is told holds just where it is positive."""

    def is_so(facts: Judged) -> bool:
        condition, where = facts.inputs["condition"], facts.inputs.get("at_border")
        tried = [(_holds(condition, numbers), sign) for numbers, sign in _signs_by_numbers(facts)]
        fits = all(holds == (sign == 1) for holds, sign in tried if sign) and len({holds for holds, _ in tried}) == 2
        if border is None or where is None or not fits:
            return fits and where is None and border is None
        there = facts.inputs["potential_here"].subs(where.left, where.right)
        return kind_of_order(there, facts) == border

    return is_so


def _bordered(border: str | None) -> Predicate:
    """Whether the border belongs to it, by the order that decides there."""

    def is_so(facts: Judged) -> bool:
        where = facts.inputs.get("at_border")
        if where is None or border is None:
            return where is None and border is None and facts.result.mark in (">", "<")
        there = facts.inputs["potential_here"].subs(where.left, where.right)
        return kind_of_order(there, facts) == border and facts.result.mark.endswith("=") == (border == "stable")

    return is_so


def _is_at_rest(facts: Judged) -> bool:
    """No rate is left in it."""
    return not explicit(facts.result).has(*map(rate, facts.inputs["coordinates"]))


def _is_what_the_lagrangian_has(facts: Judged) -> bool:
    """Whether nothing of it comes from elsewhere: V + L is of the rates alone, and vanishes with them."""
    moving = [rate(q, n) for q in facts.inputs["coordinates"] for n in (1, 2)]
    whole = explicit(facts.result + facts.inputs["lagrangian"])
    return is_zero(whole.subs(dict.fromkeys(moving, 0)))


def _higher_lasts(facts: Judged) -> bool:
    """The first derivative that does not vanish does not."""
    return "higher" not in facts.inputs or not is_zero(facts.inputs["higher"])


def _sides_as_told(facts: Judged) -> bool:
    """A side of a place is spoken of just where one is assumed, and springs where words assume it."""
    sides = [each for each in assumed() if each.mark == ">" and explicit(each.residual).has(*facts.inputs["sought"])]
    in_words = set(assumed_in_words()).issuperset(sides)
    return facts.words["seen"] == ("any" if not sides else "stretched" if in_words else "one_side")


def _level_as_told(facts: Judged) -> bool:
    """Where the force vanishes whatever the coordinate is, no place is distinguished: just these letters are excluded.

    All coefficients of the force, as a polynomial in what holds the coordinate, have a factor in common.
    """
    told, sought = facts.inputs.get("excluded"), facts.inputs["sought"]
    if len(sought) > 1:
        return told is None
    (q,) = sought
    force = together(explicit(facts.inputs["condition_0"]).residual).as_numer_denom()[0]
    marks = {f: Dummy() for f in sorted(force.atoms(Function, Pow), key=default_sort_key, reverse=True) if f.has(q)}
    common = gcd_list(Poly(force.xreplace(marks).xreplace({q: marks.get(q, q)}), q, *marks.values()).coeffs())
    open_ = Mul(*(f for f, _ in factor_list(common)[1] if sign_known(f) is None and not f.is_nonzero))
    if not open_.free_symbols:
        return told is None
    return told is not None and told.mark == "!=" and same_equation(told.residual, open_)


_TABLE: dict[str, dict[str, Predicate]] = {
    "rest.potential_at_rest": {
        "generic": _both(_is_at_rest, _is_what_the_lagrangian_has),
        "pushed": _both(_is_at_rest, lambda facts: not _is_what_the_lagrangian_has(facts)),
    },
    "rest.condition": {
        "generic": lambda facts: lasts(_residual(facts)),
        "zero": lambda f: vanishes(_residual(f)),
    },
    "rest.equilibrium": {
        "only": _both(_anywhere, lambda facts: not _several(facts), _all_are_told, _sides_as_told, _level_as_told),
        "always": _both(_anywhere, _several, _all_are_told, _sides_as_told, _level_as_told),
        "where": _both(_under_its_condition, _all_are_told, _sides_as_told, _level_as_told),
    },
    "rest.stability": {
        "stable": _both(_always(1), _kinetic_energy_is_positive),
        "unstable": _both(_always(-1), _runs_away),
        "stable_by_higher_order": _both(_higher("stable"), _higher_lasts),
        "unstable_by_higher_order": _both(_higher("unstable"), _nothing_turns_it, _higher_lasts),
        "flat": _both(_undecided, _nothing_turns_it),
        "depends": _both(_depends(None), _runs_away),
        "depends_stable_on_border": _both(_depends("stable"), _runs_away, _higher_lasts),
        "depends_unstable_on_border": _both(_depends("unstable"), _runs_away, _higher_lasts),
    },
    "rest.stable_where": {
        "with_border": _bordered("stable"),
        "without_border": _bordered("unstable"),
        "open": _bordered(None),
    },
    "rest.stability_of_several": {
        "stable": _both(_always(1), _kinetic_energy_is_positive),
        "unstable": _both(_always(-1), _runs_away),
        "unstable_along": _both(_always(-1), _runs_away, _falls_as_told),
        "level": _both(_always(0), _nothing_turns_it),
        "depends": _both(lambda facts: len(_signs(facts)) > 1, _runs_away),
    },
    "rest.stability_on_constraints": {
        word: lambda facts, sign=sign: signs_on_constraints(facts, _numbers_here(facts)) == sign
        for word, sign in (("stable", {1}), ("unstable", {-1}), ("level", {0}))
    }
    | {"depends": lambda facts: len(signs_on_constraints(facts, _numbers_here(facts))) > 1},
}


def _residual(facts: Judged) -> Judged:
    return Judged(facts.result.residual)


for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
