"""The change of the potential energy along the constraints, computed numerically without analytical derivatives.

Newton's method moves a point near the equilibrium back to the constraints; then the energies are compared.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mpmath import mp
from sympy import Expr, lambdify

from derive.algebra.ranges import has_meaning
from derive.steps.rule import Judged

DIGITS = 60
STEP = 14  # a small displacement is 10^-STEP
TURNS = 12  # largest number of steps of Newton's method; each step about doubles the number of correct digits


def signs_on_constraints(facts: Judged, points: Sequence[Mapping[Any, Expr]]) -> set[int]:
    """Return the set of the signs of the energy change for the given numbers.

    The sign is 1 if the energy rises along all allowed displacements, and -1 if it falls along at least one. Otherwise
    the energy is constant to second order along some of them, and the sign is 0.
    """
    moving = list(facts.inputs["coordinates"])
    functions = [facts.inputs["potential_here"], *facts.inputs["constraints"]]
    letters = sorted(set().union(*(each.free_symbols for each in functions)) - set(moving), key=str)
    place = facts.inputs["place"]
    letters += sorted(set().union(*(each.free_symbols for each in place)) - set(letters), key=str)
    energy, *conditions = (lambdify([*letters, *moving], each, "mpmath", dummify=True) for each in functions)
    rest = lambdify(letters, list(place), "mpmath", dummify=True)
    found = set()
    with mp.workdps(DIGITS):
        for point in points:
            if has_meaning(point) and all(s in point for s in letters):
                known = [mp.mpf(int(point[s].p)) / int(point[s].q) for s in letters]
                held = [lambda *at, f=f, known=known: f(*known, *at) for f in conditions]
                found.add(_sign(lambda *at, known=known: energy(*known, *at), held, [mp.mpf(x) for x in rest(*known)]))
    return found


def _sign(energy: Callable[..., Any], conditions: Sequence[Callable[..., Any]], place: Sequence[Any]) -> int:
    ways = _allowed(conditions, place)
    here, small = energy(*place), mp.mpf(10) ** -STEP

    def gained(*shares: Any) -> Any:
        """Return the sum of the energy changes for a displacement and for its opposite, divided by the squared step."""
        total = mp.mpf(0)
        for side in (1, -1):
            moved = [
                x + side * small * sum(share * way[i] for share, way in zip(shares, ways, strict=True))
                for i, x in enumerate(place)
            ]
            total += energy(*_returned(conditions, moved)) - here
        return total / small**2

    size = len(ways)
    alone = [gained(*(int(k == i) for k in range(size))) for i in range(size)]
    matrix = mp.matrix(size, size)
    for i in range(size):
        for j in range(size):
            both = gained(*(int(k in (i, j)) for k in range(size))) if i != j else 0
            matrix[i, j] = alone[i] if i == j else (both - alone[i] - alone[j]) / 2
    noise = (abs(here) + 1) * mp.mpf(10) ** -(STEP - 2)
    least = min(mp.eigsy(matrix, eigvals_only=True))
    return 0 if abs(least) < noise else 1 if least > 0 else -1


def _slopes(conditions: Sequence[Callable[..., Any]], place: Sequence[Any]) -> Any:
    step = mp.mpf(10) ** -(DIGITS // 3)
    found = mp.matrix(len(conditions), len(place))
    for i, condition in enumerate(conditions):
        for j in range(len(place)):
            ahead, behind = ([x + side * step * (k == j) for k, x in enumerate(place)] for side in (1, -1))
            found[i, j] = (condition(*ahead) - condition(*behind)) / (2 * step)
    return found


def _allowed(conditions: Sequence[Callable[..., Any]], place: Sequence[Any]) -> list[Any]:
    """Return an orthonormal basis of the displacements that the constraints allow."""
    slopes = _slopes(conditions, place)
    values, vectors = mp.eigsy(slopes.T * slopes)
    largest = max(abs(v) for v in values)
    return [vectors[:, i] for i in range(len(place)) if abs(values[i]) <= largest * mp.mpf(10) ** -(DIGITS // 4)]


def _returned(conditions: Sequence[Callable[..., Any]], place: Sequence[Any]) -> list[Any]:
    """Move a point close to the constraints onto the constraints, along their gradients."""
    at = list(place)
    for _ in range(TURNS):
        left = mp.matrix([condition(*at) for condition in conditions])
        if max(abs(x) for x in left) < mp.mpf(10) ** -(DIGITS - 8):
            break
        slopes = _slopes(conditions, at)
        back = slopes.T * mp.lu_solve(slopes * slopes.T, left)
        at = [x - back[i] for i, x in enumerate(at)]
    return at
