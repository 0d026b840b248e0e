"""Newton's and Euler's equations of bodies in a plane with unknown reactions, in floating-point numbers.

Nothing here uses the engine. Unknowns are named; each equation is a mapping from the names of the unknowns to their
factors, with the key "" for the known part: the sum of factor times unknown plus the known part is zero.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from mpmath import lu_solve, matrix

Vector = tuple[float, float]
Equation = Mapping[str, float]
KNOWN = ""


@dataclass(frozen=True)
class Force:
    """A force on a body: a known part, and a multiple of an unknown; it acts at an arm from the centre of mass."""

    direction: Vector
    arm: Vector = (0.0, 0.0)
    unknown: str = KNOWN


@dataclass(frozen=True)
class Body:
    """A body whose centre of mass has the accelerations `x` and `y`, and whose angular acceleration is `turn`.

    An empty name of an acceleration stands for a direction in which the body is guided and has none; `turn` is positive
    counterclockwise.
    """

    mass: float
    x: str = ""
    y: str = ""
    moment: float = 0.0
    turn: str = ""

    def equations(self, forces: Iterable[Force]) -> list[Equation]:
        acting = list(forces)
        found = []
        for i, name in enumerate((self.x, self.y)):
            if name:
                found.append(_sum((name, -self.mass), *((f.unknown, f.direction[i]) for f in acting)))
        if self.turn:
            found.append(_sum((self.turn, -self.moment), *((f.unknown, cross(f.arm, f.direction)) for f in acting)))
        return found


def _sum(*terms: tuple[str, float]) -> Equation:
    found: dict[str, float] = {}
    for name, factor in terms:
        found[name] = found.get(name, 0.0) + factor
    return found


def cross(a: Vector, b: Vector) -> float:
    return a[0] * b[1] - a[1] * b[0]


def solved(equations: Iterable[Equation]) -> dict[str, float]:
    """Return the values of the unknowns; there must be as many equations as unknowns."""
    rows = list(equations)
    names = sorted({name for row in rows for name in row} - {KNOWN})
    assert len(rows) == len(names), (len(rows), names)
    left = matrix([[row.get(name, 0.0) for name in names] for row in rows])
    right = matrix([-row.get(KNOWN, 0.0) for row in rows])
    return {name: float(value) for name, value in zip(names, lu_solve(left, right), strict=True)}
