"""Bodies that cannot exist are refused with one message; bodies that only look odd are not."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.stock.described import messages, solved

DISC = "{shape: disc, radius: R"
BALL = "{shape: ball, radius: R"


def of_parts(*parts: str, whole: str = "", values: str = "") -> str:
    named = ", ".join(f"{name}: {part}" for name, part in zip(("one", "two", "three"), parts, strict=False))
    return body(f"{{{whole}parts: {{{named}}}}}", values)


def body(written: str, values: str = "") -> str:
    return f"""\
title: A body
solve: body
symbols: {{M: mass, m: mass, R: length, a: length, b: length, d: length, h: length, l: length}}
{values}given:
  body: {written}
statement: A body.
parts:
  - {{ask: Find its tensor., answer: inertia_tensor}}
"""


def turning(moments: str) -> str:
    return f"""\
title: A body that turns
solve: rotation
symbols: {{A: moment of inertia, B: moment of inertia, w: angular speed}}
given: {{moments: {moments}, rate: w, along: x}}
statement: A body.
parts:
  - {{ask: Find its energy., answer: kinetic_energy}}
"""


def touching(coordinates: str, shape: str, surface: str, contact: str) -> str:
    return f"""\
title: A ball
solve: system
symbols: {{M: mass, R: length, g: acceleration}}
given:
  coordinates: {{{coordinates}}}
  bodies: {{ball: {{shape: ball, {shape}, mass: M}}}}
  gravity: g
  surfaces: {{ground: {surface}}}
  contacts: {{of: ball, on: ground, {contact}}}
statement: A ball.
parts:
  - {{ask: Find its motion., answer: equations_of_motion}}
