"""What acts on a body acts on one of its particles, and back on what exerts it."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import symbols

from derive.algebra.equality import equal
from tests.stock.described import edited, messages, solved

m, M, g, mu, a, l, v, Omega = symbols("m M g mu a l v Omega", positive=True)
PLANK = """\
title: A block that slides on a plank
solve: system
symbols: {m: mass, M: mass, g: acceleration, mu: positive number}
given:
  coordinates: {X: length, x: length, y: length}
  particles:
    plank: {mass: M, at: [X, 0]}
    block: {mass: m, at: [x, y]}
  gravity: g
  constraints: {condition: y, force: N}
  forces: {components: [-mu*N, 0], at: [x, y], by: plank}
statement: A block slides to the right on a plank, which lies on smooth ice.
parts:
  - ask: Find the accelerations.
    answer: [acceleration_x, acceleration_X]
"""
BALL = """\
title: A ball that slides along a floor
solve: system
symbols: {M: mass, a: length, g: acceleration, mu: positive number}
given:
  coordinates: {x: length, y: length, phi: angle}
  bodies: {ball: {shape: ball, radius: a, mass: M, centre: [x, y], turned: -phi}}
  gravity: g
  constraints: {condition: y, equals: a, force: N}
  forces: {components: [-mu*N, 0], at: [x, 0], of: ball}
statement: A ball slides along a floor.
parts:
  - ask: Find its accelerations.
    answer: [acceleration_x, acceleration_phi]
"""
TURNTABLE = """\
title: A ball that rolls on a turntable
solve: system
symbols: {m: mass, a: length, Omega: angular speed}
given:
  coordinates: {x: length, y: length, phi: angle, theta: angle, psi: angle}
  axes:
    ball: [{z: phi}, {x: theta}, {z: psi}]
    table: [{z: Omega*t}]
  bodies: {ball: {shape: ball, radius: a, mass: m, centre: [x, y, a], turned: ball}}
  surfaces: {top: {through: [0, 0, 0], normal: [0, 0, 1], in: table}}
  contacts: {of: ball, on: top, friction: {rolling: F}}
statement: A ball rolls without slipping on a horizontal table that rotates.
parts:
  - ask: Find the accelerations of its centre.
    answer: [acceleration_x, acceleration_y]
"""
HIT = """\
title: A particle hits the end of a rod
solve: system
symbols: {M: mass, m: mass, l: length, v: speed}
given:
  coordinates: {x: length, y: length, phi: angle, u: length}
  bodies: {rod: {shape: rod, length: l, mass: M, centre: [x, y], turned: phi}}
  particles: {p: {mass: m, at: [u, l/2]}}
  impact:
    at: {x: 0, y: 0, phi: 0, u: 0}
    before: {u_dot: v}
    collisions: {from: [u, l/2], to: [x, y + l/2], of: [p, rod], along: [1, 0], restitution: 1, impulse: P}
statement: A particle hits the end of a rod.
parts:
  - ask: Find the rates after it.
    answer: rates_after
"""


def test_the_plank_is_pulled_along_by_what_slows_the_block(tmp_path: Path) -> None:
    """Newton's third law: the block loses mu g, the plank gains mu m g/M."""
    steps = solved(tmp_path, PLANK)
    assert equal(steps["acceleration_x"].value, -mu * g)
    assert equal(steps["acceleration_X"].value, mu * m * g / M)


def test_between_two_masses_it_is_stated_which_exerts_friction(tmp_path: Path) -> None:
    (said,) = messages(tmp_path, edited(PLANK, (", by: plank", "")))
    assert said.startswith("11:") and "the body that exerts it" in said
    steps = solved(tmp_path, edited(PLANK, ("by: plank", "by: ground")))
    assert steps["acceleration_X"].value == 0


def test_sliding_friction_turns_a_ball(tmp_path: Path) -> None:
    """Kleppner, Kolenkow, example 6.17: a = -mu g, and (2/5) M a^2 phi_ddot = mu M g a."""
    steps = solved(tmp_path, BALL)
    assert equal(steps["acceleration_x"].value, -mu * g)
    assert equal(steps["acceleration_phi"].value, 5 * mu * g / (2 * a))


def test_the_contact_of_a_ball_that_slides_asks_for_its_body(tmp_path: Path) -> None:
    (said,) = messages(tmp_path, edited(BALL, (", of: ball", "")))
    assert said.startswith("9:") and "no body or particle" in said
    steps = solved(tmp_path, edited(BALL, ("of: ball", "of: massless")))
    assert steps["acceleration_phi"].value == 0


