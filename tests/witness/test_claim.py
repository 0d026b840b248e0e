"""What a step says, as the witness reads it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from sympy import Integer, Symbol, cos, sin, symbols

from derive.algebra.expressions import Relation, rate
from derive.algebra.ranges import Range, within
from derive.mechanics import (
    Particle,
    System,
    accelerations,
    coordinate,
    energy_function,
    equations_of_motion,
    lagrangian,
    point,
    put_in,
    weight,
)
from derive.steps.record import recorded
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from derive.witness.claim import Claim, seen, substituted
from derive.witness.dynamics import Blueprint
from derive.witness.trial import Given
from tests.witness.systems import PENDULUM, g, l, m

theta = coordinate("theta", "angle")


@pytest.fixture(autouse=True)
def _run() -> Iterator[None]:
    with recorded():
        yield


def pendulum() -> Quantity:
    coordinate("theta", "angle")
    place = point(l * sin(theta.symbol), -l * cos(theta.symbol))
    return lagrangian(System(Particle(m, place), weight(g)))


def claim(quantity: Quantity) -> Claim:
    return Claim(quantity, Judged(quantity.value), quantity.step.outcome, Blueprint(PENDULUM))


def test_what_vanishes_is_the_difference_of_the_sides_or_of_a_symbol_and_its_value() -> None:
    L = pendulum()
    (motion,) = equations_of_motion(L)
    (found,) = accelerations(motion)
    assert claim(motion).residuals == [motion.value.residual]
    assert claim(found).residuals == [rate(theta.symbol, 2) - found.value]
    assert claim(energy_function(L)).residuals == []  # h is a letter of its own


def test_a_substitution_says_what_was_replaced() -> None:
    (motion,) = equations_of_motion(pendulum())
    M = Symbol("M", positive=True)
    there = put_in(motion, {theta.symbol: Integer(1), m: 2 * M}, key="there")
    assert set(substituted(there)) == {Given(theta.symbol, Integer(1)), Given(m, 2 * M)}
    found = claim(there)
    assert found.states_given == [Given(theta.symbol, Integer(1))]
    assert found.letters_given == [Given(m, 2 * M)]
    (trial,) = found.trials(1)
    assert trial.numbers[m] == pytest.approx(2 * trial.numbers[M])
    assert [state.q[0] for state, _ in found.moments(trial)] == pytest.approx([1, 1, 1])


def test_nothing_seen_is_no_verdict() -> None:
    assert seen(0, "states") is None
    assert str(symbols("x")) and seen(2, "states").detail == "2 states"  # type: ignore[union-attr]


def test_steps_of_one_system_share_a_trial_and_its_moments_if_their_letters_have_the_same_ranges() -> None:
    L = pendulum()
    (motion,) = equations_of_motion(L)
    one = claim(L)
    other = replace(claim(motion), blueprint=one.blueprint)
    (trial,) = one.trials(1)
    assert [*other.trials(1)] == [trial]
    assert all(a is b for a, b in zip(one.moments(trial), other.moments(trial), strict=True))
    with within({l: Range(Integer(2), Integer(3))}):
        (far,) = other.trials(1)
        assert far is not trial and far.numbers[l] > 2
    (light,) = replace(other, assumed=[Relation(m, "<", l / 2)]).trials(1)
    assert light.numbers[m] < light.numbers[l] / 2
