"""Observations: facts about answers from which a student can learn, such as the length of an equivalent pendulum."""
