"""Prints a page as plain text, TeX, HTML, Markdown and JSON."""
