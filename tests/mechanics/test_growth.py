"""What is called unstable runs away: the linearised motion in numbers, beside the potential energy alone."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from sympy import Expr, Rational, symbols

from derive.algebra.expressions import TIME as t
from derive.errors import Unverified
from derive.mechanics import (
    Particle,
    System,
    Z,
    charge,
    coordinate,
    lagrangian,
    point,
    potential,
    potential_energy_of,
    space,
    stability,
)
from derive.mechanics.rest import growth
from derive.mechanics.rest import stability as minima
from derive.mechanics.rest.growth import grows_always, is_turned_aside
from derive.steps.record import recorded

m, q, B, k, c, w = symbols("m q B k c omega", positive=True)


@pytest.fixture(autouse=True)
def steps() -> Iterator[Any]:
    with recorded() as found:
        yield found


@pytest.fixture
def unguarded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(minima, "_check_nothing_else_holds_it", lambda *_: None)


def on_plane(energy: Any, field: Expr | None = None) -> tuple[System, Any, Any]:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    at = point(x, y)
    parts = [Particle(m, at), potential(energy(x.symbol, y.symbol))]
    return System(*parts, *([] if field is None else [charge(q, at, B=field)])), x, y


@pytest.mark.parametrize(
    "energy",
    [
        lambda x, y: -k * (x**2 + y**2) / 2,
        lambda x, y: (c - k) * (x**2 + y**2) / 2,
    ],
)
@pytest.mark.usefixtures("unguarded")
def test_a_field_may_hold_what_the_energy_alone_calls_unstable(energy: Any) -> None:
    """A charge on a hill circles in a field that is strong enough: Goldstein, section 5.7, of the sleeping top."""
    hill, x, y = on_plane(energy, B)
    with pytest.raises(Unverified, match="could not be confirmed"):
        stability(potential_energy_of(hill), {x: 0, y: 0})


@pytest.mark.parametrize("energy", [lambda x: -k * x**2 / 2, lambda x: -k * x**4])
@pytest.mark.usefixtures("unguarded")
def test_on_a_ridge_in_a_field_one_coordinate_does_not_decide(energy: Any) -> None:
    """Across the field of its motion along the ridge the charge is held: x_ddot = -(q B/m)^2 x + ..."""
    ridge, x, _ = on_plane(lambda x, _: energy(x), B)
    with pytest.raises(Unverified, match="could not be confirmed"):
        stability(potential_energy_of(ridge), {x: 0})


@pytest.mark.usefixtures("unguarded")
def test_a_table_that_turns_holds_a_puck_on_a_spring_however_fast() -> None:
    """Seen from the floor the puck oscillates with k/m; in the frame the energy is (k - m omega^2) r^2/2."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    place = space.turned(Z, w * t).place(x, y, 0)
    L = lagrangian(System(Particle(m, place), potential(k * (x.symbol**2 + y.symbol**2) / 2)))
    with pytest.raises(Unverified, match="could not be confirmed"):
        stability(L, {x: 0, y: 0})


def test_without_a_field_a_hill_is_unstable() -> None:
    hill, x, y = on_plane(lambda x, y: (c * x**2 - k * y**2) / 2)
    assert stability(potential_energy_of(hill), {x: 0, y: 0}).step.outcome == "unstable"


def test_a_field_does_not_hold_a_saddle() -> None:
    """An odd number of falling directions is held by no field: the product of all exponents is det K/det M."""
    x, y = on_plane(lambda x, y: x)[1:]
    system, *_ = on_plane(lambda x, y: (c * x**2 - k * y**2) / 2, B)
    points = [{k: Rational(3), c: Rational(1, 3)}, {k: Rational(1, 3), c: Rational(3)}]
    there = {x.symbol: Rational(0), y.symbol: Rational(0)}
    assert grows_always(system.matter, there, points)
    assert is_turned_aside(system.matter, there, points)
    hill, *_ = on_plane(lambda x, y: -(c * x**2 + k * y**2) / 2, B)
    assert not grows_always(hill.matter, there, points)


def test_numbers_without_a_motion_are_skipped(monkeypatch: pytest.MonkeyPatch) -> None:
    """If no definite motion exists for the first numbers, the other numbers still decide."""
    valley, x, y = on_plane(lambda x, y: (c * x**2 + k * y**2) / 2)
    points = [{k: Rational(3), c: Rational(1, 3)}, {k: Rational(1, 3), c: Rational(3)}]
    there = {x.symbol: Rational(0), y.symbol: Rational(0)}
    right = growth._motion
    monkeypatch.setattr(growth, "_motion", lambda *at: None if at[2] is points[0] else right(*at))
    assert not grows_always(valley.matter, there, points)
