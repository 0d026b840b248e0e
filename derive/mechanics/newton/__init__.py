"""Newton's and Euler's laws for each particle and each body, in a plane of motion."""
