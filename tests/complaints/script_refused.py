"""A script in which a verb refuses: its complaint stands at the script's line."""

from derive.errors import Complaint, Unverified
from derive.given import AngularSpeed, Direction, Lengths, Mass


def torque(rate: object) -> object:
    raise Unverified(Complaint("routes", "the two routes to the torque disagree"))


def solve(sides: Lengths, mass: Mass, axis: Direction, rate: AngularSpeed) -> object:
    return torque(rate)
