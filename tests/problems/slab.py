"""A slab that rocks on a fixed cylinder: where it is stable, how fast it swings, and what holds it there."""

from derive.given import Acceleration, Length, Mass, MomentOfInertia
from derive.mechanics import (
    Plate,
    boundary_case,
    contact_forces,
    coordinate,
    curvature_at,
    equation_of_motion,
    equation_with_multipliers,
    force_of_constraint,
    free_lagrangian,
    frequency,
    frequency_squared,
    lagrangian,
    leading_order,
    linearised,
    moment_of_inertia,
    multipliers_eliminated,
    plane_kinetic_energy,
    positive_where,
    rate_of,
    rolled_centre,
    slope,
    tie,
    weight_energy,
)


def solve(
    radius: Length,
    thickness: Length,
    mass: Mass,
    gravity: Acceleration,
    inertia: MomentOfInertia = None,
    width: Length = None,
):
    if width is not None and inertia is not None:
        raise ValueError("give `inertia` or `width`, not both")
    if width is not None:  # a section of the slab will do: every slice along the cylinder has its share of the mass
        inertia = moment_of_inertia(Plate((width, thickness), mass))
    theta = coordinate("theta")
    x, y = rolled_centre(radius, thickness / 2, theta)  # no slipping: the contact moves on by R theta

    T = plane_kinetic_energy(mass, (rate_of(x), rate_of(y)), (x, y), inertia, theta)
    U = weight_energy(mass, gravity, (x, y))
    L = lagrangian(T, U)
    motion = equation_of_motion(L, theta)  # d/dt dL/dtheta_dot = dL/dtheta

    small = linearised(motion)
    squared = frequency_squared(small)
    omega_0 = frequency(squared)
    stable = positive_where(squared, radius, key="stability")

    slope_of_U = slope(U, key="slope")
    curvature = curvature_at(slope(U, 2))
    minimum = positive_where(curvature, radius, key="minimum")
    balanced = leading_order(U, where=boundary_case(minimum))  # the case on the border

    # Once more, with x, y and theta free and the contact force in their equations.
    free_x, free_y = coordinate("x", "length"), coordinate("y", "length")
    ties = (tie(free_x, x), tie(free_y, y))
    free = free_lagrangian(mass, gravity, inertia, (free_x, free_y), theta)
    equation_x, equation_y, turning = (equation_with_multipliers(free, q, ties) for q in (free_x, free_y, theta))
    forces = force_of_constraint(equation_x, ties[0]), force_of_constraint(equation_y, ties[1])
    again = multipliers_eliminated(turning, forces, motion)
    normal, friction = contact_forces(forces, (x, y), theta, motion)

    return L, motion, omega_0, stable, slope_of_U, minimum, balanced, again, normal, friction
