"""Prints a page as plain text, TeX, HTML, Markdown, JSON and a notebook."""
