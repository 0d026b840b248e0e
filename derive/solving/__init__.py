"""Mathematics without laws of physics: solving for a symbol, roots, linear systems, and textbook forms of results."""
