"""What changed is made again: derivations, sheets and PDFs, in workers of their own."""
