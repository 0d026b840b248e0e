"""Motions of coupled coordinates from their start, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from sympy import Expr, Rational, cos, cosh, exp, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    coordinate,
    damping,
    equations_of_motion,
    lagrangian,
    linearised,
    motions_by_modes,
    normal_modes,
    point,
    potential,
)
from derive.mechanics.vibrations import superposition
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity
from tests.stock.described import messages, solved

m, M, k, b, A, v = symbols("m M k b A v", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def carts(energy: Expr, *drag: Expr, other: Expr = m) -> tuple[Coordinate, Coordinate, tuple[Quantity, ...]]:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    places = (point(x.symbol, 0), point(y.symbol, 0))
    parts = [Particle(mass, at) for mass, at in zip((m, other), places, strict=True)]
    drags = [damping(c, at) for c, at in zip(drag, places, strict=False)]
    L = lagrangian(System(*parts, potential(energy), *drags))
    linear = linearised(equations_of_motion(L))
    assert isinstance(linear, tuple)
    return x, y, normal_modes(linear)


def three_springs() -> Expr:
    x, y = coordinate("x", "length").symbol, coordinate("y", "length").symbol
    return k * (x**2 + y**2 + (x - y) ** 2) / 2


def test_two_carts_one_of_which_is_released() -> None:
    """Taylor, section 11.2, equation (11.22): x = A/2 (cos(omega_1 t) + cos(omega_2 t)), omega_2 = sqrt(3) omega_1."""
    x, _, modes = carts(three_springs())
    one, other = motions_by_modes(modes, {x: A})
    slow, fast = cos(sqrt(k / m) * t), cos(sqrt(3 * k / m) * t)
    assert equal(one.value, A * (slow + fast) / 2)
    assert equal(other.value, A * (slow - fast) / 2)


def test_a_push_and_a_start_together() -> None:
    x, y, modes = carts(three_springs())
    one, other = motions_by_modes(modes, {x: A, y: A}, {x: v, y: -v})
    w = sqrt(k / m)
    assert equal(one.value, A * cos(w * t) + v / (sqrt(3) * w) * sin(sqrt(3) * w * t))
    assert equal(other.value, A * cos(w * t) - v / (sqrt(3) * w) * sin(sqrt(3) * w * t))


def test_a_free_molecule_that_is_struck() -> None:
    """Landau, section 24: two masses on one spring; one is struck: the centre of mass goes on with m v/(m + M)."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    _, _, modes = carts(k * (x.symbol - y.symbol) ** 2 / 2, other=M)
    one, other = motions_by_modes(modes, {}, {x: v})
    w = sqrt(k * (m + M) / (m * M))
    assert equal(one.value, m * v * t / (m + M) + M * v / ((m + M) * w) * sin(w * t))
    assert equal(other.value, m * v * t / (m + M) - m * v / ((m + M) * w) * sin(w * t))


def test_what_is_not_held_grows() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    _, _, modes = carts(-k * (x.symbol**2 + y.symbol**2) / 2 + k * (x.symbol - y.symbol) ** 2 / 2)
    one, other = motions_by_modes(modes, {x: A, y: A})
    assert equal(one.value, A * cosh(sqrt(k / m) * t))
    assert equal(other.value, one.value)


def test_a_drag_that_goes_with_the_masses() -> None:
    """Each mode dies away as one damped oscillator does: Taylor, equation (5.38), along (1, 1) and (1, -1)."""
    x, _, modes = carts(three_springs(), b, b)
    one, _ = motions_by_modes(modes, {}, {x: v}, case="underdamped")
    slow, fast = (sqrt(n * k / m - b**2 / (4 * m**2)) for n in (1, 3))
    swings = sin(slow * t) / slow + sin(fast * t) / fast
    assert equal(
        explicit(one.value).subs(b, k * m / 100), (v / 2 * exp(-b * t / (2 * m)) * swings).subs(b, k * m / 100)
    )


def test_a_drag_that_mixes_the_modes_is_refused() -> None:
    linear = carts(three_springs())[2]
    assert linear
    x, y = coordinate("x", "length"), coordinate("y", "length")
    with pytest.raises(Rejected, match=r"do not separate|mix the modes|does not factor"):
        motions_by_modes(carts(three_springs(), b)[2], {x: A, y: A})


def test_a_start_that_is_none_is_refused() -> None:
    x, _, modes = carts(three_springs())
    with pytest.raises(Rejected, match="is not one"):
        motions_by_modes(modes, {coordinate("z", "length"): A})
    with pytest.raises(Rejected, match="start of x"):
        motions_by_modes(modes, {x: A * t})


@pytest.mark.parametrize("factor", [Rational(1, 2), -1])
def test_a_wrong_share_of_a_mode_is_refused(factor: Expr, monkeypatch: pytest.MonkeyPatch) -> None:
    x, _, modes = carts(three_springs())
    right = superposition.ExcitedMode.course
    monkeypatch.setattr(superposition.ExcitedMode, "course", lambda self, w: factor * right(self, w))
    monkeypatch.setattr(superposition, "_as_product", lambda *_: None)
    with pytest.raises(Unverified, match=r"its check `(put_back|start)`"):
        motions_by_modes(modes, {x: A})


TWO = """\
title: Two circuits
solve: system
symbols: {L_1: inductance, C_1: capacitance, C_2: capacitance, Q: charge}
given:
  coordinates: {q: charge, u: charge}
  lagrangian: L_1*(q_dot**2 + u_dot**2)/2 - (q**2 + u**2)/(2*C_1) - (q - u)**2/(2*C_2)
  results:
    both: {solution: normal_modes, values: {q: Q}}
statement: Two circuits.
parts:
  - ask: Find the charges.
    answer: both
"""


def test_it_is_asked_for_in_yaml_alone(tmp_path: Path) -> None:
    steps = solved(tmp_path, TWO)
    L_1, C_1, C_2, Q = symbols("L_1 C_1 C_2 Q", positive=True)
    Q = next(s for s in explicit(steps["both_q"].value).free_symbols if s.name == "Q")
    slow, fast = sqrt(1 / (L_1 * C_1)), sqrt((2 * C_1 + C_2) / (L_1 * C_1 * C_2))
    assert equal(steps["both_q"].value, Q * (cos(slow * t) + cos(fast * t)) / 2)
    assert equal(steps["both_u"].value, Q * (cos(slow * t) - cos(fast * t)) / 2)
    strange = messages(tmp_path, TWO.replace("{q: Q}", "{L_1: Q}"))
    assert any("is neither" in said for said in strange), strange
