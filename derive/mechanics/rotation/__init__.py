"""Inertia tensors, principal axes, angular velocity and angular momentum, Euler's equations and perturbed rotations."""
