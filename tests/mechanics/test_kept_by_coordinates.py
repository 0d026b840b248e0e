"""Rods, strings, rails, wires, pulleys and rims that the coordinates already keep, and what is wrong with a description
of them."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Rational, simplify, symbols

from derive.algebra.expressions import explicit
from tests.stock.described import edited, messages, solved

SWINGS = """
title: A pendulum
solve: system
symbols: {l: length, m: mass, g: acceleration, M: mass}
given:
  coordinates: {theta: angle, x: length}
  particles:
    cart: {mass: M, at: [x, 0]}
    bob: {mass: m, at: [x + l*sin(theta), -l*cos(theta)]}
  surfaces: {rail: {through: [0, 0], along: [1, 0], side: both}}
  contacts: {of: cart, on: rail}
  massless_rods: {from: cart, to: bob}
  gravity: g
statement: A system.
parts:
  - {ask: Find the equations of motion., answer: equations_of_motion}
"""

HANGS = """
title: Atwood's machine
solve: system
symbols: {m_1: mass, m_2: mass, R: length, l: length, g: acceleration}
given:
  coordinates: {x: positive length, y: positive length}
  particles: {left: {mass: m_1, at: [-R, -x]}, right: {mass: m_2, at: [R, -y]}}
  pulleys: {pulley: {at: [0, 0], radius: R}}
  strings: {from: left, to: right, over: [pulley], length: l, tension: T}
  gravity: g
statement: A system.
parts:
  - {ask: Find the tension., answer: T}
"""

ROLLS = """
title: A loaded cylinder
solve: system
symbols: {M: mass, R: length, a: length, g: acceleration, I: moment of inertia}
given:
  coordinates: {phi: angle}
  places: {axis: [R*phi, R]}
  bodies:
    cylinder:
      moments: I
      mass: M
      turned: -phi
      rim: {centre: axis, radius: R}
      centre: {from: axis, by: [-a*sin(phi), -a*cos(phi)]}
  surfaces: {floor: {through: [0, 0], along: [1, 0]}}
  contacts: {of: cylinder, on: floor, friction: rolling}
  gravity: g
statement: A system.
parts:
  - {ask: Find the equation of motion., answer: motion_phi}
"""


def test_things_without_a_force_change_no_equation(tmp_path: Path) -> None:
    described = solved(tmp_path / "with", SWINGS)
    removed = edited(SWINGS, ("  massless_rods: {from: cart, to: bob}\n", ""))
    bare = solved(tmp_path / "without", removed.replace("  contacts: {of: cart, on: rail}\n", "").replace(
        "  surfaces: {rail: {through: [0, 0], along: [1, 0], side: both}}\n", ""))  # fmt: skip
    assert explicit(described["motion_x"].value) == explicit(bare["motion_x"].value)
    assert explicit(described["motion_theta"].value) == explicit(bare["motion_theta"].value)


PULLED = """
title: A string that is pulled in
solve: system
symbols: {l: length, u: speed, m: mass, g: acceleration}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [(l - u*t)*sin(theta), -(l - u*t)*cos(theta)]}}
  strings: {from: [0, 0], to: bob}
  gravity: g
statement: A system.
parts:
  - {ask: Find the equation of motion., answer: motion_theta}
