"""A script that fails: a name is mistyped."""

from derive.given import AngularSpeed, Direction, Lengths, Mass


def solve(sides: Lengths, mass: Mass, axis: Direction, rate: AngularSpeed) -> object:
    return sides, mass, axis, rte  # noqa: F821
