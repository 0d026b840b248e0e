"""A circular cone: its principal moments and axes about its centre of mass, by way of its apex."""

from derive.given import Length, Mass
from derive.mechanics import (
    Cone,
    agreement,
    centre_of_mass,
    inertia_tensor,
    isotropic_where,
    moved_to,
    principal_axes,
    principal_moments,
)


def solve(radius: Length, height: Length, mass: Mass):
    cone = Cone(radius, height, mass)

    J = inertia_tensor(cone, about="apex", key="apex_tensor")  # cylindrical coordinates
    I = moved_to(J, cone.centre)  # parallel axes

    moments = principal_moments(I)
    axes = principal_axes(moments)  # I e = I_k e

    J_base = inertia_tensor(cone, about="base", coordinates="cartesian", symbol="J'", key="base_tensor")
    centre = centre_of_mass(cone, origin="base", coordinates="cartesian", symbol="r'_C", key="centre_from_base")
    again = moved_to(J_base, centre, symbol="I'", key="tensor_from_base")

    return moments, *axes, isotropic_where(moments, height), agreement(I, again)
