"""The tree as text, LaTeX, JSON and drawings; no disk, no subprocess."""
