"""A description with random numbers for its symbols, and states that satisfy the conditions and the given values.

The numbers are the same in every run, are in the ranges of their symbols, and satisfy the assumptions of the page.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from random import Random
from typing import Any
from zlib import crc32

import numpy as np
from numpy.typing import NDArray
from sympy import Expr, Symbol

from derive.algebra.expressions import TIME, Relation, depends_on_time, explicit, rate
from derive.algebra.ranges import range_of
from derive.witness.dynamics import Blueprint, Dynamics, Response
from derive.witness.geometry import STEP, Reals, State, complex_steps, copies
from derive.witness.tape import NotComputable, Tape

SALTS = 60  # largest number of sets of numbers that are tried to satisfy the assumptions
ROUNDS = 25  # largest number of iterations of Newton's method
EXACT = 1e-10
MOMENT = 1e-6  # the time step of the central difference that differentiates momenta
ATTEMPTS = 5  # largest number of random states that are tried to satisfy the conditions and assumptions

HOLDS = {
    "=": lambda x: abs(x) < EXACT,
    "!=": lambda x: abs(x) > EXACT,
    ">": lambda x: x > 0,
    ">=": lambda x: x >= -EXACT,
    "<": lambda x: x < 0,
    "<=": lambda x: x <= EXACT,
}


class Contradiction(Exception):
    """No state of the described system with the given values is found; `of_rates` is true if coordinates are found, but
    no rates."""

    def __init__(self, of_rates: bool):
        super().__init__()
        self.of_rates = of_rates


@dataclass(frozen=True)
class Given:
    """A requirement on a state, in addition to the conditions of the system: `target` has the value `value`."""

    target: Expr
    value: Expr


class Drawn(Mapping[Symbol, float]):
    """A number for each symbol: the number in `fixed`, or else the random number that `drawn` returns."""

    def __init__(self, trial: int, salt: int = 0, fixed: Mapping[Symbol, float] | None = None):
        self.trial, self.salt, self.fixed = trial, salt, dict(fixed or {})

    def __getitem__(self, letter: Symbol) -> float:
        return self.fixed[letter] if letter in self.fixed else drawn(letter, self.trial, self.salt)

    def __iter__(self) -> Iterator[Symbol]:
        return iter(self.fixed)

    def __len__(self) -> int:
        return len(self.fixed)

    def __contains__(self, letter: object) -> bool:
        return isinstance(letter, Symbol)


def drawn(letter: Symbol, trial: int, salt: int = 0, wide: float = 1.0) -> float:
    """A random number that the symbol may have, of order `wide` unless the symbol has a range or is an integer."""
    source = Random(crc32(f"{letter.name} {trial} {salt}".encode()))
    known = range_of(letter)
    if known is not None:
        way = Symbol("way", positive=True)
        return float(known.at(way).xreplace({way: _fraction(source.uniform(0.1, 0.9))}))
    if letter.is_integer:
        return float(source.randint(1, 5))
    size = source.uniform(0.4, 1.6) * wide
    if letter.is_nonnegative or letter.is_positive:
        return size
    return -size if letter.is_nonpositive or source.random() < 0.5 else size


def _fraction(number: float) -> Any:
    from sympy import Rational

    return Rational(round(number * 997), 997)


class Trial:
    """A description with one set of numbers.

    number    the index of the trial; the random numbers depend on it
    assumed   relations that the numbers and the states must satisfy
    fixed     numbers for some of the symbols, in place of random numbers
    letters   given values of constants, such as `m = 2 M`
    momenta   the symbols of momenta, each with its coordinate
    """

    def __init__(
        self,
        blueprint: Blueprint,
        number: int,
        assumed: Sequence[Relation] = (),
        fixed: Mapping[Symbol, float] | None = None,
        letters: Sequence[Given] = (),
        momenta: Mapping[Symbol, Symbol] | None = None,
    ):
        self.blueprint, self.number = blueprint, number
        self.momenta = {letter: blueprint.coordinates.index(q) for letter, q in (momenta or {}).items()}
        self.numbers = self._drawn(assumed, letters, dict(fixed or {}))
        self._moments: dict[tuple[tuple[Given, ...], int], tuple[State, Response]] = {}
        self.dynamics: Dynamics = blueprint.with_numbers(self.numbers)
        moving = {*blueprint.coordinates, *blueprint.rates, TIME}
        self._stays = [each for each in assumed if explicit(each.residual).free_symbols & moving]
        self._staying = Tape([each.residual for each in self._stays], sorted(moving, key=str)).bound(self.numbers)
        self._sorted = [[*blueprint.coordinates, *blueprint.rates, TIME].index(s) for s in sorted(moving, key=str)]

    def _drawn(self, assumed: Sequence[Relation], letters: Sequence[Given], fixed: dict[Symbol, float]) -> Drawn:
        moving = {*self.blueprint.coordinates, *self.blueprint.rates, TIME}
        constant = [each for each in assumed if not explicit(each.residual).free_symbols & moving]
        tape = Tape([each.residual for each in constant], [])
        for salt in range(SALTS):
            numbers = Drawn(self.number, salt, fixed)
            for each in letters:
                assert isinstance(each.target, Symbol)
                numbers.fixed[each.target] = self.value(each.value, numbers)
            residuals = np.real(tape.bound(numbers)(np.empty((0, 1), dtype=complex))[:, 0])
            if all(HOLDS[each.operator](x) for each, x in zip(constant, residuals, strict=True)):
                return numbers
        raise NotComputable("no numbers satisfy the assumptions")

    @property
    def used(self) -> set[Symbol]:
        """The symbols whose numbers the description uses."""
        return self.blueprint.letters

    def value(self, formula: Expr, numbers: Mapping[Symbol, float] | None = None) -> float:
        """The value of a formula that contains only constants."""
        found = Tape([formula], []).bound(self.numbers if numbers is None else numbers)(np.empty((0, 1), dtype=complex))
        return _real(found[0, 0])

    # --- states -----------------------------------------------------------------------------------------------------

    def state(self, given: Sequence[Given] = (), which: int = 0, still: bool = False) -> State:
        last = Contradiction(of_rates=False)
        for attempt in range(ATTEMPTS):
            try:
                found = self._projected(self.drawn_state(1000 * which + attempt, still, 0.5**attempt), given)
            except Contradiction as contradiction:
                last = contradiction
                continue
            if self._as_assumed(found):
                return found
        raise last

    def moment(self, given: tuple[Given, ...], which: int) -> tuple[State, Response]:
        """A state, with its accelerations and multipliers; the tests of several steps use the same states."""
        if (given, which) not in self._moments:
            state = self.state(given, which)
            self._moments[given, which] = state, self.dynamics.response(state)
        return self._moments[given, which]

    def drawn_state(self, which: int, still: bool = False, wide: float = 1.0) -> State:
        """A random state. `wide` sets the order of the rates, and of the coordinates that may have any value.

        With `still`, the rates are zero.
        """
        q, v = [], []
        for symbol, kind in self.blueprint.of.coordinates:
            place = drawn(symbol, self.number, 7 + which)
            known = range_of(symbol)
            is_free = known is None and not symbol.is_positive
            q.append(place * (0.8 if kind == "angle" else 1.0) * wide if is_free else place)
            v.append(0.0 if still else drawn(rate(symbol), self.number, 7 + which) * wide)
        time = drawn(TIME, self.number, 7 + which)
        return State(np.array(q), np.array(v), abs(time))

    def _projected(self, state: State, given: Sequence[Given]) -> State:
        """Return a state near `state` that satisfies the conditions and the given values. Raise `Contradiction` if no
        such state is found.

        Newton's method finds first the coordinates, and then the rates.
        """
        inputs = [*self.blueprint.coordinates, *self.blueprint.rates, TIME]
        kept = [(self.momenta[g.target], self.value(g.value)) for g in given if g.target in self.momenta]
        given = [g for g in given if g.target not in self.momenta]
        residuals = [explicit(each.target) - explicit(each.value) for each in given]
        of_rates = [bool(each.free_symbols & set(self.blueprint.rates)) for each in residuals]
        tape = Tape(residuals, inputs).bound(self.numbers)
        fast = np.array(of_rates, dtype=bool)

        def at(here: State) -> tuple[Reals, Reals]:
            """The residuals of the given values, and their derivatives with respect to coordinates, rates and time."""
            if not residuals:
                return np.zeros(0), np.zeros((0, len(inputs)))
            points = copies(np.concatenate([here.q, here.v, [here.t]]), len(inputs) + 1)
            points[:, 1:] += complex_steps(len(inputs))
            found = tape(points)
            return found[:, 0].real, found[:, 1:].imag / STEP

        n = len(state.q)
        needs_time = any(depends_on_time(each) for each in residuals) or self._depends_on_time
        here = state
        for _ in range(ROUNDS):
            left, slopes = at(here)
            violation, _ = self.dynamics.violation(here)
            on_places, _ = self.dynamics.gradients(here)
            residual = np.concatenate([violation, left[~fast]])
            if not np.isfinite(residual).all():
                raise Contradiction(of_rates=False)
            if np.abs(residual).max(initial=0.0) < EXACT:
                break
            by_time = slopes[~fast][:, 2 * n :] * float(needs_time)
            of_conditions = (self._by_time(here) if needs_time else np.zeros(len(violation)))[:, None]
            jacobian = np.block([[on_places, of_conditions], [slopes[~fast][:, :n], by_time]])
            move, *_ = np.linalg.lstsq(jacobian, -residual, rcond=1e-10)
            size = np.abs(move).max()
            if size < EXACT:
                raise Contradiction(of_rates=False)
            move = move * min(1.0, 1.0 / size)
            here = State(here.q + move[:n], here.v, here.t + float(move[n]))
        else:
            raise Contradiction(of_rates=False)
        if not self._allowed(here.q):
            raise Contradiction(of_rates=False)
        for _ in range(ROUNDS):
            left, slopes = at(here)
            _, violation = self.dynamics.violation(here)
            _, on_rates = self.dynamics.gradients(here)
            residual = np.concatenate([violation, left[fast]])
            rows = np.vstack([on_rates, slopes[fast][:, n : 2 * n]])
            if kept:
                momenta, (matrix, _) = self.dynamics.momenta(here), self.dynamics.inertia(here)
                residual = np.append(residual, [momenta[k] - value for k, value in kept])
                of_momenta = self.dynamics.independent(here).T @ matrix
                rows = np.vstack([rows, of_momenta[[k for k, _ in kept]]])
            if not np.isfinite(residual).all():
                raise Contradiction(of_rates=True)
            if np.abs(residual).max(initial=0.0) < EXACT:
                return here
            move, *_ = np.linalg.lstsq(rows, -residual, rcond=1e-10)
            if np.abs(move).max() < EXACT:
                break
            here = replace(here, v=here.v + move)
        raise Contradiction(of_rates=True)

    def kept_at(self, state: State) -> State:
        """A state near this state that satisfies the conditions."""
        return self._projected(state, [])

    def with_momenta(self, state: State, momenta: Mapping[int, float]) -> State:
        """The state with these momenta of cyclic coordinates; only the rates of these coordinates, and of the
        coordinates that depend on them, are changed."""
        if not momenta:
            return state
        rows = list(momenta)
        matrix, _ = self.dynamics.inertia(state)
        moved = self.dynamics.independent(state)[:, rows]
        missing = np.array(list(momenta.values())) - self.dynamics.momenta(state)[rows]
        return replace(state, v=state.v + moved @ np.linalg.solve(moved.T @ matrix @ moved, missing))

    @cached_property
    def _depends_on_time(self) -> bool:
        return any(depends_on_time(c.residual) for c in self.blueprint.of.conditions if not c.in_rates)

    def _by_time(self, state: State) -> Reals:
        """The partial time derivatives of the conditions on coordinates."""
        at_rest = replace(state, v=np.zeros_like(state.v))
        _, violation = self.dynamics.violation(at_rest)
        return np.where(self.blueprint.in_rates, 0.0, violation)

    def _as_assumed(self, state: State) -> bool:
        """Whether the assumptions of the page about coordinates and rates hold in this state."""
        point = np.concatenate([state.q, state.v, [state.t]])[self._sorted].astype(complex)[:, None]
        found = np.real(self._staying(point)[:, 0])
        return all(HOLDS[each.operator](x) for each, x in zip(self._stays, found, strict=True))

    def _allowed(self, q: Reals) -> bool:
        for symbol, place in zip(self.blueprint.coordinates, q, strict=True):
            known = range_of(symbol)
            if symbol.is_positive and place <= 0:
                return False
            if known is not None and not (float(known.least) - 1e-9 <= place <= float(known.greatest) + 1e-9):
                return False
        return True

    # --- formulas at states -----------------------------------------------------------------------------------------

    def formulas(self, formulas: Sequence[Any]) -> Formulas:
        return Formulas(self, formulas)


class Formulas:
    """Formulas of coordinates, rates, accelerations, multipliers and momenta, to be evaluated at states."""

    def __init__(self, trial: Trial, formulas: Sequence[Any]):
        self.trial = trial
        blueprint = trial.blueprint
        self._momenta = list(trial.momenta.items())
        accelerations = [rate(q, 2) for q in blueprint.coordinates]
        multipliers = list(blueprint.multipliers)
        letters = [letter for letter, _ in self._momenta]
        inputs = [*blueprint.coordinates, *blueprint.rates, *accelerations, *multipliers, *letters, TIME]
        self._tape = Tape(formulas, inputs)
        self._bound = self._tape.bound(trial.numbers)

    def at(self, state: State, response: Response | None = None) -> Reals:
        """The values of the formulas in a state; accelerations and multipliers need a `response`."""
        return np.array([_real(x) for x in self._values(state, response)])

    def complex_at(self, state: State) -> complex:
        """The value of the first formula in a state, which may be complex."""
        return complex(self._values(state)[0])

    def _values(self, state: State, response: Response | None = None) -> NDArray[np.complex128]:
        n, rows = len(state.q), len(self.trial.blueprint.multipliers)
        a, kept = (response.a, response.multipliers) if response is not None else (np.zeros(n), np.zeros(rows))
        momenta = self._momenta_at(state)
        point = np.concatenate([state.q, state.v, a, kept, momenta, [state.t]]).astype(complex)
        return self._bound(point[:, None])[:, 0]

    def _momenta_at(self, state: State) -> Reals:
        return self.trial.dynamics.momenta(state)[[k for _, k in self._momenta]] if self._momenta else np.zeros(0)

    def rate_at(self, state: State, response: Response) -> Reals:
        """The time derivatives of the formulas along the motion. The formulas must not contain accelerations or
        multipliers. The momenta are differentiated by a central difference."""
        unused = np.zeros(len(state.q) + len(self.trial.blueprint.multipliers))
        later, earlier = (
            self._momenta_at(State(state.q + h * state.v, state.v + h * response.a, state.t + h))
            for h in (MOMENT, -MOMENT)
        )
        here = np.concatenate([state.q, state.v, unused, self._momenta_at(state), [state.t]]).astype(complex)
        along = np.concatenate([state.v, response.a, unused, (later - earlier) / (2 * MOMENT), [1.0]])
        return np.imag(self._bound((here + 1j * STEP * along)[:, None])[:, 0]) / STEP


def _real(x: complex) -> float:
    return float(x.real) if abs(x.imag) <= 1e-9 * (1 + abs(x.real)) else float("nan")
