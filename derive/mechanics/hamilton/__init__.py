"""Hamiltonians, Hamilton's equations, Poisson brackets, Routhians and effective potential energies."""
