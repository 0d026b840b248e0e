"""A state of rest in several coordinates that is lost is noticed: rest is sought in numbers from many starts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from sympy import Expr, Symbol, asin, cos, pi, sin, sqrt, symbols

from derive.algebra.ranges import Range, within
from derive.errors import Unverified
from derive.mechanics import (
    Particle,
    System,
    coordinate,
    equilibria,
    point,
    potential,
    potential_energy_of,
    spring,
    weight,
)
from derive.mechanics.rest import equilibria as equilibria_module
from derive.mechanics.rest.equilibrium_search import none_is_missing
from derive.solving import zeros
from derive.solving.zeros import Zero
from derive.steps.record import recorded
from derive.steps.step import Quantity

m, g, l, a, k, c, F = symbols("m g l a k c F", positive=True)
theta, phi, x, y = symbols("theta phi x y", real=True)
r = Symbol("r", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[None]:
    with recorded():
        yield


def two_pendulums() -> Quantity:
    p, q = coordinate("theta"), coordinate("phi")
    bobs = (Particle(m, point(l * sin(p) + place, -l * cos(p))) for p, place in ((p, 0), (q, a)))
    return potential_energy_of(System(*bobs, weight(g)))


def pushed_round() -> Quantity:
    """A torque F/2 on an arm that is pushed up by F: sin theta = 1/2; and beside it a mass on a spring."""
    q, d = coordinate("theta"), coordinate("x", "length")
    arm, free = point(l * sin(q), -l * cos(q)), point(d, 0)
    U = F * (cos(q.symbol) + q.symbol / 2)
    return potential_energy_of(System(Particle(m, arm), Particle(m, free), spring(k, point(0, 0), free), potential(U)))


def test_all_four_states_are_let_in() -> None:
    assert len(equilibria(two_pendulums())) == 4


def test_both_arc_sines_are_let_in() -> None:
    found = [list(rest.value) for rest in equilibria(pushed_round())]
    assert sorted(found, key=str) == [[5 * pi / 6, 0], [pi / 6, 0]]


def test_a_state_that_is_lost_with_a_zero_of_a_factor_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(equilibria_module, "zeros_of", lambda force, q: [Zero(0 * q)])
    with pytest.raises(Unverified, match="could not be confirmed"):
        equilibria(two_pendulums())


@pytest.mark.parametrize("kept", [0, 1])
def test_a_state_that_is_lost_with_an_arc_sine_is_noticed(monkeypatch: pytest.MonkeyPatch, kept: int) -> None:
    right = zeros._with_sine
    monkeypatch.setattr(zeros, "_with_sine", lambda value: right(value)[kept : kept + 1])
    with pytest.raises(Unverified, match="could not be confirmed"):
        equilibria(pushed_round())


@pytest.mark.parametrize("lost", range(4))
def test_each_of_four_states_is_missed(lost: int) -> None:
    forces = m * g * l * sin(theta), m * g * l * sin(phi) + k * sin(theta) ** 2
    places: list[Any] = [((theta, p), (phi, q)) for p in (0 * theta, pi) for q in (0 * theta, pi)]
    angles = (theta, phi)
    assert none_is_missing(forces, angles, angles, tuple(places))
    assert not none_is_missing(forces, angles, angles, tuple(places[:lost] + places[lost + 1 :]))


def test_what_is_out_of_range_is_not_missed() -> None:
    forces = F * (2 * sin(theta) - 1), k * x
    first, second = (((theta, place), (x, 0 * theta)) for place in (asin(F / (2 * F)), pi - asin(F / (2 * F))))
    assert not none_is_missing(forces, (theta, x), (theta,), (first,))
    assert none_is_missing(forces, (theta, x), (theta,), (first, second))
    with within({theta: Range(-pi / 2, pi / 2)}):
        assert none_is_missing(forces, (theta, x), (theta,), (first,))


@pytest.mark.parametrize(
    ("forces", "sought", "states"),
    [
        ((k / r**2, c * x), (r, x), ()),  # which grow small far out
        ((k * x**3, c * y), (x, y), ()),  # of higher order, which is not confirmed
        ((k * x * y, k * x**2 / 2), (x, y), (((x, 0 * x),),)),  # rest anywhere on a line
        ((k * (r - l), c * (x - a)), (r, x), (((r, l), (x, a)),)),
        ((k * (r + l), c * (x - a)), (r, x), ()),  # a distance is positive
    ],
)
def test_what_is_no_single_place_of_rest_is_not_counted(forces: Any, sought: Any, states: Any) -> None:
    assert none_is_missing(forces, sought, (), states)


def test_a_place_that_exists_for_some_letters_is_only_asked_for_there() -> None:
    forces: tuple[Expr, ...] = (k * x**3 - (c - a) * x, c * y)
    root = sqrt((c - a) / k)
    sizes = [0 * x, root, -root]
    assert none_is_missing(forces, (x, y), (), tuple(((x, s), (y, 0 * x)) for s in sizes))
