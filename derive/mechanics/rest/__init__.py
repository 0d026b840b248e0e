"""Equilibria and their stability."""
