"""Solve for a letter, find roots, treat a linear system, write results as textbooks do; no physics."""
