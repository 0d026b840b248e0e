"""Coulomb friction in proportion to the force that keeps a condition, in YAML alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Symbol, cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit
from derive.mechanics.lagrange import constraint_forces as reactions
from tests.stock.described import edited, messages, solved

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
