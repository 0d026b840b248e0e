"""The verbs and nouns of mechanics, as a problem's script imports them."""

from inspect import isfunction

import derive.mechanics.outcomes  # from here on it is known what each word of a step must fulfil
import derive.mechanics.outcomes.told  # noqa: F401  and what else its sentence tells
from derive.algebra.direction import Direction
from derive.mechanics.arguments import checked
from derive.mechanics.bodies.body import Cuboid, centre_of_mass, density
from derive.mechanics.bodies.solids import Ball, Cone, Cylinder, volume
from derive.mechanics.bodies.thin_bodies import Disc, Hoop, Plate, Rod
from derive.mechanics.equations.conservation import rate_under
from derive.mechanics.equations.euler_equations import (
    RigidBody,
    changing_angular_velocity,
    euler_equations,
    principal_tensor,
    rate_in_body,
    rate_in_space,
)
from derive.mechanics.equations.inequalities import boundary_case, positive_where
from derive.mechanics.equations.oscillations import frequency, frequency_squared, linearised
from derive.mechanics.equations.quadratics import discriminant, roots_of
from derive.mechanics.equations.special_cases import isotropic_where
from derive.mechanics.equations.stability import curvature_at, leading_order, slope
from derive.mechanics.equations.values import at, let, magnitude, squared_magnitude, with_values
from derive.mechanics.rotation.composite import (
    Composed,
    Part,
    axial_moment,
    centre_distance,
    part_moment,
    total_mass,
    transverse_moment,
)
from derive.mechanics.rotation.inertia import agreement, inertia_tensor, moment_of_inertia, moved_from_centre, moved_to
from derive.mechanics.rotation.principal import principal_axes, principal_moments
from derive.mechanics.rotation.vectors import (
    angle_between,
    angular_momentum,
    any_angular_velocity,
    cosine_between,
    kinetic_energy,
    spin,
    torque,
)
from derive.mechanics.systems.constraints import (
    Tie,
    contact_forces,
    equation_with_multipliers,
    force_of_constraint,
    free_lagrangian,
    multipliers_eliminated,
    tie,
)
from derive.mechanics.systems.coordinates import Coordinate, coordinate, rate_of
from derive.mechanics.systems.cyclic import conserved_momentum
from derive.mechanics.systems.lagrangian import (
    equation_of_motion,
    generalized_force,
    generalized_momentum,
    lagrangian,
    momentum_rate,
    plane_kinetic_energy,
    weight_energy,
)
from derive.mechanics.systems.rolling import rolled_centre
from derive.mechanics.tops.precession import (
    no_steady_precession,
    precession_condition,
    precession_rates,
    steady_precession,
    steady_rates,
)
from derive.mechanics.tops.sleeping import effective_potential, sleeping_spin, upright_rate
from derive.mechanics.tops.top import (
    EulerAngles,
    Top,
    centre_height,
    constant_spin,
    euler_angles,
    tilt_equation,
    top_kinetic_energy,
    turning_rate,
)

__all__ = [
    "Ball",
    "Composed",
    "Cone",
    "Coordinate",
    "Cuboid",
    "Cylinder",
    "Direction",
    "Disc",
    "EulerAngles",
    "Hoop",
    "Part",
    "Plate",
    "RigidBody",
    "Rod",
    "Tie",
    "Top",
    "agreement",
    "angle_between",
    "angular_momentum",
    "any_angular_velocity",
    "at",
    "axial_moment",
    "boundary_case",
    "centre_distance",
    "centre_height",
    "centre_of_mass",
    "changing_angular_velocity",
    "conserved_momentum",
    "constant_spin",
    "contact_forces",
    "coordinate",
    "cosine_between",
    "curvature_at",
    "density",
    "discriminant",
    "effective_potential",
    "equation_of_motion",
    "equation_with_multipliers",
    "euler_angles",
    "euler_equations",
    "force_of_constraint",
    "free_lagrangian",
    "frequency",
    "frequency_squared",
    "generalized_force",
    "generalized_momentum",
    "inertia_tensor",
    "isotropic_where",
    "kinetic_energy",
    "lagrangian",
    "leading_order",
    "let",
    "linearised",
    "magnitude",
    "moment_of_inertia",
    "momentum_rate",
    "moved_from_centre",
    "moved_to",
    "multipliers_eliminated",
    "no_steady_precession",
    "part_moment",
    "plane_kinetic_energy",
    "positive_where",
    "precession_condition",
    "precession_rates",
    "principal_axes",
    "principal_moments",
    "principal_tensor",
    "rate_in_body",
    "rate_in_space",
    "rate_of",
    "rate_under",
    "rolled_centre",
    "roots_of",
    "sleeping_spin",
    "slope",
    "spin",
    "squared_magnitude",
    "steady_precession",
    "steady_rates",
    "tie",
    "tilt_equation",
    "top_kinetic_energy",
    "torque",
    "total_mass",
    "transverse_moment",
    "turning_rate",
    "upright_rate",
    "volume",
    "weight_energy",
    "with_values",
]

for _name in __all__:
    if isfunction(globals()[_name]):
        globals()[_name] = checked(globals()[_name])
