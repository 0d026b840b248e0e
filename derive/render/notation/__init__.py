"""How a formula is laid out, and written as LaTeX, MathML or plain text."""
