"""Energies, the Lagrangian, equations of motion, forces of constraint, symmetries."""
