"""A ball about its centre: the tests put each of the other bodies in its place."""

from derive import mechanics
from derive.given import Length, Mass


def solve(radius: Length, height: Length, mass: Mass):
    body = mechanics.Ball(radius, mass)
    start, about = "centre", "centre"

    J = mechanics.inertia_tensor(body, about=start, key="first_tensor")
    moment = mechanics.moment_of_inertia(body, "x", about=start, symbol="I_1", key="about_x")
    gyration = mechanics.let("squared_gyration", lambda I: I / mass, moment, symbol="s")
    if start == about:
        return J, moment, gyration
    moved = mechanics.moved_to(J, mechanics.centre_of_mass(body, origin=start))
    moments = mechanics.principal_moments(moved)
    axes = mechanics.principal_axes(moments)
    back = mechanics.moved_from_centre(moved, mechanics.centre_of_mass(body, origin=start), symbol="J'")
    return J, moment, gyration, moved, *axes, back
