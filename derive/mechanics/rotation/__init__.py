"""Tensors of inertia, principal axes, and the vectors of a body that turns."""
