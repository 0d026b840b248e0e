"""Equilibria that stay, return or leave, and their frequencies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from sympy import Integer, cos, pi, sin, sqrt, symbols

from derive.algebra.expressions import Relation, rate
from derive.mechanics import (
    Particle,
    System,
    Z,
    coordinate,
    damping,
    equations_of_motion,
    equilibria,
    lagrangian,
    linearised,
    motions_by_modes,
    normal_modes,
    point,
    potential,
    potential_energy_of,
    space,
    spring,
    stability,
    t,
    weight,
)
from derive.steps.record import recorded
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from derive.witness import small_motions
from derive.witness.claim import Claim
from derive.witness.description import Description
from derive.witness.dynamics import Blueprint
from tests.witness.systems import PENDULUM, g, k, l, m

A, R, c, w = symbols("A R c omega", positive=True)
THETA = coordinate("theta", "angle")
q = THETA.symbol


@pytest.fixture(autouse=True)
def _run() -> Iterator[None]:
    with recorded():
        coordinate("theta", "angle")
        yield


def pendulum() -> System:
    return System(Particle(m, point(l * sin(q), -l * cos(q))), weight(g))


def hoop() -> System:
    place = space.turned(Z, w * t).place(R * sin(q), 0, -R * cos(q))
    return System(Particle(m, place), weight(g))


def claim(quantity: Quantity, of: Description = PENDULUM, outcome: str = "", **inputs: object) -> Claim:
    return Claim(quantity, Judged(quantity.value, inputs), outcome or quantity.step.outcome, Blueprint(of))


def at(value: object) -> dict[str, object]:
    return {"coordinates": (q,), "place": (value,)}


def test_a_pendulum_stays_at_its_equilibria_and_nowhere_else() -> None:
    for rest in equilibria(potential_energy_of(pendulum())):
        assert small_motions.rest(claim(rest))
    moved = replace(rest, facts=(replace(rest.facts[0], values={q: Integer(1)}),))
    assert not small_motions.rest(claim(moved))


def test_below_is_stable_and_above_is_not() -> None:
    U = potential_energy_of(pendulum())
    below, above = (stability(U, {THETA: value}, key=key) for value, key in ((0, "below"), (pi, "above")))
    assert small_motions.stability(claim(below, **at(Integer(0))))
    assert small_motions.stability(claim(above, **at(pi)))
    assert small_motions.stability(claim(below, outcome="unstable", **at(Integer(0)))).detail.startswith("every small")
    assert small_motions.stability(claim(above, outcome="stable", **at(pi))).detail == "a small displacement grows"


def test_a_condition_of_stability_is_tried_on_both_of_its_sides() -> None:
    """The bead at the bottom of a turning hoop: stable where omega^2 < g/R."""
    system = hoop()
    L = lagrangian(system)
    of = system.described.description
    right, wrong = Relation(g, ">", R * w**2), Relation(g, ">", 2 * R * w**2)
    assert small_motions.stability(claim(L, of, "depends", condition=right, **at(Integer(0))))
    assert not small_motions.stability(claim(L, of, "depends", condition=wrong, **at(Integer(0))))


def test_a_saddle_that_a_constraint_closes_is_stable() -> None:
    """U = k (x^2 - y^2)/2 with y = 0 kept by a force."""
    from derive.mechanics import constraint

    x, y = coordinate("x"), coordinate("y")
    energy = k * (x.symbol**2 - y.symbol**2) / 2
    system = System(Particle(m, point(x.symbol, y.symbol)), potential(energy), constraint(y.symbol, force="Q"))
    places = {"coordinates": (x.symbol, y.symbol), "place": (Integer(0), Integer(0))}
    L = lagrangian(system)
    assert small_motions.stability(claim(L, system.described.description, "stable", **places))
    assert not small_motions.stability(claim(L, system.described.description, "unstable", **places))


def test_the_frequencies_of_normal_modes_are_those_of_small_motions() -> None:
    x, y = coordinate("x"), coordinate("y")
    zero = point(0, 0)
    one, two = point(x.symbol, 0), point(y.symbol, 0)
    system = System(Particle(m, one), Particle(m, two), spring(k, zero, one), spring(k, one, two), spring(k, two, zero))
    modes = normal_modes(linearised(equations_of_motion(lagrangian(system))))
    slow, fast = (each for each in modes if each.key.startswith("frequency"))
    of = system.described.description
    assert small_motions.frequency(claim(slow, of))
    assert small_motions.frequency(claim(fast, of))
    assert not small_motions.frequency(claim(replace(slow, value=sqrt(2 * k / m)), of))


def test_a_rate_of_growth_is_an_eigenvalue_too() -> None:
    (above,) = [linearised(equations_of_motion(lagrangian(pendulum()))[0], at={THETA: pi})]
    (growth,) = normal_modes([above] if isinstance(above, Quantity) else above)
    assert growth.step.outcome == "unstable"
    assert small_motions.frequency(claim(growth))
    assert not small_motions.frequency(claim(growth, outcome="stable"))


def damped_pair() -> tuple[System, tuple[Quantity, ...]]:
    x, y = coordinate("x"), coordinate("y")
    zero, one, two = point(0, 0), point(x.symbol, 0), point(y.symbol, 0)
    springs = spring(k, zero, one), spring(k, one, two), spring(k, two, zero)
    drag = damping(c, one), damping(c, two)
    system = System(Particle(m, one), Particle(m, two), *springs, *drag)
    return system, normal_modes(linearised(equations_of_motion(lagrangian(system))))


def test_rates_of_decay_and_damped_frequencies_are_exponents_of_small_motions() -> None:
    system, modes = damped_pair()
    of = system.described.description
    decays = [each for each in modes if each.step.rule == "vibrations.damped_rate"]
    swings = [each for each in modes if each.step.rule == "vibrations.damped_frequency"]
    assert decays and swings
    for each in decays:
        assert small_motions.damped(claim(each, of))
        assert not small_motions.damped(claim(replace(each, value=each.value * 2), of))
    for each in swings:
        beta = {"beta": decays[0].value}
        assert small_motions.damped(claim(each, of, **beta))
        assert not small_motions.damped(claim(replace(each, value=sqrt(2 * k / m)), of, **beta))


def test_a_sum_of_modes_is_the_motion_from_its_start_and_from_no_other() -> None:
    x, y = coordinate("x"), coordinate("y")
    zero, one, two = point(0, 0), point(x.symbol, 0), point(y.symbol, 0)
    springs = spring(k, zero, one), spring(k, one, two), spring(k, two, zero)
    system = System(Particle(m, one), Particle(m, two), *springs)
    modes = normal_modes(linearised(equations_of_motion(lagrangian(system))))
    first, second = motions_by_modes(modes, {x: A})
    of = system.described.description
    start = {"start_1": Relation(x.symbol, "=", A)}
    assert small_motions.motion(claim(first, of, **start))
    assert small_motions.motion(claim(second, of, **start))
    assert not small_motions.motion(claim(replace(first, value=second.value), of, **start))
    moving = {**start, "start_2": Relation(rate(y.symbol), "=", A)}
    assert not small_motions.motion(claim(first, of, **moving))
