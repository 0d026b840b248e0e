"""Expressions, and the decision whether two expressions are equal: no laws of physics, no pages."""
