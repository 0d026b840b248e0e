"""Solves for a symbol, finds roots, solves linear systems, and writes results as in a textbook. It contains no physics."""
