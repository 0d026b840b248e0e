"""How a formula is laid out, and written as LaTeX or as plain text."""
