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
from derive.mechanics.cyclic import conserved_momentum
from derive.mechanics.direction import Direction
from derive.mechanics.equations import at, let, magnitude
from derive.mechanics.inertia import agreement, inertia_tensor, moved_to
from derive.mechanics.lagrangian import (
    equation_of_motion,
    lagrangian,
    weight_energy,
)
from derive.mechanics.precession import (
    no_steady_precession,
    precession_condition,
    precession_rates,
    steady_precession,
    steady_rates,
)
from derive.mechanics.principal import principal_axes, principal_moments
from derive.mechanics.quadratics import discriminant, roots_of
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
from derive.mechanics.tops import (
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
    "EulerAngles",
    "Top",
    "centre_height",
    "conserved_momentum",
    "constant_spin",
    "discriminant",
    "equation_of_motion",
    "euler_angles",
    "lagrangian",
    "no_steady_precession",
    "precession_condition",
    "precession_rates",
    "roots_of",
    "steady_precession",
    "steady_rates",
    "tilt_equation",
    "top_kinetic_energy",
    "turning_rate",
    "weight_energy",
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
