"""Newton's and Euler's laws for single particles and bodies, and the conservation of energy. Bodies move in a plane."""
