"""A script whose `solve()` does not say what it asks for."""

from derive.given import Lengths


def solve(sides: Lengths, mass, axis: str, rate: "AngularSped") -> object:  # noqa: F821
    return sides, mass, axis, rate
