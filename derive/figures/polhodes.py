"""The polhodes of a freely rotating body, drawn for its angular momentum: curves of constant energy on a sphere.

In the body, the tip of the angular momentum stays on the sphere |L| = constant and on an ellipsoid of constant energy,
L_x^2/I_x + L_y^2/I_y + L_z^2/I_z = 2 T. The sphere has the radius 1 here. Around the axis p of the least or of the
greatest moment, with the intermediate axis q and the third axis r, the two equations give

    (1/I_p - 1/I_q) n_q^2 + (1/I_p - 1/I_r) n_r^2 = 1/I_p - e

Here n is the unit vector along L, and e is the sum of n_i^2/I_i, which is constant on a curve. So the projection of a
curve along p is an ellipse.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import cos, pi, radians, sin, sqrt
from typing import Any, ClassVar

from sympy import Expr, Integer

from derive.algebra.expressions import AXES, scalar
from derive.algebra.tidy import tidied
from derive.figures.annotations import Axis
from derive.figures.bodies import UNIT
from derive.figures.marks import Mark, Surface
from derive.figures.pieces import InNumbers, Paper, Patch, Piece, Stroke
from derive.figures.space import NOUGHT, Vector, cross, dot, plus, rim, unit
from derive.figures.surfaces import parts_where

# Distances of three curves from the axis that they surround, in degrees, measured towards the intermediate axis.
DISTANCES = (22, 44, 64)
STEPS = 144  # number of steps of a curve
FACING = 0.3  # least cosine of the angle between the line of sight and the normal at an arrowhead
EQUAL = 1e-3  # relative difference of two moments below which they count as equal
EVERY = 8  # only every eighth point of three great circles is used for the size of the drawing
FIRST = 2  # the number that replaces the first letter without a number; the next letters have the next numbers


def polhode_marks(moments: Sequence[Expr], keys: Sequence[str]) -> list[Mark]:
    """Return the sphere with its curves, and the principal axes outside the sphere."""
    one = Integer(1)
    marks: list[Mark] = [PolhodesMark((moments[0], moments[1], moments[2]), keys=tuple(keys))]
    return marks + [
        Axis(one * along, one * along, along, label=scalar(axis)) for along, axis in zip(UNIT, AXES, strict=True)
    ]


def ratios_of(moments: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the moments of inertia, divided by the first one."""
    return tuple(tidied(moment / moments[0]) for moment in moments)


def example_values(moments: Sequence[Expr]) -> dict[Any, Expr]:
    """Return numbers for the symbols on which the ratios of the moments depend."""
    letters = set().union(*(ratio.free_symbols for ratio in ratios_of(moments)))
    order = dict.fromkeys(s for moment in moments for s in sorted(moment.free_symbols, key=str) if s in letters)
    return {letter: Integer(FIRST + i) for i, letter in enumerate(order)}


def order_of(moments: Sequence[float]) -> tuple[int, int, int] | None:
    """Return the indices of the axes with the least, the intermediate and the greatest moment; None if two moments are
    equal."""
    least, middle, greatest = sorted(range(3), key=lambda i: moments[i])
    apart = EQUAL * moments[greatest]
    if min(moments[middle] - moments[least], moments[greatest] - moments[middle]) < apart:
        return None
    return least, middle, greatest


def loops(moments: Sequence[float], axis: int, middle: int) -> list[list[Vector]]:
    """Return the closed curves around the positive end of the axis of the least or of the greatest moment."""
    (other,) = {0, 1, 2} - {axis, middle}
    found = []
    for distance in map(radians, DISTANCES):
        wide = sin(distance)
        high = wide * sqrt(_excess(moments, axis, middle) / _excess(moments, axis, other))
        found.append(
            [
                _vector({axis: sqrt(max(0.0, 1 - u * u - v * v)), middle: u, other: v})
                for u, v in ((wide * cos(t), high * sin(t)) for t in (2 * pi * i / STEPS for i in range(STEPS + 1)))
            ]
        )
    return found


