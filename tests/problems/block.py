"""A block turning about an axis through its centre: why it shakes its bearings."""

from derive.given import AngularSpeed, Lengths, Mass
from derive.mechanics import (
    Cuboid,
    Direction,
    angle_between,
    angular_momentum,
    any_angular_velocity,
    at,
    inertia_tensor,
    kinetic_energy,
    magnitude,
    moved_to,
    spin,
    torque,
)


def solve(sides: Lengths, mass: Mass, axis: Direction, rate: AngularSpeed):
    block = Cuboid(sides, mass)

    J = inertia_tensor(block, about="corner", key="corner_tensor")  # integral of (r.r 1 - r r) dm
    I = moved_to(J, block.centre)  # parallel axes

    T = kinetic_energy(I, any_angular_velocity())  # 1/2 w . I w, for any w
    omega = spin(rate, along=block.direction(axis))
    T_axis = at(T, omega, key="kinetic_energy_about_axis")

    L = angular_momentum(I, omega)  # I w: in general not along w
    theta = angle_between(omega, L)
    tau = torque(omega, L)  # dL/dt = w x L

    return I, T, T_axis, theta, tau, magnitude(tau)
