"""Phase space, Hamilton's equations, Poisson brackets, the Routhian and effective potential energies."""
