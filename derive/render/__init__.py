"""Prints the tree of a page as text, LaTeX, HTML and JSON, and makes drawings; uses no disk and no subprocess."""
