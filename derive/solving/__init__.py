"""Mathematics without laws of physics: solves for a symbol, finds roots, and writes results as in a textbook."""
