"""Tests of equilibria and of small motions about them: stability, frequencies and decay. A test returns None if nothing
could be tested.

The described system is linearised numerically on the manifold of its constraints. The eigenvalues s of the linear
motion show whether a displacement grows (Re s > 0) or oscillates (s = i omega).

Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 6.1 and 6.2; Meirovitch, *Methods of Analytical
Dynamics*, section 6.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from sympy import Expr, Integer, Symbol

from derive.algebra.equality import Verdict
from derive.algebra.expressions import Relation, explicit, rate
from derive.witness.claim import Claim, seen
from derive.witness.dynamics import Singular
from derive.witness.facts import Around, Rest
from derive.witness.geometry import Reals, State
from derive.witness.tape import NotComputable
from derive.witness.trial import Contradiction, Given, Trial

SMALL = 1e-3  # step of the finite differences for the derivatives; their error is of the order of SMALL**4
# Re s counts as zero below this fraction of the largest |s|; |s|**2 counts as zero below this fraction of its largest
# value.
SURE = 1e-3
FREQUENCY = 1e-5  # relative accuracy of squared frequencies and of motions; ten times this error is allowed
STAYS = 1e-7  # accuracy of an acceleration if all numbers are of order one; ten times this error is allowed
DOUBLE = 1e-4  # relative accuracy of eigenvalues s, which is low for two nearly equal eigenvalues
SHORT, MOMENTS = 2.0, 6  # duration of a simulated small motion, and number of times at which the motion is tested
ZERO = Integer(0)
DRAWS = 8  # number of trials for a statement about stability
DISPLACED = np.array([-2.0, -1.0, 1.0, 2.0])
WEIGHTS = np.array([1.0, -8.0, 8.0, -1.0]) / 12


@dataclass(frozen=True)
class Neighbourhood:
    """States near an equilibrium.

    free     the indices of the coordinates that may be displaced: all except cyclic coordinates with known momenta
    momenta  index of each cyclic coordinate with a known momentum -> this momentum
    """

    trial: Trial
    state: State
    free: tuple[int, ...]
    momenta: Mapping[int, float]

    def basis(self) -> Reals:
        """The directions in which the constraints allow displacements, as columns."""
        _, by_rates = self.trial.dynamics.gradients(self.state)
        if not len(by_rates):
            return np.eye(len(self.free))
        _, sizes, rows = np.linalg.svd(by_rates[:, list(self.free)])
        rank = int(np.sum(sizes > 1e-9 * max(1.0, float(np.max(sizes, initial=0.0)))))
        return np.array(rows[rank:].T)

    def at(self, basis: Reals, u: Reals, w: Reals) -> State:
        """The state with the displacements u along the basis and the rates w of these displacements."""
        q, v = self.state.q.copy(), self.state.v.copy()
        q[list(self.free)] += basis @ u
        v[list(self.free)] = self.state.v[list(self.free)] + basis @ w
        if self.trial.blueprint.of.conditions:
            return self.trial.kept_at(State(q, v, self.state.t))
        return self.trial.with_momenta(State(q, v, self.state.t), self.momenta)

    def acceleration(self, basis: Reals, u: Reals, w: Reals) -> Reals:
        response = self.trial.dynamics.response(self.at(basis, u, w))
        return np.asarray(basis.T @ response.a[list(self.free)])

    def eigenvalues(self) -> NDArray[np.complex128]:
        return np.asarray(np.linalg.eigvals(self.matrix()), dtype=np.complex128)

    def matrix(self) -> Reals:
        """The matrix of the linear motion d(u, w)/dt = (w, a(u, w))."""
        basis = self.basis()
        n = basis.shape[1]
        matrix = np.zeros((2 * n, 2 * n))
        matrix[:n, n:] = np.eye(n)
        for k in range(2 * n):
            unit = np.eye(2 * n)[k] * SMALL
            slopes = [self.acceleration(basis, s * unit[:n], s * unit[n:]) for s in DISPLACED]
            matrix[n:, k] = WEIGHTS @ np.array(slopes) / SMALL
        return matrix


def neighbourhood(claim: Claim, trial: Trial, place: Mapping[Symbol, Expr]) -> Neighbourhood | None:
    """The states near the equilibrium at `place`. None if `place` contains a symbol that is not a coordinate. None also
    if constraints act and cyclic coordinates are eliminated."""
    q = claim.blueprint.coordinates
    cyclic = {q.index(of): value for of, value in claim.constants.items() if of not in place}
    if cyclic and claim.blueprint.of.conditions:
        return None
    if any(symbol not in q for symbol in place):
        return None
    letters = {of: letter for letter, of in claim.momenta.items()}
    given = [Given(symbol, value) for symbol, value in place.items()]
    given += [Given(rate(symbol), Integer(0)) for i, symbol in enumerate(q) if i not in cyclic]
    given += [Given(letters[q[i]], value) for i, value in cyclic.items()]
    state = trial.state(given)
    free = tuple(i for i in range(len(q)) if i not in cyclic)
    return Neighbourhood(trial, state, free, {i: trial.value(value) for i, value in cyclic.items()})


def _neighbourhoods(
    claim: Claim, place: Mapping[Symbol, Expr], exists: Relation | None, count: int = 2
) -> Iterator[Neighbourhood]:
    for trial in claim.trials(count, [exists] if exists is not None else []):
        try:
            found = neighbourhood(claim, trial, place)
        except (Contradiction, NotComputable):
            continue
        if found is not None:
            yield found


def rest(claim: Claim) -> Verdict | None:
    """Test whether the system stays at the equilibrium."""
    known = claim.quantity.fact(Rest)
    if known is None:
        return None
    count = 0
    for near in _neighbourhoods(claim, known.values, known.exists):
        try:
            response = near.trial.dynamics.response(near.state)
        except Singular:
            if near.momenta:  # a cyclic coordinate may be singular here, like an angle at r = 0, so there is no test
                continue
            if _is_balanced(near):  # the acceleration of a massless part is undefined, but the part stays at rest
                count += 1
                continue
            return claim.refuted("the accelerations at this equilibrium are not determined", near.trial, near.state)
        if np.max(np.abs(response.a[list(near.free)])) > STAYS * 10:
            return claim.refuted("the described system does not stay at this equilibrium", near.trial, near.state)
        count += 1
    return seen(count, "states")


def _is_balanced(near: Neighbourhood) -> bool:
    """Whether all generalized forces vanish at this equilibrium, for a system without constraints."""
    if near.trial.blueprint.of.conditions:
        return False
    _, forces = near.trial.dynamics.inertia(near.state)
    return bool(np.max(np.abs(forces), initial=0.0) < STAYS * 10)


STABLE = frozenset(["stable", "stable_by_higher_order", "level"])
UNSTABLE = frozenset(["unstable", "unstable_along"])


def stability(claim: Claim) -> Verdict | None:
    """Test the stability that the step states. At a stable equilibrium, no small displacement may grow. At an unstable
    equilibrium, some small displacement must grow. If an eigenvalue is zero, no displacement is required to grow,
    because the linear motion does not then show whether the equilibrium is stable."""
    inputs = claim.judged.inputs
    if "coordinates" not in inputs or "place" not in inputs:
        return None
    place = dict(zip(inputs["coordinates"], inputs["place"], strict=True))
    condition = inputs.get("condition")
    told = condition if isinstance(condition, Relation) else None
    if claim.outcome in STABLE | UNSTABLE:
        sides: Sequence[tuple[bool, list[Relation]]] = [(claim.outcome in STABLE, [])]
    elif told is not None:
        sides = [(True, [told]), (False, [_opposite(told)])]
    else:
        return None
    exists = inputs.get("exists")
    count = 0
    for is_stable, also in sides:
        for near in _neighbourhoods_with(claim, place, [*also, *([exists] if isinstance(exists, Relation) else [])]):
            verdict = _goes_as_stated(claim, near, is_stable)
            if isinstance(verdict, Verdict):
                return verdict
            count += verdict
    return seen(count, "equilibria")


def _neighbourhoods_with(
    claim: Claim, place: Mapping[Symbol, Expr], conditions: Sequence[Relation]
) -> Iterator[Neighbourhood]:
    for trial in claim.trials(DRAWS, conditions):
        try:
            found = neighbourhood(claim, trial, place)
        except (Contradiction, NotComputable):
            continue
        if found is not None:
            yield found


def _goes_as_stated(claim: Claim, near: Neighbourhood, is_stable: bool) -> Verdict | int:
    """Return the refutation of the stated stability, or the number of equilibria (0 or 1) that were tested."""
    try:
        growth = near.eigenvalues()
    except (Singular, Contradiction, np.linalg.LinAlgError):
        if near.momenta:  # a cyclic coordinate may be singular here, like an angle at r = 0, so there is no test
            return 0
        return claim.refuted("the small motion about this equilibrium is not determined", near.trial, near.state)
    size = max(float(np.max(np.abs(growth), initial=0.0)), 1e-3)
    leaves = bool(np.max(growth.real) > SURE * size)
    at_zero = bool(np.min(np.abs(growth), initial=size) < np.sqrt(SURE) * size)
    if is_stable and leaves:
        return claim.refuted("a small displacement grows", near.trial, near.state)
    if not is_stable and not leaves and not at_zero:
        return claim.refuted("every small displacement stays small", near.trial, near.state)
    return 1


def _opposite(relation: Relation) -> Relation:
    turned = {">": "<", "<": ">", ">=": "<", "<=": ">"}
    return Relation(relation.left, turned.get(relation.operator, relation.operator), relation.right)


def _around(claim: Claim) -> Around | None:
    return next((fact for each in claim.quantity.ancestors() if (fact := each.fact(Around)) is not None), None)


def frequency(claim: Claim) -> Verdict | None:
    """Test whether some small displacement oscillates with the stated frequency. If the step states a growth, test the
    rate of growth."""
    around = _around(claim)
    if around is None or claim.outcome == "neutral":
        return None
    grows = claim.outcome.startswith(("growing", "unstable"))
    count = 0
    for near in _neighbourhoods(claim, around.values, around.exists):
        squares = _squares_of(near)
        stated = near.trial.formulas([claim.value**2]).complex_at(near.state)
        if squares is None or not np.isfinite(stated):
            continue
        wanted = stated if grows else -stated
        size = max(float(np.max(np.abs(squares), initial=0.0)), 1e-3)
        if np.min(np.abs(squares - wanted), initial=np.inf) > FREQUENCY * 10 * size:
            return claim.refuted(
                "no small motion of the described system has this frequency or growth rate", near.trial, near.state
            )
        count += 1
    return seen(count, "equilibria")


def _squares_of(near: Neighbourhood) -> NDArray[np.complex128] | None:
    growth = _eigenvalues_of(near)
    return None if growth is None else np.asarray(growth**2, dtype=np.complex128)


def damped(claim: Claim) -> Verdict | None:
    """Test whether some small displacement decays at the stated rate, or oscillates with the stated frequency."""
    around = _around(claim)
    if around is None:
        return None
    count = 0
    for near in _neighbourhoods(claim, around.values, around.exists):
        growth = _eigenvalues_of(near)
        formulas = [near.trial.formulas([explicit(f)]) for f in (claim.value, claim.judged.inputs.get("beta", ZERO))]
        stated, decay = (each.complex_at(near.state) for each in formulas)
        if growth is None or not np.isfinite(stated):
            continue
        scale = max(float(np.max(np.abs(growth))), 1e-3)
        size = DOUBLE * scale
        if claim.outcome in (PAIR, CRITICAL):  # the mean of two eigenvalues s is minus the stated value
            one, other = (growth[index] for index in np.triu_indices(len(growth), 1))
            found, wanted = (one + other) / 2, -stated
            if claim.outcome == CRITICAL:  # rounding errors split a double eigenvalue by about their square root
                found = found[np.abs(one - other) <= np.sqrt(DOUBLE) * scale]
        else:
            found, wanted = (
                growth,
                {DECAYS: -stated, GROWS: -stated, OVERDAMPED: stated - decay}.get(claim.outcome, 1j * stated - decay),
            )
        if np.min(np.abs(found - wanted), initial=np.inf) > size:
            return claim.refuted(
                "no small motion of the described system has this rate of decay or frequency", near.trial, near.state
            )
        count += 1
    return seen(count, "equilibria")


PAIR, CRITICAL, DECAYS, GROWS, OVERDAMPED = "oscillator", "critical", "decay", "growth", "overdamped"


def motion(claim: Claim) -> Verdict | None:
    """Test whether a displacement is the stated function of time, for the stated initial displacements and rates."""
    from scipy.linalg import expm

    around, starts = _around(claim), _starts_of(claim)
    if around is None or starts is None or claim.symbol not in around.displaced:
        return None
    count = 0
    for near in _neighbourhoods(claim, around.values, around.exists):
        letters = list(around.displaced)
        order = [near.trial.blueprint.coordinates.index(around.displaced[letter]) for letter in letters]
        if near.trial.blueprint.of.conditions or sorted(order) != list(near.free) or not _stays(near):
            return None
        matrix, n = near.matrix(), len(near.free)
        begin = np.zeros(2 * n)
        for letter, where in zip(letters, order, strict=True):
            k = near.free.index(where)
            begin[k], begin[n + k] = (near.trial.value(starts.get(s, ZERO)) for s in (letter, rate(letter)))
        own = near.free.index(order[letters.index(claim.symbol)])
        formula, times = near.trial.formulas([claim.value]), np.linspace(0.0, SHORT, MOMENTS)
        found = np.array([(expm(matrix * t) @ begin)[own] for t in times])
        stated = np.array([formula.at(replace(near.state, t=float(t)))[0] for t in times])
        size = max(float(np.max(np.abs(found))), float(np.max(np.abs(begin))), 1e-3)
        if not np.max(np.abs(stated - found)) <= FREQUENCY * 10 * size:
            return claim.refuted(
                "from the stated initial values, the described system has a different small motion", near.trial
            )
        count += 1
    return seen(count, "motions")


def _starts_of(claim: Claim) -> dict[Expr, Expr] | None:
    """The initial displacements and rates that the sentence states."""
    told = [each for role, each in claim.judged.inputs.items() if role.startswith("start")]
    if not all(isinstance(each, Relation) for each in told):
        return None
    return {each.left: explicit(each.right) for each in told}


def _stays(near: Neighbourhood) -> bool:
    """Whether this state is an equilibrium at two different times."""
    at_times = [near.trial.dynamics.response(replace(near.state, t=t)) for t in (0.0, 0.3)]
    return all(np.max(np.abs(each.a[list(near.free)]), initial=0.0) < STAYS * 10 for each in at_times)


def _eigenvalues_of(near: Neighbourhood) -> NDArray[np.complex128] | None:
    """The eigenvalues of the linear motion, from a cache, or None if they cannot be computed."""
    known, letters = near.trial.blueprint.known, sorted(near.trial.blueprint.letters, key=str)
    here = near.state.q.tobytes(), near.state.v.tobytes(), tuple(near.momenta.items())
    key = (tuple(near.trial.numbers[letter] for letter in letters), near.free, *here)
    if key not in known:
        try:
            known[key] = near.eigenvalues()
        except (Singular, Contradiction, np.linalg.LinAlgError):
            known[key] = None
    found: NDArray[np.complex128] | None = known[key]
    return found
