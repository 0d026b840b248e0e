"""The verbs and nouns of mechanics, as a problem's script imports them."""

from derive.mechanics.bodies import Cuboid, centre_of_mass, density
from derive.mechanics.coordinates import Coordinate, coordinate, rate_of
from derive.mechanics.direction import Direction
from derive.mechanics.equations import at, let, magnitude
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
    "angle_between",
    "angular_momentum",
    "any_angular_velocity",
    "at",
    "centre_of_mass",
    "coordinate",
    "cosine_between",
    "density",
    "inertia_tensor",
    "kinetic_energy",
    "let",
    "magnitude",
    "moved_to",
    "rate_of",
    "spin",
    "torque",
]
