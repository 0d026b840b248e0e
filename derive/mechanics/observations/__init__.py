"""Observations: true statements about answers from which a student can learn, such as an equivalent pendulum."""
