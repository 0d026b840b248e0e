"""Solve for a symbol, find roots, solve linear systems, and write results as in a textbook; no physics."""
