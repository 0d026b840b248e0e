"""A rod that swings about its end: its Lagrangian, and how fast it swings."""

from sympy import pi

from derive.figures import sketch
from derive.given import *
from derive.mechanics import *


def solve(length: Length, mass: Mass, gravity: Acceleration):
    theta = coordinate("theta")
    rod = Rod(length, mass)
    system = System(rod.held(theta + pi, "end"), weight(gravity))

    L = lagrangian(system)
    swings = frequency(frequency_squared(linearised(equation_of_motion(L, theta))))
    sketch("rod", system)
    return L, swings
