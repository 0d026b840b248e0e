"""Expressions, and how to decide whether two expressions are equal; this package contains no laws of physics."""
