"""Bodies and rotations that are told by their `given:` alone."""

from __future__ import annotations

CONE = """\
title: A cone
solve: body
symbols: {R: length, h: length, M: mass, m: mass, alpha: angle}
given:
  body: {shape: cone, radius: R, height: h, mass: M}
  about: apex
statement: A cone.
parts:
  - ask: Find what is asked.
    answer: inertia_tensor
"""

BLOCK = """\
title: A block
solve: rotation
symbols: {a: length, M: mass, A: moment of inertia, B: moment of inertia, C: moment of inertia, omega: angular speed}
given:
  body: {shape: cuboid, sides: [a, 2*a, 3*a], mass: M}
  rate: omega
  along: diagonal
statement: A block.
parts:
  - ask: Find what is asked.
    answer: torque
"""

CONE_IS = "{shape: cone, radius: R, height: h, mass: M}"
BLOCK_IS = "body: {shape: cuboid, sides: [a, 2*a, 3*a], mass: M}"
