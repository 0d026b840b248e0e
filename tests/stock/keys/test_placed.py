"""Bodies of a described system: placed by their centre, held at a point, told by their moments, rolling."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Rational, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from tests.stock.described import PENDULUM, complaints, edited, messages, solved

l, m, g = symbols("l m g", positive=True)
theta, theta_ddot = symbols("theta theta_ddot", real=True)

ROD = edited(
    PENDULUM,
    (
        "  particles: {bob: {mass: m, at: A}}",
        "  bodies: {rod: {shape: rod, length: l, mass: m, held: end, turned: theta, across: x}}",
    ),
    ("  places: {A: [l*sin(theta), -l*cos(theta)]}\n", ""),
)
INERTIA = "symbols: {l: length, A: moment of inertia,"
BODY = "{shape: rod, length: l, mass: m, held: end, turned: theta, across: x}"


def test_a_rod_that_is_held_at_its_end_swings(tmp_path: Path) -> None:
    """Fowles and Cassiday, section 8.4: T = (1/6) m l^2 theta_dot^2."""
    energy = solved(tmp_path, edited(ROD, ("equations_of_motion", "kinetic_energy")))["kinetic_energy"]
    assert equal(energy.value, Rational(1, 6) * m * l**2 * symbols("theta_dot", real=True) ** 2)


def test_a_body_may_be_told_by_its_moment(tmp_path: Path) -> None:
    by_moment = "{moments: A, mass: m, centre: [l*sin(theta), -l*cos(theta)], turned: theta}"
    text = edited(ROD, (BODY, by_moment), ("symbols: {l: length,", INERTIA))
    A = symbols("A", positive=True)
    found = explicit(solved(tmp_path, text)["motion_theta"].value)
    assert equal(found, Relation((A + m * l**2) * theta_ddot + m * g * l * sin(theta), "=", 0))


ROLLING = """\
title: A hoop
solve: system
symbols: {M: mass, R: length}
given:
  coordinates: {s: length, phi: angle}
  bodies: {hoop: {shape: hoop, radius: R, mass: M, turned: -phi, centre: [s, R], across: z}}
  surfaces: {floor: {through: [0, 0], along: [1, 0]}}
  contacts: {of: hoop, on: floor, friction: rolling}
statement: A hoop.
parts:
  - ask: Roll.
    answer: [no_slip, kinetic_energy]
"""


def test_a_hoop_that_rolls_has_one_coordinate(tmp_path: Path) -> None:
    M, s_dot = symbols("M", positive=True), symbols("s_dot", real=True)
    steps = solved(tmp_path, ROLLING)
    assert equal(steps["kinetic_energy"].value, M * s_dot**2)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("{shape: rod, length: l, mass: m, turned: theta}", "a body needs `centre`, `held` or `from`"),
        (
            "{shape: rod, length: l, mass: m, turned: theta, centre: [0, 0], held: end}",
            "a body can have only one of `centre`, `held` or `from`",
        ),
        ("{shape: rod, length: l, mass: m, held: end}", "a body needs `turned`"),
        ("{shape: rood, length: l, mass: m, held: end, turned: theta}", "rood"),
        ("{shape: rod, length: l, mass: m, held: top, turned: theta, across: x}", "has no point `top`"),
        (
            "{moments: m, mass: m, held: pivot, turned: theta}",
            "`moments` must be a moment of inertia",
        ),
        ("{shape: rod, length: l, mass: m, held: end, turned: l, across: x}", "`turned` must be an angle"),
        (
            "{shape: rod, length: l, mass: m, held: end, turned: theta, across: z}",
            "has no moment of inertia about",
        ),
        ("{shape: rod, length: l, mass: m, held: end, turned: theta, across: w}", "`across` must be x, y or z"),
    ],
)
def test_a_body_that_cannot_be_meant_is_told(body: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(ROD, (BODY, body)))
    assert any(said in message for message in found), found


def test_what_rolls_is_a_body_of_the_system(tmp_path: Path) -> None:
    found = messages(tmp_path, edited(ROLLING, ("{of: hoop", "{of: hop")))
    assert found == ["8: `hop` is not a body or particle of this system"]


def test_the_former_key_rolling_names_contacts(tmp_path: Path) -> None:
    text = edited(ROLLING, ("contacts: {of: hoop, on: floor, friction: rolling}", "rolling: {body: hoop, at: [s, 0]}"))
    (found,) = complaints(tmp_path, text)
    assert (found.message, found.place.line) == ("`given` has no key `rolling`", 8)
    assert found.help is not None and found.help.startswith("write `contacts`: bodies that touch a surface")
