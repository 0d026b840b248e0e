"""Coordinates, constraints, Lagrangians, and d'Alembert's principle as a second way to each equation of motion."""
