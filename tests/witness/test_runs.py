"""Motions that are followed from their start."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from sympy import Expr, Integer, Rational, Symbol, cos, sin, symbols

from derive.algebra.expressions import TIME, Relation, rate
from derive.mechanics import (
    Particle,
    System,
    constraint,
    coordinate,
    energy_function,
    equations_of_motion,
    lagrangian,
    leaves_contact,
    multipliers,
    period_by_energy,
    point,
    put_in,
    solution,
    speed_from_energy,
    weight,
)
from derive.steps.record import recorded
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from derive.witness import runs
from derive.witness.claim import Claim
from derive.witness.dynamics import Blueprint
from derive.witness.trial import Trial
from tests.witness.systems import ON_A_STRING, PENDULUM, g, l, m

THETA, R = coordinate("theta", "angle"), coordinate("r", positive=True)
q, r = THETA.symbol, R.symbol
A, v = symbols("A v", positive=True)


@pytest.fixture(autouse=True)
def _run() -> Iterator[None]:
    with recorded():
        coordinate("theta", "angle")
        coordinate("r", positive=True)
        yield


def claim(quantity: Quantity, of: object = ON_A_STRING, outcome: str = "", **inputs: object) -> Claim:
    sources = {"force": quantity.parents[0]} if quantity.parents else {}
    judged = Judged(quantity.value, inputs, sources)
    return Claim(quantity, judged, outcome or quantity.step.outcome, Blueprint(of))  # type: ignore[arg-type]


def test_a_followed_pendulum_keeps_its_energy_and_ends_at_an_event() -> None:
    trial = Trial(Blueprint(PENDULUM), 0)
    energy = trial.formulas([l * rate(q) ** 2 / 2 - g * cos(q)])
    run = runs.followed(trial, trial.state(), 5.0)
    assert run is not None
    values = [float(energy.at(each)[0]) for each in run.states]
    assert np.ptp(values) < runs.FOLLOWED / 10
    ended = runs.followed(trial, trial.state(), 20.0, lambda state: float(state.q[0] - 0.1))
    assert ended is not None and ended.end is not None
    assert ended.end.q[0] == pytest.approx(0.1, abs=1e-8)


def test_a_motion_that_meets_a_singularity_is_not_seen() -> None:
    from derive.witness.description import Description
    from derive.witness.description import Particle as Mass

    flat = Description(((q, "angle"),), (Mass(m, (l * sin(q), Integer(0))),))
    trial = Trial(Blueprint(flat), 0)
    assert runs.followed(trial, trial.state(), 50.0) is None


def tension(start_rate: Expr) -> Quantity:
    L = lagrangian(System(Particle(m, point(r * sin(q), -r * cos(q))), weight(g), constraint(l - r, force="S")))
    motions = equations_of_motion(L)
    held = {r: l, rate(r): Integer(0)}
    energy = put_in(energy_function(L), held, key="energy")
    (turning,) = (each for each in motions if each.key == "motion_theta")
    motion = put_in(turning, held, key="motion")
    speed = speed_from_energy(energy, THETA, Integer(0), start_rate, motion)
    (S,) = multipliers(*motions)
    return put_in(S, speed, key="tension")


def test_the_speed_of_a_followed_motion_is_that_of_the_energy() -> None:
    found = tension(v / l)
    (speed,) = [each for each in found.ancestors() if each.step.rule == "motion.speed_from_energy"]
    start = {"coordinate": q, "start": Integer(0), "start_rate": v / l}
    assert runs.speed(claim(speed, **start))
    assert not runs.speed(claim(replace(speed, value=speed.value * 2), **start))


def test_a_string_goes_slack_only_where_the_motion_gets_there() -> None:
    """Slack for 2 g l < v^2 < 5 g l alone; below it turns back while the string is taut."""
    found = leaves_contact(tension(v / l), cos(q), Integer(1))
    assert found.step.outcome == "lost"
    said = {str(value) for role, value in found.step.roles if role in ("reached", "existing")}
    assert said == {"v**2 > 2*g*l", "v**2 < 5*g*l"} or said == {"v**2 > 2*g*l", "5*g*l > v**2"}
    assert {e.compared.value for e in found.step.evidence} >= {"witness"}
    inputs = {"unknown": cos(q), "start": Integer(1)}
    without = Relation(v**2, "<", 5 * g * l)
    assert not runs.leaves(claim(found, existing=without, **inputs))


@pytest.mark.long
def test_a_slow_impact_never_makes_the_string_slack() -> None:
    found = leaves_contact(tension((g / l) ** Rational(1, 2)), cos(q), Integer(1))
    assert found.step.outcome == "turns_back"
    assert str(found.value) == "g*m*(3*cos(theta) - 1) > 0"
    wrong = replace(found, value=Relation(cos(q), "=", Rational(1, 3)))
    verdict = runs.leaves(claim(wrong, outcome="lost", unknown=cos(q), start=Integer(1)))
    assert verdict is not None and verdict.detail == "the described motion from this start does not reach this position"


def test_a_solution_is_followed_from_its_own_start() -> None:
    z = coordinate("z")
    h = Symbol("h", positive=True)
    system = System(Particle(m, point(0, z.symbol)), weight(g))
    (motion,) = equations_of_motion(lagrangian(system))
    fall = solution(motion, z, h)
    of = system.described.description
    assert runs.solution(claim(fall, of))
    assert not runs.solution(claim(replace(fall, value=h - g * TIME**2 / 3), of))


def swing(place: tuple[Expr, Expr], order: int = 2) -> tuple[Quantity, System]:
    system = System(Particle(m, point(*place)), weight(g))
    L = lagrangian(system)
    (motion,) = equations_of_motion(L)
    speed = speed_from_energy(energy_function(L), THETA, A, Integer(0), motion)
    return period_by_energy(speed, order), system


def test_a_period_in_powers_of_the_amplitude_is_that_of_the_motion_to_its_order() -> None:
    found, system = swing((l * sin(q), -l * cos(q)), order=4)
    inputs = {"coordinate": q, "amplitude": A}
    of = system.described.description
    assert runs.period(claim(found, of, **inputs))
    right = found.value
    for wrong in (right.subs(A, 0) * (1 + A**2 / 8), right * 2, right + A**4 / 100, -right):
        assert not runs.period(claim(replace(found, value=wrong), of, **inputs))


def test_a_period_that_does_not_depend_on_the_amplitude_does_not_in_the_motion() -> None:
    """A bead on a cycloid, with the arc from its lowest point as a measure: 4 pi sqrt(l/g)."""
    found, system = swing((l * (q + sin(q)), -l * (1 + cos(q))))
    inputs = {"coordinate": q, "amplitude": A}
    of = system.described.description
    assert runs.period(claim(found, of, found.step.outcome, **inputs))
    assert not runs.period(claim(found, PENDULUM, "exact", **inputs))
