"""Observations: true statements about answers that a student can learn from, such as the length of an equivalent pendulum."""
