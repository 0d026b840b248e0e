"""A block turning about an axis through its centre: why it shakes its bearings."""

from derive.figures import angle, arrow, axis_of_rotation, drawing, outline
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
    d = block.direction(axis)
    drawing("axes", outline(block), axis_of_rotation(d, block.middle, rate=rate))

    J = inertia_tensor(block, about="corner", key="corner_tensor")  # integral of (r.r 1 - r r) dm
    I = moved_to(J, block.centre)  # parallel axes

    T = kinetic_energy(I, any_angular_velocity())  # 1/2 w . I w, for any w
    omega = spin(rate, along=d)
    T_axis = at(T, omega, key="kinetic_energy_about_axis")

    L = angular_momentum(I, omega)  # I w: in general not along w
    theta = angle_between(omega, L)
    tau = torque(omega, L)  # dL/dt = w x L

    middle = block.middle
    drawing("vectors", outline(block, named=False), axis_of_rotation(d, middle), arrow(omega, middle),
            arrow(L, middle, size=1), angle(omega, L, theta, at=middle))  # fmt: skip

    return I, T, T_axis, theta, tau, magnitude(tau)
