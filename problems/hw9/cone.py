"""A circular cone: its principal moments and axes about its centre of mass, from the tensor about its apex."""

from derive.figures import centre_mark, drawing, outline
from derive.given import *
from derive.mechanics import *


def solve(radius: Length, height: Length, mass: Mass):
    cone = Cone(radius, height, mass)

    J = inertia_tensor(cone, about="apex", key="apex_tensor")  # cylindrical coordinates
    I = moved_to(J, cone.centre)  # parallel axes
    drawing("from_apex", outline(cone, sliced=True), centre_mark(cone))

    moments = principal_moments(I)
    axes = principal_axes(moments)  # I e = I_k e

    J_base = inertia_tensor(cone, about="base", coordinates="cartesian", symbol="J'", key="base_tensor")
    centre = centre_of_mass(cone, origin="base", coordinates="cartesian", symbol="r'_C", key="centre_from_base")
    again = moved_to(J_base, centre, symbol="I'", key="tensor_from_base")
    drawing("from_base", outline(cone, about="base", sliced=True), centre_mark(cone, about="base"))

    return moments, *axes, isotropic_where(moments, height), agreement(I, again)
