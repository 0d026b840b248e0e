"""`ball.contact`, the particle of a body that touches a surface; and a rigid joint, whose couple acts at no point."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import rate, scalar
from derive.errors import DeriveError
from derive.mechanics.bodies.placed import PointOfBody
from derive.mechanics.model import contacts
from derive.stock.keys import connections
from tests.stock.described import edited, messages, solved

BALL = """\
title: A ball
solve: system
symbols: {M: mass, a: length, g: acceleration, P: positive force, c: damping constant, l: length, k: spring constant}
given:
  coordinates: {x: length, y: length, phi: angle}
  bodies: {ball: {shape: ball, radius: a, mass: M, centre: [x, y], turned: -phi}}
  gravity: g
  surfaces: {floor: {through: [0, 0], along: [1, 0]}}
  contacts: {of: ball, on: floor, normal: N, friction: none}
  forces: {components: [P, 0], at: ball.contact}
statement: A ball.
parts:
  - ask: Find its motion.
    answer: [acceleration_x, acceleration_phi]
"""
WELDED = """\
title: Two rods
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {phi: angle, x: length, y: length, psi: angle}
  bodies:
    one: {shape: rod, length: l, mass: m, from: [0, 0], along: [sin(phi), -cos(phi)]}
    two: {shape: rod, length: l, mass: m, centre: [x, y], along: [sin(psi), -cos(psi)]}
  gravity: g
  joints: {of: two.end, to: one.far_end, force: R, torque: C}
statement: Two rods.
parts:
  - ask: Find the motion.
    answer: [acceleration_phi, C]
"""
M, a, P, c = symbols("M a P c", positive=True)


def test_a_force_and_a_drag_at_the_contact_turn_the_ball(tmp_path: Path) -> None:
    """M x_ddot = F and 2/5 M a^2 phi_ddot = -a F with F = P - c (x_dot - a phi_dot), phi clockwise."""
    drag = ("  gravity: g\n", "  gravity: g\n  damping: {constant: c, at: ball.contact}\n")
    found = solved(tmp_path, edited(BALL, drag))
    F = P - c * (rate(scalar("x")) - a * rate(scalar("phi")))
    assert equal(found["acceleration_x"].value, F / M)
    assert equal(found["acceleration_phi"].value, -5 * F / (2 * M * a))


@pytest.mark.parametrize(
    ("part", "said"),
    [
        ("springs: {constant: k, from: ball.contact, to: [0, l]}", "nothing can be fastened at `ball.contact`"),
        ("strings: {from: ball.contact, to: [0, l], length: l, tension: T}", "nothing can be fastened"),
        ("joints: {of: ball.contact, to: [0, 0], force: R}", "nothing can be fastened"),
        ("forces: {components: [P, 0], at: ball.corner}", 'a ball has no point "corner"'),
    ],
)
def test_nothing_is_fastened_to_a_point_that_changes(part: str, said: str, tmp_path: Path) -> None:
    old = "forces: {components: [P, 0], at: ball.contact}"
    assert any(said in each for each in messages(tmp_path, edited(BALL, (old, part))))


def test_a_body_with_no_contact_or_with_two_has_no_point_of_contact(tmp_path: Path) -> None:
    contact = "contacts: {of: ball, on: floor, normal: N, friction: none}"
    surfaces = "surfaces: {floor: {through: [0, 0], along: [1, 0]}}"
    alone = edited(BALL, (f"  {surfaces}\n", ""), (f"  {contact}\n", ""))
    assert any("no contact of this system names `ball`" in each for each in messages(tmp_path, alone))
    wall = ("[1, 0]}}", "[1, 0]}, wall: {through: [0, 0], along: [0, -1]}}")
    both = (
        "contacts: {of: ball, on: floor, normal: N, friction: none}",
        "contacts: [{of: ball, on: floor, normal: N}, ",
    )
    two = edited(BALL, wall, (both[0], both[1] + "{of: ball, on: wall, normal: K}]"))
    assert any("several contacts of this system name `ball`" in each for each in messages(tmp_path, two))


def test_a_particle_has_no_points(tmp_path: Path) -> None:
    body = "bodies: {ball: {shape: ball, radius: a, mass: M, centre: [x, y], turned: -phi}}"
    particle = edited(BALL, (body, "particles: {ball: {mass: M, at: [x, y]}}"))
    assert any("`ball` is a particle, so it has no point `contact`" in each for each in messages(tmp_path, particle))


def test_a_wrong_point_of_contact_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = contacts.touching
    monkeypatch.setattr(contacts, "touching", lambda placed, on: (placed.hub, *right(placed, on)[1:]))
    with pytest.raises(DeriveError):
        solved(tmp_path, BALL)
    monkeypatch.setattr(contacts, "touching", right)
    monkeypatch.setattr(
        connections, "point_of_contact", lambda of, on: PointOfBody(contacts.point_of_contact(of, on).components)
    )
    with pytest.raises(DeriveError):
        solved(tmp_path, BALL)


def test_drag_at_the_contact_of_a_rolling_ball_does_nothing(tmp_path: Path) -> None:
    rolls = edited(
        BALL,
        ("{x: length, y: length, phi", "{x: length, phi"),
        ("centre: [x, y]", "centre: [x, a]"),
        ("normal: N, friction: none", "friction: rolling"),
        ("forces: {components: [P, 0], at: ball.contact}", "damping: {constant: c, at: ball.contact}"),
        ("[acceleration_x, acceleration_phi]", "acceleration_x"),
    )
    assert equal(solved(tmp_path, rolls)["acceleration_x"].value, 0)


def test_the_couple_of_a_rigid_joint(tmp_path: Path) -> None:
    """A rigid rod of length 2l on a hinge: phi_ddot = -3 g sin(phi)/(4 l); the couple on its lower half is
    C = -m g l sin(phi)/8."""
    found = solved(tmp_path, WELDED)
    phi, m, l, g = scalar("phi"), *symbols("m l g", positive=True)
    assert equal(found["acceleration_phi"].value, -3 * g * sin(phi) / (4 * l))
    assert equal(found["C"].value, -m * g * l * sin(phi) / 8)
