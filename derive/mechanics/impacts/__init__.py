"""Impulses and collisions."""
