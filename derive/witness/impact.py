"""An impact, computed numerically: the impulses change the momenta of all bodies, and positions stay fixed.

    M (v - v_before) = sum of J^T K + A^T k,    n . (v_end - v_start) = -e n . (v_end - v_start)_before,    A v + b = 0

M is the mass matrix, and v are the rates. J is the Jacobian of a point with the impulse K. A v + b = 0 are the
constraints, and k are their impulses. v_start and v_end are the velocities of the two points that collide, n is the
direction of the impulse between them, and e is the coefficient of restitution.

Source: Routh, *Dynamics of a System of Rigid Bodies*, elementary part, sections 87 and 179.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from sympy import Expr, Integer, Symbol

from derive.algebra.equality import Verdict
from derive.algebra.expressions import rate
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from derive.witness.claim import CLOSE, TRIALS, Claim, seen
from derive.witness.description import Force, Impact, Vector
from derive.witness.dynamics import Blueprint, jacobian_of
from derive.witness.geometry import Reals, State
from derive.witness.tape import NotComputable
from derive.witness.trial import Contradiction, Given, Trial


@lru_cache(maxsize=8)
def _blueprint(of: Impact) -> Blueprint:
    """The system with a force at each impulse, so that the positions of the impulses are computed."""
    acting = [*of.impulses, *(end for meeting in of.meetings for end in _ends(meeting.start, meeting.end))]
    return Blueprint(replace(of.system, forces=tuple(acting), drags=(), charges=()))


def _ends(start: Force | None, end: Force) -> list[Force]:
    return [end] if start is None else [start, end]


@dataclass(frozen=True)
class After:
    """The rates just after an impact and the impulses of the impact, by their symbols."""

    rates: dict[Symbol, float]
    impulses: dict[Symbol, float]


def after(of: Impact, trial: Trial) -> After | None:
    """The rates just after an impact, and the impulses; None if they are not determined."""
    blueprint = trial.blueprint
    q = blueprint.coordinates
    given = [Given(symbol, value) for symbol, value in of.at]
    before = dict(of.before)
    given += [Given(rate(symbol), before.get(rate(symbol), Integer(0))) for symbol in q]
    state = trial.state(given)
    matrix, columns, rows, speeds, letters = _equations(of, trial, state)
    _, kept = trial.dynamics.gradients(state)
    _, left = trial.dynamics.violation(State(state.q, np.zeros_like(state.v), state.t))
    columns = np.vstack([columns, kept])
    rows, speeds = np.vstack([rows, kept]), np.append(speeds, -left)
    n, count = len(q), len(columns)
    whole = np.zeros((n + count, n + count))
    whole[:n, :n], whole[:n, n:] = matrix, -columns.T
    whole[n:, :n] = rows
    right = np.append(matrix @ state.v + _given_share(of, trial, state), speeds)
    if np.linalg.cond(whole) > 1e10:
        return None
    found = np.linalg.solve(whole, right)
    return After(
        {rate(symbol): float(v) for symbol, v in zip(q, found, strict=False)},
        dict(zip(letters, map(float, found[n:]), strict=False)),
    )


def _given_share(of: Impact, trial: Trial, state: State) -> Reals:
    """The contribution of the given impulses to the change of each momentum."""
    at = trial.dynamics.placed(state)
    found = np.zeros(len(state.q))
    for impulse, place in zip(of.impulses, at.forces, strict=False):
        components = np.array([trial.value(c.subs(dict(of.at))) for c in impulse.components])
        found += jacobian_of(impulse.body, place, at).T @ components
    return found


def _equations(of: Impact, trial: Trial, state: State) -> tuple[Reals, Reals, Reals, Reals, list[Symbol]]:
    """The mass matrix, and four arrays with an entry for each unknown impulse.

    The entries of the first array are the changes of the momenta per unit of the impulse. The second array is equal to
    the first; its entries are the factors of the rates in the speed along the impulse. The last two arrays have the
    required speed after the impact, and the symbol of the impulse.
    """
    matrix, _ = trial.dynamics.inertia(state)
    at = trial.dynamics.placed(state)
    places = iter(at.forces[len(of.impulses) :])
    columns, speeds, letters = [], [], []
    for meeting in of.meetings:
        jacobian = np.zeros((len(meeting.end.place), len(state.q)))
        if meeting.start is not None:
            jacobian -= jacobian_of(meeting.start.body, next(places), at)
        jacobian += jacobian_of(meeting.end.body, next(places), at)
        normals = _normals(trial, meeting.normal, of.at, len(jacobian))
        for letter, normal in zip(meeting.letters, normals, strict=False):
            row = normal @ jacobian
            if np.max(np.abs(row)) < CLOSE:
                continue
            columns.append(row)
            speeds.append(-trial.value(meeting.restitution) * float(row @ state.v))
            letters.append(letter)
    rows = np.array(columns).reshape(len(columns), len(state.q))
    return matrix, rows, rows, np.array(speeds), letters


def _normals(trial: Trial, normal: Vector, at: tuple[tuple[Symbol, Expr], ...], size: int) -> list[Reals]:
    """The unit vector along the impulse, or the unit vectors of all axes if the colliding objects stay together."""
    if not normal:
        return list(np.eye(size))
    components = np.array([trial.value(c.subs(dict(at))) for c in normal])
    return [components / np.linalg.norm(components)]


def testimony(of: Impact, quantity: Quantity) -> Verdict | None:
    """Test whether a rate after the impact, or an impulse, agrees with the momentum balance."""
    symbol = quantity.symbol
    blueprint = _blueprint(of)
    claim = Claim(quantity, Judged(quantity.value), quantity.step.outcome, blueprint)
    count = 0
    for number in range(TRIALS):
        try:
            trial = Trial(blueprint, number)
            found = after(of, trial)
            stated = trial.value(claim.value)
        except (NotComputable, Contradiction, np.linalg.LinAlgError):
            return None
        expected = None if found is None else {**found.rates, **found.impulses}.get(symbol)
        if expected is None:
            return None
        if abs(stated - expected) > CLOSE * (1 + abs(expected)):
            return claim.refuted(f"the momentum balance gives {expected:.6g}, but the step states {stated:.6g}", trial)
        count += 1
    return seen(count, "impacts")
