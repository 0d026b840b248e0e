"""Prints the tree of a page as text, LaTeX, HTML and JSON, and makes drawings, without files or subprocesses."""
