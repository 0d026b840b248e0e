"""The positions of all parts of a description in a state, with their derivatives.

Complex steps give the first derivatives. The second derivative along the motion, at constant rates, is computed from
first derivatives at nearby points.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from sympy import Expr

from derive.witness.description import Body, Description, Vector
from derive.witness.tape import Compiled, Numbers

Reals: TypeAlias = NDArray[np.float64]

STEP = 1e-30  # size of a complex step; it is never added to the real part, so no digits are lost
PATH = 0.004  # upper limit of the spacing of points along the motion; `State.reach` makes it smaller for fast motions
AROUND = np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
# weights of the values at the points `AROUND` in a first derivative, which is accurate to sixth order
WEIGHTS = np.array([-1.0, 9.0, -45.0, 45.0, -9.0, 1.0]) / 60


@dataclass(frozen=True)
class State:
    """Coordinates, their rates, and the time."""

    q: Reals
    v: Reals
    t: float = 0.0

    @cached_property
    def reach(self) -> float:
        return PATH / (1 + max(1.0, float(np.abs(self.v).max(initial=0.0))))


@cache
def complex_steps(count: int) -> Numbers:
    """One complex step along each of `count` axes, as columns."""
    found: Numbers = np.zeros((count, count), dtype=np.complex128)
    np.fill_diagonal(found, 1j * STEP)
    found.flags.writeable = False  # all callers share this array
    return found


def copies(point: Reals | Numbers, count: int) -> Numbers:
    """An array whose columns are `count` copies of the point."""
    found = np.empty((len(point), count), dtype=np.complex128)
    found[:] = point[:, None]
    return found


@dataclass(frozen=True)
class Place:
    """A vector and its derivatives.

    jacobian   the first derivatives with respect to the coordinates
    velocity   the first derivative with respect to time
    turning    the second derivative with respect to time, at constant rates
    """

    at: Reals
    jacobian: Reals
    velocity: Reals
    turning: Reals


@dataclass(frozen=True)
class PlacedBody:
    """The centre of mass of a body, and the body axes, each under its number."""

    centre: Place
    axes: dict[int, Place]

    def jacobian_at(self, place: Reals) -> Reals:
        """The Jacobian of the particle of the body at a position."""
        found = self.centre.jacobian.copy()
        for axis in self.axes.values():
            found += axis.jacobian * float(axis.at @ (place - self.centre.at))
        return found

    def velocity_at(self, place: Reals) -> Reals:
        """The velocity of the particle of the body at a position."""
        found = self.centre.velocity.copy()
        for axis in self.axes.values():
            found += axis.velocity * float(axis.at @ (place - self.centre.at))
        return found


@dataclass(frozen=True)
class Placed:
    """The positions of all parts of a description in a state, in the order of the description."""

    particles: list[Place]
    bodies: list[PlacedBody]
    pairs: list[tuple[Place, Place]]
    forces: list[Place]
    drags: list[Place]
    charges: list[Place]


def formulas_of(description: Description) -> list[Expr]:
    """The components of positions, and the angles of rotations, in the order in which `placed` reads them."""
    found: list[Expr] = [c for particle in description.particles for c in particle.place]
    for body in description.bodies:
        found += [*body.place, *(angle for _, angle in body.turns)]
    for pair in description.pairs:
        found += [*pair.start, *pair.end]
    for place in _acting_places(description):
        found += place
    return found


def _acting_places(description: Description) -> list[Vector]:
    places = [force.place for force in description.forces] + [drag.place for drag in description.drags]
    return places + [charge.place for charge in description.charges]


def placed(description: Description, formulas: Compiled, arms: Sequence[Reals], state: State) -> Placed:
    """The positions of all parts in a state; `arms` are the vectors from the known points of the bodies to their
    centres of mass."""
    points, count = _points(state), len(state.q)
    found = formulas(points)
    rows = iter(found)

    def vector(size: int) -> Place:
        return _place(np.array([next(rows) for _ in range(size)]), count, state.reach)

    particles = [vector(len(particle.place)) for particle in description.particles]
    bodies = [
        _body(body, arm, rows, found.shape[1], count, state.reach)
        for body, arm in zip(description.bodies, arms, strict=True)
    ]
    pairs = [(vector(len(pair.start)), vector(len(pair.end))) for pair in description.pairs]
    acting = iter([vector(len(place)) for place in _acting_places(description)])
    forces, drags, charges = (
        [next(acting) for _ in kind] for kind in (description.forces, description.drags, description.charges)
    )
    return Placed(particles, bodies, pairs, forces, drags, charges)


def _points(state: State) -> Numbers:
    """The points at which formulas are evaluated: the state itself, complex steps from it, and nearby states along the
    motion."""
    n = len(state.q)
    here, along = np.concatenate([state.q, [state.t]]), np.concatenate([state.v, [1.0]])
    points = copies(here, n + 8)
    points[:n, 1 : n + 1] += complex_steps(n)
    points[:, n + 1 :] += 1j * STEP * along[:, None]
    points[:, n + 2 :] += along[:, None] * AROUND * state.reach
    return points


def _place(vector: Numbers, count: int, reach: float) -> Place:
    slopes = vector.imag / STEP
    turning = slopes[:, count + 2 :] @ WEIGHTS / reach
    return Place(vector.real[:, 0], slopes[:, 1 : count + 1], slopes[:, count + 1], turning)


def _body(body: Body, arm: Reals, rows: Iterator[Numbers], points: int, count: int, reach: float) -> PlacedBody:
    known = np.array([next(rows) for _ in body.place])
    axes = _axes(body, [next(rows) for _ in body.turns], points)
    centre = known + sum(a * axis for a, axis in zip(arm, axes, strict=True))
    by_number = zip(body.axes, axes, strict=True)
    return PlacedBody(_place(centre, count, reach), {i: _place(axis, count, reach) for i, axis in by_number})


def _axes(body: Body, angles: Sequence[Numbers], points: int) -> list[Numbers]:
    """The axes of a body as vectors at each point."""
    if len(body.axes) == 2:
        c, s = np.cos(angles[0]), np.sin(angles[0])
        return [np.array([c, s]), np.array([-s, c])]
    columns = [copies(axis, points) for axis in np.eye(3)]
    for (axis, _), angle in zip(body.turns, angles, strict=True):
        c, s = np.cos(angle), np.sin(angle)
        j, k = (axis + 1) % 3, (axis + 2) % 3
        columns[j], columns[k] = columns[j] * c + columns[k] * s, columns[k] * c - columns[j] * s
    return columns
