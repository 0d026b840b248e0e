"""Solve for a symbol, decide a sign, find roots, solve a linear system, write results as in a textbook; no physics."""
