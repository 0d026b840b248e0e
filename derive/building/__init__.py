"""Makes again what changed: derivations, sheets and PDFs, in workers of their own."""
