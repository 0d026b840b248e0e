"""Reads and checks what an instructor writes: YAML, expressions, LaTeX of other documents, scripts."""