"""


def test_a_string_whose_length_changes_with_the_time_needs_its_length(tmp_path: Path) -> None:
    (found,) = messages(tmp_path / "without", PULLED)
    assert "the length l - t*u of the string changes with the time" in found
    edit = ("from: [0, 0], to: bob", "from: [0, 0], to: bob, length: l - u*t")
    assert "motion_theta" in solved(tmp_path / "with", edited(PULLED, edit))


def test_a_string_over_a_pulley_with_a_radius_has_the_tension_of_atwoods_machine(tmp_path: Path) -> None:
    """Taylor, Classical Mechanics, example 7.8: T = 2 m_1 m_2 g/(m_1 + m_2)."""
    m_1, m_2, g = symbols("m_1 m_2 g", positive=True)
    found = explicit(solved(tmp_path, HANGS)["T"].value)
    assert simplify(found.subs({s: s for s in found.free_symbols}) - 2 * m_1 * m_2 * g / (m_1 + m_2)) == 0


def test_a_cylinder_that_the_coordinates_make_roll_needs_no_condition(tmp_path: Path) -> None:
    """Landau and Lifshitz, Mechanics, section 32, problem 3: T = (I + M (R^2 + a^2 - 2 R a cos phi)) phi_dot^2/2."""
    steps = solved(tmp_path, ROLLS)
    energy = explicit(steps["kinetic_energy"].value)
    numbers = {letter.name: letter for letter in energy.free_symbols}
    values = {"M": 2, "R": 3, "a": 1, "I": 5, "phi": 0, "phi_dot": 1}
    at = energy.subs({numbers[name]: value for name, value in values.items() if name in numbers})
    assert at == Rational(1, 2) * (5 + 2 * (9 + 1 - 6))


@pytest.mark.parametrize(
    ("course", "old", "new", "said"),
    [
        (SWINGS, "{from: cart, to: bob}", "{from: [0, 0], to: bob}", "allow the length of the rod to change"),
        (
            SWINGS,
            "{from: cart, to: bob}",
            "{from: cart, to: bob, length: 2*l}",
            "the rod has the length l, but its `length` is given as 2*l",
        ),
        (
            SWINGS,
            "{from: cart, to: bob}",
            "{from: cart, to: bob, length: l, force: S}",
            "so the force `S` does not appear",
        ),
        (SWINGS, "side: both", "side: inside", "a plane has no side `inside`"),
        (SWINGS, "  gravity: g", "  wires: [bob]\n  gravity: g", "must have one coordinate, but this particle has 2"),
        (SWINGS, "  gravity: g", "  wires: [cart, cart]\n  gravity: g", "`cart` is on a wire twice"),
        (HANGS, "[-R, -x]", "[-R/2, -x]", "leads to the next end or pulley"),
        (HANGS, ", tension: T}", "}", "allow the length of the string to change"),
        (HANGS, "length: l, tension: T", "tension: T", "with a symbol for its force also needs a `length`"),
        (HANGS, "at: [R, -y]", "at: [-R, -y]", "the string leaves a pulley at (-R, 0)"),
        (HANGS, "over: [pulley]", "over: [[0, 0]]", "no string runs over the pulley"),
        (HANGS, "{pulley: {at", "{left: {at", "`left` is the name of a pulley and of a body"),
        (
            HANGS,
            "pulleys: {pulley: {at: [0, 0], radius: R}}",
            "bodies: {pulley: {shape: disc, radius: R, mass: m_1, held: centre_of_mass, turned: x/R, across: z}}",
            "which has a radius",
        ),
        (ROLLS, "rim: {centre: axis", "rim: {centre: [0, R]", "does not move with the body"),
        (ROLLS, "moments: I", "shape: disc\n      radius: R", "`rim` has no effect on a body without `moments`"),
    ],
)
def test_a_description_that_cannot_be_meant_is_told(course: str, old: str, new: str, said: str, tmp_path: Path) -> None:
    assert said in "\n".join(messages(tmp_path, edited(course, (old, new))))


def test_a_rail_is_not_left(tmp_path: Path) -> None:
    course = edited(HANGS, ("  strings: {from: left, to: right, over: [pulley], length: l, tension: T}\n", "")).replace(
        "  pulleys: {pulley: {at: [0, 0], radius: R}}\n",
        "  surfaces: {rail: {through: [0, 0], along: [0, 1], side: both}}\n",
    )
    course = course.replace("at: [-R, -x]", "at: [x - y, -x]").replace(
        "  gravity: g\n", "  contacts: {of: left, on: rail, normal: T}\n  gravity: g\n  results:\n"
        "    off: {leaves: T, for: x, start: 0}\n").replace("answer: T", "answer: off")  # fmt: skip
    (said,) = messages(tmp_path, course)
    assert "may have either sign" in said


PULLS = """
title: A particle under a bowl
solve: system
symbols: {m: mass, b: length, g: acceleration}
given:
  coordinates: {x: length, y: length}
  particles: {bead: {mass: m, at: [x, y]}}
  gravity: g
  surfaces: {bowl: {y: x**2/(2*b), side: below}}
  contacts: {of: bead, on: bowl, normal: N}
statement: A system.
parts:
  - {ask: Find the accelerations., answer: accelerations}
"""

PUSHES = """
title: A string that would have to push
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {y: positive length}
  particles: {bob: {mass: m, at: [0, y]}}
  gravity: g
  strings: {from: [0, 0], to: bob, length: l, tension: T}
statement: A system.
parts:
  - {ask: Find the tension., answer: T}
"""


@pytest.mark.parametrize(
    ("course", "said"), [(PULLS, "the surface would have to pull"), (PUSHES, "the string would have to push")]
)
def test_a_force_that_a_surface_or_a_string_cannot_exert_is_refused(course: str, said: str, tmp_path: Path) -> None:
    assert said in "\n".join(messages(tmp_path, course))


def test_a_rail_may_pull(tmp_path: Path) -> None:
    assert solved(tmp_path, edited(PULLS, ("side: below", "side: both")))["acceleration_x"].value != 0
