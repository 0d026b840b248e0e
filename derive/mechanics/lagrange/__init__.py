"""Energies, Lagrangians, momenta, equations of motion, applied forces, constraint forces, and symmetries."""
