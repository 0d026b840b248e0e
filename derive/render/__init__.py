"""From a document to text, LaTeX, JSON and PDF."""
