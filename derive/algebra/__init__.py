"""Expressions, and how to decide whether two expressions are equal. The package contains no laws of physics."""
