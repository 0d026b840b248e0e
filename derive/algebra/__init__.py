"""Expressions, and the decision whether two are equal: no laws of physics, no pages."""
