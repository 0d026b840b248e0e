"""Noether's theorem: translations, rotations, a screw, a boost; and what is no symmetry."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Expr, Function, cos, sin, symbols

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import bound, explicit, scalar
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    Z,
    coordinate,
    lagrangian,
    noether,
    point,
    potential,
    space,
    spring,
    weight,
)
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity

m, m1, m2, g, l, k, w, h = symbols("m m_1 m_2 g l k omega h", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def lengths(*names: str) -> tuple[Coordinate, ...]:
    return tuple(coordinate(name, "length") for name in names)


def oscillator() -> tuple[Quantity, Coordinate, Coordinate]:
    x, y = lengths("x", "y")
    at = point(x, y)
    return lagrangian(System(Particle(m, at), spring(k, point(0, 0), at))), x, y


def same(found: Quantity, expected: Expr) -> bool:
    return bool(equal(explicit(found.value), expected)) and found.step.grade is Grade.PROVED


def test_a_rotation_gives_the_angular_momentum() -> None:
    L, x, y = oscillator()
    found = noether(L, {x: -y, y: x}, symbol="J")
    assert same(found, m * (x.symbol * y.rate - y.symbol * x.rate))
    assert (found.symbol, found.step.outcome) == (scalar("J"), "symmetry")


def test_derivatives_and_their_values_have_the_same_order() -> None:
    L, x, y = oscillator()
    with recorded() as run:
        noether(L, {x: -y, y: x})
    (change,) = (each for each in run.established if each.key == "noether_change")
    derivatives, values = (form.expr.left.args for form in change.step.chain)
    assert [explicit(bound(each, {L.symbol: L.value})) for each in derivatives] == list(values)
    assert values[0] == -values[1] == -k * x.symbol * y.symbol
    assert values[2] == -values[3] == m * x.rate * y.rate


def test_a_translation_of_two_masses_on_a_spring_gives_their_momentum() -> None:
    x, y = lengths("x", "y")
    first, second = point(x, 0), point(l + y, 0)
    L = lagrangian(System(Particle(m1, first), Particle(m2, second), spring(k, first, second, l)))
    assert same(noether(L, {x: 1, y: 1}), m1 * x.rate + m2 * y.rate)


def test_a_cyclic_coordinate_is_the_plainest_symmetry() -> None:
    q, phi = coordinate("theta"), coordinate("phi")
    at = point(l * sin(q) * cos(phi), l * sin(q) * sin(phi), -l * cos(q))
    L = lagrangian(System(Particle(m, at), weight(g)))
    assert same(noether(L, {phi: 1}), m * l**2 * phi.rate * sin(q.symbol) ** 2)


def test_a_rotation_in_turning_axes_gives_the_angular_momentum_in_space() -> None:
    x, y = lengths("x", "y")
    at = space.turned(Z, w * t).place(x, y, 0)
    L = lagrangian(System(Particle(m, at), spring(k, 0 * Z, at)))
    expected = m * (x.symbol * y.rate - y.symbol * x.rate) + m * w * (x.symbol**2 + y.symbol**2)
    assert same(noether(L, {x: -y, y: x}), expected)


def in_a_helical_field() -> tuple[Quantity, Coordinate, Coordinate]:
    phi, z = coordinate("phi"), coordinate("z", "length")
    particle = Particle(m, point(l * cos(phi), l * sin(phi), z))
    return lagrangian(System(particle, potential(k * l**2 * cos(phi.symbol - 2 * z.symbol / h)))), phi, z


def test_a_screw_gives_momentum_and_angular_momentum_together() -> None:
    """Landau, Lifshitz, section 9, problem 3: M_z + P_z h/2pi."""
    L, phi, z = in_a_helical_field()
    found = noether(L, {phi: 1, z: h / 2})
    assert same(found, m * l**2 * phi.rate + m * h * z.rate / 2)
    with pytest.raises(Rejected, match="not a symmetry"):
        noether(L, {phi: 1})


def test_a_boost_gives_the_place_from_which_the_centre_of_mass_started() -> None:
    """Landau, Lifshitz, section 8: the Lagrangian gains the rate of m x."""
    (x,) = lengths("x")
    L = lagrangian(System(Particle(m, point(x, 0))))
    found = noether(L, {x: t}, gained=m * x)
    assert same(found, m * x.rate * t - m * x.symbol)
    assert found.step.outcome == "with_gain"


def test_what_falls_gains_momentum_at_a_known_rate() -> None:
    (z,) = lengths("z")
    L = lagrangian(System(Particle(m, point(0, z)), weight(g)))
    assert same(noether(L, {z: 1}, gained=-m * g * t), m * z.rate + m * g * t)


@pytest.mark.parametrize(
    ("shift", "said"),
    [
        (lambda x, y: {x: 1}, r"changes `lagrangian` by epsilon times -k\*x"),
        (lambda x, y: {x: y, y: x}, "not a symmetry"),
        (lambda x, y: {x: 0}, "moves no coordinate"),
        (lambda x, y: {x.symbol: 1}, "needs a mapping from coordinates to shifts"),
        (lambda x, y: {x: x.rate}, "without rates"),
        (lambda x, y: {x: Function}, "without rates"),
        (lambda x, y: {coordinate("z", "length"): 1}, "does not depend on the coordinate"),
    ],
)
def test_what_is_no_symmetry_is_refused(shift: Callable[..., Any], said: str) -> None:
    L, x, y = oscillator()
    with pytest.raises(Rejected, match=said):
        noether(L, shift(x, y))


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("_times", lambda derivative, factor: 2 * factor * derivative),
        ("vanishes", lambda value: True),
        ("Terms", lambda *terms: terms[0]),
    ],
)
def test_a_wrong_law_is_refused(name: str, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    L, x, y = oscillator()
    monkeypatch.setattr(f"derive.mechanics.lagrange.symmetry.{name}", wrong)
    shift: dict[Coordinate, Any] = {x: y, y: x} if name == "vanishes" else {x: -y, y: x}
    with pytest.raises(Unverified):
        noether(L, shift)
