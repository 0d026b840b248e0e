"""The double pendulum."""

from sympy import cos, sin

from derive.given import Acceleration, Length, Mass
from derive.mechanics import Particle, System, coordinate, equations_of_motion, lagrangian, point, weight


def solve(upper: Length, lower: Length, first: Mass, second: Mass, gravity: Acceleration):
    theta, phi = coordinate("theta"), coordinate("phi")
    top = point(upper * sin(theta), -upper * cos(theta))
    bottom = top + point(lower * sin(phi), -lower * cos(phi))
    L = lagrangian(System(Particle(first, top), Particle(second, bottom), weight(gravity)))
    return L, equations_of_motion(L)
