"""Quantities computed from results: substitution, solving, roots, conditions, limits, extrema, combinations."""
