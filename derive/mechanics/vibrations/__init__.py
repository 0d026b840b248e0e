"""Small oscillations: linear equations, normal modes with and without damping, motions of linear systems."""
