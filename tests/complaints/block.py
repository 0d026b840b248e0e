"""The script of the bad problems: it asks for four things and returns them."""

from derive.given import AngularSpeed, Direction, Lengths, Mass


def solve(sides: Lengths, mass: Mass, axis: Direction, rate: AngularSpeed) -> object:
    return sides, mass, axis, rate
