"""Two beads between springs on a turning wire: explicit time, springs, weight."""

from derive.given import Acceleration, Angle, AngularSpeed, Length, Mass, SpringConstant
from derive.mechanics import (
    Particle,
    System,
    X,
    Z,
    coordinate,
    equations_of_motion,
    lagrangian,
    space,
    spring,
    t,
    weight,
)


def solve(
    length: Length, constant: SpringConstant, mass: Mass, gravity: Acceleration, rate: AngularSpeed, slope: Angle
):
    x, y = coordinate("x", "length"), coordinate("y", "length")
    wire = space.turned(Z, rate * t).turned(X, slope)
    axis, first, second = (wire.place(0, 0, along) for along in (0, length + x, 2 * length + y))
    springs = spring(constant, axis, first, length), spring(constant, first, second, length)
    L = lagrangian(System(Particle(mass, first), Particle(mass, second), weight(gravity), *springs))
    return L, equations_of_motion(L)
