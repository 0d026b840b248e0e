"""Solve for a letter, decide a sign, find roots, treat a linear system, write results as textbooks do; no physics."""