"""


ONE = "mass: M, "
HALF = "cut_out: true}"
FLOOR, BOWL = "{through: [0, 0], along: [1, 0]}", "{centre: [0, 0], radius: R, side: inside}"
IN_BOWL = "centre: [r*sin(theta), -r*cos(theta)], turned: phi"
IMPOSSIBLE = {
    "a hole that leaves the disc": (
        of_parts(DISC + "}", "{shape: disc, radius: R/2, at: [3*R/4, 0, 0], " + HALF, whole=ONE),
        "is not inside the rest of the body",
    ),
    "a hole larger than the disc": (
        of_parts(DISC + "}", "{shape: disc, radius: 2*R, " + HALF, whole=ONE),
        "`two` is cut out of the body, but is not inside the rest of the body",
    ),
    "a hole as large as the disc": (of_parts(DISC + "}", DISC + ", " + HALF, whole=ONE), "nothing is left"),
    "a hole beside the ball": (
        of_parts(BALL + "}", "{shape: ball, radius: R/2, at: [3*R, 0, 0], " + HALF, whole=ONE),
        "is not inside the rest of the body",
    ),
    "a hole through the ball and beyond": (
        of_parts(BALL + "}", "{shape: cylinder, radius: R/4, height: 3*R, at: [0, 0, 0], " + HALF, whole=ONE),
        "is not inside the rest of the body",
    ),
    "a hole outside by its numbers": (
        of_parts(
            DISC + "}", "{shape: disc, radius: a, at: [d, 0, 0], " + HALF,
            whole=ONE, values="values: {R: 1 m, a: 60 cm, d: 50 cm}\n",
        ),
        "is not inside the rest of the body",
    ),
    "two holes that overlap": (
        of_parts(
            DISC + "}", "{shape: disc, radius: R/4, at: [R/4, 0, 0], " + HALF,
            "{shape: disc, radius: R/4, at: [R/3, 0, 0], " + HALF, whole=ONE,
        ),
        "`two` and `three` are cut out of the body, but they overlap",
    ),
    "a particle as a hole": (
        of_parts(DISC + ", mass: M}", "{shape: particle, mass: m, at: [R/2, 0, 0], " + HALF),
        "a particle cannot be cut out",
    ),
    "a hole heavier than the body": (
        of_parts(DISC + ", mass: M}", "{shape: disc, radius: R/2, mass: 2*M, " + HALF),
        "needs a positive mass",
    ),
    "two balls in one place": (
        of_parts(BALL + ", mass: M}", BALL + ", mass: m, at: [R, 0, 0]}"),
        "`one` and `two` share a volume",
    ),
    "two discs that overlap in a plane": (
        of_parts(DISC + ", mass: M}", DISC + ", mass: m, at: [R, 0, 0]}"),
        "`one` and `two` share an area",
    ),
    "two rods that overlap on a line": (
        of_parts("{shape: rod, length: l, mass: M}", "{shape: rod, length: l, mass: m, at: [0, 0, l/4]}"),
        "`one` and `two` share a length",
    ),
    "an annulus that is all hole": (
        body("{shape: annulus, inner: 2*R, outer: R, mass: M}"), "an outer radius that is greater"
    ),
    "a shell of no thickness": (
        body("{shape: thick_shell, inner: R, outer: R, mass: M}"), "an outer radius that is greater"
    ),
    "a shell inside out, in numbers": (
        body("{shape: thick_shell, inner: 3 cm, outer: 2 cm, mass: M}"), "an outer radius that is greater"
    ),
    "a ring that crosses its own axis": (
        body("{shape: torus, radius: R, section: 3*R/2, mass: M}"), "not greater than the radius of the ring"
    ),
    "an arc of more than a circle": (
        body("{shape: arc, radius: R, half_angle: 200 deg, mass: M}"), "between zero and pi"
    ),
    "a negative mass": (body(BALL + ", mass: -M}"), "must be positive"),
    "a negative mass in numbers": (
        body(BALL + ", mass: M - m}", "values: {M: 1 kg, m: 2 kg}\n"), "needs a positive mass"
    ),
    "a block without height": (body("{shape: cuboid, sides: [a, b, 0], mass: M}"), "must be positive"),
    "a density of both signs": (
        body("{position: [x, 0, 0], limits: {x: [0, l]}, mass: M, density: x - l/2}"), "is negative in a part"
    ),
    "a flat tetrahedron": (
        body("{shape: tetrahedron, corners: [[0, 0, 0], [a, 0, 0], [0, a, 0], [a, a, 0]], mass: M}"),
        "not in one plane",
    ),
    "three moments in numbers": (turning("[1 kg*m^2, 2 kg*m^2, 4 kg*m^2]"), "no body has such moments"),
    "three moments in symbols": (turning("[A, B, A + 2*B]"), "no body has such moments"),
    "a ball half in the floor": (
        touching("x: length", "radius: R, centre: [x, R/2], turned: -x/R", FLOOR, "friction: rolling"),
        "always at least partly behind the surface",
    ),
    "a ball above the floor": (
        touching("x: length", "radius: R, centre: [x, 2*R], turned: -x/R", FLOOR, "friction: rolling"),
        "always away from the surface",
    ),
    "a ball larger than its bowl": (
        touching(
            "r: positive length, theta: angle, phi: angle", f"radius: 2*R, {IN_BOWL}", BOWL, "normal: N"
        ),
        "always at least partly behind the surface",
    ),
}  # fmt: skip
POSSIBLE = {
    "two balls that touch": of_parts(BALL + ", mass: M}", BALL + ", mass: m, at: [2*R, 0, 0]}"),
    "a hole that touches the rim": of_parts(
        DISC + "}", "{shape: disc, radius: R/2, at: [R/2, 0, 0], " + HALF, whole=ONE
    ),
    "a hole of any size": of_parts(DISC + "}", "{shape: disc, radius: a, at: [d, 0, 0], " + HALF, whole=ONE),
    "blocks face to face": of_parts(
        "{shape: cuboid, sides: [a, a, a], mass: M}",
        "{shape: cuboid, sides: [a, a, a], mass: m, at: [a, 0, 0], of: corner}",
    ),
    "rods that cross": of_parts(
        "{shape: rod, length: l, mass: M}", "{shape: rod, length: l, mass: m, turned: {x: pi/2}}"
    ),
    "discs that cross": of_parts(DISC + ", mass: M}", DISC + ", mass: m, turned: {x: pi/2}}"),
    "a hole that is filled": of_parts(
        BALL + ", mass: 8*M}", "{shape: ball, radius: R/2, mass: M, " + HALF, "{shape: ball, radius: R/2, mass: m}"
    ),
    "a ball in a cavity": of_parts(
        "{shape: thick_shell, inner: a, outer: 2*a, mass: M}", "{shape: ball, radius: a, mass: m}"
    ),
    "a shell round a ball": of_parts(BALL + ", mass: M}", "{shape: spherical_shell, radius: R, mass: m}"),
    "a rod to the centres of balls": of_parts(
        "{shape: rod, length: l, mass: M}", BALL + ", mass: m, at: [0, 0, l/2]}"
    ),
    "a ring without a hole": body("{shape: torus, radius: R, section: R, mass: M}"),
    "a laminar body": turning("[A, B, A + B]"),
    "a ball in a bowl": touching(
        "r: positive length, theta: angle, phi: angle", f"radius: R/4, {IN_BOWL}", BOWL, "normal: N"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", IMPOSSIBLE)
def test_an_impossible_body_is_refused_with_one_message(name: str, tmp_path: Path) -> None:
    text, said = IMPOSSIBLE[name]
    (found,) = messages(tmp_path, text)
    assert said in found and not found.startswith("0:")


@pytest.mark.parametrize("name", POSSIBLE)
def test_a_body_that_only_looks_odd_is_possible(name: str, tmp_path: Path) -> None:
    solved(tmp_path, POSSIBLE[name])
