"""What an instructor writes, read and checked: YAML, expressions, LaTeX of other documents, scripts."""