@pytest.mark.parametrize("name", ["bal", "floor"])
def test_a_body_that_is_not_there_is_not_acted_on(name: str, tmp_path: Path) -> None:
    (found,) = messages(tmp_path, edited(BALL, ("of: ball", f"of: {name}")))
    assert found == f"9: `{name}` is not a body or particle of this system"


def test_a_ball_on_a_turntable_goes_round_at_two_sevenths_of_its_rate(tmp_path: Path) -> None:
    """Weckesser, *American Journal of Physics* 65 (1997) 736: x_ddot = -(2/7) Omega y_dot."""
    steps = solved(tmp_path, TURNTABLE)
    x_dot, y_dot = (symbols(name, real=True) for name in ("x_dot", "y_dot"))
    assert equal(steps["acceleration_x"].value, -2 * Omega * y_dot / 7)
    assert equal(steps["acceleration_y"].value, 2 * Omega * x_dot / 7)


def test_the_end_of_a_rod_that_is_hit_is_a_particle_of_the_rod(tmp_path: Path) -> None:
    """By momentum, angular momentum and energy: x_dot = 2 m v/(M + 4 m), phi_dot = -12 m v/((M + 4 m) l)."""
    steps = solved(tmp_path, HIT)
    assert equal(steps["x_dot_after"].value, 2 * m * v / (M + 4 * m))
    assert equal(steps["phi_dot_after"].value, -12 * m * v / ((M + 4 * m) * l))
    (said,) = messages(tmp_path, edited(HIT, (", of: [p, rod]", "")))
    assert "no particle or body" in said
    (said,) = messages(tmp_path, edited(HIT, ("of: [p, rod]", "of: rod")))
    assert "two names" in said


def test_a_normal_may_have_any_length(tmp_path: Path) -> None:
    """A fall with v on a slope whose normal is (3, 4)/5: K = 2 m v (4/5)."""
    bounce = edited(
        HIT,
        ("{x: length, y: length, phi: angle, u: length}", "{x: length, y: length}"),
        ("  bodies: {rod: {shape: rod, length: l, mass: M, centre: [x, y], turned: phi}}\n", ""),
        ("[u, l/2]}}", "[x, y]}}"),
        ("{x: 0, y: 0, phi: 0, u: 0}", "{x: 0, y: 0}"),
        ("{u_dot: v}", "{y_dot: -v}"),
        ("{from: [u, l/2], to: [x, y + l/2], of: [p, rod], along: [1, 0],", "{at: [x, y], along: [3, 4],"),
        ("symbols: {M: mass, m: mass, l: length, v: speed}", "symbols: {m: mass, v: speed}"),
        ("answer: rates_after", "answer: P"),
    )
    assert equal(solved(tmp_path, bounce)["P"].value, m * v * 8 / 5)


def test_a_disc_does_not_touch_a_floor_beyond_its_radius(tmp_path: Path) -> None:
    far = """\
title: A disc
solve: system
symbols: {M: mass, R: length}
given:
  coordinates: {x: length, phi: angle}
  bodies: {disc: {shape: disc, radius: R, mass: M, turned: -phi, centre: [x, R], across: z}}
  surfaces: {floor: {through: [0, -R], along: [1, 0]}}
  contacts: {of: disc, on: floor, friction: rolling}
statement: A disc.
parts:
  - {ask: Find it., answer: no_slip}
"""
    (said,) = messages(tmp_path, far)
    assert "the body is always away from the surface, since its distance from the surface is R" in said
    assert "no_slip" in solved(tmp_path, edited(far, ("[0, -R]", "[0, 0]")))


@pytest.mark.parametrize(
    ("condition", "length"),
    [("condition: x**2 + y**2, equals: l**2", "2*l"), ("condition: 3*y - x", "sqrt(10)"), ("condition: y", "")],
)
def test_a_multiplier_is_a_force_where_its_condition_has_a_gradient_of_length_one(
    condition: str, length: str, tmp_path: Path
) -> None:
    """lambda grad f is the force: for f = x^2 + y^2 - l^2 it is 2 l lambda."""
    text = f"""\
title: A bob
solve: system
symbols: {{m: mass, l: length, g: acceleration}}
given:
  coordinates: {{x: length, y: length}}
  particles: {{bob: {{mass: m, at: [x, y]}}}}
  gravity: g
  constraints: {{{condition}, force: Lambda}}
statement: A bob.
parts:
  - {{ask: Find the multiplier., answer: multipliers}}
"""
    found = solved(tmp_path, text)["Lambda"].step
    assert found.outcome == ("multiplier" if length else "isolated")
    assert str(dict(found.roles).get("length", "")) == length
