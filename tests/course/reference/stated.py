"""What the tests of references state of the block, in the one notation or the other."""

from __future__ import annotations

from collections.abc import Callable

from derive.course.reference.comparison import Comparison

LETTERS = """\
  symbols: {a: length, M: mass, omega: angular speed, rho: density, I_xx: moment of inertia, I_yy: moment of inertia,
            I_zz: moment of inertia, omega_x: angular speed, omega_y: angular speed, omega_z: angular speed}
"""
GIVEN = "  given: {sides: [a, 2*a, 3*a], mass: M, axis: diagonal, rate: omega}\n"
HEAD = f"- problem: block\n{LETTERS}{GIVEN}  entries:\n"

PRINTED = HEAD.replace("symbols: {a: length", "symbols: {x: length, y: length, z: length, a: length").replace(
    "  entries:",
    "  letters: {I_1: I_xx, I_2: I_yy, I_3: I_zz, omega_1: omega_x, omega_2: omega_y, omega_3: omega_z}\n  entries:",
)

Compared = Callable[..., tuple[Comparison, ...]]


def one(found: tuple[Comparison, ...]) -> Comparison:
    assert len(found) == 1
    return found[0]
