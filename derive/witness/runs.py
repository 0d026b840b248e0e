"""Tests of motions that are simulated from their start. A test returns None if nothing could be tested.

SciPy integrates the accelerations of the described system by a multistep method, which needs few evaluations of the
accelerations. SciPy also finds the time of an event.
Source: Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, chapter III and section II.6.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from sympy import Abs, Expr, Integer, Symbol, diff

from derive.algebra.equality import Verdict
from derive.algebra.expressions import TIME, Relation, explicit, rate
from derive.witness import small_motions
from derive.witness.claim import TRIALS, Claim, seen
from derive.witness.dynamics import Blueprint, Dynamics, Singular
from derive.witness.facts import Around
from derive.witness.geometry import Reals, State
from derive.witness.tape import NotComputable
from derive.witness.trial import EXACT, HOLDS, Contradiction, Formulas, Given, Trial

LONG = 12.0  # usual duration of a simulated motion, with masses, lengths and g of order one
CALLS = 6000  # largest number of evaluations of the accelerations in one motion
MOMENTS, WATCHED = 12, 80  # least number of integration steps: without an event, and with an event, which may be short
CLEAR = 0.1  # margin by which a condition must be satisfied, because a short event might not be detected
FOLLOWED = 1e-5  # accuracy to which a simulated motion and a formula must agree
MANY = 6  # number of sets of numbers that are tried
# A motion begins at this fraction of the way from its given start to the stated place, because the start may be an
# equilibrium. If the motion turns back and the system has no state there, the motion begins on the other side of the
# start.
NUDGE = 2e-3
Event = Callable[[State], float]


class TooLong(Exception):
    """A motion needs more evaluations of the accelerations than `CALLS`."""


class Run:
    """One motion of the described system.

    states   the states of the motion, in the order of time
    end      the state at the event that ended the motion; None if the event did not occur
    """

    def __init__(self, dynamics: Dynamics, start: State, length: float, event: Event | None, step: float):
        from scipy.integrate import solve_ivp

        self._calls = 0
        n = len(start.q)

        def flow(t: float, y: Reals) -> Reals:
            self._calls += 1
            if self._calls > CALLS:
                raise TooLong
            return np.concatenate([y[n:], dynamics.response(State(y[:n], y[n:], t)).a])

        def watched(t: float, y: Reals) -> float:
            assert event is not None
            return event(State(y[:n], y[n:], t))

        watched.terminal = True  # type: ignore[attr-defined]
        watched.direction = -1  # type: ignore[attr-defined]
        found = solve_ivp(
            flow,
            (start.t, start.t + length),
            np.concatenate([start.q, start.v]),
            method="LSODA",
            rtol=1e-8,
            atol=1e-9,
            max_step=step,
            events=[watched] if event is not None else None,
        )
        self.states = [State(y[:n], y[n:], float(t)) for t, y in zip(found.t, found.y.T, strict=True)]
        ended = event is not None and len(found.t_events[0]) > 0
        self.end = State(found.y_events[0][0][:n], found.y_events[0][0][n:], found.t_events[0][0]) if ended else None


def followed(
    trial: Trial, start: State, length: float = LONG, event: Event | None = None, free: Dynamics | None = None
) -> Run | None:
    """The motion from a state, for a time `length` or until `event`; None if the motion cannot be computed.

    free   the dynamics of the system without some of its constraints, in place of the dynamics of the trial
    """
    try:
        return Run(free or trial.dynamics, start, length, event, length / (MOMENTS if event is None else WATCHED))
    except (Singular, TooLong, np.linalg.LinAlgError, FloatingPointError):
        return None


def speed(claim: Claim) -> Verdict | None:
    """Test the formula for the square of the rate in the states of the motion from the given start."""
    inputs = claim.judged.inputs
    q = inputs.get("coordinate")
    if not isinstance(q, Symbol) or q not in claim.blueprint.coordinates:
        return None
    start = [*claim.states_given, Given(q, inputs["start"]), Given(rate(q), inputs["start_rate"])]
    count = 0
    for trial in claim.trials():
        try:
            state = trial.state(_without_repeats(start))
            formulas = trial.formulas([claim.value, rate(q) ** 2])
        except Contradiction as contradiction:
            if contradiction.of_rates and claim.blueprint.of.conditions:
                return claim.refuted("the start contradicts the constraints", trial)
            continue
        run = followed(trial, state, LONG / 4)
        if run is None:
            continue
        for each in run.states:
            stated, found = formulas.at(each)
            if not abs(stated - found) <= FOLLOWED * (1 + abs(found)):
                return claim.refuted("the described motion from this start has a different speed", trial, each)
        count += 1
    return seen(count, "motions")


def _without_repeats(given: Sequence[Given]) -> list[Given]:
    return list({each.target: each for each in given}.values())


def leaves(claim: Claim) -> Verdict | None:
    """Test whether the force first vanishes at the stated position, or never if the motion turns back."""
    inputs = claim.judged.inputs
    if "unknown" not in inputs or "start" not in inputs or not isinstance(claim.value, Relation):
        return None
    if claim.outcome == TURNS_THERE:  # the simulated motion only comes close to this position
        return None
    conditions = [each for each in inputs.values() if isinstance(each, Relation) and each.operator not in ("=", "!=")]
    place = inputs["place"].right if claim.outcome == TURNS_BACK else claim.value.right
    count = 0
    for trial in claim.trials(MANY, also=conditions):
        if any(abs(trial.value(each.residual)) < CLEAR for each in conditions):
            continue
        verdict = _leaves_in(claim, trial, inputs, explicit(place))
        if isinstance(verdict, Verdict):
            return verdict
        count += verdict
    return seen(count, "motions")


TURNS_BACK, TURNS_THERE = "turns_back", "turns_there"


def _leaves_in(claim: Claim, trial: Trial, inputs: Mapping[str, Any], place: Expr) -> Verdict | int:
    """The refutation of the claim by one motion; otherwise the number of motions (0 or 1) that were tested."""
    unknown, begin = explicit(inputs["unknown"]), explicit(inputs["start"])
    margin = _margin(claim)
    if margin is None:
        return 0
    watched = trial.formulas([unknown, margin])
    stays = claim.outcome == TURNS_BACK
    first, last = trial.value(begin), trial.value(place)
    if not abs(last - first) > CLEAR:
        return 0
    try:
        near = begin + (place - begin) * (
            -NUDGE if stays and not _can_go_on(claim, trial, unknown, begin, place) else NUDGE
        )
        state = trial.state(_without_repeats([*claim.states_given, Given(unknown, near)]))
    except Contradiction:
        if stays or not _can_start(claim, trial, unknown, begin):
            return 0
        return claim.refuted("the described motion does not reach this position from this start", trial)
    state = _towards(trial, unknown, state, last - first)

    def pushing(here: State) -> float:
        return float(watched.at(here, trial.dynamics.response(here))[1])

    run = followed(trial, state, LONG, pushing)
    if run is None:
        return 0
    if stays:
        return 1 if run.end is None else claim.refuted(f"in the described motion {_ending(claim)}", trial, run.end)
    if run.end is None:
        return claim.refuted("the described motion from this start does not reach this position", trial, state)
    found = float(watched.at(run.end)[0])
    if abs(found - last) > 10 * FOLLOWED + NUDGE * abs(last - first):
        return claim.refuted(f"in the described motion {_ending(claim)} at {found:.4g} instead", trial, state)
    return 1


def _ending(claim: Claim) -> str:
    return "the body begins to slip" if "friction" in claim.judged.quantities else "the force vanishes"


def _margin(claim: Claim) -> Expr | None:
    """An expression in the multipliers: N, which vanishes where the contact ends, or mu_s N - |F|, which vanishes where
    the body begins to slip. None if a force of the step is not a multiplier."""
    quantities, inputs = claim.judged.quantities, claim.judged.inputs
    found = [quantities[role] for role in ("force", "normal", "friction") if role in quantities]
    if not found or any(each.symbol not in claim.blueprint.multipliers for each in found):
        return None
    push, *hold = (explicit(each.symbol) for each in found)
    return explicit(inputs["coefficient"]) * push - Abs(*hold) if hold else push


def slips(claim: Claim) -> Verdict | None:
    """Test the stated condition. The states of the motion that satisfy it must be those with |F| <= mu_s N; for the
    outcome "cannot", they must be the other states. For an outcome in `SLIPS_ALONG`, test where the body begins to
    slip."""
    if claim.outcome in SLIPS_ALONG:
        return leaves(claim)
    margin, side = _margin(claim), claim.judged.inputs.get("side")
    if margin is None or side is None or claim.outcome == "always":
        return None
    result, count = claim.value, 0
    F, N = (claim.judged.quantities[role].symbol for role in ("friction", "normal"))
    for trial in claim.trials(MANY):
        formulas = trial.formulas([margin, explicit(side) * F, N, result.residual])
        for state, response in claim.moments(trial):
            room, held, pushed, difference = formulas.at(state, response)
            if held <= 0 or pushed <= 0 or abs(room) < CLEAR * held or abs(difference) < EXACT:
                continue
            states_it = HOLDS[result.operator](difference) != (claim.outcome == "cannot")
            if states_it != (room > 0):
                return claim.refuted("static friction in the motion contradicts the condition", trial, state)
            count += 1
    return seen(count, "states")


SLIPS_ALONG = ("slips", "slips_squared")


def _can_start(claim: Claim, trial: Trial, unknown: Expr, at: Expr) -> bool:
    """Whether there is a state of the system with this value of the unknown."""
    try:
        trial.state(_without_repeats([*claim.states_given, Given(unknown, at)]))
    except Contradiction:
        return False
    return True


def _can_go_on(claim: Claim, trial: Trial, unknown: Expr, begin: Expr, place: Expr) -> bool:
    return _can_start(claim, trial, unknown, begin + (place - begin) * NUDGE)


def _towards(trial: Trial, unknown: Expr, state: State, sign: float) -> State:
    """Return the state, with all rates reversed if this is needed to move in the direction of `sign`."""
    response = trial.dynamics.response(state)
    changing = float(trial.formulas([unknown]).rate_at(state, response)[0])
    return replace(state, v=-state.v) if changing * sign < 0 else state


# --- free flight after the constraint has ended ---

# The simulated motion that leads to a flight begins at this fraction of the way from its given start to the place where
# contact is lost. The given start itself may be an equilibrium.
BEGUN = 0.03
FLIGHTS = 3  # number of sets of numbers with which a flight is simulated
# The greatest accepted difference between a formula for a position and a simulated flight, relative to 1 plus the size
# of the value. For the time of a landing, the greatest difference is ten times as large.
FLOWN = 1e-4


def flight(claim: Claim) -> Verdict | None:
    """Test a component of the position in a free flight. The motion is simulated until the constraint force vanishes,
    then without the constraints that end there."""
    fact, i = claim.judged.inputs["flight"], int(claim.judged.inputs["component"])
    count = 0
    for trial, start, free in _begun(claim, fact):
        length = 2 * _time_to_turn(trial, start)
        run = followed(trial, start, length, free=free)
        if run is None:
            continue
        formulas = trial.formulas([fact.in_given_letters(claim.value), fact.point.place[i]])
        for each in run.states:
            stated = float(formulas.at(replace(each, t=each.t - start.t))[0])
            found = float(formulas.at(each)[1])
            if not abs(stated - found) <= FLOWN * (1 + abs(found)):
                return claim.refuted("without its constraint, the described system moves differently", trial, each)
        count += 1
    return seen(count, "flights")


def landing(claim: Claim) -> Verdict | None:
    """Test the time at which a free flight ends. The flight is simulated until the particle meets the surface, without
    the constraints that ended at the beginning of the flight."""
    fact, target = claim.judged.inputs["flight"], claim.judged.inputs["target"]
    x, y = fact.point.place
    if target is not None:
        (px, py), (nx, ny) = target.through.components, target.unit_normal.components
        away = nx * (x - px) + ny * (y - py) - fact.radius
    else:
        (cx, cy), radius = fact.orbit.centre, fact.orbit.radius
        away = radius**2 - (x - cx) ** 2 - (y - cy) ** 2
    count = 0
    for trial, start, free in _begun(claim, fact):
        stated = trial.value(fact.in_given_letters(claim.value))
        apart = trial.formulas([away])
        early = followed(trial, start, min(stated, LONG) / 20, free=free)
        if early is None or not 0 < stated < LONG:
            continue
        run = followed(trial, early.states[-1], 2 * stated, _first_of(apart), free)
        if run is None:
            continue
        found = np.inf if run.end is None else run.end.t - start.t
        if not abs(found - stated) <= FLOWN * 10 * (1 + stated):
            ends = "much later or never" if run.end is None else f"after {found:.4g}"
            return claim.refuted(f"the described flight ends {ends} instead of after {stated:.4g}", trial, start)
        count += 1
    return seen(count, "flights")


def _begun(claim: Claim, fact: Any) -> Iterator[tuple[Trial, State, Dynamics]]:
    """Yield trials, each with a state and with dynamics. In this state the force of the constraint vanishes. The
    dynamics are those of the system without the constraints that end there.

    fact   the flight: the position where it begins, and the motion before it
    """
    q, end = fact.coordinate
    conditions = tuple(each for each in claim.blueprint.of.conditions if each.multiplier not in fact.ended)
    free = Blueprint(replace(claim.blueprint.of, conditions=conditions))
    for trial in claim.trials(FLIGHTS, also=fact.conditions):
        if any(abs(trial.value(each.residual)) < CLEAR for each in fact.conditions):
            continue
        try:
            way = trial.value(end) - trial.value(fact.start)
            near = fact.start + (end - fact.start) * BEGUN
            state = trial.state(_without_repeats([*claim.states_given, Given(q, near)]))
            pushing = trial.formulas([explicit(fact.force.symbol)])
        except (Contradiction, NotComputable):
            continue
        state = _towards(trial, q, state, way)
        run = followed(trial, state, LONG, _first_of(pushing, trial))
        if run is not None and run.end is not None:
            yield trial, run.end, free.with_numbers(trial.numbers)


def _first_of(formulas: Formulas, trial: Trial | None = None) -> Event:
    """An event at which the first formula vanishes."""
    return lambda here: float(formulas.at(here, None if trial is None else trial.dynamics.response(here))[0])


def _time_to_turn(trial: Trial, start: State) -> float:
    """A time of the order of the duration of the flight, in units with g of order one."""
    return float(min(1.0, np.max(np.abs(start.v)) + 0.3))


def solution(claim: Claim) -> Verdict | None:
    """Test whether the coordinate is the stated function of time in the simulated motion of the described system."""
    (q,) = (claim.symbol,) if isinstance(claim.symbol, Symbol) else (None,)
    if any(each.fact(Around) is not None for each in claim.quantity.ancestors()):
        return small_motions.motion(claim)  # a linear equation describes the linearised motion
    if q is None or q not in claim.blueprint.coordinates:
        return None
    motion = claim.value
    start = [Given(q, motion.subs(TIME, 0)), Given(rate(q), diff(motion, TIME).subs(TIME, 0))]
    count = 0
    for trial in claim.trials():
        try:
            state = trial.state(_without_repeats([*claim.states_given, *start, Given(TIME, Integer(0))]))
            formula = trial.formulas([motion])
        except Contradiction:
            continue
        run = followed(trial, state, LONG / 6)
        if run is None:
            continue
        i = claim.blueprint.coordinates.index(q)
        size = max(float(np.max(np.abs([each.q[i] for each in run.states]))), 1e-3)
        for each in run.states:
            (stated,) = formula.at(each)
            if not abs(stated - each.q[i]) <= FOLLOWED * size:
                return claim.refuted("the described motion from this start is a different one", trial, each)
        count += 1
    return seen(count, "motions")


def period(claim: Claim) -> Verdict | None:
    """Test the period of an oscillation that is released from rest at the amplitude.

    If the period is a series, its error must shrink with the amplitude.
    """
    inputs = claim.judged.inputs
    if claim.outcome == INTEGRATED:
        integral, letters, numbers = (inputs[role] for role in ("integral", "letters", "numbers"))
        q, amplitude = integral.args[1:3]
        fixed = {letter: float(explicit(number)) for letter, number in zip(letters, numbers, strict=True)}
        sizes: tuple[float, ...] = (fixed.pop(amplitude),)
    elif isinstance(inputs.get("amplitude"), Symbol):
        q, amplitude, fixed = inputs["coordinate"], inputs["amplitude"], {}
        sizes = (LARGE,) if claim.outcome == "exact" else (LARGE, LARGE / 2)
    else:
        return None
    count = 0
    for number in range(1 if fixed else TRIALS):
        errors = []
        for size in sizes:
            trial = Trial(claim.blueprint, number, claim.assumed, {**fixed, amplitude: size}, claim.letters_given)
            stated = trial.value(claim.value)
            if not stated > 0:
                return claim.refuted(f"the stated period, {stated:.6g}, is not positive", trial)
            found = _swing(claim, trial, q, amplitude, 0.75 * stated)
            if found is None:
                return None
            errors.append(abs(found / stated - 1))
        if errors[-1] > max(TIMED, errors[0] * _shrinks(claim.value, amplitude) * (len(sizes) > 1)):
            return claim.refuted(f"the described motion has the period {found:.6g} instead of {stated:.6g}", trial)
        count += 1
    return seen(count, "swings")


INTEGRATED = "integrated"
LARGE = 0.8  # amplitude of a large oscillation
TIMED = 1e-7  # accuracy of the period of a simulated motion


def _shrinks(series: Expr, amplitude: Symbol) -> float:
    """The largest allowed ratio of the error at half amplitude to the error at full amplitude, by the highest power in
    the series."""
    highest = series.as_poly(amplitude).degree()
    return float(0.5 ** (highest + 0.5))


def _swing(claim: Claim, trial: Trial, q: Symbol, amplitude: Symbol, length: float) -> float | None:
    """Twice the time from the release to the other turning point; None if this point is not reached."""
    i = claim.blueprint.coordinates.index(q)
    try:
        start = trial.state(_without_repeats([*claim.states_given, Given(q, amplitude), Given(rate(q), Integer(0))]))
    except Contradiction:
        return None
    run = followed(trial, start, length, lambda state: -float(state.v[i]))
    return None if run is None or run.end is None else 2 * (run.end.t - start.t)
