"""Inertia tensors, principal axes, rotation vectors, Euler's equations, perturbed rotations."""
