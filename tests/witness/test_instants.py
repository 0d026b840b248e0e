"""Equations that hold at every moment of a motion, and wrong ones that do not."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from sympy import cos, sin

from derive.algebra.expressions import Relation, rate
from derive.mechanics import (
    Particle,
    System,
    accelerations,
    constraint,
    coordinate,
    energy_function,
    equations_of_motion,
    function_of_time,
    kinetic_energy_of,
    lagrangian,
    multipliers,
    point,
    put_in,
    speed_from_energy,
    weight,
)
from derive.steps.record import recorded
from derive.steps.rule import Judged
from derive.steps.step import Form, Quantity
from derive.witness import instants
from derive.witness.claim import Claim
from derive.witness.dynamics import Blueprint
from tests.witness.systems import ON_A_STRING, PENDULUM, g, l, m

THETA, R = coordinate("theta", "angle"), coordinate("r", positive=True)
q, r = THETA.symbol, R.symbol


@pytest.fixture(autouse=True)
def _run() -> Iterator[None]:
    with recorded():
        coordinate("theta", "angle")
        coordinate("r", positive=True)
        yield


def pendulum() -> Quantity:
    return lagrangian(System(Particle(m, point(l * sin(q), -l * cos(q))), weight(g)))


def on_a_string() -> Quantity:
    place = point(r * sin(q), -r * cos(q))
    return lagrangian(System(Particle(m, place), weight(g), constraint(l - r, force="S")))


def judged(judge, quantity: Quantity, value=None, of=PENDULUM):  # type: ignore[no-untyped-def]
    if value is not None:
        step = replace(quantity.step, chain=(Form(value, "result"),))
        quantity = replace(quantity, value=value, step=step)
    return judge(Claim(quantity, Judged(quantity.value), quantity.step.outcome, Blueprint(of)))


def test_an_equation_of_motion_holds_and_one_with_another_sign_does_not() -> None:
    (motion,) = equations_of_motion(pendulum())
    assert judged(instants.equation, motion)
    wrong = Relation(l * rate(q, 2) - g * sin(q), "=", 0)
    assert judged(instants.equation, motion, wrong).detail == "the equation does not hold in the described motion"


def test_a_prescribed_function_is_neither_constant_nor_a_coordinate() -> None:
    X = function_of_time("X", "length")
    place = (X + l * sin(q), -l * cos(q))
    moved = replace(PENDULUM, particles=(replace(PENDULUM.particles[0], place=place),))
    (motion,) = equations_of_motion(lagrangian(System(Particle(m, point(*place)), weight(g))))
    assert judged(instants.equation, motion, of=moved)
    constant = Relation(l * rate(q, 2) + g * sin(q), "=", 0)
    along_X = Relation(X.rate(2) + l * rate(q, 2) * cos(q) - l * rate(q) ** 2 * sin(q), "=", 0)
    for wrong in (constant, along_X):
        assert (
            judged(instants.equation, motion, wrong, of=moved).detail
            == "the equation does not hold in the described motion"
        )
    h = energy_function(lagrangian(System(Particle(m, point(*place)), weight(g))))
    called_conserved = replace(h, step=replace(h.step, outcome="conserved"))
    assert not judged(instants.conserved, called_conserved, h.value, of=moved)


def test_multipliers_and_accelerations_agree_with_the_described_constraint() -> None:
    motions = equations_of_motion(on_a_string())
    (S,) = multipliers(*motions)
    assert judged(instants.equation, S, of=ON_A_STRING)
    assert not judged(instants.equation, S, S.value + m * g / 100, of=ON_A_STRING)
    assert not judged(instants.equation, S, -S.value, of=ON_A_STRING)
    for each in accelerations(*motions):
        assert judged(instants.equation, each, of=ON_A_STRING)


def test_rates_that_contradict_the_constraint_are_not_substituted() -> None:
    motions = equations_of_motion(on_a_string())
    with pytest.raises(Exception, match="contradict the constraint"):
        put_in(motions[1], {r: l, rate(r): g * 0 + l}, key="wrong")


def test_the_kinetic_energy_is_that_of_the_masses() -> None:
    T = kinetic_energy_of(System(Particle(m, point(l * sin(q), -l * cos(q)))))
    assert judged(instants.kinetic_energy, T)
    assert not judged(instants.kinetic_energy, T, T.value * 2)


def test_a_conserved_value_does_not_change_and_another_does() -> None:
    h = energy_function(pendulum())
    assert judged(instants.conserved, h)
    assert not judged(instants.conserved, h, h.value + m * l * rate(q) ** 3)


def test_an_energy_that_friction_takes_is_not_stated_to_be_conserved() -> None:
    """A value that is not stated to be constant is not tested."""
    h = energy_function(pendulum())
    changing = replace(h, step=replace(h.step, outcome="work_energy"))
    assert judged(instants.conserved, changing) is None


def test_that_an_energy_keeps_its_value_is_tested_along_the_motion() -> None:
    L = pendulum()
    speed = speed_from_energy(energy_function(L), THETA, l / l, motion=equations_of_motion(L)[0])
    (kept,) = [each for each in speed.parents if each.step.rule == "motion.energy_kept"]
    assert judged(instants.kept, kept)
    wrong = Relation(kept.value.left + m * g * l * sin(q), "=", kept.value.right)
    assert not judged(instants.kept, kept, wrong)


def test_what_follows_from_an_equation_of_motion_holds_along_the_motion_too() -> None:
    (motion,) = equations_of_motion(pendulum())
    assert instants.holds_along(put_in(motion, {l: 2 * m / m}, key="there"))
    assert not instants.holds_along(pendulum())
