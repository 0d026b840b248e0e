"""A long formula with a symbol is printed once, and an equation that is linear already is not repeated."""

from __future__ import annotations

from pathlib import Path

from sympy import cos, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.building.solution import rendered
from tests.stock.described import course_with, solved

PENDULUMS = """\
title: Two pendulums
solve: system
symbols: {m: mass, k: spring constant, l: length, d: length, g: acceleration}
given:
  coordinates: {theta: angle, phi: angle}
  places: {A: [l*sin(theta), -l*cos(theta)], B: [d + l*sin(phi), -l*cos(phi)]}
  particles: {one: {mass: m, at: A}, other: {mass: m, at: B}}
  springs: {constant: k, length: d, from: A, to: B}
  gravity: g
  at: {theta: 0, phi: 0}
statement: Two pendulums hang side by side.
parts:
  - {ask: Find the Lagrangian., answer: lagrangian}
drawings: {system: {at: hidden}}
"""
CART = """\
title: A cart
solve: system
symbols: {m: mass, k: spring constant, a: length}
given:
  coordinates: {x: length}
  places: {wall: [0, 0], cart: [a + x, 0]}
  particles: {cart: {mass: m, at: cart}}
  springs: {constant: k, length: a, from: wall, to: cart}
statement: A cart is held by a spring.
parts:
  - {ask: Find the equation of motion., answer: equations_of_motion}
  - {ask: Find the normal modes., answer: normal_modes}
drawings: {system: {at: hidden}}
"""


def test_a_long_length_has_a_letter(tmp_path: Path) -> None:
    text = " ".join(rendered(course_with(tmp_path, PENDULUMS), "trial/one", only={"text"}).texts["text"].split())
    assert "The length of the spring is s = √((d + l sin φ - l sin θ)² + (l cos θ - l cos φ)²)" in text
    assert "1/2 m l² ((θ̇)² + (φ̇)²) - 1/2 k (s - d)²" in text
    assert text.count("√") == 1


def test_what_is_handed_on_is_the_formula(tmp_path: Path) -> None:
    """Lagrange's equations need the formula, because they would treat its symbol as a constant."""
    steps = solved(tmp_path, PENDULUMS)
    k, l, d, m, g = symbols("k l d m g", positive=True)
    theta, phi = symbols("theta phi", real=True)
    length = sqrt((d + l * sin(phi) - l * sin(theta)) ** 2 + (l * cos(theta) - l * cos(phi)) ** 2)
    assert equal(steps["distance"].value, length)
    expected = k * (length - d) ** 2 / 2 - m * g * l * (cos(theta) + cos(phi))
    assert equal(steps["potential_energy"].value, expected)


def test_another_letter_where_the_problem_has_that_one(tmp_path: Path) -> None:
    renamed = PENDULUMS.replace("d: length", "s: length").replace("[d +", "[s +").replace("length: d", "length: s")
    assert (
        "u = √((s + l sin φ - l sin θ)²"
        in rendered(course_with(tmp_path, renamed), "trial/one", only={"text"}).texts["text"]
    )


def test_short_lengths_stay_as_they_are(tmp_path: Path) -> None:
    text = rendered(course_with(tmp_path, CART), "trial/one", only={"text"}).texts["text"]
    assert "The length of the spring" not in text


def test_an_equation_that_is_linear_already_stands_once(tmp_path: Path) -> None:
    text = rendered(course_with(tmp_path, CART), "trial/one", only={"text"}).texts["text"]
    assert text.count("+ k x = 0") == 1
    asked = CART.replace("answer: normal_modes", "answer: linearised")
    again = rendered(course_with(tmp_path / "asked", asked), "trial/one", only={"text"}).texts["text"]
    assert "is already linear" in again


def test_that_no_spring_is_pressed_to_nothing_is_told_where_it_is_used(tmp_path: Path) -> None:
    text = rendered(course_with(tmp_path, CART), "trial/one", only={"text"}).texts["text"]
    assert "It is assumed" not in text
    assert "so the potential energy, as long as the spring is not compressed to zero length, is" in " ".join(
        text.split()
    )
