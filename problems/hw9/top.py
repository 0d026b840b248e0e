"""A spinning top: at which rates it precesses steadily, and how fast it must spin to sleep upright."""

from derive.figures import drawing, leaning_top
from derive.given import Acceleration, AngularSpeed, Length, Mass, PolarAngle, require
from derive.mechanics import (
    Composed,
    Disc,
    Part,
    Rod,
    Top,
    axial_moment,
    boundary_case,
    centre_distance,
    centre_height,
    conserved_momentum,
    constant_spin,
    curvature_at,
    equation_of_motion,
    euler_angles,
    lagrangian,
    leading_order,
    positive_where,
    precession_condition,
    precession_rates,
    sleeping_spin,
    slope,
    steady_precession,
    steady_rates,
    tilt_equation,
    tilt_potential,
    top_kinetic_energy,
    total_mass,
    transverse_moment,
    turning_rate,
    upright_rate,
    weight_energy,
    with_values,
)


def solve(
    disc_mass: Mass,
    radius: Length,
    disc_at: Length,
    rod_mass: Mass,
    rod_length: Length,
    spin: AngularSpeed,
    tilt: PolarAngle,
    gravity: Acceleration,
):
    require(disc_at <= rod_length, "disc_at", "must not lie beyond the end of the rod")
    disc, rod = Disc(radius, disc_mass), Rod(rod_length, rod_mass)
    body = Composed(Part("disc", disc, at=disc_at), Part("rod", rod, at=rod_length / 2))
    mass = total_mass(body)
    top = Top(mass, centre_distance(body, mass), transverse_moment(body), axial_moment(body))

    angles = euler_angles()
    theta, phi = angles.theta.symbol, angles.phi.rate
    drawing("top", leaning_top(body, tilt, theta, precession=phi, spin=spin))
    drawing("weight", leaning_top(body, tilt, theta, weight=(mass.symbol * gravity, top.distance)))

    omega = turning_rate(angles)  # theta_dot, phi_dot sin theta, psi_dot + phi_dot cos theta
    T = top_kinetic_energy(top, omega)
    U = weight_energy(top.in_letters().mass, gravity, [centre_height(top, angles)])
    L = lagrangian(T, U)

    S = constant_spin(omega, spin, conserved_momentum(L, angles.psi), top)  # psi is cyclic
    motion = tilt_equation(equation_of_motion(L, angles.theta), S, top, gravity)

    steady = steady_precession(motion)  # theta and phi_dot constant
    rates = precession_rates(steady, tilt)
    condition = precession_condition(rates, spin)
    slow, fast = steady_rates(rates, condition)

    upright = upright_rate(conserved_momentum(L, angles.phi), motion)  # phi is cyclic; upright p_phi = p_psi = I_z S
    V = tilt_potential(upright, T, U)
    here = with_values(curvature_at(slope(V, 2)), *top.values, key="curvature_here")
    stable = positive_where(here, spin, key="upright_condition")
    border = leading_order(with_values(V, *top.values, key="potential_here"), where=boundary_case(stable))
    sleeping = sleeping_spin(stable, border, V)

    return rates, condition, slow, fast, sleeping
