"""Generalized coordinates, and positions along fixed or rotating axes."""
