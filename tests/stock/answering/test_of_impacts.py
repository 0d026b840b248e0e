"""What parts ask of an impact that is told in YAML alone."""

from __future__ import annotations

from pathlib import Path

from sympy import Rational, symbols

from derive.algebra.equality import equal
from tests.stock.described import edited, solved
from tests.stock.keys.test_impacts import BULLET, HIT

M, m, l, b, v, R = symbols("M m l b v R", positive=True)
J = symbols("J", real=True)
MOMENT = M * l**2 / 3 + m * b**2
ASKED = "answer: theta_dot_after"


def test_a_bullet_gets_stuck(tmp_path: Path) -> None:
    """Kleppner, chapter 6, by hand: m v b = (M l^2/3 + m b^2) theta_dot."""
    results = "{lost: {value: -work_of_impulses}, rest: {limit: theta_dot_after, for: M, to: 0}}"
    made = ("statement:", f"  results: {results}\nstatement:")
    found = solved(tmp_path, edited(BULLET, made, (ASKED, "answer: [rates_after, K_x, lost, rest, meetings, jumps]")))
    assert equal(found["theta_dot_after"].value, m * v * b / MOMENT)
    assert equal(found["K_x"].value, M * l**2 / 3 * m * v / MOMENT)
    assert equal(found["lost"].value, m * v**2 / 2 * M * l**2 / 3 / MOMENT)
    assert equal(found["rest"].value, v / b)
    assert "meeting_1" in found and "jump_x" in found


def test_an_elastic_bullet_and_one_with_restitution(tmp_path: Path) -> None:
    """By hand: b theta_dot - x_dot = e v, and m (v - x_dot) b = (M l^2/3) theta_dot."""
    hit = (HIT, "collisions: {from: B, to: A, along: [1, 0], restitution: e, impulse: N}")
    found = solved(tmp_path, edited(BULLET, hit, (ASKED, "answer: [rates_after, N, kinetic_energy_after]")))
    e = next(s for s in found["theta_dot_after"].value.free_symbols if s.name == "e")
    assert equal(found["theta_dot_after"].value, (1 + e) * m * v * b / MOMENT)
    assert equal(found["N"].value, (1 + e) * m * v * M * l**2 / 3 / MOMENT)


def test_impulses_that_are_given(tmp_path: Path) -> None:
    """An impulse J across the rod at b turns it at 3 J b/(M l^2); an angular one J b too."""
    for hit in ("impulses: {components: [J, 0], at: A}", "impulses: {angular: J*b, on: theta}"):
        found = solved(tmp_path, edited(BULLET, (HIT, hit), (ASKED, "answer: [theta_dot_after, x_dot_after]")))
        assert equal(found["theta_dot_after"].value, 3 * J * b / (M * l**2))
        assert equal(found["x_dot_after"].value, v)


def test_a_rod_that_strikes_the_ground(tmp_path: Path) -> None:
    """By hand: the end stops, K = M l^2 theta_dot/(3 b) at the place b below the pivot."""
    edits = ("    before: {x_dot: v}\n", "    before: {theta_dot: v/b}\n"), (HIT, "collisions: {at: A, impulse: N}")
    found = solved(tmp_path, edited(BULLET, *edits, (ASKED, "answer: [theta_dot_after, N_x, work_of_impulses]")))
    assert found["theta_dot_after"].value == 0
    assert equal(found["N_x"].value, -M * l**2 * v / (3 * b**2))
    assert equal(found["work_of_impulses"].value, -Rational(1, 6) * M * l**2 * v**2 / b**2)


def test_impulses_of_constraints(tmp_path: Path) -> None:
    """By hand: of two particles at m and m on a rigid rod along x, each takes half of J."""
    text = """\
title: Two on a rod
solve: system
symbols: {m: mass, l: length, J: momentum}
given:
  coordinates: {x: length, y: length}
  particles: {one: {mass: m, at: [x, 0]}, two: {mass: m, at: [y, 0]}}
  constraints: {condition: y - x, equals: l, force: S}
  impact: {impulses: {components: [J, 0], at: [x, 0]}}
statement: Two.
parts:
  - ask: Find what is asked.
    answer: [rates_after, J_S]
"""
    found = solved(tmp_path, text)
    assert equal(found["x_dot_after"].value, J / (2 * m))
    assert equal(found["J_S"].value, J / 2)
