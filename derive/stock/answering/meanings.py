"""The meaning of each answer that a description offers, in words, for the list of all answers."""

from __future__ import annotations

import re
from collections.abc import Mapping

MEANINGS: Mapping[str, str] = {
    # systems
    "kinetic_energy": "the kinetic energy",
    "potential_energy": "the potential energy",
    "lagrangian": "the Lagrangian",
    "equations_of_motion": "the equation of motion of each coordinate",
    "momenta": "the momentum of each coordinate",
    "conserved": "the constant momenta of cyclic coordinates",
    "energy_function": "the energy function h",
    "energy_function_rate": "the rate of change of the energy function",
    "hamiltonian": "the Hamiltonian",
    "hamilton_equations": "Hamilton's equations",
    "routhian": "the Routhian",
    "effective_potential": "the effective potential energy",
    "equilibria": "the equilibria, or the steady motions",
    "stability": "the stability of each equilibrium",
    "linearised": "the equations of motion for small displacements",
    "normal_modes": "the frequencies and the shapes of the normal modes",
    "frequency": "the frequencies of small oscillations",
    "period": "the period of small oscillations",
    "no_slip": "the conditions of rolling without slipping",
    "angular_velocity": "the angular velocity of each body",
    "accelerations": "the acceleration of each coordinate, with the forces of constraint eliminated",
    "multipliers": "the forces of constraint, or the Lagrange multipliers",
    "motion_*": "the equation of motion of {}",
    "momentum_*": "the momentum of {}",
    "conserved_*": "the conserved momentum of {}",
    "constant_*": "the value of the conserved momentum of {}",
    "acceleration_*": "the acceleration of {}",
    # impacts
    "jumps": "the jump of the momentum of each coordinate",
    "meetings": "the conditions on the rates just after the impact",
    "rates_after": "all rates just after the impact",
    "kinetic_energy_after": "the kinetic energy just after the impact",
    "work_of_impulses": "the change of the kinetic energy in the impact",
    "jump_*": "the jump of the momentum of {}",
    "*_dot_after": "the rate of {} just after the impact",
    # bodies
    "centre_of_mass": "the centre of mass",
    "centre_of_mass_*": "the {} coordinate of the centre of mass",
    "density": "the density",
    "mass": "the mass",
    "length": "the length",
    "area": "the area",
    "volume": "the volume",
    "inertia_tensor": "the inertia tensor",
    "inertia_tensor_*": "the entry {} of the inertia tensor",
    "parallel_axes": "the inertia tensor by the parallel-axis theorem",
    "moment_of_inertia_*": "the moment of inertia about the {} axis",
    "radius_of_gyration_*": "the radius of gyration about the {} axis",
    "moment_about": "the moment of inertia about `direction`",
    "turned_tensor": "the inertia tensor along rotated axes",
    "principal_moments": "the principal moments of inertia",
    "principal_axes": "the principal axes",
    "principal_angle": "the angle from the x axis to a principal axis in the x-y plane",
    "perpendicular_axes": "the moment of inertia about the normal of a flat body (perpendicular-axis theorem)",
    # rotations
    "spin": "the angular velocity",
    "angular_momentum": "the angular momentum",
    "angular_momentum_size": "the magnitude of the angular momentum",
    "angle_between": "the angle between the angular velocity and the angular momentum",
    "torque": "the torque",
    "torque_size": "the magnitude of the torque",
    "euler_equations": "Euler's equations",
    "energy_rate": "the rate of change of the kinetic energy",
    "squared_momentum_rate": "the rate of change of the squared angular momentum",
    "momentum_rate_in_body": "the rate of change of the angular momentum as seen from the body",
    "momentum_rate_in_space": "the rate of change of the angular momentum in space",
    "body_cone_rate": "the rate at which the angular velocity precesses in the body",
    "axis_of_symmetry": "the axis of symmetry",
    "body_cone": "the angle between the axis of symmetry and the angular velocity",
    "space_cone": "the angle between the angular momentum and the angular velocity",
    "tilt": "the angle between the axis of symmetry and the angular momentum",
    "body_cone_tangent": "the tangent of the angle of the body cone",
    "space_cone_tangent": "the tangent of the angle of the space cone",
    "tilt_tangent": "the tangent of the tilt",
    "precession_rate": "the rate at which the axis of symmetry precesses",
    "euler_*": "Euler's equation for the {} axis",
    "stability_*": "the stability of a rotation about the {} axis",
    "wobble_*": "the frequency or growth rate of a disturbance of the rotation about the {} axis",
    "wobble_period_*": "the period of a small disturbance of the rotation about the {} axis",
    "spin_*": "the {} component of the angular velocity",
    "angular_momentum_*": "the {} component of the angular momentum",
    "torque_*": "the {} component of the torque",
}
FORCE = "a force of constraint or an impulse"  # any other name is the symbol of a force or an impulse


def meaning_of(name: str) -> str:
    """Return the meaning of an answer in words, including the coordinate or the axis in its name."""
    if name in MEANINGS:
        return MEANINGS[name]
    fitting = []
    for pattern, words in MEANINGS.items():
        found = re.fullmatch(re.escape(pattern).replace(r"\*", r"(\w+)"), name) if "*" in pattern else None
        if found:
            fitting.append((len(pattern), words.format(found[1])))
    return max(fitting)[1] if fitting else FORCE
