"""Solve for a symbol, find roots, solve linear systems, write results as in a textbook; no physics."""
