"""A witness that is wrong itself contradicts right pages: what it judges finds it out."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from sympy import Symbol, cos, sin, symbols

from derive.algebra.expressions import rate
from derive.errors import Unverified
from derive.mechanics import (
    Ball,
    Particle,
    System,
    Z,
    accelerations,
    charge,
    constraint,
    coordinate,
    damping,
    equations_of_motion,
    force,
    lagrangian,
    point,
    space,
    spring,
    t,
    weight,
)
from derive.steps.record import recorded
from derive.witness import dynamics, geometry, judges, tape

m, M, g, k, b, q, B, F, R, l, w, a = symbols("m M g k b q B F R l omega a", positive=True)


@pytest.fixture(autouse=True)
def _run() -> Iterator[None]:
    judges.blueprint.cache_clear()
    with recorded():
        yield
    judges.blueprint.cache_clear()


def systems() -> Iterator[System]:
    x, y, theta = coordinate("x"), coordinate("y"), coordinate("theta", "angle")
    here = point(x.symbol, y.symbol)
    acting = (weight(g), spring(k, point(0, 0), here, l), damping(b, here), charge(q, here, B=B), force((F, 0), here))
    yield System(Particle(m, here), *acting)
    yield System(Particle(m, space.turned(Z, w * t).place(R * sin(theta.symbol), 0, -R * cos(theta.symbol))), weight(g))
    yield System(Particle(m, here), weight(g), constraint(x.symbol**2 + y.symbol**2, l**2, force="S"))
    length = l + w * l * t
    yield System(Particle(m, point(length * sin(theta.symbol), -length * cos(theta.symbol))), weight(g))
    ball = Ball(a, M).placed(theta.symbol, here)
    yield System(ball, force((F, 0), point(x.symbol, y.symbol + a), of=ball))


def pages() -> None:
    for number in range(5):
        with recorded():
            system = list(systems())[number]
            motions = equations_of_motion(lagrangian(system))
            if system.constraints:
                accelerations(*motions)


def test_a_right_witness_agrees_with_all_of_them() -> None:
    pages()


def turned(original: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *given: -original(*given)


def doubled(original: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *given: 2 * original(*given)


@pytest.mark.parametrize(
    ("where", "name", "change"),
    [
        (dynamics, "_across", turned),
        (dynamics, "jacobian_of", doubled),
        (dynamics.Dynamics, "_stored", turned),
        (dynamics.Dynamics, "_given", doubled),
        (geometry.PlacedBody, "jacobian_at", turned),
    ],
)
def test_a_force_with_another_sign_or_size_is_found_out(
    where: Any, name: str, change: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(where, name, change(getattr(where, name)))
    with pytest.raises(Unverified, match="contradicts the motion"):
        pages()


@pytest.mark.parametrize(
    ("module", "name", "value"),
    [
        (geometry, "WEIGHTS", -geometry.WEIGHTS),
        (geometry, "AROUND", geometry.AROUND[::-1].copy()),
        (dynamics, "WEIGHTS", -dynamics.WEIGHTS),
    ],
)
def test_another_derivative_is_found_out(module: Any, name: str, value: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, name, value)
    with pytest.raises(Unverified, match="contradicts the motion"):
        pages()


@pytest.mark.parametrize(("function", "wrong"), [(sin, np.cos), (cos, np.sin)])
def test_another_function_is_found_out(function: Any, wrong: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tape, "FUNCTIONS", {**tape.FUNCTIONS, function: wrong})
    with pytest.raises(Unverified, match="contradicts the motion"):
        pages()


def test_a_witness_that_sees_nothing_gives_no_evidence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tape, "LARGEST", 3)
    x = coordinate("x")
    cart = point(x.symbol, 0)
    (found,) = equations_of_motion(lagrangian(System(Particle(m, cart), spring(k, point(0, 0), cart))))
    assert [e for e in found.step.evidence if e.compared == "witness"] == []
    assert isinstance(rate(x.symbol), Symbol)
