"""A slab that rocks on a fixed cylinder: its stability, its oscillation frequency and the contact force."""

from sympy import Rational, cos, pi, sin
from sympy import solve as solve_linear

from derive.figures import arrow, axes, dashed_at, length_mark, plot, point_mark, sketch
from derive.given import *
from derive.mechanics import *


def solve(
    radius: Length,
    thickness: Length,
    mass: Mass,
    gravity: Acceleration,
    inertia: MomentOfInertia = None,
    width: Length = None,
    amplitude: Angle = None,
):
    if width is not None and inertia is not None:
        raise ValueError("give `inertia` or `width`, not both")
    section = Plate((width or 3 * radius + thickness, thickness), mass)  # the cross-section, with the whole mass
    slab = section if width is not None else RigidBody(mass, inertia, look=section)
    theta, s, x, y = coordinate("theta"), *(coordinate(name, "length") for name in ("s", "x", "y"))
    along, across = point(1, 0).turned(-theta), point(0, 1).turned(-theta)
    rolled = slab.placed(-theta, point(-s, radius + thickness / 2).turned(-theta))
    rolling = no_slip(rolled, at=radius * across, fixes=s)
    centre = components(rolled, rolling)
    system = System(slab.placed(-theta, point(*centre)), weight(gravity), rolling)

    L = lagrangian(system)
    motion = equation_of_motion(L, theta)
    small = linearised(motion)
    squared = frequency_squared(small)
    swings = frequency(squared)
    stable = where(squared, ">", 0, radius, key="stability")
    U = potential_energy_of(system)
    level = extreme_value(U, theta)
    curvature = stability(U, {theta: 0}, letter=radius, key="curvature")
    minimum = where(curvature, ">", 0, radius, key="minimum_condition")
    maximum = where(curvature, "<=", 0, radius, key="maximum_condition")  # the fourth derivative decides the border

    # The second solution treats x, y and theta as free coordinates; their equations contain the contact force.
    kept = [constraint(q, place.value, force=f"lambda_{place.key}") for q, place in zip((x, y), centre)]
    free = System(slab.placed(-theta, point(x, y)), weight(gravity), *kept)
    equations = equations_of_motion(lagrangian(free, symbol="L_free", key="free_lagrangian"), derivatives=False)
    forces = multipliers(*equations, keeping=[theta])
    again = put_in(equations[0], *forces, again=motion, key="multipliers_eliminated")
    N = constraint_force(forces, {x: sin(theta), y: cos(theta)}, "N", "normal_force")
    F = constraint_force(forces, {x: -cos(theta), y: sin(theta)}, "F", "tangent_force")

    needed = []
    if amplitude is not None:  # small oscillations need the greatest friction at a turning point
        turning = solved_for(small, theta.acceleration, keys=["turning"])
        at_rest = put_in(F, turning, {theta.rate: 0, theta: amplitude}, key="turning_force")
        greatest = limiting_case(at_rest, amplitude, key="friction_needed", symbol="F_max")
        least = let("least_friction", lambda F: F / (mass * gravity), greatest, symbol="mu_min", kind="number")
        needed = [greatest, least]

    top, C, O = (radius + thickness) * across, point_mark(point(*centre), "C"), point_mark(point(0, 0), "O")
    way = length_mark(top - radius * theta * along, top, "s")
    sketch(
        "slab", system, axes(point(0, 0), (7 * radius / 5, 9 * radius / 4)), O, C, way, dashed_at(system, {theta: 0})
    )
    plot("potential", U, theta.symbol, (-pi / 2, pi / 2))
    # The forces are those on the slab when it is released from rest. Their lengths are relative to that of the weight,
    # which is 2/7. The friction F is positive uphill.
    (start,) = solve_linear(motion.value.left.subs(theta.rate, 0), theta.acceleration)
    contact, sizes = radius * across, [2 * force / (7 * mass * gravity) for force in (N.value, F.value)]
    push, friction = (size.subs({theta.acceleration: start, theta.rate: 0}) for size in sizes)
    pushes = arrow(across, contact, push, label=N), arrow(-along, contact, friction, label=F)
    arm = length_mark(top - radius * theta * along, top, radius * theta)
    sketch("forces", system, O, C, arm, pushes, weights=Rational(2, 7))
    return L, motion, swings, stable, level, minimum, maximum, again, N, F, *needed
