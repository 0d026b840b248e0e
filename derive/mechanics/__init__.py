"""The verbs and nouns of mechanics, as a problem's script imports them."""

from derive.mechanics.bodies import Cuboid, centre_of_mass, density
from derive.mechanics.conservation import rate_under
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
    "angle_between",
    "angular_momentum",
    "any_angular_velocity",
    "at",
    "centre_of_mass",
    "changing_angular_velocity",
    "coordinate",
    "cosine_between",
    "density",
    "euler_equations",
    "inertia_tensor",
    "kinetic_energy",
    "let",
    "magnitude",
    "moved_to",
    "principal_tensor",
    "rate_in_body",
    "rate_in_space",
    "rate_of",
    "rate_under",
    "spin",
    "squared_magnitude",
    "torque",
]
