"""Numerical integrals over a body, for random values of its symbols. They check exact integrals.

The size of a cell is the square root of det(r_i . r_j), from the scalar products of the edges. The integral over each
variable x uses Gauss's rule in t. Here x = m - h cos(pi t), m is the midpoint of the interval, and h is half of its
length. Square roots that vanish at an end of the interval are smooth in t.
Source: Press, Teukolsky, Vetterling, Flannery, *Numerical Recipes*, 3rd edition, section 4.6.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from math import cos, isfinite, pi, sin, sqrt
from random import Random
from typing import Any

from mpmath import mp
from sympy import Expr, ImmutableDenseMatrix, Symbol, diff, lambdify
from sympy.matrices import ImmutableMatrix

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import explicit
from derive.mechanics.bodies.mapping import inside, letters_in_order
from derive.mechanics.bodies.regions import Bounds

LETTERS = 2  # number of sets of random numbers for the symbols
NODES = {1: 60, 2: 28, 3: 20}  # number of variables -> number of nodes for each variable
FIGURES = 7
DIGITS = 36  # working digits for the edges of small cells, which are differences of positions


@lru_cache(maxsize=8)
def _gauss(n: int) -> tuple[tuple[float, float], ...]:
    """Nodes and weights of Gauss's rule on 0 to 1, from the roots of Legendre's polynomial by Newton's method."""
    found = []
    for k in range(n):
        x = cos(pi * (k + 0.75) / (n + 0.5))
        slope = 1.0
        for _ in range(50):
            now, before = 1.0, 0.0
            for j in range(1, n + 1):
                now, before = ((2 * j - 1) * x * now - (j - 1) * before) / j, now
            slope = n * (x * now - before) / (x * x - 1)
            x, step = x - now / slope, abs(now / slope)
            if step < 1e-16:
                break
        found.append(((1 - x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return tuple(found)


def metric(position: ImmutableMatrix, names: Sequence[Symbol]) -> Expr:
    """det(r_i . r_j): the square of the length, area or volume of a cell, divided by the squares of the
    differentials."""
    edges = ImmutableDenseMatrix.hstack(*(ImmutableDenseMatrix(diff(position, u)) for u in names))
    return (edges.T * edges).det(method="berkowitz")


def over_cells(
    position: ImmutableMatrix, limits: Bounds, values: Sequence[Expr], letters: Sequence[Symbol]
) -> Callable[[Mapping[Symbol, Expr]], list[float]]:
    """Return a function that computes the integrals of the given functions over the body from values of the symbols."""
    names = [x for x, _, _ in limits]
    ends = [lambdify([*letters, *names[:i]], both, "math") for i, (_, *both) in enumerate(limits)]
    integrand: Callable[..., list[float]] = lambdify(
        [*letters, *names], [metric(position, names), *values], "math", cse=True
    )
    rule = [((1 - cos(pi * t)) / 2, share * pi * sin(pi * t) / 2) for t, share in _gauss(NODES[len(limits)])]

    def summed(at: Mapping[Symbol, Expr]) -> list[float]:
        totals, known = [0.0] * len(values), [float(at[s]) for s in letters]

        def further(places: tuple[float, ...], weight: float) -> None:
            if len(places) == len(names):
                square, *found = integrand(*known, *places)
                size = weight * sqrt(max(square, 0.0))
                for i, value in enumerate(found):
                    totals[i] += size * value
                return
            low, high = ends[len(places)](*known, *places)
            for part, share in rule:
                further((*places, low + (high - low) * part), weight * share * (high - low))

        further((), 1.0)
        return totals

    return summed


def _entries(of: Any) -> list[Any]:
    return list(of) if hasattr(of, "shape") or isinstance(of, list) else [of]


def agrees(value: Any, integrands: Any, position: ImmutableMatrix, limits: Bounds) -> Verdict:
    """Whether an exact value, or each entry of a matrix, agrees with a numerical sum over cells.

    integrands   for each entry, an expression in the variables and the symbols
    """
    entries, wanted = ([explicit(e) for e in _entries(those)] for those in (value, integrands))
    names = {x for x, _, _ in limits}
    letters = {s for e in (*entries, *wanted, *position) for s in e.free_symbols} - names
    letters |= {s for _, *ends in limits for end in ends for s in end.free_symbols} - names
    source, ordered = Random(len(letters)), sorted(letters, key=str)
    sums_at = over_cells(position, limits, [*wanted, *(abs(f) for f in wanted)], ordered)
    for _ in range(LETTERS if letters else 1):
        at = letters_in_order(limits, ordered, source)
        sums = sums_at(at)
        for entry, total, size in zip(entries, sums, sums[len(wanted) :], strict=False):
            here = entry.xreplace(at)
            found = complex(here.evalf()) if not here.free_symbols else complex("nan")
            if not isfinite(found.real) or abs(found - total) > 10**-FIGURES * max(size, 1e-30):
                where = tuple((str(name), str(number)) for name, number in at.items())
                return Verdict(Grade.REFUTED, f"{found.real:.6g} against {total:.6g}", where)
    return Verdict(Grade.SAMPLED, f"{LETTERS if letters else 1} points to {FIGURES} figures")


def spanned(found: Expr, position: ImmutableMatrix, limits: Bounds) -> Verdict:
    """Whether the signed volume of a cell agrees with the signed volume that the edges of small cells span.

    The edges are differences of positions, at random points between the limits: no formula is differentiated.
    """
    names = [x for x, _, _ in limits]
    value = explicit(found)
    letters = sorted((value.free_symbols | position.free_symbols) - set(names), key=str)
    place = lambdify([*names, *letters], list(position), "mpmath", dummify=True)
    size = lambdify([*names, *letters], value, "mpmath", dummify=True)
    with mp.workdps(DIGITS):
        for at in inside(limits, letters):
            here, known = ([mp.mpf(str(at[s].evalf(DIGITS))) for s in those] for those in (names, letters))
            edges = [_edge(lambda *u, known=known: place(*u, *known), here, k) for k in range(len(names))]
            volume, told = mp.det(mp.matrix(edges)), size(*here, *known)
            if not abs(told - volume) <= mp.mpf(10) ** -FIGURES * (abs(told) + abs(volume)):
                where = tuple((str(name), str(number)) for name, number in at.items())
                return Verdict(Grade.REFUTED, f"{mp.nstr(told, 6)} against {mp.nstr(volume, 6)}", where)
    return Verdict(Grade.SAMPLED, f"edges to {FIGURES} figures")


def _edge(place: Callable[..., Any], here: Sequence[Any], k: int) -> list[Any]:
    """The derivative of the position with respect to variable k, by a central difference."""
    step = mp.mpf(10) ** -(DIGITS // 3)
    ends = ([x + turn * step * (i == k) for i, x in enumerate(here)] for turn in (1, -1))
    return [(one - other) / (2 * step) for one, other in zip(*(place(*end) for end in ends), strict=True)]