def separatrix(moments: Sequence[float], order: tuple[int, int, int]) -> list[list[Vector]]:
    """Return the four halves of great circles from one end of the intermediate axis to the other end."""
    least, middle, greatest = order
    ratio = sqrt(_excess(moments, middle, greatest) / -_excess(moments, middle, least))
    size = sqrt(1 + ratio * ratio)
    found = []
    for p, r in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        turns = (pi * i / STEPS for i in range(STEPS + 1))
        found.append(
            [_vector({middle: cos(t), least: p * ratio / size * sin(t), greatest: r / size * sin(t)}) for t in turns]
        )
    return found


def _excess(moments: Sequence[float], i: int, j: int) -> float:
    return 1 / moments[i] - 1 / moments[j]


def _vector(components: dict[int, float]) -> Vector:
    return components[0], components[1], components[2]


def motion_at(moments: Sequence[float], place: Vector) -> Vector:
    """Return the direction in which the tip of the angular momentum moves in the body, by Euler's equations: L x
    omega."""
    x, y, z = (part / moment for part, moment in zip(place, moments, strict=True))
    return cross(place, (x, y, z))


@dataclass(frozen=True)
class PolhodesMark(Surface):
    """A sphere with the curves of constant energy, for a body with these moments. The front of the sphere shows all
    curves; the back shows only the separatrix, dashed."""

    moments: tuple[Any, Any, Any]
    layer: ClassVar[int] = 0

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [
            place
            for k in range(3)
            for place in rim(NOUGHT, 1.0, _vector({i: float(i == k) for i in range(3)}))[::EVERY]
        ]

    def pieces(self, paper: Paper) -> list[Piece]:
        moments = [paper.numbers.of(moment) for moment in self.moments]
        order = order_of(moments)
        assert order is not None, "no drawing is made if two moments are equal"
        outline = paper.spots(*rim(NOUGHT, 1.0, paper.stance.eye))
        pieces: list[Piece] = [Patch(outline, "solid")]
        border = separatrix(moments, order)
        for line in border:
            pieces += [Stroke(paper.spots(*run), "hidden") for run in _runs(line, paper.stance.eye, -1.0)]
        for axis in (order[0], order[2]):
            for line in loops(moments, axis, order[1]):
                for curve in (line, [plus(NOUGHT, place, -1.0) for place in line]):
                    pieces += self._drawn(curve, moments, paper)
        for line in border:
            pieces += self._drawn(line, moments, paper, order[1])
        return [*pieces, Stroke(outline, "edge")]

    def _drawn(
        self, curve: Sequence[Vector], moments: Sequence[float], paper: Paper, middle: int | None = None
    ) -> list[Piece]:
        """Return the visible parts of a curve, with arrowheads in the direction of the motion.

        middle   the index of the intermediate axis, for the separatrix
        """
        pen = "level" if middle is None else "separatrix"
        pieces: list[Piece] = []
        for run in _runs(curve, paper.stance.eye, 1.0):
            pieces.append(Stroke(paper.spots(*run), pen))
            away = [1.0 if middle is None else 1 - place[middle] ** 2 for place in run]
            at = max(range(1, len(run) - 1), key=partial(_plainly, run, away, paper.stance.eye))
            if dot(run[at], paper.stance.eye) > FACING:
                ahead = dot(plus(run[at + 1], run[at - 1], -1.0), motion_at(moments, run[at])) > 0
                ends = (run[at - 1], run[at]) if ahead else (run[at + 1], run[at])
                pieces.append(Stroke(paper.spots(*ends), pen, head=True))
        return pieces


def _plainly(run: Sequence[Vector], away: Sequence[float], eye: Vector, i: int) -> float:
    return dot(run[i], eye) * away[i]


def _runs(curve: Sequence[Vector], eye: Vector, side: float) -> list[list[Vector]]:
    """Return the parts of a curve on the unit sphere that face the viewer; for `side` -1, the parts that face away."""
    flags = [side * dot(unit(place), eye) > 0 for place in curve]
    places = list(curve)
    if places[0] == places[-1] and flags[0] and not all(flags):
        first = flags.index(False)
        places, flags = places[first:-1] + places[: first + 1], flags[first:-1] + flags[: first + 1]
    return [run for run in parts_where(places, flags) if len(run) > 2]
