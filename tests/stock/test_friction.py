"""Coulomb friction in proportion to the force that keeps a condition, in YAML alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from sympy import Symbol, cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.places import Location
from derive.mechanics.lagrange import constraint_forces as reactions
from derive.mechanics.model import contacts
from derive.steps.step import is_zero
from tests.stock.described import complaints, edited, messages, solved

INCLINE = """\
title: A block that slides down an incline
solve: system
symbols: {m: mass, M: mass, g: acceleration, alpha: 'angle in (0, pi/2)', mu: positive number}
given:
  coordinates: {s: length, n: length}
  places: {A: [s*cos(alpha) + n*sin(alpha), n*cos(alpha) - s*sin(alpha)]}
  particles: {block: {mass: m, at: A}}
  gravity: g
  constraints: [{condition: n, force: N}]
  forces: [{components: [-mu*N*cos(alpha), mu*N*sin(alpha)], at: A}]
statement: A block slides down.
parts:
  - ask: Find the motion.
    answer: [multipliers, accelerations]
"""
WEDGE = (
    ("{s: length, n: length}", "{X: length, s: length, n: length}"),
    ("{A: [s*cos", "{W: [X, 0], A: [X + s*cos"),
    ("{block: {mass: m, at: A}}", "{block: {mass: m, at: A}, wedge: {mass: M, at: W}}"),
    ("at: A}]\n", "at: A}, {components: [mu*N*cos(alpha), -mu*N*sin(alpha)], at: W}]\n"),
)
m, M, g = symbols("m M g", positive=True)
alpha, mu = symbols("alpha mu", positive=True)


def test_a_block_on_an_incline(tmp_path: Path) -> None:
    """Taylor, section 1.7, example 1.1: N = m g cos(alpha), s_ddot = g (sin(alpha) - mu cos(alpha))."""
    steps = solved(tmp_path, INCLINE)
    assert equal(steps["N"].value, m * g * cos(alpha))
    assert equal(steps["acceleration_s"].value, g * (sin(alpha) - mu * cos(alpha)))


def test_a_block_on_a_wedge_that_slides(tmp_path: Path) -> None:
    """By Newton's laws: M X_ddot = N (mu cos - sin) and N = m g cos + m X_ddot sin."""
    steps = solved(tmp_path, edited(INCLINE, *WEDGE))
    N = M * m * g * cos(alpha) / (M + m * sin(alpha) ** 2 - mu * m * sin(alpha) * cos(alpha))
    assert equal(steps["N"].value, N)
    assert equal(steps["acceleration_X"].value, N * (mu * cos(alpha) - sin(alpha)) / M)


def test_the_energy_that_friction_takes(tmp_path: Path) -> None:
    """dh/dt = -mu N s_dot."""
    steps = solved(tmp_path, edited(INCLINE, ("[multipliers, accelerations]", "energy_function_rate")))
    found = next(explicit(q.value).right for q in steps.values() if q.step.rule == "lagrange.energy_function_rate")
    N, s_dot = Symbol("N", real=True), Symbol("s_dot", real=True)
    assert equal(found, -mu * N * s_dot)


def test_a_friction_of_no_force_is_refused(tmp_path: Path) -> None:
    found = messages(tmp_path, edited(INCLINE, ("force: N", "force: P")))
    assert any("`N` is not declared" in said for said in found), found


