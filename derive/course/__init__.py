"""Reads and checks what an instructor writes: YAML, expressions, LaTeX and scripts."""
