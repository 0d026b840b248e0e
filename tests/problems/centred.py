"""A block turning about an axis through its centre: why it shakes its bearings."""

from derive.figures import axis_of_rotation, drawing, outline, vectors_in
from derive.given import AngularSpeed, Lengths, Mass
from derive.mechanics import (
    Cuboid,
    Direction,
    agreement,
    angle_between,
    angular_momentum,
    inertia_tensor,
    kinetic_energy,
    magnitude,
    moved_to,
    spin,
    torque,
)


def solve(sides: Lengths, mass: Mass, axis: Direction, rate: AngularSpeed, in_letters: Lengths):
    block = Cuboid(sides, mass)
    drawing("axes", outline(block, about="centre"), axis_of_rotation(block.direction(axis), rate=rate))

    I = inertia_tensor(block)  # integral of (r.r 1 - r r) dm about the centre
    omega = spin(rate, along=block.direction(axis))
    T = kinetic_energy(I, omega)  # 1/2 w . I w

    L = angular_momentum(I, omega)  # I w: in general not along w
    theta = angle_between(omega, L)
    tau = torque(omega, L)  # dL/dt = w x L
    drawing("vectors", vectors_in(block, omega, L, tau, angle=theta, about="centre"))

    J = inertia_tensor(block, about="corner", key="corner_tensor")
    again = moved_to(J, block.centre, symbol="I'", key="tensor_from_corner")  # parallel axes

    general = Cuboid(in_letters, mass).named("general block")  # the same with any edges, for its limiting cases
    I_general = inertia_tensor(general)
    omega_general = spin(rate, along=general.direction(axis))
    tau_general = torque(omega_general, angular_momentum(I_general, omega_general))

    return I, T, theta, tau, magnitude(tau), agreement(I, again), I_general, tau_general