@pytest.mark.parametrize("factor", [2, -1])
def test_another_force_is_refused(factor: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = reactions._solution

    def wrong(problem: reactions._Problem) -> dict[Symbol, object]:
        return {s: factor * value if s.name == "N" else value for s, value in right(problem).items()}

    monkeypatch.setattr(reactions, "_solution", wrong)
    found = messages(tmp_path, INCLINE)
    assert any("second route" in said for said in found), found


PUCK = """\
title: A puck on a disc
solve: system
symbols: {m: mass, M: mass, R: length, g: acceleration, mu: positive number}
given:
  coordinates: {x: length, y: length, z: length, psi: angle}
  axes: {table: [{z: psi}]}
  bodies: {disc: {shape: disc, radius: R, mass: M, centre: [0, 0, 0], turned: table}}
  particles: {puck: {mass: m, at: [x, y, z]}}
  gravity: g
  surfaces: {top: {through: [0, 0, 0], normal: [0, 0, 1], of: disc}}
  contacts: {of: puck, on: top, normal: N, friction: {sliding: mu}}
statement: A puck slides on a disc that may turn.
parts:
  - ask: Find the accelerations.
    answer: accelerations
"""


def test_sliding_friction_in_space_is_opposite_to_the_slip_and_turns_the_disc(tmp_path: Path) -> None:
    """The angular momentum of puck and disc about the axis is constant."""
    steps = solved(tmp_path, PUCK)
    found = {key: explicit(steps[f"acceleration_{key}"].value) for key in ("x", "y", "psi")}
    names = {s.name: s for each in found.values() for s in each.free_symbols}
    torque = names["m"] * (names["x"] * found["y"] - names["y"] * found["x"])
    assert is_zero(tidied(torque + names["M"] * names["R"] ** 2 * found["psi"] / 2))


@pytest.mark.parametrize(
    "wrong", [lambda way: -1 * way, lambda way: 2 * way, lambda way: Location(way.components[::-1])]
)
def test_sliding_friction_in_another_direction_than_the_slip_is_refused(
    wrong: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = contacts._way_of_slip
    monkeypatch.setattr(contacts, "_way_of_slip", lambda slip: wrong(right(slip)))
    (found,) = complaints(tmp_path, PUCK)
    assert found.code == "unverified" and "opposite to the relative velocity" in found.message


def test_a_direction_of_slip_in_space_is_not_believed(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path, edited(PUCK, ("{sliding: mu}", "{sliding: mu, direction: [1, 0, 0]}")))
    assert "slip across `direction`" in found.message and found.place is not None


def test_a_surface_that_turns_with_a_coordinate_needs_its_body(tmp_path: Path) -> None:
    """Otherwise the opposite force would act on nothing, and the disc would not turn."""
    (found,) = complaints(tmp_path, edited(PUCK, ("of: disc}", "in: table}")))
    assert found.code == "which-body" and "`of: disc`" in str(found.help)


def test_static_friction_is_tested_where_the_assumptions_hold(tmp_path: Path) -> None:
    """A block on a wedge with the acceleration A slips up at A = g (sin + mu cos)/(cos - mu sin)."""
    text = """\
title: A block on a driven wedge
solve: system
symbols: {m: mass, A: acceleration, g: acceleration, mu_s: positive number, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {s: length, d: length}
  assume: mu_s*sin(alpha) < cos(alpha)
  places: {W: [A*t**2/2, 0]}
  particles: {block: {mass: m, at: {from: W, by: [s*cos(alpha) + d*sin(alpha), d*cos(alpha) - s*sin(alpha)]}}}
  gravity: g
  surfaces: {slope: {through: W, along: [cos(alpha), -sin(alpha)]}}
  contacts: {of: block, on: slope, normal: N, friction: {static: mu_s, force: F, direction: left}}
  results: {most: {slips: F, for: A}}
statement: A block lies on a wedge that is accelerated.
parts:
  - ask: How large may the acceleration be?
    answer: most
"""
    found = explicit(solved(tmp_path, text)["most_2"].value.right)
    numbers = {"alpha": 0.3, "mu_s": 0.4, "g": 9.8}
    wanted = 9.8 * (sin(0.3) + 0.4 * cos(0.3)) / (cos(0.3) - 0.4 * sin(0.3))
    assert float(found.subs({s: numbers[s.name] for s in found.free_symbols})) == pytest.approx(float(wanted))


def test_a_block_may_lie_in_a_bowl_on_both_sides_of_the_lowest_point(tmp_path: Path) -> None:
    """In the bowl y = x^2/(2 b) the block does not slip as long as |x| <= mu_s b."""
    text = """\
title: A block at rest in a bowl
solve: system
symbols: {m: mass, b: length, g: acceleration, mu_s: positive number}
given:
  coordinates: {x: length, y: length}
  particles: {block: {mass: m, at: [x, y]}}
  gravity: g
  surfaces: {bowl: {y: x**2/(2*b)}}
  contacts: {of: block, on: bowl, normal: N, friction: {static: mu_s, force: F, direction: right}}
  results: {far: {slips: rest_F, for: x}}
statement: A block lies in a bowl.
parts:
  - ask: How far from the lowest point?
    answer: [equilibria, far]
"""
    steps = solved(tmp_path, text)
    assert [str(steps[f"far_{i}"].value) for i in (1, 2)] == ["x <= b*mu_s", "x >= -b*mu_s"]
    assert [dict(steps[f"far_{i}"].step.words)["sense"] for i in (1, 2)] == ["left", "right"]
