"""Expressions, and how to decide whether two expressions are equal; no laws of physics and no pages."""
