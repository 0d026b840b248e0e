"""Coordinates that several contacts or strings together keep constant have their values in forces and accelerations."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Expr, Integer, Rational, Symbol, cos, pi, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, Relation
from derive.mechanics.lagrange import constraint_forces
from derive.mechanics.lagrange.fixed_coordinates import KeptPositions
from derive.stock.answering import equilibria_with_forces
from tests.stock.described import edited, messages, solved

PLANK = """\
title: A plank on two rollers
solve: system
symbols: {m: mass, b: length, l: length, mu: coefficient of friction, g: acceleration}
given:
  coordinates: {x: length, y: length, theta: angle}
  bodies: {plank: {shape: rod, length: l, mass: m, centre: [x, y], along: [cos(theta), sin(theta)]}}
  surfaces: {under: {through: plank, along: [-cos(theta), -sin(theta)], of: plank}}
  contacts:
    - {of: [-b, 0], on: under, normal: N_1, friction: {sliding: mu, direction: [cos(theta), sin(theta)]}}
    - {of: [b, 0], on: under, normal: N_2, friction: {sliding: mu, direction: [-cos(theta), -sin(theta)]}}
  gravity: g
statement: A plank lies on two rollers that rotate in opposite senses.
parts:
  - {ask: Find the forces and the acceleration., answer: [N_1, N_2, acceleration_x]}
"""
CAR = """\
title: A car with locked wheels
solve: system
symbols: {m: mass, a: length, b: length, h: length, I: moment of inertia, mu: coefficient of friction, g: acceleration}
given:
  coordinates: {x: length, y: length, theta: angle}
  bodies: {car: {moments: I, mass: m, centre: [x, y], turned: theta}}
  places:
    front: {from: car, by: [a*cos(theta) + h*sin(theta), a*sin(theta) - h*cos(theta)]}
    rear: {from: car, by: [-b*cos(theta) + h*sin(theta), -b*sin(theta) - h*cos(theta)]}
  surfaces: {road: {through: [0, 0], along: [1, 0]}}
  contacts:
    - {of: front, on: road, normal: N_1, friction: {sliding: mu, direction: right}}
    - {of: rear, on: road, normal: N_2, friction: {sliding: mu, direction: right}}
  gravity: g
statement: A car brakes.
parts:
  - {ask: Find the forces., answer: [N_1, N_2]}
"""
SHAFT = """\
title: A ball on two strings
solve: system
symbols: {m: mass, l: length, g: acceleration, Omega: positive angular speed}
given:
  coordinates: {x: positive length, z: length}
  axes: {shaft: [{z: Omega*t}]}
  particles: {ball: {mass: m, at: {in: shaft, by: [x, 0, z]}}}
  strings:
    - {from: [0, 0, l/2], to: ball, length: l, tension: S_1}
    - {from: [0, 0, -l/2], to: ball, length: l, tension: S_2}
  gravity: g
statement: A ball is held by two strings.
parts:
  - {ask: Find the tensions., answer: [S_1, S_2]}
"""
COIN = """\
title: A coin on a turntable
solve: system
symbols: {m: mass, g: acceleration, mu_s: coefficient of friction, Omega: positive angular speed}
given:
  coordinates: {x: length, y: length, z: length}
  axes: {table: [{z: Omega*t}]}
  particles: {coin: {mass: m, at: {in: table, by: [x, y, z]}}}
  surfaces: {top: {through: [0, 0, 0], normal: [0, 0, 1], in: table}}
  contacts: {of: coin, on: top, normal: N, friction: {static: mu_s, force: F}}
  gravity: g
statement: A coin lies on a turntable.
parts:
  - {ask: Find the friction., answer: F_x}
"""
SHELF = """\
title: A shelf on a hinge and a string
solve: system
symbols: {m: mass, l: length, g: acceleration, beta: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, y: length, theta: 'angle in (-pi/2, pi/2)'}
  bodies: {shelf: {shape: rod, length: l, mass: m, centre: [x, y], along: [cos(theta), sin(theta)]}}
  joints: {of: shelf.end, to: [0, 0], force: R}
  strings: {from: shelf.far_end, to: [0, l*tan(beta)], length: l/cos(beta), tension: S}
  gravity: g
statement: A shelf is held by a string.
parts:
  - {ask: Find the forces., answer: equilibria}
