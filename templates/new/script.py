"""A rod that swings about its end: its Lagrangian, and the angular frequency of small oscillations."""

from sympy import pi

from derive.figures import sketch
from derive.given import Acceleration, Length, Mass
from derive.mechanics import (
    Rod,
    System,
    coordinate,
    equation_of_motion,
    frequency,
    frequency_squared,
    lagrangian,
    linearised,
    weight,
)


def solve(length: Length, mass: Mass, gravity: Acceleration):
    theta = coordinate("theta")
    rod = Rod(length, mass)
    system = System(rod.held(theta + pi, "end"), weight(gravity))

    L = lagrangian(system)
    swings = frequency(frequency_squared(linearised(equation_of_motion(L, theta))))
    sketch("rod", system)
    return L, swings
