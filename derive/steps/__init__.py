"""Verified steps: the function that makes them, and the steps on which each answer depends."""
