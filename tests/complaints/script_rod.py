"""A rod, its centre of mass and its inertia tensor."""

from derive.given import Length, Mass
from derive.mechanics import Rod, centre_of_mass, inertia_tensor


def solve(length: Length, mass: Mass):
    rod = Rod(length, mass)
    return centre_of_mass(rod, origin="end"), inertia_tensor(rod)
