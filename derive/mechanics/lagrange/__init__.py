"""Energies, Lagrangians, equations of motion, constraint forces, symmetries."""
