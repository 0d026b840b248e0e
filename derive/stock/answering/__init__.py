"""Answers that parts ask for by name. Each answer is derived when it is first needed."""
