"""A body that turns freely: what Euler's equations leave constant."""

from derive.given import MomentsOfInertia
from derive.mechanics import (
    RigidBody,
    angular_momentum,
    changing_angular_velocity,
    euler_equations,
    kinetic_energy,
    rate_in_body,
    rate_in_space,
    rate_under,
    squared_magnitude,
)


def solve(moments: MomentsOfInertia):
    body = RigidBody(moments=moments)  # principal axes, about the centre of mass
    omega = changing_angular_velocity()
    L = angular_momentum(body.tensor, omega)  # I w

    equations = euler_equations(rate_in_space(L, omega))  # dL/dt = (dL/dt)_body + w x L = 0

    T = kinetic_energy(body.tensor, omega)  # 1/2 w . I w
    T_rate = rate_under(T, equations)

    square = squared_magnitude(L, key="squared_momentum")  # L . L
    square_rate = rate_under(square, equations)

    in_body = rate_in_body(L, omega, equations)  # -w x L
    in_space = rate_in_space(L, omega, in_body, key="momentum_rate_in_space")

    return *equations, T_rate, square_rate, in_body, in_space
