"""Systems by their descriptions alone, for the tests of the witness."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Symbol, cos, sin, symbols

from derive.algebra.expressions import scalar
from derive.witness.description import Condition, Description, Particle
from derive.witness.dynamics import Blueprint, Dynamics

m, l, g, k = symbols("m l g k", positive=True)
theta, phi, x, y = (scalar(name) for name in ("theta", "phi", "x", "y"))
r = scalar("r", positive=True)
S = scalar("S")

PENDULUM = Description(((theta, "angle"),), (Particle(m, (l * sin(theta), -l * cos(theta))),), gravity=g)
ON_A_STRING = Description(
    ((r, "length"), (theta, "angle")),
    (Particle(m, (r * sin(theta), -r * cos(theta))),),
    gravity=g,
    conditions=(Condition(l - r, multiplier=S),),
)
NUMBERS: Mapping[Symbol, float] = {m: 1.3, l: 0.7, g: 9.0, k: 4.0}


def dynamics(of: Description) -> Dynamics:
    return Blueprint(of).with_numbers(NUMBERS)
