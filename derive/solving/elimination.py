"""The order in which a person solves linear equations: an equation with only one unknown is used first, if there is
one.

Example: M x'' = mu N, M y'' = N - M g, y'' = 0. The last two equations give N, and the first equation then gives x''.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.derivatives import derivative
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.steps.signs import sign_for_all

ZERO = Integer(0)
MOST = 5  # greatest number of equations that are solved together
LONGEST_IN_WORDS = 8  # greatest length of the value of an unknown in a sentence
LONGEST_DETERMINANT = 1500  # greatest length of a determinant, not simplified, whose sign is examined
LONGEST = 20  # greatest length of the value of an unknown that is written in terms of earlier unknowns


@dataclass(frozen=True)
class Isolated:
    """The equations that give an unknown after the earlier unknowns are found.

    equations   the indices of these equations, and of the equations which show that other unknowns in them are zero
    eliminated  the other unknowns of these equations that are not found earlier
    earlier     the unknowns of these equations that are found earlier
    value       the unknown in terms of the earlier unknowns, if one equation gives it and this form is short
    """

    equations: tuple[int, ...]
    eliminated: tuple[Symbol, ...] = ()
    earlier: tuple[Symbol, ...] = ()
    value: Expr | None = None


def isolated_in_order(residuals: Sequence[Expr], unknowns: Sequence[Symbol]) -> dict[Symbol, Isolated]:
    """Return the equations for each unknown, in the order in which the unknowns are found.

    residuals   the equations, linear in the unknowns: residual = 0
    unknowns    the unknowns, in the order in which they should be found

    Unknowns that are zero are left out. An unknown is also left out if no set of at most `MOST` equations determines it
    with a determinant that is known not to vanish.
    """
    slopes = [{u: c for u in unknowns if (c := tidied(derivative(row, u))) != 0} for row in residuals]
    found: dict[Symbol, Isolated] = {}
    vanishing: dict[Symbol, tuple[int, ...]] = {}  # unknown -> the equations which say that it is zero
    while True:
        known = {*found, *vanishing}
        several = _fewest(slopes, known, unknowns, residuals)
        if not several:
            return found
        new = [u for u in unknowns if u not in known and any(u in slopes[i] for i in several)]
        lead = new[0]
        zero = [n for u, them in vanishing.items() if any(u in slopes[i] for i in several) for n in them]
        named = tuple(sorted({*several, *zero}))
        earlier = tuple(u for u in found if any(u in slopes[i] for i in several))
        if len(new) > 1:
            found[lead] = Isolated(named, tuple(new[1:]), earlier)
            continue
        row = residuals[several[0]].xreplace(dict.fromkeys(vanishing, ZERO))
        value = tidied(-row.xreplace({lead: ZERO}) / slopes[several[0]][lead])
        if value == 0:
            vanishing[lead] = named
        else:
            found[lead] = Isolated(named, (), earlier, value if length(value) <= LONGEST else None)


@dataclass(frozen=True)
class Substitution:
    """One equation, solved for an unknown that is then eliminated from the other equations.

    equation   the index of the equation
    unknown    the unknown that is eliminated
    value      this unknown in terms of the other unknowns, with the earlier substitutions made
    """

    equation: int
    unknown: Symbol
    value: Expr


def substitutions(residuals: Sequence[Expr], eliminated: Sequence[Symbol]) -> tuple[Substitution, ...]:
    """Return the substitutions, in order, after which one equation contains none of the eliminated unknowns.

    residuals   the equations, one more than the eliminated unknowns

    The result is empty if no short substitutions are found.
    """
    rows, left = dict(enumerate(residuals)), list(eliminated)
    found: list[Substitution] = []
    while left:
        possible = []
        for i, row in rows.items():
            for u in left:
                slope = tidied(derivative(row, u))
                if slope != 0 and sign_for_all(slope) in (1, -1):
                    possible.append(Substitution(i, u, tidied(-row.xreplace({u: ZERO}) / slope)))
        if not possible:
            return ()
        best = min(possible, key=lambda each: (length(each.value), each.equation))
        others = [row for i, row in rows.items() if i != best.equation]
        if length(best.value) > LONGEST_IN_WORDS or not any(row.has(best.unknown) for row in others):
            return ()
        found.append(best)
        left.remove(best.unknown)
        del rows[best.equation]
        rows = {i: row.xreplace({best.unknown: best.value}) for i, row in rows.items()}
    return tuple(found)


def _fewest(
    slopes: Sequence[dict[Symbol, Expr]], known: set[Symbol], unknowns: Sequence[Symbol], residuals: Sequence[Expr]
) -> tuple[int, ...]:
    """Return the smallest set of coupled equations that determines as many new unknowns as it has equations; an empty
    set if none is found."""
    first = {i: [unknowns.index(u) for u in row if u not in known] for i, row in enumerate(slopes)}
    left = sorted((i for i in first if first[i]), key=lambda i: (min(first[i]), length(residuals[i])))
    for count in range(1, min(len(left), MOST) + 1):
        for several in combinations(left, count):
            new = sorted({u for i in several for u in slopes[i]} - known, key=str)
            if len(new) == count and _are_coupled(slopes, several, new) and _is_regular(slopes, several, new):
                return several
    return ()


def _are_coupled(slopes: Sequence[dict[Symbol, Expr]], several: Sequence[int], new: Sequence[Symbol]) -> bool:
    """Whether each new unknown is in at least two of the equations; True for one equation."""
    return len(several) == 1 or all(len([i for i in several if u in slopes[i]]) > 1 for u in new)


def _is_regular(slopes: Sequence[dict[Symbol, Expr]], several: Sequence[int], new: Sequence[Symbol]) -> bool:
    """Whether the determinant of the equations is known not to vanish. A long determinant is not examined."""
    matrix = ImmutableDenseMatrix([[slopes[i].get(u, ZERO) for u in new] for i in several])
    det = matrix.det(method="berkowitz")
    return length(det) <= LONGEST_DETERMINANT and sign_for_all(tidied(det)) in (1, -1)
