"""A circular cone: its principal moments and axes about its centre of mass, reached from the apex and from the base."""

from derive.given import Length, Mass
from derive.mechanics import (
    Cone,
    agreement,
    centre_of_mass,
    inertia_tensor,
    moved_to,
    principal_axes,
    principal_moments,
)


def solve(radius: Length, height: Length, mass: Mass):
    cone = Cone(radius, height, mass)

    J = inertia_tensor(cone, about="apex", key="apex_tensor")  # cylindrical coordinates
    I = moved_to(J, cone.centre)  # parallel axes

    base = {"origin": "base", "coordinates": "cartesian"}
    J_base = inertia_tensor(cone, about="base", coordinates="cartesian", symbol="J'", key="base_tensor")
    centre = centre_of_mass(cone, **base, symbol="r'_C", key="centre_from_base")
    again = moved_to(J_base, centre, symbol="I'", key="tensor_from_base")

    moments = principal_moments(I)

    return I, agreement(I, again), moments, *principal_axes(moments)
