"""The ways to an equation of motion: Lagrange's equation, Newton's and Euler's laws, or conservation of energy."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from derive.course.parts import ANGULAR_MOMENTUM, BOTH, NEWTON
from derive.mechanics import Coordinate, System, second_law, torque_law
from derive.mechanics.newton.alone import body_of
from derive.steps.step import Quantity


def by_newton(system: System, q: Coordinate, key: str, about: str = "", at_rest: bool = False) -> Quantity:
    """Newton's second law along a coordinate, or the sum of the torques if the coordinate rotates its body."""
    if body_of(system, q.symbol).turn(q.symbol) != 0:
        return torque_law(system, q, key, about, at_rest)
    return second_law(system, q, key, at_rest)


ABOUT: Mapping[str, str] = {NEWTON: "", BOTH: "", ANGULAR_MOMENTUM: "contact"}  # method -> argument of `torque_law`