"""
STEP = """\
title: A wheel at a step
solve: system
symbols: {m: mass, R: length, h: length, g: acceleration, F: positive force}
given:
  coordinates: {x: positive length, y: length}
  bodies: {wheel: {shape: disc, radius: R, mass: m, centre: [-x, y], turned: 0}}
  surfaces: {floor: {through: [0, 0], along: [1, 0]}}
  contacts:
    - {of: wheel, on: floor, normal: N}
    - {of: [0, h], on: wheel, normal: K}
  forces: {at: wheel, components: [F, 0]}
  assume: [h < R]
  gravity: g
  results: {least: {where: rest_N, is: <=, for: F}}
statement: A force F at its centre pulls a wheel against a step.
parts:
  - {ask: Find the forces that lift the wheel., answer: least}
"""
m, g, l, a, b, h, mu, Omega = symbols("m g l a b h mu Omega", positive=True)
x, y = symbols("x y", real=True)


def test_a_plank_on_two_rollers(tmp_path: Path) -> None:
    """The torques about each roller vanish, and m x_ddot = mu (N_1 - N_2)."""
    steps = solved(tmp_path, PLANK)
    assert equal(steps["N_1"].value, m * g * (b - x) / (2 * b))
    assert equal(steps["N_2"].value, m * g * (b + x) / (2 * b))
    assert equal(steps["acceleration_x"].value, -mu * g * x / b)


def test_two_wheels_are_places_that_move_with_the_car(tmp_path: Path) -> None:
    """The torques about the rear wheel: N_1 (a + b) = m g b + m (mu g) h."""
    steps = solved(tmp_path, CAR)
    assert equal(steps["N_1"].value, m * g * (b + mu * h) / (a + b))
    assert equal(steps["N_2"].value, m * g * (a - mu * h) / (a + b))


def test_a_place_that_does_not_turn_with_the_car_is_no_wheel(tmp_path: Path) -> None:
    found = messages(tmp_path, edited(CAR, ("[a*cos(theta) + h*sin(theta), a*sin(theta) - h*cos(theta)]", "[a, -h]")))
    assert any("`contact` needs a particle" in said for said in found), found


def test_two_strings_on_a_shaft(tmp_path: Path) -> None:
    """With x = sqrt(3)/2 l and z = 0: (S_1 + S_2)/2 x = ... = m Omega^2 x l/2, and (S_1 - S_2)/2 = m g."""
    steps = solved(tmp_path, SHAFT)
    assert equal(steps["S_1"].value, m * (l * Omega**2 / 2 + g))
    assert equal(steps["S_2"].value, m * (l * Omega**2 / 2 - g))


def test_static_friction_in_two_directions_keeps_the_rates_zero(tmp_path: Path) -> None:
    """The force is m Omega^2 times the distance, towards the axis."""
    steps = solved(tmp_path, COIN)
    wt = Omega * TIME
    assert equal(steps["F_x"].value, -m * Omega**2 * (x * cos(wt) - y * sin(wt)))


def test_a_shelf_rests_where_its_hinge_and_its_string_together_hold_it(tmp_path: Path) -> None:
    """The torques about the hinge: S l sin(beta) = m g l/2. The first equation at rest gives the reason."""
    steps = solved(tmp_path, SHELF)
    beta = next(s for s in steps["rest_S"].value.free_symbols if s.name == "beta")
    assert equal(steps["rest_S"].value, m * g / (2 * sin(beta))) and equal(steps["rest_R_y"].value, m * g / 2)
    assert [steps[f"still_{q}"].step.words for q in ("x", "y", "theta")] == [(("fixed", "together"),), (), ()]


def test_a_wheel_leaves_the_floor_at_a_step(tmp_path: Path) -> None:
    """The torques about the edge of the step: F (R - h) = m g sqrt(R^2 - (R - h)^2)."""
    R = Symbol("R", positive=True)
    least = solved(tmp_path, STEP)["least"].value
    assert least.operator == ">=" and equal(least.right.subs({R: 5, h: 2}), m * g * Rational(4, 3))


def test_the_reason_for_a_position_must_fix_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = KeptPositions({x: l / 2, y: Integer(0)}, (x - l / 2,))
    monkeypatch.setattr(equilibria_with_forces, "positions_kept", lambda _: wrong)
    assert any("could not be confirmed" in said for said in messages(tmp_path, SHELF))


@pytest.mark.parametrize(("height", "angle"), [(l, Integer(0)), (Integer(0), pi / 2)])
def test_other_constant_values_are_refused(
    height: Expr, angle: Expr, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = {0: Relation(y, "=", height), 1: Relation(symbols("theta", real=True), "=", angle)}
    monkeypatch.setattr(constraint_forces, "_together", lambda *_: wrong)
    assert messages(tmp_path, PLANK)
