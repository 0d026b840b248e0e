"""The verbs and nouns of mechanics, as a problem's script imports them."""

from derive.mechanics.bodies import Cuboid, centre_of_mass, density
from derive.mechanics.conditions import boundary_case, positive_where
from derive.mechanics.conservation import rate_under
from derive.mechanics.constraints import (
    Tie,
    contact_forces,
    equation_with_multipliers,
    force_of_constraint,
    free_lagrangian,
    multipliers_eliminated,
    tie,
)
from derive.mechanics.coordinates import Coordinate, coordinate, rate_of
from derive.mechanics.direction import Direction
from derive.mechanics.equations import at, let, magnitude, squared_magnitude
from derive.mechanics.free_rotation import (
    RigidBody,
    changing_angular_velocity,
    euler_equations,
    principal_tensor,
    rate_in_body,
    rate_in_space,
)
from derive.mechanics.inertia import inertia_tensor, moved_to
from derive.mechanics.lagrangian import (
    equation_of_motion,
    generalized_force,
    generalized_momentum,
    lagrangian,
    momentum_rate,
    plane_kinetic_energy,
    weight_energy,
)
from derive.mechanics.oscillations import frequency, frequency_squared, linearised
from derive.mechanics.potentials import curvature_at, leading_order, slope
from derive.mechanics.rolling import rolled_centre
from derive.mechanics.rotation import (
    angle_between,
    angular_momentum,
    any_angular_velocity,
    cosine_between,
    kinetic_energy,
    spin,
    torque,
)

__all__ = [
    "Coordinate",
    "Cuboid",
    "Direction",
    "RigidBody",
    "Tie",
    "angle_between",
    "angular_momentum",
    "any_angular_velocity",
    "at",
    "boundary_case",
    "centre_of_mass",
    "changing_angular_velocity",
    "contact_forces",
    "coordinate",
    "cosine_between",
    "curvature_at",
    "density",
    "equation_of_motion",
    "equation_with_multipliers",
    "euler_equations",
    "force_of_constraint",
    "free_lagrangian",
    "frequency",
    "frequency_squared",
    "generalized_force",
    "generalized_momentum",
    "inertia_tensor",
    "kinetic_energy",
    "lagrangian",
    "leading_order",
    "let",
    "linearised",
    "magnitude",
    "momentum_rate",
    "moved_to",
    "multipliers_eliminated",
    "plane_kinetic_energy",
    "positive_where",
    "principal_tensor",
    "rate_in_body",
    "rate_in_space",
    "rate_of",
    "rate_under",
    "rolled_centre",
    "slope",
    "spin",
    "squared_magnitude",
    "tie",
    "torque",
    "weight_energy",
]
