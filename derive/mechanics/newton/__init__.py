"""Newton's and Euler's laws for single particles and for bodies in a plane, and the conservation of energy."""
