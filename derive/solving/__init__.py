"""Solves for a symbol, finds roots, solves linear systems, writes results as in a textbook; no physics."""
