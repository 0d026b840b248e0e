"""Equations to an order in what is small: the falling stone on the turning Earth, Taylor, sections 9.8 and 9.9."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from sympy import Expr, cos, oo, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    Y,
    Z,
    coordinate,
    equation_in_limit,
    equations_of_motion,
    lagrangian,
    point,
    potential,
    put_in,
    solution,
    space,
    spring,
    weight,
)
from derive.mechanics.answers import approximate
from derive.solving import leading
from derive.steps.record import recorded
from derive.steps.step import Quantity

m, M, g, l, k, W, theta, a = symbols("m M g l k Omega theta a", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[None]:
    with recorded():
        yield


def stone() -> tuple[Any, ...]:
    x, y, z = (coordinate(name, "length") for name in "xyz")
    earth = space.turned(Z, W * t).turned(Y, theta)
    L = lagrangian(System(Particle(m, earth.place(x, y, z)), potential(m * g * z.symbol)))
    return x, y, z, equations_of_motion(L)


def left(found: Quantity) -> Expr:
    return explicit(found.value).residual


def test_coriolis_force_alone_is_left_to_the_first_order() -> None:
    """z_ddot = -g + 2 Omega y_dot sin(theta): Taylor, equations 9.53."""
    x, y, z, motions = stone()
    along = [equation_in_limit(each, W, 0, 1) for each in motions]
    assert {each.step.outcome for each in along} == {"first_order"}
    assert equal(left(along[0]), m * x.acceleration - 2 * m * W * y.rate * cos(theta))
    assert equal(left(along[1]), m * y.acceleration + 2 * m * W * x.rate * cos(theta) + 2 * m * W * z.rate * sin(theta))
    assert equal(left(along[2]), m * z.acceleration - 2 * m * W * y.rate * sin(theta) + m * g)
    falling = put_in(along[1], {x.rate: 0, z.rate: -g * t})
    assert equal(solution(falling, y, 0).value, W * g * t**3 * sin(theta) / 3)  # equation 9.57


def test_leading_terms_for_a_small_letter_and_for_a_large_one() -> None:
    x, phi = coordinate("x", "length"), coordinate("phi")
    cart = point(x, 0)
    bob = point(x.symbol + l * sin(phi.symbol), -l * cos(phi.symbol))
    along, _ = equations_of_motion(
        lagrangian(System(Particle(M, cart), Particle(m, bob), spring(k, point(0, 0), cart), weight(g)))
    )
    light = equation_in_limit(along, m)
    assert light.step.outcome == "small" and equal(left(light), M * x.acceleration + k * x.symbol)
    fixed = equation_in_limit(along, M, oo)
    assert fixed.step.outcome == "large" and equal(
        left(fixed).subs(x.acceleration, 1), left(fixed).coeff(x.acceleration)
    )
    whole = equation_in_limit(along, m, 0, 1, key="whole")
    assert whole.step.outcome == "exact" and equal(left(whole), left(along))


def wheel() -> tuple[Any, Quantity]:
    """A pendulum on the rim of a wheel: Taylor, problem 7.29."""
    phi = coordinate("phi")
    rim = point(a * cos(W * t) + l * sin(phi.symbol), a * sin(W * t) - l * cos(phi.symbol))
    return phi, equations_of_motion(lagrangian(System(Particle(m, rim), weight(g))))[0]


def test_a_sine_of_the_time_is_expanded_for_short_times_alone() -> None:
    phi, motion = wheel()
    at_rest = equation_in_limit(motion, W)
    assert equal(left(at_rest), l * phi.acceleration + g * sin(phi.symbol))
    assert dict(at_rest.step.roles)["short"] == 1 / W
    assert "t" in {s.name for s in left(equation_in_limit(motion, W, 0, 3, key="third")).free_symbols}


@pytest.mark.parametrize(("letter", "said"), [("x", "changes in the motion"), ("k", "does not contain k")])
def test_wrong_letters_are_refused(letter: str, said: str) -> None:
    x, *_, motions = stone()
    with pytest.raises(Rejected, match=said):
        equation_in_limit(motions[0], {"x": x, "k": k}[letter])


def test_a_term_of_the_wrong_sign_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    _, y, _, motions = stone()
    right = approximate.arranged

    def turned(value: Relation, moving: Any) -> Relation:
        found = right(value, moving)
        return Relation(found.left.subs(y.rate, -y.rate), "=", 0)

    monkeypatch.setattr(approximate, "arranged", turned)
    with pytest.raises(Unverified):
        equation_in_limit(motions[0], W, 0, 1)


def test_a_term_that_is_left_out_wrongly_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    _, _, _, motions = stone()
    right = leading.expanded
    monkeypatch.setattr(leading, "expanded", lambda f, x, to, n: {0: right(f, x, to, n)[0]})
    with pytest.raises(Unverified):
        equation_in_limit(motions[0], W, 0, 1)
