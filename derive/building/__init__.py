"""Builds what has changed: derivations, sheets and PDFs, in worker processes."""
