"""The Newton-Euler equations, numerically: the accelerations and multipliers of a described system in any state.

With the Jacobians J of positions, and the accelerations c of these positions at constant rates, virtual work gives

    sum of W J^T J a + sum of W J^T c = sum of J^T F + A^T lambda,    A a + b = 0,

which are linear equations for the accelerations a and the multipliers lambda. The weights W are masses and second
moments; A and b come from the time derivatives of the constraints.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.4 and 2.4; Hairer, Lubich, Wanner, *Geometric
Numerical Integration*, section I.4.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, wraps
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from sympy import Expr, Symbol

from derive.algebra.expressions import TIME, rate
from derive.witness.description import Description
from derive.witness.geometry import (
    AROUND,
    STEP,
    WEIGHTS,
    Place,
    Placed,
    Reals,
    State,
    complex_steps,
    copies,
    formulas_of,
    placed,
)
from derive.witness.tape import Compiled, Tape

NEAR = (
    1e-4  # greatest spacing of points for second derivatives of a Lagrangian, which may be singular at a nearby speed
)
LEAST = 1e-12  # an equation whose coefficients are all smaller than this counts as zero
RANK = 1e-9  # singular values below this number, for entries of order one, count as zero
Found = TypeVar("Found")


class Singular(Exception):
    """A state does not determine the accelerations, for example because a mass vanishes."""


@dataclass(frozen=True)
class Response:
    """The accelerations in a state, and the multipliers in the order of the conditions.

    rank   the number of independent conditions
    """

    a: Reals
    multipliers: Reals
    rank: int


class Blueprint:
    """The formulas of a description as operations, before the symbols have numbers."""

    def __init__(self, description: Description):
        self.of = description
        q = [symbol for symbol, _ in description.coordinates]
        self.coordinates = q
        self.rates = [rate(symbol) for symbol in q]
        self.places = Tape(formulas_of(description), [*q, TIME])
        self.weights = Tape(_weights(description), [])
        self.pulls = [Tape([pair.energy], [pair.distance]) for pair in description.pairs]
        self.energies = Tape(list(description.energies), [*q, TIME])
        self.multipliers = [c.multiplier or Symbol(f"multiplier_{i}") for i, c in enumerate(description.conditions)]
        forces = [c for force in description.forces for c in force.components]
        self.forces = Tape(forces, [*q, *self.rates, TIME, *self.multipliers])
        self.conditions = Tape([c.residual for c in description.conditions], [*q, *self.rates, TIME])
        given = [description.lagrangian] if description.lagrangian is not None else []
        self.lagrangian = Tape(given, [*q, *self.rates, TIME])
        self.known: dict[object, Any] = {}  # results for particular numbers, cached for later steps

    @cached_property
    def letters(self) -> set[Symbol]:
        """All symbols of the description that need a number."""
        tapes = [self.places, self.weights, *self.pulls, self.energies, self.forces, self.conditions, self.lagrangian]
        return {letter for tape in tapes for letter in tape.letters}

    @cached_property
    def in_rates(self) -> NDArray[np.bool_]:
        """For each condition, whether it is a condition on the rates."""
        return np.array([c.in_rates for c in self.of.conditions], dtype=bool)

    @cached_property
    def dependent(self) -> dict[int, int]:
        """The index of each condition that expresses a coordinate in terms of others -> the index of this
        coordinate."""
        found = enumerate(each.expresses for each in self.of.conditions)
        return {row: self.coordinates.index(q) for row, q in found if q is not None}

    def with_numbers(self, numbers: Mapping[Symbol, float]) -> Dynamics:
        return Dynamics(self, numbers)


def _weights(description: Description) -> list[Expr]:
    """The constants of the description, in the order in which `Dynamics` reads them."""
    found: list[Expr] = [particle.mass for particle in description.particles]
    for body in description.bodies:
        found += [body.mass, *body.arm, *(entry for row in body.spread for entry in row)]
    found += [description.gravity] if description.gravity is not None else []
    found += [drag.constant for drag in description.drags]
    for charge in description.charges:
        found += [charge.charge, *charge.electric, *charge.magnetic]
    return found


def once_per_state(method: Callable[[Dynamics, State], Found]) -> Callable[[Dynamics, State], Found]:
    """Keep the result of a method for the last state, because several results need the same derivatives."""

    @wraps(method)
    def kept(of: Dynamics, state: State) -> Found:
        last: tuple[State, Found] | None = of.last.get(method.__name__)
        if last is None or last[0] is not state:
            last = of.last[method.__name__] = state, method(of, state)
        return last[1]

    return kept


class Dynamics:
    """A description whose symbols have numbers."""

    def __init__(self, blueprint: Blueprint, numbers: Mapping[Symbol, float]):
        self.blueprint, self.numbers = blueprint, numbers
        self.last: dict[str, Any] = {}  # method -> the last state, and the result of the method for this state
        of = blueprint.of
        self.count = len(blueprint.coordinates)
        self._places = blueprint.places.bound(numbers)
        weights = iter(np.real(blueprint.weights.bound(numbers)(np.empty((0, 1), dtype=complex))[:, 0]))
        self._masses = [next(weights) for _ in of.particles]
        self._bodies = [
            (next(weights), np.array([next(weights) for _ in b.arm]), _square(weights, len(b.spread)))
            for b in of.bodies
        ]
        self._gravity = next(weights) if of.gravity is not None else 0.0
        self._drags = [next(weights) for _ in of.drags]
        self._charges = [
            (
                next(weights),
                np.array([next(weights) for _ in c.electric]),
                np.array([next(weights) for _ in c.magnetic]),
            )
            for c in of.charges
        ]
        self._pulls = [tape.bound(numbers) for tape in blueprint.pulls]
        self._energies = blueprint.energies.bound(numbers)
        self._forces = blueprint.forces.bound(numbers)
        self._conditions = blueprint.conditions.bound(numbers)
        self._lagrangian = blueprint.lagrangian.bound(numbers) if of.lagrangian is not None else None

    @once_per_state
    def placed(self, state: State) -> Placed:
        """The positions of all parts of the description in a state."""
        return placed(self.blueprint.of, self._places, [arm for _, arm, _ in self._bodies], state)

    # --- the equations ----------------------------------------------------------------------------------------------

    def inertia(self, state: State) -> tuple[Reals, Reals]:
        """The mass matrix, and the generalized forces minus the inertial terms, at zero accelerations and
        multipliers."""
        if self._lagrangian is not None:
            matrix, forces = self._of_lagrangian(state, self._lagrangian)
            return matrix, forces + self._given(state, self.placed(state))[:, 0]
        at = self.placed(state)
        matrix, forces = self._matter(at)
        forces = forces + self._stored(state, at) + self._given(state, at)[:, 0]
        return matrix, forces

    def response(self, state: State) -> Response:
        """The accelerations and multipliers in a state; raises `Singular` if the accelerations are not determined."""
        at = self.placed(state)
        if self._lagrangian is not None:
            matrix, forces = self._of_lagrangian(state, self._lagrangian)
        else:
            matrix, forces = self._matter(at)
            forces = forces + self._stored(state, at)
        given = self._given(state, at)
        gradients, left = self._kept(state)
        rows = len(left)
        whole = np.zeros((self.count + rows, self.count + rows))
        whole[: self.count, : self.count] = matrix
        whole[: self.count, self.count :] = -gradients.T - given[:, 1:]
        whole[self.count :, : self.count] = gradients
        right = np.concatenate([forces + given[:, 0], -left])
        if not (np.isfinite(whole).all() and np.isfinite(right).all()):
            raise Singular
        rank = int(np.linalg.matrix_rank(gradients, tol=RANK * (1 + np.abs(gradients).max()))) if rows else 0
        return self._solved(whole, right, rank, rows)

    def _solved(self, whole: Reals, right: Reals, rank: int, rows: int) -> Response:
        scale = np.abs(whole).max(axis=1)
        if (scale < LEAST).any():
            raise Singular
        whole, right = whole / scale[:, None], right / scale
        if rank == rows:
            if np.linalg.cond(whole) > 1 / RANK:
                raise Singular
            found = np.linalg.solve(whole, right)
        else:
            found, *_ = np.linalg.lstsq(whole, right, rcond=RANK)
            if np.linalg.matrix_rank(whole, tol=RANK) < self.count + rank:
                raise Singular
            if np.linalg.norm(whole @ found - right) > 1e-7 * (1 + np.linalg.norm(right)):
                raise Singular
        known = np.asarray(found, dtype=np.float64)
        return Response(known[: self.count], known[self.count :], rank)

    def _pairs_of_matter(self, at: Placed) -> Iterator[tuple[float, Place, Place]]:
        """Yield each mass with its position twice, and each second moment with the two body axes to which it
        belongs."""
        for mass, place in self._weighed(at):
            yield mass, place, place
        for body, (_, _, spread) in zip(at.bodies, self._bodies, strict=True):
            for i, one in body.axes.items():
                for k, other in body.axes.items():
                    yield spread[i, k], one, other

    def _matter(self, at: Placed) -> tuple[Reals, Reals]:
        """The mass matrix, and the generalized forces of gravity minus the inertial terms at zero accelerations."""
        matrix, forces = np.zeros((self.count, self.count)), np.zeros(self.count)
        for weight, one, other in self._pairs_of_matter(at):
            matrix += weight * one.jacobian.T @ other.jacobian
            forces -= weight * one.jacobian.T @ other.turning
        for mass, place in self._weighed(at):
            forces -= mass * self._gravity * place.jacobian[-1]
        return matrix, forces

    def _weighed(self, at: Placed) -> Iterator[tuple[float, Place]]:
        """Each mass with its position, for a body the centre of mass."""
        yield from zip(self._masses, at.particles, strict=True)
        for (mass, _, _), body in zip(self._bodies, at.bodies, strict=True):
            yield mass, body.centre

    def _stored(self, state: State, at: Placed) -> Reals:
        """The generalized forces of springs and other pairs, and of potential energies."""
        forces = np.zeros(self.count)
        for pull, (start, end) in zip(self._pulls, at.pairs, strict=True):
            way = end.at - start.at
            distance = max(float(np.linalg.norm(way)), 1e-9)
            slope = float(np.imag(pull(np.array([[distance + 1j * STEP]]))[0, 0])) / STEP
            forces -= (end.jacobian - start.jacobian).T @ way * (slope / distance)
        if self.blueprint.of.energies:
            points = copies(np.concatenate([state.q, [state.t]]), self.count)
            points[: self.count] += complex_steps(self.count)
            forces -= np.sum(np.imag(self._energies(points)), axis=0) / STEP
        return forces

    def _given(self, state: State, at: Placed) -> Reals:
        """The generalized forces of given forces, drag and charges.

        The first column has the forces at zero multipliers; each further column is the factor of one multiplier.
        """
        rows, n = len(self.blueprint.multipliers), self.count
        found = np.zeros((n, 1 + rows))
        if not (self.blueprint.of.forces or self._drags or self._charges):
            return found
        here = np.concatenate([state.q, state.v, [state.t], np.zeros(rows)])
        points = copies(here, 1 + rows)
        if rows:
            points[-rows:, 1:] = np.eye(rows)
        components = iter(self._forces(points).real)
        for force, place in zip(self.blueprint.of.forces, at.forces, strict=True):
            acting = np.array([next(components) for _ in force.components])
            acting[:, 1:] -= acting[:, :1]
            found += jacobian_of(force.body, place, at).T @ acting
        for drag, constant, place in zip(self.blueprint.of.drags, self._drags, at.drags, strict=True):
            velocity = place.velocity if drag.body is None else at.bodies[drag.body].velocity_at(place.at)
            found[:, 0] -= jacobian_of(drag.body, place, at).T @ velocity * constant
        for (charge, electric, magnetic), place in zip(self._charges, at.charges, strict=True):
            found[:, 0] += place.jacobian.T @ (charge * (electric + _across(place.velocity, magnetic)))
        return found

    def _kept(self, state: State) -> tuple[Reals, Reals]:
        """The matrix A and the column b of the constraints A a + b = 0 on the accelerations a."""
        by_places, by_rates, along = self._slopes_of_conditions(state)
        in_rates = self.blueprint.in_rates
        return np.where(in_rates[:, None], by_rates, by_places), np.where(in_rates, along[:, 0], along[:, 1])

    @once_per_state
    def _slopes_of_conditions(self, state: State) -> tuple[Reals, Reals, Reals]:
        """The derivatives of the conditions with respect to coordinates, with respect to rates, and along the motion.

        The last array has the first and the second derivative along the motion at constant rates.
        """
        n = self.count
        if not self.blueprint.of.conditions:
            return np.zeros((0, n)), np.zeros((0, n)), np.zeros((0, 2))
        here = np.concatenate([state.q, state.v, [state.t]])
        along = np.concatenate([state.v, np.zeros(n), [1.0]])
        reach = state.reach
        points = copies(here, 2 * n + 7)
        points[: 2 * n, : 2 * n] += complex_steps(2 * n)
        points[:, 2 * n :] += 1j * STEP * along[:, None]
        points[:, 2 * n + 1 :] += along[:, None] * AROUND * reach
        slopes = self._conditions(points).imag / STEP
        second = slopes[:, 2 * n + 1 :] @ WEIGHTS / reach
        return slopes[:, :n], slopes[:, n : 2 * n], np.stack([slopes[:, 2 * n], second], axis=1)

    def violation(self, state: State) -> tuple[Reals, Reals]:
        """Two arrays that are zero if the state satisfies all conditions.

        The first array has the residuals of conditions on coordinates, and zero for each condition on rates. The second
        array has the residuals of conditions on rates, and the time derivatives of conditions on coordinates.
        """
        here = np.concatenate([state.q, state.v, [state.t]]).astype(complex)[:, None]
        residuals = self._conditions(here).real[:, 0]
        in_rates = self.blueprint.in_rates
        _, _, along = self._slopes_of_conditions(state)
        return np.where(in_rates, 0.0, residuals), np.where(in_rates, residuals, along[:, 0])

    def gradients(self, state: State) -> tuple[Reals, Reals]:
        """The derivatives of the first array of `violation` with respect to coordinates, and of the second array with
        respect to rates."""
        by_places, by_rates, _ = self._slopes_of_conditions(state)
        in_rates = self.blueprint.in_rates
        on_places = by_places.copy()
        on_places[in_rates] = 0.0
        return on_places, np.where(in_rates[:, None], by_rates, by_places)

    def momenta(self, state: State) -> Reals:
        """The momenta conjugate to the independent coordinates; zero for the other coordinates."""
        return self.independent(state).T @ self._all_momenta(state)

    def independent(self, state: State) -> Reals:
        """The derivatives of all coordinates (rows) with respect to the independent coordinates (columns); the columns
        of the other coordinates are zero."""
        found = np.eye(self.count)
        if dependent := self.blueprint.dependent:
            rows, columns = list(dependent), list(dependent.values())
            slopes = self._slopes_of_conditions(state)[0][rows]
            found[:, columns] = 0.0
            found[columns] = -np.linalg.solve(slopes[:, columns], slopes @ found)
        return found

    def _all_momenta(self, state: State) -> Reals:
        """The momenta if all coordinates were independent; a charge in a magnetic field contributes q A, with A =
        (1/2) B x r."""
        if self._lagrangian is not None:
            return self._slopes_of_lagrangian(state, self._lagrangian)[self.count :]
        at = self.placed(state)
        found = np.zeros(self.count)
        for weight, one, other in self._pairs_of_matter(at):
            found += weight * one.jacobian.T @ other.velocity
        for (charge, _, magnetic), place in zip(self._charges, at.charges, strict=True):
            found += place.jacobian.T @ (-0.5 * charge * _across(place.at, magnetic))
        return found

    def kinetic_energy(self, state: State) -> float:
        pairs = self._pairs_of_matter(self.placed(state))
        return sum(float(weight * one.velocity @ other.velocity) for weight, one, other in pairs) / 2

    # --- a given Lagrangian -----------------------------------------------------------------------------------------

    def _slopes_of_lagrangian(self, state: State, function: Compiled) -> Reals:
        n = self.count
        points = copies(np.concatenate([state.q, state.v, [state.t]]), 2 * n)
        points[: 2 * n] += complex_steps(2 * n)
        return np.asarray(np.imag(function(points)[0]) / STEP, dtype=np.float64)

    def _of_lagrangian(self, state: State, function: Compiled) -> tuple[Reals, Reals]:
        """The second derivatives of L with respect to the rates, and dL/dq - d(dL/dv)/dt at zero acceleration."""
        n = self.count
        reach = NEAR / (1 + float(np.max(np.abs(state.v), initial=0.0)))
        matrix = np.zeros((n, n))
        for k in range(n):
            unit = np.eye(n)[k] * reach
            slopes = [self._slopes_of_lagrangian(State(state.q, state.v + s * unit, state.t), function) for s in AROUND]
            matrix[k] = WEIGHTS @ np.array(slopes)[:, n:] / reach
        along = [
            self._slopes_of_lagrangian(State(state.q + s * reach * state.v, state.v, state.t + s * reach), function)
            for s in AROUND
        ]
        changing = WEIGHTS @ np.array(along)[:, n:] / reach
        return (matrix + matrix.T) / 2, self._slopes_of_lagrangian(state, function)[:n] - changing


def jacobian_of(body: int | None, place: Place, at: Placed) -> Reals:
    """The Jacobian of a position, or of the particle of a body at this position."""
    return place.jacobian if body is None else at.bodies[body].jacobian_at(place.at)


def _square(values: Iterator[float], size: int) -> Reals:
    return np.array([[next(values) for _ in range(size)] for _ in range(size)])


def _across(velocity: Reals, field: Reals) -> Reals:
    """The product v x B; in a plane B has one component, towards the reader."""
    if len(velocity) == 2:
        return np.array([velocity[1] * field[0], -velocity[0] * field[0]])
    return np.cross(velocity, field)
