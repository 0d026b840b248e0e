"""The verbs and nouns of mechanics, as a problem's script imports them."""

from derive.mechanics.bodies import Cuboid, centre_of_mass, density
from derive.mechanics.composed import (
    Composed,
    Part,
    axial_moment,
    centre_distance,
    part_moment,
    total_mass,
    transverse_moment,
)
from derive.mechanics.coordinates import Coordinate, coordinate, rate_of
from derive.mechanics.direction import Direction
from derive.mechanics.equations import at, let, magnitude
from derive.mechanics.inertia import agreement, inertia_tensor, moved_to
from derive.mechanics.principal import principal_axes, principal_moments
from derive.mechanics.rotation import (
    angle_between,
    angular_momentum,
    any_angular_velocity,
    cosine_between,
    kinetic_energy,
    spin,
    torque,
)
from derive.mechanics.solids import Ball, Cone, Cylinder, volume
from derive.mechanics.thin_bodies import Disc, Hoop, Plate, Rod

__all__ = [
    "Ball",
    "Composed",
    "Cone",
    "Coordinate",
    "Cuboid",
    "Cylinder",
    "Direction",
    "Disc",
    "Hoop",
    "Part",
    "Plate",
    "Rod",
    "agreement",
    "angle_between",
    "angular_momentum",
    "any_angular_velocity",
    "at",
    "axial_moment",
    "centre_distance",
    "centre_of_mass",
    "coordinate",
    "cosine_between",
    "density",
    "inertia_tensor",
    "kinetic_energy",
    "let",
    "magnitude",
    "moved_to",
    "part_moment",
    "principal_axes",
    "principal_moments",
    "rate_of",
    "spin",
    "torque",
    "total_mass",
    "transverse_moment",
    "volume",
]
