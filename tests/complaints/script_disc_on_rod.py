"""A disc that must be mounted on a rod."""

from derive.given import Length, Mass, PolarAngle, require
from derive.mechanics import Rod, inertia_tensor


def solve(rod_length: Length, disc_at: Length, mass: Mass, tilt: PolarAngle):
    require(disc_at <= rod_length, "disc_at", "must not lie beyond the end of the rod")
    return inertia_tensor(Rod(rod_length, mass))
